// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Meshes of tetrahedra: joints, numbers, the report, ranks. The tests of
// SpaceMeshOfRanks also run on two and three ranks.

#include "space_box.h"
#include "test_meshes.h"

#include <quoin/base/constants.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/mesh/mixed_tetrahedra.h>
#include <quoin/mesh/node_map.h>
#include <quoin/mesh/partition.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <functional>
#include <map>

using namespace quoin;
using namespace quoin::test;

namespace
{
  using Point = dealii::Point<3>;

  /** Adds box_points() and box_cells(), with vertices of their own. */
  void add_box(MeshData<3> &mesh, const Count &n, const std::string &group,
               const Point &origin = Point(), const double h = 1.)
  {
    const unsigned int first = mesh.vertices.size();
    const auto points        = box_points(n, h, origin);
    mesh.vertices.insert(mesh.vertices.end(), points.begin(), points.end());
    for (auto cell : box_cells(n))
    {
      for (unsigned int &v : cell)
        v += first;
      mesh.cells.push_back(cell);
    }
    mesh.cell_group.resize(mesh.cells.size(),
                           index_of(group, mesh.group_names));
  }

  /** Names the faces of cells all of whose vertices @p on says. */
  void add_surface(MeshData<3> &mesh, const std::string &name,
                   const std::function<bool(const Point &)> &on)
  {
    std::set<std::array<unsigned int, 3>> faces;
    for (const auto &cell : mesh.cells)
      for (unsigned int f = 0; f < 4; ++f)
      {
        std::array<unsigned int, 3> face;
        for (unsigned int k = 0; k < 3; ++k)
          face[k] = cell[(f + 1 + k) % 4];
        std::sort(face.begin(), face.end());
        if (std::all_of(face.begin(), face.end(),
                        [&](const unsigned int v)
                        { return on(mesh.vertices[v]); }))
          faces.insert(face);
      }
    mesh.faces.insert(mesh.faces.end(), faces.begin(), faces.end());
    mesh.face_name.resize(mesh.faces.size(), index_of(name, mesh.face_names));
  }

  dealii::Tensor<1, 3> area_vector(const std::vector<Point> &points,
                                   const std::array<unsigned int, 3> &face)
  {
    return 0.5
           * dealii::cross_product_3d(points[face[1]] - points[face[0]],
                                      points[face[2]] - points[face[0]]);
  }

  double volume(const BlockMesh<3> &mesh, const unsigned int cell)
  {
    const auto &v = mesh.cells[cell];
    const auto &x = mesh.vertices[v[0]];
    return dealii::cross_product_3d(mesh.vertices[v[1]] - x,
                                    mesh.vertices[v[2]] - x)
           * (mesh.vertices[v[3]] - x) / 6.;
  }

  double volume_of_block(const BlockMesh<3> &mesh, const unsigned int b)
  {
    double result = 0.;
    for (unsigned int c = mesh.block_first_cell[b];
         c < mesh.block_first_cell[b + 1]; ++c)
      result += volume(mesh, c);
    return result;
  }

  /** Whether @p face is one of @p cell and its normal points out of it. */
  void expect_outward(const BlockMesh<3> &mesh, const unsigned int cell,
                      const std::array<unsigned int, 3> &face)
  {
    const auto &vertices = mesh.cells[cell];
    unsigned int inner = dealii::numbers::invalid_unsigned_int, n_inner = 0;
    for (const unsigned int v : vertices)
      if (std::find(face.begin(), face.end(), v) == face.end())
      {
        inner = v;
        ++n_inner;
      }
    ASSERT_EQ(n_inner, 1U);
    EXPECT_LT(area_vector(mesh.vertices, face)
                  * (mesh.vertices[inner] - mesh.vertices[face[0]]),
              0.);
  }

