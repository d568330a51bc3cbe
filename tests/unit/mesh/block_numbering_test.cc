// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "space_box.h"
#include "test_meshes.h"

#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>

#include <deal.II/base/utilities.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** n x n blocks of 2 x 2 squares, with a named bottom. */
  MeshData<2> tiles(const unsigned int n)
  {
    MeshData<2> data = grid(2 * n, 2 * n, "rock");
    for (unsigned int i = 1; i < n; ++i)
    {
      add_curve(data, "joint", 2. * i, 0, 2. * i, 2. * n);
      add_curve(data, "joint", 0, 2. * i, 2. * n, 2. * i);
    }
    add_curve(data, "bottom", 0, 0, 2. * n, 0);
    return data;
  }

  BlockMesh<2> split(const MeshData<2> &data)
  {
    SplitOptions options;
    options.joints_along = { "joint" };
    return split_into_blocks(data, options);
  }

  dealii::Point<2> corner(const BlockMesh<2> &mesh, const unsigned int block)
  {
    dealii::Point<2> p = mesh.vertices[mesh.block_first_vertex[block]];
    for (unsigned int v = mesh.block_first_vertex[block];
         v < mesh.block_first_vertex[block + 1]; ++v)
      for (unsigned int d = 0; d < 2; ++d)
        p[d] = std::min(p[d], mesh.vertices[v][d]);
    return p;
  }
  /** The cells of one block lie along the Hilbert curve as deal.II has it. */
  template <int dim>
  void expect_on_curve(const BlockMesh<dim> &mesh)
  {
    constexpr int n_bits = dim == 2 ? 31 : 21;
    std::vector<dealii::Point<dim>> centres(mesh.n_cells());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      for (const unsigned int v : mesh.cells[c])
        centres[c] += mesh.vertices[v];
      centres[c] = centres[c] / (dim + 1.);
    }
    std::uint64_t last = 0;
    for (const auto &place :
         dealii::Utilities::inverse_Hilbert_space_filling_curve(centres,
                                                                n_bits))
    {
      const auto next = dealii::Utilities::pack_integers<dim>(place, n_bits);
      EXPECT_GE(next, last);
      last = next;
    }
  }
} // namespace

TEST(BlockNumbering, FollowsTheHilbertCurve)
{
  expect_on_curve(split_into_blocks(grid(13, 7, "rock"), SplitOptions()));
  MeshData<3> box;
  const Count n   = { 5, 3, 7 };
  box.vertices    = box_points(n, 0.3, { -1., 2., 0.1 });
  box.cells       = box_cells(n);
  box.group_names = { "rock" };
  box.cell_group.assign(box.cells.size(), 0);
  expect_on_curve(split_into_blocks(box, SplitOptions()));
}

TEST(BlockNumbering, FollowsTheBoundaryOfEachBlock)
{
  const BlockMesh<2> mesh = split(tiles(3));
  expect_consistent(mesh, 36.);
  ASSERT_EQ(mesh.n_blocks(), 9U);
  for (unsigned int b = 0; b < 9; ++b)
  {
    const unsigned int first = mesh.block_first_vertex[b];
    EXPECT_EQ(mesh.block_first_vertex[b + 1] - first, 9U);
    for (unsigned int k = 0; k < 8; ++k)
      EXPECT_NEAR(
          mesh.vertices[first + k].distance(mesh.vertices[first + (k + 1) % 8]),
          1., 1e-12);
  }
}

TEST(BlockNumbering, PermutesBlocks)
{
  BlockMesh<2> mesh                     = split(tiles(2));
  const std::vector<unsigned int> order = { 2, 0, 3, 1 };
  SplitOptions options;
  options.joints_along        = { "joint" };
  const BlockMesh<2> permuted = split_into_blocks(tiles(2), options, &order);
  expect_consistent(permuted, 16.);
  for (unsigned int b = 0; b < 4; ++b)
    EXPECT_EQ(corner(permuted, b), corner(mesh, order[b]));

  renumber_blocks(mesh, order);
  EXPECT_EQ(mesh.cells, permuted.cells);
  EXPECT_ANY_THROW(renumber_blocks(mesh, { 0, 1, 2 }));
  EXPECT_ANY_THROW(renumber_blocks(mesh, { 0, 1, 2, 2 }));
}

TEST(BlockNumbering, RigidBlocksComeBehindTheOthers)
{
  EXPECT_EQ(order_rigid_last({ true, true, false, false, true, false }),
            std::vector<unsigned int>({ 2, 3, 5, 0, 1, 4 }));
  EXPECT_EQ(order_rigid_last({ false, false }),
            std::vector<unsigned int>({ 0, 1 }));
  EXPECT_EQ(order_rigid_last({ true, true }),
            std::vector<unsigned int>({ 0, 1 }));

  const BlockMesh<2> mesh = split(tiles(8));
  BlockMesh<2> ordered    = mesh;
  std::vector<bool> is_rigid;
  for (unsigned int b = 0; b < 64; ++b)
    is_rigid.push_back(b % 5 < 2);
  const auto order = order_rigid_last(is_rigid);
  renumber_blocks(ordered, order);
  expect_consistent(ordered, 256.);
  for (unsigned int b = 0; b < 64; ++b)
    EXPECT_EQ(corner(ordered, b), corner(mesh, order[b]));
}

TEST(MeshData, SurvivesSerialization)
{
  MeshData<2> data       = tiles(2);
  data.source            = "wall.geo";
  data.quadratic         = true;
  data.n_reoriented      = 3;
  const MeshData<2> copy = dealii::Utilities::unpack<MeshData<2>>(
      dealii::Utilities::pack(data, false), false);
  EXPECT_EQ(copy.vertices, data.vertices);
  EXPECT_EQ(copy.cells, data.cells);
  EXPECT_EQ(copy.cell_group, data.cell_group);
  EXPECT_EQ(copy.faces, data.faces);
  EXPECT_EQ(copy.face_name, data.face_name);
  EXPECT_EQ(copy.group_names, data.group_names);
  EXPECT_EQ(copy.face_names, data.face_names);
  EXPECT_EQ(copy.quadratic, data.quadratic);
  EXPECT_EQ(copy.n_reoriented, data.n_reoriented);
  EXPECT_EQ(copy.source, data.source);
}

TEST(MeshData, TurnsClockwiseTrianglesAndRefusesFlatOnes)
{
  MeshData<2> data = grid(1, 1, "rock");
  std::swap(data.cells[1][0], data.cells[1][1]);
  orient_cells(data);
  EXPECT_EQ(data.n_reoriented, 1U);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  expect_consistent(mesh, 1.);
  EXPECT_EQ(mesh.n_reoriented_cells, 1U);

  data.vertices[2] = dealii::Point<2>(2., 2.);
  expect_input_error([&] { orient_cells(data); },
                     { "has no area", "(0, 0)", "(2, 2)" });
}
