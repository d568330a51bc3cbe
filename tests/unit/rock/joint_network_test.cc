// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/rock/block_faces.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace quoin;

namespace
{
  using Point = dealii::Point<2>;

  void add_square(JointNetwork &network, const double low, const double high,
                  const unsigned int line)
  {
    const Polygon corners = { Point(low, low), Point(high, low),
                              Point(high, high), Point(low, high) };
    for (unsigned int i = 0; i < 4; ++i)
      network.add({ { corners[i], corners[(i + 1) % 4] } }, line, true);
  }

  void add(JointNetwork &network, const double x0, const double y0,
           const double x1, const double y1, const unsigned int line = 1)
  {
    network.add({ { Point(x0, y0), Point(x1, y1) } }, line, false);
  }

  unsigned int n_vertices_in_use(const JointNetwork &network)
  {
    std::set<unsigned int> used;
    for (const auto &edge : network.edges())
    {
      used.insert(edge.from);
      used.insert(edge.to);
    }
    return used.size();
  }

  double total_area(const BlockFaces &faces)
  {
    double sum = 0.;
    for (const auto &face : faces.faces())
      sum += face.area;
    return sum;
  }

  /** V - E + F = 1 + C, with the outside as a face. */
  void expect_euler(const JointNetwork &network, const BlockFaces &faces)
  {
    EXPECT_EQ(n_vertices_in_use(network) + faces.faces().size() + 1,
              network.edges().size() + 1 + faces.n_parts());
  }
} // namespace

TEST(JointNetwork, cuts_lines_at_their_crossing)
{
  JointNetwork network(0.01);
  add_square(network, 0., 1., 0);
  add(network, 0., 0.5, 1., 0.5);
  add(network, 0.25, 0., 0.25, 1.);
  network.cut();
  const BlockFaces faces(network);
  EXPECT_EQ(faces.faces().size(), 4u);
  EXPECT_EQ(network.edges().size(), 12u);
  EXPECT_EQ(network.n_joined(), 0u);
  EXPECT_NEAR(total_area(faces), 1., 1e-15);
  expect_euler(network, faces);
}

TEST(JointNetwork, joins_ends_that_nearly_meet)
{
  JointNetwork network(0.01);
  add_square(network, 0., 1., 0);
  add(network, 0.004, 0.5, 0.996, 0.5); // just short of the border
  add(network, 0.5, 0.503, 0.5, 1.);    // just short of the first joint
  add(network, 0.001, 0.002, 0.3, 0.5); // near the corner
  network.cut();
  const BlockFaces faces(network);
  EXPECT_EQ(faces.faces().size(), 4u);
  EXPECT_TRUE(faces.dead_ends().empty());
  EXPECT_GE(network.n_joined(), 4u);
  EXPECT_NEAR(total_area(faces), 1., 1e-14);
  expect_euler(network, faces);
}

TEST(JointNetwork, first_line_names_a_common_edge)
{
  JointNetwork network(0.01);
  add_square(network, 0., 1., 0);
  add(network, 0., 0.5, 1., 0.5, 2);
  add(network, 0.2, 0.501, 0.8, 0.499, 1);
  network.cut();
  std::map<unsigned int, double> length;
  for (const auto &edge : network.edges())
    length[edge.line] += network.length(edge);
  EXPECT_NEAR(length[1], 0.6, 0.01);
  EXPECT_NEAR(length[2], 0.4, 0.01);
}

TEST(JointNetwork, borders_stay_where_they_are)
{
  JointNetwork network(0.05);
  add_square(network, 0., 1., 0);
  for (unsigned int i = 0; i < 40; ++i)
    add(network, 0.5, 0.5, 0.5 + std::cos(0.17 * i), 0.5 + std::sin(0.17 * i));
  network.cut();
  network.remove(
      [&](const JointNetwork::Edge &edge)
      {
        const Point p = network.middle(edge);
        return std::max(std::abs(p[0] - 0.5), std::abs(p[1] - 0.5))
               > 0.5 + 1e-12;
      });
  const BlockFaces faces(network);
  EXPECT_NEAR(total_area(faces), 1., 1e-12);
  for (const auto &edge : network.edges())
    EXPECT_GT(network.length(edge), 0.05 * (1. - 1e-9));
}

