// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/node_exchange.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <vector>

using namespace quoin;

namespace
{
  constexpr unsigned int n_each = 4;

  struct Entry
  {
    unsigned int global;
    double value;
  };

  Entry entry_of(const unsigned int global)
  {
    return { global, 0.5 * global };
  }
} // namespace

// On any number of ranks: each owns four nodes and mirrors the second and the
// last of all others.
TEST(NodeExchange, GhostsAreTheNodesOfTheirOwners)
{
  const MPI_Comm world       = MPI_COMM_WORLD;
  const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(world);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(world);
  std::vector<unsigned int> ghosts;
  for (unsigned int r = 0; r < n_ranks; ++r)
    if (r != rank)
      for (const unsigned int k : { 1U, 3U })
        ghosts.push_back(n_each * r + k);
  const NodeExchange exchange(n_each * rank, n_each * (rank + 1),
                              n_each * n_ranks, ghosts, world);
  ASSERT_EQ(exchange.n_owned(), n_each);
  ASSERT_EQ(exchange.n_local(), n_each + ghosts.size());

  std::vector<Entry> values(exchange.n_local(), Entry{ 0, -1. });
  for (unsigned int i = 0; i < n_each; ++i)
    values[i] = entry_of(exchange.global(i));
  exchange.update_ghosts(values.data());
  for (unsigned int i = 0; i < exchange.n_local(); ++i)
  {
    EXPECT_EQ(values[i].global, exchange.global(i));
    EXPECT_EQ(values[i].value, 0.5 * exchange.global(i));
    EXPECT_EQ(exchange.local(exchange.global(i)), i);
    EXPECT_EQ(exchange.owns(exchange.global(i)), i < n_each);
  }

  // the same owners, other ghosts, in an array of their own
  const unsigned int next  = n_each * ((rank + 1) % n_ranks);
  const bool is_alone      = n_ranks == 1;
  const NodeExchange other = exchange.with_partners(
      is_alone ? std::vector<unsigned int>{}
               : std::vector<unsigned int>{ next + 2 });
  std::vector<Entry> mirrored(is_alone ? 0 : 1, Entry{ 0, -1. });
  other.update_ghosts(values.data(), mirrored.data());
  for (const Entry &entry : mirrored)
  {
    EXPECT_EQ(entry.global, next + 2);
    EXPECT_EQ(entry.value, 0.5 * (next + 2));
  }
}
