// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Blocks in three dimensions, from the distributed mesh to the steps. These
// tests also run on two and three ranks, among which the block is divided.

#include "../base/message_of.h"
#include "../mesh/space_box.h"
#include "../model/test_models.h"

#include <quoin/operators/stored_energy.h>
#include <quoin/blocks/block_cells.h>
#include <quoin/dynamics/central_differences.h>
#include <quoin/dynamics/kinetic_energy.h>
#include <quoin/base/exceptions.h>
#include <quoin/absorbing/free_field_boundary.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/motions/prescribed_motion.h>
#include <quoin/motions/space_platen.h>
#include <quoin/absorbing/viscous_boundary.h>
#include <quoin/mesh/partition.h>

#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

#include <map>

using namespace quoin;
using namespace quoin::test;

namespace
{
  using Vector = dealii::Tensor<1, 3>;

  LoadParameters load(const std::string &name, const LoadType type,
                      const std::vector<std::string> &sides)
  {
    LoadParameters result;
    result.name       = name;
    result.type       = type;
    result.boundaries = sides;
    return result;
  }

  /** A box on all ranks, with what acts on it. */
  struct Box
  {
    const LinearElastic stone;
    const BlockTriangulation<3> blocks;
    const NodeMap<3> nodes;
    BlockForces<3> forces;
    PhaseClock clock;
    CentralDifferences<3> stepper;
    const std::vector<double> mass;
    StageParameters stage;
    State<3> state;
    std::vector<std::unique_ptr<ForceOperator<3>>> loads;
    std::vector<std::unique_ptr<MotionConstraint<3>>> constraints;
    double dt = 0., stored = 0., kinetic = 0.;

    Box(const Count &n, const double h, const LinearElastic &stone)
      : stone(stone), blocks(made(n, h)), nodes(blocks),
        stepper(nodes, forces, clock),
        mass(lumped_masses(nodes, { stone.density }))
    {
      BlockForcesData<3> data;
      take_cells(nodes, data);
      data.stiffness = { space_stiffness(stone) };
      forces.prepare(data);
      forces.prepare(state);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        state.nodes.push_back({});
        for (unsigned int d = 0; d < 3; ++d)
          state.nodes[i].X[d] = nodes.point(i)[d];
      }
      state.velocity.assign(nodes.n_local(), dealii::Tensor<1, 3>());

      std::vector<NodeStiffness<3>> bound(nodes.n_local(), NodeStiffness<3>{});
      forces.add_stiffness_bound(state, {}, bound);
      nodes.exchange().add_to_owners(bound.data());
      bound.resize(nodes.n_owned());
      dt = 0.8
           * StableTimeStep<3>::critical(
               dealii::Utilities::MPI::max(
                   StableTimeStep<3>(bound).largest_eigenvalue(mass),
                   MPI_COMM_WORLD),
               0.);
      state.previous_time_step = dt;
    }

