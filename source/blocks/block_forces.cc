// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/block_elements/cell_strain.h>
#include <quoin/block_elements/cell_tangent.h>
#include <quoin/blocks/cell_states.h>

#include <algorithm>
#include <limits>
#include <string>

#include "plastic_strip_kernel.h"

namespace quoin
{
  namespace
  {
    /** A run starts with two nodes per lane and then takes steps by three. */
    std::size_t padded_steps(const std::size_t n)
    {
      return 2 + 3 * ((std::max<std::size_t>(n, 3) - 2 + 2) / 3);
    }
  } // namespace

  void BlockForces<2>::prepare(const BlockForcesData<2> &new_data,
                               const BlockForcesOptions &options)
  {
    data    = new_data;
    n_lanes = options.n_lanes == 0 ? native_lanes : options.n_lanes;

    runs.clear();
    offsets.clear();
    masks.clear();
    lane_stress.clear();
    lane_cells.clear();
    node_groups.clear();
    make_tiles(options.tile_bytes);
    for (Tile &tile : tiles)
      make_runs(tile, options.max_run_cells);
  }

  void BlockForces<2>::add_stiffness_bound(
      const State<2> &state, const NodeRatio &,
      std::vector<NodeStiffness<2>> &stiffness) const
  {
    constexpr unsigned int dim = 2;
    const auto *plastic        = state.find<PlasticHistory>();
    for (unsigned int c = 0; c < data.cells.size(); ++c)
    {
      const auto &[i, j, k] = data.cells[c];
      Triangle cell(state.nodes[i], state.nodes[j], state.nodes[k]);
      if (plastic && data.law_of(c))
        cell.flow(plastic->cells[c].inverse_stretch);
      // With a third of its mass at each node; the density cancels out.
      const double share
          = largest_eigenvalue_squared_frequency(cell, data.stiffness_of(c), 1.)
            * cell.area() * data.thickness_of(c) / 3.;
      for (const unsigned int node : data.cells[c])
        for (unsigned int d = 0; d < dim; ++d)
          stiffness[node][d] += share;
    }
  }

  void BlockForces<2>::make_tiles(const std::size_t tile_bytes)
  {
    // Node record, velocity, force, inverse mass.
    constexpr std::size_t node_bytes = sizeof(NodeRecord<2>)
                                       + 2 * sizeof(dealii::Tensor<1, 2>)
                                       + sizeof(double);

    const auto &first_node = data.block_first_node;
    const auto &first_cell = data.block_first_cell;
    tiles.clear();
    for (std::size_t begin = 0; begin + 1 < first_node.size();)
    {
      std::size_t end = begin + 1;
      while (end + 1 < first_node.size()
             && (first_node[end + 1] - first_node[begin]) * node_bytes
                    <= tile_bytes)
        ++end;
      tiles.push_back({ { first_node[begin], first_node[end] },
                        { first_cell[begin], first_cell[end] },
                        0,
                        0 });
      begin = end;
    }
    for (const Tile &tile : tiles)
      if (tile.nodes.end - tile.nodes.begin
          > std::numeric_limits<std::uint32_t>::max()
                / sizeof(dealii::Tensor<1, 2>))
        throw InputError(
            "A block has " + std::to_string(tile.nodes.end - tile.nodes.begin)
            + " nodes, more than 268 million: refine the mesh less "
              "or cut the block.");
  }

  void BlockForces<2>::make_runs(Tile &tile, const std::size_t max_run_cells)
  {
    tile.begin_run = runs.size();
    std::vector<std::vector<unsigned int>> members(data.stiffness.size());
    const auto finish = [&](const unsigned int s)
    {
      if (!members[s].empty())
        append_run(make_strips(data.cells, members[s], nullptr), tile, s);
      members[s].clear();
    };
    for (std::size_t cell = tile.cells.begin; cell < tile.cells.end; ++cell)
    {
      const unsigned int s
          = data.cell_stiffness.empty() ? 0 : data.cell_stiffness[cell];
      members[s].push_back(cell);
      if (members[s].size() >= max_run_cells)
        finish(s);
    }
    for (unsigned int s = 0; s < members.size(); ++s)
      finish(s);
    tile.end_run = runs.size();
  }

