// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/layout/block_surfaces.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <fstream>

using namespace quoin;

namespace
{
  /** A file for the time of a test. */
  class TestFile
  {
  public:
    TestFile(const std::string &ending, const std::string &text)
      : name(testing::TempDir() + "block_surfaces" + ending)
    {
      std::ofstream(name, std::ios::binary) << text;
    }
    ~TestFile()
    {
      std::remove(name.c_str());
    }
    const std::string name;
  };

  /** Vertices and faces of the box from @p x to @p x + 1, 2 high. */
  std::string obj_box(const std::string &object, const double x,
                      const unsigned int first)
  {
    std::string text = "o " + object + "\n";
    for (const int z : { 0, 2 })
      for (const int y : { 0, 1 })
        for (const double dx : { 0., 1. })
          text += "v " + std::to_string(x + dx) + " " + std::to_string(y) + " "
                  + std::to_string(z) + "\n";
    // Two of them point inwards, as careless programs write them.
    for (const auto &face :
         std::vector<std::vector<unsigned int>>{ { 0, 1, 3, 2 },
                                                 { 4, 5, 7, 6 },
                                                 { 0, 1, 5, 4 },
                                                 { 2, 6, 7, 3 },
                                                 { 0, 2, 6, 4 },
                                                 { 1, 3, 7, 5 } })
    {
      text += "f";
      for (const unsigned int v : face)
        text += " " + std::to_string(first + v) + "/1";
      text += "\n";
    }
    return text;
  }

