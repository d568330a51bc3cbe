// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_meshes.h"

#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/mesh_report.h>

#include <sys/wait.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <utility>

using namespace quoin;
using namespace quoin::test;

namespace
{
  std::string write(const std::string &name, const std::string &text)
  {
    const std::string path = ::testing::TempDir() + "/quoin_" + name;
    std::ofstream(path) << text;
    return path;
  }

  /** Two unit squares with a joint between them. */
  const std::string two_squares
      = "Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5};\n"
        "Point(3) = {2, 0, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};\n"
        "Point(5) = {1, 1, 0, 0.5}; Point(6) = {2, 1, 0, 0.5};\n"
        "Line(1) = {1, 2}; Line(2) = {2, 5}; Line(3) = {5, 4};\n"
        "Line(4) = {4, 1}; Line(5) = {2, 3}; Line(6) = {3, 6};\n"
        "Line(7) = {6, 5};\n"
        "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
        "Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};\n";
  const std::string names
      = "Physical Surface(\"left\") = {1}; Physical Surface(\"right\") = {2};\n"
        "Physical Curve(\"joint\") = {2}; Physical Curve(\"base\") = {1, 5};\n";

  /** The same, two triangles each, as text of format 2.2. */
  std::string msh2(const std::string &nodes, const std::string &elements)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
           "$PhysicalNames\n3\n1 7 \"joint\"\n2 1 \"left\"\n2 2 \"right\"\n"
           "$EndPhysicalNames\n$Nodes\n"
           + nodes + "$EndNodes\n$Elements\n" + elements + "$EndElements\n";
  }
  const std::string nodes    = "6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n"
                               "4 0 1 0\n5 1 1 0\n60 2 1 0\n";
  const std::string elements = "5\n1 1 2 7 1 2 5\n2 2 2 1 1 1 2 5\n"
                               "3 2 2 1 1 1 5 4\n4 2 2 2 2 2 3 60\n"
                               "5 2 2 2 2 2 60 5\n";

  void expect_two_squares(const MeshData &data)
  {
    EXPECT_EQ(data.group_names, (std::vector<std::string>{ "left", "right" }));
    SplitOptions options;
    options.joints_along = { "joint" };
    BlockMesh<2> mesh;
    split_into_blocks(data, options, mesh);
    expect_consistent(mesh, 2.);
    EXPECT_EQ(mesh.n_blocks(), 2U);
    EXPECT_DOUBLE_EQ(make_mesh_report(mesh).joint_length.at("joint"), 1.);
    for (const JointFace<2> &face : mesh.joint_faces)
      EXPECT_EQ(face.groups, (std::array<unsigned int, 2>{ { 0, 1 } }));
  }

  void expect_refused(const std::string &path,
                      const std::vector<std::string> &parts)
  {
    std::vector<std::string> all = { path };
    all.insert(all.end(), parts.begin(), parts.end());
    expect_input_error([&] { read_gmsh(path); }, all);
  }
} // namespace

TEST(GmshReader, MeshesAGeometry)
{
  const std::string path = write("two.geo", two_squares + names);
  const MeshData data    = read_gmsh(path);
  EXPECT_EQ(data.line_names, (std::vector<std::string>{ "", "base", "joint" }));
  EXPECT_EQ(data.source, path);
  EXPECT_EQ(data.n_reoriented, 0U);
  expect_two_squares(data);
  expect_two_squares(read_gmsh(path, MPI_COMM_WORLD));
}

TEST(GmshReader, SaysThatTrianglesAreToHaveMidsideNodes)
{
  const std::string path = write("quadratic.geo", two_squares + names);
  const MeshData plain   = read_gmsh(path);
  const MeshData data    = read_gmsh(path, TriangleKind::quadratic);
  const MeshData received
      = read_gmsh(path, MPI_COMM_SELF, TriangleKind::quadratic);
  EXPECT_FALSE(plain.quadratic);
  for (const MeshData *mesh : { &data, &received })
  {
    EXPECT_TRUE(mesh->quadratic);
    EXPECT_EQ(mesh->triangles, plain.triangles);
    EXPECT_EQ(mesh->lines, plain.lines);
    expect_two_squares(*mesh);
  }
}

