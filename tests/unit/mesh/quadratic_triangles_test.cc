// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_meshes.h"

#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/quadratic_triangles.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /**
   * All that the four cells of each quadratic triangle promise, and that faces
   * have a corner and a midside node each.
   */
  void expect_quadratic(const BlockMesh<2> &mesh)
  {
    ASSERT_TRUE(mesh.quadratic);
    ASSERT_EQ(mesh.is_midside.size(), mesh.n_vertices());
    for (const unsigned int first : mesh.block_first_cell)
      EXPECT_EQ(first % 4, 0U);
    for (unsigned int t = 0; t < mesh.n_cells() / 4; ++t)
    {
      const auto *const cell      = &mesh.cells[4 * t];
      const auto &[m01, m12, m20] = cell[3];
      const unsigned int mid[3]   = { m01, m12, m20 };
      for (unsigned int k = 0; k < 3; ++k)
      {
        EXPECT_EQ(cell[k][1], mid[k]);
        EXPECT_EQ(cell[k][2], mid[(k + 2) % 3]);
        EXPECT_FALSE(mesh.is_midside[cell[k][0]]);
        EXPECT_TRUE(mesh.is_midside[mid[k]]);
        const auto &from = mesh.vertices[cell[k][0]];
        const auto &to   = mesh.vertices[cell[(k + 1) % 3][0]];
        EXPECT_NEAR((mesh.vertices[mid[k]] - 0.5 * (from + to)).norm(), 0.,
                    1e-14);
        EXPECT_NEAR(area(mesh, 4 * t + k), area(mesh, 4 * t + 3), 1e-14);
        EXPECT_EQ(mesh.cell_group[4 * t + k], mesh.cell_group[4 * t + 3]);
      }
    }
    const auto n_midsides = [&](const std::array<unsigned int, 2> &edge)
    { return mesh.is_midside[edge[0]] + mesh.is_midside[edge[1]]; };
    for (const BlockFace &face : mesh.boundary_faces)
      EXPECT_EQ(n_midsides(face.vertices), 1);
    for (const JointFace &face : mesh.joint_faces)
      for (unsigned int k = 0; k < 2; ++k)
      {
        EXPECT_EQ(n_midsides(face.lower), 1);
        EXPECT_EQ(mesh.is_midside[face.lower[k]],
                  mesh.is_midside[face.upper[k]]);
      }
  }

  /** Four blocks of two groups, one of them apart, with two cracks. */
  MeshData cracked_blocks()
  {
    MeshData data;
    add_grid(data, 6, 4, "rock");
    add_curve(data, "bed", 0, 2, 6, 2);
    add_curve(data, "head", 2, 2, 2, 4);
    add_curve(data, "crack", 4, 0, 4, 1);
    add_curve(data, "short", 1, 1, 2, 1);
    add_grid(data, 6, 1, "concrete", 0., 4.);
    return data;
  }

  SplitOptions all_joints()
  {
    SplitOptions options;
    options.joints_along = { "bed", "head", "crack", "short" };
    return options;
  }
} // namespace

TEST(QuadraticTriangles, AreFourCellsInTheirOrder)
{
  MeshData data;
  add_grid(data, 2, 1, "rock");
  add_grid(data, 1, 1, "other", 5.);
  add_curve(data, "base", 0, 0, 2, 0);
  data.lines.push_back({ { 0, 2 } }); // no edge of the mesh
  data.line_name.push_back(1);
  const MeshData linear = data;
  cut_into_quadratic_triangles(data);

  EXPECT_TRUE(data.quadratic);
  // Two pieces of 6 and 4 nodes with 9 and 5 edges.
  EXPECT_EQ(data.vertices.size(), 10U + 14U);
  ASSERT_EQ(data.triangles.size(), 24U);
  for (unsigned int t = 0; t < linear.triangles.size(); ++t)
  {
    const auto &corner      = linear.triangles[t];
    const auto *const cell  = &data.triangles[4 * t];
    const auto &[a, b, c]   = cell[3];
    const unsigned int m[3] = { a, b, c };
    for (unsigned int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(cell[k], (std::array<unsigned int, 3>{
                             { corner[k], m[k], m[(k + 2) % 3] } }));
      EXPECT_EQ(data.vertices[m[k]],
                dealii::Point<2>(0.5
                                 * (linear.vertices[corner[k]]
                                    + linear.vertices[corner[(k + 1) % 3]])));
      EXPECT_GE(m[k], linear.vertices.size());
    }
    for (unsigned int k = 0; k < 4; ++k)
      EXPECT_EQ(data.triangle_group[4 * t + k], linear.triangle_group[t]);
  }

  ASSERT_EQ(data.lines.size(), 5U);
  EXPECT_EQ(data.line_name, std::vector<unsigned int>(5, 1));
  for (unsigned int l = 0; l < 4; ++l)
    EXPECT_NEAR(data.vertices[data.lines[l][1]][0]
                    - data.vertices[data.lines[l][0]][0],
                0.5, 1e-15);
  EXPECT_EQ(data.lines.back(), linear.lines.back());
}

