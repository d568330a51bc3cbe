// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "test_models.h"

#include <quoin/motions/platen.h>
#include <quoin/results/field_output.h>
#include <quoin/dynamics/state_checks.h>
#include <quoin/model/block_placement.h>
#include <quoin/base/exceptions.h>
#include <quoin/blocks/cell_states.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  using Outside = ContactParameters::Outside;

  /** The stack without a joint, the upper block higher and to the right. */
  BlockMesh<2> make_parted_stack(const double gap, const double right = 0.)
  {
    MeshData<2> data     = grid(2, 1, "lower", 0., 0.);
    const unsigned int n = data.vertices.size();
    add_grid(data, 2, 2, "upper", 0., 1.);
    for (unsigned int v = n; v < data.vertices.size(); ++v)
      data.vertices[v] += dealii::Point<2>(right, gap);
    return split_into_blocks(data, {});
  }

  JointSetParameters touching()
  {
    JointSetParameters set = elastic_joint(1e9, 1e9);
    set.name               = "touch";
    set.curves.clear();
    set.all_new_contacts  = true;
    coulomb_law(set).peak = coulomb_law(set).residual = { 0., 0.5, 0. };
    return set;
  }

  ModelParameters in_box(const std::array<double, 4> &box,
                         const Outside outside, const bool rigid = false)
  {
    ModelParameters parameters = two_blocks();
    for (MaterialParameters &material : parameters.materials)
      material.rigid = rigid;
    parameters.joints                      = { touching() };
    parameters.large_displacements         = true;
    parameters.contact.large_displacements = true;
    parameters.contact.has_box             = true;
    parameters.contact.box                 = box;
    parameters.contact.outside             = outside;
    return parameters;
  }

  LoadParameters held(const std::string &group)
  {
    const LoadComponent still = component(LoadQuantity::velocity, "0");
    return platen("held", group, still, still, still);
  }

  /** Throws the upper block with spin; a deformable one vibrates, too. */
  void throw_upper(TestRun &run, const double x, const double y,
                   const double spin)
  {
    if (run.model.nodes().table().is_rigid[1])
    {
      double *v = run.state.get<RigidBlockStates>()[1].velocity;
      v[0]      = x;
      v[1]      = y;
      v[2]      = spin;
      return;
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    const NodeRange range = block_nodes(run.model, 1);
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      const dealii::Tensor<1, 2> &X = run.state.nodes[i].X;
      run.state.velocity[i]
          = dealii::Point<2>(x - spin * (X[1] - 2.) + uniform(random),
                             y + spin * (X[0] - 1.) + uniform(random));
    }
  }

  /** Moves the whole model as it is. */
  void shift(TestRun &run, const double y)
  {
    for (NodeRecord<2> &node : run.state.nodes)
      node.u[1] += y;
    for (RigidBlockState &rigid : run.state.get<RigidBlockStates>())
      rigid.displacement[1] += y;
  }

  /** One step, after which blocks outside the box are found. */
  std::vector<BlockOutside> step_and_check(TestRun &run)
  {
    run.solver.step(run.state, { true, true });
    return run.solver.take_blocks_outside();
  }

  /** Steps until blocks are found outside. */
  std::vector<BlockOutside> step_until_outside(TestRun &run,
                                               const unsigned int limit = 20000)
  {
    for (unsigned int i = 0; i < limit; ++i)
    {
      run.solver.step(run.state, { true, i % 10 == 0 });
      const auto found = run.solver.take_blocks_outside();
      if (!found.empty())
        return found;
    }
    return {};
  }

  void expect_words(const std::string &text,
                    const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      EXPECT_NE(text.find(word), std::string::npos)
          << "no '" << word << "' in: " << text;
  }
} // namespace