  /** All that BlockMesh promises, of blocks that have the topology of a ball:
      V - E + F - C = 1 for each. */
  void expect_consistent(const BlockMesh<3> &mesh, const double total_volume)
  {
    // 1. Cells.
    double sum = 0.;
    ASSERT_EQ(mesh.block_first_cell.back(), mesh.n_cells());
    ASSERT_EQ(mesh.block_first_vertex.back(), mesh.n_vertices());
    std::vector<std::set<std::pair<unsigned int, unsigned int>>> edges(
        mesh.n_blocks());
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      EXPECT_GT(volume(mesh, c), 0.);
      sum += volume(mesh, c);
      for (const unsigned int v : mesh.cells[c])
      {
        EXPECT_EQ(mesh.block_of_vertex(v), mesh.block_of_cell(c));
        for (const unsigned int w : mesh.cells[c])
          if (v < w)
            edges[mesh.block_of_cell(c)].insert({ v, w });
      }
    }
    EXPECT_NEAR(sum, total_volume, 1e-12 * total_volume);

    // 2. Faces.
    std::vector<unsigned int> n_faces(mesh.n_blocks(), 0);
    std::vector<bool> on_boundary(mesh.n_vertices(), false);
    for (const BlockFace<3> &face : mesh.boundary_faces)
    {
      expect_outward(mesh, face.cell, face.vertices);
      ++n_faces[mesh.block_of_cell(face.cell)];
      for (const unsigned int v : face.vertices)
        on_boundary[v] = true;
    }
    for (const JointFace<3> &face : mesh.joint_faces)
    {
      auto upper = face.upper;
      std::reverse(upper.begin(), upper.end());
      expect_outward(mesh, face.cells[0], face.lower);
      expect_outward(mesh, face.cells[1], upper);
      for (unsigned int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(
            mesh.vertices[face.lower[k]].distance(mesh.vertices[face.upper[k]]),
            0., 1e-3);
        on_boundary[face.lower[k]] = on_boundary[face.upper[k]] = true;
      }
      for (unsigned int k = 0; k < 2; ++k)
      {
        EXPECT_EQ(face.groups[k], mesh.cell_group[face.cells[k]]);
        ++n_faces[mesh.block_of_cell(face.cells[k])];
      }
      const auto n = area_vector(mesh.vertices, face.lower)
                     / area_vector(mesh.vertices, face.lower).norm();
      EXPECT_TRUE(n[2] > 1e-6
                  || (std::abs(n[2]) < 1e-5
                      && (n[1] > 1e-6 || (std::abs(n[1]) < 1e-5 && n[0] > 0.))))
          << n;
    }

    // 3. Blocks.
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
    {
      const unsigned int first = mesh.block_first_vertex[b];
      const unsigned int end   = mesh.block_first_vertex[b + 1];
      for (unsigned int v = first + 1; v < end; ++v)
        EXPECT_GE(on_boundary[v - 1], on_boundary[v]);
      const int n_cells
          = mesh.block_first_cell[b + 1] - mesh.block_first_cell[b];
      ASSERT_EQ((4 * n_cells + n_faces[b]) % 2, 0U);
      const int n_all_faces = (4 * n_cells + n_faces[b]) / 2;
      EXPECT_EQ(static_cast<int>(end - first)
                    - static_cast<int>(edges[b].size()) + n_all_faces - n_cells,
                1);
    }
  }

  /** By name, the area of the faces. */
  std::map<std::string, double> outer_areas(const BlockMesh<3> &mesh)
  {
    std::map<std::string, double> result;
    for (const BlockFace<3> &face : mesh.boundary_faces)
      result[mesh.face_names[face.name]]
          += area_vector(mesh.vertices, face.vertices).norm();
    return result;
  }

  /** Two boxes of gmsh, the lower one a cube of 1 m, the upper one half as
      high, with a joint between them. */
  const std::string two_boxes
      = "SetFactory(\"OpenCASCADE\");\n"
        "Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 0.5};\n"
        "Coherence;\n"
        "Mesh.MeshSizeMax = 0.4; e = 1e-3;\n"
        "Physical Volume(\"lower\") = {1}; Physical Volume(\"upper\") = {2};\n"
        "Physical Surface(\"bed\") =\n"
        "  Surface In BoundingBox{-e, -e, 1 - e, 1 + e, 1 + e, 1 + e};\n"
        "Physical Surface(\"base\") =\n"
        "  Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e};\n";

  MeshData<3> read_boxes(const MPI_Comm communicator)
  {
    const unsigned int n
        = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const std::string path = ::testing::TempDir() + "/quoin_two_boxes_"
                             + std::to_string(n) + ".geo";
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      std::ofstream(path) << two_boxes;
    return std::get<MeshData<3>>(read_any_gmsh(path, communicator));
  }

  SplitOptions along(const std::vector<std::string> &names)
  {
    SplitOptions options;
    options.joints_along = names;
    return options;
  }
} // namespace

