// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/joint_elements/joint_changes.h>
#include <quoin/operators/archive.h>
#include <quoin/results/cable_output.h>
#include <quoin/results/field_output.h>
#include <quoin/results/point_values.h>
#include <quoin/results/result_origin.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** Two blocks of 3 m x 2 m, one on the other, of which the upper one has
      moved by 0.25 m to the right. */
  struct MovedBlocks
  {
    MovedBlocks() : run(make_stack(3, 2), two_blocks(), {}), state(run.state)
    {
      state.add<ResultOrigin<2>>();
      move(0.25);
    }

    void move(const double to)
    {
      for (unsigned int i = 0; i < state.nodes.size(); ++i)
        if (run.model.nodes().block_of_node(i) == 1)
          state.nodes[i].u[0] = to;
    }

    /** Displacement of the upper block in fields; all nodes must agree. */
    double displacement() const
    {
      const BlockFields<2> fields = block_fields(run.model, state);
      double result               = 0.;
      for (std::size_t i = 0; i < fields.position.size(); ++i)
      {
        const double u = fields.displacement[i][0];
        if (u != 0.)
        {
          EXPECT_TRUE(result == 0. || result == u);
          result = u;
        }
      }
      return result;
    }

    TestRun run;
    State<2> &state;
  };
} // namespace

TEST(ResultOrigin, FieldsCountFromItAndStandWhereTheBlocksAre)
{
  MovedBlocks blocks;
  const BlockFields<2> whole = block_fields(blocks.run.model, blocks.state);
  const double slip = joint_fields(blocks.run.model, blocks.state).slip.front();
  EXPECT_DOUBLE_EQ(std::abs(slip), 0.25);
  count_from(blocks.run.model, { true, true, false }, blocks.state);
  blocks.move(0.375);
  EXPECT_DOUBLE_EQ(blocks.displacement(), 0.125);

  const BlockFields<2> since = block_fields(blocks.run.model, blocks.state);
  for (std::size_t i = 0; i < since.position.size(); ++i)
  {
    EXPECT_EQ(since.earlier_displacement[i], whole.displacement[i]);
    EXPECT_DOUBLE_EQ(since.position[i][0],
                     whole.position[i][0] + whole.displacement[i][0]);
  }
  const JointFields joints = joint_fields(blocks.run.model, blocks.state);
  for (std::size_t p = 0; p < joints.slip.size(); ++p)
  {
    EXPECT_DOUBLE_EQ(joints.slip[p], 0.5 * slip);
    EXPECT_DOUBLE_EQ(joints.earlier_slip[p], slip);
    // of the middle of both sides
    EXPECT_DOUBLE_EQ(joints.displacement[p][0], 0.0625);
    EXPECT_DOUBLE_EQ(joints.earlier_displacement[p][0], 0.125);
  }
}

namespace
{
  /** A displacement that is linear in the mesh [m]. */
  dealii::Tensor<1, 2> linear_displacement(const dealii::Tensor<1, 2> &X)
  {
    return dealii::Point<2>(0.01 + 0.02 * X[0] - 0.03 * X[1],
                            -0.04 + 0.05 * X[0] + 0.06 * X[1]);
  }

  /** As if a stage had reset displacements where they were linear. */
  void set_linear_origin(const NodeMap<2> &nodes, State<2> &state)
  {
    auto &origin = state.add<ResultOrigin<2>>().displacement;
    origin.resize(state.nodes.size());
    for (unsigned int i = 0; i < state.nodes.size(); ++i)
      origin[i] = linear_displacement(nodes.point(i));
  }

  void expect_near(const dealii::Tensor<1, 2> &a, const dealii::Tensor<1, 2> &b)
  {
    EXPECT_NEAR((a - b).norm(), 0., 1e-12);
  }
} // namespace

