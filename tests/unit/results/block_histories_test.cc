// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/base/constants.h>
#include <quoin/results/block_histories.h>

#include <cmath>

using namespace quoin;
using namespace quoin::test;
using constants::degree;

namespace
{
  constexpr auto moves    = HistoryQuantity::block_displacement;
  constexpr auto velocity = HistoryQuantity::block_velocity;
  constexpr auto force    = HistoryQuantity::block_force;

  /** Columns x, y and rotation or moment of @p quantity. */
  void add(std::vector<HistoryParameters> &columns,
           const HistoryQuantity quantity, const std::string &block,
           const std::string &other = "")
  {
    for (unsigned int d = 0; d < 3; ++d)
    {
      HistoryParameters column;
      column.quantity    = quantity;
      column.component   = d;
      column.block       = block;
      column.other_block = other;
      columns.push_back(column);
    }
  }

  /** "a", the lower, and "b", the upper of two blocks. */
  std::vector<NamedBlock> both_blocks(const NodeMap<2> &nodes)
  {
    std::vector<NamedBlock> blocks(2);
    blocks[0].name  = "a";
    blocks[0].group = "lower";
    blocks[1].name  = "b";
    blocks[1].group = "upper";
    find_named_blocks(nodes, blocks);
    return blocks;
  }

  /** Turns the upper block by @p angle, stretched by @p stretch, about its
      centroid, which moves by x, y; with a @p spin [rad/s]. */
  void place_upper(TestRun &run, const double angle, const double stretch,
                   const double x, const double y, const double spin)
  {
    const auto centroid = inertia_of_block(run.model, 1).centroid;
    const double c = stretch * std::cos(angle), s = stretch * std::sin(angle);
    for (unsigned int i = 0; i < run.nodes->n_local(); ++i)
      if (run.nodes->block_of_node(i) == 1)
      {
        const auto r    = run.nodes->point(i) - centroid;
        const double px = c * r[0] - s * r[1], py = s * r[0] + c * r[1];
        run.state.nodes[i].u[0]  = x + px - r[0];
        run.state.nodes[i].u[1]  = y + py - r[1];
        run.state.velocity[i][0] = 3. - spin * py;
        run.state.velocity[i][1] = -4. + spin * px;
      }
  }
} // namespace

TEST(BlockHistories, RotationCountsTurnsOfADeformableBlock)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  std::vector<HistoryParameters> columns;
  add(columns, moves, "b");
  add(columns, velocity, "b");
  add(columns, moves, "a");
  BlockHistories histories(columns, both_blocks(run.nodes), run.model, nullptr);
  for (const double angle : { 100., 200., 370., 540., 700., 610. })
  {
    place_upper(run, angle * degree, 1.1, 100., -50., 2.);
    histories.before_step(run.state);
    const auto row = histories.after_step(run.state);
    EXPECT_NEAR(row[0], 100., 1e-12);
    EXPECT_NEAR(row[1], -50., 1e-12);
    EXPECT_NEAR(row[2], angle, 1e-10);
    EXPECT_NEAR(row[3], 3., 1e-13);
    EXPECT_NEAR(row[4], -4., 1e-13);
    EXPECT_NEAR(row[5], 2. / degree, 1e-9);
    for (const unsigned int i : { 6, 7, 8 })
      EXPECT_EQ(row[i], 0.);
  }
}

TEST(BlockHistories, MotionDoesNotDependOnADensityThatChanges)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  std::vector<HistoryParameters> columns;
  add(columns, moves, "b");
  add(columns, velocity, "b");
  BlockHistories histories(columns, both_blocks(run.nodes), run.model, nullptr);
  // As where a stage fills in a heavier block.
  ModelProperties properties = run.model.properties();
  for (MaterialParameters &material : properties.materials)
    material.elastic.density *= 1.25;
  run.model.set_properties(properties, run.state.get<ConstructionState<2>>());
  place_upper(run, 100. * degree, 1.1, 100., -50., 2.);
  histories.before_step(run.state);
  const auto row = histories.after_step(run.state);
  EXPECT_NEAR(row[0], 100., 1e-12);
  EXPECT_NEAR(row[1], -50., 1e-12);
  EXPECT_NEAR(row[2], 100., 1e-10);
  EXPECT_NEAR(row[3], 3., 1e-13);
  EXPECT_NEAR(row[4], -4., 1e-13);
  EXPECT_NEAR(row[5], 2. / degree, 1e-9);
}

