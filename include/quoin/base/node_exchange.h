// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_node_exchange_h
#define quoin_base_node_exchange_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <vector>

namespace quoin
{
  /**
   * Nodes of this rank: a contiguous range of global nodes that it owns,
   * numbered from 0, and after them copies of nodes: first the shared ones,
   * nodes of its own cells that other ranks own, whose forces it adds to those
   * of the owner; then partners, the nodes across joints of which another rank
   * has the cell, which it only reads. A node may appear more than once; values
   * added to a partner are discarded.
   */
  class NodeExchange
  {
  public:
    /** Owns [first, last) of @p n_global nodes and mirrors @p partners. */
    NodeExchange(unsigned int first, unsigned int last, unsigned int n_global,
                 const std::vector<unsigned int> &partners,
                 MPI_Comm communicator);

    /** Exchange that also mirrors @p shared nodes, ascending. Collective. */
    NodeExchange(unsigned int first, unsigned int last, unsigned int n_global,
                 const std::vector<unsigned int> &shared,
                 const std::vector<unsigned int> &partners,
                 MPI_Comm communicator);

    /** Exchange of the same nodes with @p partners alone. Collective. */
    NodeExchange with_partners(const std::vector<unsigned int> &partners) const;

    /** Global numbers of the owned nodes. */
    const dealii::IndexSet &owned() const
    {
      return partitioner.locally_owned_range();
    }
    unsigned int n_owned() const
    {
      return partitioner.locally_owned_size();
    }
    unsigned int n_shared() const
    {
      return shared_partitioner.n_ghost_indices();
    }
    unsigned int n_local() const
    {
      return n_owned() + n_shared() + partners.size();
    }
    bool owns(const unsigned int global) const
    {
      return partitioner.in_local_range(global);
    }
    /** Local number of a node that is owned, shared or a partner. */
    unsigned int local(const unsigned int global) const
    {
      return owns(global) || shared_partitioner.is_ghost_entry(global)
                 ? shared_partitioner.global_to_local(global)
                 : partner(global);
    }
    /** Local number of a node as a partner. */
    unsigned int partner(const unsigned int global) const
    {
      return n_owned() + n_shared()
             + (std::lower_bound(partners.begin(), partners.end(), global)
                - partners.begin());
    }
    unsigned int global(const unsigned int local) const
    {
      return local < n_owned() + n_shared()
                 ? shared_partitioner.local_to_global(local)
                 : partners[local - n_owned() - n_shared()];
    }
    unsigned int n_global() const
    {
      return partitioner.size();
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

    /** Updates ghosts in a separate array. */
    template <typename T>
    void update_ghosts(const T *owned, T *ghosts) const;

    /**
     * Adds the entries of shared nodes of @p values, n_local() long, to those
     * of their owners on other ranks. The entries of this rank stay. @p T is an
     * aggregate of doubles.
     */
    template <typename T>
    void add_to_owners(T *values) const;

  private:
    template <typename T>
    friend class OwnerSum;

    dealii::Utilities::MPI::Partitioner partitioner, shared_partitioner;
    std::vector<unsigned int> partners; /**< global, ascending */
    /** Sources of the values of shared nodes and then of partners: below
        n_owned() an owned node, else a ghost of the partitioner. Empty if they
        are the ghosts in order. */
    std::vector<unsigned int> sources;
  };

  template <typename T>
  void NodeExchange::update_ghosts(const T *owned, T *ghosts) const
  {
    const auto &senders = partitioner.ghost_targets();
    const auto &targets = partitioner.import_targets();
    if (senders.empty() && targets.empty() && sources.empty())
      return;

    std::vector<T> arrived(sources.empty() ? 0 : partitioner.n_ghost_indices());
    std::vector<MPI_Request> requests(senders.size() + targets.size());
    auto request = requests.begin();
    T *ghost     = sources.empty() ? ghosts : arrived.data();
    for (const auto &[rank, count] : senders)
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
    for (const unsigned int source : sources)
      *ghosts++
          = source < n_owned() ? owned[source] : arrived[source - n_owned()];
  }

  /**
   * NodeExchange::add_to_owners() in two halves, between which the caller works
   * on other nodes. Keeps its buffers.
   */
  template <typename T>
  class OwnerSum
  {
  public:
    /** Keeps a reference to @p exchange. */
    explicit OwnerSum(const NodeExchange &exchange)
      : exchange(exchange), partitioner(exchange.shared_partitioner),
        arrived(partitioner.n_import_indices()),
        requests(partitioner.ghost_targets().size()
                 + partitioner.import_targets().size())
    {
    }

    /** Sends the entries of shared nodes of @p values, n_local() long, which
        must not change before finish(). */
    void start(const T *values)
    {
      auto request = requests.begin();
      T *incoming  = arrived.data();
      for (const auto &[rank, count] : partitioner.import_targets())
      {
        MPI_Irecv(incoming, count * sizeof(T), MPI_BYTE, rank, 1,
                  exchange.communicator(), &*request++);
        incoming += count;
      }
      const T *outgoing = values + exchange.n_owned();
      for (const auto &[rank, count] : partitioner.ghost_targets())
      {
        MPI_Isend(outgoing, count * sizeof(T), MPI_BYTE, rank, 1,
                  exchange.communicator(), &*request++);
        outgoing += count;
      }
    }

    /** Adds the received entries to the owned entries of @p values. */
    void finish(T *values)
    {
      constexpr unsigned int n_components = sizeof(T) / sizeof(double);
      if (requests.empty())
        return;
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
      const T *part = arrived.data();
      for (const auto &[begin, end] : partitioner.import_indices())
        for (unsigned int i = begin; i < end; ++i, ++part)
        {
          double *sum        = reinterpret_cast<double *>(values + i);
          const double *term = reinterpret_cast<const double *>(part);
          for (unsigned int c = 0; c < n_components; ++c)
            sum[c] += term[c];
        }
    }

  private:
    const NodeExchange &exchange;
    const dealii::Utilities::MPI::Partitioner &partitioner;
    std::vector<T> arrived;
    std::vector<MPI_Request> requests;
  };

  template <typename T>
  void NodeExchange::add_to_owners(T *values) const
  {
    OwnerSum<T> sum(*this);
    sum.start(values);
    sum.finish(values);
  }
} // namespace quoin

#endif
