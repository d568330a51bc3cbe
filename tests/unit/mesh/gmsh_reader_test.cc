// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_meshes.h"

#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/mesh_report.h>

#include <deal.II/base/tensor.h>

#include <sys/personality.h>
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

  void expect_two_squares(const MeshData<2> &data)
  {
    EXPECT_EQ(data.group_names, (std::vector<std::string>{ "left", "right" }));
    SplitOptions options;
    options.joints_along = { "joint" };
    BlockMesh<2> mesh    = split_into_blocks(data, options);
    expect_consistent(mesh, 2.);
    EXPECT_EQ(mesh.n_blocks(), 2U);
    EXPECT_DOUBLE_EQ(make_mesh_report(mesh).joint_size.at("joint"), 1.);
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
  const MeshData<2> data = read_gmsh(path);
  EXPECT_EQ(data.face_names, (std::vector<std::string>{ "", "base", "joint" }));
  EXPECT_EQ(data.source, path);
  EXPECT_EQ(data.n_reoriented, 0U);
  expect_two_squares(data);
  expect_two_squares(read_gmsh(path, MPI_COMM_WORLD));
}

TEST(GmshReader, SaysThatTrianglesAreToHaveMidsideNodes)
{
  const std::string path  = write("quadratic.geo", two_squares + names);
  const MeshData<2> plain = read_gmsh(path);
  const MeshData<2> data  = read_gmsh(path, TriangleKind::quadratic);
  const MeshData<2> received
      = read_gmsh(path, MPI_COMM_SELF, TriangleKind::quadratic);
  EXPECT_FALSE(plain.quadratic);
  for (const MeshData<2> *mesh : { &data, &received })
  {
    EXPECT_TRUE(mesh->quadratic);
    EXPECT_EQ(mesh->cells, plain.cells);
    EXPECT_EQ(mesh->faces, plain.faces);
    expect_two_squares(*mesh);
  }
}

TEST(GmshReader, HalvesEdges)
{
  // A quarter of a disc, in the plane.
  const std::string disc
      = "h = 0.5; Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h};"
        "Point(3) = {0, 1, 0, h}; Line(1) = {1, 2}; Circle(2) = {2, 1, 3};"
        "Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};"
        "Physical Surface(\"rock\") = {1}; Physical Curve(\"arc\") = {2};\n";
  const std::string path = write("refined.geo", disc);
  for (const TriangleKind kind : { TriangleKind::plain, TriangleKind::crossed })
  {
    const MeshData<2> coarse = read_gmsh(path, kind);
    const MeshData<2> fine   = read_gmsh(path, CellOptions(kind, 2));
    EXPECT_EQ(fine.cells.size(), 16 * coarse.cells.size());
    EXPECT_EQ(fine.faces.size(), 4 * coarse.faces.size());
    EXPECT_EQ(fine.group_names, coarse.group_names);
    for (const auto &face : fine.faces)
      for (const unsigned int vertex : face)
        EXPECT_NEAR(fine.vertices[vertex].norm(), 1., 1e-6);
  }

  // A mesh without geometry.
  const std::string file    = write("refined.msh", msh2(nodes, elements));
  const MeshData<2> coarse  = read_gmsh(file);
  const MeshData<2> refined = read_gmsh(file, CellOptions({}, 1));
  EXPECT_EQ(refined.cells.size(), 4 * coarse.cells.size());
  expect_two_squares(refined);
}

TEST(GmshReader, HalvesStraightEdges)
{
  const auto longest_edge = [](const MeshData<2> &mesh)
  {
    double longest = 0.;
    for (const auto &cell : mesh.cells)
      for (unsigned int k = 0; k < 3; ++k)
        longest = std::max(longest, mesh.vertices[cell[k]].distance(
                                        mesh.vertices[cell[(k + 1) % 3]]));
    return longest;
  };
  const std::string path = write("straight.geo", two_squares + names);
  for (const TriangleKind kind : { TriangleKind::plain, TriangleKind::crossed })
  {
    const MeshData<2> coarse = read_gmsh(path, kind);
    const MeshData<2> fine   = read_gmsh(path, CellOptions(kind, 2));
    EXPECT_EQ(fine.cells.size(), 16 * coarse.cells.size());
    EXPECT_EQ(fine.faces.size(), 4 * coarse.faces.size());
    expect_two_squares(fine);
    if (kind == TriangleKind::plain)
    {
      EXPECT_NEAR(longest_edge(fine), 0.25 * longest_edge(coarse), 1e-12);
    }
    // By Euler's formula all triangles share their nodes.
    std::set<std::array<unsigned int, 2>> edges;
    for (const auto &cell : fine.cells)
      for (unsigned int k = 0; k < 3; ++k)
        edges.insert({ std::min(cell[k], cell[(k + 1) % 3]),
                       std::max(cell[k], cell[(k + 1) % 3]) });
    EXPECT_EQ(fine.vertices.size() + fine.cells.size(), edges.size() + 1);
    for (const auto &face : fine.faces)
      EXPECT_EQ(edges.count(
                    { std::min(face[0], face[1]), std::max(face[0], face[1]) }),
                1U);
  }
}

