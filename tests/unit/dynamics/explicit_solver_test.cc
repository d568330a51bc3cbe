// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/motions/platen.h>
#include <quoin/base/exceptions.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/dynamics/largest_force.h>
#include <quoin/dynamics/state_checks.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr auto velocity     = LoadQuantity::velocity;
  constexpr auto displacement = LoadQuantity::displacement;
  constexpr auto given_force  = LoadQuantity::force;
  constexpr double degree     = 3.14159265358979323846 / 180.;

  /** Of the upper block of two_blocks() with the stack (nx, ny). */
  double mass_of_block(const unsigned int nx, const unsigned int ny)
  {
    return 2500. * 0.5 * nx * ny;
  }

} // namespace

TEST(ExplicitSolver, EnergyBalanceOfAnElasticModel)
{
  // Strains of 1e-14, for which the rotating frames are linear to rounding.
  TestRun run(
      make_stack(2, 2), two_blocks(),
      { motion("base", "bottom", "0", "0"),
        traction("pull", "top", "1e-4 * sin(500*t)", "2e-4 * cos(700*t)"),
        gravity("0", "-1e-8") });
  run.begin(stage_with({ "base", "pull", "gravity" }));
  EXPECT_LT(run.residual_of_steps(1000), 1e-12);
  EXPECT_GT(run.solver.energies().kinetic, 0.);
  EXPECT_GT(run.solver.energies().strain, 0.);
  EXPECT_GT(run.solver.energies().joint, 0.);
}

// Just below the critical step of the assembled stiffness, which is longer than
// that of the bound, energies stay; just above it they grow without end. Cells
// that may yield, and deform, keep the bound.
TEST(ExplicitSolver, TakesTheStepOfTheAssembledStiffness)
{
  BlockMesh<2> mesh              = make_stack(6, 4);
  const auto critical_and_growth = [&](const bool assembled, const double share)
  {
    TestRun run(mesh, two_blocks(),
                { motion("base", "bottom", "0", "0"),
                  traction("pull", "top", "1e-4 * sin(500*t)", "2e-4") });
    if (assembled)
      run.solver.take_assembled_step();
    run.begin(stage_with({ "base", "pull" }), share);
    const auto kinetic_after = [&](const unsigned int n)
    {
      double largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        run.solver.step(run.state, { true, false });
        largest = std::max(largest, run.solver.energies().kinetic);
      }
      return largest;
    };
    const double early = kinetic_after(1000), late = kinetic_after(1000);
    return std::array<double, 2>{ run.solver.critical_step().length,
                                  late / early };
  };
  const auto [bound, calm]   = critical_and_growth(false, 0.99);
  const auto [step, calmly]  = critical_and_growth(true, 0.995);
  const auto [same, growth]  = critical_and_growth(true, 1.03);
  ModelParameters soft       = two_blocks();
  soft.materials[1].strength = MohrCoulombStrength{ 1e5, 0., 0. };
  TestRun yielding(mesh, soft, {});
  yielding.solver.take_assembled_step();
  yielding.begin(stage_with({}));
  EXPECT_EQ(yielding.solver.critical_step().length, bound);
  ModelParameters damped = two_blocks();
  for (JointSetParameters &set : damped.joints)
    set.damping.normal = 1e-9;
  TestRun dashpots(mesh, damped, {});
  dashpots.solver.take_assembled_step();
  dashpots.begin(stage_with({}));
  EXPECT_LT(dashpots.solver.critical_step().length, 1.01 * bound);
  StageParameters heavy  = stage_with({});
  heavy.scaled_time_step = 1.001 * bound;
  TestRun scaled(mesh, two_blocks(), {});
  scaled.solver.take_assembled_step();
  scaled.begin(heavy);
  EXPECT_LT(scaled.solver.critical_step().length, 1.01 * bound);
  EXPECT_GT(step, 1.03 * bound);
  EXPECT_EQ(step, same);
  EXPECT_LT(calm, 10.);
  EXPECT_LT(calmly, 10.);
  EXPECT_GT(growth, 1e6);
}

TEST(ExplicitSolver, KineticEnergySlowsTheLoadsDown)
{
  TestRun run(make_stack(2, 2), two_blocks(),
              { motion("base", "bottom", "0", "0"),
                motion("pull", "top", "", "20"),
                traction("push", "sides", "1e3 * t", "") });
  StageParameters stage
      = stage_with({ "base", "pull", "push" }, DampingType::local);
  stage.duration      = 1e-3;
  stage.kinetic_limit = 1e-3;
  run.begin(stage, 0.4);
  EXPECT_LT(run.state.load_rate, 0.1);
  double largest = 0., fastest = 0., balance = 0.;
  while (run.state.load_time < stage.duration)
  {
    ASSERT_LT(run.state.stage_step, 1000000U);
    const bool due
        = run.state.stage_step % ExplicitSolver<2>::balance_interval == 0;
    run.solver.step(run.state, { false, due });
    const Energies &energies = run.solver.energies();
    if (!due)
      continue;
    balance = std::max(balance,
                       std::abs(energies.residual()) / energies.throughput());
    if (run.state.stage_step < 1000)
      continue;
    largest = std::max(largest, energies.kinetic / energies.throughput());
    fastest = std::max(fastest, run.state.load_rate);
  }
  EXPECT_LT(largest, stage.kinetic_limit);
  EXPECT_LT(fastest, 0.5);
  EXPECT_LT(balance, 1e-6);
  EXPECT_GT(run.state.time, run.state.load_time);
  // What velocity prescribes is the displacement over load time.
  for (const unsigned int node : run.nodes_at_height(4.))
    EXPECT_NEAR(run.state.nodes[node].u[1], 20. * run.state.load_time, 1e-12);
}

