// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/block_elements/cell_tangent.h>
#include <quoin/block_elements/mixed_cells.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/blocks/tetrahedron_pairs.h>

#include <algorithm>
#include <limits>

#include "tetrahedron_kernel.h"

namespace quoin
{
  namespace
  {
    /** Motion of a cell and its rate of strain in the rotating frame. */
    struct CellRate
    {
      CellMotion motion;
      SpaceStrain strain;
      SpaceTensor U; /**< dU/dt [1/s] */
    };

    CellRate cell_rate(const BlockForcesData<3> &data, const std::size_t cell,
                       const NodeRecord<3> *nodes,
                       const dealii::Tensor<1, 3> *velocity)
    {
      CellRate result;
      result.motion = cell_motion(data, nodes, cell);
      result.strain = SpaceStrain(result.motion.H);
      const auto &R = result.strain.R;
      const auto &n = data.cells[cell];
      double d[3][3], L[3][3], A[3][3];
      for (unsigned int q = 0; q < 3; ++q)
        for (unsigned int i = 0; i < 3; ++i)
          d[q][i] = velocity[n[q + 1]][i] - velocity[n[0]][i];
      result.motion.geometry.gradient(d, L);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          A[r][c] = R[0][r] * L[0][c] + R[1][r] * L[1][c] + R[2][r] * L[2][c];
      result.U = PolarRate(result.strain, A).U;
      return result;
    }
  } // namespace

  void BlockForces<3>::prepare(const BlockForcesData<3> &new_data,
                               const BlockForcesOptions &options)
  {
    data    = new_data;
    n_lanes = options.n_lanes == 0 ? native_lanes : options.n_lanes;
    tiles.clear();
    chunks.clear();
    chunk_nodes.clear();
    plastic_cells.clear();
    offsets.clear();
    lane_stress.clear();

    const auto &first_node = data.block_first_node;
    const auto &first_cell = data.block_first_cell;
    // Node record, velocity, force, inverse mass.
    constexpr std::size_t node_bytes = sizeof(NodeRecord<3>)
                                       + 2 * sizeof(dealii::Tensor<1, 3>)
                                       + sizeof(double);
    for (std::size_t begin = 0; begin + 1 < first_node.size();)
    {
      std::size_t end = begin + 1;
      while (end + 1 < first_node.size()
             && (first_node[end + 1] - first_node[begin]) * node_bytes
                    <= options.tile_bytes)
        ++end;
      const std::size_t begin_chunk   = chunks.size();
      const std::size_t begin_plastic = plastic_cells.size();
      std::vector<std::vector<unsigned int>> members(data.stiffness.size());
      for (unsigned int cell = first_cell[begin]; cell < first_cell[end];
           ++cell)
        members[data.cell_stiffness.empty() ? 0 : data.cell_stiffness[cell]]
            .push_back(cell);
      for (unsigned int s = 0; s < members.size(); ++s)
        if (data.law(s))
          plastic_cells.insert(plastic_cells.end(), members[s].begin(),
                               members[s].end());
        else
          append_chunks(members[s], s, options.max_run_cells);
      tiles.push_back({ { first_node[begin], first_node[end] },
                        { first_cell[begin], first_cell[end] },
                        begin_chunk,
                        chunks.size(),
                        begin_plastic,
                        plastic_cells.size() });
      begin = end;
    }
  }

  void BlockForces<3>::append_chunks(const std::vector<unsigned int> &members,
                                     const unsigned int stiffness,
                                     const std::size_t max_cells)
  {
    const unsigned int *const last = members.data() + members.size();
    const unsigned int joined      = data.n_joined_cells();
    for (const unsigned int *begin = members.data(); begin != last;)
    {
      const std::size_t first_node = chunk_nodes.size();
      const unsigned int *end      = begin;
      for (; end != last && std::size_t(end - begin) < max_cells; end += joined)
      {
        std::vector<std::uint32_t> more;
        const auto is_new = [&](const std::uint32_t node)
        {
          const auto old = chunk_nodes.begin() + first_node;
          return std::find(old, chunk_nodes.end(), node) == chunk_nodes.end()
                 && std::find(more.begin(), more.end(), node) == more.end();
        };
        for (unsigned int part = 0; part < joined; ++part)
          for (const unsigned int node : data.cells[end[part]])
            if (is_new(node))
              more.push_back(node);
        if (chunk_nodes.size() - first_node + more.size()
            > ChunkNodes::max_size)
          break;
        chunk_nodes.insert(chunk_nodes.end(), more.begin(), more.end());
      }
      append_chunk(begin, end, first_node, stiffness);
      begin = end;
    }
  }