TEST(JointNetwork, finds_dead_ends_bridges_and_islands)
{
  JointNetwork network(0.01);
  add_square(network, 0., 4., 0);
  add_square(network, 1., 2., 1);
  add(network, 2., 1.5, 4., 1.5); // bridge from the inner square
  add(network, 3., 3., 3.5, 3.5); // stands alone
  add(network, 0., 3., 0.5, 3.);  // from the border
  network.cut();
  {
    const BlockFaces faces(network);
    EXPECT_EQ(faces.faces().size(), 2u);
    EXPECT_EQ(faces.dead_ends().size(), 2u);
    EXPECT_EQ(faces.bridges().size(), 1u);
    EXPECT_EQ(faces.n_parts(), 2u);
    EXPECT_NEAR(total_area(faces), 16., 1e-12);
    std::vector<bool> dead(network.edges().size(), false);
    for (const auto *edges : { &faces.dead_ends(), &faces.bridges() })
      for (const unsigned int e : *edges)
        dead[e] = true;
    std::size_t e = 0;
    network.remove([&](const JointNetwork::Edge &) { return dead[e++]; });
  }
  const BlockFaces faces(network);
  ASSERT_EQ(faces.faces().size(), 2u);
  EXPECT_TRUE(faces.dead_ends().empty());
  const auto &outer = faces.faces()[faces.find(Point(3., 3.))];
  EXPECT_EQ(outer.inner.size(), 1u);
  EXPECT_NEAR(outer.area, 15., 1e-12);
  EXPECT_NEAR(outer.perimeter, 20., 1e-12);
  expect_euler(network, faces);
}

TEST(JointNetwork, splits_borders_that_touch_themselves_in_a_point)
{
  // A triangle inside the square whose tip is on the base.
  JointNetwork network(0.01);
  add_square(network, 0., 4., 0);
  add(network, 2., 0., 3., 2.);
  add(network, 3., 2., 1., 2.);
  add(network, 1., 2., 2., 0.);
  network.cut();
  const BlockFaces faces(network);
  ASSERT_EQ(faces.faces().size(), 2u);
  const auto &outer = faces.faces()[faces.find(Point(2., 3.))];
  EXPECT_EQ(outer.outer.size(), 5u);
  ASSERT_EQ(outer.inner.size(), 1u);
  EXPECT_EQ(outer.inner[0].size(), 3u);
  EXPECT_NEAR(outer.area, 14., 1e-12);
  expect_euler(network, faces);
}

TEST(JointNetwork, lengthens_ends_to_the_next_edge)
{
  JointNetwork network(0.01);
  add_square(network, 0., 4., 0);
  add(network, 0., 1., 3., 1.);
  add(network, 2., 2., 2., 3.); // one end to the joint below, one to the border
  network.cut();
  double added = 0.;
  EXPECT_EQ(network.extend_ends(added), 3u);
  EXPECT_NEAR(added, 1. + 1. + 1., 1e-12);
  EXPECT_EQ(network.extend_ends(added), 0u);
  const BlockFaces faces(network);
  EXPECT_EQ(faces.faces().size(), 3u);
  EXPECT_TRUE(faces.dead_ends().empty());
}

TEST(JointNetwork, refuses_borders_that_cross)
{
  JointNetwork network(0.01);
  add_square(network, 0., 4., 0);
  add_square(network, 3., 5., 1);
  EXPECT_THROW(network.cut(), InputError);
}

TEST(JointNetwork, comes_to_an_end_however_dense_the_joints_are)
{
  // Far more lines than the tolerance leaves room for.
  for (unsigned int seed = 1; seed <= 5; ++seed)
  {
    JointNetwork network(0.02);
    add_square(network, 0., 1., 0);
    std::mt19937 random(seed);
    const auto uniform = [&]() { return random() / 4294967296.; };
    for (unsigned int i = 0; i < 150; ++i)
      add(network, uniform(), uniform(), uniform(), uniform());
    network.cut();
    const BlockFaces faces(network);
    EXPECT_NEAR(total_area(faces), 1., 1e-12) << seed;
    expect_euler(network, faces);
  }
}
