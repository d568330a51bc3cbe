// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_block_forces_h
#define quoin_dynamics_block_forces_h

#include <quoin/base/state.h>
#include <quoin/dynamics/triangle.h>
#include <quoin/dynamics/triangle_strips.h>
#include <quoin/materials/linear_elastic.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** What the block kernel knows of a mesh; copied by prepare(). */
  struct BlockForcesData
  {
    /** Nodes of each cell, block-major. */
    std::vector<std::array<unsigned int, 3>> cells;
    std::vector<unsigned int> block_first_cell; /**< n_blocks + 1 entries */
    std::vector<unsigned int> block_first_node; /**< n_blocks + 1 entries */

    std::vector<PlaneStiffness> stiffness; /**< the different ones */

    /** Index into stiffness of each cell; empty if there is only one. */
    std::vector<unsigned int> cell_stiffness;

    /**
     * Stress of each cell at zero strain [Pa]; it turns with the cell. Empty:
     * none.
     */
    std::vector<PlaneTensor> initial_stress;

    double thickness = 1.; /**< [m] */
  };

  /** How the block kernel cuts its work; the defaults suit usual caches. */
  struct BlockForcesOptions
  {
    /** Nodes of a tile stay below this many bytes, if a block does. */
    std::size_t tile_bytes = 64 * 1024;

    /**
     * Strips reach over no more than this many consecutive cells, so that in
     * a large block too the lanes stay near one another.
     */
    std::size_t max_run_cells = 4096;

    /** Triangles computed at once: 4, 8, or 0 for what the machine has. */
    unsigned int n_lanes = 0;
  };

  struct NodeRange
  {
    std::size_t begin;
    std::size_t end;

    std::size_t size() const
    {
      return end - begin;
    }
  };

  /**
   * Internal forces of linear elastic blocks that undergo any rotation
   * (triangle.h has the element). Tension is positive, and a force is what
   * the cells exert on their nodes [N].
   *
   * The work comes in tiles, consecutive whole blocks whose nodes fit into
   * the second level cache, so that the caller can do everything else with a
   * tile's nodes while they are there:
   * @code
   *   for (unsigned int tile = 0; tile < forces.n_tiles(); ++tile)
   *     {
   *       forces.add_forces(tile, nodes, force);
   *       advance_nodes(forces.tile_nodes(tile).begin, ...);
   *     }
   * @endcode
   * Blocks share no nodes, hence tiles do not either.
   *
   * Within a tile cells of equal stiffness are laid out as triangle strips,
   * one per SIMD lane. Each step a lane loads the one node that enters its
   * strip, computes the triangle from scratch, keeps the forces of the
   * strip's three current nodes in registers and adds that of the node which
   * leaves to memory, lane after lane, so that lanes may share nodes.
   */
  class BlockForces
  {
  public:
    void prepare(const BlockForcesData &data,
                 const BlockForcesOptions &options = BlockForcesOptions());

    unsigned int n_tiles() const
    {
      return tiles.size();
    }

    NodeRange tile_nodes(const unsigned int tile) const
    {
      return tiles[tile].nodes;
    }

    /** Cells [begin, end) of a tile. */
    NodeRange tile_cells(const unsigned int tile) const
    {
      return tiles[tile].cells;
    }

    /** Adds the internal forces of a tile's cells. */
    void add_forces(unsigned int tile, const NodeRecord *nodes,
                    NodeVector *force) const;

    /**
     * Adds the forces of stiffness-proportional damping: the stress
     * @p beta [s] times the stiffness times the strain rate in the rotating
     * frame, sym(R^T dF/dt). Linear in @p velocity, zero for rigid motion,
     * never doing positive work.
     */
    void add_viscous_forces(unsigned int tile, const NodeRecord *nodes,
                            const NodeVector *velocity, double beta,
                            NodeVector *force) const;

    /** add_forces() cell by cell: what the strips are compared with. */
    void add_forces_by_cell(unsigned int tile, const NodeRecord *nodes,
                            NodeVector *force) const;

    /** add_viscous_forces() cell by cell. */
    void add_viscous_forces_by_cell(unsigned int tile, const NodeRecord *nodes,
                                    const NodeVector *velocity, double beta,
                                    NodeVector *force) const;

    /**
     * Energy of the cells of tiles [begin_tile, end_tile) [J]; minus its
     * gradient are the forces. With initial stress it counts from the
     * undeformed state and may be negative.
     */
    double strain_energy(const NodeRecord *nodes, unsigned int begin_tile,
                         unsigned int end_tile) const;

    /** Of all cells. */
    double strain_energy(const NodeRecord *nodes) const
    {
      return strain_energy(nodes, 0, n_tiles());
    }

    /**
     * Stress xx, yy, xy, zz [Pa] and, if asked for, strain xx, yy, xy of a
     * cell in the fixed frame: R S R^T and R e R^T. The initial stress is
     * part of the stress, in zz by the same factor as the elastic one.
     */
    std::array<double, 4> cell_stress(const NodeRecord *nodes, std::size_t cell,
                                      PlaneTensor *strain = nullptr) const;

    /** cell_stress() of all cells. */
    void stresses(const NodeRecord *nodes,
                  std::vector<std::array<double, 4>> &stress,
                  std::vector<PlaneTensor> &strain) const;

    const PlaneStiffness &cell_stiffness(const unsigned int cell) const
    {
      return data
          .stiffness[data.cell_stiffness.empty() ? 0
                                                 : data.cell_stiffness[cell]];
    }

    const StripStatistics &strip_statistics() const
    {
      return statistics;
    }

    /** Share of the lanes' work that is spent on triangles. */
    double lane_fill() const;

  private:
    /** Strips of equal stiffness that go through the lanes together. */
    struct Run
    {
      std::size_t first_step; /**< into offsets, masks, lane_stress */
      std::size_t n_steps;
      double bulk;             /**< plane bulk modulus times thickness [N/m] */
      double shear;            /**< shear modulus times thickness [N/m] */
      std::size_t first_group; /**< into node_groups */
      std::size_t n_groups;
    };

    struct Tile
    {
      NodeRange nodes;
      NodeRange cells;
      std::size_t begin_run;
      std::size_t end_run;
    };

    void make_tiles(std::size_t tile_bytes);

    void make_runs(Tile &tile, std::size_t max_run_cells);

    void append_run(const std::vector<StripEntry> &strips, const Tile &tile,
                    const PlaneStiffness &stiffness);

    template <int lanes>
    void add_forces_in_lanes(const Tile &tile, const NodeRecord *nodes,
                             NodeVector *force) const;

    template <int lanes>
    void add_viscous_forces_in_lanes(const Tile &tile, const NodeRecord *nodes,
                                     const NodeVector *velocity, double beta,
                                     NodeVector *force) const;

    PlaneTensor initial_stress(const unsigned int cell) const
    {
      return data.initial_stress.empty() ? PlaneTensor{ 0., 0., 0. }
                                         : data.initial_stress[cell];
    }

    BlockForcesData data;
    unsigned int n_lanes = 0;
    std::vector<Tile> tiles;
    std::vector<Run> runs;
    StripStatistics statistics;

    /**
     * The node that enters each lane at each step, as its offset in bytes
     * into the tile's NodeVectors, and half of that into its NodeRecords.
     */
    AlignedArray<std::uint32_t> offsets;

    /**
     * The groups of four consecutive nodes that each run meets: what is to
     * be fetched while the run before is at work.
     */
    std::vector<std::uint32_t> node_groups;

    /** Bit l says that lane l completes a triangle. */
    std::vector<std::uint8_t> masks;

    /**
     * Half the thickness times the initial stress, per step its mean, half
     * its difference and its shear component, each in all lanes.
     */
    AlignedArray<double> lane_stress;
  };
} // namespace quoin

#endif
