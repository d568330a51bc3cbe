// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/results/histories.h>
#include <quoin/results/history_points.h>
#include <quoin/mesh/block_numbering.h>

#include <cmath>

using namespace quoin;
using namespace quoin::test;

namespace
{
  HistoryParameters velocity_at(const double x, const double y)
  {
    HistoryParameters history;
    history.name     = "v";
    history.quantity = HistoryQuantity::velocity;
    history.point    = { { x, y } };
    return history;
  }

  /** Velocities at @p points where the upper of two blocks, which meet at
      y = 2 m, moves by 1 m/s and the lower one rests. */
  std::vector<double> velocities(const std::vector<HistoryParameters> &points,
                                 const bool upper_first)
  {
    BlockMesh<2> mesh = make_stack(3, 2);
    if (upper_first)
      renumber_blocks(mesh, { 1, 0 });
    TestRun run(mesh, two_blocks(), {});
    run.begin(stage_with({}));
    for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
      if (mesh.block_of_vertex(v) == (upper_first ? 0U : 1U))
        run.state.velocity[v][0] = 1.;
    Histories<2> histories(points, run.model, run.solver, BoundaryGeometry(),
                           BoundaryElementParameters(), { false, false });
    histories.before_step(run.state);
    return histories.after_step(run.state);
  }
} // namespace

TEST(Histories, AtAJointTheyAreOfOneBlockWhateverTheNumbers)
{
  const std::vector<HistoryParameters> points
      = { velocity_at(1., 2.), velocity_at(1.1, 2.05), velocity_at(1.1, 1.95),
          velocity_at(1., 4.) };
  for (const bool upper_first : { false, true })
  {
    const auto row = velocities(points, upper_first);
    ASSERT_EQ(row.size(), 5U);
    EXPECT_EQ(row[1], 0.) << "on the joint: the lower block";
    EXPECT_EQ(row[2], 1.) << "in the upper block";
    EXPECT_EQ(row[3], 0.) << "in the lower block";
    EXPECT_EQ(row[4], 1.);
  }
}

// Between two nodes of the wall, where no distance to a node is zero.
TEST(Histories, OnAWallTheyAreOfTheBlockThatIsThereLonger)
{
  using Q = HistoryQuantity;
  TestRun run(make_stack(3, 2), two_blocks(), {});
  HistoryParameters wanted;
  // Absent in the end, and placed by a stage.
  for (const double missing : { 2.5, 0.5 })
    for (const double x : { 0.2, 0.5, 0.8, 1.3, 2., 2.7 })
      for (const unsigned int goes : { 0U, 1U })
      {
        std::vector<double> absence(2, 0.);
        absence[goes]         = missing;
        wanted.point          = { { x, 2. } };
        wanted.quantity       = Q::displacement;
        const HistoryPoint at = find_history_point(run.model, wanted, absence);
        ASSERT_FALSE(at.nodes.empty());
        for (const auto &[node, weight] : at.nodes)
        {
          if (std::abs(weight) < 1e-12)
            continue;
          EXPECT_EQ(run.model.nodes().block_of_node(node), 1 - goes)
              << "at x = " << x;
        }
        wanted.quantity = Q::stress;
        const unsigned int cell
            = find_history_point(run.model, wanted, absence).entity;
        EXPECT_EQ(run.model.nodes().blocks().block_of_cell(cell), 1 - goes)
            << "at x = " << x;
      }
}

// Beside the wall of a lining the node of the wall is the nearest.
TEST(Histories, InABlockThatIsPlacedTheyAreOfIt)
{
  const BlockMesh<2> mesh = make_stack(3, 2);
  TestRun run(mesh, two_blocks(), {});
  HistoryParameters wanted;
  wanted.quantity = HistoryQuantity::displacement;
  for (const unsigned int placed : { 0U, 1U })
  {
    std::vector<double> absence(2, 0.);
    absence[placed]       = 0.5;
    wanted.point          = { { 1.02, placed == 0 ? 1.97 : 2.03 } };
    const HistoryPoint at = find_history_point(run.model, wanted, absence);
    ASSERT_FALSE(at.nodes.empty());
    for (const auto &[node, weight] : at.nodes)
      EXPECT_EQ(run.model.nodes().block_of_node(node), placed);
  }
  // Cells of the other block may be nearer.
  wanted.quantity = HistoryQuantity::stress;
  for (const unsigned int placed : { 0U, 1U })
    for (const double depth : { 0.001, 0.3 })
    {
      std::vector<double> absence(2, 0.);
      absence[placed]       = 0.5;
      wanted.point          = { { 1.02, 2. + (placed == 0 ? -depth : depth) } };
      const HistoryPoint at = find_history_point(run.model, wanted, absence);
      EXPECT_EQ(run.model.nodes().blocks().block_of_cell(at.entity), placed);
    }
}