    static BlockTriangulation<3> made(const Count &n, const double h)
    {
      BlockMesh<3> mesh       = box_mesh(n, h);
      const auto rank_of_cell = partition_cells(
          mesh, { false },
          dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
      return { mesh, rank_of_cell, { false }, MPI_COMM_WORLD };
    }

    void begin()
    {
      std::vector<ForceOperator<3> *> on;
      for (const auto &each : loads)
        on.push_back(each.get());
      std::vector<MotionConstraint<3> *> moving;
      for (const auto &each : constraints)
        moving.push_back(each.get());
      stage.damping = DampingType::none;
      stepper.set_operators(on, {}, moving, stage);
      for (MotionConstraint<3> *constraint : moving)
      {
        constraint->prepare(state);
        constraint->begin_stage(state, false);
      }
      stepper.capture_nodes(mass, {},
                            std::vector<bool>(nodes.n_local(), false));
      nodes.exchange().update_ghosts(state.nodes.data());
    }

    /** Takes a step; energies are then those before it, of all ranks. */
    void step()
    {
      const StepContext context = step_context(state, stage, dt);
      state.energy += state.pending;
      state.pending = EnergyAccounts();
      stepper.update_neighbours(state, context);
      stepper.add_forces(state, context);
      stored                     = sum(stored_energy(state, forces));
      const auto velocity_before = state.velocity;
      StepSums sums;
      stepper.advance_blocks(state, context, false, sums);
      stepper.move_constrained_nodes(state, context);
      stepper.book_work(state, context, sums);
      kinetic = sum(
          kinetic_energy(nodes, mass, velocity_before, state.velocity, 1.));
      stepper.exchange_positions(state);
      ++state.step;
      ++state.stage_step;
      state.time += dt;
      state.load_time = state.time;
    }

    /** What the balance leaves over [J]. */
    double residual() const
    {
      return stored + kinetic
             + sum(state.energy.sum(EnergyKind::dissipated)
                   - state.energy.sum(EnergyKind::given));
    }

    static double sum(const double value)
    {
      return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
    }

    /** Sum over all nodes of mass times what @p of says of a node. */
    Vector sum_of_mass(
        const std::function<Vector(const Vector &x, const Vector &v)> &of) const
    {
      Vector result;
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        Vector x, v;
        for (unsigned int d = 0; d < 3; ++d)
        {
          // Positions where velocities are: half a step ago.
          x[d] = state.nodes[i].X[d] + state.nodes[i].u[d]
                 - 0.5 * dt * state.velocity[i][d];
          v[d] = state.velocity[i][d];
        }
        result += mass[i] * of(x, v);
      }
      return dealii::Utilities::MPI::sum(result, MPI_COMM_WORLD);
    }

    /** Sets motion of all nodes by their positions. */
    void set(const std::function<Vector(const Vector &x)> &displacement,
             const std::function<Vector(const Vector &x)> &velocity)
    {
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        const Vector u = displacement(nodes.point(i)),
                     v = velocity(nodes.point(i));
        for (unsigned int d = 0; d < 3; ++d)
        {
          state.nodes[i].u[d]  = u[d];
          state.velocity[i][d] = v[d];
        }
      }
    }
  };

  const LinearElastic stone{ 2500., 1e10, 0.25 };
} // namespace

TEST(SpaceBlocks, FreeFlightKeepsMomentaAndEnergy)
{
  for (const Vector &axis : { Vector({ 1., 0.1, 0. }), Vector({ 0., 1., 0.2 }),
                              Vector({ 0.3, 0., 1. }) })
  {
    Box box({ 4, 3, 2 }, 0.5, stone);
    const Vector drift({ 1., -2., 3. });
    box.set([](const Vector &) { return Vector(); }, [&](const Vector &x)
            { return drift + 40. * dealii::cross_product_3d(axis, x); });
    box.begin();
    const auto momentum = [](const Vector &, const Vector &v) { return v; };
    const auto angular  = [](const Vector &x, const Vector &v)
    { return dealii::cross_product_3d(x, v); };
    const Vector p = box.sum_of_mass(momentum), L = box.sum_of_mass(angular);
    box.step();
    const double energy = box.stored + box.kinetic;
    for (unsigned int i = 0; i < 1000; ++i)
      box.step();
    EXPECT_LT((box.sum_of_mass(momentum) - p).norm(), 1e-12 * p.norm());
    // The arm of half a step ago, before the forces turned the velocity.
    EXPECT_LT((box.sum_of_mass(angular) - L).norm(), 1e-5 * L.norm());
    EXPECT_NEAR(box.stored + box.kinetic, energy, 1e-5 * energy);
  }
}

