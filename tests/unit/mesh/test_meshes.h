// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_mesh_test_meshes_h
#define quoin_tests_unit_mesh_test_meshes_h

#include <quoin/base/exceptions.h>
#include <quoin/mesh/block_mesh.h>
#include <quoin/mesh/mesh_data.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

namespace quoin::test
{
  /** The number of @p name in @p names, to which it is added if it is new. */
  inline unsigned int index_of(const std::string &name,
                               std::vector<std::string> &names)
  {
    const unsigned int place
        = std::find(names.begin(), names.end(), name) - names.begin();
    if (place == names.size())
      names.push_back(name);
    return place;
  }

  /**
   * Add nx x ny squares of side @p side, each cut into two triangles, with
   * nodes of their own.
   */
  inline void add_grid(MeshData<2> &mesh, const unsigned int nx,
                       const unsigned int ny, const std::string &group,
                       const double x = 0., const double y = 0.,
                       const double side = 1.)
  {
    const unsigned int first = mesh.vertices.size();
    for (unsigned int j = 0; j <= ny; ++j)
      for (unsigned int i = 0; i <= nx; ++i)
        mesh.vertices.emplace_back(x + i * side, y + j * side);
    const unsigned int group_number = index_of(group, mesh.group_names);
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
      {
        const unsigned int a = first + i + (nx + 1) * j, b = a + 1;
        const unsigned int d = a + nx + 1, c = d + 1;
        mesh.cells.push_back({ { a, b, c } });
        mesh.cells.push_back({ { a, c, d } });
        mesh.cell_group.resize(mesh.cells.size(), group_number);
      }
  }

  /** add_grid() alone. */
  inline MeshData<2> grid(const unsigned int nx, const unsigned int ny,
                          const std::string &group, const double x = 0.,
                          const double y = 0., const double side = 1.)
  {
    MeshData<2> mesh;
    add_grid(mesh, nx, ny, group, x, y, side);
    return mesh;
  }

