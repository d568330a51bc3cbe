// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_local_mesh_h
#define quoin_mesh_local_mesh_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** Cells and nodes [begin, end) that this rank owns of one block. */
  struct BlockPart
  {
    unsigned int number; /**< number of the block in the whole mesh */
    std::array<unsigned int, 2> cells;
    /** Cells from this one on have no nodes that other ranks share. */
    unsigned int first_inner_cell;
    /** Without those that other ranks share. */
    std::array<unsigned int, 2> nodes;
  };

  /** The blocks of which a rank owns cells. */
  struct LocalBlocks
  {
    /** Blocks by ascending number; rigid ones last. */
    std::vector<BlockPart> parts;
    unsigned int n_deformable = 0; /**< parts from this one on are rigid */

    /** Index of the part of block @p number; parts.size() if there is none. */
    unsigned int find(const unsigned int number) const
    {
      const auto found
          = std::lower_bound(parts.begin(), parts.end(), number,
                             [](const BlockPart &part, const unsigned int n)
                             { return part.number < n; });
      return found != parts.end() && found->number == number
                 ? found - parts.begin()
                 : parts.size();
    }

    /** Number in the whole mesh of the block of owned cell @p cell. */
    unsigned int block_of_cell(const unsigned int cell) const
    {
      return (std::upper_bound(parts.begin(), parts.end(), cell,
                               [](const unsigned int c, const BlockPart &part)
                               { return c < part.cells[0]; })
              - 1)
          ->number;
    }
  };

  /** The cells that a rank owns, those of LocalBlocks in their order. */
  template <int dim>
  struct LocalCells
  {
    using Nodes = std::array<unsigned int, dim + 1>;

    std::vector<Nodes> nodes;        /**< local, of each; positive volume */
    std::vector<unsigned int> group; /**< material id of each */
    /** Number of each cell in the whole mesh. */
    std::vector<std::uint64_t> number;
    unsigned int n_deformable = 0; /**< cells from this one on are rigid */
    bool is_quadratic = false; /**< four each are one triangle of degree 2 */

    unsigned int size() const
    {
      return nodes.size();
    }

    /**
     * The nodes that carry the mass of @p cell in equal shares: its own; of a
     * quadratic triangle those in the middle of the edges, because the
     * integrals of the vertices' shape functions vanish.
     */
    const Nodes &mass_nodes(const unsigned int cell) const
    {
      return nodes[is_quadratic ? cell | 3U : cell];
    }
  };

  /**
   * A face of an owned cell on the outer boundary of its block, or one half of
   * it if the cell has midside nodes. In two dimensions it runs from nodes[0]
   * to nodes[1] with the cell on its left; in three, nodes run anticlockwise
   * for who looks from outside.
   */
  template <int dim>
  struct OuterFace
  {
    std::array<unsigned int, dim> nodes; /**< local */
    unsigned int cell;                   /**< local */
    unsigned int name; /**< index into BlockTable::face_names */
  };

  /** A JointPair by local nodes, or one half of it; see JointFace. */
  template <int dim>
  struct JointNodes
  {
    std::array<unsigned int, dim> lower, upper; /**< local */
    std::array<unsigned int, 2> blocks;         /**< numbers of the sides' */
    /** Whether this rank owns the cells of the lower and the upper side. The
        nodes of another rank's side are partners of its NodeExchange. */
    std::array<bool, 2> is_own;
    std::array<unsigned int, 2> cells; /**< local, of own sides */
    unsigned int number;               /**< number on all ranks */
    unsigned int name;                 /**< index into BlockTable::face_names */
    std::array<unsigned int, 2> groups;
  };

  /** The part of a straight segment that lies in a linear cell of any rank, in
      two dimensions. */
  struct CrossedCell
  {
    unsigned int segment;      /**< number of the segment */
    double begin, end;         /**< of the part, as shares of its length [-] */
    unsigned int block, group; /**< of the cell */
    std::uint64_t number;      /**< of the cell in the whole mesh */
    std::array<unsigned int, 3> nodes; /**< global */
    /** Corners x, y of the cell [m]. */
    std::array<dealii::Point<2>, 3> corners;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &segment &begin &end &block &group &number &nodes &corners;
    }
  };

  /** The faces at the boundaries of blocks that a rank has. */
  template <int dim>
  struct LocalFaces
  {
    std::vector<OuterFace<dim>> outer;   /**< outer faces by ascending nodes */
    std::vector<JointNodes<dim>> joints; /**< joints by ascending number */
    unsigned int n_global_joints = 0;    /**< JointNodes of all ranks */
  };
} // namespace quoin

#endif
