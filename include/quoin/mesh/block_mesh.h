// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_block_mesh_h
#define quoin_mesh_block_mesh_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * An edge of a cell that lies on the boundary of its block. Seen from its
   * cell, which is on the left, the edge runs from vertices[0] to vertices[1]
   * (counter-clockwise around the block).
   */
  struct BlockFace
  {
    std::array<unsigned int, 2> vertices;
    unsigned int cell;
    unsigned int name; /**< into BlockMesh::line_names */
  };

  /**
   * Two coincident edges of two blocks (or of the two lips of a crack inside
   * one block). The lower side runs from lower[0] to lower[1] with its cell on
   * the left; upper[k] is the vertex that coincides with lower[k]. The joint
   * normal points from lower to upper: n = (t_y, -t_x) for the edge
   * direction t.
   *
   * Lower is the side whose normal points up (n_y > 0), and for vertical edges
   * (|n_y| <= 1e-6) the one whose normal points right (n_x > 0). So lower is
   * the block below a bed joint, with t pointing left (t_x < 0), and the block
   * left of a head joint, with t pointing up (t_y > 0). The sides of a curved
   * joint change places where its tangent is vertical.
   *
   * Where a joint ends inside a block the vertex there is not split:
   * lower[k] == upper[k] at such a tip.
   */
  struct JointFace
  {
    std::array<unsigned int, 2> lower;
    std::array<unsigned int, 2> upper;
    std::array<unsigned int, 2> cells;  /**< of lower, of upper */
    unsigned int name;                  /**< into line_names; may be unnamed */
    std::array<unsigned int, 2> groups; /**< cell groups of lower, upper */
  };

  /**
   * The blocks that a mesh fell into: the triangles of all blocks, which share
   * no vertices, and how they touch. Blocks are numbered one after the
   * other; cells and vertices are block-major, and within a block the
   * vertices on its boundary come first.
   *
   * A quadratic mesh is one of six-node triangles, each of which is the four
   * consecutive cells of cut_into_quadratic_triangles(); the fourth has the
   * nodes in the middle of its edges as vertices. An edge of a quadratic
   * triangle is two faces, each with a corner and a midside node.
   */
  template <int dim>
  struct BlockMesh
  {
    std::vector<dealii::Point<dim>> vertices;
    std::vector<std::array<unsigned int, 3>> cells; /**< counter-clockwise */
    std::vector<unsigned int> cell_group;           /**< into group_names */
    std::vector<unsigned int> block_first_cell;   /**< n_blocks() + 1 entries */
    std::vector<unsigned int> block_first_vertex; /**< n_blocks() + 1 entries */

    std::vector<std::string> group_names; /**< of physical surfaces */
    std::vector<std::string> line_names;  /**< of physical curves; [0] is "" */

    bool quadratic = false;
    std::vector<bool> is_midside; /**< by vertex; empty if not quadratic */

    std::vector<BlockFace> boundary_faces; /**< outer, not joints */
    std::vector<JointFace> joint_faces;

    /** Cells that the mesh file listed clockwise and that were turned. */
    unsigned int n_reoriented_cells = 0;

    unsigned int n_blocks() const
    {
      return block_first_cell.empty() ? 0 : block_first_cell.size() - 1;
    }
    unsigned int n_cells() const
    {
      return cells.size();
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

    /**
     * The share of a boundary or joint face that its end @p vertex stands for
     * if a constant traction acts on it: a half; by Simpson's rule over the two
     * faces of a quadratic edge a third at a corner, two thirds at a midside.
     */
    double edge_share(const unsigned int vertex) const
    {
      return !quadratic ? 0.5 : is_midside[vertex] ? 2. / 3. : 1. / 3.;
    }

    /**
     * The vertices that carry the mass of @p cell in equal thirds: its own; of
     * a quadratic triangle those in the middle of the edges, because the
     * integrals of the corners' shape functions vanish.
     */
    const std::array<unsigned int, 3> &
    mass_vertices(const unsigned int cell) const
    {
      return cells[quadratic ? cell | 3U : cell];
    }
  };
} // namespace quoin

#endif