// A uniform strain is in equilibrium whatever the mesh and its division.
TEST(SpaceBlocks, PassThePatchTest)
{
  Box box({ 4, 4, 4 }, 0.25, stone);
  const double A[3][3]
      = { { 1e-4, 3e-5, -2e-5 }, { 5e-5, -2e-4, 1e-5 }, { 0., 4e-5, 3e-4 } };
  const auto affine = [&](const Vector &x)
  {
    Vector u;
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int e = 0; e < 3; ++e)
        u[d] += A[d][e] * x[e];
    return u;
  };
  box.set(affine, [](const Vector &) { return Vector(); });
  LoadParameters held = load("held", LoadType::prescribed_motion,
                             { "x0", "x1", "y0", "y1", "z0", "z1" });
  for (LoadComponent &part : held.components)
    part = component(LoadQuantity::velocity, "0");
  box.constraints.push_back(
      std::make_unique<PrescribedMotion<3>>(held, box.nodes));
  box.begin();
  for (unsigned int i = 0; i < 50; ++i)
    box.step();
  for (unsigned int i = 0; i < box.nodes.n_owned(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(box.state.nodes[i].u[d], affine(box.nodes.point(i))[d],
                  1e-4 * 1e-10);
}

// Held at one end and pulled at the other from t = 0 on: a wave runs to the
// held end and back, behind which the stress has doubled. By a traction and by
// a negative pressure, which is along the outward normal.
TEST(SpaceBlocks, BarUnderASuddenEndLoad)
{
  const LinearElastic cork{ 2500., 1e10, 0. };
  const double c = std::sqrt(cork.young / cork.density), traction = 1e5;
  for (const bool by_pressure : { false, true })
  {
    Box box({ 80, 1, 1 }, 0.1, cork);
    LoadParameters held = load("held", LoadType::prescribed_motion, { "x0" });
    held.components[0]  = component(LoadQuantity::velocity, "0");
    box.constraints.push_back(
        std::make_unique<PrescribedMotion<3>>(held, box.nodes));
    LoadParameters pull = load("pull", LoadType::traction, { "x1" });
    (by_pressure ? pull.pressure : pull.components[0])
        = component(LoadQuantity::force, by_pressure ? "-1e5" : "1e5");
    box.loads.push_back(
        std::make_unique<NodalLoad<3>>(pull, box.nodes, box.mass, 1.));
    box.begin();
    while (box.state.time < 8. / c)
      box.step();
    double end = 0., reaction = box.sum(box.constraints[0]->resultant()[0]);
    for (unsigned int i = 0; i < box.nodes.n_owned(); ++i)
      if (box.nodes.point(i)[0] > 7.99)
        end = box.state.nodes[i].u[0];
    end            = dealii::Utilities::MPI::max(end, MPI_COMM_WORLD);
    const double v = traction / (cork.density * c);
    EXPECT_NEAR(end, v * box.state.time, 0.01 * v * box.state.time);
    EXPECT_LT(std::abs(box.residual()), 1e-6 * box.stored);
    while (box.state.time < 12. / c)
      box.step();
    reaction = box.sum(box.constraints[0]->resultant()[0]);
    // Twice the stress with some ringing at the front of the wave.
    EXPECT_NEAR(reaction, -2. * traction * 0.01, 0.2 * traction * 0.01);
    EXPECT_LT(std::abs(box.residual()), 1e-6 * box.stored);
  }
}

TEST(SpaceBlocks, PlanePulsesLeaveThroughDashpots)
{
  const SpaceStiffness C = space_stiffness(stone);
  for (const unsigned int d : { 0U, 1U }) // of P and S waves along x
  {
    Box box({ 160, 1, 1 }, 0.05, stone);
    const double c
        = std::sqrt((d == 0 ? C.lambda + 2. * C.mu : C.mu) / stone.density);
    const Impedance beyond = impedance_of(stone, PlaneAssumption::plane_strain);
    LoadParameters sides   = load("sides", LoadType::prescribed_motion,
                                  { "y0", "y1", "z0", "z1" });
    for (unsigned int e = 0; e < 3; ++e)
      if (e != d)
        sides.components[e] = component(LoadQuantity::velocity, "0");
    const LoadParameters ends
        = load("ends", LoadType::viscous_boundary, { "x0", "x1" });
    box.constraints.push_back(std::make_unique<ViscousBoundary<3>>(
        ends, box.nodes, std::vector<Impedance>{ beyond }, 1.));
    box.constraints.push_back(
        std::make_unique<PrescribedMotion<3>>(sides, box.nodes));
    const double size = 1e-6;
    const auto pulse  = [&](const double x)
    { return size * std::exp(-(x - 3.) * (x - 3.) / 0.5); };
    const auto along = [&](const double value)
    {
      Vector u;
      u[d] = value;
      return u;
    };
    box.set([&](const Vector &x) { return along(pulse(x[0])); },
            [&](const Vector &x)
            {
              const double ahead = x[0] + 0.5 * c * box.dt; // half a step ago
              return along(c * 4. * (ahead - 3.) * pulse(ahead));
            });
    box.begin();
    box.step();
    const double energy = box.stored + box.kinetic;
    while (box.state.time < 3. / c)
      box.step();
    for (unsigned int i = 0; i < box.nodes.n_owned(); ++i)
      EXPECT_NEAR(box.state.nodes[i].u[d],
                  pulse(box.nodes.point(i)[0] - c * box.state.time),
                  0.01 * size);
    EXPECT_NEAR(box.residual(), energy, 1e-6 * energy);
    while (box.state.time < 14. / c)
      box.step();
    EXPECT_LT(box.stored + box.kinetic, 1e-4 * energy);
    EXPECT_NEAR(box.residual(), energy, 1e-6 * energy);
    EXPECT_NEAR(box.sum(box.state.energy.viscous), energy, 1e-3 * energy);
  }
}

namespace
{
  using Matrix = dealii::Tensor<2, 3>;

  Matrix turned_by(const Vector &turn)
  {
    if (turn.norm() == 0.)
      return dealii::unit_symmetric_tensor<3>();
    return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
        turn / turn.norm(), turn.norm());
  }

  /** A box of which a platen moves all nodes. */
  struct Plate : Box
  {
    SpacePlaten *platen;
    double total = 0.;
    Vector centre;
    Matrix inertia; /**< about the centre, where it begins */

    Plate(const std::array<LoadComponent, 3> &parts,
          const std::array<LoadComponent, 3> &turns,
          const Count &count                         = { { 4, 3, 2 } },
          const std::vector<std::string> &boundaries = {})
      : Box(count, 0.5, LinearElastic{ 2500., 1e10, 0.25 })
    {
      LoadParameters plate = load("plate", LoadType::platen, {});
      if (boundaries.empty())
        plate.groups = { "rock" };
      plate.boundaries = boundaries;
      plate.components = parts;
      plate.rotations  = turns;
      auto made        = std::make_unique<SpacePlaten>(plate, nodes);
      platen           = made.get();
      platen->set_mass(mass);
      constraints.push_back(std::move(made));
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        total += mass[i];
        centre += mass[i] * Vector(nodes.point(i));
      }
      total  = sum(total);
      centre = dealii::Utilities::MPI::sum(centre, MPI_COMM_WORLD) / total;
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        const Vector r = nodes.point(i) - centre;
        for (unsigned int d = 0; d < 3; ++d)
        {
          inertia[d][d] += mass[i] * r.norm_square();
          for (unsigned int e = 0; e < 3; ++e)
            inertia[d][e] -= mass[i] * r[d] * r[e];
        }
      }
      inertia = dealii::Utilities::MPI::sum(inertia, MPI_COMM_WORLD);
    }

    const SpacePlatenState &now() const
    {
      return state.get<SpacePlatenState>("plate");
    }
    Vector spin() const
    {
      const auto &v = now().velocity;
      return Vector({ v[3], v[4], v[5] });
    }
  };
} // namespace

