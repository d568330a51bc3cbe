// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "pair_marks.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include <quoin/contact_geometry/edge_lanes.h>

namespace quoin
{
  namespace
  {
    /** Marks are read as numbers of so many bytes. */
    constexpr unsigned int marks_at_once = sizeof(std::uint64_t);

    /** Motion of nodes against each other up to which pairs stay distant, at
        first by the skin; then it is chosen such that it is reached after
        shortest_distance to longest_distance steps. */
    constexpr double first_distance          = 0.125;
    constexpr unsigned int shortest_distance = 8, longest_distance = 32;
  } // namespace

  void make_marks(ContactState &contacts)
  {
    // Marks beyond the last pair are of none that a step looks at.
    contacts.marks.assign((contacts.pairs.size() + marks_at_once - 1)
                              / marks_at_once * marks_at_once,
                          PairMark::distant);
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      const ContactPair &pair = contacts.pairs[i];
      contacts.marks[i]       = pair.active     ? PairMark::active
                                : pair.was_open ? PairMark::open
                                                : PairMark::unseen;
    }
    contacts.distant_from.clear();
  }

  void mark_distant(const NearPairs &near, ContactState &contacts)
  {
    const MovingEdges &moving = near.moving_edges();
    const bool is_first       = contacts.distant_from.empty();
    if (!is_first
        && moving.motion_since(contacts.distant_from)
               <= contacts.distant_motion)
    {
      ++contacts.distant_steps;
      return;
    }
    if (is_first)
      contacts.distant_motion = first_distance * contacts.skin;
    else if (contacts.distant_steps < shortest_distance)
      contacts.distant_motion *= 2.;
    else if (contacts.distant_steps > longest_distance)
      contacts.distant_motion *= 0.5;
    contacts.distant_steps = 0;
    contacts.distant_from  = moving.positions();

    constexpr unsigned int lanes = native_lanes;
    const unsigned int n_pairs   = contacts.pairs.size();
    for (unsigned int i = 0; i < n_pairs; i += lanes)
    {
      unsigned int pairs[lanes];
      std::iota(pairs, pairs + lanes, i);
      const unsigned int n = std::min(lanes, n_pairs - i);
      const PairPack<lanes> pack(near, pairs, n);
      const unsigned int clear
          = LaneFunctions<lanes>::set_lanes(PairFunctions<lanes>::stay_clear(
              pack.a, pack.b, contacts.distant_motion));
      for (unsigned int l = 0; l < n; ++l)
      {
        PairMark &mark = contacts.marks[i + l];
        if (mark == PairMark::unseen || mark == PairMark::distant)
          mark = clear >> l & 1 ? PairMark::distant : PairMark::unseen;
      }
    }
  }

  void list_pairs(const AlignedArray<PairMark> &marks,
                  std::vector<unsigned int> &active,
                  std::vector<unsigned int> &idle)
  {
    // The mark of an active pair has the second bit and not the first, that of
    // a distant one has both.
    constexpr std::uint64_t first_bits = 0x0101010101010101;
    static_assert(unsigned(PairMark::open) == 1
                  && unsigned(PairMark::active) == 2
                  && unsigned(PairMark::distant) == 3);
    active.resize(marks.size());
    idle.resize(marks.size());
    unsigned int *next_active = active.data(), *next_idle = idle.data();
    for (unsigned int i = 0; i < marks.size(); i += marks_at_once)
    {
      std::uint64_t bytes;
      std::memcpy(&bytes, &marks[i], sizeof(bytes));
      const auto list = [&](std::uint64_t bits, unsigned int *&to)
      {
        for (; bits != 0; bits &= bits - 1)
          *to++ = i + __builtin_ctzll(bits) / 8;
      };
      list(bytes >> 1 & ~bytes & first_bits, next_active);
      list(~(bytes >> 1) & first_bits, next_idle);
    }
    active.resize(next_active - active.data());
    idle.resize(next_idle - idle.data());
  }
} // namespace quoin