TEST(ResultOrigin, ContactsCountFromItAsTheBlocksDo)
{
  const BlockMesh<2> mesh                = make_stack(3, 2);
  ModelParameters parameters             = two_blocks();
  JointSetParameters &joint              = parameters.joints[0];
  joint.all_new_contacts                 = true;
  coulomb_law(joint).peak                = { 0., 0.3, 0. };
  coulomb_law(joint).residual            = { 0., 0.3, 0. };
  parameters.large_displacements         = true;
  parameters.contact.large_displacements = true;
  const auto still = component(LoadQuantity::velocity, "0");
  TestRun run(
      mesh, parameters,
      { platen("held", "lower", still, still, still),
        platen("driven", "upper", component(LoadQuantity::velocity, "0.05"),
               still, still) });
  for (unsigned int i = 0; i < run.state.nodes.size(); ++i)
    if (run.nodes->block_of_node(i) == 1)
      run.state.nodes[i].u[1] = -1e-5;
  run.begin(stage_with({ "held", "driven" }));
  while (run.state.get<JointHistory>().handed_over[0] == 0
         && run.state.nodes[run.node(3., 4.)].u[0] < 0.02)
    run.step(1);
  run.step(1);
  ASSERT_NE(run.state.get<JointHistory>().handed_over[0], 0);
  const auto fields = [&]()
  {
    return contact_fields(run.model.joints(), *run.model.contacts(), run.state);
  };
  const JointFields whole = fields();
  ASSERT_FALSE(whole.position.empty());
  EXPECT_TRUE(whole.earlier_displacement.empty());
  set_linear_origin(*run.nodes, run.state);
  const JointFields since = fields();
  ASSERT_EQ(since.position.size(), whole.position.size());
  ASSERT_EQ(since.earlier_displacement.size(), whole.position.size());
  for (std::size_t p = 0; p < since.position.size(); ++p)
  {
    const dealii::Tensor<1, 2> earlier = linear_displacement(whole.position[p]);
    expect_near(since.earlier_displacement[p], earlier);
    expect_near(since.displacement[p], whole.displacement[p] - earlier);
    expect_near(since.position[p], whole.position[p] + earlier);
  }
}

TEST(ResultOrigin, BarsCountFromItAsTheBlocksDo)
{
  BlockMesh<2> mesh = make_stack(2, 2);
  const dealii::Point<2> head(0.3, 3.7), far(1.6, 0.2);
  CableParameters cable;
  cable.element_length       = 0.25;
  cable.name                 = "bar";
  cable.bars                 = { { { head, far } } };
  cable.law.stiffness        = 1e8;
  cable.law.bond_stiffness   = 1e9;
  cable.law.active_length    = 0.1;
  ModelParameters parameters = two_blocks();
  parameters.cables          = { cable };
  const BlockTriangulation<2> blocks(
      mesh, std::vector<unsigned int>(mesh.n_cells(), 0),
      std::vector<bool>(mesh.n_blocks(), false), MPI_COMM_SELF);
  const NodeMap<2> nodes(blocks,
                         std::vector<NodeMap<2>::Segment>{ { { head, far } } });
  const Model<2> model(nodes, parameters);
  State<2> state = model.initial_state();
  model.reinforcement().begin_stage("first", true, 0., state);
  EXPECT_TRUE(earlier_displacement(model.reinforcement(), state).empty());
  set_linear_origin(nodes, state);
  const auto earlier = earlier_displacement(model.reinforcement(), state);
  const auto places  = cable_fields(model.reinforcement(), state).position;
  ASSERT_FALSE(places.empty());
  ASSERT_EQ(earlier.size(), places.size());
  for (std::size_t p = 0; p < places.size(); ++p)
    expect_near(earlier[p], linear_displacement(places[p]));
}

TEST(JointFields, TheInelasticSlipHasNothingOfInitialStresses)
{
  MovedBlocks blocks;
  const auto inelastic = [&]()
  {
    const auto fields = joint_fields(blocks.run.model, blocks.state).of_laws;
    EXPECT_EQ(fields.back().first, "inelastic slip");
    return fields.back().second;
  };
  const double none = 0.;
  for (const double slip : inelastic())
    EXPECT_EQ(slip, none);
  const JointFaceStress<2> stress
      = { { { { 0., -2e6, 1e6 } }, { { 0., -2e6, 1e6 } } } };
  const auto &joints = blocks.run.model.joints();
  initialise_joints(joints, { joints.segments().size(), stress }, blocks.state);
  JointHistory &history = blocks.state.get<JointHistory>();
  ASSERT_NE(history.plastic_slip[0], none);
  for (const double slip : inelastic())
    EXPECT_EQ(slip, none);

  history.plastic_slip[0] += 0.125;
  EXPECT_DOUBLE_EQ(inelastic()[0], 0.125);
  history.handed_over[0] = 1;
  EXPECT_DOUBLE_EQ(std::abs(inelastic()[0]), 0.25);
}