TEST(SpaceMesh, TwoBoxesOfGmsh)
{
  const MeshData<3> data = read_boxes(MPI_COMM_SELF);
  EXPECT_EQ(data.group_names, (std::vector<std::string>{ "lower", "upper" }));
  BlockMesh<3> mesh = split_into_blocks(data, along({ "bed" }));
  expect_consistent(mesh, 1.5);
  ASSERT_EQ(mesh.n_blocks(), 2U);
  EXPECT_NEAR(volume_of_block(mesh, 0), 1., 1e-12);
  EXPECT_NEAR(volume_of_block(mesh, 1), 0.5, 1e-12);
  for (const JointFace<3> &face : mesh.joint_faces)
    EXPECT_EQ(face.groups, (std::array<unsigned int, 2>{ { 0, 1 } }));

  const auto areas = outer_areas(mesh);
  EXPECT_EQ(areas.size(), 2U);
  EXPECT_NEAR(areas.at("base"), 1., 1e-12);
  EXPECT_NEAR(areas.at(""), 7., 1e-12);

  const MeshReport report = make_mesh_report(mesh);
  EXPECT_EQ(report.dimension, 3U);
  EXPECT_EQ(report.n_cells, data.cells.size());
  EXPECT_NEAR(report.joint_size.at("bed"), 1., 1e-12);
  EXPECT_NEAR(report.total_joint_size, 1., 1e-12);
  EXPECT_LT(report.box[0].distance(Point(0., 0., 0.)), 1e-12);
  EXPECT_LT(report.box[1].distance(Point(1., 1., 1.5)), 1e-12);
  EXPECT_TRUE(report.warnings().empty());

  // The same joint, found between the groups; no joint.
  SplitOptions between;
  between.joints_between  = { { "lower", "upper" } };
  const BlockMesh<3> same = split_into_blocks(data, between);
  EXPECT_EQ(same.cells, mesh.cells);
  EXPECT_EQ(same.joint_faces.size(), mesh.joint_faces.size());
  const BlockMesh<3> whole = split_into_blocks(data, {});
  expect_consistent(whole, 1.5);
  EXPECT_EQ(whole.n_blocks(), 1U);
  EXPECT_EQ(whole.joint_faces.size(), 0U);
}

TEST(SpaceMesh, EightBlocksMeetInAPoint)
{
  MeshData<3> data;
  add_box(data, { 4, 4, 4 }, "rock");
  for (unsigned int d = 0; d < 3; ++d)
    add_surface(data, "joint " + std::to_string(d),
                [&](const Point &p) { return std::abs(p[d] - 2.) < 1e-9; });
  BlockMesh<3> mesh
      = split_into_blocks(data, along({ "joint 0", "joint 1", "joint 2" }));
  expect_consistent(mesh, 64.);
  ASSERT_EQ(mesh.n_blocks(), 8U);
  EXPECT_EQ(mesh.n_vertices(), 8U * 27U);
  EXPECT_EQ(mesh.joint_faces.size(), 3U * 32U);
  for (unsigned int b = 0; b < 8; ++b)
    EXPECT_NEAR(volume_of_block(mesh, b), 8., 1e-12);
  const MeshReport report = make_mesh_report(mesh);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(report.joint_size.at("joint " + std::to_string(d)), 16., 1e-12);
  for (const JointFace<3> &face : mesh.joint_faces)
  {
    const unsigned int d = mesh.face_names[face.name].back() - '0';
    const auto n         = area_vector(mesh.vertices, face.lower);
    EXPECT_GT(n[d], 0.);
    EXPECT_NEAR(n[d], n.norm(), 1e-12);
  }
}

