// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "implicit_run.h"

#include <quoin/base/exceptions.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/farfield/static_far_field.h>
#include <quoin/mesh/crossed_triangles.h>
#include <quoin/operators/archive.h>

#include <boost/archive/binary_oarchive.hpp>

#include <sstream>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr auto velocity    = LoadQuantity::velocity;
  constexpr auto given_force = LoadQuantity::force;
  constexpr double section   = 0.5 * 2.; // thickness times height

  enum class Cut
  {
    plain,
    crossed,
    quadratic
  };

  /** The squares of add_grid() by both of their diagonals. */
  void cross(MeshData<2> &data)
  {
    Quadrangles squares;
    for (unsigned int i = 0; i < data.cells.size(); i += 2)
    {
      const auto &[a, b, c] = data.cells[i];
      squares.nodes.push_back({ { a, b, c, data.cells[i + 1][2] } });
      squares.group.push_back(data.cell_group[i]);
    }
    data.cells.clear();
    data.cell_group.clear();
    add_crossed_triangles(squares, data);
  }

  /**
   * Three blocks of 2 m x 2 m in a row, groups "a", "b" and "c", with the
   * joints "first" and "second" and the curves "left", "right" and "floor".
   */
  BlockMesh<2> make_row(const Cut cut = Cut::plain)
  {
    const std::string groups[] = { "a", "b", "c" };
    const std::string curves[] = { "left", "first", "second" };
    MeshData<2> data;
    for (unsigned int i = 0; i < 3; ++i)
    {
      const double x = 2. * i;
      add_grid(data, 2, 2, groups[i], x, 0.);
      add_curve(data, curves[i], x, 0., x, 2.);
      add_curve(data, "floor", x, 0., x + 2., 0.);
    }
    add_curve(data, "right", 6., 0., 6., 2.);
    if (cut == Cut::crossed)
      cross(data);
    data.quadratic = cut == Cut::quadratic;
    return split_into_blocks(data, {});
  }

  ModelParameters three_blocks(const double poisson = 0.2)
  {
    ModelParameters result;
    result.plane     = PlaneAssumption::plane_stress;
    result.thickness = 0.5;
    for (const std::string name : { "a", "b", "c" })
      result.materials.push_back(material(name, 2500., 1e10, poisson));
    result.joints = { elastic_joint(1e11, 4e10, "first"),
                      elastic_joint(2e11, 8e10, "second") };
    return result;
  }

  LoadParameters moved(const std::string &name, const std::string &x,
                       const std::string &y)
  {
    return load(name, LoadType::prescribed_motion, name,
                LoadQuantity::displacement, x, y);
  }

  std::string bytes(const State<2> &state)
  {
    std::ostringstream stream;
    boost::archive::binary_oarchive(stream) << state;
    return stream.str();
  }

  /** Friction 0.5 under 1e6 N, then a force of 0.8e6 N a second: it holds
      until 0.625 s. */
  struct Sliding
  {
    BlockMesh<2> mesh = make_stack(2, 1);
    std::unique_ptr<ImplicitRun> run;

    explicit Sliding(const bool jumps)
    {
      ModelParameters parameters = two_blocks();
      CoulombLaw &law            = coulomb_law(parameters.joints[0]);
      law.peak = law.residual = { 0., 0.5, 0. };
      ImplicitParameters numbers;
      numbers.jumps      = jumps;
      const auto at_rest = component(velocity, "0");
      run                = std::make_unique<ImplicitRun>(
          mesh, parameters,
          std::vector<LoadParameters>{
                             platen("held", "lower", at_rest, at_rest, at_rest),
                             platen("press", "upper", component(given_force, "0"),
                                    component(given_force, "-1e6 * min(1, t/0.5)"), at_rest),
                             platen("push", "upper", component(given_force, "8e5*t"),
                                    component(given_force, "-1e6"), at_rest) },
          numbers);
      const StageParameters pressed = stage_with({ "held", "press" });
      run->begin(pressed.loads);
      run->finish();
      run->begin({ "held", "push" }, &pressed);
    }
  };

  double largest_damping_error(const ImplicitRun &run)
  {
    const Energies &energies = run.solver.energies();
    return std::abs(energies.residual()) / energies.throughput();
  }
} // namespace

