// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../implicit/implicit_run.h"
#include "../model/test_models.h"

#include <quoin/loading/load_pattern.h>

#include <cmath>
#include <sstream>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double g = 9.81;

  /** A stage that a factor of gravity, to the right, pushes. */
  StageParameters pushed(const std::string &control,
                         const DampingType damping = DampingType::none)
  {
    StageParameters stage = stage_with({ "hold" }, damping);
    stage.pattern         = PatternParameters{ { "gravity" },
                                       "mean",
                                       TimeFunction(control, "./") };
    return stage;
  }

  std::vector<LoadParameters> held_and_pushed()
  {
    return { motion("hold", "bottom", "0", "0"), gravity("9.81", "0") };
  }

  double factor(const State<2> &state)
  {
    return state.get<LoadPatternState>().factor;
  }

  /** Mean displacement x by mass above the foot, which is held [m]. */
  double mean_x(const Model<2> &model, const State<2> &state)
  {
    double mass = 0., sum = 0.;
    for (unsigned int i = 0; i < state.nodes.size(); ++i)
    {
      if (state.nodes[i].X[1] == 0.)
        continue;
      mass += model.mass()[i];
      sum += model.mass()[i] * state.nodes[i].u[0];
    }
    return sum / mass;
  }

  double total_mass(const Model<2> &model)
  {
    double mass = 0.;
    for (const double m : model.mass())
      mass += m;
    return mass;
  }
} // namespace

TEST(LoadPattern, ControlIsExactWithAnyDamping)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  for (const DampingType damping :
       { DampingType::none, DampingType::local, DampingType::adaptive })
  {
    TestRun run(mesh, two_blocks(), held_and_pushed());
    run.begin(pushed("1e-3 * t", damping));
    for (unsigned int i = 0; i < 200; ++i)
    {
      run.step(1);
      ASSERT_NEAR(mean_x(run.model, run.state), 1e-3 * run.state.time, 1e-18);
    }
    EXPECT_GT(factor(run.state), 0.);
  }
}

TEST(LoadPattern, GravityOfAPatternIsThereAtOnce)
{
  // Gravity grows where it begins in a static stage; a pattern has its loads in
  // full, whether that stage has them or not.
  for (const bool acts_before : { false, true })
  {
    TestRun run(make_stack(3, 2), two_blocks(), held_and_pushed());
    std::vector<std::string> loads = { "hold" };
    if (acts_before)
      loads.push_back("gravity");
    StageParameters rest = stage_with(loads, DampingType::local);
    rest.end             = StageEnd::static_ratio;
    run.begin(rest);
    run.step(10);
    const double start = mean_x(run.model, run.state);
    const double begun = run.state.time;
    run.begin(pushed("1e-3 * t", DampingType::local), 0.5, &rest);
    run.step(100);
    EXPECT_NEAR(mean_x(run.model, run.state) - start,
                1e-3 * (run.state.time - begun), 1e-15);
  }
}

TEST(LoadPattern, SupportsTakeTheLoadAndEnergyIsKept)
{
  TestRun run(make_stack(3, 2), two_blocks(), held_and_pushed());
  run.begin(pushed("1e-3 * t"), 0.98);
  const double weight = g * total_mass(run.model);
  double held         = 0.;
  for (const unsigned int node : run.nodes_at_height(0.))
    held += g * run.model.mass()[node];
  double largest = 0.;
  for (unsigned int i = 0; i < 3000; ++i)
  {
    const double before = factor(run.state);
    run.solver.step(run.state, { true, false });
    const Energies &energies = run.solver.energies();
    if (i < 2)
      continue;
    largest = std::max(largest,
                       std::abs(energies.residual()) / energies.throughput());
    // The mean acceleration is zero, so there is no inertia in the balance. On
    // held nodes the factor is that of the step before.
    const double now = factor(run.state);
    ASSERT_NEAR(run.solver.resultant("hold")[0],
                -now * (weight - held) - before * held,
                1e-6 * std::abs(now) * weight + 1e-2);
  }
  EXPECT_LT(largest, 1e-9);
}

TEST(LoadPattern, WorkWithLocalDampingIsThatOfTheFactor)
{
  TestRun run(make_stack(3, 2), two_blocks(), held_and_pushed());
  const std::string slowly = "1e-4 * if(t < 0.01, t^2 / 0.02, t - 0.005)";
  run.begin(pushed(slowly, DampingType::local), 0.5);
  const double weight = g * total_mass(run.model);
  double held         = 0.;
  for (const unsigned int node : run.nodes_at_height(0.))
    held += g * run.model.mass()[node];
  double work = 0., before = 0., moved = 0.;
  while (run.state.time < 0.05)
  {
    run.solver.step(run.state, { true, false });
    // A step computes the factor at its start.
    const double now
        = run.solver.stage_loads().pattern->target(run.state.time - run.dt());
    work
        += 0.5 * (weight - held) * (before + factor(run.state)) * (now - moved);
    before = factor(run.state);
    moved  = now;
  }
  const Energies &energies = run.solver.energies();
  EXPECT_NEAR(energies.external, work, 1e-6 * work);
  EXPECT_LT(std::abs(energies.residual()), 1e-4 * energies.throughput());
}

