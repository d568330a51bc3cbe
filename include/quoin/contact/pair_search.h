// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_pair_search_h
#define quoin_contact_pair_search_h

#include <quoin/contact/contact_laws.h>
#include <quoin/contact_geometry/contact_skin.h>
#include <quoin/contact_geometry/near_pairs.h>

#include <array>
#include <vector>

namespace quoin
{
  struct EdgeEnds;

  /** Finds the pairs of edges that may touch before the next search. */
  class PairSearch
  {
  public:
    /** Keeps references to all but @p largest_skin, see ContactSkin.
        Collective. */
    PairSearch(const NodeMap<2> &node_map, ContactEdges &edges,
               const NearPairs &near, const ContactLaws &laws,
               double largest_skin);

    /**
     * Finds the pairs at the positions of @p state. Those that were there keep
     * their history; contacts that end give their energy to the account of
     * contacts. @p rate: by what edges may have approached in a step since the
     * last search [m]. Collective.
     */
    void renew(State<2> &state, double rate);

    const ContactSkin &skin() const
    {
      return own_skin;
    }

  private:
    /** The pairs within the skin and by how much contacts are @p apart [m], by
        their places in @p ends; sets the skin. */
    std::vector<std::array<unsigned int, 2>>
    find_pairs(const std::vector<EdgeEnds> &ends, double apart, double rate,
               ContactState &contacts) const;
    bool is_matched(const ContactState &contacts, unsigned int a,
                    unsigned int b) const;
    ContactPair new_pair(const EdgeEnds &a, const EdgeEnds &b) const;

    const NodeMap<2> &node_map;
    ContactEdges &edges;
    const NearPairs &near;
    const ContactLaws &laws;
    const ContactSkin own_skin;
    AlignedArray<ContactPair> pairs_before; /**< the last search */
  };

  /** Lets new pairs beside contacts that were joints allow for the slip of
      those, without which their lengths would not add up. */
  void inherit_shifts(const NearPairs &near, ContactState &contacts);
  /** Counts slip from where the edges touch now. */
  void reanchor(const NearPairs &near, ContactState &contacts);
} // namespace quoin

#endif
