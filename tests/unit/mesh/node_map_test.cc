// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/base/node_record.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/mesh/node_map.h>
#include <quoin/mesh/partition.h>

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "test_meshes.h"
#include "test_nodes.h"

// These tests also run on two and three ranks.

namespace quoin::test
{
  namespace
  {
    unsigned int n_ranks()
    {
      return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    }

    double sum(const double value)
    {
      return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
    }

    /** Two blocks of 6 x 4 squares, one on the other; a crack in the upper. */
    BlockMesh<2> two_blocks()
    {
      MeshData<2> data;
      add_grid(data, 6, 4, "lower");
      add_grid(data, 6, 4, "upper", 0., 4.);
      add_curve(data, "bottom", 0., 0., 6., 0.);
      add_curve(data, "crack", 3., 8., 3., 6.);
      SplitOptions options;
      options.joints_along = { "crack" };
      options.joint_ends   = SplitOptions::keep;
      return split_into_blocks(data, options);
    }

    /** Stripes of cells, so that blocks lie on all ranks. */
    std::vector<unsigned int> in_stripes(const BlockMesh<2> &mesh)
    {
      std::vector<unsigned int> rank;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        rank.push_back(c / 5 % n_ranks());
      return rank;
    }

    /** A box of 2 x 1 x 1 cubes, each of its own block and six tetrahedra. */
    BlockMesh<3> two_cubes()
    {
      BlockMesh<3> mesh;
      mesh.group_names        = { "left", "right" };
      mesh.face_names         = { "", "joint", "outside" };
      mesh.block_first_cell   = { 0 };
      mesh.block_first_vertex = { 0 };
      // Kuhn's division: a tetrahedron for each order of the axes.
      const unsigned int axes[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                        { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 } };
      std::map<std::array<unsigned int, 3>, std::array<unsigned int, 2>> faces;
      for (unsigned int block = 0; block < 2; ++block)
      {
        for (unsigned int v = 0; v < 8; ++v)
          mesh.vertices.emplace_back(block + (v & 1U), (v >> 1U) & 1U, v >> 2U);
        for (unsigned int t = 0; t < 6; ++t)
        {
          unsigned int corner = 0;
          std::array<unsigned int, 4> cell;
          for (unsigned int k = 0; k < 4; ++k)
          {
            cell[k] = 8 * block + corner;
            if (k < 3)
              corner |= 1U << axes[t][k];
          }
          if (t > 2) // of odd order
            std::swap(cell[2], cell[3]);
          mesh.cells.push_back(cell);
          mesh.cell_group.push_back(block);
        }
        mesh.block_first_cell.push_back(mesh.n_cells());
        mesh.block_first_vertex.push_back(mesh.n_vertices());
      }
      // Faces at x = 1 are joints, others that occur once are outside.
      std::map<std::array<unsigned int, 3>,
               std::vector<std::array<unsigned int, 4>>>
          sides; // of their nodes in the left cube, sorted: cell and vertices
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
        {
          std::array<unsigned int, 3> face;
          for (unsigned int k = 0; k < 3; ++k)
            face[k] = mesh.cells[c][(f + 1 + k) % 4];
          auto key = face;
          for (unsigned int &v : key)
            if (v >= 8 && mesh.vertices[v][0] == 1.)
              v = v - 8 + 1;
          std::sort(key.begin(), key.end());
          sides[key].push_back({ c, face[0], face[1], face[2] });
        }
      for (const auto &[key, found] : sides)
      {
        const auto nodes = [](const std::array<unsigned int, 4> &side) {
          return std::array<unsigned int, 3>{ side[1], side[2], side[3] };
        };
        if (found.size() == 1)
          mesh.boundary_faces.push_back({ nodes(found[0]), found[0][0], 2 });
        else if (found[0][0] / 6 != found[1][0] / 6)
        {
          auto lower = nodes(found[0]);
          auto upper = lower;
          for (unsigned int &v : upper)
            v = v + 8 - 1;
          mesh.joint_faces.push_back(
              { lower, upper, { found[0][0], found[1][0] }, 1, { 0, 1 } });
        }
      }
      return mesh;
    }

