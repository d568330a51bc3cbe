// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../model/test_models.h"

#include <quoin/motions/platen.h>
#include <quoin/base/exceptions.h>
#include <quoin/blocks/rigid_blocks.h>
#include <quoin/dynamics/highest_frequency.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/model/model_stability.h>
#include <quoin/water/joint_flow.h>

#include <cstring>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr auto velocity    = LoadQuantity::velocity;
  constexpr auto given_force = LoadQuantity::force;
  constexpr double pi        = 3.14159265358979323846;

  MaterialParameters rigid(const std::string &group,
                           const double density = 2500.)
  {
    MaterialParameters result = material(group, density);
    result.rigid              = true;
    result.elastic            = LinearElastic{ density, 0., 0. };
    return result;
  }

  void order(BlockMesh<2> &mesh, const ModelParameters &parameters)
  {
    renumber_blocks(
        mesh, order_rigid_last(find_rigid_blocks(mesh, parameters.materials)));
  }

  /** A rectangle of nx x ny unit squares, "block", by itself. */
  BlockMesh<2> make_rectangle(const unsigned int nx, const unsigned int ny,
                              const double x = 0.)
  {
    MeshData<2> data = grid(nx, ny, "block", x, 0.);
    return split_into_blocks(data, {});
  }

  ModelParameters one_rigid_block(const double density = 2000.)
  {
    ModelParameters result;
    result.thickness = 0.5;
    result.materials = { rigid("block", density) };
    return result;
  }

  /** Three blocks of nx x 1, "lower", "middle", "upper", with a bed "joint". */
  BlockMesh<2> make_three(const unsigned int nx)
  {
    MeshData<2> data;
    const char *names[] = { "lower", "middle", "upper" };
    for (const unsigned int i : { 0U, 1U, 2U })
    {
      add_grid(data, nx, 1, names[i], 0., i);
      add_curve(data, i == 0 ? "bottom" : "joint", 0., i, nx, i);
      if (i == 2)
        add_curve(data, "top", 0., 3., nx, 3.);
    }
    return split_into_blocks(data, {});
  }

  ModelParameters three_blocks(const double kn, const double ks)
  {
    ModelParameters result;
    result.thickness = 0.5;
    result.materials
        = { rigid("lower"), rigid("middle", 2000.), rigid("upper") };
    result.joints = { elastic_joint(kn, ks) };
    return result;
  }

  LoadParameters hold(const std::string &name, const std::string &group)
  {
    return platen(name, group, component(velocity, "0"),
                  component(velocity, "0"), component(velocity, "0"));
  }

  unsigned int rigid_block(const TestRun &run, const std::string &group)
  {
    const BlockTable<2> &table = run.model.nodes().table();
    for (unsigned int b = 0; b < run.model.rigid_blocks().n_blocks(); ++b)
    {
      const unsigned int v = run.model.rigid_blocks().block(b).begin;
      if (table.group_names[table.group[run.nodes->block_of_node(v)]] == group)
        return b;
    }
    ADD_FAILURE() << group;
    return 0;
  }

  double distance(const State<2> &state, const unsigned int i,
                  const unsigned int j)
  {
    const NodeRecord<2> &a = state.nodes[i], &b = state.nodes[j];
    return std::hypot(a.X[0] + a.u[0] - b.X[0] - b.u[0],
                      a.X[1] + a.u[1] - b.X[1] - b.u[1]);
  }

  /** Force and moment on each rigid block at displacements of all of them. */
  std::vector<double> forces(const Model<2> &model,
                             const std::vector<double> &q)
  {
    State<2> state           = model.initial_state();
    const RigidBlocks &rigid = model.rigid_blocks();
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      for (unsigned int i = rigid.block(b).begin; i < rigid.block(b).end; ++i)
      {
        const double x      = state.nodes[i].X[0] - rigid.block(b).centre[0];
        const double y      = state.nodes[i].X[1] - rigid.block(b).centre[1];
        state.nodes[i].u[0] = q[3 * b] - q[3 * b + 2] * y;
        state.nodes[i].u[1] = q[3 * b + 1] + q[3 * b + 2] * x;
      }
    AlignedArray<dealii::Tensor<1, 2>> force(state.nodes.size(),
                                             dealii::Tensor<1, 2>());
    EnergyAccounts energy;
    model.joints().add_forces(state.nodes.data(), state.get<JointHistory>(),
                              energy, force.data());
    std::vector<double> result(q.size(), 0.);
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      for (unsigned int i = rigid.block(b).begin; i < rigid.block(b).end; ++i)
      {
        const dealii::Tensor<1, 2> &f = force[i];
        result[3 * b] += f[0];
        result[3 * b + 1] += f[1];
        result[3 * b + 2]
            += (state.nodes[i].X[0] - rigid.block(b).centre[0]) * f[1]
               - (state.nodes[i].X[1] - rigid.block(b).centre[1]) * f[0];
      }
    return result;
  }

  /** Largest omega^2 of a model of rigid blocks, by power iteration. */
  double exact_eigenvalue(const Model<2> &model)
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    const unsigned int n     = 3 * rigid.n_blocks();
    const auto mass          = [&](const unsigned int i) {
      return i % 3 == 2 ? rigid.block(i / 3).inertia : rigid.block(i / 3).mass;
    };
    std::vector<std::vector<double>> K(n);
    const double h = 1e-7;
    for (unsigned int j = 0; j < n; ++j)
    {
      std::vector<double> q(n, 0.);
      q[j]             = h;
      const auto plus  = forces(model, q);
      q[j]             = -h;
      const auto minus = forces(model, q);
      for (unsigned int i = 0; i < n; ++i)
        K[j].push_back((minus[i] - plus[i]) / (2. * h));
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    std::vector<double> x(n), y(n);
    for (double &value : x)
      value = uniform(random);
    double eigenvalue = 0.;
    for (unsigned int iteration = 0; iteration < 5000; ++iteration)
    {
      double norm = 0., before = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        y[i] = 0.;
        for (unsigned int j = 0; j < n; ++j)
          y[i] += K[j][i] * x[j];
        y[i] /= mass(i);
        norm += mass(i) * y[i] * y[i];
        before += mass(i) * x[i] * x[i];
      }
      eigenvalue = std::sqrt(norm / before);
      for (unsigned int i = 0; i < n; ++i)
        x[i] = y[i] / std::sqrt(norm);
    }
    return eigenvalue;
  }
} // namespace