  std::string failure(const std::string &ending, const std::string &text)
  {
    const TestFile file(ending, text);
    try
    {
      read_block_surfaces(file.name);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  void expect_failure(const std::string &ending, const std::string &text,
                      const std::string &part)
  {
    EXPECT_NE(failure(ending, text).find(part), std::string::npos)
        << failure(ending, text);
  }
} // namespace

TEST(BlockSurfaces, ObjOfTwoBoxesThatTouch)
{
  const TestFile file(".obj", "# two\nvn 0 0 1\n" + obj_box("a", 0., 1)
                                  + "usemtl hard\n" + obj_box("b", 1., 9));
  const BlockSurfaces blocks = read_block_surfaces(file.name);
  ASSERT_EQ(blocks.blocks.size(), 2U);
  EXPECT_EQ(blocks.blocks[0].group, "block");
  EXPECT_EQ(blocks.blocks[1].group, "hard");
  EXPECT_EQ(blocks.points.size(), 12U); // four of them are the same
  EXPECT_EQ(blocks.n_ignored, 1U);
  for (const auto &block : blocks.blocks)
  {
    EXPECT_NEAR(block.volume, 2., 1e-12);
    EXPECT_EQ(block.faces.size(), 6U);
  }

  // Their common face becomes a joint, whole.
  const GmshGeometry geometry = block_geometry(blocks, 0.5);
  ASSERT_EQ(geometry.joint_curves, std::vector<std::string>{ "joint" });
  const auto mesh = std::get<MeshData<3>>(mesh_any_gmsh_geometry(
      geometry.text, file.name, MPI_COMM_SELF, MeshDimension::three));
  SplitOptions options;
  options.joints_along = geometry.joint_curves;
  BlockMesh<3> split   = split_into_blocks(mesh, options);
  EXPECT_EQ(split.n_blocks(), 2U);
  double area = 0.;
  for (const auto &face : split.joint_faces)
  {
    const auto edge = [&](const unsigned int k)
    { return split.vertices[face.lower[k]] - split.vertices[face.lower[0]]; };
    area += 0.5 * cross_product_3d(edge(1), edge(2)).norm();
  }
  EXPECT_NEAR(area, 2., 1e-9);
}

TEST(BlockSurfaces, OneBlockAndBlocksThatDoNotTouch)
{
  for (const unsigned int n : { 1U, 2U })
  {
    const TestFile file(".obj", obj_box("a", 0., 1)
                                    + (n == 2 ? obj_box("b", 1.5, 9) : ""));
    const GmshGeometry geometry
        = block_geometry(read_block_surfaces(file.name), 0.5);
    const auto mesh = std::get<MeshData<3>>(mesh_any_gmsh_geometry(
        geometry.text, file.name, MPI_COMM_SELF, MeshDimension::three));
    SplitOptions options;
    options.joints_along    = geometry.joint_curves;
    options.may_lack_joints = true;
    BlockMesh<3> split      = split_into_blocks(mesh, options);
    EXPECT_EQ(split.n_blocks(), n);
    EXPECT_TRUE(split.joint_faces.empty());
  }
}

TEST(BlockSurfaces, FacesWithHolesAndPlanesOfTriangles)
{
  // A frame: the box of side 3 with a hole of side 1 through it, in triangles
  // that lie two by two in a plane.
  std::string text = "solid frame\n";
  const auto facet = [&](const std::array<std::array<double, 3>, 3> &corners)
  {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto &p : corners)
      text += "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1])
              + " " + std::to_string(p[2]) + "\n";
    text += "endloop\nendfacet\n";
  };
  const auto quad = [&](const std::array<std::array<double, 3>, 4> &c)
  {
    facet({ c[0], c[1], c[2] });
    facet({ c[0], c[2], c[3] });
  };
  const double outer[4][2] = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 } };
  const double inner[4][2] = { { 1, 1 }, { 2, 1 }, { 2, 2 }, { 1, 2 } };
  for (unsigned int i = 0; i < 4; ++i)
  {
    const auto &a = outer[i], &b = outer[(i + 1) % 4];
    const auto &c = inner[i], &d = inner[(i + 1) % 4];
    for (const double z : { 0., 1. })
      quad({ { { a[0], a[1], z },
               { b[0], b[1], z },
               { d[0], d[1], z },
               { c[0], c[1], z } } });
    for (const auto &[from, to] : { std::pair(a, b), std::pair(c, d) })
      quad({ { { from[0], from[1], 0. },
               { to[0], to[1], 0. },
               { to[0], to[1], 1. },
               { from[0], from[1], 1. } } });
  }
  const TestFile file(".stl", text + "endsolid\n");
  const BlockSurfaces blocks = read_block_surfaces(file.name);
  ASSERT_EQ(blocks.blocks.size(), 1U);
  EXPECT_NEAR(blocks.blocks[0].volume, 8., 1e-12);
  ASSERT_EQ(blocks.blocks[0].faces.size(), 10U);
  unsigned int n_holes = 0;
  for (const auto &face : blocks.blocks[0].faces)
    n_holes += face.loops.size() - 1;
  EXPECT_EQ(n_holes, 2U);
}

TEST(BlockSurfaces, BinaryStl)
{
  // A tetrahedron.
  const float p[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  const unsigned int facets[4][3]
      = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 2, 3 }, { 1, 2, 3 } };
  std::string bytes = "solid of a program that writes binary files";
  bytes.resize(80, ' ');
  const auto append = [&](const auto &value)
  { bytes.append(reinterpret_cast<const char *>(&value), sizeof(value)); };
  append(std::uint32_t(4));
  for (const auto &facet : facets)
  {
    for (unsigned int k = 0; k < 3; ++k)
      append(0.f);
    for (const unsigned int v : facet)
      for (const float x : p[v])
        append(x);
    append(std::uint16_t(0));
  }
  const TestFile file(".stl", bytes);
  const BlockSurfaces blocks = read_block_surfaces(file.name);
  ASSERT_EQ(blocks.blocks.size(), 1U);
  EXPECT_NEAR(blocks.blocks[0].volume, 1. / 6., 1e-7);

  expect_failure(".stl", bytes.substr(0, 150), "this is no STL file");
}