TEST(GmshReader, CutsQuadranglesCrosswise)
{
  const std::string path = write("crossed.geo", two_squares + names);
  const MeshData data    = read_gmsh(path, TriangleKind::crossed);
  expect_two_squares(data);
  expect_two_squares(read_gmsh(path, MPI_COMM_WORLD, TriangleKind::crossed));
  EXPECT_EQ(data.triangles.size() % 4, 0U);

  // A quadrangle beside two triangles.
  const std::string mixed = "4\n1 1 2 7 1 2 5\n2 3 2 1 1 1 2 5 4\n"
                            "3 2 2 2 2 2 3 60\n4 2 2 2 2 2 60 5\n";
  const std::string file  = write("mixed.msh", msh2(nodes, mixed));
  const MeshData some     = read_gmsh(file, TriangleKind::crossed);
  EXPECT_EQ(some.triangles.size(), 6U);
  EXPECT_EQ(some.vertices.size(), 7U);
  EXPECT_EQ(some.triangle_group,
            (std::vector<unsigned int>{ 1, 1, 0, 0, 0, 0 }));
  double area = 0.;
  for (const auto &t : some.triangles)
    area += 0.5
            * ((some.vertices[t[1]][0] - some.vertices[t[0]][0])
                   * (some.vertices[t[2]][1] - some.vertices[t[0]][1])
               - (some.vertices[t[1]][1] - some.vertices[t[0]][1])
                     * (some.vertices[t[2]][0] - some.vertices[t[0]][0]));
  EXPECT_DOUBLE_EQ(area, 2.);
  expect_refused(file, { "surface 1", "Quad", "Triangles = crossed" });
  try
  {
    read_gmsh(write("uncut.msh", msh2(nodes, elements)), TriangleKind::crossed);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("no quadrangles"),
              std::string::npos);
  }
}

TEST(GmshReader, ReadsFormat22)
{
  const MeshData data = read_gmsh(write("two22.msh", msh2(nodes, elements)));
  EXPECT_EQ(data.vertices.size(), 6U);
  EXPECT_EQ(data.triangles.size(), 4U);
  EXPECT_EQ(data.lines.size(), 1U);
  expect_two_squares(data);
}

TEST(GmshReader, ReadsAllFormatsThatGmshWrites)
{
  const std::string geo   = write("formats.geo", two_squares + names);
  const MeshData expected = read_gmsh(geo);
  for (const char *version : { "2.2", "4.1" })
    for (const char *binary : { "0", "1" })
    {
      SCOPED_TRACE(std::string(version) + ", binary " + binary);
      const std::string format = std::string("Mesh.MshFileVersion = ") + version
                                 + "; Mesh.Binary = " + binary + ";\n";
      const std::string file = ::testing::TempDir() + "/quoin_format.msh";
      write_gmsh_mesh(write("format.geo", format + two_squares + names), file);
      const MeshData data = read_gmsh(file);
      expect_two_squares(data);
      EXPECT_EQ(data.triangles.size(), expected.triangles.size());
      EXPECT_EQ(data.vertices.size(), expected.vertices.size());
      EXPECT_EQ(data.lines.size(), expected.lines.size());
    }
}

TEST(GmshReader, KeepsCoincidentNodesApart)
{
  const MeshData data = read_gmsh(
      write("apart.msh",
            msh2("8\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"
                 "12 1 0 0\n15 1 1 0\n",
                 "5\n1 1 2 7 1 12 15\n2 2 2 1 1 1 2 5\n3 2 2 1 1 1 5 4\n"
                 "4 2 2 2 2 12 3 6\n5 2 2 2 2 12 6 15\n")));
  EXPECT_EQ(data.vertices.size(), 8U);
  expect_two_squares(data);
}

TEST(GmshReader, TurnsClockwiseSurfaces)
{
  std::string geometry = two_squares;
  geometry.replace(geometry.find("{1, 2, 3, 4}"), 12, "{-4, -3, -2, -1}");
  const MeshData data = read_gmsh(write("clockwise.geo", geometry + names));
  EXPECT_GT(data.n_reoriented, 0U);
  expect_two_squares(data);
}

TEST(GmshReader, RefusesFilesItCannotRead)
{
  expect_refused("nowhere/wall.geo", { "no such file", "Mesh/File" });
  expect_refused(::testing::TempDir(), { "cannot be read" });
  expect_refused(write("mesh.txt", "x"), { "'.txt'", ".geo", ".msh" });
  expect_refused(write("empty.msh", ""), { "empty" });
  expect_refused(write("garbage.msh", "$MeshFormat\nnonsense\n"), { "gmsh" });
  expect_refused(write("syntax.geo", "Point(1) = {0, 0;\nLine(1 = 2\n"),
                 { "gmsh could not", "syntax error", "line 1" });
  expect_refused(write("words.msh", "no mesh at all\n"), { "Mesh '" });
  expect_input_error([] { read_gmsh("nowhere/wall.geo", MPI_COMM_WORLD); },
                     { "no such file" });
}