  void BlockForces<3>::append_chunk(const unsigned int *begin,
                                    const unsigned int *end,
                                    const std::size_t first_node,
                                    const unsigned int stiffness)
  {
    const auto first = chunk_nodes.begin() + first_node;
    std::sort(first, chunk_nodes.end());
    std::vector<std::array<unsigned int, 4>> cells;
    for (const unsigned int *cell = begin; cell != end; ++cell)
    {
      cells.emplace_back();
      for (unsigned int i = 0; i < 4; ++i)
        cells.back()[i]
            = std::lower_bound(first, chunk_nodes.end(), data.cells[*cell][i])
              - first;
    }
    const TetrahedronPairs found
        = pair_tetrahedra(cells, data.mixed ? parts_of_mixed : cells.size());
    // Each part at a corner has one neighbour among the parts of a mixed
    // tetrahedron, another one for each.
    AssertThrow(!data.mixed || found.singles.empty(),
                dealii::ExcInternalError());
    Chunk chunk{
      first_node, chunk_nodes.size() - first_node, stiffness, {}, {}
    };
    const unsigned int joined = data.mixed ? parts_of_mixed / 2 : 1;
    chunk.pairs               = append_groups(found.pairs, 2, joined, begin);
    chunk.singles             = append_groups(found.singles, 1, 1, begin);
    chunks.push_back(chunk);
  }

  BlockForces<3>::Groups
  BlockForces<3>::append_groups(const std::vector<TetrahedronCluster> &clusters,
                                const unsigned int n_cells,
                                const unsigned int joined,
                                const unsigned int *const begin)
  {
    const unsigned int n_nodes = 3 + n_cells;
    const std::size_t n_units  = clusters.size() / joined;
    const std::size_t n_rounds = (n_units + n_lanes - 1) / n_lanes;
    Groups groups;
    groups.n            = n_rounds * joined;
    groups.first_offset = offsets.size();
    groups.first_stress = lane_stress.size();
    offsets.resize(groups.first_offset + groups.n * n_nodes * n_lanes);
    if (!data.initial_stress.empty())
      lane_stress.resize(groups.first_stress + groups.n * n_cells * 6 * n_lanes,
                         0.);
    for (std::size_t lane = 0; lane < n_lanes; ++lane)
    {
      const std::size_t lane_begin = n_units * lane / n_lanes;
      const std::size_t lane_end   = n_units * (lane + 1) / n_lanes;
      for (std::size_t g = 0; g < groups.n; ++g)
      {
        // Pieces have the same length or end one round earlier.
        const std::size_t round = g / joined;
        const bool present      = lane_begin + round < lane_end;
        if (present && round + 1 == n_rounds)
          groups.last_mask |= 1u << lane;
        const std::size_t unit = present ? lane_begin + round : n_units - 1;
        const TetrahedronCluster &cluster
            = clusters[joined * unit + g % joined];
        for (unsigned int k = 0; k < n_nodes; ++k)
          offsets[groups.first_offset + (n_nodes * g + k) * n_lanes + lane]
              = sizeof(ChunkNodes::Row) * cluster.nodes[k];
        if (present && !data.initial_stress.empty())
          for (unsigned int c = 0; c < n_cells; ++c)
            for (unsigned int i = 0; i < 6; ++i)
              lane_stress[groups.first_stress
                          + (6 * (n_cells * g + c) + i) * n_lanes + lane]
                  = -data.initial_stress[begin[cluster.cells[c]]][i] / 6.;
      }
    }
    return groups;
  }

  template <typename Do>
  void BlockForces<3>::for_chunks_of(const Tile &tile,
                                     const NodeRecord<3> *nodes,
                                     const Do &act) const
  {
    ChunkNodes copies;
    for (std::size_t c = tile.begin_chunk; c < tile.end_chunk; ++c)
    {
      const Chunk &chunk         = chunks[c];
      const std::uint32_t *names = &chunk_nodes[chunk.first_node];
      copies.load(names, chunk.n_nodes, nodes);
      act(chunk, copies);
    }
  }