// About an axis near its middle one it tumbles; the momentum stays.
TEST(SpaceBlocks, AFreePlatenFollowsEulersEquations)
{
  Plate box({}, {});
  const Vector first({ 3., 40., -2. }), drift({ 1., -2., 3. });
  box.set([](const Vector &) { return Vector(); }, [&](const Vector &x)
          { return drift + cross_product_3d(first, x - box.centre); });
  box.begin();
  EXPECT_LT((box.spin() - first).norm(), 1e-12);
  // Velocities are those of half a step ago.
  Matrix R           = turned_by(-0.5 * box.dt * first);
  const Vector L     = R * (box.inertia * (transpose(R) * first));
  const auto spin_of = [&](const Matrix &rotation)
  {
    return Vector(rotation * (invert(box.inertia) * (transpose(rotation) * L)));
  };
  double energy = 0., change = 0.;
  while (box.state.time < 0.2)
  {
    box.step();
    if (energy == 0.)
      energy = box.kinetic;
    // by the middle of the step
    R = turned_by(box.dt * spin_of(turned_by(0.5 * box.dt * spin_of(R)) * R))
        * R;
    EXPECT_LT((box.spin() - spin_of(R)).norm(), 2e-4 * first.norm());
    change = std::max(change, (box.spin() - first).norm());
  }
  EXPECT_GT(change, 10.);
  EXPECT_NEAR(box.kinetic, energy, 1e-5 * energy);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(box.now().displacement[d], drift[d] * box.state.time, 1e-9);
}