TEST(Histories, WhereAJointCrossesAWallTheyAreOfThePartThatIsThereLonger)
{
  MeshData<2> data;
  for (const unsigned int j : { 0U, 1U })
    for (const unsigned int i : { 0U, 1U })
    {
      const double x = 2. * i, y = 2. * j;
      add_grid(data, 2, 2, i == 0 ? "lower" : "upper", x, y);
      if (j == 1)
        add_curve(data, "bed", x, y, x + 2., y);
      if (i == 1)
        add_curve(data, "wall", x, y, x, y + 2.);
    }
  const BlockMesh<2> mesh    = split_into_blocks(data, {});
  ModelParameters parameters = two_blocks();
  parameters.joints
      = { elastic_joint(2e10, 1e10, "bed"), elastic_joint(2e10, 1e10, "wall") };
  TestRun run(mesh, parameters, {});
  const NodeMap<2> &nodes = run.model.nodes();
  HistoryParameters wanted;
  wanted.quantity = HistoryQuantity::joint;
  wanted.point    = { { 2., 2. } };
  for (const std::string curve : { "bed", "" })
    for (const double missing : { 2.5, 0.5 })
      for (const unsigned int goes : { 0U, 1U })
      {
        std::vector<double> absence(2, 0.);
        absence[goes] = missing;
        wanted.curve  = curve;
        const unsigned int point
            = find_history_point(run.model, wanted, absence).entity;
        const unsigned int face = run.model.joints().segments()[point / 2].face;
        for (const unsigned int block : nodes.faces().joints[face].blocks)
          EXPECT_EQ(nodes.table().group[block], 1 - goes) << "on " << curve;
      }
}

namespace
{
  HistoryParameters history(const HistoryQuantity quantity,
                            const unsigned int component   = 0,
                            const std::array<double, 3> &a = {},
                            const std::array<double, 3> &b = {})
  {
    HistoryParameters result;
    result.name        = "h" + std::to_string(int(quantity));
    result.quantity    = quantity;
    result.component   = component;
    result.point       = a;
    result.other_point = b;
    return result;
  }

  /** A row of @p wanted of @p run. */
  std::vector<double> row_of(const std::vector<HistoryParameters> &wanted,
                             TestRun &run)
  {
    Histories<2> histories(wanted, run.model, run.solver, BoundaryGeometry(),
                           BoundaryElementParameters(), { false, false });
    EXPECT_EQ(histories.column_names().size(), 1 + wanted.size());
    histories.before_step(run.state);
    return histories.after_step(run.state);
  }
} // namespace

TEST(Histories, QuantitiesOfTwoPointsFollowTheMotionOfBoth)
{
  using Q = HistoryQuantity;
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  // The line from (0, 0) to (3, 4), 5 m, is turned by 30 degrees,
  // anticlockwise, and becomes 1.2 times as long.
  const double c = 1.2 * std::sqrt(3.) / 2., s = 1.2 / 2.;
  for (NodeRecord<2> &node : run.state.nodes)
  {
    node.u[0] = c * node.X[0] - s * node.X[1] - node.X[0] + 0.3;
    node.u[1] = s * node.X[0] + c * node.X[1] - node.X[1] - 7.;
  }
  // Between nodes, on both sides of the joint, and there.
  for (const double part : { 0.45, 1. })
  {
    const double x = part < 1. ? 0.3 : 0., y = part < 1. ? 0.55 : 0.;
    const std::array<double, 3> a = { { x, y, 0. } },
                                b = { { x + 3. * part, y + 4. * part, 0. } };
    const auto row                = row_of(
                       { history(Q::relative_displacement, 0, a, b),
                         history(Q::relative_displacement, 1, a, b), history(Q::tilt, 0, a, b),
                         history(Q::distance_change, 0, a, b), history(Q::tilt, 0, b, a),
                         history(Q::displacement, 1, a) },
                       run);
    ASSERT_EQ(row.size(), 7U);
    EXPECT_NEAR(row[1], part * (3. * c - 4. * s - 3.), 1e-14);
    EXPECT_NEAR(row[2], part * (3. * s + 4. * c - 4.), 1e-14);
    EXPECT_NEAR(row[3], 30., 1e-13);
    EXPECT_NEAR(row[4], part, 1e-14);
    EXPECT_NEAR(row[5], 30., 1e-13);
    EXPECT_NEAR(row[6], s * x + c * y - y - 7., 1e-14);
  }
}