TEST(ExplicitSolver, TotalTimeGoesOnAfterLoadsWereSlowedDown)
{
  // A gravity of T goes on where it was, however long the stage before took.
  TestRun run(make_stack(1, 1), two_blocks(), { gravity("0", "-1e3*T") });
  StageParameters slow = stage_with({ "gravity" });
  slow.kinetic_limit   = 1e-3;
  run.begin(slow, 0.5);
  run.step(300, true);
  const double reached = run.state.load_time;
  ASSERT_LT(reached, 0.1 * run.state.time);

  StageParameters next = stage_with({ "gravity" });
  run.begin(next, 0.5, &slow);
  EXPECT_NEAR(run.state.load_start(), reached, 1e-12 * run.state.time);
  const double before = run.state.velocity[0][1];
  run.step(1);
  EXPECT_NEAR(run.state.velocity[0][1] - before, -1e3 * reached * run.dt(),
              1e-9 * std::abs(before) + 1e-6 * 1e3 * reached * run.dt());
  run.step(100);
  // T advances as the time does.
  run.begin(next, 0.5, &next);
  EXPECT_NEAR(run.state.load_start(), reached + 101. * run.dt(),
              1e-12 * run.state.time);
}

TEST(ExplicitSolver, EnergyBalanceWhenTheTimeStepChanges)
{
  TestRun run(make_stack(2, 2), two_blocks(),
              { motion("base", "bottom", "0", "0"),
                traction("pull", "top", "1e-4 * sin(500*T)", "2e-4") });
  const StageParameters stage     = stage_with({ "base", "pull" });
  const StageParameters *previous = nullptr;
  for (const double share : { 0.9, 0.1, 0.7, 0.3 })
  {
    run.begin(stage, share, previous);
    previous = &stage;
    for (unsigned int i = 0; i < 50; ++i)
    {
      run.solver.step(run.state, { true, false });
      const Energies &energies = run.solver.energies();
      EXPECT_LE(std::abs(energies.residual()), 1e-12 * energies.throughput());
    }
  }
}

namespace
{
  /** Kinetic energy after 1000 critical steps by that after the first, of a
      block that is 20 m high on a plate of the thickness @p height [m], whose
      material is @p plate and which @p load holds. */
  double growth_on_a_held_plate(const LoadParameters &load, const double height,
                                const MaterialParameters &plate,
                                const double stiffness)
  {
    MeshData<2> data;
    add_grid(data, 1, 20, "upper", 0., 1.);
    add_grid(data, 1, 1, "lower", 0., 0.); // rigid blocks are last
    for (auto &vertex : data.vertices)
      vertex[1] = vertex[1] == 0. ? 0. : vertex[1] - 1. + height;
    add_curve(data, "bottom", 0., 0., 1., 0.);
    add_curve(data, "joint", 0., height, 1., height);
    BlockMesh<2> mesh            = split_into_blocks(data, {});
    ModelParameters parameters   = two_blocks(stiffness, stiffness);
    parameters.joints[0].damping = { 1., 1. };
    parameters.materials         = { plate, material("upper") };
    TestRun run(mesh, parameters, { load });
    run.throw_at_random(1e-9);
    run.begin(stage_with({ load.name }), 1.);
    run.solver.step(run.state, { true, false });
    const double start = run.solver.energies().kinetic;
    run.step(1000);
    run.solver.step(run.state, { true, false });
    return run.solver.energies().kinetic / start;
  }
} // namespace

// The dashpots are those of the mass of the block, on the nodes of a plate that
// is lighter by up to 2e4.
TEST(ExplicitSolver, DashpotsOnAHeldPlateBelowAHeavyBlockAreStable)
{
  const LoadParameters base = motion("base", "bottom", "0", "0");
  for (const double height : { 0.001, 0.01, 0.1 })
    for (const double stiffness : { 1e8, 1e9, 1e10 })
      EXPECT_LT(
          growth_on_a_held_plate(base, height, material("lower"), stiffness),
          1.)
          << height << ' ' << stiffness;
}

// They are those of both masses where a force pushes the plate.
TEST(ExplicitSolver, DashpotsOnALightPlatenThatAForceMovesAreStable)
{
  MaterialParameters plate = material("lower", 25.);
  plate.rigid              = true;
  const LoadParameters base
      = platen("base", "lower", component(velocity, "0"),
               component(given_force, "0"), component(velocity, "0"));
  for (const double stiffness : { 1e8, 1e9, 1e10 })
    EXPECT_LT(growth_on_a_held_plate(base, 0.02, plate, stiffness), 1.)
        << stiffness;
}

TEST(ExplicitSolver, EnergyIsWhatTheFormulasSay)
{
  // The upper block pulled off by rigid platens: only the joint stores.
  BlockMesh<2> mesh  = make_stack(2, 1);
  const double speed = 1e-3, kn = 2e10;
  TestRun run(
      mesh, two_blocks(kn),
      { platen("held", "lower", component(velocity, "0"),
               component(velocity, "0"), component(velocity, "0")),
        platen("lift", "upper", component(velocity, "0"),
               component(velocity, "1e-3"), component(velocity, "0")) });
  run.begin(stage_with({ "held", "lift" }));
  run.step(50);
  run.solver.step(run.state, { true, false });
  const double time     = 50. * run.dt();
  const double opening  = speed * time;
  const Energies &after = run.solver.energies();
  EXPECT_NEAR(after.kinetic, 0.5 * mass_of_block(2, 1) * speed * speed,
              1e-9 * after.kinetic);
  EXPECT_NEAR(after.joint, 0.5 * kn * opening * opening, 1e-9 * after.joint);
  EXPECT_NEAR(after.strain, 0., 1e-9 * after.joint);
  EXPECT_NEAR(after.external, after.kinetic + after.joint, 1e-9 * after.joint);
  EXPECT_NEAR(run.solver.resultant("lift")[1], kn * opening,
              1e-9 * kn * opening);
  EXPECT_NEAR(run.solver.resultant("held")[1], -kn * opening,
              1e-9 * kn * opening);
}

TEST(ExplicitSolver, AccountsBalanceWithAnyDamping)
{
  // Driven at the base, thrown, loaded on top; strains as small as above.
  BlockMesh<2> mesh = make_stack(2, 2);
  for (const DampingType damping :
       { DampingType::none, DampingType::local, DampingType::adaptive,
         DampingType::rayleigh })
  {
    TestRun run(mesh, two_blocks(),
                { motion("base", "bottom", "1e-11*sin(300*t)", ""),
                  traction("pull", "top", "1e-4*cos(500*t)", "1e-4") });
    StageParameters stage = stage_with({ "base", "pull" }, damping);
    if (damping == DampingType::rayleigh)
    {
      stage.mass_coefficient      = 30.;
      stage.stiffness_coefficient = 1e-5;
    }
    run.begin(stage);
    run.throw_at_random(1e-11);
    EXPECT_LT(run.residual_of_steps(1000), 2e-12) << static_cast<int>(damping);
    const double taken = run.solver.energies().damping;
    EXPECT_EQ(taken > 0., damping != DampingType::none);
  }
}

