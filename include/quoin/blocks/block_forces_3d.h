// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_block_forces_3d_h
#define quoin_blocks_block_forces_3d_h

#include <quoin/blocks/block_forces.h>

namespace quoin
{
  struct TetrahedronCluster;

  /**
   * Internal forces of blocks of tetrahedra (tetrahedron.h has the element)
   * that undergo any rotation, linear elastic or elastoplastic; otherwise as
   * BlockForces<2>.
   *
   * The cells of a tile are taken in chunks of few nodes, which are copied to
   * the first level cache before and added to the forces after. In a chunk
   * they are paired across common faces, so that two cells load five nodes
   * instead of eight; those that are left over come one by one. Lane l takes
   * the l-th part of a chunk, so that cells that are computed together have no
   * nodes in common; it takes the parts of a mixed tetrahedron one after the
   * other. Geometry is computed from the positions in each step:
   * that is cheaper than to read it from memory. Cells that yield come one by
   * one after them.
   */
  template <>
  class BlockForces<3> : public ForceOperator<3>
  {
  public:
    void prepare(const BlockForcesData<3> &data,
                 const BlockForcesOptions &options = BlockForcesOptions());

    const char *kind() const override
    {
      return "blocks";
    }
    void prepare(State<3> &state) const override;
    void add_forces(const StepContext &step, State<3> &state,
                    const NodeForces<3> &forces) override;
    void add_stored_energy(const State<3> &state,
                           EnergyAccounts &energies) const override;
    bool is_internal() const override
    {
      return true;
    }

    void linearise(State<3> &state, bool with_stiffness,
                   const TakeElement<3> &take) const override;

    /** Adds the bound of linear cells. */
    void add_stiffness_bound(
        const State<3> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<3>> &stiffness) const override;

    const BlockForcesData<3> &cell_data() const
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

    /** Adds the internal forces of a tile's cells. Updates @p history for the
        current positions and returns the energy that this dissipates [J]. */
    double add_forces(unsigned int tile, const NodeRecord<3> *nodes,
                      PlasticHistory &history,
                      dealii::Tensor<1, 3> *force) const;

    /** strain_energy() of cell_states.h [J]. */
    double strain_energy(const NodeRecord<3> *nodes,
                         const PlasticHistory &history) const;

    /**
     * Adds the forces of stiffness-proportional damping, cell by cell: those
     * of the stress @p beta [s] times the stiffness times dU/dt. Linear in
     * @p velocity, zero for rigid motion, without moment, never doing positive
     * work.
     */
    void add_viscous_forces(unsigned int tile, const NodeRecord<3> *nodes,
                            const dealii::Tensor<1, 3> *velocity, double beta,
                            dealii::Tensor<1, 3> *force) const;

    /** Updates @p history as add_forces() does and returns the dissipation [J].
     */
    double update(const NodeRecord<3> *nodes, PlasticHistory &history) const;

  private:
    /** Cells that go through the lanes together, or two of each lane. */
    struct Groups
    {
      std::size_t n            = 0;
      std::size_t first_offset = 0; /**< index into offsets */
      std::size_t first_stress = 0; /**< index into lane_stress */
      unsigned int last_mask   = 0; /**< lanes that have a cell in the last
                                       group, or the last four pairs of mixed
                                       tetrahedra */
    };

    /** Cells of equal stiffness whose nodes are copied together. */
    struct Chunk
    {
      std::size_t first_node; /**< index into chunk_nodes */
      std::size_t n_nodes;
      unsigned int stiffness; /**< index of the stiffness */
      Groups pairs;
      Groups singles;
    };

    struct Tile
    {
      NodeRange nodes;
      NodeRange cells;
      std::size_t begin_chunk;
      std::size_t end_chunk;
      std::size_t begin_plastic; /**< index into plastic_cells */
      std::size_t end_plastic;
    };

    /** Cuts cells of equal stiffness into chunks. */
    void append_chunks(const std::vector<unsigned int> &members,
                       unsigned int stiffness, std::size_t max_cells);

    /** One chunk of the cells [begin, end), whose nodes are the last of
        chunk_nodes. */
    void append_chunk(const unsigned int *begin, const unsigned int *end,
                      std::size_t first_node, unsigned int stiffness);

    /** Groups of @p clusters of @p n_cells cells, whose nodes and cells are
        numbered within the chunk of the cells from @p begin on. A lane takes
        @p joined ones that follow one another. */
    Groups append_groups(const std::vector<TetrahedronCluster> &clusters,
                         unsigned int n_cells, unsigned int joined,
                         const unsigned int *begin);

    /** Calls @p act(chunk, copies of its nodes, without a force) for the
        chunks of a tile. */
    template <typename Do>
    void for_chunks_of(const Tile &tile, const NodeRecord<3> *nodes,
                       const Do &act) const;

    /** Calls a function of tetrahedron_kernel.h for groups of a chunk. */
    template <typename Kernel, typename Nodes>
    auto apply(const Kernel kernel, const Chunk &chunk, const Groups &groups,
               Nodes &nodes) const
    {
      using Result
          = decltype(kernel(nullptr, 0, 0, data.stiffness[0], nullptr, nodes));
      return groups.n == 0
                 ? Result()
                 : kernel(&offsets[groups.first_offset], groups.n,
                          groups.last_mask, data.stiffness[chunk.stiffness],
                          lane_stress.empty()
                              ? nullptr
                              : &lane_stress[groups.first_stress],
                          nodes);
    }

    template <int lanes>
    void add_forces_in_lanes(const Tile &tile, const NodeRecord<3> *nodes,
                             dealii::Tensor<1, 3> *force) const;

    template <int lanes>
    double energy_in_lanes(const Tile &tile, const NodeRecord<3> *nodes) const;

    BlockForcesData<3> data;
    unsigned int n_lanes = 0;
    std::vector<Tile> tiles;
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> chunk_nodes;
    std::vector<unsigned int> plastic_cells; /**< cells with a yield law */

    /** Nodes of each group, each in all lanes, in bytes into the chunk's
        forces. */
    AlignedArray<std::uint16_t> offsets;

    /** -1/6 of the initial stress, per cell of a group its six components in
        all lanes. */
    AlignedArray<double> lane_stress;
  };
} // namespace quoin

#endif