TEST(RigidBlocks, MassAndInertiaOfARectangle)
{
  // Far from the origin, whatever the mesh.
  for (const unsigned int n : { 1U, 3U })
  {
    MeshData<2> data  = grid(2 * n, n, "block", 1e5, -1e5, 1.5 / n);
    BlockMesh<2> mesh = split_into_blocks(data, {});
    const TestNodes nodes(mesh, one_rigid_block().materials);
    const Model<2> model(nodes, one_rigid_block());
    ASSERT_EQ(model.rigid_blocks().n_blocks(), 1U);
    const RigidBlocks::Block &block = model.rigid_blocks().block(0);
    const double mass               = 2000. * 0.5 * 3. * 1.5;
    EXPECT_NEAR(block.mass, mass, 1e-8 * mass);
    EXPECT_NEAR(block.centre[0], 1e5 + 1.5, 1e-9);
    EXPECT_NEAR(block.centre[1], -1e5 + 0.75, 1e-9);
    EXPECT_NEAR(block.inertia, mass * (9. + 2.25) / 12., 1e-8 * mass);
    EXPECT_GT(block.lumped_inertia, 1.05 * block.inertia);
    EXPECT_EQ(model.nodes().n_deformable_nodes(), 0U);
    EXPECT_EQ(model.nodes().cells().n_deformable, 0U);
    EXPECT_EQ(model.blocks().n_tiles(), 0U);
  }
}