TEST(ExplicitSolver, AccountsBalanceWithPlatens)
{
  // Positions of a platen's nodes are rounded to 1e-16 m, so the strains are
  // larger here: 1e-7, and so is what is left of the rotating frames.
  BlockMesh<2> mesh = make_stack(2, 2);
  for (const DampingType damping :
       { DampingType::none, DampingType::local, DampingType::rayleigh })
  {
    TestRun run(mesh, two_blocks(),
                { motion("base", "bottom", "0", "0"),
                  platen("beam", "upper", component(given_force, "1e3"),
                         component(displacement, "1e-6*sin(900*t)"),
                         component(given_force, "2e3*sin(400*t)")) });
    StageParameters stage = stage_with({ "base", "beam" }, damping);
    if (damping == DampingType::rayleigh)
    {
      stage.mass_coefficient      = 30.;
      stage.stiffness_coefficient = 1e-5;
    }
    run.begin(stage);
    EXPECT_LT(run.residual_of_steps(1000), 1e-6) << static_cast<int>(damping);
  }
}

TEST(ExplicitSolver, AccountsBalanceWhereBoundariesMeet)
{
  // Corner nodes belong to two loads; their work must be booked once.
  BlockMesh<2> mesh = make_stack(2, 2);
  const std::vector<std::pair<LoadParameters, LoadParameters>> pairs
      = { { motion("a", "bottom", "1e-11", ""), motion("b", "sides", "", "0") },
          { motion("a", "bottom", "1e-11", "0"),
            motion("b", "sides", "1e-11", "") },
          { viscous("a", "bottom"), motion("b", "sides", "0", "") },
          { viscous("a", "bottom"), motion("b", "sides", "1e-11", "") },
          { viscous("a", "bottom"), viscous("b", "sides") } };
  for (unsigned int i = 0; i < pairs.size(); ++i)
  {
    TestRun run(mesh, two_blocks(), { pairs[i].first, pairs[i].second });
    run.begin(stage_with({ "a", "b" }));
    run.throw_at_random(1e-11);
    EXPECT_LT(run.residual_of_steps(300), 1e-11) << "pair " << i;
  }
}

TEST(ExplicitSolver, PrescribedVelocity)
{
  TestRun run(make_stack(2, 1), two_blocks(),
              { motion("base", "bottom", "0.02", "-0.01*t"),
                motion("pull", "top", "", "0.03") });
  run.begin(stage_with({ "base", "pull" }));
  run.step(200);
  const double time = 200. * run.dt();
  EXPECT_NEAR(run.state.time, time, 1e-15);
  for (const unsigned int v : run.nodes_at_height(0.))
  {
    EXPECT_NEAR(run.state.nodes[v].u[0], 0.02 * time, 1e-14 * time);
    // The midpoint rule is exact for a velocity linear in time.
    EXPECT_NEAR(run.state.nodes[v].u[1], -0.005 * time * time, 1e-14 * time);
    EXPECT_EQ(run.state.velocity[v][0], 0.02);
  }
  double moved = 0.;
  for (const unsigned int v : run.nodes_at_height(2.))
  {
    EXPECT_NEAR(run.state.nodes[v].u[1], 0.03 * time, 1e-14 * time);
    moved += std::abs(run.state.nodes[v].u[0]);
  }
  EXPECT_GT(moved, 0.);
}

TEST(ExplicitSolver, PrescribedDisplacementCountsFromTheStage)
{
  auto base = load("base", LoadType::prescribed_motion, "bottom", displacement,
                   "1e-3*t", "2e-4*sin(100*t)");
  TestRun run(make_stack(1, 1), two_blocks(), { base });
  const StageParameters stage = stage_with({ "base" });
  run.begin(stage);
  run.step(40);
  const double t = 40. * run.dt();
  for (const unsigned int v : run.nodes_at_height(0.))
  {
    EXPECT_NEAR(run.state.nodes[v].u[0], 1e-3 * t, 1e-17);
    EXPECT_NEAR(run.state.nodes[v].u[1], 2e-4 * std::sin(100. * t), 1e-17);
  }
  run.begin(stage, 0.8, &stage);
  run.step(30);
  const double u = 30. * run.dt();
  for (const unsigned int v : run.nodes_at_height(0.))
  {
    EXPECT_NEAR(run.state.nodes[v].u[0], 1e-3 * (t + u), 1e-17);
    EXPECT_NEAR(run.state.nodes[v].u[1],
                2e-4 * (std::sin(100. * t) + std::sin(100. * u)), 1e-17);
  }
}

TEST(ExplicitSolver, ReactionInTheStaticLimit)
{
  // Two blocks and a joint in a row: u / F = 2 L / (E A) + 1 / (kn A).
  const double u = 1e-9, L = 2., A = 2. * 0.5, E = 1e10, kn = 2e10, nu = 0.2;
  TestRun run(make_stack(2, 2), two_blocks(kn),
              { motion("base", "bottom", "", "0"),
                load("pull", LoadType::prescribed_motion, "top", displacement,
                     "", "1e-9 * min(1, 1e3 * t)") });
  run.begin(stage_with({ "base", "pull" }, DampingType::local));
  for (unsigned int i = 0; i < 20; ++i)
    run.step(500, i == 19);
  const double stiffness = A / (2. * L / E + 1. / kn);
  EXPECT_NEAR(run.solver.resultant("pull")[1], stiffness * u,
              1e-7 * stiffness * u);
  EXPECT_NEAR(run.solver.resultant("base")[1], -stiffness * u,
              1e-7 * stiffness * u);
  // In the middle of the stack, one metre from the origin.
  EXPECT_NEAR(run.solver.resultant("pull")[2], stiffness * u,
              1e-6 * stiffness * u);
  EXPECT_LT(run.state.unbalanced_ratio, 1e-8);
  const auto stress
      = cell_stress(run.model.blocks(), run.state.nodes.data(), {}, 3);
  EXPECT_NEAR(stress[1], stiffness * u / A, 1e-6 * stiffness * u);
  EXPECT_NEAR(stress[0], 0., 1e-6 * stiffness * u);
  const double strain = stiffness * u / A / E;
  EXPECT_NEAR(run.state.nodes[run.node(2., 4.)].u[0]
                  - run.state.nodes[run.node(0., 4.)].u[0],
              -nu * strain * 2., 1e-5 * strain);
}