// Forward, back and forth again under a constant pressure, when nothing but the
// pressure is free: the force is 5e5 N all the way.
TEST(ImplicitSolver, FrictionBetweenPrescribedMotionsIsForceTimesSlip)
{
  BlockMesh<2> mesh          = make_stack(2, 1);
  ModelParameters parameters = two_blocks();
  CoulombLaw &law            = coulomb_law(parameters.joints[0]);
  law.peak = law.residual = { 0., 0.5, 0. };
  const auto at_rest      = component(velocity, "0");
  const auto pressed      = component(given_force, "-1e6*min(1, T/0.5)");
  ImplicitParameters numbers;
  numbers.first_step = 0.002;
  ImplicitRun run(
      mesh, parameters,
      { platen("held", "lower", at_rest, at_rest, at_rest),
        platen("press", "upper", component(given_force, "0"), pressed, at_rest),
        platen("push", "upper",
               component(LoadQuantity::displacement, "0.01*sin(2*pi*t)"),
               pressed, at_rest) },
      numbers);
  const StageParameters first = stage_with({ "held", "press" });
  run.begin(first.loads);
  run.finish();
  run.begin({ "held", "push" }, &first);
  run.finish();
  // Once 5e5 N, and at both reversals twice as much, are elastic.
  const double stiffness = 1e10 * 2. * 0.5;
  const double work      = 5e5 * (0.04 - 5. * 5e5 / stiffness);
  EXPECT_NEAR(run.state.energy.friction, work, 0.005 * work);
}

TEST(ImplicitSolver, UniformStressIsExact)
{
  for (const Cut cut : { Cut::plain, Cut::crossed, Cut::quadratic })
  {
    ImplicitParameters numbers;
    numbers.force_ratio = 1e-12;
    const double sx = 3e6, sy = 0.;
    ImplicitRun run(make_row(cut), three_blocks(),
                    { moved("left", "0", ""), moved("floor", "", "0"),
                      traction("pull", "right", "3e6*t", "") },
                    numbers);
    run.begin({ "left", "floor", "pull" });
    run.finish();
    for (unsigned int c = 0; c < run.nodes->cells().size(); ++c)
    {
      const auto stress
          = cell_stress(run.model.blocks(), run.state.nodes.data(), {}, c);
      EXPECT_NEAR(stress[0], sx, 1e-9 * sx);
      EXPECT_NEAR(stress[1], sy, 1e-9 * sx);
      EXPECT_NEAR(stress[2], 0., 1e-9 * sx);
    }
    for (const double t : run.state.get<JointHistory>().normal_traction)
      EXPECT_NEAR(t, sx, 1e-9 * sx);
    // Length over E, and two joints.
    const double pulled = sx * (6. / 1e10 + 1. / 1e11 + 1. / 2e11);
    for (const unsigned int v : nodes_at(run.nodes, 6., 2.))
    {
      EXPECT_NEAR(run.state.nodes[v].u[0], pulled, 1e-9 * pulled);
      EXPECT_NEAR(run.state.nodes[v].u[1], -0.2 * sx * 2. / 1e10,
                  1e-9 * pulled);
    }
    EXPECT_NEAR(run.solver.resultant("left")[0], -sx * section, 1e-9 * sx);
    EXPECT_LT(largest_damping_error(run), 1e-9);
  }
}

TEST(ImplicitSolver, IterationsConvergeQuadratically)
{
  // A bar of three blocks bent by a third of a right angle in one step.
  ImplicitParameters numbers;
  numbers.first_step = numbers.largest_step = 1.;
  numbers.force_ratio                       = 1e-13;
  numbers.line_search                       = false;
  ImplicitRun run(
      make_row(), three_blocks(),
      { moved("left", "0", "0"), traction("push", "right", "", "1e8*t") },
      numbers);
  run.begin({ "left", "push" });
  run.solver.step(run.state);
  ASSERT_TRUE(run.solver.has_ended(run.state));
  EXPECT_GT(run.state.nodes[nodes_at(run.nodes, 6., 2.)[0]].u[1], 0.5);
  expect_quadratic_convergence(run.solver.record().iterations, 2);
}