TEST(RigidBlocks, MassAndInertiaOfAnAngle)
{
  // A square of 2 m without the upper right square of 1 m.
  MeshData<2> data = grid(2, 2, "block");
  data.cells.resize(6);
  data.cell_group.resize(6);
  data.vertices.pop_back();
  BlockMesh<2> mesh = split_into_blocks(data, {});
  const TestNodes nodes(mesh, one_rigid_block().materials);
  const Model<2> model(nodes, one_rigid_block());
  const RigidBlocks::Block &block = model.rigid_blocks().block(0);
  const double square             = 2000. * 0.5;
  EXPECT_DOUBLE_EQ(block.mass, 3. * square);
  EXPECT_NEAR(block.centre[0], 5. / 6., 1e-14);
  EXPECT_NEAR(block.centre[1], 5. / 6., 1e-14);
  // The whole square about the angle's centroid less the part cut out.
  const double whole = 4. * square * (8. / 12. + 2. / 36.);
  const double part  = square * (2. / 12. + 2. * 4. / 9.);
  EXPECT_NEAR(block.inertia, whole - part, 1e-12 * whole);
}

TEST(RigidBlocks, ThrownAndSpunFreely)
{
  TestRun run(make_rectangle(2, 1), one_rigid_block(), {});
  run.solver.begin_stage(stage_with({}), nullptr, run.state);
  EXPECT_FALSE(std::isfinite(run.solver.critical_step().length));
  const double dt = 1e-3;
  run.solver.set_time_step(dt);
  RigidBlockState &block = run.state.get<RigidBlockStates>()[0];
  const double start[3]  = { 3., 4., 5. };
  std::copy(start, start + 3, block.velocity);

  const State<2> rest  = run.state;
  const unsigned int n = 10000;
  run.step(n - 1);
  run.solver.step(run.state, { true, true });
  // Energy, momentum and angular momentum are those of the start, bitwise.
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_EQ(block.velocity[d], start[d]);
  const RigidBlocks::Block &own = run.model.rigid_blocks().block(0);
  EXPECT_DOUBLE_EQ(run.solver.energies().kinetic,
                   0.5 * own.mass * 25. + 0.5 * own.inertia * 25.);
  EXPECT_NEAR(block.displacement[0], 30., 1e-10);
  EXPECT_NEAR(block.displacement[1], 40., 1e-10);
  EXPECT_NEAR(block.rotation, 50., 1e-10);
  for (unsigned int i = 0; i < run.state.nodes.size(); ++i)
    for (unsigned int j = 0; j < i; ++j)
      EXPECT_NEAR(distance(run.state, i, j), distance(rest, i, j), 2e-14);
  const NodeRecord<2> &node = run.state.nodes[0];
  const double x = node.X[0] - own.centre[0], y = node.X[1] - own.centre[1];
  EXPECT_NEAR(node.X[0] + node.u[0],
              own.centre[0] + 30. + std::cos(50.) * x - std::sin(50.) * y,
              1e-10);
  EXPECT_NEAR(node.X[1] + node.u[1],
              own.centre[1] + 40. + std::sin(50.) * x + std::cos(50.) * y,
              1e-10);
  EXPECT_EQ(run.state.unbalanced_ratio, 0.);
}

TEST(RigidBlocks, FallOfASpinningBlock)
{
  TestRun run(make_rectangle(3, 1), one_rigid_block(),
              { gravity("1", "-9.81") });
  run.solver.begin_stage(stage_with({ "gravity" }), nullptr, run.state);
  run.solver.set_time_step(1e-3);
  run.state.get<RigidBlockStates>()[0].velocity[2] = 7.;
  EXPECT_LT(run.residual_of_steps(2000), 1e-12);
  const RigidBlockState &block = run.state.get<RigidBlockStates>()[0];
  EXPECT_NEAR(block.displacement[0], 2., 1e-10);
  EXPECT_NEAR(block.displacement[1], -9.81 * 2., 1e-10);
  EXPECT_NEAR(block.velocity[2], 7., 1e-12); // weight has no moment
}