TEST(ExplicitSolver, UnbalancedRatioOfTheFirstStep)
{
  // Nothing resists yet: all that is applied is unbalanced.
  TestRun run(make_stack(1, 1), two_blocks(), { gravity("0", "-10") });
  run.begin(stage_with({ "gravity" }));
  run.step(1, true);
  EXPECT_DOUBLE_EQ(run.state.unbalanced_ratio, 1.);
}

TEST(ExplicitSolver, PlatenUnderAForce)
{
  BlockMesh<2> mesh  = make_stack(2, 2);
  const double force = 7e3, acceleration = force / mass_of_block(2, 2);
  TestRun run(mesh, two_blocks(),
              { platen("beam", "upper", component(given_force, "7e3"), {},
                       component(velocity, "0")) });
  run.begin(stage_with({ "beam" }));
  run.step(1);
  const PlatenState &beam = run.state.get<PlatenState>("beam");
  // From rest at time zero the first half step gives the velocity.
  const double v = acceleration * 0.5 * run.dt();
  EXPECT_NEAR(beam.velocity[0], v, 1e-14 * v);
  EXPECT_EQ(beam.velocity[1], 0.);
  EXPECT_EQ(beam.velocity[2], 0.);
  EXPECT_NEAR(beam.centre[0], 1., 1e-14);
  EXPECT_NEAR(beam.centre[1], 3., 1e-14);
  for (unsigned int n = 0; n < mesh.n_vertices(); ++n)
  {
    const double share = mesh.block_of_vertex(n) == 1 ? 1. : 0.;
    EXPECT_NEAR(run.state.velocity[n][0], share * v, 1e-14 * v);
    EXPECT_NEAR(run.state.nodes[n].u[0], share * v * run.dt(), 1e-15);
  }
  EXPECT_DOUBLE_EQ(run.solver.resultant("beam")[0], force);
}

TEST(ExplicitSolver, PlatenUnderAMoment)
{
  BlockMesh<2> mesh = make_stack(3, 1);
  TestRun run(
      mesh, two_blocks(),
      { platen("beam", "upper", {}, {}, component(given_force, "5e3")) });
  run.begin(stage_with({ "beam" }));
  double inertia = 0., mass = 0., centre[2]{};
  const auto &m = run.model.mass();
  for (unsigned int n = 0; n < mesh.n_vertices(); ++n)
    if (mesh.block_of_vertex(n) == 1)
    {
      const auto &p = mesh.vertices[n];
      mass += m[n];
      inertia += m[n] * p.norm_square();
      centre[0] += m[n] * p[0];
      centre[1] += m[n] * p[1];
    }
  inertia -= (centre[0] * centre[0] + centre[1] * centre[1]) / mass;

  run.step(1);
  const double omega = 5e3 / inertia * 0.5 * run.dt();
  EXPECT_NEAR(run.state.get<PlatenState>("beam").velocity[2], omega,
              1e-12 * omega);
  const unsigned int corner = run.node(3., 2.);
  EXPECT_NEAR(run.state.velocity[corner][0], -omega * (2. - centre[1] / mass),
              1e-6 * omega);
  EXPECT_NEAR(run.state.velocity[corner][1], omega * (3. - centre[0] / mass),
              1e-6 * omega);
}

TEST(ExplicitSolver, PlatenTurnsItsBlockAsARigidBody)
{
  BlockMesh<2> mesh          = make_stack(2, 1);
  ModelParameters parameters = two_blocks(1., 1.);
  TestRun run(
      mesh, parameters,
      { platen("beam", "upper", component(velocity, "0.1"),
               component(velocity, "0"), component(displacement, "30*t")) });
  run.begin(stage_with({ "beam" }));
  const double dt = 1e-4;
  run.solver.set_time_step(dt);
  run.step(5000);
  const double angle = 30. * degree * 0.5;
  EXPECT_NEAR(run.state.get<PlatenState>("beam").displacement[2], angle, 1e-12);
  for (const double x : { 0., 1., 2. })
  {
    const auto &node = run.state.nodes[run.node(x, 2.)];
    EXPECT_NEAR(node.X[0] + node.u[0],
                1.05 + std::cos(angle) * (x - 1.) - std::sin(angle) * 0.5,
                1e-12);
    EXPECT_NEAR(node.X[1] + node.u[1],
                1.5 + std::sin(angle) * (x - 1.) + std::cos(angle) * 0.5,
                1e-12);
  }
}

TEST(ExplicitSolver, PlatenKeepsItsDisplacementThroughStages)
{
  const std::vector<LoadParameters> loads
      = { platen("beam", "upper", component(velocity, "0.1"),
                 component(displacement, "1e-3*t"), component(velocity, "0")) };
  TestRun run(make_stack(1, 1), two_blocks(), loads);
  const StageParameters with = stage_with({ "beam" }), without = stage_with({});
  run.begin(with);
  const double dt = run.dt();
  run.step(20);
  EXPECT_NEAR(run.state.get<PlatenState>("beam").displacement[0], 2. * dt,
              1e-13 * dt);
  EXPECT_NEAR(run.state.get<PlatenState>("beam").displacement[1], 0.02 * dt,
              1e-13 * dt);

  run.begin(with, 0.8, &with);
  run.step(10);
  EXPECT_NEAR(run.state.get<PlatenState>("beam").displacement[0], 3. * dt,
              1e-13 * dt);
  EXPECT_NEAR(run.state.get<PlatenState>("beam").displacement[1], 0.03 * dt,
              1e-13 * dt);
  const auto &node = run.state.nodes[run.node(1., 2.)];
  EXPECT_NEAR(node.u[0], 3. * dt, 1e-13);

  // Having let go it begins anew.
  run.begin(without, 0.8, &with);
  EXPECT_FALSE(run.state.get<PlatenState>("beam").active);
  run.step(10);
  run.begin(with, 0.8, &without);
  EXPECT_TRUE(run.state.get<PlatenState>("beam").active);
  EXPECT_EQ(run.state.get<PlatenState>("beam").displacement[0], 0.);
  run.step(5);
  EXPECT_NEAR(run.state.get<PlatenState>("beam").displacement[0], 0.5 * dt,
              1e-13 * dt);
}