TEST(GmshReader, CutsQuadranglesCrosswise)
{
  const std::string path = write("crossed.geo", two_squares + names);
  const MeshData<2> data = read_gmsh(path, TriangleKind::crossed);
  expect_two_squares(data);
  expect_two_squares(read_gmsh(path, MPI_COMM_WORLD, TriangleKind::crossed));
  EXPECT_EQ(data.cells.size() % 4, 0U);

  // A quadrangle beside two triangles.
  const std::string mixed = "4\n1 1 2 7 1 2 5\n2 3 2 1 1 1 2 5 4\n"
                            "3 2 2 2 2 2 3 60\n4 2 2 2 2 2 60 5\n";
  const std::string file  = write("mixed.msh", msh2(nodes, mixed));
  const MeshData<2> some  = read_gmsh(file, TriangleKind::crossed);
  EXPECT_EQ(some.cells.size(), 6U);
  EXPECT_EQ(some.vertices.size(), 7U);
  EXPECT_EQ(some.cell_group, (std::vector<unsigned int>{ 1, 1, 0, 0, 0, 0 }));
  double area = 0.;
  for (const auto &t : some.cells)
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
  const MeshData<2> data = read_gmsh(write("two22.msh", msh2(nodes, elements)));
  EXPECT_EQ(data.vertices.size(), 6U);
  EXPECT_EQ(data.cells.size(), 4U);
  EXPECT_EQ(data.faces.size(), 1U);
  expect_two_squares(data);
}

TEST(GmshReader, ReadsAllFormatsThatGmshWrites)
{
  const std::string geo      = write("formats.geo", two_squares + names);
  const MeshData<2> expected = read_gmsh(geo);
  for (const char *version : { "2.2", "4.1" })
    for (const char *binary : { "0", "1" })
    {
      SCOPED_TRACE(std::string(version) + ", binary " + binary);
      const std::string format = std::string("Mesh.MshFileVersion = ") + version
                                 + "; Mesh.Binary = " + binary + ";\n";
      const std::string file = ::testing::TempDir() + "/quoin_format.msh";
      write_gmsh_mesh(write("format.geo", format + two_squares + names), file);
      const MeshData<2> data = read_gmsh(file);
      expect_two_squares(data);
      EXPECT_EQ(data.cells.size(), expected.cells.size());
      EXPECT_EQ(data.vertices.size(), expected.vertices.size());
      EXPECT_EQ(data.faces.size(), expected.faces.size());
    }
}

TEST(GmshReader, KeepsCoincidentNodesApart)
{
  const MeshData<2> data = read_gmsh(
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
  const MeshData<2> data = read_gmsh(write("clockwise.geo", geometry + names));
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
                 { "gmsh ended", "Exit", "curves cross each other" });
  expect_two_squares(read_gmsh(fine));

  EXPECT_EQ(n_open(), n_open_before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1); // no process is left
  EXPECT_EQ(errno, ECHILD);
}