TEST(RigidBlocks, BouncesAndRocksOnElasticJoints)
{
  const double kn = 3e9, ks = 1e9, thickness = 0.5;
  BlockMesh<2> mesh                = make_three(2);
  const ModelParameters parameters = three_blocks(kn, ks);
  const std::vector<LoadParameters> loads
      = { hold("below", "lower"), hold("above", "upper") };
  const double mass = 2000. * thickness * 2., inertia = mass * (4. + 1.) / 12.;
  // Either bed: points at -1, 0, 1 m with 1/2, 1, 1/2 m of length, at a
  // height of 1/2 m from the centroid.
  const double stiffness[3]
      = { 2. * ks * thickness * 2., 2. * kn * thickness * 2.,
          2. * thickness * (kn * 1. + ks * 2. * 0.25) };
  for (const unsigned int d : { 0U, 1U, 2U })
  {
    const double omega = std::sqrt(stiffness[d] / (d < 2 ? mass : inertia));
    double error[2];
    for (const unsigned int k : { 0U, 1U })
    {
      TestRun run(mesh, parameters, loads);
      run.begin(stage_with({ "below", "above" }));
      const unsigned int n = 100 * (1 + k);
      const double time    = 2.5 / omega;
      run.solver.set_time_step(time / n);
      RigidBlockState &block
          = run.state.get<RigidBlockStates>()[rigid_block(run, "middle")];
      const double speed = 1e-9 * omega;
      block.velocity[d]  = speed;
      run.step(n);
      const double value = d < 2 ? block.displacement[d] : block.rotation;
      // Closed form of the scheme, then of the oscillator.
      const double phase = 2. * std::asin(0.5 * omega * run.dt());
      EXPECT_NEAR(value,
                  speed * run.dt() * std::sin(n * phase) / std::sin(phase),
                  1e-6 * 1e-9);
      error[k] = value - speed / omega * std::sin(omega * time);
      EXPECT_NEAR(error[k], 0., 1e-3 * 1e-9);
    }
    EXPECT_NEAR(error[0] / error[1], 4., 0.05);
  }
}

TEST(RigidBlocks, AccountsBalanceWithAnyDamping)
{
  // Rigid and deformable blocks; motions so small that joints are linear.
  BlockMesh<2> mesh          = make_three(2);
  ModelParameters parameters = three_blocks(2e10, 1e10);
  parameters.materials = { material("lower"), rigid("middle"), rigid("upper") };
  order(mesh, parameters);
  for (const DampingType damping :
       { DampingType::none, DampingType::local, DampingType::adaptive,
         DampingType::rayleigh })
  {
    TestRun run(mesh, parameters,
                { motion("base", "bottom", "1e-11*sin(300*t)", "0"),
                  traction("pull", "top", "1e-4*cos(500*t)", "1e-4") });
    StageParameters stage = stage_with({ "base", "pull" }, damping);
    if (damping == DampingType::rayleigh)
    {
      stage.mass_coefficient      = 30.;
      stage.stiffness_coefficient = 1e-5;
    }
    const StageParameters *previous = nullptr;
    for (const double share : { 0.8, 0.3 })
    {
      run.begin(stage, share, previous);
      if (!previous)
        for (RigidBlockState &block : run.state.get<RigidBlockStates>())
          for (unsigned int d = 0; d < 3; ++d)
            block.velocity[d] = (1. + d) * 1e-11;
      previous = &stage;
      EXPECT_LT(run.residual_of_steps(1000), 2e-12)
          << static_cast<int>(damping);
    }
    const double taken = run.solver.energies().damping;
    EXPECT_EQ(taken > 0., damping != DampingType::none);
    EXPECT_GT(run.solver.energies().joint, 0.);
  }
}

TEST(RigidBlocks, AccountsBalanceOfALoadedPlaten)
{
  // Larger motions, because those of a platen are rounded to 1e-16 m; what is
  // left is proportional to them: the forces of joints that turn are not
  // linear, so that the trapezoidal rule is off by the third order of a step.
  BlockMesh<2> mesh = make_three(2);
  for (const DampingType damping : { DampingType::none, DampingType::local })
  {
    TestRun run(
        mesh, three_blocks(2e10, 1e10),
        { hold("below", "lower"),
          platen("press", "upper", component(velocity, "1e-5*sin(700*t)"),
                 component(given_force, "-100*cos(400*t)"),
                 component(given_force, "100")) });
    run.begin(stage_with({ "below", "press" }, damping));
    EXPECT_LT(run.residual_of_steps(1000), 3e-6);
    EXPECT_GT(run.solver.energies().external, 0.);
  }
}