TEST(ExplicitSolver, FreeFall)
{
  // At rest at time zero: g t^2 / 2 at every step, without strain.
  TestRun run(make_stack(2, 1), two_blocks(), { gravity("1.5", "-9.81") });
  run.begin(stage_with({ "gravity" }));
  const unsigned int n = 1000;
  for (unsigned int i = 0; i < n; ++i)
    run.solver.step(run.state, { true, false });
  const double fallen = std::pow(n * run.dt(), 2) / 2.;
  for (const NodeRecord<2> &node : run.state.nodes)
  {
    EXPECT_NEAR(node.u[0], 1.5 * fallen, 1e-12 * fallen);
    EXPECT_NEAR(node.u[1], -9.81 * fallen, 1e-11 * fallen);
  }
  const Energies &energies = run.solver.energies();
  const double mass        = 2. * mass_of_block(2, 1);
  // 1/2 m v- v+ from the velocities half a step before and after.
  const double before = (n - 1) * run.dt(), half = 0.5 * run.dt();
  EXPECT_NEAR(energies.kinetic,
              0.5 * mass * (1.5 * 1.5 + 9.81 * 9.81) * (before - half)
                  * (before + half),
              1e-11 * energies.kinetic);
  EXPECT_LT(std::abs(energies.residual()), 1e-11 * energies.kinetic);
}

TEST(ExplicitSolver, TractionActsOnTributaryAreas)
{
  BlockMesh<2> mesh = make_stack(3, 1);
  TestRun run(mesh, two_blocks(),
              { traction("push", "top", "2e3*(t + 1)", "-5e3"),
                traction("side", "sides", "7e3", "") });
  run.begin(stage_with({ "push", "side" }));
  run.step(1);
  for (unsigned int n = 0; n < mesh.n_vertices(); ++n)
  {
    const auto &p      = mesh.vertices[n];
    const bool at_side = p[0] == 0. || p[0] == 3.;
    const double top   = p[1] == 2. ? 0.5 * (at_side ? 0.5 : 1.) : 0.;
    const double side  = at_side ? 0.5 * 0.5 : 0.;
    const double rate  = 0.5 * run.dt() / run.model.mass()[n];
    EXPECT_NEAR(run.state.velocity[n][0], (2e3 * top + 7e3 * side) * rate,
                1e-12 * 7e3 * rate);
    EXPECT_NEAR(run.state.velocity[n][1], -5e3 * top * rate,
                1e-12 * 7e3 * rate);
  }
}

TEST(ExplicitSolver, ChangeOfTimeStepKeepsTheParabola)
{
  // With steps of different length the velocity lives at the midpoints.
  TestRun run(make_stack(1, 1), two_blocks(), { gravity("0", "-10") });
  const StageParameters stage = stage_with({ "gravity" });
  run.begin(stage);
  run.step(1);
  const double h = run.dt(), g = -10.;
  run.begin(stage, 0.4, &stage);
  EXPECT_DOUBLE_EQ(run.dt(), 0.5 * h);
  run.step(2);
  const double u = 0.5 * g * 4. * h * h;
  for (const NodeRecord<2> &node : run.state.nodes)
    EXPECT_NEAR(node.u[1], u, 1e-13 * std::abs(u));
  EXPECT_NEAR(run.state.time, 2. * h, 1e-15);
  EXPECT_NEAR(run.state.stage_start, h, 1e-15);
  EXPECT_EQ(run.state.stage_step, 2U);
}

TEST(ExplicitSolver, GravityOfStaticStagesComesQuietly)
{
  // Without damping a stack settles twice as far as at rest under a weight
  // that is there at once, and hardly farther under one that grows.
  for (const bool sudden : { false, true })
  {
    BlockMesh<2> mesh     = make_stack(1, 8);
    LoadParameters weight = gravity("0", "-10");
    if (sudden)
      weight.ramp_duration = 0.;
    TestRun run(mesh, two_blocks(),
                { weight, motion("base", "bottom", "0", "0"),
                  motion("rollers", "sides", "0", "") });
    StageParameters stage = stage_with({ "gravity", "base", "rollers" });
    stage.end             = StageEnd::static_ratio;
    run.begin(stage);
    const double quiet = run.solver.quiet_time();
    double lowest = 0., sum = 0.;
    unsigned int n = 0;
    while (run.state.time < 5. * quiet)
    {
      run.step(1);
      double top = 0.;
      for (const NodeRecord<2> &node : run.state.nodes)
        top = std::min(top, node.u[1]);
      lowest = std::min(lowest, top);
      if (run.state.time > quiet)
      {
        sum += top;
        ++n;
      }
    }
    const double overshoot = lowest / (sum / n) - 1.;
    if (sudden)
      EXPECT_GT(overshoot, 0.8);
    else
      EXPECT_LT(overshoot, 0.05);
  }
}

TEST(ExplicitSolver, ViscousBoundaryAbsorbs)
{
  // A column thrown down on its viscous base: the wave up and down again takes
  // 2 H / c, then all of 1/2 m v^2 has gone through the base.
  BlockMesh<2> mesh          = make_stack(1, 30);
  ModelParameters parameters = two_blocks(1e14, 1e14);
  parameters.plane           = PlaneAssumption::plane_strain;
  TestRun run(
      mesh, parameters,
      { viscous("base", "bottom"), motion("rollers", "sides", "0", "") });
  run.begin(stage_with({ "base", "rollers" }));
  const double v = -1e-9;
  for (dealii::Tensor<1, 2> &node : run.state.velocity)
    node[1] = v;
  const double M       = 1e10 * 0.8 / (1.2 * 0.6);
  const double c       = std::sqrt(M / 2500.);
  const double initial = 0.5 * 2. * mass_of_block(1, 30) * v * v;

  double last = initial, first_residual = 0.;
  const unsigned int steps
      = static_cast<unsigned int>(2. * 60. / c / run.dt() * 1.4);
  for (unsigned int i = 0; i < steps; ++i)
  {
    run.solver.step(run.state, { true, false });
    const Energies &energies = run.solver.energies();
    if (i == 0)
      first_residual = energies.residual();
    const double now = energies.kinetic + energies.strain + energies.joint;
    EXPECT_LT(now, last * (1. + 1e-6) + 1e-6 * initial);
    EXPECT_NEAR(energies.residual(), first_residual, 1e-11 * initial);
    last = now;
    if (i == steps / 3)
    {
      // Until the free surface answers, waves of v / 2 run through the base.
      EXPECT_NEAR(now, initial - 2500. * c * 0.25 * v * v * 0.5 * i * run.dt(),
                  0.02 * initial);
    }
  }
  EXPECT_NEAR(first_residual, initial, 0.01 * initial);
  EXPECT_LT(last, 0.01 * initial);
  EXPECT_NEAR(run.solver.energies().viscous, initial, 0.02 * initial);
}

