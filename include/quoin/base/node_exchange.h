// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_node_exchange_h
#define quoin_base_node_exchange_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <vector>

namespace quoin
{
  /**
   * Nodes of this rank: a contiguous range of global nodes that it owns,
   * numbered from 0, and after them ghosts, the joint partners that other
   * ranks own. Copies what the owners know to the ghosts.
   */
  class NodeExchange
  {
  public:
    /** Owns [first, last) of @p n_global nodes and mirrors @p ghosts. */
    NodeExchange(unsigned int first, unsigned int last, unsigned int n_global,
                 const std::vector<unsigned int> &ghosts,
                 MPI_Comm communicator);

    /** The same owned nodes with other @p ghosts; collective. */
    NodeExchange with_ghosts(const std::vector<unsigned int> &ghosts) const;

    unsigned int n_owned() const
    {
      return partitioner.locally_owned_size();
    }
    unsigned int n_local() const
    {
      return n_owned() + partitioner.n_ghost_indices();
    }
    bool owns(const unsigned int global) const
    {
      return partitioner.in_local_range(global);
    }
    /** Local number of an owned node or ghost. */
    unsigned int local(const unsigned int global) const
    {
      return partitioner.global_to_local(global);
    }
    unsigned int global(const unsigned int local) const
    {
      return partitioner.local_to_global(local);
    }
    MPI_Comm communicator() const
    {
      return partitioner.get_mpi_communicator();
    }

    /** Overwrites the ghost entries of @p values, n_local() long. */
    template <typename T>
    void update_ghosts(T *values) const
    {
      update_ghosts(values, values + n_owned());
    }

    /** The same with the ghosts in an array of their own. */
    template <typename T>
    void update_ghosts(const T *owned, T *ghosts) const;

  private:
    dealii::Utilities::MPI::Partitioner partitioner;
  };

  template <typename T>
  void NodeExchange::update_ghosts(const T *owned, T *ghosts) const
  {
    const auto &sources = partitioner.ghost_targets();
    const auto &targets = partitioner.import_targets();
    if (sources.empty() && targets.empty())
      return;

    std::vector<MPI_Request> requests(sources.size() + targets.size());
    auto request = requests.begin();
    T *ghost     = ghosts;
    for (const auto &[rank, count] : sources)
    {
      MPI_Irecv(ghost, count * sizeof(T), MPI_BYTE, rank, 0, communicator(),
                &*request++);
      ghost += count;
    }

    std::vector<T> buffer;
    buffer.reserve(partitioner.n_import_indices());
    for (const auto &[begin, end] : partitioner.import_indices())
      buffer.insert(buffer.end(), owned + begin, owned + end);
    const T *outgoing = buffer.data();
    for (const auto &[rank, count] : targets)
    {
      MPI_Isend(outgoing, count * sizeof(T), MPI_BYTE, rank, 0, communicator(),
                &*request++);
      outgoing += count;
    }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }
} // namespace quoin

#endif