// Three sides of a cube, which have all of its nodes: the centre of the platen
// is their middle, and not that of its masses, which moves on as that of a free
// body does.
TEST(SpaceBlocks, AFreePlatenOnBoundariesKeepsItsMomentum)
{
  Plate box({}, {}, { { 1, 1, 1 } }, { "x0", "x1", "z1" });
  const Vector first({ 3., 40., -2. }), drift({ 1., -2., 3. });
  box.set([](const Vector &) { return Vector(); }, [&](const Vector &x)
          { return drift + cross_product_3d(first, x - box.centre); });
  box.begin();
  EXPECT_LT((box.spin() - first).norm(), 1e-12);
  EXPECT_LT((box.now().centre - Vector({ 0.25, 0.25, 1. / 3. })).norm(), 1e-14);
  EXPECT_GT((box.now().centre - box.centre).norm(), 0.01);
  box.step();
  const double energy    = box.kinetic;
  const auto mean_of_run = [&](const double end)
  {
    const auto centre_now = [&]()
    {
      Vector sum;
      for (unsigned int i = 0; i < box.nodes.n_owned(); ++i)
        sum += box.mass[i] / box.total * Vector(box.state.nodes[i].position());
      return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    };
    const Vector from = centre_now();
    const double then = box.state.time;
    while (box.state.time < end)
      box.step();
    return (centre_now() - from) / (box.state.time - then);
  };
  // It turns by 0.8 rad, then by 7; about the middle nodes move with 3 m/s.
  const Vector velocity = mean_of_run(0.02);
  EXPECT_LT((velocity - drift).norm(), 0.01);
  EXPECT_LT((mean_of_run(0.2) - velocity).norm(), 1e-4);
  EXPECT_NEAR(box.kinetic, energy, 1e-4 * energy);
}

// A quarter of a turn about z, the rest held: nodes are where it takes them,
// and the work of its moment is the energy of its rotation.
TEST(SpaceBlocks, ADrivenPlatenTurnsAsGiven)
{
  const LoadComponent held = component(LoadQuantity::velocity, "0");
  Plate box({ { held, held, held } },
            { { held, held,
                component(LoadQuantity::displacement,
                          "90 * 0.5 * (1 - cos(pi * min(1, t / 0.05)))") } });
  box.begin();
  double most = 0.;
  while (box.state.time < 0.05)
  {
    box.step();
    EXPECT_LT(std::abs(box.residual()), 1e-6 * 1e3 + 1e-4 * box.kinetic);
    most = std::max(most, box.kinetic);
  }
  // 0.5 I (pi/2 pi/2/0.05)^2
  EXPECT_NEAR(most,
              0.5 * box.inertia[2][2] * std::pow(0.25 * M_PI * M_PI / 0.05, 2),
              1e-3 * most);
  for (unsigned int i = 0; i < box.nodes.n_owned(); ++i)
  {
    const Vector r = box.nodes.point(i) - box.centre;
    const auto &u  = box.state.nodes[i].u;
    EXPECT_NEAR(u[0], -r[1] - r[0], 1e-12);
    EXPECT_NEAR(u[1], r[0] - r[1], 1e-12);
    EXPECT_NEAR(u[2], 0., 1e-12);
  }
}

// 5 N along y; 20 N m about x while it may turn about z, but not about y.
TEST(SpaceBlocks, ForcesAndMomentsAccelerateAPlaten)
{
  Plate box({ { {}, component(LoadQuantity::force, "5"), {} } },
            { { component(LoadQuantity::force, "20"),
                component(LoadQuantity::velocity, "0"),
                {} } });
  box.begin();
  box.step();
  const Matrix &I  = box.inertia;
  const double det = I[0][0] * I[2][2] - I[0][2] * I[2][0];
  const Vector turned({ 20. * I[2][2] / det, 0., -20. * I[2][0] / det });
  // The first step has half a step's velocity behind it.
  const double by = box.spin()[0] / turned[0];
  EXPECT_NEAR(by, box.dt, 0.51 * box.dt);
  EXPECT_LT((box.spin() - by * turned).norm(), 1e-9 * by * turned.norm());
  EXPECT_NE(turned[2], 0.);
  EXPECT_NEAR(box.now().velocity[1], by * 5. / box.total, 1e-12 * by);
  EXPECT_NEAR(box.platen->MotionConstraint<3>::resultant()[3], 20., 1e-12);
  EXPECT_NEAR(box.platen->MotionConstraint<3>::resultant()[4],
              Vector(I * turned)[1], 1e-9 * std::abs(turned.norm() * I[0][0]));
  EXPECT_EQ(box.platen->MotionConstraint<3>::resultant()[5], 0.);
  EXPECT_EQ(box.platen->MotionConstraint<3>::resultant()[1], 5.);
}