TEST(BlockHistories, VelocitiesLieBetweenThoseOfTheStepsBesideThem)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  std::vector<HistoryParameters> columns;
  add(columns, velocity, "b");
  BlockHistories histories(columns, both_blocks(run.nodes), run.model, nullptr);
  const auto spin = [&](const double step_before, const double step_after)
  {
    place_upper(run, 0.3, 1., 0., 0., 1.);
    run.state.previous_time_step = step_before;
    histories.before_step(run.state);
    place_upper(run, 0.3, 1., 0., 0., 2.);
    run.state.previous_time_step = step_after;
    return histories.after_step(run.state)[2] * degree;
  };
  // In the middle of the steps the spin is 1 and 2 / s.
  EXPECT_NEAR(spin(1e-3, 1e-3), 1.5, 1e-12);
  EXPECT_NEAR(spin(2e-3, 1e-3), 5. / 3., 1e-12);
  EXPECT_NEAR(spin(0., 1e-3), 1., 1e-12) << "the run starts with 1 / s";
}

TEST(BlockHistories, ForceOfJointsWhereTheyWere)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  std::vector<HistoryParameters> columns;
  add(columns, force, "a", "b");
  add(columns, force, "b", "a");
  add(columns, force, "a");
  BlockHistories histories(columns, both_blocks(run.nodes), run.model, nullptr);
  histories.before_step(run.state);
  // The step moves all nodes; tractions are those of before: 2 MPa of pressure
  // on the left one of three faces of 1 m x 0.5 m, 1 MPa of shear on all.
  place_upper(run, 1., 1., 5., 5., 0.);
  auto &joints = run.state.get<JointHistory>();
  for (unsigned int i = 0; i < 3; ++i)
  {
    const auto &segment = run.model.joints().segments()[i];
    const double x      = 0.5
                     * (run.nodes->point(segment.lower[0])[0]
                        + run.nodes->point(segment.lower[1])[0]);
    for (const unsigned int p : { 2 * i, 2 * i + 1 })
    {
      joints.normal_traction[p] = x < 1. ? -2e6 : 0.;
      joints.shear_traction[p]  = 1e6;
    }
  }
  const auto row = histories.after_step(run.state);
  // On block a: n = (0, 1), s = (n_y, -n_x) = (1, 0), f = sigma n + tau s; it
  // is the same if b is the lower side of the joint.
  const double fx = 1.5e6, fy = -1e6;
  EXPECT_NEAR(row[0], fx, 1e-6);
  EXPECT_NEAR(row[1], fy, 1e-6);
  const auto a = inertia_of_block(run.model, 0).centroid;
  EXPECT_NEAR(row[2], (0.5 - a[0]) * fy - (2. - a[1]) * fx, 1e-4);
  EXPECT_NEAR(row[3], -fx, 1e-6);
  EXPECT_NEAR(row[4], -fy, 1e-6);
  const auto b = inertia_of_block(run.model, 1).centroid;
  EXPECT_NEAR(row[5], -(0.5 - b[0]) * fy + (2. - b[1]) * fx, 1e-4);
  for (const unsigned int i : { 0, 1, 2 })
    EXPECT_EQ(row[6 + i], row[i]) << "there are no others";

  std::fill(joints.handed_over.begin(), joints.handed_over.end(), 1);
  histories.before_step(run.state);
  EXPECT_EQ(histories.after_step(run.state)[1], 0.);
}

TEST(BlockHistories, HaveNoValueOfADeletedBlock)
{
  TestRun run(make_stack(3, 2), two_blocks(), {});
  run.begin(stage_with({}));
  std::vector<HistoryParameters> columns;
  add(columns, moves, "a");
  add(columns, moves, "b");
  add(columns, force, "a", "b");
  BlockHistories histories(columns, both_blocks(run.nodes), run.model, nullptr);
  const auto row = [&]()
  {
    histories.before_step(run.state);
    return histories.after_step(run.state);
  };
  place_upper(run, 0.1, 1., 1., 1., 0.);
  run.state.block_marks = { block_mark::present, block_mark::absent };
  for (const double value : row())
    EXPECT_EQ(value, 0.);
  run.state.block_marks[1] = block_mark::removed;
  const auto values        = row();
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(values[i], 0.);
    EXPECT_TRUE(std::isnan(values[3 + i]));
    EXPECT_TRUE(std::isnan(values[6 + i]));
    EXPECT_TRUE(histories.is_of(6 + i, 1) && histories.is_of(6 + i, 0));
    EXPECT_FALSE(histories.is_of(i, 1));
  }
}
