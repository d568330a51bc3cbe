// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_pair_copies_h
#define quoin_contact_geometry_pair_copies_h

#include <quoin/contact_geometry/contact_edges.h>
#include <quoin/contact_geometry/contact_state.h>

#include <vector>

namespace quoin
{
  /**
   * Copies of pairs that other ranks have beside those of this one: where an
   * own edge goes on, along the boundary of a block that lies on several ranks,
   * as an edge of another rank, and both are near an edge that is not own
   * either. They are there to be read: forces and energies of these pairs are
   * those of other ranks.
   */
  class PairCopies
  {
  public:
    /** Keeps a reference to @p edges. */
    PairCopies(const ContactEdges &edges, MPI_Comm communicator);

    /** Finds out what ranks that share blocks have for each other beside
        @p pairs, ascending in their edges. All of them call it. */
    void bind(const AlignedArray<ContactPair> &pairs);

    /** Copies pairs as they are now; they are those of bind(). All ranks that
        share blocks call it. */
    void update(const AlignedArray<ContactPair> &pairs);

    /** Ordered by rank; one pair may come from two. */
    const std::vector<ContactPair> &pairs() const
    {
      return copies;
    }

  private:
    /** Numbers of pairs, one for each rank. */
    using Counts = std::vector<unsigned int>;

    template <typename T>
    void swap(const std::vector<T> &out, const Counts &n_out,
              std::vector<T> &in, const Counts &n_in) const;

    const ContactEdges &edges;
    const MPI_Comm communicator;
    /** Ranks that share blocks with this one. */
    std::vector<unsigned int> ranks;
    std::vector<unsigned int> sent; /**< pairs, by rank */
    Counts n_sent, n_received;
    std::vector<ContactPair> outgoing, copies;
  };
} // namespace quoin

#endif