    template <int dim>
    void check_nodes(const BlockMesh<dim> &whole, const NodeMap<dim> &nodes,
                     const BlockTriangulation<dim> &blocks)
    {
      EXPECT_EQ(nodes.exchange().n_global(), whole.n_vertices());
      EXPECT_EQ(sum(nodes.n_owned()), whole.n_vertices());
      EXPECT_EQ(sum(nodes.cells().size()), whole.n_cells());

      // Positions are those of the vertices, whoever owns them.
      unsigned int c = 0;
      for (const auto &cell : blocks.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
        {
          const unsigned int number = cell->id().get_coarse_cell_id();
          EXPECT_EQ(nodes.cells().number[c], number);
          EXPECT_EQ(nodes.cells().group[c], whole.cell_group[number]);
          EXPECT_EQ(nodes.blocks().block_of_cell(c),
                    whole.block_of_cell(number));
          for (unsigned int k = 0; k <= dim; ++k)
          {
            EXPECT_EQ(nodes.point(nodes.cells().nodes[c][k]),
                      whole.vertices[whole.cells[number][k]]);
            EXPECT_EQ(nodes.block_of_node(nodes.cells().nodes[c][k]),
                      whole.block_of_cell(number));
          }
          ++c;
        }

      // What cells add to nodes arrives at the owners, and only that.
      std::map<std::array<double, dim + 1>, double> valence;
      for (unsigned int cell = 0; cell < whole.n_cells(); ++cell)
        for (const unsigned int v : whole.cells[cell])
        {
          std::array<double, dim + 1> key;
          for (unsigned int d = 0; d < dim; ++d)
            key[d] = whole.vertices[v][d];
          key[dim] = v;
          valence[key] += 1.;
        }
      std::vector<dealii::Tensor<1, dim>> count(nodes.n_local());
      for (unsigned int cell = 0; cell < nodes.cells().size(); ++cell)
        for (const unsigned int node : nodes.cells().nodes[cell])
          count[node][0] += 1.;
      nodes.exchange().add_to_owners(count.data());
      double total = 0., squares = 0., expected = 0.;
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        total += count[i][0];
        squares += count[i][0] * count[i][0];
      }
      for (const auto &[key, n] : valence)
        expected += n * n;
      EXPECT_EQ(sum(total), (dim + 1) * whole.n_cells());
      EXPECT_EQ(sum(squares), expected);
    }

    template <int dim>
    void check_joints(const BlockMesh<dim> &whole, const NodeMap<dim> &nodes)
    {
      double sides = 0.;
      for (const JointNodes<dim> &joint : nodes.faces().joints)
      {
        sides += joint.is_own[0] + joint.is_own[1];
        for (unsigned int k = 0; k < dim; ++k)
        {
          EXPECT_EQ(nodes.point(joint.lower[k]), nodes.point(joint.upper[k]));
          EXPECT_EQ(nodes.block_of_node(joint.lower[k]), joint.blocks[0]);
          EXPECT_EQ(nodes.block_of_node(joint.upper[k]), joint.blocks[1]);
        }
        for (unsigned int side = 0; side < 2; ++side)
          if (joint.is_own[side])
            for (const unsigned int node :
                 side == 0 ? joint.lower : joint.upper)
            {
              const auto &cell = nodes.cells().nodes[joint.cells[side]];
              EXPECT_EQ(std::count(cell.begin(), cell.end(), node), 1);
            }
      }
      EXPECT_EQ(sum(sides), 2 * whole.joint_faces.size());

      const std::vector<bool> all(whole.face_names.size(), true);
      const auto faces = gather_faces(nodes, all);
      ASSERT_EQ(faces.size(), whole.boundary_faces.size());
      double area = 0., whole_area = 0.;
      const auto middle = [](const auto &points)
      {
        dealii::Tensor<1, dim> mean;
        for (const auto &p : points)
          mean += p;
        return mean;
      };
      for (unsigned int f = 0; f < faces.size(); ++f)
      {
        area += middle(faces[f].points).norm() * (1. + faces[f].name);
        std::array<dealii::Point<dim>, dim> points;
        for (unsigned int k = 0; k < dim; ++k)
          points[k] = whole.vertices[whole.boundary_faces[f].vertices[k]];
        whole_area
            += middle(points).norm() * (1. + whole.boundary_faces[f].name);
      }
      EXPECT_NEAR(area, whole_area, 1e-12 * area);
    }
  } // namespace

