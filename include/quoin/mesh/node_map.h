// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_node_map_h
#define quoin_mesh_node_map_h

#include <quoin/base/node_exchange.h>
#include <quoin/mesh/block_triangulation.h>
#include <quoin/mesh/local_mesh.h>

#include <deal.II/dofs/dof_handler.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace quoin
{
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
   * number, too, that of NodeExchange.
   *
   * With degree 2 each cell of the triangulation is four consecutive linear
   * ones here: those at its three vertices and the one in its middle, whose
   * vertices are the midside nodes. Two dimensions only.
   */
  template <int dim>
  class NodeMap
  {
  public:
    /** No node. */
    static constexpr unsigned int none = -1;

    /** A straight line between two points [m]. */
    using Segment = std::array<dealii::Point<dim>, 2>;

    /**
     * Collective; keeps a reference to @p mesh. All ranks have the nodes of the
     * cells that @p segments cross, as partners if they are not their own.
     */
    explicit NodeMap(const BlockTriangulation<dim> &mesh,
                     const std::vector<Segment> &segments = {});

    const BlockTable<dim> &table() const
    {
      return mesh.table();
    }
    const NodeExchange &exchange() const
    {
      return *node_exchange;
    }
    MPI_Comm communicator() const
    {
      return mesh.communicator();
    }

    unsigned int n_owned() const
    {
      return node_exchange->n_owned();
    }
    unsigned int n_local() const
    {
      return points.size();
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
    /** Whether local node @p node lies in the middle of an edge. */
    bool is_midside(const unsigned int node) const
    {
      return !midside.empty() && midside[node];
    }

    /** The cells of all ranks that the segments cross, in the order of the
        segments and along each: the same on all ranks. */
    const std::vector<CrossedCell> &crossed_cells() const
    {
      return crossed;
    }

    const LocalBlocks &blocks() const
    {
      return local_blocks;
    }
    const LocalCells<dim> &cells() const
    {
      return local_cells;
    }
    const LocalFaces<dim> &faces() const
    {
      return local_faces;
    }

  private:
    /** Global nodes of both sides of each joint pair. */
    using Partners = std::vector<std::array<std::vector<unsigned int>, 2>>;

    void number_nodes();
    Partners nodes_of_joints() const;
    /** Finds crossed_cells(). */
    void find_crossed_cells(const std::vector<Segment> &segments);
    void find_ghosts(const Partners &partners_of);
    /** Finds the parts of blocks. Returns the place of each owned cell of the
        triangulation among those. */
    std::vector<unsigned int> order_cells();
    void pack_cells(const std::vector<unsigned int> &cell_place);
    void pack_joints(const Partners &partners_of,
                     const std::vector<unsigned int> &cell_place);
    void pack_outer_faces(const std::vector<unsigned int> &cell_place);
    /** Orders the nodes of a face of @p cell, in three dimensions, so that its
        normal by the right hand points out of the cell. */
    void turn_outward(std::array<unsigned int, dim> &face,
                      const std::array<unsigned int, dim + 1> &cell) const;

    const BlockTriangulation<dim> &mesh;
    dealii::DoFHandler<dim> dofs;
    std::unique_ptr<NodeExchange> node_exchange;

    std::vector<dealii::Point<dim>> points;
    std::vector<unsigned int> node_block;
    std::vector<std::uint64_t> node_numbers;
    std::vector<bool> midside;
    std::vector<CrossedCell> crossed;
    LocalBlocks local_blocks;
    LocalCells<dim> local_cells;
    LocalFaces<dim> local_faces;
    unsigned int shared_nodes_begin = 0, deformable_nodes = 0;
  };

  // A member that exists in two dimensions only.
  template <>
  void NodeMap<2>::find_crossed_cells(const std::vector<Segment> &segments);

  /**
   * The share of a face on which local @p node stands for if a constant
   * traction acts on it [-]: one of dim; by Simpson's rule over the two faces
   * of a quadratic edge a third at a vertex, two thirds at a midside.
   */
  template <int dim>
  double face_share(const NodeMap<dim> &nodes, const unsigned int node)
  {
    return !nodes.cells().is_quadratic ? 1. / dim
           : nodes.is_midside(node)    ? 2. / 3.
                                       : 1. / 3.;
  }
} // namespace quoin

#endif