TEST(SpaceMesh, LowerIsTheSideBelow)
{
  for (const double slope : { 0.5, -0.5 })
  {
    MeshData<3> data;
    add_box(data, { 2, 2, 2 }, "rock");
    add_surface(data, "bed",
                [](const Point &p) { return std::abs(p[2] - 1.) < 1e-9; });
    add_surface(data, "head",
                [](const Point &p) { return std::abs(p[0] - 1.) < 1e-9; });
    for (Point &p : data.vertices)
      p = Point(p[0] + slope * p[1], p[1], p[2] + slope * (p[0] + p[1]));
    BlockMesh<3> mesh = split_into_blocks(data, along({ "bed", "head" }));
    expect_consistent(mesh, 8.);
    EXPECT_EQ(mesh.n_blocks(), 4U);
    for (const JointFace<3> &face : mesh.joint_faces)
    {
      const auto n = area_vector(mesh.vertices, face.lower);
      if (mesh.face_names[face.name] == "bed")
        EXPECT_GT(n[2], 0.);
      else // the normal is (1, -slope, 0)
        EXPECT_GT(n[1], 0.);
    }
  }
}

TEST(SpaceMesh, BoxesApartTouch)
{
  // The third one has a side of its own meshing.
  MeshData<3> data;
  add_box(data, { 2, 2, 1 }, "a");
  add_box(data, { 2, 2, 1 }, "b", Point(1e-5, 0., 1.));
  add_box(data, { 1, 1, 1 }, "c", Point(2., 0., 0.), 2.);
  BlockMesh<3> mesh = split_into_blocks(data, {});
  expect_consistent(mesh, 16.);
  ASSERT_EQ(mesh.n_blocks(), 3U);
  ASSERT_EQ(mesh.joint_faces.size(), 8U);
  for (const JointFace<3> &face : mesh.joint_faces)
    EXPECT_EQ(face.groups, (std::array<unsigned int, 2>{ { 0, 1 } }));

  const MeshReport report = make_mesh_report(mesh);
  EXPECT_NEAR(report.joint_size.at(""), 4., 1e-12);
  EXPECT_NEAR(report.unmatched_size, 4., 1e-4);
  EXPECT_NEAR(report.unmatched_position[0], 2., 1e-4);
  ASSERT_EQ(report.warnings().size(), 1U);
  EXPECT_NE(report.warnings()[0].find("faces lie on each other over 4 m2"),
            std::string::npos)
      << report.warnings()[0];
}

TEST(SpaceMesh, CracksEndAtAFront)
{
  MeshData<3> data;
  add_box(data, { 2, 2, 2 }, "rock");
  add_surface(data, "crack",
              [](const Point &p)
              { return std::abs(p[2] - 1.) < 1e-9 && p[0] < 1.1; });
  BlockMesh<3> mesh = split_into_blocks(data, along({ "crack" }));
  EXPECT_EQ(mesh.n_blocks(), 1U);
  EXPECT_EQ(mesh.n_vertices(), 27U + 3U);
  EXPECT_EQ(mesh.joint_faces.size(), 4U);
  for (const JointFace<3> &face : mesh.joint_faces)
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_EQ(face.lower[k] == face.upper[k],
                mesh.vertices[face.lower[k]][0] > 0.5);
  const MeshReport report = make_mesh_report(mesh);
  EXPECT_EQ(report.n_joint_ends, 3U);
  EXPECT_EQ(report.n_tied_joint_faces, 0U);
  EXPECT_NEAR(report.total_joint_size, 2., 1e-12);
  EXPECT_NE(report.to_text().find("crack fronts"), std::string::npos);

  SplitOptions refusing = along({ "crack" });
  refusing.joint_ends   = SplitOptions::refuse;
  expect_input_error([&] { split_into_blocks(data, refusing); },
                     { "surface 'crack' ends inside a block at (1, ",
                       "Joint ends inside blocks = keep" });
}