TEST(ModelBox, DeletedBlockTakesItsEnergyAlong)
{
  for (const std::string kind : { "elastic", "yielding", "rigid" })
  {
    ModelParameters parameters
        = in_box({ { -1., -1., 3., 6. } }, Outside::remove, kind == "rigid");
    if (kind == "yielding")
      parameters.materials[1].strength = MohrCoulombStrength{ 1e5, 0., 0. };
    TestRun run(make_parted_stack(0.2), parameters,
                { held("lower"), gravity("0", "-9.81") });
    run.begin(stage_with({ "held", "gravity" }), 0.5);
    throw_upper(run, 1., 20., 2.);
    run.solver.step(run.state, { true, false });
    const double start   = run.solver.energies().residual();
    const double initial = run.solver.energies().kinetic;
    const auto found     = step_until_outside(run);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].block, 1U);
    EXPECT_TRUE(found[0].removed);
    EXPECT_EQ(run.state.energy.plastic > 0., kind == "yielding");
    EXPECT_GT(found[0].position[1], 6.);
    EXPECT_LT(found[0].position[1], 9.);
    EXPECT_EQ(run.state.block_marks[1], block_mark::removed);

    // What is left is at rest, without strain, and stays so.
    const NodeRange range = block_nodes(run.model, 1);
    const State<2> then   = run.state;
    for (unsigned int i = 0; i < 300; ++i)
    {
      run.solver.step(run.state, { true, i % 100 == 0 });
      const Energies &energies = run.solver.energies();
      EXPECT_EQ(energies.kinetic, 0.);
      EXPECT_EQ(energies.joint, 0.);
      EXPECT_NEAR(energies.residual(), start,
                  (kind == "yielding" ? 1e-8 : 1e-9) * initial)
          << kind;
    }
    EXPECT_LT(run.solver.energies().strain, 1e-12 * initial);
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        EXPECT_EQ(run.state.nodes[i].u[d], then.nodes[i].u[d]);
        EXPECT_EQ(run.state.velocity[i][d], 0.);
      }
    EXPECT_TRUE(run.solver.take_blocks_outside().empty());
  }
}

TEST(ModelBox, DeletedBlockTouchesNothing)
{
  // The upper block is pressed into the lower one, which is deleted.
  for (const bool rigid : { false, true })
  {
    TestRun run(make_parted_stack(-1e-4, 0.3),
                in_box({ { -1., 0.5, 3., 9. } }, Outside::remove, rigid), {});
    // What contacts did in the half step before is lost: a short one.
    run.begin(stage_with({}), 0.02);
    run.solver.step(run.state, { true, true });
    const double start  = run.solver.energies().residual();
    const double stored = run.solver.energies().joint;
    const double lost   = run.solver.energies().contact;
    EXPECT_GT(stored, 1.);
    EXPECT_TRUE(run.solver.take_blocks_outside().empty());
    shift(run, -0.6);
    const auto found = step_and_check(run);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].block, 0U);
    EXPECT_TRUE(found[0].removed);
    EXPECT_TRUE(run.state.get<ContactState>().pairs.empty());
    EXPECT_EQ(run.solver.energies().joint, 0.);
    EXPECT_NEAR(run.solver.energies().contact - lost, stored, 1e-2 * stored);
    EXPECT_NEAR(run.solver.energies().residual(), start, 1e-2 * stored);

    // No force is left on the other: its momentum stays.
    const auto momentum = [&]()
    {
      double sum            = 0.;
      const NodeRange range = block_nodes(run.model, 1);
      for (std::size_t i = range.begin; i < range.end; ++i)
        sum += run.model.mass()[i] * run.state.velocity[i][1];
      return sum;
    };
    const double then = momentum();
    EXPECT_GT(then, 0.);
    run.step(100);
    EXPECT_NEAR(momentum(), then, 1e-9 * then);
  }
}

TEST(ModelBox, JointedBlocksLeaveTogether)
{
  BlockMesh<2> mesh = make_stack(2, 2);
  ModelParameters parameters
      = in_box({ { -1., -1., 3., 2.5 } }, Outside::remove);
  parameters.joints.push_back(elastic_joint(2e10, 1e10));
  TestRun run(mesh, parameters, {});
  run.begin(stage_with({}), 0.5);
  EXPECT_TRUE(step_and_check(run).empty());
  shift(run, 0.6);
  auto found = step_and_check(run);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].block, 1U);
  EXPECT_FALSE(found[0].removed);
  EXPECT_EQ(run.state.block_marks[1], block_mark::left_box);
  EXPECT_TRUE(step_and_check(run).empty());

  // A strained joint: its energy goes, too.
  run.state.nodes[mesh.block_first_vertex[1]].u[1] += 1e-4;
  shift(run, 2.5);
  found = step_and_check(run);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].removed && found[1].removed);
  EXPECT_EQ(run.solver.energies().joint, 0.);
  EXPECT_EQ(run.solver.energies().strain, 0.);
  EXPECT_LT(run.solver.energies().external, -1.);
  EXPECT_TRUE(step_and_check(run).empty());
}

TEST(ModelBox, BlocksThatLoadsMoveStay)
{
  BlockMesh<2> mesh                       = make_parted_stack(0.2);
  const std::vector<LoadParameters> loads = { held("upper") };
  TestRun run(mesh, in_box({ { -1., -1., 3., 2.5 } }, Outside::remove), loads);
  run.begin(stage_with({ "held" }), 0.5);
  shift(run, 2.);
  // As a platen it remembers where it is.
  run.state.get<PlatenState>("held").displacement[1] = 2.;
  auto found                                         = step_and_check(run);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].removed);
  // Free now, so it goes.
  run.begin(stage_with({}), 0.5);
  found = step_and_check(run);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].removed);

  // Free only until the next stage.
  const std::vector<StageParameters> stages
      = { stage_with({}), stage_with({ "held" }) };
  ExplicitSolver<2> solver(run.model, loads, stages);
  State<2> state = run.model.initial_state();
  solver.begin_stage(stages[0], nullptr, state);
  solver.set_time_step(0.5 * solver.critical_step().length);
  for (NodeRecord<2> &node : state.nodes)
    node.u[1] += 2.;
  solver.step(state, { true, true });
  found = solver.take_blocks_outside();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].removed);
}

