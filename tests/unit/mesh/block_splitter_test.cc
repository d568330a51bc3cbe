// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_meshes.h"

#include <quoin/mesh/block_splitter.h>

#include <map>

using namespace quoin;
using namespace quoin::test;

namespace
{
  SplitOptions along(const std::vector<std::string> &curves)
  {
    SplitOptions options;
    options.joints_along = curves;
    return options;
  }

  double joint_length(const BlockMesh<2> &mesh, const std::string &name)
  {
    double length = 0.;
    for (const JointFace<2> &face : mesh.joint_faces)
      if (mesh.face_names[face.name] == name)
        length += mesh.vertices[face.lower[0]].distance(
            mesh.vertices[face.lower[1]]);
    return length;
  }
} // namespace

TEST(BlockSplitter, LeavesASquareWhole)
{
  MeshData<2> data = grid(3, 2, "rock");
  add_curve(data, "base", 0, 0, 3, 0);
  BlockMesh<2> mesh = split_into_blocks(data, {});

  expect_consistent(mesh, 6.);
  EXPECT_EQ(mesh.n_blocks(), 1U);
  EXPECT_EQ(mesh.n_vertices(), 12U);
  EXPECT_EQ(mesh.joint_faces.size(), 0U);
  ASSERT_EQ(mesh.boundary_faces.size(), 10U);
  unsigned int n_base = 0;
  for (const BlockFace<2> &face : mesh.boundary_faces)
    if (mesh.face_names[face.name] == "base")
    {
      ++n_base;
      EXPECT_EQ(mesh.vertices[face.vertices[0]][1], 0.);
      EXPECT_GT(mesh.vertices[face.vertices[1]][0],
                mesh.vertices[face.vertices[0]][0]);
    }
  EXPECT_EQ(n_base, 3U);
}

TEST(BlockSplitter, PutsTheLowerBlockBelowABedJoint)
{
  MeshData<2> data = grid(3, 2, "brick");
  add_curve(data, "bed", 0, 1, 3, 1);
  BlockMesh<2> mesh = split_into_blocks(data, along({ "bed" }));

  expect_consistent(mesh, 6.);
  EXPECT_EQ(mesh.n_blocks(), 2U);
  EXPECT_EQ(mesh.n_vertices(), 16U);
  ASSERT_EQ(mesh.joint_faces.size(), 3U);
  for (const JointFace<2> &face : mesh.joint_faces)
  {
    EXPECT_EQ(mesh.block_of_cell(face.cells[0]), 0U);
    EXPECT_EQ(mesh.block_of_cell(face.cells[1]), 1U);
    EXPECT_LT(mesh.vertices[face.lower[1]][0], mesh.vertices[face.lower[0]][0]);
  }
}

TEST(BlockSplitter, PutsTheLowerBlockLeftOfAHeadJoint)
{
  MeshData<2> data = grid(2, 3, "brick");
  add_curve(data, "head", 1, 0, 1, 3);
  BlockMesh<2> mesh = split_into_blocks(data, along({ "head" }));

  expect_consistent(mesh, 6.);
  ASSERT_EQ(mesh.joint_faces.size(), 3U);
  for (const JointFace<2> &face : mesh.joint_faces)
  {
    EXPECT_EQ(mesh.block_of_cell(face.cells[0]), 0U);
    EXPECT_GT(mesh.vertices[face.lower[1]][1], mesh.vertices[face.lower[0]][1]);
  }
}

TEST(BlockSplitter, SplitsAnXCrossingIntoFour)
{
  MeshData<2> data = grid(4, 4, "rock");
  add_curve(data, "first", 2, 0, 2, 4);
  add_curve(data, "second", 0, 2, 4, 2);
  BlockMesh<2> mesh = split_into_blocks(data, along({ "first", "second" }));

  expect_consistent(mesh, 16.);
  EXPECT_EQ(mesh.n_blocks(), 4U);
  EXPECT_DOUBLE_EQ(joint_length(mesh, "first"), 4.);
  EXPECT_DOUBLE_EQ(joint_length(mesh, "second"), 4.);
  const auto centre = vertices_at(mesh, 2, 2);
  ASSERT_EQ(centre.size(), 4U);
  for (const unsigned int v : centre)
    EXPECT_EQ(n_joint_sides(mesh, v), 2U);
  EXPECT_EQ(vertices_at(mesh, 2, 3).size(), 2U);
  EXPECT_EQ(vertices_at(mesh, 1, 1).size(), 1U);
}