  void BlockForces<2>::append_run(const std::vector<StripEntry> &strips,
                                  const Tile &tile, const unsigned int s)
  {
    // Each lane takes an equal piece of the sequence, cutting strips, after the
    // two nodes before the piece: all lanes end together.
    const std::size_t end         = strips.size();
    const std::size_t piece       = (end + n_lanes - 1) / n_lanes;
    const std::size_t n           = padded_steps(piece + 2);
    const std::size_t first       = masks.size();
    const std::size_t first_group = node_groups.size();
    for (const StripEntry &entry : strips)
      node_groups.push_back(entry.node / 4);
    const auto groups = node_groups.begin() + first_group;
    std::sort(groups, node_groups.end());
    node_groups.erase(std::unique(groups, node_groups.end()),
                      node_groups.end());
    runs.push_back({ first, n, data.stiffness[s].bulk() * data.thickness[s],
                     data.stiffness[s].c33 * data.thickness[s], s, first_group,
                     node_groups.size() - first_group });

    // The kernel begins two steps more than it ends.
    const std::size_t n_rows = n + 2;
    offsets.resize((first + n_rows) * n_lanes);
    masks.resize(first + n_rows, 0);
    if (!data.initial_stress.empty())
      lane_stress.resize(3 * (first + n_rows) * n_lanes, 0.);
    // Two more are prefetched.
    if (data.is_plastic())
      lane_cells.resize((first + n_rows + 2) * n_lanes, tile.cells.begin);

    for (std::size_t lane = 0; lane < n_lanes; ++lane)
    {
      const std::size_t lane_begin = std::min(lane * piece, end);
      const std::size_t lane_end   = std::min(lane_begin + piece, end);
      for (std::size_t step = 0; step < n_rows; ++step)
      {
        // Before and after its piece a lane repeats the first and last entry.
        const std::size_t k = std::min(
            std::max<std::size_t>(lane_begin + step, 2) - 2, end - 1);
        const bool in_piece   = step >= 2 && lane_begin + step - 2 < lane_end;
        const std::size_t row = first + step;
        offsets[row * n_lanes + lane] = (strips[k].node - tile.nodes.begin)
                                        * sizeof(dealii::Tensor<1, 2>);
        if (!in_piece || strips[k].cell == StripEntry::no_cell)
          continue;
        masks[row] |= 1u << lane;
        if (data.is_plastic())
          lane_cells[row * n_lanes + lane] = strips[k].cell;
        if (!data.initial_stress.empty())
        {
          const auto &stress = data.initial_stress[strips[k].cell];
          double *to         = &lane_stress[3 * row * n_lanes + lane];
          const double half  = 0.5 * data.thickness[s];
          to[0]              = half * 0.5 * (stress[0] + stress[1]);
          to[n_lanes]        = half * 0.5 * (stress[0] - stress[1]);
          to[2 * n_lanes]    = half * stress[2];
        }
      }
    }
  }

  template <int lanes>
  double BlockForces<2>::add_forces_in_lanes(const Tile &tile,
                                             const NodeRecord<2> *nodes,
                                             PlasticHistory &history,
                                             dealii::Tensor<1, 2> *force) const
  {
    double dissipated     = 0.;
    std::uint8_t yielding = 0;
    if (data.is_plastic())
      for (std::size_t k = tile.cells.begin; k < tile.cells.end; ++k)
        yielding |= history.yielding[k]
            = MohrCoulomb::past(history.yielding[k]);
    for (std::size_t r = tile.begin_run; r < tile.end_run; ++r)
    {
      const Run &run  = runs[r];
      const Run &next = runs[r + 1 < runs.size() ? r + 1 : 0];
      Prefetcher prefetcher(nodes, force, &node_groups[next.first_group],
                            &node_groups[next.first_group] + next.n_groups,
                            run.n_steps / 3);
      StripSequence sequence{ &offsets[run.first_step * lanes],
                              &masks[run.first_step], run.n_steps };
      ScaledModuli moduli{ run.bulk, run.shear };
      const NodeRecord<2> *tile_records = nodes + tile.nodes.begin;
      dealii::Tensor<1, 2> *tile_force  = force + tile.nodes.begin;
      if (const MohrCoulomb *yields = data.law(run.stiffness))
      {
        const std::uint32_t *const cells = &lane_cells[run.first_step * lanes];
        const auto add                   = [&](const auto intact)
        {
          const PlasticStrips<lanes, decltype(intact)::value> strips(
              *yields, data.stiffness[run.stiffness],
              data.thickness[run.stiffness], cells,
              lane_stress.empty() ? nullptr : data.initial_stress.data(),
              history);
          dissipated += strips.add_forces(sequence, tile_records, tile_force,
                                          prefetcher);
        };
        // One cell is looked up after the other only in tiles that yield.
        const bool intact = yielding == 0
                            || std::none_of(cells, cells + run.n_steps * lanes,
                                            [&](const std::uint32_t c) {
                                              return history.yielding[c] != 0;
                                            });
        if (intact)
          add(std::true_type());
        else
          add(std::false_type());
      }
      else if (lane_stress.empty())
        elastic_strips<lanes, false>(sequence, moduli, nullptr, tile_records,
                                     tile_force, prefetcher);
      else
        elastic_strips<lanes, true>(sequence, moduli,
                                    &lane_stress[3 * run.first_step * lanes],
                                    tile_records, tile_force, prefetcher);
    }
    return dissipated;
  }