TEST(QuadraticTriangles, StayTogetherInBlocks)
{
  MeshData data = cracked_blocks();
  BlockMesh<2> linear, mesh;
  split_into_blocks(data, all_joints(), linear);
  cut_into_quadratic_triangles(data);
  split_into_blocks(data, all_joints(), mesh);

  expect_consistent(mesh, 30., 1); // the crack of one edge is a hole
  expect_quadratic(mesh);
  EXPECT_EQ(mesh.n_blocks(), linear.n_blocks());
  EXPECT_EQ(mesh.n_cells(), 4 * linear.n_cells());
  EXPECT_EQ(mesh.boundary_faces.size(), 2 * linear.boundary_faces.size());
  EXPECT_EQ(mesh.joint_faces.size(), 2 * linear.joint_faces.size());
  for (unsigned int b = 0; b <= mesh.n_blocks(); ++b)
    EXPECT_EQ(mesh.block_first_cell[b], 4 * linear.block_first_cell[b]);

  const std::vector<unsigned int> order = { 2, 0, 3, 1 };
  ASSERT_EQ(mesh.n_blocks(), order.size());
  renumber_blocks(mesh, order);
  expect_consistent(mesh, 30., 1);
  expect_quadratic(mesh);
}

TEST(QuadraticTriangles, CracksEndAtCorners)
{
  MeshData data = cracked_blocks();
  cut_into_quadratic_triangles(data);
  BlockMesh<2> mesh;
  split_into_blocks(data, all_joints(), mesh);

  // Tips are shared; the middle of an edge between two tips is not.
  EXPECT_EQ(vertices_at(mesh, 4., 1.).size(), 1U);
  EXPECT_EQ(vertices_at(mesh, 4., 0.5).size(), 2U);
  EXPECT_EQ(vertices_at(mesh, 4., 0.).size(), 2U);
  EXPECT_EQ(vertices_at(mesh, 1., 1.).size(), 1U);
  EXPECT_EQ(vertices_at(mesh, 1.5, 1.).size(), 2U);
  EXPECT_EQ(vertices_at(mesh, 2., 1.).size(), 1U);
  for (const JointFace &face : mesh.joint_faces)
    EXPECT_FALSE(face.lower[0] == face.upper[0]
                 && face.lower[1] == face.upper[1]);
}

TEST(QuadraticTriangles, BlocksApartTouchAsLinearOnesDo)
{
  for (const double gap : { 0.8e-3, 1.2e-3 })
  {
    MeshData data;
    add_grid(data, 3, 1, "rock");
    add_grid(data, 3, 1, "rock", 0., 1. + gap);
    BlockMesh<2> linear, mesh;
    split_into_blocks(data, {}, linear);
    cut_into_quadratic_triangles(data);
    split_into_blocks(data, {}, mesh);
    EXPECT_EQ(linear.joint_faces.size(), gap < 1e-3 ? 3U : 0U);
    EXPECT_EQ(mesh.joint_faces.size(), 2 * linear.joint_faces.size());
  }
}

TEST(QuadraticTriangles, HaveSimpsonsWeights)
{
  MeshData data;
  add_grid(data, 2, 1, "rock");
  cut_into_quadratic_triangles(data);
  BlockMesh<2> mesh;
  split_into_blocks(data, {}, mesh);
  for (const BlockFace &face : mesh.boundary_faces)
  {
    double sum = 0.;
    for (const unsigned int v : face.vertices)
    {
      sum += mesh.edge_share(v);
      EXPECT_DOUBLE_EQ(mesh.edge_share(v),
                       mesh.is_midside[v] ? 2. / 3. : 1. / 3.);
    }
    EXPECT_DOUBLE_EQ(sum, 1.);
  }
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    for (const unsigned int v : mesh.mass_vertices(c))
      EXPECT_TRUE(mesh.is_midside[v]);
}
