// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact_geometry/contact_skin.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace quoin
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Most steps between two looks at the motions, with a skin not below the
        first one; with a smaller one there are fewer. */
    constexpr double longest_interval = 50.;
    /** First and largest automatic skin by the median edge. */
    constexpr double first_skin = 0.02, most_skin = 0.2;
    /** Automatic skins are the largest one by powers of the square root of 2.
     */
    constexpr unsigned int n_skins = 14;
    /** By how much an automatic skin may grow from one search to the next. */
    constexpr double growth = 2.;
    /** What a search costs for each edge, by what a step costs for each pair.
     */
    constexpr double cost_of_search = 150.;
    /** Steps after which a first search is followed by another, which knows of
        the motions, and, by the number of steps that a skin is made for, those
        after which another one may be cheaper. */
    constexpr std::uint64_t first_steps = 100;
    constexpr double patience           = 4.;

    /** Those from @p largest on, descending. */
    std::array<double, n_skins> automatic_skins(const double largest)
    {
      std::array<double, n_skins> skins;
      for (unsigned int k = 0; k < n_skins; ++k)
        skins[k] = largest * std::pow(0.5, 0.5 * k);
      return skins;
    }

    /** Median of the edges of all ranks. Collective. */
    double median_length(const ContactEdges &edges, const MPI_Comm communicator)
    {
      std::vector<double> lengths;
      for (const ContactEdge &edge : edges.own())
        lengths.push_back(edge.length);
      // Positive numbers ascend as their bits do, so that of the number with as
      // many below it one byte after the other is found by counting.
      unsigned int below  = edges.n_global() / 2;
      std::uint64_t found = 0;
      for (int shift = 56; shift >= 0; shift -= 8)
      {
        std::vector<unsigned int> counts(256, 0);
        for (const double length : lengths)
        {
          std::uint64_t bits;
          std::memcpy(&bits, &length, sizeof(bits));
          if (shift == 56 || bits >> (shift + 8) == found)
            ++counts[bits >> shift & 255U];
        }
        dealii::Utilities::MPI::sum(counts, communicator, counts);
        unsigned int byte = 0;
        while (below >= counts[byte])
          below -= counts[byte++];
        found = found << 8U | byte;
      }
      double median;
      std::memcpy(&median, &found, sizeof(median));
      return median;
    }
  } // namespace

  ContactSkin::ContactSkin(const double given, const ContactEdges &edges,
                           const MPI_Comm communicator)
    : given(given), edges(edges), communicator(communicator),
      largest_skin(given > 0. ? given
                              : most_skin * median_length(edges, communicator))
  {
  }

  std::uint64_t ContactSkin::renewal(const ContactState &contacts,
                                     const double rate) const
  {
    const double steps = patience * contacts.skin / rate;
    if (given > 0.)
      return -1;
    if (contacts.n_searches == 1)
      return contacts.searched + first_steps;
    return steps < 1e9 ? contacts.searched + static_cast<std::uint64_t>(steps)
                       : -1;
  }

  double ContactSkin::search_distance(const ContactState &contacts) const
  {
    if (given > 0.)
      return given;
    return contacts.n_searches == 0
               ? first_skin / most_skin * largest_skin
               : std::min(largest_skin, growth * contacts.skin);
  }

  double ContactSkin::cheapest(std::vector<unsigned int> sides,
                               const double rate,
                               const ContactState &contacts) const
  {
    dealii::Utilities::MPI::sum(sides, communicator, sides);
    double best = search_distance(contacts), least = infinity;
    const auto skins = automatic_skins(largest_skin);
    for (unsigned int k = 0; k < n_skins; ++k)
    {
      const double skin = skins[k];
      if (skin > 1.001 * search_distance(contacts))
        continue;
      const double cost
          = 0.5 * sides[k] + cost_of_search * edges.n_global() * rate / skin;
      if (cost < least)
      {
        best  = skin;
        least = cost;
      }
    }
    return best;
  }

  void ContactSkin::choose(const std::vector<double> &needed,
                           const std::vector<unsigned int> &own_edges,
                           const double rate, ContactState &contacts) const
  {
    if (given > 0. || contacts.n_searches == 0)
    {
      contacts.skin = search_distance(contacts);
      return;
    }
    // By skin, how many sides of pairs of this rank it takes in.
    std::vector<unsigned int> sides(n_skins, 0);
    const auto skins = automatic_skins(largest_skin);
    for (unsigned int p = 0; p < needed.size(); ++p)
    {
      unsigned int n = 0;
      while (n < n_skins && needed[p] <= skins[n])
        ++n;
      if (n > 0)
        sides[n - 1] += own_edges[p];
    }
    for (unsigned int k = n_skins - 1; k > 0; --k)
      sides[k - 1] += sides[k];
    contacts.skin = cheapest(sides, rate, contacts);
  }

  std::uint64_t ContactSkin::interval(const ContactState &contacts,
                                      const double left,
                                      const double ahead) const
  {
    const double longest
        = std::clamp(std::floor(longest_interval * most_skin / first_skin
                                * contacts.skin / largest_skin),
                     1., longest_interval);
    return static_cast<std::uint64_t>(
        ahead > 0. ? std::clamp(std::floor(left / ahead), 1., longest)
                   : longest);
  }
} // namespace quoin