TEST(GmshReader, SurvivesTheEndOfGmsh)
{
  const std::string fine = write("fine.geo", two_squares + names);
  const auto n_open      = []()
  {
    namespace fs = std::filesystem;
    return std::distance(fs::directory_iterator("/proc/self/fd"), {});
  };
  const auto n_open_before = n_open();
  // A stack that overflows, which later versions may refuse; a command.
  const std::string deep
      = "a = " + std::string(200000, '(') + "1" + std::string(200000, ')');
  expect_refused(write("deep.geo", deep + ";\n"), { "gmsh" });
  expect_refused(write("end.geo", two_squares + names + "Exit;\n"),
                 { "gmsh came to its end", "Exit", "repair it" });
  expect_two_squares(read_gmsh(fine));

  EXPECT_EQ(n_open(), n_open_before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1); // no process is left
  EXPECT_EQ(errno, ECHILD);
}

TEST(GmshReader, MeshesATextAsAFile)
{
  const std::string text = two_squares + names;
  const MeshData made = mesh_gmsh_geometry(text, "section Wall", MPI_COMM_SELF);
  const MeshData read = read_gmsh(write("text.geo", text));
  EXPECT_EQ(made.source, "section Wall");
  EXPECT_EQ(made.vertices, read.vertices);
  EXPECT_EQ(made.triangles, read.triangles);
  EXPECT_EQ(made.lines, read.lines);
  expect_input_error(
      [] {
        mesh_gmsh_geometry("Point(1) = {0, 0;", "section Wall", MPI_COMM_SELF);
      },
      { "Mesh 'section Wall': gmsh could not", "syntax error",
        "Change the parameters of that section." });
}

TEST(GmshReader, RefusesMeshesWithoutTriangles)
{
  expect_refused(write("points.geo",
                       "Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1};\n"
                       "Line(1) = {1, 2}; Physical Curve(\"a\") = {1};\n"),
                 { "no triangles", "gmsh -2" });
  expect_refused(write("lines.msh", msh2(nodes, "1\n1 1 2 7 1 2 5\n")),
                 { "no triangles" });
}

TEST(GmshReader, WantsEverySurfaceNamed)
{
  expect_refused(write("none.geo", two_squares),
                 { "no physical group holds the surfaces 1, 2" });
  expect_refused(
      write("some.geo", two_squares + "Physical Surface(\"a\") = {1};\n"),
      { "no physical group holds the surface 2" });
  expect_refused(
      write("unnamed.geo", two_squares + "Physical Surface(4) = {1, 2};\n"),
      { "physical surface 4 has no name", "Physical Surface(" });
  expect_refused(
      write("several.geo", two_squares
                               + "Physical Surface(\"a\") = {1, 2};\n"
                                 "Physical Surface(\"b\") = {2};\n"),
      { "surface 2 is in several physical surfaces (1, 2)" });
  expect_refused(write("zero.msh", msh2(nodes, "1\n2 2 2 0 1 1 2 5\n")),
                 { "no physical group" });
}

TEST(GmshReader, WantsCurvesInOneGroup)
{
  expect_refused(
      write("curves.geo",
            two_squares + names + "Physical Curve(\"other\") = {2};\n"),
      { "curve 2 is in several physical curves" });
  expect_refused(write("curve.geo", two_squares
                                        + "Physical Surface(\"a\") = {1, 2};\n"
                                          "Physical Curve(9) = {2};\n"),
                 { "physical curve 9 has no name" });
}

TEST(GmshReader, WantsPlaneStraightTriangles)
{
  expect_refused(
      write("quads.geo", two_squares + names + "Recombine Surface{1};\n"),
      { "surface 1", "Quad", "Recombine" });
  expect_refused(
      write("order.geo", "Mesh.ElementOrder = 2;\n" + two_squares + names),
      { "surface 1", "Triangle 6", "ElementOrder" });
  std::string raised = nodes;
  raised.replace(raised.find("60 2 1 0"), 8, "60 2 1 .1");
  expect_refused(write("raised.msh", msh2(raised, elements)),
                 { "node 60 at (2, 1, 0.1) is off the plane" });
  std::string flat = nodes;
  flat.replace(flat.find("60 2 1 0"), 8, "60 3 0 0");
  expect_refused(write("flat.msh", msh2(flat, elements)),
                 { "has no area", "(3, 0)" });
}

TEST(GmshReader, RefusesUndefinedNodes)
{
  std::string wrong = elements;
  wrong.replace(wrong.find("2 3 60"), 6, "2 3 61");
  expect_refused(write("undefined.msh", msh2(nodes, wrong)), { "61" });
}
