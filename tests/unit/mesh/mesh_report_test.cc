// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_meshes.h"

#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/mesh_report.h>

#include <cmath>

using namespace quoin;
using namespace quoin::test;

TEST(MeshReport, CountsAndMeasures)
{
  MeshData<2> data = grid(4, 2, "rock", -1.);
  add_curve(data, "bed", -1, 1, 3, 1);
  add_curve(data, "crack", 1, 1, 1, 2);
  SplitOptions options;
  options.joints_along    = { "bed", "crack" };
  BlockMesh<2> mesh       = split_into_blocks(data, options);
  const MeshReport report = make_mesh_report(mesh);

  EXPECT_EQ(report.n_blocks, 3U);
  EXPECT_EQ(report.n_cells, 16U);
  EXPECT_EQ(report.n_nodes, 22U);
  EXPECT_EQ(report.n_joint_faces, 5U);
  EXPECT_DOUBLE_EQ(report.joint_size.at("bed"), 4.);
  EXPECT_DOUBLE_EQ(report.joint_size.at("crack"), 1.);
  EXPECT_DOUBLE_EQ(report.total_joint_size, 5.);
  EXPECT_DOUBLE_EQ(report.shortest_edge, 1.);
  EXPECT_DOUBLE_EQ(report.longest_edge, std::sqrt(2.));
  EXPECT_NEAR(report.smallest_angle, 45., 1e-9);
  EXPECT_EQ(report.box[0], dealii::Point<3>(-1., 0., 0.));
  EXPECT_EQ(report.box[1], dealii::Point<3>(3., 2., 0.));
  EXPECT_EQ(report.n_joint_ends, 0U);
  EXPECT_EQ(report.unmatched_size, 0.);

  const std::string text = report.to_text();
  EXPECT_NE(text.find("3 blocks, 16 triangles"), std::string::npos) << text;
  EXPECT_NE(text.find("bed 4 m, crack 1 m"), std::string::npos) << text;
  EXPECT_TRUE(report.warnings().empty());
}

TEST(MeshReport, SpeaksOfQuadraticTriangles)
{
  MeshData<2> data = grid(4, 2, "rock");
  add_curve(data, "bed", 0, 1, 4, 1);
  data.quadratic = true;
  SplitOptions options;
  options.joints_along    = { "bed" };
  BlockMesh<2> mesh       = split_into_blocks(data, options);
  const MeshReport report = make_mesh_report(mesh);

  EXPECT_TRUE(report.quadratic);
  EXPECT_EQ(report.n_cells, 16U);
  EXPECT_EQ(report.n_joint_faces, 4U);
  // Of either block: 10 vertices, 17 edges.
  EXPECT_EQ(report.n_nodes, 54U);
  EXPECT_DOUBLE_EQ(report.total_joint_size, 4.);
  EXPECT_DOUBLE_EQ(report.shortest_edge, 1.);
  EXPECT_DOUBLE_EQ(report.longest_edge, std::sqrt(2.));
  EXPECT_NEAR(report.smallest_angle, 45., 1e-9);
  const std::string text = report.to_text();
  EXPECT_NE(text.find("2 blocks, 16 quadratic triangles"), std::string::npos)
      << text;
  EXPECT_NE(text.find("4 joint faces, 4 m"), std::string::npos) << text;
}

TEST(MeshReport, CountsJointEnds)
{
  MeshData<2> data = grid(4, 4, "rock");
  add_curve(data, "crack", 0, 1, 2, 1);
  add_curve(data, "short", 1, 3, 2, 3);
  SplitOptions options;
  options.joints_along    = { "crack", "short" };
  BlockMesh<2> mesh       = split_into_blocks(data, options);
  const MeshReport report = make_mesh_report(mesh);
  EXPECT_EQ(report.n_joint_ends, 3U);
  EXPECT_EQ(report.n_tied_joint_faces, 1U);
  EXPECT_NE(report.to_text().find("cannot open"), std::string::npos);
}

