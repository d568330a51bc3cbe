// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/operators/archive.h>
#include <quoin/implicit/dof_map.h>
#include <quoin/motions/prescribed_motion.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr auto velocity        = LoadQuantity::velocity;
  constexpr auto as_displacement = LoadQuantity::displacement;
  constexpr auto given_force     = LoadQuantity::force;
  constexpr double degree        = 3.14159265358979323846 / 180.;

  using Values = BodyValues<2>;

  /** Two blocks: a platen, which drives the lower one, and a rigid block. */
  struct Bodies
  {
    BlockMesh<2> mesh = make_stack(3, 1);
    std::unique_ptr<TestNodes> nodes;
    std::unique_ptr<Model<2>> model;
    std::unique_ptr<Platen> beam;
    std::unique_ptr<DofMap<2>> dof_map;
    State<2> state;

    Bodies(const LoadComponent &x, const LoadComponent &y,
           const LoadComponent &rotation)
    {
      ModelParameters parameters    = two_blocks();
      parameters.materials[1].rigid = true;
      nodes = std::make_unique<TestNodes>(mesh, parameters.materials);
      model = std::make_unique<Model<2>>(*nodes, parameters);
      state = model->initial_state();
      beam  = std::make_unique<Platen>(platen("beam", "lower", x, y, rotation),
                                      *nodes);
      beam->prepare(state);
      state.add<ImplicitState>();
      state.add<LoadPatternState>();
      beam->set_mass(model->mass());
      beam->begin_stage(state, false);
      dof_map = std::make_unique<DofMap<2>>(
          *model, std::vector<MotionConstraint<2> *>{ beam.get() },
          std::vector<bool>{ false }, state);
    }

    DofVector vector() const
    {
      return DofVector(dof_map->owned(), MPI_COMM_SELF);
    }

    /** One value for each degree of freedom of a body that is not given. */
    DofVector vector(const Values &values) const
    {
      auto result = vector();
      for (unsigned int b = 0; b < values.size(); ++b)
        for (unsigned int d = 0; d < 3; ++d)
          if (!dof_map->bodies()[b].given[d])
            result(dof_map->bodies()[b].first + d) = values[b][d];
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    /** Expects the block's nodes to have gone rigidly about @p centre. */
    void expect_rigid(const Configuration<2> &configuration,
                      const unsigned int block,
                      const std::array<double, 2> &centre,
                      const std::array<double, 3> &motion) const
    {
      const double c = std::cos(motion[2]), s = std::sin(motion[2]);
      for (unsigned int v = mesh.block_first_vertex[block];
           v < mesh.block_first_vertex[block + 1]; ++v)
      {
        const double x                = mesh.vertices[v][0] - centre[0];
        const double y                = mesh.vertices[v][1] - centre[1];
        const dealii::Tensor<1, 2> &u = configuration.nodes[v].u;
        EXPECT_NEAR(u[0], motion[0] + c * x - s * y - x, 1e-14);
        EXPECT_NEAR(u[1], motion[1] + s * x + c * y - y, 1e-14);
      }
    }
  };

  LoadComponent driven(const LoadQuantity quantity, const std::string &text)
  {
    return component(quantity, text);
  }
} // namespace

TEST(DofMap, GivenChangeOfADisplacementIsThatOfItsValues)
{
  const auto kinked = driven(as_displacement, "if(t < 0.5, 2*t, 1) + 3*T");
  EXPECT_NEAR(given_change<2>(kinked, 0.2, 0.4, 7.), 0.4 + 0.6, 1e-13);
  EXPECT_NEAR(given_change<2>(kinked, 0.4, 0.9, 7.), 0.2 + 1.5, 1e-13);
  EXPECT_NEAR(given_change<2>(kinked, 0.9, 0.4, 7.), -1.7, 1e-13);
  EXPECT_EQ(given_change<2>(kinked, 0.3, 0.3, 7.), 0.);
}