  TEST(NodeMap, KnowsNodesOfBlocksOnSeveralRanks)
  {
    const BlockMesh<2> whole = two_blocks();
    BlockMesh<2> mesh        = whole;
    const BlockTriangulation<2> blocks(mesh, in_stripes(whole),
                                       { false, false }, MPI_COMM_WORLD);
    const NodeMap<2> nodes(blocks);
    check_nodes(whole, nodes, blocks);
    check_joints(whole, nodes);
    EXPECT_EQ(mesh.n_cells(), 0U);
    EXPECT_EQ(blocks.table().n_blocks(), 2U);
    // The upper block touches the lower one and, in its crack, itself.
    using Pairs = std::vector<std::array<unsigned int, 2>>;
    EXPECT_EQ(blocks.table().joined, (Pairs{ { 0, 1 }, { 1, 1 } }));
    const unsigned int n = blocks.table().face_names.size();
    std::vector<bool> bottom(n, false);
    for (unsigned int i = 0; i < n; ++i)
      bottom[i] = blocks.table().face_names[i] == "bottom";
    const auto faces = gather_faces(nodes, bottom);
    ASSERT_EQ(faces.size(), 6U);
    for (const BoundaryFace<2> &face : faces)
    {
      EXPECT_EQ(face.points[0][1], 0.);
      EXPECT_NEAR(face.points[1][0] - face.points[0][0], 1., 1e-14);
    }
  }

  TEST(NodeMap, KeepsTheOrderOfTheMeshOnOneRank)
  {
    const BlockMesh<2> whole = two_blocks();
    BlockMesh<2> mesh        = whole;
    const std::vector<unsigned int> first(whole.n_cells(), 0);
    const BlockTriangulation<2> blocks(mesh, first, { false, false },
                                       MPI_COMM_SELF);
    const NodeMap<2> nodes(blocks);
    ASSERT_EQ(nodes.n_local(), whole.n_vertices());
    for (unsigned int v = 0; v < whole.n_vertices(); ++v)
      EXPECT_EQ(nodes.point(v), whole.vertices[v]);
    for (unsigned int c = 0; c < whole.n_cells(); ++c)
      EXPECT_EQ(nodes.cells().nodes[c], whole.cells[c]);
    ASSERT_EQ(nodes.faces().joints.size(), whole.joint_faces.size());
    for (unsigned int f = 0; f < whole.joint_faces.size(); ++f)
    {
      EXPECT_EQ(nodes.faces().joints[f].lower, whole.joint_faces[f].lower);
      EXPECT_EQ(nodes.faces().joints[f].upper, whole.joint_faces[f].upper);
    }
    ASSERT_EQ(nodes.faces().outer.size(), whole.boundary_faces.size());
    for (unsigned int f = 0; f < whole.boundary_faces.size(); ++f)
    {
      EXPECT_EQ(nodes.faces().outer[f].nodes, whole.boundary_faces[f].vertices);
      EXPECT_EQ(nodes.faces().outer[f].cell, whole.boundary_faces[f].cell);
    }
    ASSERT_EQ(nodes.blocks().parts.size(), 2U);
    for (unsigned int b = 0; b < 2; ++b)
    {
      EXPECT_EQ(nodes.blocks().parts[b].nodes[0], whole.block_first_vertex[b]);
      EXPECT_EQ(nodes.blocks().parts[b].nodes[1],
                whole.block_first_vertex[b + 1]);
    }
  }