  template <int lanes>
  double BlockForces<2>::energy_in_lanes(const Tile &tile,
                                         const NodeRecord<2> *nodes) const
  {
    const auto energy_of = lane_stress.empty() ? energy_of_strips<lanes, false>
                                               : energy_of_strips<lanes, true>;
    double energy        = 0.;
    for (std::size_t r = tile.begin_run; r < tile.end_run; ++r)
    {
      const Run &run = runs[r];
      if (!data.law(run.stiffness))
        energy += energy_of({ &offsets[run.first_step * lanes],
                              &masks[run.first_step], run.n_steps },
                            { run.bulk, run.shear },
                            lane_stress.empty()
                                ? nullptr
                                : &lane_stress[3 * run.first_step * lanes],
                            nodes + tile.nodes.begin);
    }
    return energy;
  }

  template <int lanes>
  void BlockForces<2>::add_viscous_forces_in_lanes(
      const Tile &tile, const NodeRecord<2> *nodes,
      const dealii::Tensor<1, 2> *velocity, const double beta,
      dealii::Tensor<1, 2> *force) const
  {
    for (std::size_t r = tile.begin_run; r < tile.end_run; ++r)
    {
      const Run &run = runs[r];
      viscous_strips<lanes>(
          { &offsets[run.first_step * lanes], &masks[run.first_step],
            run.n_steps },
          { beta * run.bulk, beta * run.shear }, nodes + tile.nodes.begin,
          velocity + tile.nodes.begin, force + tile.nodes.begin);
    }
  }

  double BlockForces<2>::add_forces(const unsigned int tile,
                                    const NodeRecord<2> *nodes,
                                    PlasticHistory &history,
                                    dealii::Tensor<1, 2> *force) const
  {
    return n_lanes == 8
               ? add_forces_in_lanes<8>(tiles[tile], nodes, history, force)
               : add_forces_in_lanes<4>(tiles[tile], nodes, history, force);
  }

  void BlockForces<2>::add_viscous_forces(const unsigned int tile,
                                          const NodeRecord<2> *nodes,
                                          const dealii::Tensor<1, 2> *velocity,
                                          const double beta,
                                          dealii::Tensor<1, 2> *force) const
  {
    if (n_lanes == 8)
      add_viscous_forces_in_lanes<8>(tiles[tile], nodes, velocity, beta, force);
    else
      add_viscous_forces_in_lanes<4>(tiles[tile], nodes, velocity, beta, force);
  }

  void BlockForces<2>::prepare(State<2> &state) const
  {
    if (!state.find<PlasticHistory>())
      state.add<PlasticHistory>() = initial_history(*this);
  }

  void BlockForces<2>::add_stored_energy(const State<2> &state,
                                         EnergyAccounts &energies) const
  {
    energies.strain
        += strain_energy(state.nodes.data(), state.get<PlasticHistory>());
  }

  double BlockForces<2>::strain_energy(const NodeRecord<2> *nodes,
                                       const PlasticHistory &history) const
  {
    // Strips are of linear triangles.
    double energy = 0.;
    if (!data.quadratic)
      for (const Tile &tile : tiles)
        energy += n_lanes == 8 ? energy_in_lanes<8>(tile, nodes)
                               : energy_in_lanes<4>(tile, nodes);
    if (data.quadratic || data.is_plastic())
      for (std::size_t k = 0; k < data.cells.size(); ++k)
        if (data.quadratic || data.law_of(k))
          energy += cell_energy(data, nodes, history, k);
    return energy;
  }

  void BlockForces<2>::add_forces(const StepContext &step, State<2> &state,
                                  const NodeForces<2> &forces)
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

  double BlockForces<2>::update(const NodeRecord<2> *nodes,
                                PlasticHistory &history) const
  {
    double dissipated = 0.;
    if (!data.is_plastic())
      return dissipated;
    for (std::size_t k = 0; k < data.cells.size(); ++k)
      if (data.law_of(k))
      {
        double area;
        const auto gradient = cell_gradient(data, nodes, k, &area);
        const CorotatedStrain strain(
            stretched_gradient(gradient, history.cells[k].inverse_stretch));
        dissipated += data.thickness_of(k) * area
                      * update_cell(data, k, strain.e, history).dissipated;
      }
    return dissipated;
  }

  void BlockForces<2>::linearise(State<2> &state, const bool with_stiffness,
                                 const TakeElement<2> &take) const
  {
    CellLinearisation cell;
    PlasticHistory &history = state.get<PlasticHistory>();
    for (unsigned int c = 0; c < data.cells.size(); ++c)
    {
      if (!linearise_cell(data, c, state.nodes.data(), history, cell,
                          with_stiffness))
        continue;
      state.energy.plastic += cell.dissipated;
      take({ cell.nodes.data(), cell.n_nodes, cell.force.data(),
             cell.stiffness[0].data(), unsigned(cell.force.size()) });
    }
  }
} // namespace quoin