TEST(ResultOrigin, ABlockThatComesAgainCountsFromTheMesh)
{
  MovedBlocks blocks;
  count_from(blocks.run.model, { true, true, false }, blocks.state);
  blocks.state.block_marks = { block_mark::present, block_mark::absent };
  count_from(blocks.run.model, {}, blocks.state);
  blocks.state.block_marks = { block_mark::present, block_mark::present };
  count_from(blocks.run.model, {}, blocks.state);
  EXPECT_DOUBLE_EQ(blocks.displacement(), 0.25);
  EXPECT_EQ(slip_at_origin(blocks.state, 0), 0.);
}

TEST(ResultOrigin, JointsOfPlacedBlocksCountFromThere)
{
  MovedBlocks blocks;
  const Model<2> &model = blocks.run.model;
  State<2> &state       = blocks.state;
  JointHistory &history = state.get<JointHistory>();
  for (unsigned int i = 0; i < state.nodes.size(); ++i)
    if (model.nodes().block_of_node(i) == 1)
      state.nodes[i].u[1] = 0.125;
  const double slip = joint_fields(model, state).slip.front();
  EXPECT_DOUBLE_EQ(std::abs(slip), 0.25);
  EXPECT_DOUBLE_EQ(joint_fields(model, state).opening.front(), 0.125);

  const unsigned int n = model.joints().segments().size();
  count_from_placing(model.joints(), history);
  for (unsigned int i = 0; i < n; ++i)
    begin_joint_anew(model.joints(), i, state);
  blocks.move(0.375);
  HistoryParameters wanted;
  wanted.quantity = HistoryQuantity::joint;
  HistoryPoint point;
  point.here   = true;
  point.entity = 0;
  const auto expect
      = [&](const double slips, const double opening, const double earlier)
  {
    const JointFields fields = joint_fields(model, state);
    EXPECT_DOUBLE_EQ(fields.slip.front(), slips);
    EXPECT_DOUBLE_EQ(fields.opening.front(), opening);
    EXPECT_EQ(fields.earlier_slip.empty() ? 0. : fields.earlier_slip.front(),
              earlier);
    wanted.component = 0;
    EXPECT_DOUBLE_EQ(point_value(model, wanted, point, state), opening);
    wanted.component = 1;
    EXPECT_DOUBLE_EQ(point_value(model, wanted, point, state), slips + earlier);
  };
  expect(0.5 * slip, 0., 0.);
  // Slips that are reset later count from the placing until then.
  count_from(model, { false, true, false }, state);
  blocks.move(0.5);
  expect(0.5 * slip, 0., 0.5 * slip);
  // Contacts are between the faces that met, wherever they were placed.
  std::fill(history.handed_over.begin(), history.handed_over.end(), 1);
  EXPECT_DOUBLE_EQ(joint_fields(model, state).opening.front(), 0.125);
}

TEST(ResultOrigin, OnlyJointsThatFailedSinceHaveSlipped)
{
  MovedBlocks blocks;
  State<2> &state       = blocks.state;
  JointHistory &history = state.get<JointHistory>();
  ASSERT_GE(history.state.size(), 6U);
  const auto expect = [&](const std::vector<JointState> &states)
  {
    for (unsigned int p = 0; p < states.size(); ++p)
      EXPECT_EQ(state_since_origin(state, p), states[p]) << "point " << p;
  };
  using S = JointState;
  // without an origin all is what it is
  const std::vector<S> before
      = { S::intact, S::slipped, S::slipped, S::slipping, S::open, S::slipped };
  std::copy(before.begin(), before.end(), history.state.begin());
  expect(before);

  count_from(blocks.run.model, { false, false, true }, state);
  expect({ S::intact, S::intact, S::intact, S::slipping, S::open, S::intact });
  // those that slip, open or are open, and those that were intact
  history.state[1] = S::slipping;
  history.state[2] = S::open;
  note_failed_joints(state);
  std::fill(history.state.begin(), history.state.end(), S::slipped);
  const std::vector<S> after = { S::slipped, S::slipped, S::slipped,
                                 S::slipped, S::slipped, S::intact };
  expect(after);

  // The next stage goes on, another one begins anew.
  count_from(blocks.run.model, { true, true, false }, state);
  expect(after);
  count_from(blocks.run.model, { false, false, true }, state);
  expect(std::vector<S>(6, S::intact));
}
