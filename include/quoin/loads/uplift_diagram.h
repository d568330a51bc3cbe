// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_uplift_diagram_h
#define quoin_loads_uplift_diagram_h

#include <quoin/signals/time_function.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace quoin
{
  /**
   * Piezometric level of the water in a joint below a dam, by the distance s
   * from the heel towards the toe: the headwater h at the heel and all along a
   * crack of the length c, from there linear to the tailwater h_t at the toe,
   * at L. A line of drains of the efficiency E at s = X > c lowers the level
   * there to h_d + (1 - E)(l - h_d) where h_d is the height at which it drains,
   * no less than h_t, and l > h_d the level without drain; on both sides of it
   * the level is linear. A crack beyond the drains makes them useless (@cite
   * USACE1995, Fig. 3-3).
   */
  struct UpliftDiagram
  {
    TimeFunction headwater, tailwater; /**< levels [m] */
    dealii::Point<2> heel, toe;        /**< [m] */
    double drain      = 0.;            /**< X [m]; 0: none */
    double efficiency = 0.;            /**< E [-] */
    /** Height at which the drains end [m]; none: the tailwater. */
    std::optional<double> drain_level;
    /** Whether the headwater follows a crack; otherwise c is 0. */
    bool enters_cracks = false;

    /** L [m]. */
    double length() const
    {
      return heel.distance(toe);
    }
    /** s of @p place [m]. */
    double distance(const dealii::Point<2> &place) const
    {
      return (place - heel) * (toe - heel) / length();
    }

    /** Level [m] at @p s with a crack of the length @p crack [m]. */
    double level(const double s, const TimePoint &time,
                 const double crack) const
    {
      const double h = headwater(time), ht = tailwater(time);
      const double end = length();
      if (s <= crack || s <= 0.)
        return h;
      if (s >= end)
        return ht;
      const auto between = [&](const double s0, const double h0,
                               const double s1, const double h1)
      { return h0 + (h1 - h0) * (s - s0) / (s1 - s0); };
      if (!has_drain(crack))
        return between(crack, h, end, ht);
      const double linear = ht + (h - ht) * (end - drain) / (end - crack);
      const double drains = std::max(ht, drain_level.value_or(ht));
      const double lowered
          = std::min(linear, drains + (1. - efficiency) * (linear - drains));
      return s < drain ? between(crack, h, drain, lowered)
                       : between(drain, lowered, end, ht);
    }

    /** Whether drains act beyond a crack of the length @p crack [m]. */
    bool has_drain(const double crack) const
    {
      return drain > 0. && crack < drain;
    }
    /** Distances at which the level has kinks [m]. */
    std::vector<double> kinks(const double crack) const
    {
      std::vector<double> result = { 0., crack, length() };
      if (has_drain(crack))
        result.push_back(drain);
      return result;
    }
  };
} // namespace quoin

#endif