TEST(SpaceMesh, MixedTetrahedraAreCutIntoEight)
{
  // One cell: equal volumes, and the shortest of three diagonals.
  MeshData<3> one;
  one.vertices   = { Point(0., 0., 0.), Point(3., 0., 0.), Point(0., 1., 0.),
                     Point(0.4, 0.3, 1.) };
  one.cells      = { { { 0, 1, 2, 3 } } };
  one.cell_group = { 4 };
  one.faces      = { { { 0, 1, 2 } } };
  one.face_name  = { 3 };
  make_mixed(one);
  EXPECT_TRUE(one.mixed);
  ASSERT_EQ(one.cells.size(), 8U);
  EXPECT_EQ(one.vertices.size(), 10U);
  EXPECT_EQ(one.cell_group, std::vector<unsigned int>(8, 4));
  EXPECT_EQ(one.face_name, std::vector<unsigned int>(4, 3));
  // Squares of the diagonals: 2.0625, 2.3625, 3.2625.
  std::array<unsigned int, 3> n_diagonals{};
  for (const auto &v : one.cells)
  {
    const Point &x = one.vertices[v[0]];
    EXPECT_NEAR(
        dealii::cross_product_3d(one.vertices[v[1]] - x, one.vertices[v[2]] - x)
            * (one.vertices[v[3]] - x),
        3. / 8., 1e-14);
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int b = 0; b < a; ++b)
      {
        const double square
            = one.vertices[v[a]].distance_square(one.vertices[v[b]]);
        n_diagonals[0] += std::abs(square - 2.0625) < 1e-12;
        n_diagonals[1] += std::abs(square - 2.3625) < 1e-12;
        n_diagonals[2] += std::abs(square - 3.2625) < 1e-12;
      }
  }
  EXPECT_EQ(n_diagonals, (std::array<unsigned int, 3>{ { 4, 0, 0 } }));
  double area = 0.;
  for (const auto &face : one.faces)
    area += area_vector(one.vertices, face)[2];
  EXPECT_NEAR(area, 1.5, 1e-14);
}

TEST(SpaceMesh, MixedTetrahedraKeepJointsAndNames)
{
  MeshData<3> data           = read_boxes(MPI_COMM_SELF);
  const unsigned int n_plain = data.cells.size();
  const BlockMesh<3> plain   = split_into_blocks(data, along({ "bed" }));
  make_mixed(data);
  const BlockMesh<3> mesh = split_into_blocks(data, along({ "bed" }));
  expect_consistent(mesh, 1.5);
  EXPECT_TRUE(mesh.mixed);
  EXPECT_EQ(mesh.n_blocks(), 2U);
  EXPECT_EQ(mesh.n_cells(), 8 * n_plain);
  EXPECT_EQ(mesh.joint_faces.size(), 4 * plain.joint_faces.size());
  EXPECT_NEAR(outer_areas(mesh).at("base"), 1., 1e-12);
  EXPECT_NEAR(make_mesh_report(mesh).joint_size.at("bed"), 1., 1e-12);
  EXPECT_NE(make_mesh_report(mesh).to_text().find("mixed"), std::string::npos);
  // Each eight have four at corners and four around a diagonal.
  for (unsigned int c = 0; c < mesh.n_cells(); c += 8)
  {
    std::set<unsigned int> vertices;
    double size = 0.;
    for (unsigned int k = c; k < c + 8; ++k)
    {
      vertices.insert(mesh.cells[k].begin(), mesh.cells[k].end());
      EXPECT_NEAR(volume(mesh, k), volume(mesh, c), 1e-12 * volume(mesh, c));
      size += volume(mesh, k);
    }
    EXPECT_EQ(vertices.size(), 10U);
    EXPECT_GT(size, 0.);
  }
}

TEST(SpaceMesh, CracksOfMixedTetrahedraEndAtTheSameFront)
{
  MeshData<3> data;
  add_box(data, { 2, 2, 2 }, "rock");
  add_surface(data, "crack",
              [](const Point &p)
              { return std::abs(p[2] - 1.) < 1e-9 && p[0] < 1.1; });
  make_mixed(data);
  BlockMesh<3> mesh = split_into_blocks(data, along({ "crack" }));
  EXPECT_EQ(mesh.n_blocks(), 1U);
  EXPECT_EQ(mesh.joint_faces.size(), 16U);
  for (const JointFace<3> &face : mesh.joint_faces)
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_EQ(face.lower[k] == face.upper[k],
                mesh.vertices[face.lower[k]][0] > 0.9);
  EXPECT_NEAR(make_mesh_report(mesh).total_joint_size, 2., 1e-12);
}

