// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_block_forces_h
#define quoin_blocks_block_forces_h

#include <quoin/block_elements/block_forces_data.h>
#include <quoin/blocks/triangle_strips.h>
#include <quoin/materials/plastic_history.h>
#include <quoin/operators/force_operator.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** Internal forces of deformable blocks. */
  template <int dim>
  class BlockForces;

  /** Division of the kernel's work; the defaults suit usual caches. */
  struct BlockForcesOptions
  {
    /** Nodes of a tile stay below this many bytes, if a block does. */
    std::size_t tile_bytes = 64 * 1024;

    /**
     * Strips reach over no more than this many consecutive cells, so that in
     * a large block too the lanes stay near one another.
     */
    std::size_t max_run_cells = 4096;

    /** Triangles computed at once: 4, 8, or 0: what the machine supports. */
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
   * Internal forces of blocks that undergo any rotation (triangle.h has the
   * element), linear elastic or elastoplastic. Tension is positive, and a force
   * is what the cells exert on their nodes [N].
   *
   * The work comes in tiles, consecutive whole blocks whose nodes fit into
   * the second level cache, so that the caller can do everything else with a
   * tile's nodes while they are there:
   * @code
   *   for (unsigned int tile = 0; tile < forces.n_tiles(); ++tile)
   *     {
   *       forces.add_forces(tile, nodes, history, force);
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
   *
   * Cells that yield have their own kernel, which also loads each cell's
   * plastic strain, compares the trial stress with the limits in lanes and
   * hands the triangles that exceed them to the law one by one.
   */
  template <>
  class BlockForces<2> : public ForceOperator<2>
  {
  public:
    void prepare(const BlockForcesData<2> &data,
                 const BlockForcesOptions &options = BlockForcesOptions());

    const char *kind() const override
    {
      return "blocks";
    }
    void prepare(State<2> &state) const override;
    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;
    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override;
    bool is_internal() const override
    {
      return true;
    }

    void linearise(State<2> &state, bool with_stiffness,
                   const TakeElement<2> &take) const override;

    /** Adds the bound of linear cells. */
    void add_stiffness_bound(
        const State<2> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<2>> &stiffness) const override;

    /** Argument of prepare(); see cell_states.h for the states of cells. */
    const BlockForcesData<2> &cell_data() const
    {
      return data;
    }

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

    /**
     * Adds the internal forces of a tile's cells. Updates @p history for the
     * current positions and returns the energy that this dissipates [J].
     */
    double add_forces(unsigned int tile, const NodeRecord<2> *nodes,
                      PlasticHistory &history,
                      dealii::Tensor<1, 2> *force) const;

    /** Updates @p history as add_forces() does and returns the dissipation [J].
     */
    double update(const NodeRecord<2> *nodes, PlasticHistory &history) const;

    /** strain_energy() of cell_states.h [J]. */
    double strain_energy(const NodeRecord<2> *nodes,
                         const PlasticHistory &history) const;

    /**
     * Adds the forces of stiffness-proportional damping: the stress
     * @p beta [s] times the stiffness times the strain rate in the rotating
     * frame, sym(R^T dF/dt). Linear in @p velocity, zero for rigid motion,
     * never doing positive work; cells that yield have it unchanged.
     */
    void add_viscous_forces(unsigned int tile, const NodeRecord<2> *nodes,
                            const dealii::Tensor<1, 2> *velocity, double beta,
                            dealii::Tensor<1, 2> *force) const;

  private:
    /** Strips of equal stiffness that go through the lanes together. */
    struct Run
    {
      std::size_t first_step; /**< index into offsets, masks, lane_stress */
      std::size_t n_steps;
      double bulk;             /**< plane bulk modulus times thickness [N/m] */
      double shear;            /**< shear modulus times thickness [N/m] */
      unsigned int stiffness;  /**< index of the stiffness */
      std::size_t first_group; /**< index into node_groups */
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
                    unsigned int s);

    template <int lanes>
    double add_forces_in_lanes(const Tile &tile, const NodeRecord<2> *nodes,
                               PlasticHistory &history,
                               dealii::Tensor<1, 2> *force) const;

    template <int lanes>
    double energy_in_lanes(const Tile &tile, const NodeRecord<2> *nodes) const;

    template <int lanes>
    void
    add_viscous_forces_in_lanes(const Tile &tile, const NodeRecord<2> *nodes,
                                const dealii::Tensor<1, 2> *velocity,
                                double beta, dealii::Tensor<1, 2> *force) const;

    BlockForcesData<2> data;
    unsigned int n_lanes = 0;
    std::vector<Tile> tiles;
    std::vector<Run> runs;

    /**
     * The node that enters each lane at each step, as its offset in bytes
     * into the tile's NodeVectors, and half of that into its NodeRecords.
     */
    AlignedArray<std::uint32_t> offsets;

    /**
     * The groups of four consecutive nodes of each run, prefetched during the
     * run before.
     */
    std::vector<std::uint32_t> node_groups;

    /** Bit l: whether lane l completes a triangle. */
    std::vector<std::uint8_t> masks;

    /** Cells of the triangles, ordered as offsets; empty if none yields. */
    AlignedArray<std::uint32_t> lane_cells;

    /**
     * Half the thickness times the initial stress, per step its mean, half
     * its difference and its shear component, each in all lanes.
     */
    AlignedArray<double> lane_stress;
  };
} // namespace quoin

#endif
