// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../model/test_models.h"

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/initial_energy.h>
#include <quoin/absorbing/free_field_boundary.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr auto velocity = LoadQuantity::velocity;

  /**
   * A lower block of nx x ny unit squares and an upper one with a joint
   * between, and the curves "bottom", "left", "right", "joint".
   */
  BlockMesh<2> make_sides(const unsigned int nx, const unsigned int ny)
  {
    MeshData<2> data;
    for (const unsigned int i : { 0U, 1U })
    {
      const double y0 = i * ny, y1 = y0 + ny;
      add_grid(data, nx, ny, i == 0 ? "lower" : "upper", 0., y0);
      add_curve(data, i == 0 ? "bottom" : "joint", 0., y0, nx, y0);
      add_curve(data, "left", 0., y0, 0., y1);
      add_curve(data, "right", nx, y0, nx, y1);
      if (i == 1)
        add_curve(data, "top", 0., y1, nx, y1);
    }
    return split_into_blocks(data, {});
  }

  LoadParameters free_field(const std::string &name,
                            const std::string &boundary,
                            const std::string &base = "base")
  {
    LoadParameters result;
    result.name       = name;
    result.type       = LoadType::free_field;
    result.boundaries = { boundary };
    result.base       = base;
    return result;
  }

  LoadParameters incident(const std::string &normal, const std::string &shear)
  {
    return load("base", LoadType::viscous_boundary, "bottom", velocity, normal,
                shear);
  }

  ModelParameters plane_strain()
  {
    ModelParameters parameters = two_blocks(1e14, 1e14);
    parameters.plane           = PlaneAssumption::plane_strain;
    return parameters;
  }

  /** What a stage changes: the stiffness of all materials by @p factor. */
  void change_stiffness(TestRun &run, const double factor,
                        const bool yields = false)
  {
    ModelProperties properties = run.model.properties();
    for (MaterialParameters &each : properties.materials)
    {
      each.elastic.young *= factor;
      if (yields)
        each.strength = MohrCoulombStrength{ 1e9, 0., 0. };
    }
    run.model.set_properties(properties, run.state.get<ConstructionState<2>>());
  }

  StageParameters named_stage(const std::string &name,
                              const std::vector<std::string> &loads)
  {
    StageParameters stage = stage_with(loads);
    stage.name            = name;
    return stage;
  }

  void expect_refused(const std::vector<LoadParameters> &loads,
                      const std::vector<std::string> &words,
                      const ModelParameters &parameters = plane_strain())
  {
    BlockMesh<2> mesh = make_sides(2, 2);
    const std::string message
        = message_of<InputError>([&] { TestRun run(mesh, parameters, loads); });
    for (const std::string &word : words)
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
} // namespace

TEST(FreeField, VerticalWavesPassAsIfTheModelWereEndless)
{
  // Both kinds at once; the corners have other lumped masses than the column.
  BlockMesh<2> mesh       = make_sides(6, 10);
  const std::string pulse = "*(1-cos(2*pi*t/0.012))*if(t<0.012,1,0)";
  TestRun run(mesh, plane_strain(),
              { incident("1e-9" + pulse, "1e-9" + pulse),
                free_field("left", "left"), free_field("right", "right") });
  run.begin(stage_with({ "base", "left", "right" }));
  double peak = 0., scatter = 0.;
  const auto steps = static_cast<unsigned int>(0.04 / run.dt());
  for (unsigned int i = 0; i < steps; ++i)
  {
    run.step(1);
    const auto top                   = run.nodes_at_height(20.);
    const dealii::Tensor<1, 2> &mean = run.state.velocity[run.node(3., 20.)];
    for (const unsigned int n : top)
      for (unsigned int d = 0; d < 2; ++d)
      {
        peak = std::max(peak, std::abs(mean[d]));
        scatter
            = std::max(scatter, std::abs(run.state.velocity[n][d] - mean[d]));
      }
  }
  EXPECT_NEAR(peak, 4e-9, 0.1e-9);
  EXPECT_LT(scatter, 0.02 * peak);
}