TEST(ExplicitSolver, ViscousBoundaryInAnyDirection)
{
  // The same model turned by 30 degrees moves in the same way, turned.
  const double c = std::cos(30. * degree), s = std::sin(30. * degree);
  BlockMesh<2> flat, turned;
  flat   = make_stack(2, 2);
  turned = make_stack(2, 2);
  for (auto &p : turned.vertices)
    p = { c * p[0] - s * p[1], s * p[0] + c * p[1] };
  auto base = load("base", LoadType::viscous_boundary, "bottom", velocity,
                   "3e-9", "-5e-9");
  TestRun a(flat, two_blocks(), { base }), b(turned, two_blocks(), { base });
  a.throw_at_random(1e-9);
  for (unsigned int n = 0; n < flat.n_vertices(); ++n)
  {
    const dealii::Tensor<1, 2> &v = a.state.velocity[n];
    b.state.velocity[n]
        = dealii::Point<2>(c * v[0] - s * v[1], s * v[0] + c * v[1]);
  }
  for (TestRun *run : { &a, &b })
  {
    run->begin(stage_with({ "base" }));
    run->solver.set_time_step(1e-4);
    run->step(50);
  }
  for (unsigned int n = 0; n < flat.n_vertices(); ++n)
  {
    const dealii::Tensor<1, 2> &v = a.state.velocity[n],
                               &w = b.state.velocity[n];
    EXPECT_NEAR(w[0], c * v[0] - s * v[1], 1e-14);
    EXPECT_NEAR(w[1], s * v[0] + c * v[1], 1e-14);
  }
  const auto force = a.solver.resultant("base");
  EXPECT_NEAR(b.solver.resultant("base")[0], c * force[0] - s * force[1],
              1e-6 * std::abs(force[0]));
}

TEST(ExplicitSolver, RowsOfTheUnbalancedRatioLeaveTheStageAlone)
{
  const BlockMesh<2> mesh = make_stack(2, 2);
  TestRun run(mesh, two_blocks(1e11, 1e11),
              { gravity("0", "-10"), motion("base", "bottom", "0", "0") });
  StageParameters settle = stage_with({ "gravity", "base" });
  settle.kinetic_limit   = 1e-3;
  run.begin(settle, 0.5);
  run.solver.step(run.state, { true, false });
  run.solver.step(run.state, { true, false });
  const double growth = run.state.load_rate_growth;
  run.solver.step(run.state, { true, false, true });
  EXPECT_GT(run.state.unbalanced_ratio, 0.);
  EXPECT_NE(run.state.unbalanced_ratio, 1.);
  EXPECT_EQ(run.state.get<LargestForce>().applied, 0.);
  EXPECT_EQ(run.state.load_rate_growth, growth);
  run.solver.step(run.state, { true, true });
  EXPECT_GT(run.state.get<LargestForce>().applied, 0.);
  EXPECT_NE(run.state.load_rate_growth, growth);
}

// What it replaces is held; a load that begins with it is not.
TEST(ExplicitSolver, ViscousBoundaryTakesOverReactions)
{
  for (const bool pushed : { false, true })
  {
    BlockMesh<2> mesh                = make_stack(2, 2);
    const ModelParameters parameters = two_blocks(1e11, 1e11);
    TestRun run(mesh, parameters,
                { gravity("0", "-10"), motion("base", "bottom", "0", "0"),
                  viscous("quiet", "bottom"),
                  traction("push", "bottom", "0", "1e3") });
    const StageParameters settle
        = stage_with({ "gravity", "base" }, DampingType::local);
    run.begin(settle, 0.5);
    run.step(20000);
    std::vector<std::string> loads = { "gravity", "quiet" };
    if (pushed)
      loads.push_back("push");
    run.begin(stage_with(loads), 0.5, &settle);
    run.step(1);
    const double first = run.state.velocity[run.node(1., 0.)][1];
    run.step(200);
    double fastest = 0.;
    for (const dealii::Tensor<1, 2> &v : run.state.velocity)
      fastest = std::max(fastest, std::abs(v[1]));
    // Of half the traction: the other half goes into the dashpots.
    const double speed = 1e3 / (2. * 2500. * std::sqrt(1e10 / 2500.));
    if (pushed)
      EXPECT_GT(first, 0.1 * speed);
    else
      EXPECT_LT(fastest, 1e-9 * speed);
  }
}

TEST(ExplicitSolver, IncidentWaveDoublesAtTheFreeSurface)
{
  // A steady incident shear velocity v: the column ends up moving at 2 v.
  auto base = load("base", LoadType::viscous_boundary, "bottom", velocity, "0",
                   "1e-9");
  TestRun run(make_stack(1, 20), two_blocks(1e14, 1e14),
              { base, motion("rollers", "sides", "", "0") });
  run.begin(stage_with({ "base", "rollers" }));
  const double c = std::sqrt(1e10 / 2.4 / 2500.);
  run.step(static_cast<unsigned int>(40. / c / run.dt() * 4.));
  // Along the boundary with the block on its left: to the right.
  for (const double y : { 0., 40. })
    for (const unsigned int n : run.nodes_at_height(y))
      EXPECT_NEAR(run.state.velocity[n][0], 2e-9, 0.05e-9);
  run.solver.step(run.state, { true, false });
  // (The column began to move at once, from -dt/2 on, at the base alone.)
  EXPECT_LT(std::abs(run.solver.energies().residual()),
            1e-11 * run.solver.energies().throughput());
}