TEST(GmshReader, MeshesATextAsAFile)
{
  const std::string text = two_squares + names;
  const MeshData<2> made
      = mesh_gmsh_geometry(text, "section Wall", MPI_COMM_SELF);
  const MeshData<2> read = read_gmsh(write("text.geo", text));
  EXPECT_EQ(made.source, "section Wall");
  EXPECT_EQ(made.vertices, read.vertices);
  EXPECT_EQ(made.cells, read.cells);
  EXPECT_EQ(made.faces, read.faces);
  expect_input_error(
      [] {
        mesh_gmsh_geometry("Point(1) = {0, 0;", "section Wall", MPI_COMM_SELF);
      },
      { "Mesh 'section Wall': gmsh could not", "syntax error",
        "Change the parameters of that section, such as" });
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

namespace
{
  /** A box, by gmsh's own kernel; volume 1, its base surface 1. */
  const std::string box
      = "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0};\n"
        "Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
        "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};\n"
        "Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4};\n"
        "Plane Surface(1) = {1}; Mesh.MeshSizeMax = 0.5;\n"
        "b[] = Extrude {0, 0, 2} { Surface{1}; LAYERS };\n";
  std::string box_with(const std::string &layers, const std::string &more)
  {
    std::string text = box;
    return text.replace(text.find("LAYERS"), 6, layers) + more;
  }
  const std::string box_names = "Physical Volume(\"stone\") = {1};\n"
                                "Physical Surface(\"base\") = {1}; Physical "
                                "Surface(\"top\") = {b[0]};\n";

  /** Two tetrahedra of format 2.2 on the plane z = 0, with a triangle. */
  std::string msh_of_tetrahedra(const std::string &nodes)
  {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
           "$PhysicalNames\n2\n2 7 \"base\"\n3 1 \"stone\"\n"
           "$EndPhysicalNames\n$Nodes\n"
           + nodes
           + "$EndNodes\n$Elements\n3\n1 2 2 7 1 1 2 3\n"
             "2 4 2 1 1 1 2 3 4\n3 4 2 1 1 3 2 1 50\n$EndElements\n";
  }

  double total_volume(const MeshData<3> &mesh)
  {
    double result = 0.;
    for (const auto &cell : mesh.cells)
    {
      const auto edge = [&](const unsigned int k)
      { return mesh.vertices[cell[k]] - mesh.vertices[cell[0]]; };
      result += dealii::cross_product_3d(edge(1), edge(2)) * edge(3) / 6.;
    }
    return result;
  }

  void expect_box(const MeshData<3> &mesh)
  {
    EXPECT_EQ(mesh.group_names, (std::vector<std::string>{ "stone" }));
    EXPECT_EQ(mesh.face_names, (std::vector<std::string>{ "", "base", "top" }));
    EXPECT_NEAR(total_volume(mesh), 2., 1e-12);
    double base = 0., top = 0.;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    {
      const auto &v  = mesh.faces[f];
      const auto &x  = mesh.vertices[v[0]];
      const double a = 0.5
                       * dealii::cross_product_3d(mesh.vertices[v[1]] - x,
                                                  mesh.vertices[v[2]] - x)
                             .norm();
      (mesh.face_name[f] == 1 ? base : top) += a;
      EXPECT_NEAR(x[2], mesh.face_name[f] == 1 ? 0. : 2., 1e-12);
    }
    EXPECT_NEAR(base, 1., 1e-12);
    EXPECT_NEAR(top, 1., 1e-12);
  }

  /** The refusal of a mesh of any dimension. */
  void expect_refused_as(const std::string &path, const MeshDimension dimension,
                         const TriangleKind kind,
                         const std::vector<std::string> &parts)
  {
    std::vector<std::string> all = { path };
    all.insert(all.end(), parts.begin(), parts.end());
    expect_input_error(
        [&] { read_any_gmsh(path, MPI_COMM_SELF, dimension, kind); }, all);
  }
  void expect_space_refused(const std::string &path,
                            const std::vector<std::string> &parts)
  {
    expect_refused_as(path, MeshDimension::from_mesh, TriangleKind::plain,
                      parts);
  }
} // namespace

TEST(GmshReader, MeshesVolumes)
{
  const std::string path = write("box.geo", box_with("", box_names));
  expect_box(std::get<MeshData<3>>(read_any_gmsh(path, MPI_COMM_WORLD)));
  expect_box(read_gmsh<3>(path));
  expect_box(read_gmsh<3>(path, MPI_COMM_WORLD));
  // Layers of tetrahedra.
  expect_box(read_gmsh<3>(
      write("layers.geo", box_with("Layers{ {2, 1}, {0.5, 1} };", box_names))));

  const AnyMeshData plane
      = read_any_gmsh(write("plane.geo", two_squares + names), MPI_COMM_WORLD);
  expect_two_squares(std::get<MeshData<2>>(plane));
}

TEST(GmshReader, ReadsTetrahedraOfAllFormats)
{
  const MeshData<3> expected
      = read_gmsh<3>(write("box_formats.geo", box_with("", box_names)));
  for (const char *version : { "2.2", "4.1" })
    for (const char *binary : { "0", "1" })
    {
      SCOPED_TRACE(std::string(version) + ", binary " + binary);
      const std::string format = std::string("Mesh.MshFileVersion = ") + version
                                 + "; Mesh.Binary = " + binary + ";\n";
      const std::string file = ::testing::TempDir() + "/quoin_box_format.msh";
      write_gmsh_mesh(write("box_format.geo", format + box_with("", box_names)),
                      file);
      const MeshData<3> data
          = std::get<MeshData<3>>(read_any_gmsh(file, MPI_COMM_SELF));
      expect_box(data);
      EXPECT_EQ(data.cells.size(), expected.cells.size());
      EXPECT_EQ(data.vertices.size(), expected.vertices.size());
    }
}

TEST(GmshReader, TurnsTetrahedra)
{
  const std::string corners = "5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  const MeshData<3> data    = read_gmsh<3>(
      write("two.msh", msh_of_tetrahedra(corners + "50 0 0 -3\n")));
  EXPECT_EQ(data.n_reoriented, 0U);
  EXPECT_DOUBLE_EQ(total_volume(data), 2. / 3.);
  EXPECT_EQ(data.faces.size(), 1U);
  // Both on one side of the triangle, the second one inside out.
  const MeshData<3> turned = read_gmsh<3>(
      write("turned.msh", msh_of_tetrahedra(corners + "50 0 0 3\n")));
  EXPECT_EQ(turned.n_reoriented, 1U);
  EXPECT_DOUBLE_EQ(total_volume(turned), 2. / 3.);
  expect_space_refused(
      write("sliver.msh", msh_of_tetrahedra(corners + "50 2 3 0\n")),
      { "a tetrahedron has no volume", "(2, 3, 0)" });
}