TEST(RigidBlocks, ResidualOfALargeRotationIsSmall)
{
  // Two blocks on soft joints, spun: the rest is what the turning frames of
  // the joints leave, and falls with the square of the step.
  BlockMesh<2> mesh = make_three(2);
  double residual[2];
  for (const unsigned int k : { 0U, 1U })
  {
    TestRun run(mesh, three_blocks(1e8, 1e8), {});
    run.begin(stage_with({}), 0.2 / (1 + k));
    const Model<2> &model = run.model;
    for (const char *group : { "lower", "middle", "upper" })
    {
      const unsigned int b   = rigid_block(run, group);
      const auto &own        = model.rigid_blocks().block(b);
      RigidBlockState &block = run.state.get<RigidBlockStates>()[b];
      block.velocity[0]      = -2. * (own.centre[1] - 1.5);
      block.velocity[1]      = 2. * (own.centre[0] - 1.);
      block.velocity[2]      = 2.;
    }
    residual[k] = run.residual_of_steps(std::lround(1. / run.dt()));
    EXPECT_LT(residual[k], 1e-5);
  }
  EXPECT_NEAR(residual[0] / residual[1], 4., 0.2);
}

TEST(RigidBlocks, PlatenHasTheirInertia)
{
  TestRun run(
      make_rectangle(3, 1), one_rigid_block(),
      { platen("turn", "block", component(velocity, "0"),
               component(given_force, "100"), component(given_force, "50")) });
  run.solver.begin_stage(stage_with({ "turn" }), nullptr, run.state);
  run.solver.set_time_step(1e-3);
  run.step(1000);
  const double mass            = 2000. * 0.5 * 3.;
  const double inertia         = mass * (9. + 1.) / 12.;
  const RigidBlockState &block = run.state.get<RigidBlockStates>()[0];
  EXPECT_NEAR(block.rotation, 0.5 * 50. / inertia, 1e-12);
  EXPECT_NEAR(block.displacement[1], 0.5 * 100. / mass, 1e-12);
  EXPECT_NEAR(run.state.get<PlatenState>("turn").velocity[2], block.velocity[2],
              1e-14);
}

TEST(RigidBlocks, PlatenTakesOverAndReleases)
{
  // Driven round by 3.5 turns, released, taken over by a free platen.
  const LoadParameters spin
      = platen("spin", "block", component(velocity, "2"),
               component(velocity, "-1"), component(velocity, "1260"));
  const LoadParameters free
      = platen("free", "block", component(velocity, ""),
               component(velocity, ""), component(velocity, ""));
  TestRun run(make_rectangle(3, 1, 10.), one_rigid_block(), { spin, free });
  const StageParameters driven   = stage_with({ "spin" }),
                        released = stage_with({}),
                        again    = stage_with({ "free" });
  const double dt = 1e-3, omega = 7. * pi;
  const RigidBlockState &block = run.state.get<RigidBlockStates>()[0];
  const auto check             = [&](const double time)
  {
    EXPECT_NEAR(block.rotation, omega * time, 1e-10);
    EXPECT_NEAR(block.displacement[0], 2. * time, 1e-10);
    EXPECT_NEAR(block.displacement[1], -time, 1e-10);
    EXPECT_NEAR(block.velocity[2], omega, 1e-10);
    EXPECT_NEAR(block.velocity[0], 2., 1e-10);
    EXPECT_NEAR(block.velocity[1], -1., 1e-10);
  };
  run.solver.begin_stage(driven, nullptr, run.state);
  run.solver.set_time_step(dt);
  run.step(1000);
  check(1.);

  State<2> before = run.state;
  run.solver.begin_stage(released, &driven, run.state);
  run.step(1);
  check(1.001);
  for (unsigned int i = 0; i < before.nodes.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(run.state.nodes[i].u[d] - before.nodes[i].u[d],
                  dt * run.state.velocity[i][d], 1e-5);
      EXPECT_NEAR(run.state.velocity[i][d], before.velocity[i][d], 1.);
    }
  run.step(499);
  check(1.5);

  run.solver.begin_stage(again, &released, run.state);
  run.step(499);
  run.solver.step(run.state, { true, false });
  check(2.);
  const auto &own = run.model.rigid_blocks().block(0);
  EXPECT_NEAR(run.solver.energies().kinetic,
              0.5 * own.mass * 5. + 0.5 * own.inertia * omega * omega, 1e-6);
  // The platen's drive made this energy.
  EXPECT_NEAR(run.solver.energies().residual(), 0.,
              1e-6 * run.solver.energies().kinetic);
}