TEST(SpaceMesh, RefusesWhatIsNoJoint)
{
  MeshData<3> data;
  add_box(data, { 2, 1, 1 }, "rock");
  add_surface(data, "side", [](const Point &p) { return p[0] < 0.1; });
  data.faces.push_back({ { 0, 1, 11 } });
  data.face_name.push_back(index_of("inside", data.face_names));
  BlockMesh<3> mesh;
  expect_input_error([&] { split_into_blocks(data, along({ "side" })); },
                     { "surface 'side' dangles at (0, ", "Mesh/Joints along" });
  expect_input_error(
      [&] { split_into_blocks(data, along({ "inside" })); },
      { "surface 'inside' is no face of the mesh", "Surface{...} In Volume" });
  expect_input_error([&] { split_into_blocks(data, along({ "nowhere" })); },
                     { "no physical surface 'nowhere'", "has side, inside." });
  SplitOptions between;
  between.joints_between = { { "rock", "soil" } };
  expect_input_error([&] { split_into_blocks(data, between); },
                     { "no physical volume 'soil'" });

  MeshData<3> twice = data;
  twice.cells.push_back(twice.cells[3]);
  twice.cell_group.push_back(0);
  expect_input_error([&] { split_into_blocks(twice, {}); },
                     { "tetrahedra overlap at the face" });
  expect_input_error([&] { split_into_blocks(MeshData<3>(), {}); },
                     { "there are no tetrahedra" });
}

TEST(SpaceMesh, BlocksArePermuted)
{
  MeshData<3> data;
  for (unsigned int i = 0; i < 4; ++i)
    add_box(data, { i + 1, 2, 2 }, "rock", Point(6. * i, 0., 0.));
  const std::vector<unsigned int> order = { 2, 0, 3, 1 };
  BlockMesh<3> mesh                     = split_into_blocks(data, {});
  const BlockMesh<3> permuted           = split_into_blocks(data, {}, &order);
  expect_consistent(permuted, 40.);
  for (unsigned int b = 0; b < 4; ++b)
  {
    EXPECT_NEAR(volume_of_block(mesh, b), 4. * (b + 1), 1e-12);
    EXPECT_NEAR(volume_of_block(permuted, b), 4. * (order[b] + 1), 1e-12);
  }
  renumber_blocks(mesh, order);
  EXPECT_EQ(mesh.cells, permuted.cells);
}

TEST(SpaceMesh, CellsFollowACurve)
{
  MeshData<3> data;
  add_box(data, { 16, 16, 16 }, "rock");
  BlockMesh<3> mesh = split_into_blocks(data, {});
  // Along the curve from one cube to the next one: most cells that follow each
  // other have a vertex in common.
  unsigned int n_together = 0;
  for (unsigned int c = 1; c < mesh.n_cells(); ++c)
    n_together += std::any_of(mesh.cells[c].begin(), mesh.cells[c].end(),
                              [&](const unsigned int v)
                              {
                                return std::find(mesh.cells[c - 1].begin(),
                                                 mesh.cells[c - 1].end(), v)
                                       != mesh.cells[c - 1].end();
                              });
  EXPECT_GT(n_together, 0.95 * mesh.n_cells());
}

TEST(SpaceMesh, TetrahedraGetPositiveVolume)
{
  MeshData<3> data;
  data.source   = "rock.msh";
  data.vertices = { Point(0., 0., 0.), Point(1., 0., 0.), Point(0., 1., 0.),
                    Point(0., 0., 1.), Point(1., 1., 1e-14) };
  data.cells    = { { { 0, 1, 2, 3 } }, { { 1, 0, 2, 3 } } };
  orient_cells(data);
  EXPECT_EQ(data.n_reoriented, 1U);
  EXPECT_EQ(data.cells[0], (std::array<unsigned int, 4>{ { 0, 1, 2, 3 } }));
  EXPECT_EQ(data.cells[1], (std::array<unsigned int, 4>{ { 1, 0, 3, 2 } }));
  data.cells.push_back({ { 0, 1, 2, 4 } });
  expect_input_error([&] { orient_cells(data); },
                     { "Mesh 'rock.msh'", "a tetrahedron has no volume",
                       "(1, 1, 1e-14)", "Mesh this place anew" });
}