// The same where a rigid block turns: forces of its nodes turn with it.
TEST(ImplicitSolver, IterationsOfATurningBlockConvergeQuadratically)
{
  MeshData<2> data = grid(2, 1, "lower", 0., 0.);
  add_curve(data, "bottom", 0., 0., 2., 0.);
  add_grid(data, 2, 1, "upper", 0., 1.);
  add_curve(data, "joint", 0., 1., 2., 1.);
  add_curve(data, "half", 1., 2., 2., 2.);
  BlockMesh<2> mesh             = split_into_blocks(data, {});
  ModelParameters parameters    = two_blocks(2e5, 1e5);
  parameters.materials[1].rigid = true;
  ImplicitParameters numbers;
  numbers.first_step = numbers.largest_step = 1.;
  numbers.force_ratio                       = 1e-13;
  numbers.line_search                       = false;
  const auto at_rest                        = component(velocity, "0");
  ImplicitRun run(mesh, parameters,
                  { platen("held", "lower", at_rest, at_rest, at_rest),
                    traction("load", "half", "", "-1e5*t") },
                  numbers);
  run.begin({ "held", "load" });
  run.solver.step(run.state);
  ASSERT_TRUE(run.solver.has_ended(run.state));
  EXPECT_LT(run.state.get<RigidBlockStates>()[0].rotation, -0.1);
  expect_quadratic_convergence(run.solver.record().iterations, 1);
}

TEST(ImplicitSolver, SlidingBeyondItsLimitKeepsTheLastEquilibrium)
{
  Sliding sliding(false);
  ImplicitRun &run = *sliding.run;
  State<2> last;
  try
  {
    for (;;)
    {
      last = run.state;
      run.solver.step(run.state);
      ASSERT_LT(run.state.load_time, 0.63);
    }
  }
  catch (const RunError &error)
  {
    const std::string text = error.what();
    for (const std::string part :
         { "no equilibrium", "load time 0.62", "limit load",
           "'Path following = automatic'", "last equilibrium is kept" })
      EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  }
  EXPECT_NEAR(run.state.load_time, 0.625, 1e-4);
  last.get<ImplicitState>()
      = run.state.get<ImplicitState>(); // the step to try has become smaller
  EXPECT_EQ(bytes(run.state), bytes(last));
}

TEST(ImplicitSolver, ACollapseResumedWithinItsJumpEndsTheSame)
{
  const auto collapse = [](ImplicitRun &run)
  {
    try
    {
      run.finish();
    }
    catch (const RunError &error)
    {
      return std::string(error.what());
    }
    return std::string("it stands");
  };
  Sliding whole(true), other(true);
  ImplicitRun &run = *whole.run;
  while (run.state.get<ImplicitState>().n_drag < 1)
    run.solver.step(run.state);
  run.solver.save(run.state);
  other.run->state = run.state;
  run.state.get<ImplicitState>().before_jump.clear(); // of the checkpoint alone
  other.run->solver.resume_stage(stage_with({ "held", "push" }), nullptr,
                                 other.run->state);
  const std::string text = collapse(run);
  EXPECT_NE(text.find("kept moving"), std::string::npos) << text;
  EXPECT_EQ(collapse(*other.run), text);
  EXPECT_TRUE(bytes(other.run->state) == bytes(run.state));
  EXPECT_EQ(other.run->state.get<ImplicitState>().jumps, false);
}

TEST(ImplicitSolver, AStepOfAJumpBeginsWithTheMotionOfTheLastOne)
{
  Sliding sliding(true);
  ImplicitRun &run = *sliding.run;
  while (run.state.get<ImplicitState>().n_drag < 4)
    run.solver.step(run.state);
  // What is beyond the friction drags the block at a constant velocity.
  run.solver.record().iterations.clear();
  run.solver.step(run.state);
  ASSERT_EQ(run.state.get<ImplicitState>().n_drag, 5U);
  const double out_of_balance
      = 8e5 * run.state.get<ImplicitState>().jump_time - 5e5;
  EXPECT_LT(run.solver.record().iterations.front().unbalanced_ratio,
            1e-3 * out_of_balance / 1e6);
}

