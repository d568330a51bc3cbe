// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/node_exchange.h>

namespace quoin
{
  namespace
  {
    dealii::IndexSet range(const unsigned int first, const unsigned int last,
                           const unsigned int size)
    {
      dealii::IndexSet set(size);
      set.add_range(first, last);
      return set;
    }

    dealii::IndexSet indices(const std::vector<unsigned int> &entries,
                             const unsigned int size)
    {
      dealii::IndexSet set(size);
      set.add_indices(entries.begin(), entries.end());
      set.compress();
      return set;
    }

    std::vector<unsigned int> all_of(const std::vector<unsigned int> &a,
                                     const std::vector<unsigned int> &b)
    {
      std::vector<unsigned int> result(a);
      result.insert(result.end(), b.begin(), b.end());
      return result;
    }
  } // namespace

  NodeExchange::NodeExchange(const unsigned int first, const unsigned int last,
                             const unsigned int n_global,
                             const std::vector<unsigned int> &partner_nodes,
                             const MPI_Comm communicator)
    : NodeExchange(first, last, n_global, {}, partner_nodes, communicator)
  {
  }

  NodeExchange::NodeExchange(const unsigned int first, const unsigned int last,
                             const unsigned int n_global,
                             const std::vector<unsigned int> &shared,
                             const std::vector<unsigned int> &partner_nodes,
                             const MPI_Comm communicator)
    : partitioner(range(first, last, n_global),
                  indices(all_of(shared, partner_nodes), n_global),
                  communicator),
      shared_partitioner(range(first, last, n_global),
                         indices(shared, n_global), communicator)
  {
    for (const auto node : indices(partner_nodes, n_global))
      partners.push_back(node);
    // The partitioner's local numbers: owned nodes, then ghosts.
    for (const auto node : indices(shared, n_global))
      sources.push_back(partitioner.global_to_local(node));
    for (const unsigned int node : partners)
      sources.push_back(partitioner.global_to_local(node));
    for (unsigned int i = 0; i < sources.size(); ++i)
      if (sources[i] != n_owned() + i)
        return;
    sources.clear();
  }

  NodeExchange NodeExchange::with_partners(
      const std::vector<unsigned int> &partner_nodes) const
  {
    const auto [first, last] = partitioner.local_range();
    return NodeExchange(first, last, partitioner.size(), partner_nodes,
                        communicator());
  }
} // namespace quoin