TEST(ModelBox, DeletedBlocksStayDeletedInTheNextStageAndWhenResumed)
{
  for (const bool rigid : { false, true })
  {
    BlockMesh<2> mesh = make_parted_stack(0.2);
    const auto parameters
        = in_box({ { -1., -1., 3., 3.4 } }, Outside::remove, rigid);
    const std::vector<LoadParameters> loads
        = { held("lower"), gravity("0", "-9.81") };
    const StageParameters first = stage_with({ "held", "gravity" });
    StageParameters second      = stage_with({ "gravity" }, DampingType::local);
    TestRun run(mesh, parameters, loads);
    run.begin(first, 0.5);
    throw_upper(run, 0., 20., 1.);
    ASSERT_EQ(step_until_outside(run).size(), 1U);
    const NodeRecord<2> there = run.state.nodes[mesh.block_first_vertex[1]];

    run.begin(second, 0.4, &first);
    run.step(20);
    TestRun resumed(mesh, parameters, loads);
    resumed.state = run.state;
    resumed.solver.resume_stage(second, &first, resumed.state);
    resumed.solver.set_time_step(run.dt());
    for (TestRun *each : { &run, &resumed })
      each->step(200, true);
    for (unsigned int i = 0; i < mesh.n_vertices(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        EXPECT_EQ(run.state.nodes[i].u[d], resumed.state.nodes[i].u[d]);
        EXPECT_EQ(run.state.velocity[i][d], resumed.state.velocity[i][d]);
      }
    EXPECT_EQ(run.state.energy.external, resumed.state.energy.external);
    const NodeRecord<2> &here = run.state.nodes[mesh.block_first_vertex[1]];
    EXPECT_EQ(here.u[0], there.u[0]);
    EXPECT_EQ(here.u[1], there.u[1]);
    EXPECT_LT(run.state.nodes[0].u[1], -1e-6);
  }
}

TEST(ModelBox, DeletedBlocksAreNotWritten)
{
  BlockMesh<2> mesh = make_parted_stack(0.2);
  TestRun run(mesh, in_box({ { -1., 0.5, 3., 9. } }, Outside::remove), {});
  run.begin(stage_with({}), 0.5);
  shift(run, -0.6);
  run.state.nodes.back().u[0] = 1e-3;
  ASSERT_EQ(step_and_check(run).size(), 1U);
  const BlockFields<2> fields = block_fields(run.model, run.state);
  EXPECT_EQ(fields.position.size(), block_nodes(run.model, 1).size());
  EXPECT_EQ(fields.displacement.size(), fields.position.size());
  EXPECT_EQ(fields.velocity.size(), fields.position.size());
  ASSERT_EQ(fields.cells.size(), 8U);
  EXPECT_EQ(fields.block, std::vector<std::int32_t>(8, 1));
  EXPECT_EQ(fields.material, std::vector<std::int32_t>(8, 1));
  for (unsigned int c = 0; c < 8; ++c)
  {
    const unsigned int cell = mesh.block_first_cell[1] + c;
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto &p = fields.position[fields.cells[c][k]];
      EXPECT_EQ(p[0], mesh.vertices[mesh.cells[cell][k]][0]);
      EXPECT_EQ(p[1], mesh.vertices[mesh.cells[cell][k]][1]);
    }
    EXPECT_EQ(fields.stress[c], cell_stress(run.model.blocks(),
                                            run.state.nodes.data(), {}, cell));
  }
}

TEST(ModelBox, ReportsOnceAndGoesOn)
{
  TestRun run(make_parted_stack(0.2),
              in_box({ { -1., -1., 3., 4. } }, Outside::report),
              { held("lower") });
  run.begin(stage_with({ "held" }), 0.5);
  throw_upper(run, 0., 20., 0.);
  const auto found = step_until_outside(run);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].removed);
  EXPECT_GT(found[0].time, 0.);
  const double before = run.solver.energies().kinetic;
  EXPECT_TRUE(step_until_outside(run, 100).empty());
  EXPECT_GT(run.solver.energies().kinetic, 0.9 * before);
}