TEST(ExplicitSolver, LoadsThatComeLateAreStillToChange)
{
  BlockMesh<2> mesh  = make_stack(3, 2);
  const auto changes = [&](const std::string &function, const double load_time)
  {
    TestRun run(mesh, two_blocks(),
                { motion("base", "bottom", "0", "0"),
                  traction("push", "top", "", function) });
    run.begin(stage_with({ "base", "push" }));
    run.state.load_time = load_time;
    return run.solver.stage_loads().change(run.state, 1, 1e-3);
  };
  EXPECT_FALSE(changes("-1e3", 0.));
  EXPECT_TRUE(changes("-1e3 * min(1, t / 0.1)", 0.05));
  EXPECT_FALSE(changes("-1e3 * min(1, t / 0.1)", 0.2));
  // A plateau before the last step.
  const std::string steps = "if(t < 1, -1e3, if(t < 2, -2e3, -3e3))";
  EXPECT_TRUE(changes(steps, 0.5));
  EXPECT_TRUE(changes(steps, 1.5));
  EXPECT_FALSE(changes(steps, 2.5));
  EXPECT_TRUE(changes("if(t < 1e5, 0, -1e3)", 0.5));
}

TEST(ExplicitSolver, SlipByTheEdgesThatTouch)
{
  // Edges are 1 m; slip counts where the joint bears pressure.
  BlockMesh<2> mesh = make_stack(3, 2);
  TestRun run(mesh, two_blocks(), {});
  run.begin(stage_with({}));
  EXPECT_EQ(largest_slip_share(run.model, run.state), 0.);
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.block_of_vertex(v) == 1)
      run.state.nodes[v].u[0] = -0.7;
  EXPECT_EQ(largest_slip_share(run.model, run.state), 0.);
  run.state.get<JointHistory>().normal_traction[1] = -1.;
  EXPECT_NEAR(largest_slip_share(run.model, run.state), 0.7, 1e-12);
}

TEST(ExplicitSolver, TurnAndDistanceOfBlocksThatShareAJoint)
{
  // The upper block turns about its lower left corner, by displacements that
  // are linear in the angle, and everything is displaced.
  BlockMesh<2> mesh = make_stack(3, 2);
  TestRun run(mesh, two_blocks(), {});
  run.begin(stage_with({}));
  constexpr double turn = 0.3, opening = 0.01;
  double low = 1e9, left = 1e9, right = -1e9;
  for (const NodeRecord<2> &node : run.state.nodes)
  {
    left  = std::min(left, node.X[0]);
    right = std::max(right, node.X[0]);
  }
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.block_of_vertex(v) == 1)
      low = std::min(low, run.state.nodes[v].X[1]);
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
  {
    NodeRecord<2> &node = run.state.nodes[v];
    node.u[0] = node.u[1] = 5.;
    if (mesh.block_of_vertex(v) == 0)
      continue;
    node.u[0] -= turn * (node.X[1] - low);
    node.u[1] += turn * (node.X[0] - left) + opening;
  }
  const JointMotion motion = joint_motion(run.model, run.state);
  EXPECT_NEAR(motion.turn, turn, 1e-12);
  EXPECT_NEAR(motion.distance, turn * (right - left) + opening, 1e-12);
  EXPECT_EQ(motion.slip, 0.);
}

TEST(ExplicitSolver, RefusesFreeBodiesInAStaticStage)
{
  TestRun run(make_stack(1, 1), two_blocks(),
              { motion("roller", "bottom", "", "0"),
                motion("fixed", "bottom", "0", "0"),
                platen("held", "upper", component(velocity, "0"),
                       component(velocity, "0"), component(velocity, "0")),
                platen("hung", "upper", {}, component(velocity, "0"), {}),
                viscous("quiet", "bottom") });
  const auto begin = [&](const std::vector<std::string> &loads)
  {
    StageParameters stage = stage_with(loads, DampingType::local);
    stage.name            = "settle";
    stage.end             = StageEnd::static_ratio;
    run.begin(stage);
  };
  for (const auto &loads : std::vector<std::vector<std::string>>{
           {}, { "roller" }, { "quiet" }, { "hung" } })
    expect_input_error([&] { begin(loads); }, { "'Stages/settle'", "block 0",
                                                "(0, 0)", "static ratio" });
  EXPECT_NO_THROW(begin({ "fixed" }));
  EXPECT_NO_THROW(begin({ "held" }));
  // A stage that ends by time may have them.
  EXPECT_NO_THROW(run.begin(stage_with({})));
}

TEST(ExplicitSolver, NamesTheBlockThatNothingHolds)
{
  MeshData<2> data;
  for (const double x : { 0., 5. })
  {
    add_grid(data, 1, 1, "rock", x, 0.);
    add_curve(data, x == 0. ? "bottom" : "edge", x, 0., x + 1., 0.);
  }
  BlockMesh<2> mesh = split_into_blocks(data, {});
  ASSERT_EQ(mesh.n_blocks(), 2U);
  ModelParameters parameters;
  parameters.materials = { material("rock") };
  TestRun run(mesh, parameters,
              { motion("base", "bottom", "0", "0"),
                motion("edge", "edge", "0", "0"),
                platen("both", "rock", {}, {}, {}) });
  StageParameters stage = stage_with({ "base" });
  stage.end             = StageEnd::static_ratio;
  expect_input_error([&] { run.begin(stage); }, { "block 1", "(5, 0)" });
  stage.loads = { "base", "edge" };
  EXPECT_NO_THROW(run.begin(stage));
  // A platen makes one body of its blocks.
  stage.loads = { "base", "both" };
  EXPECT_NO_THROW(run.begin(stage));
}

TEST(ExplicitSolver, RefusesUnknownLoads)
{
  BlockMesh<2> mesh = make_stack(1, 1);
  TestRun run(mesh, two_blocks(), { gravity("0", "0") });
  expect_input_error(
      [&] {
        run.begin(stage_with({ "gravity", "wind" }));
      },
      { "'Stages/stage'", "'wind'", "gravity" });
  expect_input_error([&] { run.solver.resultant("gravity"); },
                     { "'gravity'", "no reaction" });
  expect_input_error(
      [&]
      { TestRun(mesh, two_blocks(), { motion("base", "botom", "0", "0") }); },
      { "'Loads/base'", "botom", "bottom" });
  expect_input_error(
      [&]
      { TestRun(mesh, two_blocks(), { motion("base", "joint", "0", "0") }); },
      { "'Loads/base'", "joint", "outer boundary" });
}

