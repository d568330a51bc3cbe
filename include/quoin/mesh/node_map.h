// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_node_map_h
#define quoin_mesh_node_map_h

#include <quoin/base/node_exchange.h>
#include <quoin/mesh/block_triangulation.h>

#include <deal.II/dofs/dof_handler.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /** Cells and nodes [begin, end) that this rank owns of one block. */
  struct BlockPart
  {
    unsigned int number; /**< of the block in the whole mesh */
    std::array<unsigned int, 2> cells;
    /** Cells from this one on have no nodes that other ranks share. */
    unsigned int first_inner_cell;
    /** Without those that other ranks share. */
    std::array<unsigned int, 2> nodes;
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
    unsigned int name;                   /**< into BlockTable::face_names */
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
    unsigned int number;               /**< of all ranks */
    unsigned int name;                 /**< into BlockTable::face_names */
    std::array<unsigned int, 2> groups;
  };

  /** An OuterFace of any rank. */
  template <int dim>
  struct BoundaryFace
  {
    std::array<unsigned int, dim> nodes; /**< global */
    std::array<dealii::Point<dim>, dim> points;
    std::array<double, dim> shares; /**< NodeMap::face_share() of the nodes */
    unsigned int group;             /**< of the cell behind it */
    unsigned int block;             /**< of that cell */
    unsigned int name;              /**< into BlockTable::face_names */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &points &shares &group &block &name;
    }
  };

  /**
   * The nodes of the cells that this rank owns, numbered as the kernels want
   * them, and what lies on them. From here operators pack their arrays; no
   * inner loop sees deal.II.
   *
   * Owned nodes come first, block by block as BlockTable has them: those of
   * deformable blocks that no other rank shares, those that one does, then
   * those of rigid blocks, which are never distributed over ranks; after them
   * the ghosts of NodeExchange. Of each block, cells that have nodes which
   * other ranks share come before the others, so that their forces can be on
   * their way while those of the others are computed. Nodes have a global
   * number, too, which is the index of their degree of freedom in
   * dof_handler().
   *
   * With degree 2 each cell of the triangulation is four consecutive linear
   * ones here: those at its three vertices and the one in its middle, whose
   * vertices are the midside nodes. Two dimensions only.
   */
  template <int dim>
  class NodeMap
  {
  public:
    /** Collective; keeps a reference to @p blocks. */
    explicit NodeMap(const BlockTriangulation<dim> &blocks);

    const BlockTable<dim> &table() const
    {
      return blocks.table();
    }
    const dealii::DoFHandler<dim> &dof_handler() const
    {
      return dofs;
    }
    const NodeExchange &exchange() const
    {
      return *node_exchange;
    }
    MPI_Comm communicator() const
    {
      return blocks.communicator();
    }

    unsigned int n_owned() const
    {
      return node_exchange->n_owned();
    }
    unsigned int n_local() const
    {
      return points.size();
    }
    /** Nodes of all ranks. */
    unsigned int n_global() const
    {
      return node_exchange->n_global();
    }
    /** Owned nodes from this one on are those of rigid blocks. */
    unsigned int n_deformable_nodes() const
    {
      return deformable_nodes;
    }
    /** Owned nodes from this one on, and below n_deformable_nodes(), are
        shared by other ranks. */
    unsigned int first_shared_node() const
    {
      return shared_nodes_begin;
    }
    /** Owned cells from this one on are those of rigid blocks. */
    unsigned int n_deformable_cells() const
    {
      return n_deformable_parts == parts.size()
                 ? cells.size()
                 : parts[n_deformable_parts].cells[0];
    }

    /** Reference position of local node @p node [m]. */
    const dealii::Point<dim> &point(const unsigned int node) const
    {
      return points[node];
    }
    /** Number in the whole mesh of the block of local node @p node. */
    unsigned int block_of_node(const unsigned int node) const
    {
      return node_block[node];
    }
    /** A number of local node @p node in the whole mesh that does not depend
        on the number of ranks: that of its vertex or, in the middle of an edge,
        both of the edge's. */
    std::uint64_t number_of_node(const unsigned int node) const
    {
      return node_numbers[node];
    }
    /** Numbers of the owned cells, likewise. */
    std::vector<std::uint64_t> cell_numbers() const;
    bool is_midside(const unsigned int node) const
    {
      return !midside.empty() && midside[node];
    }

    unsigned int n_cells() const
    {
      return cells.size();
    }
    /** Local nodes of owned cell @p cell; positive volume. */
    const std::array<unsigned int, dim + 1> &cell(const unsigned int cell) const
    {
      return cells[cell];
    }
    const std::vector<std::array<unsigned int, dim + 1>> &all_cells() const
    {
      return cells;
    }
    unsigned int group_of_cell(const unsigned int cell) const
    {
      return cell_group[cell];
    }
    unsigned int block_of_cell(const unsigned int cell) const;

    /**
     * The nodes that carry the mass of @p cell in equal shares: its own; of a
     * quadratic triangle those in the middle of the edges, because the
     * integrals of the vertices' shape functions vanish.
     */
    const std::array<unsigned int, dim + 1> &
    mass_nodes(const unsigned int cell) const
    {
      return cells[table().is_quadratic ? cell | 3U : cell];
    }

    /**
     * The share of a face on which @p node stands for if a constant traction
     * acts on it: one of dim; by Simpson's rule over the two faces of a
     * quadratic edge a third at a vertex, two thirds at a midside.
     */
    double face_share(const unsigned int node) const
    {
      return !table().is_quadratic ? 1. / dim
             : is_midside(node)    ? 2. / 3.
                                   : 1. / 3.;
    }

    /** Blocks of which this rank has cells, ascending: rigid ones last. */
    const std::vector<BlockPart> &block_parts() const
    {
      return parts;
    }
    /** Entries of block_parts() from this one on are rigid. */
    unsigned int n_deformable_block_parts() const
    {
      return n_deformable_parts;
    }
    /** Entry of block_parts() of block @p number; their number if this rank
        has none of it. */
    unsigned int find_part(unsigned int number) const;

    /** Joint faces of all ranks, as JointNodes count them. */
    unsigned int n_joint_faces() const
    {
      return table().n_joint_faces * (table().is_quadratic ? 2 : 1);
    }
    /** Cells of all ranks, as n_cells() counts them. */
    unsigned int n_global_cells() const
    {
      return table().n_cells() * (table().is_quadratic ? 4 : 1);
    }

    /** Diagonal of the box around all nodes [m]. */
    double diagonal() const
    {
      return table().box[0].distance(table().box[1]);
    }

    const std::vector<OuterFace<dim>> &outer_faces() const
    {
      return outer;
    }
    const std::vector<JointNodes<dim>> &joint_faces() const
    {
      return joints;
    }

    /**
     * The outer faces of all ranks whose names @p wanted says, on all ranks,
     * by ascending global nodes. Collective.
     */
    std::vector<BoundaryFace<dim>>
    gather_faces(const std::vector<bool> &wanted) const;

    /** Lower and upper corner of the box around block @p number [m].
        Collective. */
    std::array<dealii::Point<dim>, 2> box_of_block(unsigned int number) const;

    /** Position of the first node of block @p number [m]. Collective. */
    dealii::Point<dim> point_of_block(unsigned int number) const;

    /**
     * Of the ranks that give a local @p node, position of that with the lowest
     * global number, on all ranks; false if all give @p none. Collective.
     */
    static constexpr unsigned int none = -1;
    bool first_point(unsigned int node, dealii::Point<dim> &position,
                     unsigned int *block = nullptr) const;

  private:
    void number_nodes();
    void find_ghosts();
    void order_cells();
    void pack_cells();
    void pack_faces();
    /** Orders the nodes of a face of @p cell, in three dimensions, so that its
        normal by the right hand points out of the cell. */
    void turn_outward(std::array<unsigned int, dim> &face,
                      const std::array<unsigned int, dim + 1> &cell) const;

    using Partners = std::vector<std::array<std::vector<unsigned int>, 2>>;
    /** Global nodes of both sides of each joint pair. */
    Partners nodes_of_joints() const;

    const BlockTriangulation<dim> &blocks;
    dealii::DoFHandler<dim> dofs;
    std::unique_ptr<NodeExchange> node_exchange;

    std::vector<dealii::Point<dim>> points;
    std::vector<unsigned int> node_block;
    std::vector<std::uint64_t> node_numbers;
    std::vector<bool> midside;
    std::vector<std::array<unsigned int, dim + 1>> cells;
    std::vector<unsigned int> cell_group;
    /** Place of each owned cell of the triangulation among those. */
    std::vector<unsigned int> cell_place;
    std::vector<BlockPart> parts;
    std::vector<OuterFace<dim>> outer;
    std::vector<JointNodes<dim>> joints;
    unsigned int n_deformable_parts = 0;
    unsigned int shared_nodes_begin = 0, deformable_nodes = 0;
  };
} // namespace quoin

#endif