TEST(RigidBlocks, PatchWithDeformableBlocks)
{
  // Uniform compression passes through the rigid block.
  BlockMesh<2> mesh          = make_three(2);
  ModelParameters parameters = three_blocks(2e10, 1e10);
  parameters.materials = { material("lower", 2500., 1e10, 0.), rigid("middle"),
                           material("upper", 2500., 1e10, 0.) };
  order(mesh, parameters);
  TestRun run(mesh, parameters,
              { motion("base", "bottom", "0", "0"),
                traction("press", "top", "0", "-1e5") });
  EXPECT_EQ(run.model.nodes().cells().n_deformable, 8U);
  EXPECT_EQ(run.model.nodes().n_deformable_nodes(), 12U);
  EXPECT_EQ(run.model.nodes().table().is_rigid,
            std::vector<bool>({ false, false, true }));
  StageParameters stage = stage_with({ "base", "press" }, DampingType::local);
  run.begin(stage, 0.5);
  run.step(4000);
  run.solver.step(run.state, { true, true });
  EXPECT_LT(run.state.unbalanced_ratio, 1e-9);
  for (unsigned int c = 0; c < 8; ++c)
  {
    const auto stress
        = cell_stress(run.model.blocks(), run.state.nodes.data(), {}, c);
    EXPECT_NEAR(stress[0], 0., 1e-2);
    EXPECT_NEAR(stress[1], -1e5, 1e-2);
    EXPECT_NEAR(stress[2], 0., 1e-2);
  }
  for (const double traction : run.state.get<JointHistory>().normal_traction)
    EXPECT_NEAR(traction, -1e5, 1e-2);
  EXPECT_NEAR(run.state.get<RigidBlockStates>()[0].displacement[1],
              -1e5 / 1e10 - 1e5 / 2e10, 1e-12);
}

TEST(RigidBlocks, BoundOfTheFrequency)
{
  for (const double base_density : { 100., 2500., 1e6 })
    for (const auto &[kn, ks] :
         std::vector<std::pair<double, double>>{ { 2e10, 1e10 }, { 1e9, 5e9 } })
    {
      BlockMesh<2> mesh          = make_stack(4, 2);
      ModelParameters parameters = two_blocks(kn, ks);
      parameters.materials = { rigid("lower", base_density), rigid("upper") };
      const TestNodes nodes(mesh, parameters.materials);
      const Model<2> model(nodes, parameters);
      const double exact = exact_eigenvalue(model);
      const double bound = stability_at(model, model.initial_state())
                               .largest_eigenvalue(model.mass());
      EXPECT_GE(bound, exact * (1. - 1e-6));
      EXPECT_LE(bound, 1.5 * exact);
      std::vector<KnownFrequency> known;
      for (const double factor : { 1., 4. })
        EXPECT_NEAR(highest_squared_frequency(
                        model, model.mass(), { { factor, factor }, {} }, known),
                    exact / factor, 1e-5 * exact);
    }
}

TEST(RigidBlocks, BoundOfManyBlocksOnOne)
{
  // Twenty blocks on a heavy one: its many springs must not cost a small step.
  MeshData<2> data = grid(20, 1, "base", 0., -1.);
  for (unsigned int i = 0; i < 20; ++i)
  {
    add_grid(data, 1, 1, "block", i, 0.);
    add_curve(data, "joint", i, 0., i + 1., 0.);
    if (i > 0)
      add_curve(data, "head", i, 0., i, 1.);
  }
  BlockMesh<2> mesh = split_into_blocks(data, {});
  ModelParameters parameters;
  parameters.materials = { rigid("base", 1e5), rigid("block") };
  parameters.joints
      = { elastic_joint(1e10, 5e9), elastic_joint(1e2, 1e2, "head") };
  const TestNodes nodes(mesh, parameters.materials);
  const Model<2> model(nodes, parameters);
  const double exact = exact_eigenvalue(model);
  const double bound = stability_at(model, model.initial_state())
                           .largest_eigenvalue(model.mass());
  EXPECT_GE(bound, exact * (1. - 1e-6));
  EXPECT_LE(bound, 1.1 * exact);
}

