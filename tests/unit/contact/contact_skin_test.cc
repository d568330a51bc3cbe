// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// The automatic skin of contacts, and gaps between blocks.

#include "test_contacts.h"

#include <quoin/contact/block_gaps.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double gap      = 0.02;
  constexpr unsigned int n  = 5;
  constexpr double distance = 1. + gap;

  /** n x n blocks of 1 m with gaps. */
  BlockMesh<2> make_array()
  {
    std::vector<Rectangle> rectangles;
    for (unsigned int i = 0; i < n * n; ++i)
      rectangles.push_back(
          { i % n * distance, i / n * distance, 1., 1., 4, 4 });
    return make_blocks(rectangles);
  }

  ModelParameters loose_blocks(const double skin)
  {
    ModelParameters result;
    result.plane               = PlaneAssumption::plane_stress;
    result.materials           = { material("stone") };
    result.joints              = { touching() };
    result.large_displacements = result.contact.large_displacements = true;
    result.contact.skin                                             = skin;
    return result;
  }

  struct Shaking
  {
    double drift = 0.; // of all blocks [m/s]
    double spin  = 0.; // of every other one, the others the other way [rad/s]
    bool anew    = false; // whether each step looks at all pairs
  };

  /** The array after some impacts of blocks of 0.5 m/s. */
  std::unique_ptr<TestRun> shaken(const BlockMesh<2> &mesh, const double skin,
                                  const Shaking &shaking = {})
  {
    auto run = std::make_unique<TestRun>(mesh, loose_blocks(skin),
                                         std::vector<LoadParameters>());
    run->begin(stage_with({}), 0.4);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    std::vector<dealii::Tensor<1, 2>> velocity;
    for (unsigned int b = 0; b < n * n; ++b)
      velocity.push_back(
          dealii::Point<2>(uniform(random) + shaking.drift, uniform(random)));
    for (unsigned int i = 0; i < run->nodes->n_local(); ++i)
    {
      const unsigned int b = run->nodes->block_of_node(i);
      const double x       = run->nodes->point(i)[0] - b % n * distance - 0.5;
      const double y       = run->nodes->point(i)[1] - b / n * distance - 0.5;
      const double turning = b % 2 == 0 ? shaking.spin : -shaking.spin;
      run->state.velocity[i]
          = velocity[b] + dealii::Point<2>(-turning * y, turning * x);
    }
    for (unsigned int i = 0; i < 2000; ++i)
    {
      if (shaking.anew)
        run->state.get<ContactState>().marks.clear();
      run->step(1);
    }
    return run;
  }

  double n_searches(const TestRun &run)
  {
    return run.state.get<ContactState>().n_searches;
  }
} // namespace

TEST(ContactSkin, LooksAtFewPairsAndChangesNothing)
{
  BlockMesh<2> mesh = make_array();
  const auto wide = shaken(mesh, 0.05), automatic = shaken(mesh, 0.);
  double largest = 0., error = 0.;
  for (unsigned int i = 0; i < wide->state.nodes.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double u = wide->state.nodes[i].u[d];
      largest        = std::max(largest, std::abs(u));
      error = std::max(error, std::abs(u - automatic->state.nodes[i].u[d]));
    }
  EXPECT_GT(n_touching(wide->model.contacts()->near_pairs(),
                       wide->state.get<ContactState>()),
            0.);
  EXPECT_GT(largest, gap);
  // Slip is counted from anchors that move at a search.
  EXPECT_LT(error, 1e-6 * largest);
  // All neighbours are within the wide skin, few of them touch.
  EXPECT_LT(automatic->model.contacts()->work().updates,
            0.3 * wide->model.contacts()->work().updates);
}

TEST(ContactSkin, DistantPairsAreLookedAtInTime)
{
  BlockMesh<2> mesh            = make_array();
  const auto some              = shaken(mesh, 0.1, { 0., 1. }),
             all               = shaken(mesh, 0.1, { 0., 1., true });
  const ContactState &contacts = some->state.get<ContactState>();
  EXPECT_GT(some->state.energy.friction, 0.);
  for (const PairMark mark : { PairMark::distant, PairMark::apart })
    EXPECT_GT(std::count(contacts.marks.begin(),
                         contacts.marks.begin() + contacts.pairs.size(), mark),
              5);
  for (unsigned int i = 0; i < some->state.nodes.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_EQ(some->state.nodes[i].u[d], all->state.nodes[i].u[d]);
}

TEST(ContactSkin, WhatAllBlocksShareCallsForNoSearch)
{
  BlockMesh<2> mesh = make_array();
  const auto still = shaken(mesh, 0.), drifts = shaken(mesh, 0., { 20. });
  EXPECT_GT(n_searches(*still), 5.);
  EXPECT_NEAR(n_searches(*drifts), n_searches(*still),
              0.1 * n_searches(*still));
}

TEST(BlockGaps, AreThoseOfTheNearestBlockThatIsNotTouched)
{
  // Two blocks that touch, one 0.03 m beside, one far away.
  BlockMesh<2> mesh = make_blocks({ { 0., 0., 1., 1., 2, 2 },
                                    { 0.25, 1., 1., 1., 3, 3 },
                                    { 1.03, 0., 1., 0.9, 2, 2 },
                                    { 5., 0., 1., 1., 1, 1 } });
  const TestNodes nodes(mesh);
  State<2> state;
  for (const auto &p : mesh.vertices)
    state.nodes.push_back({ { p[0], p[1] }, {} });
  // From (1, 0..0.9) to the block beside, and from that to the one above.
  const auto gaps = block_gaps(nodes, state, 0.2);
  ASSERT_EQ(gaps.size(), 3U);
  EXPECT_NEAR(gaps[0], 0.03, 1e-12);
  EXPECT_NEAR(gaps[1], 0.03, 1e-12);
  EXPECT_NEAR(gaps[2], 0.1, 1e-12);
  EXPECT_TRUE(block_gaps(nodes, state, 0.02).empty());
}