TEST(FreeField, StandsOnTheMaterialsOfItsStage)
{
  BlockMesh<2> mesh       = make_sides(6, 10);
  const std::string pulse = "*(1-cos(2*pi*t/0.012))*if(t<0.012,1,0)";
  TestRun run(mesh, plane_strain(),
              { incident("1e-9" + pulse, "1e-9" + pulse),
                free_field("left", "left"), free_field("right", "right"),
                motion("rollers", "bottom", "0", "0") });
  const StageParameters first = named_stage("first", { "rollers" });
  const StageParameters second
      = named_stage("second", { "base", "left", "right" });
  run.begin(first);
  run.step(3);
  change_stiffness(run, 2.);
  run.begin(second, 0.8, &first);
  double peak = 0., scatter = 0.;
  const auto steps = static_cast<unsigned int>(0.03 / run.dt());
  for (unsigned int i = 0; i < steps; ++i)
  {
    run.step(1);
    const dealii::Tensor<1, 2> &mean = run.state.velocity[run.node(3., 20.)];
    for (const unsigned int n : run.nodes_at_height(20.))
      for (unsigned int d = 0; d < 2; ++d)
      {
        peak = std::max(peak, std::abs(mean[d]));
        scatter
            = std::max(scatter, std::abs(run.state.velocity[n][d] - mean[d]));
      }
  }
  EXPECT_NEAR(peak, 4e-9, 0.1e-9);
  EXPECT_LT(scatter, 0.02 * peak);
}