TEST(RigidBlocks, RunsAtTheBoundStayBounded)
{
  BlockMesh<2> mesh = make_three(3);
  for (const bool mixed : { false, true })
  {
    ModelParameters parameters = three_blocks(2e10, 1e10);
    if (mixed)
      parameters.materials[0] = material("lower");
    order(mesh, parameters);
    TestRun run(mesh, parameters, {});
    run.begin(stage_with({}), 0.99);
    for (RigidBlockState &block : run.state.get<RigidBlockStates>())
      block.velocity[1] = block.velocity[2] = 1e-9;
    run.state.get<RigidBlockStates>()[0].velocity[2] = -1e-9;
    run.step(20000);
    for (const RigidBlockState &block : run.state.get<RigidBlockStates>())
      for (const double v : block.velocity)
        EXPECT_LT(std::abs(v), 1e-8);
  }
}

TEST(RigidBlocks, BoundOfContactsAnywhere)
{
  BlockMesh<2> mesh                     = make_stack(2, 1);
  ModelParameters parameters            = two_blocks(2e10, 3e10);
  parameters.materials                  = { rigid("lower"), rigid("upper") };
  parameters.large_displacements        = true;
  parameters.joints[0].all_new_contacts = true;
  const TestNodes nodes(mesh, parameters.materials);
  const Model<2> model(nodes, parameters);
  // Around a rectangle of 2 m by 1 m every node but those in the middle of
  // the long sides is a corner with two edges of 1 m: all have 1 m.
  const double k = 2. * 3e10 * 1. * 0.5, mass = 2500. * 0.5 * 2.;
  const double inertia = mass * 5. / 12.;
  EXPECT_NEAR(stability_at(model, model.initial_state())
                  .largest_eigenvalue(model.mass()),
              std::max(6. * k / mass, (4. * 1.25 + 2. * 0.25) * k / inertia),
              1e-6 * k / mass);
}

TEST(RigidBlocks, MassScalingReachesTheStep)
{
  BlockMesh<2> mesh          = make_three(2);
  ModelParameters parameters = three_blocks(2e10, 1e10);
  parameters.materials[0]    = material("lower");
  order(mesh, parameters);
  TestRun run(mesh, parameters, { gravity("0", "-10") });
  StageParameters stage = stage_with({ "gravity" });
  run.begin(stage);
  const double own       = run.solver.critical_step().length;
  stage.scaled_time_step = 3. * own;
  run.begin(stage, 0.5);
  EXPECT_NEAR(run.solver.critical_step().length, 3. * own, 1e-9 * own);
  EXPECT_GT(run.solver.critical_step().added.share, 0.);
  for (RigidBlockState &block : run.state.get<RigidBlockStates>())
    block.velocity[1] = block.velocity[2] = 1e-9;
  // The energy that scaling gives and takes is booked.
  run.step(100);
  stage.scaled_time_step = 0.;
  run.solver.step(run.state, { true, false });
  const double before = run.solver.energies().residual();
  run.begin(stage, 0.4, &stage);
  run.solver.step(run.state, { true, false });
  EXPECT_NEAR(run.solver.energies().residual(), before,
              1e-6 * run.solver.energies().throughput());
}