  TEST(NodeMap, HasTetrahedraToo)
  {
    const BlockMesh<3> whole = two_cubes();
    ASSERT_EQ(whole.joint_faces.size(), 2U);
    ASSERT_EQ(whole.boundary_faces.size(), 20U);
    BlockMesh<3> mesh = whole;
    std::vector<unsigned int> rank;
    for (unsigned int c = 0; c < whole.n_cells(); ++c)
      rank.push_back(c % n_ranks());
    const BlockTriangulation<3> blocks(mesh, rank, { false, false },
                                       MPI_COMM_WORLD);
    const NodeMap<3> nodes(blocks);
    check_nodes(whole, nodes, blocks);
    check_joints(whole, nodes);
  }

  TEST(NodeMap, PutsMidsideNodesBetweenVertices)
  {
    const BlockMesh<2> whole = two_blocks();
    BlockMesh<2> mesh        = whole;
    mesh.quadratic           = true;
    const BlockTriangulation<2> blocks(mesh, in_stripes(whole),
                                       { false, false }, MPI_COMM_WORLD);
    const NodeMap<2> nodes(blocks);
    EXPECT_EQ(sum(nodes.cells().size()), 4 * whole.n_cells());
    double area = 0.;
    for (unsigned int c = 0; c < nodes.cells().size(); ++c)
    {
      const auto &[i, j, k] = nodes.cells().nodes[c];
      const auto a          = nodes.point(j) - nodes.point(i);
      const auto b          = nodes.point(k) - nodes.point(i);
      EXPECT_NEAR(a[0] * b[1] - a[1] * b[0], 0.25, 1e-14);
      area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      for (const unsigned int node : nodes.cells().mass_nodes(c))
        EXPECT_TRUE(nodes.is_midside(node));
      EXPECT_EQ(nodes.is_midside(i), c % 4 == 3);
    }
    EXPECT_NEAR(sum(area), 48., 1e-12);
    double sides = 0.;
    for (const JointNodes<2> &joint : nodes.faces().joints)
    {
      sides += joint.is_own[0] + joint.is_own[1];
      EXPECT_NE(nodes.is_midside(joint.lower[0]),
                nodes.is_midside(joint.lower[1]));
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_EQ(nodes.point(joint.lower[k]), nodes.point(joint.upper[k]));
      for (unsigned int side = 0; side < 2; ++side)
        if (joint.is_own[side])
          for (const unsigned int node : side == 0 ? joint.lower : joint.upper)
          {
            const auto &cell = nodes.cells().nodes[joint.cells[side]];
            EXPECT_EQ(std::count(cell.begin(), cell.end(), node), 1);
          }
    }
    EXPECT_EQ(sum(sides), 4 * whole.joint_faces.size());
    for (const OuterFace<2> &face : nodes.faces().outer)
      for (const unsigned int node : face.nodes)
      {
        const auto &cell = nodes.cells().nodes[face.cell];
        EXPECT_EQ(std::count(cell.begin(), cell.end(), node), 1);
      }
  }

  namespace
  {
    /** Four blocks of two groups, one of them apart, with two cracks. */
    BlockMesh<2> cracked_blocks()
    {
      MeshData<2> data = grid(6, 4, "rock");
      add_curve(data, "bed", 0, 2, 6, 2);
      add_curve(data, "head", 2, 2, 2, 4);
      add_curve(data, "crack", 4, 0, 4, 1);
      add_curve(data, "short", 1, 1, 2, 1);
      add_grid(data, 6, 1, "concrete", 0., 4.);
      data.quadratic = true;
      SplitOptions options;
      options.joints_along = { "bed", "head", "crack", "short" };
      return split_into_blocks(data, options);
    }
  } // namespace