TEST(LoadPattern, TurnsRigidBlocksByTheMomentOfItsLoads)
{
  MeshData<2> data  = grid(2, 4, "block", 0., 0.);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  ModelParameters parameters;
  MaterialParameters stone = material("block", 2000.);
  stone.rigid              = true;
  stone.elastic            = LinearElastic{ 2000., 0., 0. };
  parameters.materials     = { stone };
  auto load                = gravity("9.81", "0");
  load.distribution        = SpaceTimeFunction("y", "./", 3);
  TestRun run(mesh, parameters, { load });
  StageParameters stage = pushed("0.1 * t");
  stage.loads.clear();
  run.solver.begin_stage(stage, nullptr, run.state);
  run.solver.set_time_step(1e-3);
  run.step(1);
  // From rest a free body moves with f and m in the ratio of its inertias: the
  // resultant is a sixth of the height h above the centroid, and the inertia by
  // the mass (h^2 + b^2)/12.
  constexpr double h = 4., b = 2.;
  const auto &rigid = run.state.get<RigidBlockStates>()[0];
  EXPECT_NEAR(rigid.velocity[2] / rigid.velocity[0], -2. * h / (h * h + b * b),
              1e-12);
  EXPECT_NEAR(rigid.velocity[1], 0., 1e-15);
  for (unsigned int i = 0; i < 500; ++i)
  {
    run.step(1);
    // The error of a step, of second order in its rotation, is made good in
    // the next one.
    const double w
        = run.solver.stage_loads().pattern->displacement(run.state.nodes);
    ASSERT_NEAR(w, 0.1 * run.state.time, 1e-7);
  }
}

TEST(LoadPattern, GoesOnWithItsFactorInTheNextStage)
{
  TestRun run(make_stack(3, 2), two_blocks(), held_and_pushed());
  StageParameters stage = pushed("1e-4 * if(t < 0.01, t^2 / 0.02, t - 0.005)",
                                 DampingType::local);
  run.begin(stage);
  run.step(2000);
  const double last = factor(run.state), moved = mean_x(run.model, run.state);
  stage.pattern->control = TimeFunction("0", "./");
  run.begin(stage, 0.8, &stage);
  run.step(2000);
  EXPECT_NEAR(mean_x(run.model, run.state), moved, 1e-15);
  EXPECT_NEAR(factor(run.state), last, 0.05 * last);
  const StageParameters other = stage_with({ "hold" }, DampingType::local);
  run.begin(other, 0.8, &stage);
  EXPECT_EQ(factor(run.state), 0.);
}

TEST(LoadPattern, ImplicitFactorIsTheLoadOfTheSameDisplacement)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  // Of a vertical displacement, which is not along the loads.
  const double wanted = 1e-5;
  ImplicitRun run(mesh, two_blocks(), held_and_pushed());
  const unsigned int node              = nodes_at(run.nodes, 0., 4.).front();
  run.solver.loads().controls["stage"] = { { node, 1, 1. } };
  const StageParameters stage          = pushed("1e-5 * t");
  run.solver.begin_stage(stage, nullptr, run.state);
  run.finish();
  EXPECT_NEAR(run.state.nodes[node].u[1], wanted, 1e-11);

  const double found = factor(run.state);
  std::ostringstream pull;
  pull.precision(17);
  pull << g * found;
  ImplicitRun other(
      mesh, two_blocks(),
      { motion("hold", "bottom", "0", "0"), gravity(pull.str(), "0") });
  other.begin({ "hold", "gravity" });
  other.finish();
  EXPECT_NEAR(other.state.nodes[node].u[1], wanted, 1e-5 * wanted);
  EXPECT_NEAR(run.solver.resultant("hold")[0],
              -found * g * total_mass(run.model),
              1e-5 * found * g * total_mass(run.model));
  const Energies &energies = run.solver.energies();
  EXPECT_LT(std::abs(energies.residual()), 1e-4 * energies.throughput());
}

// What is controlled may move little where blocks that nothing holds go far.
TEST(LoadPattern, ImplicitStepsMoveATwentiethOfTheModelAtMost)
{
  ImplicitParameters numbers;
  numbers.first_step = numbers.largest_step = 1.;
  ImplicitRun run(make_stack(3, 2), two_blocks(), held_and_pushed(), numbers);
  const StageParameters stage = pushed("0.3 * t");
  run.solver.begin_stage(stage, nullptr, run.state);
  const double most = 0.05 * run.model.nodes().table().diagonal();
  while (!run.solver.has_ended(run.state))
  {
    const auto before = run.state.nodes;
    run.solver.step(run.state);
    for (unsigned int i = 0; i < before.size(); ++i)
      EXPECT_LE(std::abs(run.state.nodes[i].u[0] - before[i].u[0]), most);
  }
  EXPECT_NEAR(mean_x(run.model, run.state), 0.3, 1e-6);
}