TEST(BlockSurfaces, GridOf3decWithZones)
{
  const std::string points = "* a comment\nTOL 1e-3\nG 7 0 0 0\nG 8, 1, 0, 0\n"
                             "G 9 0 1 0\nG 10 0 0 1\nG 20 1 1 1\n";
  const TestFile file(".3dgrid", points
                                     + "Z 1 7 8 9 10\nZ 2 8 9 10 20\n"
                                       "B 3 5 Z 1 2\n");
  const BlockSurfaces blocks = read_block_surfaces(file.name);
  ASSERT_EQ(blocks.blocks.size(), 1U);
  EXPECT_EQ(blocks.blocks[0].group, "region 5");
  EXPECT_EQ(blocks.blocks[0].faces.size(), 6U);
  EXPECT_NEAR(blocks.blocks[0].volume, 1. / 6. + 1. / 3., 1e-12);

  expect_failure(".3dgrid", points + "Z 1 7 8 9\n",
                 "line 8: a zone needs 4 gridpoints.");
  expect_failure(".3dgrid", points + "F 1 7 8 99\n",
                 "line 8: gridpoint 99 has no G line before this one.");
  expect_failure(".3dgrid", points + "B 1 1 F 4\n",
                 "line 8: face 4 has no line before this one.");
  expect_failure(".3dgrid", points + "B 1 1 4\n",
                 "'F' and faces or 'Z' and zones must follow, not '4'");
}

TEST(BlockSurfaces, RefusesWhatIsNoBlock)
{
  const std::string box = obj_box("a", 0., 1);
  expect_failure(".obj", "# nothing\n", "there is no block in it");
  expect_failure(".obj", "v 0 0\n",
                 "line 1: a coordinate is missing or no number");
  expect_failure(".obj", "v 0 0 0\nf 1 2 3\n",
                 "line 2: vertex '2' is not there");
  expect_failure(".obj", "v 0 0 0\nv 1 0 0\nf 1 2\n",
                 "line 3: a face needs three vertices.");
  expect_failure(".obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
                 "there is no block in it");
  expect_failure(".obj", "v 0 0 0\nf 1 1 1\n", "there is no block in it");
  std::string two = box;
  two.insert(two.rfind('f'), "usemtl other\n");
  expect_failure(".obj", two,
                 "block 'a' has the materials 'block' and 'other'");
  expect_failure(".obj", box.substr(0, box.rfind('f')),
                 "the surface of block 'a' is not closed: 1 face has the edge");
}

TEST(BlockSurfaces, UnusedVerticesDoNotCount)
{
  const TestFile file(".obj", "v 1000 0 0\n" + obj_box("a", 0., 2));
  const BlockSurfaces blocks = read_block_surfaces(file.name);
  EXPECT_EQ(blocks.points.size(), 8U);
}

TEST(BlockSurfaces, BlocksThatOverlapAreRefused)
{
  // Beside each other by half, and one inside the other.
  const std::string other = obj_box("b", 0.5, 9);
  std::string inner       = "o inner\n";
  for (const double z : { 0.5, 1.5 })
    for (const double y : { 0.25, 0.75 })
      for (const double x : { 0.25, 0.75 })
        inner += "v " + std::to_string(x) + " " + std::to_string(y) + " "
                 + std::to_string(z) + "\n";
  inner += other.substr(other.find('f'));
  for (const std::string &second : { other, inner })
  {
    const TestFile file(".obj", obj_box("a", 0., 1) + second);
    const GmshGeometry geometry
        = block_geometry(read_block_surfaces(file.name), 0.5);
    try
    {
      mesh_any_gmsh_geometry(geometry.text, file.name, MPI_COMM_SELF,
                             MeshDimension::three);
      FAIL();
    }
    catch (const InputError &error)
    {
      EXPECT_NE(
          std::string(error.what()).find("blocks overlap, or one is hollow"),
          std::string::npos)
          << error.what();
    }
  }
}