  template <int lanes>
  void BlockForces<3>::add_forces_in_lanes(const Tile &tile,
                                           const NodeRecord<3> *nodes,
                                           dealii::Tensor<1, 3> *force) const
  {
    using Add              = decltype(&add_mixed_tetrahedra<lanes, true>);
    const bool with_stress = !lane_stress.empty();
    const Add add_mixed    = with_stress ? add_mixed_tetrahedra<lanes, true>
                                         : add_mixed_tetrahedra<lanes, false>;
    const Add add_pairs    = with_stress ? add_tetrahedra<lanes, true, 2>
                                         : add_tetrahedra<lanes, false, 2>;
    const Add add_singles  = with_stress ? add_tetrahedra<lanes, true, 1>
                                         : add_tetrahedra<lanes, false, 1>;
    for_chunks_of(tile, nodes,
                  [&](const Chunk &chunk, ChunkNodes &copies)
                  {
                    apply(data.mixed ? add_mixed : add_pairs, chunk,
                          chunk.pairs, copies);
                    apply(add_singles, chunk, chunk.singles, copies);
                    copies.add_forces(&chunk_nodes[chunk.first_node],
                                      chunk.n_nodes, force);
                  });
  }

  template <int lanes>
  double BlockForces<3>::energy_in_lanes(const Tile &tile,
                                         const NodeRecord<3> *nodes) const
  {
    using Energy           = decltype(&energy_of_mixed_tetrahedra<lanes, true>);
    const bool with_stress = !lane_stress.empty();
    const Energy of_mixed  = with_stress
                                 ? energy_of_mixed_tetrahedra<lanes, true>
                                 : energy_of_mixed_tetrahedra<lanes, false>;
    const Energy of_pairs  = with_stress ? energy_of_tetrahedra<lanes, true, 2>
                                         : energy_of_tetrahedra<lanes, false, 2>;
    const Energy of_singles = with_stress
                                  ? energy_of_tetrahedra<lanes, true, 1>
                                  : energy_of_tetrahedra<lanes, false, 1>;
    double energy           = 0.;
    for_chunks_of(tile, nodes,
                  [&](const Chunk &chunk, const ChunkNodes &copies)
                  {
                    energy += apply(data.mixed ? of_mixed : of_pairs, chunk,
                                    chunk.pairs, copies)
                              + apply(of_singles, chunk, chunk.singles, copies);
                  });
    return energy;
  }

  double BlockForces<3>::add_forces(const unsigned int tile,
                                    const NodeRecord<3> *nodes,
                                    PlasticHistory &history,
                                    dealii::Tensor<1, 3> *force) const
  {
    if (n_lanes == 8)
      add_forces_in_lanes<8>(tiles[tile], nodes, force);
    else
      add_forces_in_lanes<4>(tiles[tile], nodes, force);
    double dissipated = 0.;
    const auto add    = data.mixed ? add_mixed_forces : add_plastic_forces;
    for (std::size_t k = tiles[tile].begin_plastic; k < tiles[tile].end_plastic;
         k += data.n_joined_cells())
      dissipated += add(data, plastic_cells[k], nodes, history, force);
    return dissipated;
  }

  double BlockForces<3>::strain_energy(const NodeRecord<3> *nodes,
                                       const PlasticHistory &history) const
  {
    double energy = 0.;
    for (const Tile &tile : tiles)
    {
      energy += n_lanes == 8 ? energy_in_lanes<8>(tile, nodes)
                             : energy_in_lanes<4>(tile, nodes);
      for (std::size_t k = tile.begin_plastic; k < tile.end_plastic;
           k += data.n_joined_cells())
        energy += cell_energy(data, nodes, history, plastic_cells[k]);
    }
    return energy;
  }

