// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_models.h"

#include <quoin/base/exceptions.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** make_stack() and, apart from it, a block "loose" from (5, 0) to (6, 1). */
  BlockMesh<2> make_stack_and_block()
  {
    MeshData<2> data;
    for (const unsigned int i : { 0U, 1U })
    {
      add_grid(data, 2, 1, i == 0 ? "lower" : "upper", 0., i);
      add_curve(data, i == 0 ? "bottom" : "joint", 0., i, 2., i);
    }
    add_grid(data, 1, 1, "loose", 5., 0.);
    add_curve(data, "foot", 5., 0., 6., 0.);
    add_curve(data, "top", 5., 1., 6., 1.);
    return split_into_blocks(data, {});
  }

  ModelParameters three_blocks()
  {
    ModelParameters parameters = two_blocks();
    parameters.materials.push_back(material("loose"));
    return parameters;
  }

  std::vector<UnsupportedBody<2>>
  pushed(const std::vector<LoadParameters> &loads,
         const std::vector<std::string> &names)
  {
    TestRun run(make_stack_and_block(), three_blocks(), loads);
    const StageParameters stage = stage_with(names);
    run.begin(stage);
    return run.solver.stage_loads().unsupported_bodies(run.model, stage,
                                                       run.state);
  }
} // namespace

TEST(FreeBodies, ABlockThatNothingHolds)
{
  const auto bodies
      = pushed({ motion("base", "bottom", "0", "0"), gravity("0", "-9.81") },
               { "base", "gravity" });
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_NEAR(bodies[0].centre[0], 5.5, 1e-12);
  EXPECT_NEAR(bodies[0].centre[1], 0.5, 1e-12);
  EXPECT_EQ(bodies[0].n_blocks, 1U);
  EXPECT_TRUE(bodies[0].is_loose);
}

TEST(FreeBodies, BlocksTiedByJointsAreOne)
{
  const auto bodies
      = pushed({ motion("foot", "foot", "0", "0"), gravity("0", "-9.81") },
               { "foot", "gravity" });
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_LT(bodies[0].centre[0], 2.);
  EXPECT_EQ(bodies[0].n_blocks, 2U);
}

TEST(FreeBodies, WithoutLoadsNothingMoves)
{
  EXPECT_TRUE(
      pushed({ motion("base", "bottom", "0", "0"), gravity("0", "-9.81") },
             { "base" })
          .empty());
}

TEST(FreeBodies, HeldWhereItsLoadsPushIt)
{
  // On rollers under its weight it stays; pushed to the side it goes.
  const std::vector<LoadParameters> loads
      = { motion("base", "bottom", "0", "0"), motion("roller", "foot", "", "0"),
          gravity("0", "-9.81"), traction("side", "top", "1e3*t", "") };
  EXPECT_TRUE(pushed(loads, { "base", "roller", "gravity" }).empty());
  const auto bodies = pushed(loads, { "base", "roller", "gravity", "side" });
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_FALSE(bodies[0].is_loose);
}

TEST(FreeBodies, PlatensPush)
{
  // On rollers the block may go sideways or turn about nothing.
  const auto base   = motion("base", "bottom", "0", "0");
  const auto roller = motion("roller", "foot", "", "0");
  const LoadComponent nothing;
  const auto force = [](const std::string &function) {
    return LoadComponent{ LoadQuantity::force, TimeFunction(function, "./") };
  };
  const auto down = platen("jack", "loose", nothing, force("-1e3"), nothing);
  const auto side = platen("jack", "loose", force("1e3"), nothing, nothing);
  const std::vector<std::string> names = { "base", "roller", "jack" };
  EXPECT_TRUE(pushed({ base, roller, down }, names).empty());
  EXPECT_EQ(pushed({ base, roller, side }, names).size(), 1U);
  // Without the roller nothing bears the moment either.
  EXPECT_EQ(
      pushed({ base, platen("jack", "loose", nothing, nothing, force("1e3")) },
             { "base", "jack" })
          .size(),
      1U);
}

TEST(FreeBodies, DashpotsHoldInMotionButNotAtRest)
{
  const std::vector<LoadParameters> loads
      = { motion("base", "bottom", "0", "0"), viscous("dashpots", "foot"),
          gravity("0", "-9.81") };
  EXPECT_TRUE(pushed(loads, { "base", "dashpots", "gravity" }).empty());

  TestRun run(make_stack_and_block(), three_blocks(), loads);
  StageParameters stage = stage_with({ "base", "dashpots", "gravity" });
  stage.end             = StageEnd::static_ratio;
  EXPECT_THROW(run.begin(stage), InputError);
}

TEST(FreeBodies, LoadsThatBalancePushNothing)
{
  const std::vector<LoadParameters> loads
      = { motion("base", "bottom", "0", "0"),
          traction("down", "top", "", "-1e4"),
          traction("up", "foot", "", "1e4") };
  EXPECT_TRUE(pushed(loads, { "base", "down", "up" }).empty());
  EXPECT_EQ(pushed(loads, { "base", "down" }).size(), 1U);
}