TEST(RigidBlocks, ResumesInMidStage)
{
  BlockMesh<2> mesh          = make_three(2);
  ModelParameters parameters = three_blocks(2e10, 1e10);
  parameters.materials[0]    = material("lower");
  order(mesh, parameters);
  const std::vector<LoadParameters> loads
      = { gravity("0", "-10"), motion("base", "bottom", "0", "0"),
          platen("top", "upper", component(velocity, "0.01"),
                 component(given_force, "-1e4"), component(given_force, "")) };
  StageParameters stage
      = stage_with({ "gravity", "base", "top" }, DampingType::local);
  stage.scaled_time_step = 1e-3;
  TestRun run(mesh, parameters, loads), other(mesh, parameters, loads);
  run.begin(stage, 0.5);
  run.step(200);
  other.state = run.state;
  other.solver.resume_stage(stage, nullptr, other.state);
  EXPECT_EQ(other.solver.critical_step().length,
            run.solver.critical_step().length);
  other.solver.set_time_step(run.dt());
  run.step(200);
  other.step(200);
  EXPECT_EQ(std::memcmp(run.state.nodes.data(), other.state.nodes.data(),
                        run.state.nodes.size() * sizeof(NodeRecord<2>)),
            0);
  EXPECT_EQ(std::memcmp(run.state.get<RigidBlockStates>().data(),
                        other.state.get<RigidBlockStates>().data(),
                        2 * sizeof(RigidBlockState)),
            0);
  EXPECT_NE(run.state.get<RigidBlockStates>()[0].displacement[1], 0.);
}

TEST(RigidBlocks, RefusesWhatWouldDeformThem)
{
  BlockMesh<2> mesh          = make_stack(2, 2);
  ModelParameters parameters = two_blocks();
  parameters.materials       = { rigid("lower"), rigid("upper") };
  TestRun run(
      mesh, parameters,
      { motion("base", "bottom", "0", "0"), viscous("quiet", "sides"),
        load("plate", LoadType::platen, "top", velocity, "0", "0", "0") });
  for (const char *name : { "base", "quiet", "plate" })
  {
    const std::string message
        = message_of<InputError>([&]() { run.begin(stage_with({ name })); });
    for (const std::string &part :
         { std::string(name), std::string("rigid"), std::string("platen"),
           std::string("Group") })
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(RigidBlocks, RefusesABlockThatIsRigidInPart)
{
  MeshData<2> data = grid(2, 1, "stone");
  data.group_names.push_back("mortar");
  data.cell_group[3] = 1;
  BlockMesh<2> mesh  = split_into_blocks(data, {});
  ModelParameters parameters;
  parameters.materials      = { rigid("stone"), material("mortar") };
  const std::string message = message_of<InputError>(
      [&]() { find_rigid_blocks(mesh, parameters.materials); });
  for (const char *part : { "stone", "mortar", "Law = rigid" })
    EXPECT_NE(message.find(part), std::string::npos) << message;
  parameters.materials[1] = rigid("mortar");
  EXPECT_EQ(find_rigid_blocks(mesh, parameters.materials),
            std::vector<bool>{ true });
}

TEST(RigidBlocks, StepWithWaterKnowsTheirInertia)
{
  // Flat blocks that rock on the water between them.
  BlockMesh<2> mesh = make_stack(1, 1);
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
    mesh.vertices[v][0] *= 4.;
  ModelParameters parameters = two_blocks();
  for (MaterialParameters &stone : parameters.materials)
    stone.rigid = true;
  TestRun run(mesh, parameters, {});
  const auto eigenvalue = [&]()
  {
    run.begin(stage_with({}));
    const double step = run.solver.critical_step().length;
    return 4. / (step * step);
  };
  const double without = eigenvalue();
  WaterParameters given;
  given.flow               = FlowKind::transient;
  given.fluid.bulk_modulus = 2e9;
  HydraulicAperture aperture;
  aperture.name     = "joint";
  aperture.residual = 1e-5;
  given.joints      = { aperture };
  JointFlow water(given, run.nodes, run.model.joints(), parameters.joints,
                  run.model.thickness());
  run.solver.loads().water = &water;
  const double half        = 2e9 / 1e-5 * 0.5 * 2.; // at each end [N/m]
  const double mass        = 2500. * 4. * 0.5;
  const double exact       = 2. * 2. * half * 2. * 2. / (mass * 17. / 12.);
  EXPECT_NEAR(eigenvalue() - without, exact, 1e-9 * exact);
}