TEST(Histories, PointsOutsideOfBlocksAreNamed)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  for (const double x : { 0.25, -0.25 })
  {
    const Histories<2> histories({ velocity_at(x, 1.), velocity_at(3., 0.) },
                                 run.model, run.solver, BoundaryGeometry(),
                                 BoundaryElementParameters(), { false, false });
    const auto lines = histories.moved_points();
    ASSERT_EQ(lines.size(), x < 0. ? 1U : 0U);
    if (lines.empty())
      continue;
    EXPECT_EQ(lines[0], "history v: the motion of the node at (0, 1), the "
                        "nearest to its 'Point', which lies outside of all "
                        "blocks, 0.25 m away");
  }
}

TEST(Histories, JointsOnNoNamedCurve)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  for (JointFace<2> &face : mesh.joint_faces)
    face.name = 0;
  ModelParameters parameters  = two_blocks();
  parameters.joints[0].curves = { "unnamed" };
  TestRun run(mesh, parameters, {});
  HistoryParameters wanted;
  wanted.quantity = HistoryQuantity::joint;
  wanted.curve    = "unnamed";
  wanted.point    = { { 2.9, 2. } };
  EXPECT_TRUE(find_history_point(run.model, wanted, { false, false }).here);
  wanted.curve = "joint";
  EXPECT_THROW(find_history_point(run.model, wanted, { false, false }),
               InputError);
}

TEST(Histories, LengthOfOpenJoints)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  const auto open = [&]()
  { return row_of({ history(HistoryQuantity::open_joints) }, run)[1]; };
  EXPECT_EQ(open(), 0.);
  // One end of one of three faces of 1 m.
  auto &states = run.state.get<JointHistory>().state;
  states[2]    = JointState::open;
  EXPECT_NEAR(open(), 0.5, 1e-15);
  states[3] = JointState::open;
  states[4] = JointState::slipping;
  EXPECT_NEAR(open(), 1., 1e-15);
  run.state.get<JointHistory>().handed_over[1] = 1;
  EXPECT_EQ(open(), 0.);
}

// Joints that slide or open become general contacts in large displacements, and
// bear and open as those that stay joints.
TEST(Histories, OfJointsGoOnWhenTheyHaveBecomeContacts)
{
  using Q                            = HistoryQuantity;
  const std::array<double, 3> middle = { { 1., 2., 0. } };
  const auto row                     = [&](const bool large, const double up)
  {
    BlockMesh<2> mesh                      = make_stack(3, 2);
    ModelParameters parameters             = two_blocks();
    JointSetParameters &joint              = parameters.joints[0];
    joint.all_new_contacts                 = true;
    coulomb_law(joint).peak                = { 0., 0.3, 0. };
    coulomb_law(joint).residual            = { 0., 0.3, 0. };
    parameters.large_displacements         = large;
    parameters.contact.large_displacements = large;
    const auto still = component(LoadQuantity::velocity, "0");
    TestRun run(
        mesh, parameters,
        { platen("held", "lower", still, still, still),
          platen("driven", "upper", component(LoadQuantity::velocity, "0.05"),
                 still, still) });
    for (unsigned int i = 0; i < run.state.nodes.size(); ++i)
      if (run.nodes->block_of_node(i) == 1)
        run.state.nodes[i].u[1] = up;
    run.begin(stage_with({ "held", "driven" }));
    const auto is_contact
        = [&]() { return run.state.get<JointHistory>().handed_over[0] != 0; };
    const double &slip = run.state.nodes[run.node(3., 4.)].u[0];
    while (slip < 2e-3 || (large && !is_contact() && slip < 0.02))
      run.step(1);
    EXPECT_EQ(is_contact(), large);
    Histories<2> histories(
        { history(Q::joint, 2, middle), history(Q::joint, 3, middle),
          history(Q::joint, 4, middle), history(Q::open_joints) },
        run.model, run.solver, BoundaryGeometry(), BoundaryElementParameters(),
        { false, false });
    histories.before_step(run.state);
    run.step(1);
    return histories.after_step(run.state);
  };
  for (const bool large : { false, true })
  {
    const auto sliding = row(large, -1e-5);
    EXPECT_NEAR(sliding[1], -2e5, 1.);
    EXPECT_NEAR(sliding[2], 6e4, 1.);
    EXPECT_EQ(sliding[3], double(JointState::slipping));
    EXPECT_EQ(sliding[4], 0.);
    const auto open = row(large, 1e-3);
    EXPECT_EQ(open[1], 0.);
    EXPECT_EQ(open[2], 0.);
    EXPECT_EQ(open[3], double(JointState::open));
    EXPECT_NEAR(open[4], 3., 1e-12);
  }
}