TEST(DofMap, GivenChangeOfAVelocityIsItsIntegral)
{
  // A ramp, as platens of walls begin to move; one step goes past it.
  const auto ramp = driven(velocity, "0.02 * min(1, t / 0.001)");
  EXPECT_NEAR(given_change<2>(ramp, 0., 0.01, 0.), 0.02 * 0.0095, 1e-10);
  EXPECT_NEAR(given_change<2>(ramp, 0., 5e-4, 0.), 0.02 * 0.125e-3, 1e-16);
  EXPECT_NEAR(given_change<2>(ramp, 0.01, 0., 0.), -0.02 * 0.0095, 1e-10);
  EXPECT_NEAR(given_change<2>(ramp, 0.1, 0.1001, 0.), 2e-6, 1e-18);

  // A jump within the step costs 2^-15 of it at most.
  const auto jump = driven(velocity, "if(t < 0.37, 0, 1)");
  EXPECT_NEAR(given_change<2>(jump, 0., 1., 0.), 0.63, 1e-5);
  const auto run_time = driven(velocity, "T");
  EXPECT_NEAR(given_change<2>(run_time, 1., 2., 10.), 11.5, 1e-12);

  // There and back: what a cyclic test needs.
  const auto wave = driven(velocity, "cos(2*pi*t)");
  EXPECT_NEAR(given_change<2>(wave, 0., 0.25, 0.), 0.5 / 3.141592653589793,
              1e-12);
  EXPECT_NEAR(given_change<2>(wave, 0., 1., 0.), 0., 1e-12);

  EXPECT_EQ(given_change<2>(driven(given_force, "5"), 0., 1., 0.), 0.);
}

TEST(DofMap, BodiesFollowThroughLargeRotations)
{
  Bodies run({}, {}, {});
  ASSERT_EQ(run.dof_map->bodies().size(), 2U);
  Configuration<2> configuration
      = configuration_of(run.dof_map->bodies(), run.state);
  Values total(2, { { 0., 0., 0. } });
  const Values steps[] = { { { 0.2, -0.4, 1.9 }, { -0.3, 0.1, -2.6 } },
                           { { 0.1, 0.3, 2.2 }, { 0.6, 0.2, -4.9 } } };
  for (const Values &step : steps)
  {
    run.dof_map->move(run.vector(step), 0.5, 0., configuration);
    for (unsigned int b = 0; b < 2; ++b)
      for (unsigned int d = 0; d < 3; ++d)
        total[b][d] += 0.5 * step[b][d];
    run.expect_rigid(configuration, 0, { { 1.5, 0.5 } }, total[0]);
    run.expect_rigid(configuration, 1, { { 1.5, 1.5 } }, total[1]);
  }
  // And the state has it all, also from where another step goes on.
  write_configuration(run.dof_map->bodies(), configuration, run.state);
  for (unsigned int d = 0; d < 3; ++d)
  {
    EXPECT_EQ(run.state.get<PlatenState>("beam").displacement[d],
              configuration.bodies[0][d]);
    EXPECT_EQ(configuration_of(run.dof_map->bodies(), run.state).bodies,
              configuration.bodies);
  }
  EXPECT_EQ(run.state.get<RigidBlockStates>()[0].rotation,
            configuration.bodies[1][2]);
}

TEST(DofMap, ProjectionIsTheTransposeOfTheMotion)
{
  // Virtual work: of forces on nodes that move, of their sums on unknowns.
  Bodies run({}, {}, {});
  Configuration<2> configuration
      = configuration_of(run.dof_map->bodies(), run.state);
  run.dof_map->move(run.vector({ { 0.2, -0.4, 1.9 }, { -0.3, 0.1, -2.6 } }), 1.,
                    0., configuration);
  run.dof_map->update_constraints(configuration, 0.);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  AlignedArray<dealii::Tensor<1, 2>> force(run.mesh.n_vertices());
  for (dealii::Tensor<1, 2> &f : force)
    f = dealii::Point<2>(uniform(random), uniform(random));
  const Values others{ { 0.3, -0.8, 0.5 }, { -0.2, 0.4, 0.7 } };
  auto sums = run.vector();
  run.dof_map->add_forces(force, sums);
  add_body_forces(run.dof_map->bodies(), others, sums);
  for (unsigned int mode = 0; mode < 6; ++mode)
  {
    Values virtual_motion(2, { { 0., 0., 0. } });
    virtual_motion[mode / 3][mode % 3] = 1.;
    const auto direction               = run.vector(virtual_motion);
    const double h                     = 1e-6;
    double work                        = others[mode / 3][mode % 3];
    for (const double share : { h, -h })
    {
      Configuration<2> moved = configuration;
      run.dof_map->move(direction, share, 0., moved);
      for (unsigned int v = 0; v < force.size(); ++v)
        for (unsigned int d = 0; d < 2; ++d)
          work += force[v][d] * moved.nodes[v].u[d] / (2. * share);
    }
    EXPECT_NEAR(sums * direction, work, 1e-8) << mode;
  }
}