TEST(SpaceMesh, ReportsTheShapeOfTetrahedra)
{
  const auto report = [](const std::vector<Point> &corners)
  {
    MeshData<3> data;
    data.vertices    = corners;
    data.cells       = { { { 0, 1, 2, 3 } } };
    data.cell_group  = { 0 };
    data.group_names = { "rock" };
    orient_cells(data);
    BlockMesh<3> mesh = split_into_blocks(data, {});
    return make_mesh_report(mesh);
  };
  // Dihedral angles: acos(1/3) of a regular one; of the corner of a cube, where
  // its three faces meet the fourth.
  const MeshReport regular
      = report({ Point(1., 1., 1.), Point(1., -1., -1.), Point(-1., 1., -1.),
                 Point(-1., -1., 1.) });
  EXPECT_NEAR(regular.smallest_angle, std::acos(1. / 3.) / constants::degree,
              1e-9);
  EXPECT_NEAR(regular.shortest_edge, std::sqrt(8.), 1e-12);
  EXPECT_NEAR(regular.longest_edge, std::sqrt(8.), 1e-12);
  const MeshReport corner = report({ Point(0., 0., 0.), Point(1., 0., 0.),
                                     Point(0., 1., 0.), Point(0., 0., 1.) });
  EXPECT_NEAR(corner.smallest_angle,
              std::acos(1. / std::sqrt(3.)) / constants::degree, 1e-9);
  EXPECT_NEAR(corner.angle_position.distance(Point(0.25, 0.25, 0.25)), 0.,
              1e-12);
  EXPECT_NE(corner.to_text().find("degrees between faces at "
                                  + corner.position(corner.angle_position)
                                  + " m\n"),
            std::string::npos)
      << corner.to_text();
  EXPECT_NEAR(corner.shortest_edge, 1., 1e-12);
  EXPECT_NEAR(corner.longest_edge, std::sqrt(2.), 1e-12);
  EXPECT_NE(corner.to_text().find("1 blocks, 1 tetrahedra, 4 nodes; x 0 to 1 "
                                  "m, y 0 to 1 m, z 0 to 1 m"),
            std::string::npos)
      << corner.to_text();
}

TEST(SpaceMesh, FindsBlocksThatOverlap)
{
  const auto report = [](const Point &at, const double h)
  {
    MeshData<3> data;
    add_box(data, { 3, 3, 3 }, "rock");
    add_box(data, { 1, 1, 1 }, "lining", at, h);
    BlockMesh<3> mesh = split_into_blocks(data, {});
    return make_mesh_report(mesh);
  };
  // Beside it, at a corner, on its side with other nodes; in part; within.
  EXPECT_FALSE(report(Point(4., 1., 1.), 1.).overlaps);
  EXPECT_FALSE(report(Point(3., 3., 3.), 1.).overlaps);
  EXPECT_FALSE(report(Point(3., 0.1, 0.3), 1.7).overlaps);
  EXPECT_TRUE(report(Point(2.3, 0.4, 0.6), 1.9).overlaps);
  const MeshReport within = report(Point(1.1, 1.2, 1.3), 0.5);
  EXPECT_TRUE(within.overlaps);
  EXPECT_LT(within.overlap_position.distance(Point(1.35, 1.45, 1.55)), 0.5);
  ASSERT_EQ(within.warnings().size(), 1U);
  EXPECT_NE(within.warnings()[0].find("Take the volume out"),
            std::string::npos);
  EXPECT_NEAR(report(Point(3., 0.1, 0.3), 1.7).unmatched_size, 1.7 * 1.7, 1e-3);
}

