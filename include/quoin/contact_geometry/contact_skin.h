// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_contact_skin_h
#define quoin_contact_geometry_contact_skin_h

#include <quoin/contact_geometry/contact_search.h>
#include <quoin/contact_geometry/contact_state.h>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * The skin, the distance that edges may approach before the next search: as
   * it is given, or that for which searches and pairs that stay apart cost
   * least together.
   */
  class ContactSkin
  {
  public:
    /** Keeps a reference to @p edges; @p given [m], 0: automatic. Collective.
     */
    ContactSkin(double given, const ContactEdges &edges, MPI_Comm communicator);

    /** Largest skin [m]. */
    double largest() const
    {
      return largest_skin;
    }
    /** Distance within which a search looks for pairs [m]. */
    double search_distance(const ContactState &contacts) const;
    /** Sets the skin of @p contacts for pairs that touch once edges have moved
        by @p needed [m], of which this rank has @p own_edges, if edges have
        approached by @p rate in a step since the last search [m]. Collective.
     */
    void choose(const std::vector<double> &needed,
                const std::vector<unsigned int> &own_edges, double rate,
                ContactState &contacts) const;
    /** Step after which another search may be cheaper; largest: none. */
    std::uint64_t renewal(const ContactState &contacts, double rate) const;
    /** Steps to the next look at the motions, if edges may approach by
        @p ahead in each and by @p left before the next search [m]. */
    std::uint64_t interval(const ContactState &contacts, double left,
                           double ahead) const;

  private:
    double cheapest(std::vector<unsigned int> sides, double rate,
                    const ContactState &contacts) const;

    const double given;
    const ContactEdges &edges;
    const MPI_Comm communicator;
    double largest_skin; /**< [m] */
  };
} // namespace quoin

#endif