TEST(ExplicitSolver, StopsWhereTheMotionIsNoNumber)
{
  BlockMesh<2> mesh = make_stack(1, 1);
  const auto stop = [&](const std::string &pull, const std::string &before_time)
  {
    TestRun run(mesh, two_blocks(), { traction("push", "top", "0", pull) });
    run.begin(stage_with({ "push" }));
    std::string message;
    try
    {
      run.step(1000, true);
    }
    catch (const RunError &error)
    {
      message = error.what();
    }
    const auto found = message.find(before_time);
    EXPECT_NE(found, std::string::npos) << message;
    if (found != std::string::npos)
    {
      const double time = std::stod(message.substr(found + before_time.size()));
      EXPECT_GT(time, 1e-3);
      EXPECT_LT(time, 1e-3 + 1.01 * run.dt());
    }
    return message;
  };
  EXPECT_NE(stop("if(T > 1e-3, 1e200, 0)", "at time ").find("block 1 at ("),
            std::string::npos);
  EXPECT_NE(stop("sqrt(1e-3 - T)", "at the time ").find("the load 'push'"),
            std::string::npos);
}

TEST(ExplicitSolver, MassScalingRaisesTheCriticalStep)
{
  // All four corners of a square of two triangles have the same bound, so all
  // masses grow with the square of the step.
  MeshData<2> data  = grid(1, 1, "rock");
  BlockMesh<2> mesh = split_into_blocks(data, {});
  ModelParameters parameters;
  parameters.materials = { material("rock") };
  TestRun run(mesh, parameters, { gravity("0", "-10") });
  StageParameters stage = stage_with({ "gravity" });
  run.begin(stage);
  const double own = run.solver.critical_step().length;
  EXPECT_EQ(run.solver.critical_step().added.share, 0.);

  stage.scaled_time_step = 3. * own;
  run.begin(stage);
  EXPECT_NEAR(run.solver.critical_step().length, 3. * own, 1e-12 * own);
  EXPECT_NEAR(run.solver.critical_step().added.share, 8., 1e-12);
  const AddedMass &added = run.solver.critical_step().added;
  EXPECT_NEAR(added.factor, 9., 1e-12);
  EXPECT_EQ(added.n_slow, 1u);
  EXPECT_EQ(added.slow_share, 1.);
  EXPECT_EQ(added.bodies, 1.);
  EXPECT_NEAR(added.frequency * dealii::numbers::PI * 3. * own, 1., 1e-12);
  EXPECT_NE(added.warning(1.).find("changes histories"), std::string::npos);

  // Gravity pulls on the true mass only: the fall is nine times slower.
  run.step(1);
  EXPECT_NEAR(run.state.velocity[0][1], -10. / 9. * 0.5 * run.dt(), 1e-14);

  // A step that is stable anyway takes no mass away.
  stage.scaled_time_step = 0.5 * own;
  run.begin(stage);
  EXPECT_EQ(run.solver.critical_step().length, own);
  EXPECT_EQ(run.solver.critical_step().added.share, 0.);
}

TEST(ExplicitSolver, MassScalingBehindAStiffJoint)
{
  // Only nodes that need mass get it.
  TestRun run(make_stack(2, 3), two_blocks(1e13, 1e13), {});
  StageParameters stage = stage_with({});
  run.begin(stage);
  const double own       = run.solver.critical_step().length;
  stage.scaled_time_step = 1.5 * own;
  run.begin(stage);
  EXPECT_NEAR(run.solver.critical_step().length, 1.5 * own, 1e-12 * own);
  const double joint_share = 2. * 2. * 0.5 * (1. / 2.) / (12. * 0.5);
  EXPECT_GT(run.solver.critical_step().added.share, 0.);
  EXPECT_LT(run.solver.critical_step().added.share, 1.25 * joint_share);
  AddedMass added = run.solver.critical_step().added;
  EXPECT_LT(added.bodies, 1.);
  added.share      = 0.;
  added.slow_share = 0.02;
  EXPECT_NE(added.warning(1.).find("move too slowly"), std::string::npos);
  added.slow_share = 0.;
  EXPECT_EQ(added.warning(0.24 * added.frequency), "");
  EXPECT_NE(added.warning(0.26 * added.frequency).find("lowers frequencies"),
            std::string::npos);

  run.begin(stage, 0.99);
  run.throw_at_random(1e-6);
  run.step(2000);
  for (const dealii::Tensor<1, 2> &v : run.state.velocity)
    EXPECT_LT(std::abs(v[0]) + std::abs(v[1]), 1e-4);
}

TEST(ExplicitSolver, StiffnessDampingLowersTheCriticalStep)
{
  TestRun run(make_stack(1, 1), two_blocks(), {});
  StageParameters stage = stage_with({}, DampingType::rayleigh);
  run.begin(stage);
  const double undamped       = run.solver.critical_step().length;
  stage.stiffness_coefficient = undamped;
  run.begin(stage);
  // xi = beta omega / 2 = 1.
  EXPECT_NEAR(run.solver.critical_step().length,
              undamped * (std::sqrt(2.) - 1.), 1e-12 * undamped);
}

TEST(ExplicitSolver, ResumedStageGoesOnAsIfNothingHadHappened)
{
  BlockMesh<2> mesh = make_stack(2, 1);
  const std::vector<LoadParameters> loads
      = { motion("base", "bottom", "0", "1e-3*sin(200*t)"),
          platen("beam", "upper", component(given_force, "1e3"),
                 component(displacement, "1e-4*t"), {}) };
  StageParameters stage = stage_with({ "base", "beam" }, DampingType::adaptive);
  TestRun whole(mesh, two_blocks(), loads);
  whole.begin(stage);
  whole.step(300);
  TestRun rest(mesh, two_blocks(), loads);
  rest.state = whole.state;
  rest.solver.resume_stage(stage, nullptr, rest.state);
  rest.solver.set_time_step(whole.dt());
  whole.step(200);
  rest.step(200);
  EXPECT_EQ(rest.state.time, whole.state.time);
  EXPECT_EQ(rest.state.adaptive_damping, whole.state.adaptive_damping);
  for (unsigned int n = 0; n < mesh.n_vertices(); ++n)
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_EQ(rest.state.nodes[n].u[d], whole.state.nodes[n].u[d]);
      EXPECT_EQ(rest.state.velocity[n][d], whole.state.velocity[n][d]);
    }
}
