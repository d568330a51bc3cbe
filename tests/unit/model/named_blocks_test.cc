// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "test_models.h"

#include <quoin/base/exceptions.h>
#include <quoin/model/named_blocks.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  NamedBlock at(const std::string &name, const double x, const double y)
  {
    NamedBlock block;
    block.name      = name;
    block.has_point = true;
    block.point     = dealii::Point<2>(x, y);
    return block;
  }

  NamedBlock of(const std::string &name, const std::string &group)
  {
    NamedBlock block;
    block.name  = name;
    block.group = group;
    return block;
  }

  /** What is said of @p blocks in a stack of two of 3 m x 2 m. */
  std::string refusal(std::vector<NamedBlock> blocks)
  {
    const TestNodes nodes(make_stack(3, 2));
    return message_of<InputError>([&] { find_named_blocks(nodes, blocks); });
  }

  void expect_words(const std::string &message,
                    const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      EXPECT_NE(message.find(word), std::string::npos) << message;
  }
} // namespace

TEST(NamedBlocks, AreFoundByPointAndBySurface)
{
  const TestNodes nodes(make_stack(3, 2));
  // the second point is on an edge between two cells of its block
  std::vector<NamedBlock> blocks = { at("a", 0.1, 3.9), of("b", "lower") };
  find_named_blocks(nodes, blocks);
  EXPECT_EQ(blocks[0].number, 1U);
  EXPECT_EQ(blocks[1].number, 0U);
  blocks = { at("a", 1.3, 1.) };
  find_named_blocks(nodes, blocks);
  EXPECT_EQ(blocks[0].number, 0U);
}

TEST(NamedBlocks, AreOneBlockEach)
{
  expect_words(refusal({ at("key", 3.5, 1.) }),
               { "Blocks/key", "(3.5, 1)", "in no block" });
  expect_words(refusal({ at("key", 1.3, 2.) }),
               { "Blocks/key", "on the edge of several blocks" });
  expect_words(refusal({ of("key", "middle") }),
               { "Blocks/key", "'middle'", "lower, upper" });
  expect_words(refusal({ at("key", 1., 1.5), of("stone", "lower") }),
               { "Blocks/stone", "'key' already" });
  MeshData<2> data;
  for (const double x : { 0., 2. })
    add_grid(data, 1, 1, "stones", x, 0.);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  const TestNodes nodes(mesh);
  std::vector<NamedBlock> two = { of("key", "stones") };
  expect_words(message_of<InputError>([&] { find_named_blocks(nodes, two); }),
               { "Blocks/key", "a surface of 2 blocks", "'Point'" });
}

TEST(NamedBlocks, InertiaOfADeformableAndARigidBlock)
{
  // 3 m x 2 m x 0.5 m; lumped masses have a larger moment than the area
  const double mass = 2500. * 3. * 2. * 0.5;
  for (const bool rigid : { false, true })
  {
    BlockMesh<2> mesh          = make_stack(3, 2);
    ModelParameters parameters = two_blocks();
    for (MaterialParameters &stone : parameters.materials)
      stone.rigid = rigid;
    const TestNodes nodes(mesh, parameters.materials);
    const Model<2> model(nodes, parameters);
    const BlockInertia inertia = inertia_of_block(model, 1);
    EXPECT_NEAR(inertia.mass, mass, 1e-9 * mass);
    EXPECT_NEAR(inertia.centroid[0], 1.5, rigid ? 1e-14 : 0.2);
    EXPECT_NEAR(inertia.centroid[1], 3., rigid ? 1e-14 : 0.2);
    const double exact = mass * (9. + 4.) / 12.;
    if (rigid)
      EXPECT_NEAR(inertia.moment, exact, 1e-9 * exact);
    else
      EXPECT_GT(inertia.moment, exact);
  }
}