TEST(BlockSplitter, SplitsATCrossingIntoThree)
{
  MeshData<2> data = grid(4, 4, "brick");
  add_curve(data, "bed", 0, 2, 4, 2);
  add_curve(data, "head", 2, 2, 2, 4);
  BlockMesh<2> mesh = split_into_blocks(data, along({ "bed", "head" }));

  expect_consistent(mesh, 16.);
  EXPECT_EQ(mesh.n_blocks(), 3U);
  const auto crossing = vertices_at(mesh, 2, 2);
  ASSERT_EQ(crossing.size(), 3U);
  for (const unsigned int v : crossing)
    EXPECT_EQ(n_joint_sides(mesh, v), 2U);
}

TEST(BlockSplitter, SplitsSixBlocksAtAVertex)
{
  MeshData<2> data;
  data.vertices.emplace_back(0., 0.);
  for (unsigned int i = 0; i < 6; ++i)
  {
    data.vertices.emplace_back(std::cos(i * M_PI / 3), std::sin(i * M_PI / 3));
    data.cells.push_back({ { 0, i + 1, (i + 1) % 6 + 1 } });
    data.cell_group.push_back(i);
    data.group_names.push_back("sector " + std::to_string(i));
  }
  SplitOptions options;
  options.between_all = true;
  BlockMesh<2> mesh   = split_into_blocks(data, options);

  expect_consistent(mesh, 6. * std::sqrt(0.1875));
  EXPECT_EQ(mesh.n_blocks(), 6U);
  EXPECT_EQ(mesh.n_vertices(), 18U);
  EXPECT_EQ(mesh.joint_faces.size(), 6U);
  EXPECT_NEAR(joint_length(mesh, ""), 6., 1e-12);
  EXPECT_EQ(vertices_at(mesh, 0, 0).size(), 6U);
}

TEST(BlockSplitter, SplitsBetweenTheGivenSurfacesOnly)
{
  MeshData<2> data = grid(3, 1, "a");
  data.group_names = { "a", "b", "c" };
  data.cell_group  = { 0, 0, 1, 1, 2, 2 };
  SplitOptions options;
  options.joints_between = { { "c", "b" } };
  BlockMesh<2> mesh      = split_into_blocks(data, options);

  expect_consistent(mesh, 3.);
  EXPECT_EQ(mesh.n_blocks(), 2U);
  ASSERT_EQ(mesh.joint_faces.size(), 1U);
  EXPECT_EQ(mesh.joint_faces[0].name, 0U);
  EXPECT_EQ(mesh.joint_faces[0].groups,
            (std::array<unsigned int, 2>{ { 1, 2 } }));
}

TEST(BlockSplitter, KeepsACrackThatEndsInside)
{
  MeshData<2> data = grid(4, 4, "rock");
  add_curve(data, "crack", 0, 2, 2, 2);
  BlockMesh<2> mesh = split_into_blocks(data, along({ "crack" }));

  expect_consistent(mesh, 16.);
  EXPECT_EQ(mesh.n_blocks(), 1U);
  ASSERT_EQ(mesh.joint_faces.size(), 2U);
  EXPECT_EQ(vertices_at(mesh, 0, 2).size(), 2U);
  EXPECT_EQ(vertices_at(mesh, 1, 2).size(), 2U);
  const auto tip = vertices_at(mesh, 2, 2);
  ASSERT_EQ(tip.size(), 1U);
  EXPECT_EQ(n_joint_sides(mesh, tip[0]), 2U);
}