TEST(ImplicitSolver, StepsAreLongWhereTheMotionGoesOnAndShortWhereItTurns)
{
  ImplicitParameters numbers;
  numbers.first_step   = 0.01;
  numbers.largest_step = 0.2;
  ImplicitRun run(
      make_row(), three_blocks(),
      { moved("left", "0", ""), moved("floor", "", "0"),
        traction("pull", "right", "3e6 * (t < 0.5 ? t : 1.1 - 1.2 * t)", "") },
      numbers);
  run.begin({ "left", "floor", "pull" });
  double longest = 0., at_the_turn = 0.;
  while (!run.solver.has_ended(run.state))
  {
    const double before = run.state.load_time;
    run.solver.step(run.state);
    const double step = run.state.load_time - before;
    longest           = std::max(longest, step);
    if (before <= 0.5 && run.state.load_time > 0.5)
      at_the_turn = step;
  }
  EXPECT_GT(longest, 0.1);
  EXPECT_LT(at_the_turn, 0.0101);
  EXPECT_LT(run.state.stage_step, 40U);
}

TEST(ImplicitSolver, ALoadThatJumpsAtTheStartRestsFromThereOn)
{
  ImplicitRun run(make_row(), three_blocks(),
                  { moved("left", "0", ""), moved("floor", "", "0"),
                    traction("pull", "right", "if(t > 0, 3e6, 0)", "") });
  StageParameters stage = stage_with({ "left", "floor", "pull" });
  stage.end             = StageEnd::static_ratio;
  run.solver.begin_stage(stage, nullptr, run.state);
  run.finish();
  EXPECT_NEAR(run.solver.resultant("left")[0], -3e6 * section, 1e-5 * 3e6);
}

TEST(ImplicitSolver, AGivenRotationResumedIsBitwiseTheSame)
{
  BlockMesh<2> mesh  = make_stack(2, 1);
  const auto at_rest = component(velocity, "0");
  const std::vector<LoadParameters> loads
      = { platen("held", "lower", at_rest, at_rest, at_rest),
          platen("turn", "upper", at_rest, at_rest,
                 component(velocity, "1e-3*t")) };
  const StageParameters stage = stage_with({ "held", "turn" });
  ImplicitRun run(mesh, two_blocks(), loads), other(mesh, two_blocks(), loads);
  run.solver.begin_stage(stage, nullptr, run.state);
  run.solver.step(run.state);
  other.state = run.state;
  other.solver.resume_stage(stage, nullptr, other.state);
  run.solver.step(run.state);
  other.solver.step(other.state);
  EXPECT_EQ(bytes(other.state), bytes(run.state));
}

TEST(ImplicitSolver, ReactionOfTheFarField)
{
  // Boundary elements below the stack, of the same rock, resist its turning.
  const TestNodes nodes(make_stack(4, 1));
  Model<2> model(nodes, two_blocks());
  FarFieldDomain domain;
  domain.boundary.add_curve({ { 4., 0. }, { 2., 0. }, { 0., 0. } }, false);
  domain.medium    = ElasticMedium::from_young(2500., 1e10, 0.2);
  domain.interface = { 0, 1 };
  LoadParameters far;
  far.name = "far";
  far.type = LoadType::boundary_elements;
  ImplicitSolver<2> solver(
      model,
      { far,
        platen("turn", "upper", component(given_force, "0"),
               component(given_force, "0"), component(given_force, "1e6*t")) },
      {}, { "joint" },
      std::make_unique<StaticFarField>(
          "far", domain, nodes, faces_of_curves<2>(nodes, { "bottom" }, "far"),
          model.parameters().thickness));
  State<2> state = model.initial_state();
  solver.begin_stage(stage_with({ "far", "turn" }), nullptr, state);
  while (!solver.has_ended(state))
    solver.step(state);
  const auto reaction = solver.resultant("far");
  EXPECT_NEAR(reaction[2], -1e6, 1e-5 * 1e6);
  for (unsigned int d = 0; d < 2; ++d)
    EXPECT_NEAR(reaction[d], 0., 1e-5 * 1e6);
}