namespace
{
  /** Puts @p box on a viscous base, from which the same waves rise along all
      axes, or on one that moves, between free fields on four sides. */
  void stand_between_free_fields(Box &box, const bool prescribed)
  {
    const auto z         = impedance_of(stone, PlaneAssumption::plane_strain);
    LoadParameters below = load("base",
                                prescribed ? LoadType::prescribed_motion
                                           : LoadType::viscous_boundary,
                                { "z0" });
    for (LoadComponent &part : below.components)
      part = component(LoadQuantity::velocity,
                       "1e-9*(1-cos(2*pi*t/0.016))*if(t<0.016,1,0)");
    LoadParameters sides
        = load("sides", LoadType::free_field, { "x0", "x1", "y0", "y1" });
    if (prescribed)
      box.constraints.push_back(
          std::make_unique<PrescribedMotion<3>>(below, box.nodes));
    else
      box.constraints.push_back(std::make_unique<ViscousBoundary<3>>(
          below, box.nodes, std::vector<Impedance>{ z }, 1.));
    FreeFieldGround ground;
    ground.materials = { stone };
    ground.is_rigid = ground.yields = { false };
    auto fields                     = std::make_unique<FreeFieldBoundary<3>>(
        sides, box.nodes, ground, FreeFieldBase{ below, { z } });
    box.dt = std::min(box.dt,
                      1.6 / std::sqrt(fields->traits().largest_eigenvalue));
    // What prescribes comes last.
    box.constraints.insert(prescribed ? box.constraints.begin()
                                      : box.constraints.end(),
                           std::move(fields));
  }
} // namespace

TEST(SpaceFreeField, VerticalWavesPassAsIfTheModelWereEndless)
{
  Box box({ 6, 4, 20 }, 1., stone);
  stand_between_free_fields(box, false);
  box.begin();
  double peak = 0., scatter = 0.;
  while (box.state.time < 0.04)
  {
    box.step();
    std::array<double, 6> ends; // largest and, negative, smallest
    ends.fill(-1.);
    for (unsigned int i = 0; i < box.nodes.n_owned(); ++i)
      if (box.nodes.point(i)[2] == 20.)
        for (unsigned int d = 0; d < 3; ++d)
          for (const unsigned int k : { 0, 1 })
            ends[2 * d + k]
                = std::max(ends[2 * d + k],
                           box.state.velocity[i][d] * (k == 0 ? 1. : -1.));
    for (unsigned int k = 0; k < 6; ++k)
      ends[k] = dealii::Utilities::MPI::max(ends[k], MPI_COMM_WORLD);
    for (unsigned int d = 0; d < 3; ++d)
    {
      peak    = std::max(peak, ends[2 * d]);
      scatter = std::max(scatter, ends[2 * d] + ends[2 * d + 1]);
    }
  }
  EXPECT_NEAR(peak, 4e-9, 0.1e-9);
  EXPECT_LT(scatter, 0.03 * peak);
}

TEST(SpaceFreeField, BalancesItsEnergy)
{
  for (const bool prescribed : { false, true })
  {
    Box box({ 3, 2, 4 }, 1., stone);
    stand_between_free_fields(box, prescribed);
    box.stage.mass_coefficient      = 5.;
    box.stage.stiffness_coefficient = 1e-5;
    box.begin();
    box.stage.damping = DampingType::rayleigh;
    double largest = 0., most = 0.;
    for (unsigned int i = 0; i < 300; ++i)
    {
      box.step();
      largest = std::max(largest, std::abs(box.residual()));
      most    = std::max(most, box.stored + box.kinetic);
    }
    EXPECT_LT(largest, 1e-6 * most);
    EXPECT_GT(box.sum(box.state.energy.viscous), 0.);
  }
}