  /**
   * One block of two triangles, whose corners are (x0, y0) and (x1, y1), with
   * the number of the name of its bottom, right, top and left side.
   */
  inline BlockMesh<2> rectangle(const double x0, const double y0,
                                const double x1, const double y1,
                                const std::vector<std::string> &face_names,
                                const std::array<unsigned int, 4> &name_of_side)
  {
    BlockMesh<2> result;
    result.vertices   = { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } };
    result.cells      = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
    result.cell_group = { 0, 0 };
    result.block_first_cell   = { 0, 2 };
    result.block_first_vertex = { 0, 4 };
    result.group_names        = { "rock" };
    result.face_names         = face_names;
    for (const unsigned int k : { 0U, 1U, 2U, 3U })
      result.boundary_faces.push_back(
          { { { k, (k + 1) % 4 } }, k < 2 ? 0U : 1U, name_of_side[k] });
    return result;
  }

  /** The last node of the mesh at this place. */
  inline unsigned int node_at(const MeshData<2> &mesh, const double x,
                              const double y)
  {
    for (unsigned int v = mesh.vertices.size(); v > 0; --v)
      if (mesh.vertices[v - 1].distance(dealii::Point<2>(x, y)) < 1e-9)
        return v - 1;
    ADD_FAILURE() << "no node at " << x << ", " << y;
    return 0;
  }

  /** Lines along the nodes one apart from (x0, y0) to (x1, y1). */
  inline void add_curve(MeshData<2> &mesh, const std::string &name,
                        const double x0, const double y0, const double x1,
                        const double y1)
  {
    const unsigned int n
        = std::lround(std::max(std::abs(x1 - x0), std::abs(y1 - y0)));
    const double dx = (x1 - x0) / n, dy = (y1 - y0) / n;
    for (unsigned int i = 0; i < n; ++i)
      mesh.faces.push_back(
          { { node_at(mesh, x0 + i * dx, y0 + i * dy),
              node_at(mesh, x0 + (i + 1) * dx, y0 + (i + 1) * dy) } });
    mesh.face_name.resize(mesh.faces.size(), index_of(name, mesh.face_names));
  }

  inline double area(const BlockMesh<2> &mesh, const unsigned int cell)
  {
    const auto &v = mesh.cells[cell];
    const auto a  = mesh.vertices[v[1]] - mesh.vertices[v[0]];
    const auto b  = mesh.vertices[v[2]] - mesh.vertices[v[0]];
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }

  /** Vertices of the block mesh at a place. */
  inline std::vector<unsigned int> vertices_at(const BlockMesh<2> &mesh,
                                               const double x, const double y)
  {
    std::vector<unsigned int> result;
    for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
      if (mesh.vertices[v].distance(dealii::Point<2>(x, y)) < 1e-3)
        result.push_back(v);
    return result;
  }

  /** The number of sides of joint faces that end at a vertex. */
  inline unsigned int n_joint_sides(const BlockMesh<2> &mesh,
                                    const unsigned int vertex)
  {
    unsigned int n = 0;
    for (const JointFace<2> &face : mesh.joint_faces)
      for (unsigned int k = 0; k < 2; ++k)
        n += (face.lower[k] == vertex) + (face.upper[k] == vertex);
    return n;
  }

  inline bool has_edge(const std::array<unsigned int, 3> &cell,
                       const unsigned int from, const unsigned int to)
  {
    for (unsigned int k = 0; k < 3; ++k)
      if (cell[k] == from && cell[(k + 1) % 3] == to)
        return true;
    return false;
  }

  /**
   * All that BlockMesh promises: areas, sides of joints, numbering, and for
   * each block V - E + F = 1 less its holes, of which there are
   * @p n_holes altogether.
   */
  inline void expect_consistent(const BlockMesh<2> &mesh,
                                const double total_area,
                                const unsigned int n_holes = 0)
  {
    // 1. Cells.
    double sum = 0.;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      EXPECT_GT(area(mesh, c), 0.);
      sum += area(mesh, c);
      for (const unsigned int v : mesh.cells[c])
        EXPECT_EQ(mesh.block_of_vertex(v), mesh.block_of_cell(c));
    }
    EXPECT_NEAR(sum, total_area, 1e-12 * total_area);
    ASSERT_EQ(mesh.block_first_cell.back(), mesh.n_cells());
    ASSERT_EQ(mesh.block_first_vertex.back(), mesh.n_vertices());

    // 2. Faces.
    std::vector<unsigned int> n_faces(mesh.n_blocks(), 0);
    std::set<unsigned int> on_boundary;
    for (const BlockFace<2> &face : mesh.boundary_faces)
    {
      EXPECT_TRUE(
          has_edge(mesh.cells[face.cell], face.vertices[0], face.vertices[1]));
      ++n_faces[mesh.block_of_cell(face.cell)];
      on_boundary.insert(face.vertices.begin(), face.vertices.end());
    }
    for (const JointFace<2> &face : mesh.joint_faces)
    {
      EXPECT_TRUE(
          has_edge(mesh.cells[face.cells[0]], face.lower[0], face.lower[1]));
      EXPECT_TRUE(
          has_edge(mesh.cells[face.cells[1]], face.upper[1], face.upper[0]));
      for (unsigned int k = 0; k < 2; ++k)
      {
        EXPECT_NEAR(
            mesh.vertices[face.lower[k]].distance(mesh.vertices[face.upper[k]]),
            0., 1e-3);
        EXPECT_EQ(face.groups[k], mesh.cell_group[face.cells[k]]);
        ++n_faces[mesh.block_of_cell(face.cells[k])];
      }
      const auto t
          = mesh.vertices[face.lower[1]] - mesh.vertices[face.lower[0]];
      const double n_x = t[1], n_y = -t[0];
      EXPECT_TRUE(n_y > 0. || (std::abs(n_y) < 1e-5 && n_x > 0.));
      on_boundary.insert(face.lower.begin(), face.lower.end());
      on_boundary.insert(face.upper.begin(), face.upper.end());
    }

    // 3. Blocks.
    int characteristic = 0;
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
    {
      const unsigned int first = mesh.block_first_vertex[b];
      const unsigned int end   = mesh.block_first_vertex[b + 1];
      for (unsigned int v = first + 1; v < end; ++v)
        EXPECT_GE(on_boundary.count(v - 1), on_boundary.count(v));

      const unsigned int n_cells
          = mesh.block_first_cell[b + 1] - mesh.block_first_cell[b];
      ASSERT_EQ((3 * n_cells + n_faces[b]) % 2, 0U);
      const int n_edges = (3 * n_cells + n_faces[b]) / 2;
      characteristic += static_cast<int>(end - first) - n_edges
                        + static_cast<int>(n_cells);
    }
    EXPECT_EQ(characteristic,
              static_cast<int>(mesh.n_blocks()) - static_cast<int>(n_holes));
  }

  /** Expect an InputError whose message holds all @p parts. */
  template <typename Function>
  void expect_input_error(const Function &function,
                          const std::vector<std::string> &parts)
  {
    try
    {
      function();
      ADD_FAILURE() << "no InputError with '" << parts[0] << "'";
    }
    catch (const InputError &error)
    {
      for (const std::string &part : parts)
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
            << "'" << part << "' is not in: " << error.what();
    }
  }
} // namespace quoin::test

#endif
