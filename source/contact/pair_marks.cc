// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "pair_marks.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include <quoin/contact_geometry/edge_lanes.h>

namespace quoin
{
  namespace
  {
    /** Marks are read as numbers of so many bytes. */
    constexpr unsigned int marks_at_once = sizeof(std::uint64_t);

    /** Motion of nodes against each other after which it is looked anew which
        pairs may touch, at first by the skin; then it is chosen such that it is
        reached after fewest_steps to most_steps. */
    constexpr double first_motion       = 0.01;
    constexpr unsigned int fewest_steps = 4, most_steps = 16;
  } // namespace

  PairMark mark_of_active(const ContactPair &pair)
  {
    return pair.was_joint || pair.shift != 0. ? PairMark::shifted
                                              : PairMark::active;
  }

  void make_marks(ContactState &contacts)
  {
    // Marks beyond the last pair are of none that a step looks at.
    contacts.marks.assign((contacts.pairs.size() + marks_at_once - 1)
                              / marks_at_once * marks_at_once,
                          PairMark::distant);
    for (unsigned int i = 0; i < contacts.pairs.size(); ++i)
    {
      const ContactPair &pair = contacts.pairs[i];
      contacts.marks[i]       = pair.active     ? mark_of_active(pair)
                                : pair.was_open ? PairMark::open
                                                : PairMark::unseen;
    }
    contacts.marked_from.clear();
  }

  void mark_distant(const NearPairs &near, const bool by_distance,
                    ContactState &contacts)
  {
    const MovingEdges &moving = near.moving_edges();
    const bool is_first       = contacts.marked_from.empty();
    const double moved
        = is_first ? 0. : moving.motion_since(contacts.marked_from);
    ++contacts.marked_steps;
    if (!is_first && moved <= contacts.marked_for)
      return;
    // So far within one step that pairs may have touched which were passed
    // over.
    const bool was_late = moved > 2. * contacts.marked_for;
    double &motion      = contacts.marked_motion;
    if (is_first)
    {
      motion = 0.;
      // Beyond the last pair there is none that falls due.
      contacts.clear_until.assign(contacts.marks.size(),
                                  std::numeric_limits<double>::infinity());
      std::fill_n(contacts.clear_until.begin(), contacts.pairs.size(), 0.);
      if (contacts.marked_for == 0.)
        contacts.marked_for = first_motion * contacts.skin;
    }
    else if (contacts.marked_steps < fewest_steps)
      contacts.marked_for *= 2.;
    else if (contacts.marked_steps > most_steps)
      contacts.marked_for *= 0.5;
    motion += moved;
    contacts.marked_steps = 0;
    contacts.marked_from  = moving.positions();

    constexpr unsigned int lanes = native_lanes;
    using F                      = LaneFunctions<lanes>;
    std::vector<unsigned int> due;
    const double until = motion + contacts.marked_for;
    for (unsigned int i = 0; i < contacts.clear_until.size(); i += lanes)
    {
      const F::Bits mark = F::load_bytes(
          reinterpret_cast<const std::uint8_t *>(&contacts.marks[i]));
      const F::Bits is_early = F::load(&contacts.clear_until[i]) < until;
      // The first two bits; see list_pairs().
      const F::Bits is_idle = (mark & 3) != 2;
      for (unsigned int early = F::set_lanes(is_early & is_idle); early != 0;
           early &= early - 1)
        due.push_back(i + __builtin_ctz(early));
    }
    for (unsigned int j = 0; j < due.size(); j += lanes)
    {
      const unsigned int n = std::min<unsigned int>(lanes, due.size() - j);
      const PairPack<lanes> pack(near, &due[j], n);
      const auto clearance  = PairFunctions<lanes>::clearance(pack.a, pack.b);
      const auto separation = PairFunctions<lanes>::separation(pack.a, pack.b);
      for (unsigned int l = 0; l < n; ++l)
      {
        const unsigned int i = due[j + l];
        PairMark &mark       = contacts.marks[i];
        const bool was_apart = mark == PairMark::apart;
        const bool was_open  = was_apart || mark == PairMark::open;
        if (was_apart && was_late)
          for (ContactPoint &point : contacts.pairs[i].points)
            point.opening = std::numeric_limits<double>::infinity();
        // Pairs that are apart wake at half of their distance, so that the step
        // in which they touch has seen the one before.
        double clear = F::at(clearance, l);
        if (was_open)
          clear = by_distance ? 0.5 * F::at(separation, l) : 0.;
        contacts.clear_until[i] = motion + clear;
        if (clear > contacts.marked_for)
          mark = was_open ? PairMark::apart : PairMark::distant;
        else
          mark = was_open ? PairMark::open : PairMark::unseen;
      }
    }
  }

  void list_pairs(const AlignedArray<PairMark> &marks,
                  std::vector<unsigned int> &active,
                  std::vector<unsigned int> &idle)
  {
    // Marks of active pairs have the second bit and not the first, those of
    // pairs that are passed over have both.
    constexpr std::uint64_t first_bits = 0x0101010101010101;
    static_assert(
        unsigned(PairMark::open) == 1 && unsigned(PairMark::active) == 2
        && unsigned(PairMark::distant) == 3 && unsigned(PairMark::apart) == 7
        && unsigned(PairMark::shifted) == 10);
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