TEST(MeshReport, FindsEdgesThatTouchWithoutMatching)
{
  // A T: two blocks of half the element size hang on the right of another.
  MeshData<2> data;
  add_grid(data, 1, 1, "left");
  add_grid(data, 2, 1, "right", 1., 0., 0.5);
  add_grid(data, 2, 1, "right", 1., 0.5, 0.5);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  EXPECT_EQ(mesh.n_blocks(), 3U);
  EXPECT_EQ(mesh.joint_faces.size(), 2U); // between those on the right
  const MeshReport report = make_mesh_report(mesh);
  EXPECT_NEAR(report.unmatched_size, 1., 1e-12);
  EXPECT_NEAR(report.unmatched_position[0], 1., 1e-12);
  ASSERT_EQ(report.warnings().size(), 1U);
  EXPECT_NE(report.warnings()[0].find("over 1 m without matching"),
            std::string::npos)
      << report.warnings()[0];
}

TEST(MeshReport, FindsSlivers)
{
  MeshData<2> data     = grid(4, 2, "rock");
  const auto report_of = [&](const double x)
  {
    data.vertices[node_at(data, 1., 1.)][0] = x;
    BlockMesh<2> mesh                       = split_into_blocks(data, {});
    data.vertices[6][0]                     = 1.;
    return make_mesh_report(mesh);
  };
  EXPECT_NEAR(report_of(1.).smallest_height, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(report_of(0.01).sliver_text(), "");
  const MeshReport report = report_of(1e-5);
  EXPECT_NEAR(report.smallest_height, std::sqrt(0.5) * 1e-5, 1e-9);
  EXPECT_GE(report.median_edge, 1.);
  EXPECT_LE(report.median_edge, std::sqrt(2.));
  const std::string text = report.sliver_text();
  EXPECT_NE(text.find("is only 7.071e-06 m high"), std::string::npos) << text;
}

TEST(MeshReport, FindsSlenderBlocksWithFewCellsAcross)
{
  // Two plates on each other, turned by an angle.
  const auto slender = [](const unsigned int nx, const unsigned int ny,
                          const bool quadratic = false)
  {
    MeshData<2> data;
    for (const unsigned int i : { 0U, 1U })
    {
      const double y = i * ny;
      add_grid(data, nx, ny, i == 0 ? "lower" : "upper", 0., y);
      add_curve(data, i == 0 ? "bottom" : "joint", 0., y, nx, y);
      if (i == 1)
        add_curve(data, "top", 0., y + ny, nx, y + ny);
    }
    data.quadratic    = quadratic;
    BlockMesh<2> mesh = split_into_blocks(data, {});
    for (dealii::Point<2> &p : mesh.vertices)
      p = dealii::Point<2>(1e3 + 0.8 * p[0] - 0.6 * p[1],
                           0.6 * p[0] + 0.8 * p[1]);
    return make_mesh_report(mesh).slender;
  };
  const auto found = slender(12, 2);
  ASSERT_EQ(found.size(), 2U);
  for (const unsigned int b : { 0U, 1U })
  {
    const SlenderBlock &block = found[b];
    EXPECT_EQ(block.group, b);
    EXPECT_NEAR(block.thickness, 2., 1e-6);
    EXPECT_NEAR(block.length, 12., 1e-6);
    EXPECT_NEAR(std::abs(block.axis * dealii::Point<3>(-0.6, 0.8, 0.)), 1.,
                1e-9);
    EXPECT_NEAR(block.faces, 24., 1e-6);
    ASSERT_EQ(block.outer.size(), 1U);
    EXPECT_NEAR(block.outer.at(b == 0 ? "bottom" : "top"), 12., 1e-6);
    // Cells reach across one of two layers. So much a cantilever ten times as
    // long as thick loses.
    EXPECT_NEAR(block.n_across, 2., 1e-6);
    EXPECT_NEAR(block.lost_deflection(2), 0.39, 0.01);
  }
  EXPECT_TRUE(slender(12, 4).empty()) << "not slender";
  EXPECT_EQ(slender(17, 3).size(), 2U);
  EXPECT_TRUE(slender(17, 4).empty()) << "enough across";
  EXPECT_TRUE(slender(12, 2, true).empty());
}

TEST(MeshReport, DoesNotMistakeCornersForContacts)
{
  MeshData<2> data;
  add_grid(data, 2, 2, "a");
  add_grid(data, 2, 2, "b", 2., 2.);   // meets it in a point
  add_grid(data, 2, 2, "c", 2., -2.1); // passes it
  BlockMesh<2> mesh = split_into_blocks(data, {});
  EXPECT_EQ(make_mesh_report(mesh).unmatched_size, 0.);
}

TEST(MeshReport, FindsBlocksThatOverlap)
{
  const auto report = [](const double x, const double y, const double side)
  {
    MeshData<2> data;
    add_grid(data, 4, 4, "rock");
    add_grid(data, 2, 2, "lining", x, y, side);
    BlockMesh<2> mesh = split_into_blocks(data, SplitOptions());
    return make_mesh_report(mesh);
  };
  // Beside it, at a corner, on its side with other nodes; in part; within.
  EXPECT_FALSE(report(5., 1., 0.3).overlaps);
  EXPECT_FALSE(report(4., 4., 1.).overlaps);
  EXPECT_FALSE(report(4., 0.1, 0.3).overlaps);
  EXPECT_TRUE(report(3.3, 1.2, 1.).overlaps);
  EXPECT_NEAR(report(3.3, 1.2, 1.).overlap_depth, 0.7, 1e-12);
  // On it, a hundredth of an edge too low; less than a thousandth.
  EXPECT_NEAR(report(1.2, 3.99, 1.).overlap_depth, 0.01, 1e-12);
  EXPECT_FALSE(report(1.2, 3.9995, 1.).overlaps);
  const MeshReport within = report(1.1, 1.2, 0.3);
  EXPECT_TRUE(std::isinf(within.overlap_depth));
  EXPECT_NEAR(within.overlap_position.distance(dealii::Point<3>(1.4, 1.5, 0.)),
              0., 0.5);
  ASSERT_EQ(within.warnings().size(), 1U);
  EXPECT_NE(within.warnings()[0].find("a block lies within another"),
            std::string::npos);
}

TEST(MeshReport, MeshesOfAnArcThatDoNotMatchAreNoOverlap)
{
  // A ring of 9 chords around a disc of 64.
  MeshData<2> data;
  const auto add_point = [&](const double radius, const double angle)
  {
    data.vertices.emplace_back(radius * std::cos(angle),
                               radius * std::sin(angle));
    return static_cast<unsigned int>(data.vertices.size()) - 1;
  };
  const auto add_triangle
      = [&](const unsigned int a, const unsigned int b, const unsigned int c)
  {
    data.cells.push_back({ { a, b, c } });
    data.cell_group.push_back(0);
  };
  data.group_names = { "rock" };
  for (unsigned int k = 0; k < 64; ++k)
  {
    const unsigned int middle = add_point(0., 0.);
    const double at = 2. * M_PI * k / 64, next = 2. * M_PI * (k + 1) / 64;
    add_triangle(middle, add_point(1., at), add_point(1., next));
  }
  for (unsigned int k = 0; k < 9; ++k)
  {
    const double at = 2. * M_PI * k / 9, next = 2. * M_PI * (k + 1) / 9;
    const unsigned int a = add_point(1., at), b = add_point(1., next);
    const unsigned int c = add_point(2., next), d = add_point(2., at);
    add_triangle(a, d, c);
    add_triangle(a, c, b);
  }
  BlockMesh<2> mesh = split_into_blocks(data, SplitOptions());
  EXPECT_FALSE(make_mesh_report(mesh).overlaps);
}