TEST(BlockSplitter, KeepsACrackWithTwoTips)
{
  MeshData<2> data = grid(4, 4, "rock");
  add_curve(data, "crack", 1, 1, 3, 3);
  BlockMesh<2> mesh = split_into_blocks(data, along({ "crack" }));

  expect_consistent(mesh, 16., 1);
  EXPECT_EQ(mesh.n_blocks(), 1U);
  EXPECT_EQ(mesh.n_vertices(), 26U);
}

TEST(BlockSplitter, RefusesJointEndsIfAsked)
{
  MeshData<2> data = grid(4, 4, "rock");
  add_curve(data, "crack", 0, 2, 2, 2);
  SplitOptions options = along({ "crack" });
  options.joint_ends   = SplitOptions::refuse;
  expect_input_error([&] { split_into_blocks(data, options); },
                     { "curve 'crack' ends inside a block at (2, 2)",
                       "Joint ends inside blocks = keep" });

  add_curve(data, "crack", 2, 2, 4, 2);
  BlockMesh<2> mesh = split_into_blocks(data, options);
  EXPECT_EQ(mesh.n_blocks(), 2U);
}

TEST(BlockSplitter, FindsJointsOfBlocksThatAreApart)
{
  // Within the tolerance, a thousandth of the shortest edge.
  MeshData<2> data;
  add_grid(data, 2, 1, "below");
  add_grid(data, 2, 1, "above", 3e-4, 1. - 3e-4);
  data.faces        = { { { node_at(data, 0, 1), node_at(data, 1, 1) } } };
  data.face_name    = { index_of("bed", data.face_names) };
  BlockMesh<2> mesh = split_into_blocks(data, {});

  expect_consistent(mesh, 2. * (2. - 3e-4));
  EXPECT_EQ(mesh.n_blocks(), 2U);
  EXPECT_EQ(mesh.n_vertices(), 12U);
  ASSERT_EQ(mesh.joint_faces.size(), 2U);
  EXPECT_NEAR(joint_length(mesh, "bed"), 1., 1e-12);
  EXPECT_NEAR(joint_length(mesh, ""), 1., 1e-12);
  EXPECT_EQ(mesh.boundary_faces.size(), 8U);

  // The joint is closed: nodes have met half way.
  for (const JointFace<2> &face : mesh.joint_faces)
    for (unsigned int k = 0; k < 2; ++k)
      EXPECT_EQ(mesh.vertices[face.lower[k]], mesh.vertices[face.upper[k]]);
  EXPECT_NEAR(mesh.largest_shift, std::sqrt(.5) * 3e-4, 1e-12);

  // Named joints may lie on either side; that is no dangling curve.
  data.faces[0] = { { node_at(data, 3e-4, 1. - 3e-4),
                      node_at(data, 1. + 3e-4, 1. - 3e-4) } };
  mesh          = split_into_blocks(data, along({ "bed" }));
  EXPECT_NEAR(joint_length(mesh, "bed"), 1., 1e-12);

  SplitOptions strict;
  strict.coincidence_tolerance = 1e-4;
  mesh                         = split_into_blocks(data, strict);
  EXPECT_EQ(mesh.joint_faces.size(), 0U);
}

TEST(BlockSplitter, FindsCoincidentEdgesFarFromTheOrigin)
{
  MeshData<2> data;
  for (unsigned int j = 0; j < 5; ++j)
    for (unsigned int i = 0; i < 5; ++i)
      add_grid(data, 2, 2, "brick", 1e4 + .2 * i, -3e3 + .2 * j, .1);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  EXPECT_EQ(mesh.n_blocks(), 25U);
  EXPECT_EQ(mesh.joint_faces.size(), 80U);
  EXPECT_EQ(mesh.boundary_faces.size(), 40U);
}

TEST(BlockSplitter, SeparatesBlocksThatMeetInAPoint)
{
  MeshData<2> data = grid(2, 2, "rock");
  data.cells.erase(data.cells.begin() + 2, data.cells.begin() + 6);
  data.cell_group.resize(4);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  expect_consistent(mesh, 2.);
  EXPECT_EQ(mesh.n_blocks(), 2U);
  EXPECT_EQ(mesh.n_vertices(), 8U);
}