TEST(SpaceMeshOfRanks, BlocksAreDistributed)
{
  using namespace dealii::Utilities::MPI;
  const unsigned int n_ranks = n_mpi_processes(MPI_COMM_WORLD);
  const MeshData<3> data     = read_boxes(MPI_COMM_WORLD);
  BlockMesh<3> mesh;
  std::vector<unsigned int> rank_of_cell;
  MeshReport report;
  if (this_mpi_process(MPI_COMM_WORLD) == 0)
  {
    mesh         = split_into_blocks(data, along({ "bed" }));
    report       = make_mesh_report(mesh);
    rank_of_cell = partition_cells(mesh, { false, false }, n_ranks);
  }
  report = broadcast(MPI_COMM_WORLD, report);
  const BlockTriangulation<3> blocks(mesh, rank_of_cell, { false, false },
                                     MPI_COMM_WORLD);
  const NodeMap<3> nodes(blocks);
  EXPECT_EQ(nodes.exchange().n_global(), report.n_nodes);
  EXPECT_EQ(dealii::Utilities::MPI::sum(nodes.cells().size(), MPI_COMM_WORLD),
            report.n_cells);
  EXPECT_EQ(nodes.faces().n_global_joints, report.n_joint_faces);

  std::vector<Point> points;
  for (unsigned int i = 0; i < nodes.n_local(); ++i)
    points.push_back(nodes.point(i));
  std::array<double, 2> volumes{}, sum_of_volumes{};
  for (unsigned int c = 0; c < nodes.cells().size(); ++c)
  {
    const auto &v = nodes.cells().nodes[c];
    volumes[nodes.cells().group[c]]
        += area_vector(points, { { v[0], v[1], v[2] } })
           * (points[v[3]] - points[v[0]]) / 3.;
  }
  dealii::Utilities::MPI::sum(
      dealii::ArrayView<const double>(volumes.data(), 2), MPI_COMM_WORLD,
      dealii::ArrayView<double>(sum_of_volumes.data(), 2));
  EXPECT_NEAR(sum_of_volumes[0], 1., 1e-12);
  EXPECT_NEAR(sum_of_volumes[1], 0.5, 1e-12);

  double joint = 0., outer = 0.;
  for (const JointNodes<3> &face : nodes.faces().joints)
  {
    for (unsigned int k = 0; k < 3; ++k)
      EXPECT_LT(points[face.lower[k]].distance(points[face.upper[k]]), 1e-12);
    const auto n = area_vector(points, face.lower);
    EXPECT_GT(n[2], 0.);
    EXPECT_EQ(nodes.table().face_names[face.name], "bed");
    if (face.is_own[0])
      joint += n.norm();
  }
  for (const OuterFace<3> &face : nodes.faces().outer)
    outer += area_vector(points, face.nodes).norm();
  EXPECT_NEAR(sum(joint, MPI_COMM_WORLD), 1., 1e-12);
  EXPECT_NEAR(sum(outer, MPI_COMM_WORLD), 8., 1e-12);
}

TEST(SpaceMeshOfRanks, MixedTetrahedraStayWhole)
{
  using namespace dealii::Utilities::MPI;
  MeshData<3> data = read_boxes(MPI_COMM_WORLD);
  BlockMesh<3> mesh;
  std::vector<unsigned int> rank_of_cell;
  if (this_mpi_process(MPI_COMM_WORLD) == 0)
  {
    make_mixed(data);
    mesh = split_into_blocks(data, {});
    rank_of_cell
        = partition_cells(mesh, { false }, n_mpi_processes(MPI_COMM_WORLD));
  }
  const BlockTriangulation<3> blocks(mesh, rank_of_cell, { false },
                                     MPI_COMM_WORLD);
  const NodeMap<3> nodes(blocks);
  EXPECT_TRUE(nodes.table().is_mixed);
  const LocalCells<3> &cells = nodes.cells();
  ASSERT_GT(cells.size(), 0U);
  ASSERT_EQ(cells.size() % 8, 0U);
  for (unsigned int c = 0; c < cells.size(); ++c)
    EXPECT_EQ(cells.number[c], cells.number[c - c % 8] + c % 8);
  for (unsigned int c = 0; c < cells.size(); c += 8)
    EXPECT_EQ(cells.number[c] % 8, 0U);
  // Those that share a node with other ranks come first.
  ASSERT_EQ(nodes.blocks().parts.size(), 1U);
  const BlockPart &part = nodes.blocks().parts[0];
  EXPECT_EQ(part.first_inner_cell % 8, 0U);
  EXPECT_EQ(part.first_inner_cell > 0, n_mpi_processes(MPI_COMM_WORLD) > 1);
  for (unsigned int c = part.first_inner_cell; c < cells.size(); ++c)
    for (const unsigned int node : cells.nodes[c])
      EXPECT_LT(node, part.nodes[1]);
}
