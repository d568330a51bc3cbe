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
  } // namespace

  NodeExchange::NodeExchange(const unsigned int first, const unsigned int last,
                             const unsigned int n_global,
                             const std::vector<unsigned int> &ghosts,
                             const MPI_Comm communicator)
    : partitioner(range(first, last, n_global), indices(ghosts, n_global),
                  communicator)
  {
  }

  NodeExchange
  NodeExchange::with_ghosts(const std::vector<unsigned int> &ghosts) const
  {
    const auto [first, last] = partitioner.local_range();
    return NodeExchange(first, last, partitioner.size(), ghosts,
                        communicator());
  }
} // namespace quoin