TEST(ImplicitSolver, RigidBlockUnderAnEccentricLoad)
{
  // A wall of 2 m x 1 m on a bed of springs: weight 25 kN in the middle,
  // 0.5 kN half a metre to the right.
  MeshData<2> data = grid(2, 1, "lower", 0., 0.);
  add_curve(data, "bottom", 0., 0., 2., 0.);
  add_grid(data, 2, 1, "upper", 0., 1.);
  add_curve(data, "joint", 0., 1., 2., 1.);
  add_curve(data, "half", 1., 2., 2., 2.);
  BlockMesh<2> mesh             = split_into_blocks(data, {});
  ModelParameters parameters    = two_blocks();
  parameters.materials[1].rigid = true;
  ImplicitParameters numbers;
  numbers.force_ratio = 1e-12;
  const auto at_rest  = component(velocity, "0");
  ImplicitRun run(mesh, parameters,
                  { platen("held", "lower", at_rest, at_rest, at_rest),
                    gravity("0", "-10"), traction("load", "half", "", "-1e3") },
                  numbers);
  run.begin({ "held", "gravity", "load" });
  EXPECT_EQ(run.state.get<ImplicitState>().released, 0.);
  run.finish();
  // Nodal quadrature: 0.25, 0.5 and 0.25 m^2 at -1, 0 and 1 m.
  const double kn = 2e10, moment = -500. * 0.5, inertia = 0.5;
  const RigidBlockState &block = run.state.get<RigidBlockStates>()[0];
  EXPECT_NEAR(block.displacement[1], -25.5e3 / kn, 1e-6 * 25.5e3 / kn);
  EXPECT_NEAR(block.rotation, moment / (kn * inertia), 1e-12);
  // The lower block weighs as much as the upper one.
  EXPECT_NEAR(run.solver.resultant("held")[1], 50.5e3, 1e-6 * 50.5e3);
}

TEST(ImplicitSolver, WhatASupportHeldIsLetGo)
{
  ImplicitParameters numbers;
  numbers.force_ratio = 1e-6;
  ImplicitRun run(make_row(), three_blocks(0.),
                  { moved("left", "0", "0"), moved("right", "1e-6*t", "") },
                  numbers);
  const StageParameters pulled = stage_with({ "left", "right" });
  run.begin(pulled.loads);
  run.finish();
  const double stiffness = section / (6. / 1e10 + 1. / 1e11 + 1. / 2e11);
  EXPECT_NEAR(run.solver.resultant("right")[0], stiffness * 1e-6,
              1e-6 * stiffness * 1e-6);
  EXPECT_EQ(run.state.get<ImplicitState>().released, 1.);

  run.begin({ "left" }, &pulled);
  EXPECT_EQ(run.state.get<ImplicitState>().released, 0.);
  const unsigned int end = nodes_at(run.nodes, 6., 2.)[0];
  unsigned int n         = 0;
  for (; run.state.get<ImplicitState>().released < 1.; ++n)
  {
    EXPECT_EQ(run.state.load_time, 0.);
    EXPECT_NEAR(run.state.nodes[end].u[0],
                1e-6 * (1. - run.state.get<ImplicitState>().released), 1e-12);
    run.solver.step(run.state);
  }
  EXPECT_GT(n, 5U);
  EXPECT_TRUE(run.state.get<ImplicitState>().held.empty());
  EXPECT_NEAR(run.state.nodes[end].u[0], 0., 1e-14);
  // All that was stored is lost, as by a damper.
  const double stored = 0.5 * stiffness * 1e-12;
  EXPECT_NEAR(run.state.energy.damping, stored, 1e-5 * stored);
  EXPECT_LT(largest_damping_error(run), 1e-9);
  run.finish();
  EXPECT_NEAR(run.state.nodes[end].u[0], 0., 1e-14);
}
