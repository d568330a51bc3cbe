// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_pair_marks_h
#define quoin_source_contact_pair_marks_h

#include <quoin/contact_geometry/near_pairs.h>

#include <vector>

// What a step has to know of all pairs before it looks at any: PairMark.

namespace quoin
{
  /** Mark of an active pair: 'active' or 'shifted'. */
  PairMark mark_of_active(const ContactPair &pair);

  /** Marks all pairs by their flags, none of them as distant. */
  void make_marks(ContactState &contacts);

  /** Finds out anew which pairs will not touch for the time being, if nodes
      have moved farther than that was found out for: those that do not overlap
      and, with @p by_distance, those that are far enough apart. theory.md,
      "General contacts". */
  void mark_distant(const NearPairs &near, bool by_distance,
                    ContactState &contacts);

  /** Lists the pairs that are active, and those that are neither active nor
      passed over, ascending. */
  void list_pairs(const AlignedArray<PairMark> &marks,
                  std::vector<unsigned int> &active,
                  std::vector<unsigned int> &idle);
} // namespace quoin

#endif
