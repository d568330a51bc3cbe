// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/partition.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <numeric>

namespace quoin
{
  namespace
  {
    /** What a step takes, in cells: a side of a joint face, a rigid block. */
    constexpr unsigned int joint_cost = 8, rigid_block_cost = 10;

    /** By how much the fullest rank may exceed the mean. */
    constexpr double whole_block_imbalance = 1.1;

    /** Large blocks are divided into this many pieces for each rank. */
    constexpr unsigned int pieces_per_rank = 500;

    /** Largest unit first, each to the rank with the least cost so far. */
    std::vector<unsigned int> deal_out(const std::vector<unsigned int> &cost,
                                       const unsigned int n_ranks)
    {
      std::vector<unsigned int> order(cost.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(),
                       [&](const unsigned int a, const unsigned int b)
                       { return cost[a] > cost[b]; });
      std::vector<unsigned int> rank(cost.size());
      std::vector<double> load(n_ranks, 0.);
      for (const unsigned int unit : order)
      {
        rank[unit] = std::min_element(load.begin(), load.end()) - load.begin();
        load[rank[unit]] += cost[unit];
      }
      return rank;
    }

    /** Load of the fullest rank by the mean load. */
    double imbalance(const std::vector<unsigned int> &rank,
                     const std::vector<unsigned int> &cost,
                     const unsigned int n_ranks)
    {
      std::vector<double> load(n_ranks, 0.);
      for (unsigned int unit = 0; unit < rank.size(); ++unit)
        load[rank[unit]] += cost[unit];
      return *std::max_element(load.begin(), load.end()) * n_ranks
             / std::accumulate(load.begin(), load.end(), 0.);
    }

    /** Units that go to ranks as wholes: blocks, or pieces of them. */
    template <int dim>
    class UnitGraph
    {
    public:
      UnitGraph(const BlockMesh<dim> &mesh, const std::vector<bool> &is_rigid,
                const std::vector<unsigned int> &unit_of_cell)
        : mesh(mesh), unit_of_cell(unit_of_cell),
          cost(unit_of_cell.empty() ? 0 : unit_of_cell.back() + 1, 0)
      {
        for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
          for (unsigned int c = mesh.block_first_cell[b];
               c < mesh.block_first_cell[b + 1]; ++c)
            cost[unit_of_cell[c]] += !is_rigid[b] ? 1
                                     : c == mesh.block_first_cell[b]
                                         ? rigid_block_cost
                                         : 0;
        for (const JointFace<dim> &face : mesh.joint_faces)
          for (const unsigned int c : face.cells)
            cost[unit_of_cell[c]] += joint_cost;
      }

      /** Rank of each unit. */
      std::vector<unsigned int> divide(const unsigned int n_ranks) const
      {
        const std::vector<unsigned int> by_size = deal_out(cost, n_ranks);
        const unsigned int n                    = cost.size();
        if (n <= n_ranks)
          return by_size;
        dealii::DynamicSparsityPattern graph(n, n);
        const auto connect = [&](const unsigned int a, const unsigned int b)
        {
          graph.add(a, b);
          graph.add(b, a);
        };
        for (unsigned int unit = 0; unit < n; ++unit)
          graph.add(unit, unit);
        for (const JointFace<dim> &face : mesh.joint_faces)
          connect(unit_of_cell[face.cells[0]], unit_of_cell[face.cells[1]]);
        // Pieces of a block share vertices.
        constexpr unsigned int none = -1;
        std::vector<unsigned int> unit_of_vertex(mesh.n_vertices(), none);
        for (unsigned int c = 0; c < mesh.n_cells(); ++c)
          for (const unsigned int v : mesh.cells[c])
          {
            if (unit_of_vertex[v] != none
                && unit_of_vertex[v] != unit_of_cell[c])
              connect(unit_of_vertex[v], unit_of_cell[c]);
            unit_of_vertex[v] = unit_of_cell[c];
          }
        dealii::SparsityPattern pattern;
        pattern.copy_from(graph);
        std::vector<unsigned int> rank(n);
        dealii::SparsityTools::partition(pattern, cost, n_ranks, rank);
        // With few units of very different size METIS may fail to balance.
        return imbalance(rank, cost, n_ranks)
                       <= whole_block_imbalance
                              * imbalance(by_size, cost, n_ranks)
                   ? rank
                   : by_size;
      }

      double imbalance_of(const std::vector<unsigned int> &rank,
                          const unsigned int n_ranks) const
      {
        return imbalance(rank, cost, n_ranks);
      }

    private:
      const BlockMesh<dim> &mesh;
      const std::vector<unsigned int> &unit_of_cell;
      std::vector<unsigned int> cost;
    };
  } // namespace

  template <int dim>
  std::vector<unsigned int> partition_cells(const BlockMesh<dim> &mesh,
                                            const std::vector<bool> &is_rigid,
                                            const unsigned int n_ranks)
  {
    std::vector<unsigned int> rank_of_cell(mesh.n_cells(), 0);
    if (n_ranks == 1)
      return rank_of_cell;

    // Whole blocks; if they do not balance, large ones in pieces of consecutive
    // cells, which the numbering keeps near one another.
    const unsigned int joined = mesh.n_joined_cells();
    const unsigned int largest_piece
        = joined
          * std::max<unsigned int>(
              1, mesh.n_cells() / (joined * pieces_per_rank * n_ranks));
    for (const bool in_pieces : { false, true })
    {
      std::vector<unsigned int> unit_of_cell(mesh.n_cells());
      unsigned int n_units = 0;
      for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
      {
        const unsigned int begin = mesh.block_first_cell[b];
        const unsigned int end   = mesh.block_first_cell[b + 1];
        const bool is_cut        = in_pieces && !is_rigid[b]
                            && (end - begin) * n_ranks > mesh.n_cells() / 2;
        for (unsigned int c = begin; c < end; ++c)
          unit_of_cell[c]
              = n_units + (is_cut ? (c - begin) / largest_piece : 0);
        n_units = unit_of_cell[end - 1] + 1;
      }
      const UnitGraph<dim> graph(mesh, is_rigid, unit_of_cell);
      const auto rank = graph.divide(n_ranks);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        rank_of_cell[c] = rank[unit_of_cell[c]];
      if (graph.imbalance_of(rank, n_ranks) <= whole_block_imbalance)
        break;
    }
    return rank_of_cell;
  }

  template std::vector<unsigned int> partition_cells(const BlockMesh<2> &,
                                                     const std::vector<bool> &,
                                                     unsigned int);
  template std::vector<unsigned int> partition_cells(const BlockMesh<3> &,
                                                     const std::vector<bool> &,
                                                     unsigned int);
} // namespace quoin