TEST(FreeField, RefusesMaterialsThatItCannotFollow)
{
  BlockMesh<2> mesh           = make_sides(2, 2);
  const StageParameters first = named_stage("first", { "base", "left" });
  const StageParameters rest  = named_stage("rest", { "base" });
  const StageParameters last  = named_stage("last", { "base", "left" });
  for (const bool yields : { false, true })
  {
    TestRun run(mesh, plane_strain(),
                { incident("0", "0"), free_field("left", "left") });
    const StageParameters &before = yields ? rest : first;
    run.begin(before);
    run.step(1);
    change_stiffness(run, 2., yields);
    const std::string message
        = message_of<InputError>([&] { run.begin(last, 0.8, &before); });
    for (const std::string &word :
         yields ? std::vector<std::string>{ "'Stages/last'", "'Loads/left'",
                                            "'Mohr-Coulomb'" }
                : std::vector<std::string>{ "'Stages/last'", "'Materials'",
                                            "'lower'", "'left'" })
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(FreeField, BalancesItsEnergy)
{
  for (const bool prescribed : { false, true })
  {
    const LoadParameters base
        = prescribed
              ? motion("base", "bottom", "1e-9*sin(800*t)", "1e-9*sin(500*t)")
              : incident("1e-9*sin(500*t)", "1e-9*sin(800*t)");
    TestRun run(
        make_sides(3, 4), plane_strain(),
        { base, free_field("left", "left"), free_field("right", "right") });
    StageParameters stage       = stage_with({ "base", "left", "right" });
    stage.damping               = DampingType::rayleigh;
    stage.mass_coefficient      = 5.;
    stage.stiffness_coefficient = 1e-5;
    run.begin(stage);
    double largest = 0.;
    for (unsigned int i = 0; i < 1000; ++i)
    {
      run.solver.step(run.state, { true, false });
      largest = std::max(largest, std::abs(run.solver.energies().residual()));
    }
    EXPECT_LT(largest, 1e-11 * run.solver.energies().throughput());
    EXPECT_GT(run.solver.energies().viscous, 0.);
  }
}

TEST(FreeField, HoldsTheStressThatItFinds)
{
  // Stress in equilibrium with gravity, sides without any other support.
  BlockMesh<2> mesh          = make_sides(3, 4);
  ModelParameters parameters = plane_strain();
  LoadParameters stress;
  stress.name                 = "in situ";
  stress.type                 = LoadType::initial_stress;
  stress.stress               = { { -3e5, -2e5, 0. } };
  stress.stress_gradient      = { { 12500., 25000., 0. } };
  stress.stress[1]            = -8. * 25000.;
  parameters.initial_stresses = { stress };
  TestRun run(mesh, parameters,
              { motion("base", "bottom", "0", "0"), gravity("0", "-10"),
                free_field("left", "left"), free_field("right", "right") });
  run.begin(stage_with({ "base", "gravity", "left", "right" }));
  run.step(500);
  for (unsigned int n = 0; n < mesh.n_vertices(); ++n)
    for (const double u : dealii::make_array_view(run.state.nodes[n].u))
      EXPECT_LT(std::abs(u), 1e-13);
}

TEST(FreeField, TheColumnIsLayered)
{
  BlockMesh<2> mesh          = make_sides(2, 2);
  ModelParameters parameters = plane_strain();
  parameters.materials
      = { material("lower", 2500., 1e10), material("upper", 2000., 2e9) };
  TestRun run(mesh, parameters,
              { incident("0", "0"), free_field("left", "left") });
  const auto *side = dynamic_cast<const FreeFieldBoundary<2> *>(
      run.solver.loads().constraints.back().get());
  ASSERT_TRUE(side != nullptr);
  EXPECT_EQ(side->sides().front().ground.heights(),
            (std::vector<double>{ 0., 1., 2., 3., 4. }));
  const double modulus = 1e10 * 0.8 / (1.2 * 0.6);
  EXPECT_NEAR(side->traits().largest_eigenvalue, 4. * modulus / 2500., 1e-3);
  EXPECT_EQ(side->traits().companion, "base");
}

TEST(FreeField, RefusesWhatIsNoSide)
{
  expect_refused({ incident("0", "0"), free_field("side", "bottom") },
                 { "'Loads/side'", "'Boundary'", "vertical" });
  LoadParameters both = free_field("side", "left");
  both.boundaries.push_back("right");
  expect_refused({ incident("0", "0"), both }, { "'Boundary'", "side" });

  ModelParameters parameters    = plane_strain();
  parameters.materials[1].rigid = true;
  expect_refused({ incident("0", "0"), free_field("side", "left") },
                 { "'Boundary'", "rigid", "(0, 4)" }, parameters);

  MeshData<2> data = grid(2, 3, "lower");
  add_curve(data, "bottom", 0., 0., 2., 0.);
  add_curve(data, "left", 0., 0., 0., 1.);
  add_curve(data, "left", 0., 2., 0., 3.);
  BlockMesh<2> mesh    = split_into_blocks(data, {});
  parameters.materials = { material("lower") };
  parameters.joints.clear();
  const std::string message = message_of<InputError>(
      [&]
      {
        TestRun run(mesh, parameters,
                    { incident("0", "0"), free_field("side", "left") });
      });
  EXPECT_NE(message.find("gap between (0, 1) m and (0, 2) m"),
            std::string::npos)
      << message;
}

TEST(FreeField, RefusesWhatIsNoBase)
{
  expect_refused({ incident("0", "0"), free_field("side", "left", "bass") },
                 { "'Loads/side'", "'Base = bass'" });
  expect_refused(
      { traction("base", "bottom", "0", "0"), free_field("side", "left") },
      { "'Base = base'", "prescribed motion" });
  expect_refused(
      { load("base", LoadType::viscous_boundary, "top", velocity, "0", "0"),
        free_field("side", "left") },
      { "'Base'", "foot", "(0, 0)" });
  expect_refused(
      { load("base", LoadType::viscous_boundary, "left", velocity, "0", "0"),
        free_field("side", "left") },
      { "'Base'", "not horizontal" });

  TestRun run(make_sides(2, 2), plane_strain(),
              { incident("0", "0"), free_field("side", "left") });
  const std::string message
      = message_of<InputError>([&] { run.begin(stage_with({ "side" })); });
  EXPECT_NE(message.find("'base'"), std::string::npos) << message;
}

TEST(ViscousBoundary, BalancesItsEnergyBesideRollersOnAnInclinedBase)
{
  BlockMesh<2> mesh = make_stack(2, 2);
  for (auto &vertex : mesh.vertices)
    vertex[1] += 0.5 * vertex[0];
  TestRun run(mesh, plane_strain(),
              { viscous("base", "bottom"),
                motion("rollers", "sides", "1e-9*sin(800*t)", "") });
  run.throw_at_random(1e-9);
  account_for_initial_motion(run.model, run.state);
  run.begin(stage_with({ "base", "rollers" }));
  double largest = 0.;
  for (unsigned int i = 0; i < 300; ++i)
  {
    run.solver.step(run.state, { true, false });
    largest = std::max(largest, std::abs(run.solver.energies().residual()));
  }
  EXPECT_LT(largest, 1e-11 * run.solver.energies().throughput());
  EXPECT_GT(run.solver.energies().viscous, 0.);
}

TEST(ViscousBoundary, OfAnotherMaterialBeyond)
{
  // Thrown down at v on ground of three times its impedance, the base slows
  // down to v / 4 until a wave comes back.
  BlockMesh<2> mesh          = make_stack(1, 30);
  ModelParameters parameters = plane_strain();
  MaterialParameters hard    = material("hard", 2500., 9e10);
  hard.groups.clear();
  parameters.materials.push_back(hard);
  LoadParameters base = viscous("base", "bottom");
  base.far_material   = "hard";
  TestRun run(mesh, parameters, { base, motion("rollers", "sides", "0", "") });
  run.begin(stage_with({ "base", "rollers" }));
  for (dealii::Tensor<1, 2> &node : run.state.velocity)
    node[1] = -1e-9;
  const double c = std::sqrt(1e10 * 0.8 / (1.2 * 0.6) / 2500.);
  run.step(static_cast<unsigned int>(40. / c / run.dt()));
  for (const unsigned int n : run.nodes_at_height(0.))
    EXPECT_NEAR(run.state.velocity[n][1], -0.25e-9, 0.01e-9);

  for (const std::string name : { "harder", "stiff" })
  {
    MaterialParameters rigid = material("stiff");
    rigid.groups.clear();
    rigid.rigid = true;
    parameters.materials.push_back(rigid);
    base.far_material         = name;
    const std::string message = message_of<InputError>(
        [&] { TestRun other(mesh, parameters, { base }); });
    for (const std::string word :
         { "'Loads/base'", "'Far field material", "lower, upper, hard" })
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
}

TEST(ViscousBoundary, HasTheMaterialsOfItsStage)
{
  // Thrown down at v on ground of its own impedance, the base slows down to
  // v / 2 until a wave comes back.
  TestRun run(
      make_stack(1, 30), plane_strain(),
      { viscous("base", "bottom"), motion("rollers", "sides", "0", "") });
  const StageParameters first = named_stage("first", { "base", "rollers" });
  run.begin(first);
  run.step(3);
  change_stiffness(run, 9.);
  run.begin(named_stage("second", { "base", "rollers" }), 0.8, &first);
  for (dealii::Tensor<1, 2> &node : run.state.velocity)
    node[1] = -1e-9;
  const double c = 3. * std::sqrt(1e10 * 0.8 / (1.2 * 0.6) / 2500.);
  run.step(static_cast<unsigned int>(40. / c / run.dt()));
  for (const unsigned int n : run.nodes_at_height(0.))
    EXPECT_NEAR(run.state.velocity[n][1], -0.5e-9, 0.02e-9);
}

TEST(InitialMotion, BringsItsEnergyAndIsOfSecondOrder)
{
  // A mode-like motion with velocities and strains, joints strained too. The
  // results of half steps differ by a quarter as much.
  double result[3];
  for (const unsigned int k : { 0U, 1U, 2U })
  {
    BlockMesh<2> mesh = make_sides(4, 4);
    TestRun run(mesh, two_blocks(), { motion("base", "bottom", "0", "0") });
    for (unsigned int n = 0; n < run.state.nodes.size(); ++n)
    {
      const double y           = run.state.nodes[n].X[1];
      const double jump        = mesh.block_of_vertex(n);
      run.state.nodes[n].u[0]  = 1e-12 * y * (1. + jump);
      run.state.velocity[n][1] = 1e-9 * y;
    }
    account_for_initial_motion(run.model, run.state);
    run.begin(stage_with({ "base" }));
    run.solver.set_time_step(0.5e-4 / (1U << k));
    const double given = run.state.energy.external;
    EXPECT_GT(given, 0.);
    double largest = 0.;
    for (unsigned int i = 0; i < (20U << k); ++i)
    {
      run.solver.step(run.state, { true, false });
      largest = std::max(largest, std::abs(run.solver.energies().residual()));
    }
    EXPECT_LT(largest, 1e-10 * given);
    result[k] = run.state.nodes[run.node(4., 8.)].u[1];
  }
  EXPECT_NEAR((result[0] - result[1]) / (result[1] - result[2]), 4., 0.4);
}