TEST(BlockSplitter, RefusesNamesThatDoNotExist)
{
  MeshData<2> data = grid(2, 2, "rock");
  add_curve(data, "fault", 0, 1, 2, 1);
  BlockMesh<2> mesh;
  expect_input_error([&] { split_into_blocks(data, along({ "falt" })); },
                     { "no physical curve 'falt'",
                       "The mesh has fault. The nearest one is 'fault'." });
  expect_input_error([&] { split_into_blocks(data, along({ "" })); },
                     { "no physical curve ''" });
  SplitOptions options;
  options.joints_between = { { "rock", "soil" } };
  expect_input_error([&] { split_into_blocks(data, options); },
                     { "no physical surface 'soil'", "The mesh has rock." });
  options.joints_between = { { "rock", "rock" } };
  expect_input_error([&] { split_into_blocks(data, options); },
                     { "'rock' with itself" });
}

TEST(BlockSplitter, RefusesJointsOnTheOuterBoundary)
{
  MeshData<2> data = grid(2, 2, "rock");
  add_curve(data, "fault", 0, 1, 2, 1);
  add_curve(data, "fault", 2, 1, 2, 2);
  expect_input_error([&] { split_into_blocks(data, along({ "fault" })); },
                     { "curve 'fault' dangles at (2, 1.5)" });
}

TEST(BlockSplitter, RefusesCurvesThatAreNoEdges)
{
  MeshData<2> data = grid(2, 2, "rock");
  add_curve(data, "fault", 0, 1, 1, 0); // across the diagonals
  BlockMesh<2> mesh;
  expect_input_error(
      [&] { split_into_blocks(data, along({ "fault" })); },
      { "curve 'fault' is no edge of the mesh at (0.5, 0.5)", "In Surface" });
  EXPECT_NO_THROW(split_into_blocks(data, {}));

  data.faces.clear();
  data.face_name.clear();
  expect_input_error([&] { split_into_blocks(data, along({ "fault" })); },
                     { "curve 'fault' has no line elements" });
}

TEST(BlockSplitter, RefusesCurvesOnEachOther)
{
  MeshData<2> data = grid(2, 2, "rock");
  add_curve(data, "fault", 0, 1, 2, 1);
  add_curve(data, "seam", 1, 1, 2, 1);
  expect_input_error([&] { split_into_blocks(data, {}); },
                     { "'fault' and 'seam' lie on each other at (1.5, 1)" });
}

TEST(BlockSplitter, RefusesOverlaps)
{
  MeshData<2> data  = grid(2, 2, "rock");
  MeshData<2> twice = data;
  twice.cells.push_back(twice.cells.front());
  twice.cell_group.push_back(0);
  expect_input_error([&] { split_into_blocks(twice, {}); },
                     { "triangles overlap" });

  add_grid(data, 2, 2, "rock");
  expect_input_error([&] { split_into_blocks(data, {}); },
                     { "blocks overlap" });
  expect_input_error([&] { split_into_blocks(MeshData<2>(), {}); },
                     { "no triangles" });
}

TEST(BlockSplitter, GivesTheSameBlocksForAnyOrderOfTriangles)
{
  MeshData<2> data = grid(6, 6, "rock");
  add_curve(data, "joint", 0, 2, 6, 2);
  add_curve(data, "joint", 3, 2, 3, 6);
  MeshData<2> reversed = data;
  std::reverse(reversed.cells.begin(), reversed.cells.end());
  for (auto &triangle : reversed.cells)
    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());

  std::map<unsigned int, unsigned int> sizes[2];
  const MeshData<2> *meshes[2] = { &data, &reversed };
  for (unsigned int i = 0; i < 2; ++i)
  {
    BlockMesh<2> mesh = split_into_blocks(*meshes[i], along({ "joint" }));
    expect_consistent(mesh, 36.);
    EXPECT_DOUBLE_EQ(joint_length(mesh, "joint"), 10.);
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
      ++sizes[i][mesh.block_first_vertex[b + 1] - mesh.block_first_vertex[b]];
  }
  EXPECT_EQ(sizes[0], sizes[1]);
}