TEST(DofMap, PlatensMayBeDrivenInPart)
{
  // Pushed to the right by 0.1 m/s, turned by 30 degrees a second, loaded.
  Bodies run(driven(velocity, "0.1"), driven(given_force, "-4e3*t"),
             driven(as_displacement, "30*t"));
  const RigidBody<2> &beam = run.dof_map->bodies()[0];
  EXPECT_EQ(beam.given, (std::array<bool, 3>{ { true, false, true } }));
  EXPECT_EQ(body_loads(run.dof_map->bodies(), { 2., 2. })[0],
            (std::array<double, 3>{ { 0., -8e3, 0. } }));
  EXPECT_EQ(body_loads(run.dof_map->bodies(), { 2., 2. })[1],
            (std::array<double, 3>{ { 0., 0., 0. } }));

  Configuration<2> configuration
      = configuration_of(run.dof_map->bodies(), run.state);
  const auto increment = run.vector({ { 9., 0.25, 9. }, { 0., 0., 0. } });
  run.dof_map->move(increment, 1., 3., configuration);
  EXPECT_EQ(configuration.load_time, 3.);
  run.expect_rigid(configuration, 0, { { 1.5, 0.5 } },
                   { { 0.3, 0.25, 90. * degree } });
  run.expect_rigid(configuration, 1, { { 1.5, 1.5 } }, { { 0., 0., 0. } });

  // What is given on the way to a time near is that of the nodes' motion.
  const double dt = 1e-6;
  run.dof_map->update_constraints(configuration, 3. + dt);
  Configuration<2> later = configuration;
  run.dof_map->move(run.vector(), 0., 3. + dt, later);
  for (unsigned int v = 0; v < run.mesh.n_vertices(); ++v)
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_NEAR(
          run.dof_map->constraints().get_inhomogeneity(run.dof_map->dof(v, d)),
          later.nodes[v].u[d] - configuration.nodes[v].u[d], 1e-5 * dt);

  // Only what is not given has a right-hand side.
  AlignedArray<dealii::Tensor<1, 2>> force(run.mesh.n_vertices(),
                                           dealii::Point<2>(1., 1.));
  auto sums = run.vector();
  run.dof_map->add_forces(force, sums);
  add_body_forces(run.dof_map->bodies(), Values(2, { { 1., 1., 1. } }), sums);
  EXPECT_EQ(sums(beam.first), 0.);
  EXPECT_EQ(sums(beam.first + 1), 1. + double(beam.nodes.size()));
  EXPECT_EQ(sums(beam.first + 2), 0.);
}

TEST(DofMap, TheLastMotionOfANodePrevails)
{
  BlockMesh<2> mesh = make_stack(2, 1);
  const TestNodes nodes(mesh);
  const Model<2> model(nodes, two_blocks());
  State<2> state = model.initial_state();
  state.add<ImplicitState>();
  state.add<LoadPatternState>();
  PrescribedMotion<2> bottom(motion("bottom", "bottom", "1", "2"), nodes);
  PrescribedMotion<2> sides(motion("sides", "sides", "3", ""), nodes);
  const DofMap<2> dof_map(model, { &bottom, &sides }, {}, state);
  EXPECT_EQ(dof_map.prescribed().size(), 3U + 1U + 8U);
  Configuration<2> configuration = configuration_of(dof_map.bodies(), state);
  DofVector ones(dof_map.owned(), MPI_COMM_SELF);
  ones = 1.;
  dof_map.move(ones, 10., 0.5, configuration);
  const auto expect_at
      = [&](const double x, const double y, const double ux, const double uy)
  {
    for (const unsigned int v : vertices_at(mesh, x, y))
    {
      EXPECT_NEAR(configuration.nodes[v].u[0], ux, 1e-14);
      EXPECT_NEAR(configuration.nodes[v].u[1], uy, 1e-14);
    }
  };
  expect_at(0., 0., 1.5, 1.); // the corner follows the sides in x
  expect_at(1., 0., 0.5, 1.);
  expect_at(0., 1., 1.5, 10.);
  expect_at(1., 1., 10., 10.);
}
