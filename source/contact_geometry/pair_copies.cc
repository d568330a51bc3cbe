// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact_geometry/pair_copies.h>

#include <numeric>
#include <type_traits>

namespace quoin
{
  static_assert(std::is_trivially_copyable_v<ContactPair>,
                "pairs are sent as they are");

  PairCopies::PairCopies(const ContactEdges &edges, const MPI_Comm communicator)
    : edges(edges), communicator(communicator)
  {
    for (const auto &[edge, rank] : edges.ranks_beside())
      ranks.push_back(rank);
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    n_sent.assign(ranks.size(), 0);
    n_received.assign(ranks.size(), 0);
  }

  template <typename T>
  void PairCopies::swap(const std::vector<T> &out, const Counts &n_out,
                        std::vector<T> &in, const Counts &n_in) const
  {
    constexpr int tag = 2;
    in.resize(std::accumulate(n_in.begin(), n_in.end(), 0U));
    std::vector<MPI_Request> requests;
    const T *from = out.data();
    T *to         = in.data();
    for (unsigned int r = 0; r < ranks.size(); ++r)
    {
      if (n_in[r] > 0)
        MPI_Irecv(to, n_in[r] * sizeof(T), MPI_BYTE, ranks[r], tag,
                  communicator, &requests.emplace_back());
      if (n_out[r] > 0)
        MPI_Isend(from, n_out[r] * sizeof(T), MPI_BYTE, ranks[r], tag,
                  communicator, &requests.emplace_back());
      to += n_in[r];
      from += n_out[r];
    }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }

  void PairCopies::bind(const AlignedArray<ContactPair> &pairs)
  {
    if (ranks.empty())
      return;
    // Beside a pair of which one edge is own are those of the edges before and
    // after that.
    using Key = std::array<unsigned int, 2>;
    std::vector<std::vector<Key>> keys(ranks.size());
    const auto look_beside = [&](const unsigned int own, const unsigned int b)
    {
      if (!edges.is_own(own) || edges.is_own(b))
        return;
      for (const unsigned int a : { edges[own].previous, edges[own].next })
        if (const auto found = edges.ranks_beside().find(a);
            found != edges.ranks_beside().end())
          keys[std::lower_bound(ranks.begin(), ranks.end(), found->second)
               - ranks.begin()]
              .push_back({ std::min(a, b), std::max(a, b) });
    };
    for (const ContactPair &pair : pairs)
    {
      look_beside(pair.lower, pair.upper);
      look_beside(pair.upper, pair.lower);
    }

    // Ask for them; of those asked for here, send what there is.
    const Counts one(ranks.size(), 1);
    Counts n_wanted, n_asked;
    std::vector<Key> wanted, asked;
    for (std::vector<Key> &of_rank : keys)
    {
      std::sort(of_rank.begin(), of_rank.end());
      of_rank.erase(std::unique(of_rank.begin(), of_rank.end()), of_rank.end());
      n_wanted.push_back(of_rank.size());
      wanted.insert(wanted.end(), of_rank.begin(), of_rank.end());
    }
    swap(n_wanted, one, n_asked, one);
    swap(wanted, n_wanted, asked, n_asked);
    sent.clear();
    n_sent.assign(ranks.size(), 0);
    auto key = asked.begin();
    for (unsigned int r = 0; r < ranks.size(); ++r)
      for (unsigned int i = 0; i < n_asked[r]; ++i, ++key)
      {
        const auto found
            = std::lower_bound(pairs.begin(), pairs.end(), *key,
                               [](const ContactPair &pair, const Key &k)
                               { return pair.edges() < k; });
        if (found == pairs.end() || found->edges() != *key)
          continue;
        sent.push_back(found - pairs.begin());
        ++n_sent[r];
      }
    swap(n_sent, one, n_received, one);
    update(pairs);
  }

  void PairCopies::update(const AlignedArray<ContactPair> &pairs)
  {
    if (ranks.empty())
      return;
    outgoing.clear();
    for (const unsigned int i : sent)
      outgoing.push_back(pairs[i]);
    swap(outgoing, n_sent, copies, n_received);
  }
} // namespace quoin