TEST(Histories, OfTwoPointsAreZeroWhereOneIsInABlockThatIsNotThere)
{
  using Q = HistoryQuantity;
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  for (NodeRecord<2> &node : run.state.nodes)
    node.u = dealii::Point<2>(0.1 + 0.01 * node.X[1], 0.2 * node.X[0]);
  const std::array<double, 3> below = { { 0., 0., 0. } },
                              side  = { { 3., 0., 0. } },
                              above = { { 0.3, 4., 0. } };
  std::vector<HistoryParameters> wanted;
  for (const auto &[a, b] :
       { std::pair(below, above), std::pair(above, below) })
    for (const Q quantity :
         { Q::relative_displacement, Q::tilt, Q::distance_change })
      wanted.push_back(history(quantity, 0, a, b));
  wanted.push_back(history(Q::relative_displacement, 1, below, side));
  auto row = row_of(wanted, run);
  for (unsigned int i = 1; i <= wanted.size(); ++i)
    EXPECT_GT(std::abs(row[i]), 1e-3) << "column " << i;
  run.state.block_marks.assign(2, block_mark::present);
  run.state.block_marks[1] = block_mark::absent;
  row                      = row_of(wanted, run);
  for (unsigned int i = 1; i < wanted.size(); ++i)
    EXPECT_EQ(row[i], 0.) << "column " << i;
  EXPECT_NEAR(row[wanted.size()], 0.6, 1e-14);
}

TEST(Histories, HaveNoValueInADeletedBlock)
{
  using Q = HistoryQuantity;
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  const std::array<double, 3> below = { { 0., 0., 0. } },
                              above = { { 0., 4., 0. } };
  const std::vector<HistoryParameters> wanted
      = { history(Q::velocity, 0, below),
          history(Q::velocity, 0, above),
          history(Q::stress, 0, above),
          history(Q::rotation, 0, above),
          history(Q::joint, 2, { { 1., 2., 0. } }),
          history(Q::distance_change, 0, below, above) };
  for (const double value : row_of(wanted, run))
    EXPECT_EQ(value, 0.);
  run.state.block_marks.assign(2, block_mark::present);
  run.state.block_marks[1] = block_mark::absent;
  for (unsigned int i = 1; i <= 5; ++i)
    EXPECT_EQ(row_of(wanted, run)[i], 0.) << "excavated, column " << i;
  run.state.block_marks[1] = block_mark::removed;
  const auto row           = row_of(wanted, run);
  EXPECT_EQ(row[1], 0.);
  for (unsigned int i = 2; i <= 6; ++i)
    EXPECT_TRUE(std::isnan(row[i])) << "column " << i;

  Histories<2> histories(wanted, run.model, run.solver, BoundaryGeometry(),
                         BoundaryElementParameters(), { false, false });
  EXPECT_EQ(histories.names_in(1).size(), 5U);
  EXPECT_EQ(histories.names_in(0).size(), 3U) << "with the joint's";
}
