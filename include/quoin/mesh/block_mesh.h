// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_block_mesh_h
#define quoin_mesh_block_mesh_h

#include <quoin/mesh/mixed_tetrahedra.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * A face of a cell that lies on the boundary of its block. In two dimensions
   * it runs from vertices[0] to vertices[1] with the cell on the left
   * (counter-clockwise around the block); in three, vertices run anticlockwise
   * for who looks from outside.
   */
  template <int dim>
  struct BlockFace
  {
    std::array<unsigned int, dim> vertices;
    unsigned int cell;
    unsigned int name; /**< index into BlockMesh::face_names */
  };

  /**
   * Two coincident faces of two blocks (or of the two lips of a crack inside
   * one block). The vertices of the lower side run as those of a BlockFace;
   * upper[k] is the vertex that coincides with lower[k]. The joint normal
   * points from lower to upper: n = (t_y, -t_x) for the direction t from
   * lower[0] to lower[1], and in three dimensions the normal by the right hand
   * of lower[0], lower[1], lower[2].
   *
   * Lower is the side whose normal points up: the last component of n is
   * positive, or where that is none (at most 1e-6 of |n|) the one before. In
   * two dimensions lower is the block below a bed joint, with t pointing left
   * (t_x < 0), and the block left of a head joint, with t pointing up
   * (t_y > 0). In three it is the block below (n_z > 0), else the one with
   * the lesser y (n_y > 0), else the one with the lesser x (n_x > 0). The
   * sides of a curved joint change places where its tangent is vertical.
   *
   * Where a joint ends inside a block the vertices there are not split:
   * lower[k] == upper[k] at such a tip or front.
   */
  template <int dim>
  struct JointFace
  {
    std::array<unsigned int, dim> lower;
    std::array<unsigned int, dim> upper;
    /** Cells of the lower and the upper side. */
    std::array<unsigned int, 2> cells;
    unsigned int name; /**< index into face_names; may be unnamed */
    std::array<unsigned int, 2> groups; /**< cell groups of lower, upper */
  };

  /**
   * The blocks that a mesh fell into: the simplices of all blocks, which share
   * no vertices, and how they touch. It is what BlockTriangulation distributes,
   * and exists on the first rank until then. Blocks are numbered one after the
   * other; cells and vertices are block-major, and within a block the
   * vertices on its boundary come first.
   */
  template <int dim>
  struct BlockMesh
  {
    std::vector<dealii::Point<dim>> vertices;
    std::vector<std::array<unsigned int, dim + 1>>
        cells;                                  /**< positive volume */
    std::vector<unsigned int> cell_group;       /**< indices into group_names */
    std::vector<unsigned int> block_first_cell; /**< n_blocks() + 1 entries */
    std::vector<unsigned int> block_first_vertex; /**< n_blocks() + 1 entries */

    std::vector<std::string> group_names; /**< names of surfaces or volumes */
    std::vector<std::string>
        face_names; /**< names of curves or surfaces; [0] is "" */

    /** Cells are to have nodes in the middle of their edges; see NodeMap. */
    bool quadratic = false;

    /** Each eight cells are one mixed tetrahedron, see make_mixed(). */
    bool mixed = false;

    std::vector<BlockFace<dim>> boundary_faces; /**< outer, not joints */
    std::vector<JointFace<dim>> joint_faces;

    /** Cells of negative volume in the file, which were turned over. */
    unsigned int n_reoriented_cells = 0;

    /** How far at most vertices of blocks drawn apart were moved to meet those
        across their joints [m]. */
    double largest_shift = 0.;

    unsigned int n_blocks() const
    {
      return block_first_cell.empty() ? 0 : block_first_cell.size() - 1;
    }
    unsigned int n_cells() const
    {
      return cells.size();
    }
    /** Consecutive cells that stay together, on one rank. */
    unsigned int n_joined_cells() const
    {
      return mixed ? parts_of_mixed : 1;
    }
    unsigned int n_vertices() const
    {
      return vertices.size();
    }
    unsigned int block_of_cell(const unsigned int cell) const
    {
      return std::upper_bound(block_first_cell.begin(), block_first_cell.end(),
                              cell)
             - block_first_cell.begin() - 1;
    }
    unsigned int block_of_vertex(const unsigned int vertex) const
    {
      return std::upper_bound(block_first_vertex.begin(),
                              block_first_vertex.end(), vertex)
             - block_first_vertex.begin() - 1;
    }
  };
} // namespace quoin

#endif