  void BlockForces<3>::add_stiffness_bound(
      const State<3> &state, const NodeRatio &,
      std::vector<NodeStiffness<3>> &stiffness) const
  {
    const auto *plastic = state.find<PlasticHistory>();
    for (unsigned int c = 0; c < data.cells.size(); ++c)
    {
      const auto &nodes = data.cells[c];
      double edges[3][3];
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int d = 0; d < 3; ++d)
          edges[k][d]
              = state.nodes[nodes[k + 1]].X[d] - state.nodes[nodes[0]].X[d];
      Tetrahedron<OneLane> cell;
      cell.set_edges(edges);
      if (plastic && data.law_of(c))
        cell.flow(plastic->space_cells[c].inverse_stretch);
      // With a quarter of its mass at each node; the density cancels out.
      const double share
          = largest_eigenvalue_squared_frequency(cell, data.stiffness_of(c), 1.)
            * cell.det / 24.;
      for (const unsigned int node : nodes)
        for (unsigned int d = 0; d < 3; ++d)
          stiffness[node][d] += share;
    }
  }

  void BlockForces<3>::add_viscous_forces(const unsigned int tile,
                                          const NodeRecord<3> *nodes,
                                          const dealii::Tensor<1, 3> *velocity,
                                          const double beta,
                                          dealii::Tensor<1, 3> *force) const
  {
    const unsigned int joined = data.n_joined_cells();
    OfMixed<CellRate> cells;
    for (std::size_t first = tiles[tile].cells.begin;
         first < tiles[tile].cells.end; first += joined)
    {
      double volume = 0., growth = 0.;
      for (unsigned int k = 0; k < joined; ++k)
      {
        cells[k] = cell_rate(data, first + k, nodes, velocity);
        volume += cells[k].motion.geometry.det;
        growth += cells[k].motion.geometry.det * trace(cells[k].U);
      }
      for (unsigned int k = 0; k < joined; ++k)
      {
        CellRate &cell = cells[k];
        if (data.mixed)
          add_trace(growth / volume - trace(cell.U), cell.U);
        SpaceTensor s = elastic_stress(data.stiffness_of(first), cell.U);
        for (double &component : s)
          component *= beta;
        double T[3][3];
        cell.strain.turning_stress(s, T);
        add_cell_forces(data, first + k, cell.motion.geometry, cell.strain.R, T,
                        force);
      }
    }
  }

  void BlockForces<3>::linearise(State<3> &state, const bool with_stiffness,
                                 const TakeElement<3> &take) const
  {
    PlasticHistory &history = state.get<PlasticHistory>();
    const auto give         = [&](const auto &cell)
    {
      state.energy.plastic += cell.dissipated;
      take({ cell.nodes.data(), cell.n_nodes, cell.force.data(),
             cell.stiffness[0].data(), unsigned(cell.force.size()) });
    };
    CellLinearisation cell;
    MixedLinearisation tetrahedron;
    for (unsigned int c = 0; c < data.cells.size(); c += data.n_joined_cells())
      if (data.mixed)
      {
        linearise_mixed(data, c, state.nodes.data(), history, tetrahedron,
                        with_stiffness);
        give(tetrahedron);
      }
      else
      {
        linearise_cell(data, c, state.nodes.data(), history, cell,
                       with_stiffness);
        give(cell);
      }
  }

  void BlockForces<3>::prepare(State<3> &state) const
  {
    if (!state.find<PlasticHistory>())
      state.add<PlasticHistory>() = initial_history(*this);
  }

  void BlockForces<3>::add_stored_energy(const State<3> &state,
                                         EnergyAccounts &energies) const
  {
    energies.strain
        += strain_energy(state.nodes.data(), state.get<PlasticHistory>());
  }

  void BlockForces<3>::add_forces(const StepContext &step, State<3> &state,
                                  const NodeForces<3> &forces)
  {
    for (unsigned int tile = 0; tile < n_tiles(); ++tile)
    {
      state.energy.plastic += add_forces(
          tile, state.nodes.data(), state.get<PlasticHistory>(), forces.force);
      if (forces.viscous)
        add_viscous_forces(tile, state.nodes.data(), state.velocity.data(),
                           step.stiffness_damping, forces.viscous);
    }
  }

  double BlockForces<3>::update(const NodeRecord<3> *nodes,
                                PlasticHistory &history) const
  {
    double dissipated = 0.;
    if (data.mixed)
    {
      for (std::size_t i = 0; i < plastic_cells.size(); i += parts_of_mixed)
        dissipated += update_mixed(data, plastic_cells[i], nodes, history);
      return dissipated;
    }
    for (const unsigned int k : plastic_cells)
    {
      const CellMotion motion = cell_motion(data, nodes, k);
      const SpaceStrain strain
          = elastic_strain(motion.H, history.space_cells[k].inverse_stretch);
      SpacePlasticPoint point = space_plastic_point(history, k);
      const double lost       = data.law_of(k)
                              ->update(point, strain, data.initial_stress_of(k))
                              .dissipated;
      set_plastic_point(point, k, history);
      dissipated += motion.geometry.det / 6. * lost;
    }
    return dissipated;
  }
} // namespace quoin