  TEST(NodeMap, CutsQuadraticTrianglesIntoFourCellsInTheirOrder)
  {
    const BlockMesh<2> whole = cracked_blocks();
    ASSERT_EQ(whole.n_blocks(), 4U);
    for (const bool reordered : { false, true })
    {
      BlockMesh<2> mesh = whole;
      if (reordered)
        renumber_blocks(mesh, { 2, 0, 3, 1 });
      const BlockMesh<2> linear = mesh;
      const TestNodes nodes(mesh);
      ASSERT_TRUE(nodes->table().is_quadratic);
      EXPECT_EQ(nodes->cells().size(), 4 * linear.n_cells());
      for (unsigned int t = 0; t < linear.n_cells(); ++t)
      {
        const auto &[m01, m12, m20] = nodes->cells().nodes[4 * t + 3];
        const unsigned int mid[3]   = { m01, m12, m20 };
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto &cell = nodes->cells().nodes[4 * t + k];
          EXPECT_EQ(cell[1], mid[k]);
          EXPECT_EQ(cell[2], mid[(k + 2) % 3]);
          EXPECT_FALSE(nodes->is_midside(cell[0]));
          EXPECT_TRUE(nodes->is_midside(mid[k]));
          const auto &from = linear.vertices[linear.cells[t][k]];
          const auto &to   = linear.vertices[linear.cells[t][(k + 1) % 3]];
          EXPECT_EQ(nodes->point(cell[0]), from);
          EXPECT_NEAR((nodes->point(mid[k]) - 0.5 * (from + to)).norm(), 0.,
                      1e-14);
        }
        for (unsigned int k = 0; k < 4; ++k)
        {
          EXPECT_EQ(nodes->cells().number[4 * t + k], 4 * t + k);
          EXPECT_EQ(nodes->cells().group[4 * t + k], linear.cell_group[t]);
          EXPECT_EQ(nodes->blocks().block_of_cell(4 * t + k),
                    linear.block_of_cell(t));
          EXPECT_EQ(nodes->cells().mass_nodes(4 * t + k),
                    nodes->cells().nodes[4 * t + 3]);
        }
      }
      for (unsigned int b = 0; b < 4; ++b)
      {
        EXPECT_EQ(nodes->blocks().parts[b].cells[0],
                  4 * linear.block_first_cell[b]);
        EXPECT_EQ(nodes->blocks().parts[b].cells[1],
                  4 * linear.block_first_cell[b + 1]);
      }
    }
  }

  TEST(NodeMap, HalvesFacesOfQuadraticTriangles)
  {
    const BlockMesh<2> whole = cracked_blocks();
    const TestNodes nodes(whole);
    ASSERT_EQ(nodes->faces().outer.size(), 2 * whole.boundary_faces.size());
    ASSERT_EQ(nodes->faces().joints.size(), 2 * whole.joint_faces.size());
    EXPECT_EQ(nodes->faces().n_global_joints, 2 * whole.joint_faces.size());
    double length = 0.;
    for (const OuterFace<2> &face : nodes->faces().outer)
    {
      EXPECT_NE(nodes->is_midside(face.nodes[0]),
                nodes->is_midside(face.nodes[1]));
      EXPECT_TRUE(has_edge(nodes->cells().nodes[face.cell], face.nodes[0],
                           face.nodes[1]));
      // By Simpson's rule.
      double sum = 0.;
      for (const unsigned int node : face.nodes)
      {
        sum += face_share(*nodes, node);
        EXPECT_DOUBLE_EQ(face_share(*nodes, node),
                         nodes->is_midside(node) ? 2. / 3. : 1. / 3.);
      }
      EXPECT_DOUBLE_EQ(sum, 1.);
      length
          += nodes->point(face.nodes[0]).distance(nodes->point(face.nodes[1]));
    }
    EXPECT_NEAR(length, whole.boundary_faces.size(), 1e-12);
    std::vector<unsigned int> n_parts(whole.joint_faces.size(), 0);
    for (const JointNodes<2> &joint : nodes->faces().joints)
    {
      const JointFace<2> &face = whole.joint_faces[joint.number / 2];
      ++n_parts[joint.number / 2];
      EXPECT_EQ(joint.name, face.name);
      EXPECT_EQ(joint.groups, face.groups);
      EXPECT_NE(nodes->is_midside(joint.lower[0]),
                nodes->is_midside(joint.lower[1]));
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_EQ(nodes->is_midside(joint.lower[k]),
                  nodes->is_midside(joint.upper[k]));
      EXPECT_TRUE(has_edge(nodes->cells().nodes[joint.cells[0]], joint.lower[0],
                           joint.lower[1]));
      EXPECT_TRUE(has_edge(nodes->cells().nodes[joint.cells[1]], joint.upper[1],
                           joint.upper[0]));
      // Both halves have the direction of the whole.
      const auto t
          = nodes->point(joint.lower[1]) - nodes->point(joint.lower[0]);
      const auto along
          = whole.vertices[face.lower[1]] - whole.vertices[face.lower[0]];
      EXPECT_NEAR((t - 0.5 * along).norm(), 0., 1e-14);
    }
    EXPECT_EQ(n_parts, std::vector<unsigned int>(n_parts.size(), 2));
  }

  TEST(NodeMap, CracksOfQuadraticTrianglesEndAtCorners)
  {
    const BlockMesh<2> whole = cracked_blocks();
    const TestNodes nodes(whole);
    EXPECT_EQ(nodes_at(nodes, 4., 1.).size(), 1U);
    EXPECT_EQ(nodes_at(nodes, 4., 0.5).size(), 2U);
    EXPECT_EQ(nodes_at(nodes, 4., 0.).size(), 2U);
    EXPECT_EQ(nodes_at(nodes, 1., 1.).size(), 1U);
    EXPECT_EQ(nodes_at(nodes, 2., 1.).size(), 1U);
    EXPECT_EQ(make_mesh_report(whole).n_nodes, nodes->exchange().n_global());
  }

  TEST(NodeMap, SaysThePointOfTheLowestNode)
  {
    const BlockMesh<2> whole = two_blocks();
    BlockMesh<2> mesh        = whole;
    const BlockTriangulation<2> blocks(mesh, in_stripes(whole),
                                       { false, false }, MPI_COMM_WORLD);
    const NodeMap<2> nodes(blocks);
    dealii::Point<2> position;
    EXPECT_FALSE(first_point(nodes, NodeMap<2>::none, position));
    const bool is_last
        = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)
          == n_ranks() - 1;
    unsigned int block = 7;
    EXPECT_TRUE(
        first_point(nodes, is_last ? 0 : NodeMap<2>::none, position, &block));
    if (is_last)
    {
      EXPECT_EQ(position, nodes.point(0));
    }
    EXPECT_LT(block, 2U);
  }

  TEST(Partition, KeepsBlocksWholeWhereThatBalances)
  {
    MeshData<2> data;
    for (unsigned int b = 0; b < 8; ++b)
      add_grid(data, 4, 4, "block", 5. * b);
    BlockMesh<2> mesh = split_into_blocks(data, {});
    const auto rank
        = partition_cells(mesh, std::vector<bool>(mesh.n_blocks(), false), 4);
    std::vector<unsigned int> load(4, 0);
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
    {
      for (unsigned int c = mesh.block_first_cell[b];
           c < mesh.block_first_cell[b + 1]; ++c)
        EXPECT_EQ(rank[c], rank[mesh.block_first_cell[b]]);
      ++load[rank[mesh.block_first_cell[b]]];
    }
    EXPECT_EQ(load, std::vector<unsigned int>(4, 2));
  }

  TEST(Partition, SharesManyBlocksEvenly)
  {
    // 64 blocks of 2 x 2 squares with joints between.
    MeshData<2> data = grid(16, 16, "rock");
    for (unsigned int i = 2; i < 16; i += 2)
    {
      add_curve(data, "joint", i, 0., i, 16.);
      add_curve(data, "joint", 0., i, 16., i);
    }
    SplitOptions options;
    options.joints_along = { "joint" };
    BlockMesh<2> mesh    = split_into_blocks(data, options);
    ASSERT_EQ(mesh.n_blocks(), 64U);
    const auto rank = partition_cells(mesh, std::vector<bool>(64, false), 4);
    ASSERT_EQ(rank.size(), mesh.n_cells());
    std::vector<unsigned int> load(4, 0);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      EXPECT_EQ(rank[c], rank[mesh.block_first_cell[mesh.block_of_cell(c)]]);
      ++load.at(rank[c]);
    }
    for (const unsigned int l : load)
      EXPECT_NEAR(l, 16 * 8, 2 * 8);
  }

  TEST(Partition, OfFewBlocks)
  {
    MeshData<2> data;
    for (unsigned int b = 0; b < 4; ++b)
      add_grid(data, 2, 2, "block", 3. * b);
    BlockMesh<2> mesh = split_into_blocks(data, {});
    const std::vector<bool> all_rigid(4, true), none_rigid(4, false);
    EXPECT_EQ(partition_cells(mesh, none_rigid, 1),
              std::vector<unsigned int>(mesh.n_cells(), 0));
    // One to a rank, also where ranks are left over and blocks stay whole.
    for (const unsigned int n : { 4U, 9U })
    {
      const auto rank = partition_cells(mesh, all_rigid, n);
      ASSERT_EQ(rank.size(), mesh.n_cells());
      std::set<unsigned int> used(rank.begin(), rank.end());
      EXPECT_EQ(used.size(), 4U);
      EXPECT_LT(*used.rbegin(), n);
    }

    // A large block and small ones: no rank may be empty.
    MeshData<2> uneven = grid(10, 10, "block");
    for (unsigned int i = 0; i < 4; ++i)
      add_grid(uneven, 1, 1, "block", 20. + 2 * i);
    mesh = split_into_blocks(uneven, {});
    ASSERT_EQ(mesh.n_blocks(), 5U);
    for (const bool rigid : { false, true })
    {
      const auto rank = partition_cells(mesh, std::vector<bool>(5, rigid), 3);
      const std::set<unsigned int> used(rank.begin(), rank.end());
      EXPECT_EQ(used, (std::set<unsigned int>{ 0, 1, 2 }));
      if (!rigid)
        continue;
      std::vector<unsigned int> n_of_rank(3, 0);
      for (unsigned int b = 0; b < 5; ++b)
        ++n_of_rank[rank[mesh.block_first_cell[b]]];
      std::sort(n_of_rank.begin(), n_of_rank.end());
      EXPECT_EQ(n_of_rank, (std::vector<unsigned int>{ 1, 2, 2 }));
    }
  }

  TEST(Partition, DividesALargeBlock)
  {
    MeshData<2> data;
    add_grid(data, 60, 60, "large");
    add_grid(data, 6, 6, "small", 70.);
    BlockMesh<2> mesh = split_into_blocks(data, {});
    for (const unsigned int n : { 2U, 3U, 4U })
    {
      const auto rank = partition_cells(mesh, { false, false }, n);
      std::vector<double> load(n, 0.);
      for (const unsigned int r : rank)
        load[r] += double(n) / mesh.n_cells();
      for (const double part : load)
        EXPECT_NEAR(part, 1., 0.1);
      // A straight cut between two ranks has 61 vertices.
      std::vector<unsigned int> owner(mesh.n_vertices(), n);
      unsigned int n_shared = 0;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (const unsigned int v : mesh.cells[c])
        {
          n_shared += owner[v] < n && owner[v] != rank[c];
          owner[v] = rank[c];
        }
      EXPECT_LT(n_shared, n * 61 * 6);
    }
  }

  TEST(Partition, KeepsRigidBlocksWhole)
  {
    MeshData<2> data;
    add_grid(data, 30, 30, "large");
    add_grid(data, 6, 6, "small", 40.);
    BlockMesh<2> mesh = split_into_blocks(data, {});
    const auto rank   = partition_cells(mesh, { true, true }, 3);
    for (unsigned int b = 0; b < 2; ++b)
      for (unsigned int c = mesh.block_first_cell[b];
           c < mesh.block_first_cell[b + 1]; ++c)
        EXPECT_EQ(rank[c], rank[mesh.block_first_cell[b]]);
  }
} // namespace quoin::test