TEST(ModelBox, StopsIfAsked)
{
  TestRun run(make_parted_stack(0.2),
              in_box({ { -1., -1., 3., 4. } }, Outside::stop),
              { held("lower") });
  run.begin(stage_with({ "held" }), 0.5);
  throw_upper(run, 0., 20., 0.);
  expect_words(
      message_of<RunError>([&]() { step_until_outside(run); }),
      { "block 1", "Box = -1, -1, 3, 4", "time", "step", "Outside the box" });
}

TEST(ModelBox, MustHoldTheModelAtFirst)
{
  BlockMesh<2> mesh = make_parted_stack(0.2);
  expect_words(
      message_of<InputError>(
          [&]() {
            TestRun run(mesh,
                        in_box({ { -1., -1., 3., 1.1 } }, Outside::report), {});
          }),
      { "section 'Contact'", "Box = -1, -1, 3, 1.1", "(0, 1.2)",
        "whole model" });
}

TEST(ModelBox, CellsInsideOutAreFound)
{
  for (const bool large : { false, true })
  {
    BlockMesh<2> mesh          = make_stack(2, 2);
    ModelParameters parameters = two_blocks();
    if (large)
    {
      parameters = in_box({ { -9., -9., 9., 9. } }, Outside::report);
      parameters.joints.push_back(elastic_joint(2e10, 1e10));
    }
    TestRun run(mesh, parameters, {});
    run.begin(stage_with({}), 0.1);
    check_cells(run.model, run.state, {});
    // Turned and stretched is no harm.
    for (NodeRecord<2> &node : run.state.nodes)
    {
      node.u[0] = -1.2 * node.X[1] - node.X[0];
      node.u[1] = 0.8 * node.X[0] - node.X[1];
    }
    check_cells(run.model, run.state, {});
    for (NodeRecord<2> &node : run.state.nodes)
      node.u[0] = node.u[1] = 0.;
    run.step(1);
    run.state.nodes[run.node(2., 0.)].u[0] = -1.5;
    run.state.nodes[run.node(2., 0.)].u[1] = 1.5;
    expect_words(message_of<RunError>([&]() { run.step(1, true); }),
                 { "block 0", "inside out", "time", "step 1",
                   "Normal stiffness", "refine", "Share of critical" });
  }
}

TEST(ModelBox, CellsInsideOutAreOfTheMeshOrOfTheLoads)
{
  BlockMesh<2> mesh = make_stack(2, 2);
  TestRun run(mesh, two_blocks(), {});
  run.begin(stage_with({}), 0.1);
  const unsigned int corner = run.node(2., 0.);
  const auto message        = [&]()
  {
    return message_of<ModelFailure>(
        [&]() {
          check_cells(run.model, run.state, { "weight", "push" });
        });
  };
  run.state.nodes[corner].u[0] = -1.5;
  run.state.nodes[corner].u[1] = 1.5;
  expect_words(message(), { "block 0", "Initial motion" });
  run.state.nodes[corner].u[0] = run.state.nodes[corner].u[1] = 0.;
  run.step(1);
  run.state.nodes[corner].u[0] = -1.5;
  run.state.nodes[corner].u[1] = 1.5;
  expect_words(message(), { "block 0", "crushed",
                            "loads of this stage are "
                            "weight, push",
                            "End conditions" });
  // Halves of squares of 1 m by 0.05 m: heights of 0.05 m on edges of 1 m.
  for (NodeRecord<2> &node : run.state.nodes)
    node.X[1] *= 0.05;
  expect_words(message(), { "block 0", "smallest height is only 4.9",
                            "% of its longest edge", "the mesh is the" });
}

TEST(ModelBox, TheNodeThatMovedFarthest)
{
  TestRun run(make_stack(2, 2), two_blocks(), {});
  run.begin(stage_with({}), 0.1);
  EXPECT_EQ(farthest_node(run.model, run.state).distance, 0.);
  const unsigned int far = run.node(2., 4.), near = run.node(0., 0.);
  run.state.nodes[near].u[0]  = -4.;
  run.state.nodes[far].u[0]   = 3.;
  run.state.nodes[far].u[1]   = -4.;
  run.state.velocity[far][0]  = 1.;
  run.state.velocity[far][1]  = 2.;
  const FarthestNode<2> found = farthest_node(run.model, run.state);
  EXPECT_EQ(found.block, 1U);
  EXPECT_DOUBLE_EQ(found.distance, 5.);
  EXPECT_DOUBLE_EQ(found.speed, -1.);
  EXPECT_EQ(found.before[1], 4.);
  EXPECT_EQ(found.now[0], 5.);
  // What has been deleted is where it was when that happened.
  run.state.block_marks = { block_mark::present, block_mark::removed };
  EXPECT_EQ(farthest_node(run.model, run.state).distance, 4.);
}
