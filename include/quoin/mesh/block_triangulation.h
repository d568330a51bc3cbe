// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_block_triangulation_h
#define quoin_mesh_block_triangulation_h

#include <quoin/mesh/block_mesh.h>
#include <quoin/mesh/block_table.h>
#include <quoin/mesh/joint_map.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <array>
#include <utility>
#include <vector>

namespace quoin
{
  /** What one rank has of the mesh: its cells, and those of other ranks that
      share a vertex with them. */
  template <int dim>
  struct MeshPart
  {
    std::vector<dealii::Point<dim>> points;   /**< of its vertices [m] */
    std::vector<unsigned int> vertex_numbers; /**< in the whole mesh */

    std::vector<std::array<unsigned int, dim + 1>> cells; /**< into points */
    /** Numbers of the cells in the whole mesh, ascending; their ranks and
        groups. */
    std::vector<dealii::types::coarse_cell_id> cell_numbers;
    std::vector<unsigned int> cell_ranks, cell_groups;

    /** Face f of cell c, as (dim + 1) c + f, and its boundary id. */
    std::vector<std::pair<std::size_t, unsigned int>> boundary_ids;

    JointMap<dim> joints;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &points &vertex_numbers &cells &cell_numbers &cell_ranks
          &cell_groups &boundary_ids &joints;
    }
  };

  /**
   * A distributed triangulation of coarse cells alone, in the order of their
   * ids. deal.II makes one of a TriangulationDescription, which it copies and
   * sorts twice: that takes twice the time and memory of the triangulation.
   */
  template <int dim>
  class CellTriangulation
    : public dealii::parallel::fullydistributed::Triangulation<dim>
  {
  public:
    using dealii::parallel::fullydistributed::Triangulation<dim>::Triangulation;

    /** Collective. */
    void create(const MeshPart<dim> &part);

  private:
    using Id = dealii::types::coarse_cell_id;

    unsigned int coarse_cell_id_to_coarse_cell_index(Id id) const override;
    Id coarse_cell_index_to_coarse_cell_id(unsigned int index) const override;

    std::vector<Id> ids;
  };

  /**
   * The mesh of record: a distributed triangulation of all blocks, which are
   * its disconnected parts, and the joints between them. Each rank has the
   * cells that it owns and, where a block is distributed over several ranks,
   * those of others that share a vertex with them.
   *
   * Ids of coarse cells are the numbers of the cells in the whole mesh,
   * whatever the number of ranks; material ids are groups, boundary ids of
   * outer faces the names of BlockTable::face_names. Faces along joints are
   * boundary faces, too; joint_boundary_id() is theirs.
   */
  template <int dim>
  class BlockTriangulation
  {
  public:
    using Triangulation
        = dealii::parallel::fullydistributed::Triangulation<dim>;

    /**
     * Collective. Distributes @p mesh, which only the first rank has and which
     * is empty afterwards: cell c goes to rank @p rank_of_cell [c]. No serial
     * triangulation is made; the first rank sends each of the others its part.
     * @p is_rigid has an entry for each block.
     */
    BlockTriangulation(BlockMesh<dim> &mesh,
                       const std::vector<unsigned int> &rank_of_cell,
                       const std::vector<bool> &is_rigid,
                       MPI_Comm communicator);

    const Triangulation &triangulation() const
    {
      return cells;
    }
    const JointMap<dim> &joints() const
    {
      return joint_map;
    }
    const BlockTable<dim> &table() const
    {
      return block_table;
    }
    MPI_Comm communicator() const
    {
      return cells.get_communicator();
    }

    /** Number in the whole mesh of each vertex of triangulation(). */
    const std::vector<unsigned int> &vertex_numbers() const
    {
      return vertices;
    }

    /** Boundary id of faces along a joint named @p name. */
    unsigned int joint_boundary_id(const unsigned int name) const
    {
      return block_table.face_names.size() + name;
    }

  private:
    CellTriangulation<dim> cells;
    JointMap<dim> joint_map;
    BlockTable<dim> block_table;
    std::vector<unsigned int> vertices;
  };
} // namespace quoin

#endif