TEST(SpaceFreeField, RefusesWhatIsNoSideAndNoBase)
{
  const Box box({ 2, 2, 2 }, 1., stone);
  const auto z = impedance_of(stone, PlaneAssumption::plane_strain);
  FreeFieldGround rock;
  rock.materials = { stone };
  rock.is_rigid = rock.yields = { false };
  const auto message = [&](const std::string &side, const std::string &base,
                           const FreeFieldGround &ground)
  {
    return message_of<InputError>(
        [&]
        {
          FreeFieldBoundary<3>(
              load("sides", LoadType::free_field, { side }), box.nodes, ground,
              { load("base", LoadType::viscous_boundary, { base }), { z } });
        });
  };
  FreeFieldGround yielding = rock, rigid = rock;
  yielding.yields = rigid.is_rigid = { true };
  const std::vector<std::pair<std::string, std::string>> said
      = { { message("z1", "z0", rock), "not vertical" },
          { message("x0", "z1", rock),
            "'Base' is 'base', which does not meet" },
          { message("x0", "y0", rock), "does not meet the foot" },
          { message("y0", "z0", yielding), "'Mohr-Coulomb'" },
          { message("y0", "z0", rigid), "rigid block" } };
  for (const auto &[text, words] : said)
  {
    EXPECT_NE(text.find("'Loads/sides'"), std::string::npos) << text;
    EXPECT_NE(text.find(words), std::string::npos) << text;
  }
}

TEST(SpaceFreeField, AnSWaveNeedsAHorizontalBase)
{
  const Box box({ 1, 1, 1 }, 1., stone);
  LoadParameters side    = load("side", LoadType::viscous_boundary, { "x0" });
  side.components[2]     = component(LoadQuantity::velocity, "t");
  const std::string text = message_of<InputError>(
      [&]
      {
        ViscousBoundary<3>(
            side, box.nodes,
            { impedance_of(stone, PlaneAssumption::plane_strain) }, 1.);
      });
  for (const std::string words :
       { "'Loads/side'", "Incident lateral velocity", "not horizontal" })
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

namespace
{
  /** Velocities of all nodes after an oblique P wave, which also pushes where
      it leaves, has come in through the loads on these sides. */
  std::vector<Vector>
  after_wave(const std::vector<std::vector<std::string>> &sides)
  {
    const BlockTriangulation<3> blocks = Box::made({ 8, 2, 2 }, 1.);
    const NodeMap<3> nodes(blocks);
    ModelParameters parameters;
    parameters.materials = { material("rock") };
    Model<3> model(nodes, parameters);
    std::vector<LoadParameters> loads;
    StageParameters stage = stage_with({});
    for (const auto &side : sides)
    {
      loads.push_back(load(side.front(), LoadType::viscous_boundary, side));
      loads.back().wave_direction = dealii::Point<3>(2., 0., 1.);
      loads.back().components[0]  = component(LoadQuantity::velocity,
                                              "1e-9*if(t > 0, sin(500*t)^2, 0)");
      stage.loads.push_back(side.front());
    }
    ExplicitSolver<3> solver(model, loads);
    State<3> state = model.initial_state();
    solver.begin_stage(stage, nullptr, state);
    solver.set_time_step(0.8 * solver.critical_step().length);
    while (state.time < 3e-3)
      solver.step(state, { false, false });
    return { state.velocity.begin(), state.velocity.end() };
  }
} // namespace

TEST(SpaceWaves, LoadsOfOneDirectionShareItsOrigin)
{
  const auto one = after_wave({ { "x0", "x1" } });
  const auto two = after_wave({ { "x1" }, { "x0" } });
  double largest = 0., difference = 0.;
  for (unsigned int i = 0; i < one.size(); ++i)
  {
    largest    = std::max(largest, one[i].norm());
    difference = std::max(difference, (one[i] - two[i]).norm());
  }
  EXPECT_GT(largest, 0.3e-9);
  EXPECT_LT(difference, 1e-9 * largest);
}