TEST(GmshReader, WantsTheDimensionAskedFor)
{
  const std::string square = write("square.geo", two_squares + names);
  expect_refused_as(square, MeshDimension::three, TriangleKind::plain,
                    { "no tetrahedra", "'Dimension = 3' in section 'Mesh'",
                      "gmsh -3", "'Dimension = from mesh'" });
  expect_refused_as(write("three.msh", msh2(nodes, elements)),
                    MeshDimension::three, TriangleKind::plain,
                    { "no tetrahedra", "gmsh -3" });
  // The surface of a geometry of volumes that lies in the plane is not alone.
  expect_refused_as(write("base.geo", box_with("", box_names)),
                    MeshDimension::two, TriangleKind::plain,
                    { "no physical group holds the surfaces" });
  for (const auto &[kind, word] :
       { std::make_pair(TriangleKind::crossed, "crossed"),
         std::make_pair(TriangleKind::quadratic, "quadratic") })
    expect_refused_as(
        write("kinds.geo", box_with("", box_names)), MeshDimension::from_mesh,
        kind,
        { "three-dimensional",
          "'Triangles = " + std::string(word) + "' in section 'Mesh'",
          "'Triangles = plain'" });
}

TEST(GmshReader, WantsTetrahedraInNamedVolumes)
{
  expect_space_refused(
      write("no_volume.geo", box_with("", "")),
      { "no physical group holds the volume 1", "Physical Volume(\"rock\")" });
  expect_space_refused(
      write("unnamed_volume.geo", box_with("", "Physical Volume(3) = {1};\n")),
      { "physical volume 3 has no name", "Physical Volume(" });
  expect_space_refused(
      write("volumes.geo",
            box_with("", box_names + "Physical Volume(\"rock\") = {1};\n")),
      { "volume 1 is in several physical volumes" });
  expect_space_refused(
      write("surfaces.geo",
            box_with("", box_names + "Physical Surface(\"x\") = {1};\n")),
      { "surface 1 is in several physical surfaces" });
  expect_space_refused(
      write("prisms.geo", box_with("Layers{2}; Recombine;", box_names)),
      { "volume 1", "Prism", "four-node tetrahedra", "remove Recombine" });
  expect_space_refused(
      write("hexahedra.geo",
            "Mesh.RecombineAll = 1;\n"
            "Mesh.SubdivisionAlgorithm = 1;\n"
                + box_with("Layers{2}; Recombine;", box_names)),
      { "volume 1", "Hexahedron", "remove Recombine" });
  expect_space_refused(
      write("order_3d.geo",
            "Mesh.ElementOrder = 2;\n" + box_with("", box_names)),
      { "volume 1", "Tetrahedron 10", "Mesh.ElementOrder = 1" });
}

// gmsh orders entities by their addresses, which must not change from run to
// run.
TEST(GmshReader, MeshesAVolumeInTheSameWayEachTime)
{
  const int before = personality(0xffffffff);
  if (before == -1 || personality(before | ADDR_NO_RANDOMIZE) == -1)
    GTEST_SKIP() << "addresses cannot be fixed here";
  personality(before);
  const std::string path = write(
      "same.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0,0,0, 6,6,6};\n"
                  "Rectangle(100) = {0, 0, 6, 1, 1};\n"
                  "BooleanFragments{ Volume{1}; Delete; }"
                  "{ Surface{100}; Delete; }\n"
                  "Physical Volume(\"rock\") = Volume \"*\";\n"
                  "Mesh.MeshSizeExtendFromBoundary = 0;\n"
                  "Mesh.MeshSizeFromPoints = 0; Field[1] = MathEval;\n"
                  "Field[1].F = \"0.15 + 0.15 * Sqrt(x^2 + y^2 + "
                  "(6 - z)^2)\";\n"
                  "Background Field = 1; Mesh.Algorithm3D = 10;\n");
  const MeshData<3> first = read_gmsh<3>(path);
  EXPECT_GT(first.cells.size(), 1000U);
  for (unsigned int again = 0; again < 2; ++again)
    EXPECT_EQ(read_gmsh<3>(path).cells, first.cells);
}
