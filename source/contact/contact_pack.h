// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_contact_pack_h
#define quoin_source_contact_contact_pack_h

#include <quoin/contact_geometry/contact_state.h>
#include <quoin/contact_geometry/pair_lanes.h>
#include <quoin/law_lanes/barton_bandis_lanes.h>
#include <quoin/law_lanes/composite_lanes.h>
#include <quoin/law_lanes/continuously_yielding_lanes.h>
#include <quoin/law_lanes/coulomb_lanes.h>
#include <quoin/law_lanes/slip_weakening_lanes.h>

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace quoin
{
  static_assert(offsetof(ContactPoint, plastic_slip) == 4 * sizeof(double)
                    && offsetof(ContactPoint, slip_offset) == 8 * sizeof(double)
                    && offsetof(ContactPoint, internal) == 12 * sizeof(double)
                    && offsetof(ContactPair, shift) % sizeof(Pair) == 0,
                "they are loaded as they lie in memory");

  /**
   * Points of general contacts under one law, those at the same end of the
   * pairs in the lanes. With one lane they follow the law itself, the reference
   * of those with more.
   */
  template <typename Law, int lanes>
  class ContactPack
  {
  public:
    static constexpr unsigned int dim = 2;
    using L                           = Lanes<lanes>;
    using F                           = LaneFunctions<lanes>;
    using Value                       = typename F::Value;
    using Bits                        = typename F::Bits;
    using Laws = std::conditional_t<lanes == 1, Law, LawLanes<Law, lanes, dim>>;

    // As load() found them; see ContactPoint.
    Value sigma_before, tau_before, area_before, opening_before;
    Value plastic_before, lean_before, sideways_before;
    AnchorLanes<lanes> anchor;
    Value sigma, tau; /**< tractions after advance() [Pa] */

    /** Points @p k of pairs. */
    QUOIN_INLINE void load(ContactPair *pairs, const std::uint32_t *pair,
                           const unsigned int k)
    {
      Value row[4];
      for (int l = 0; l < lanes; ++l)
        points[l] = &pairs[pair[l]].points[k];
      L::load_four([&](const int l) { return &points[l]->normal_traction; },
                   row);
      sigma_before   = row[0];
      tau_before     = row[1];
      area_before    = row[2];
      opening_before = row[3];
      F::store(now.values[0], row[0]);
      F::store(now.values[1], row[1]);
      L::load_four([&](const int l) { return &points[l]->plastic_slip; }, row);
      plastic_before  = row[1];
      lean_before     = row[2];
      sideways_before = row[3];
      F::store(now.values[2], row[0]);
      F::store(now.values[3], row[1]);
      L::load_four([&](const int l) { return &points[l]->slip_offset; }, row);
      anchor = { row[0], row[1], row[2] };
      rest   = row[3];
      if constexpr (n_internal > 0)
      {
        L::load_four([&](const int l) { return points[l]->internal; }, row);
        for (unsigned int i = 0; i < 4; ++i)
          F::store(now.values[4 + i], row[i]);
      }
      if constexpr (lanes == 1)
        now.state[0] = points[0]->state;
      else
        F::store_bytes(reinterpret_cast<std::uint8_t *>(now.state),
                       (Bits)rest & last_byte);
    }

    /** Does not write the lanes beside those @p present. */
    QUOIN_INLINE void keep(const unsigned int present)
    {
      for (int l = 0; l < lanes; ++l)
        points[l] = present >> l & 1 ? points[l] : &left_out;
    }

    /** Brings the points of @p present to @p opening and @p slip [m]; @p
        weight: their areas, of what that dissipates. */
    QUOIN_INLINE void advance(const Law &law, const Laws &laws,
                              const Bits &present, const Value &opening,
                              const Value &slip, const Value &weight,
                              DissipationLanes<lanes> &lost)
    {
      if constexpr (keeps_before)
        before = now;
      if constexpr (lanes == 1)
      {
        auto point = read_point(law, arrays(now), 0);
        if (present && !law.update_elastic(point, opening, slip))
        {
          const JointDissipation own = law.update_failing(point, opening, slip);
          lost.friction += weight * own.friction;
          lost.fracture += weight * own.fracture;
          lost.crushing += weight * own.crushing;
        }
        PointArrays<dim> all = arrays(now);
        write_point(point, all, 0);
        has_flowed = true;
      }
      else
      {
        PointLanes<lanes, dim> points;
        points.arrays  = arrays(now);
        points.opening = opening;
        points.slip    = { { slip } };
        has_flowed     = !F::all(laws.try_elastic(points) | ~present);
        if (has_flowed)
          laws.update(points, present, weight, lost);
        else
          points.store_tractions();
      }
      sigma = F::load(now.values[0]);
      tau   = F::load(now.values[1]);
    }

    /** Plastic opening after advance() [m]. */
    QUOIN_INLINE Value plastic_opening() const
    {
      return F::load(now.values[3]);
    }

    /** Those that slip or are open after advance(). */
    QUOIN_INLINE Bits flows() const
    {
      return is(JointState::slipping) | is(JointState::open);
    }

    /** Energy per area [J/m^2] that a change of area takes along in advance().
        What comes with no area has had no energy before. */
    QUOIN_INLINE Value carried(const Law &law)
    {
      if constexpr (keeps_before)
        return F::each(
            [&](const int l)
            {
              const auto after = read_point(law, arrays(now), l);
              return law.carried_energy(F::at(area_before, l) > 0.
                                            ? read_point(law, arrays(before), l)
                                            : after,
                                        after);
            });
      else
      {
        const Bits is_old   = area_before > 0.;
        const Value sigma_0 = is_old ? sigma_before : sigma;
        const Value tau_0   = is_old ? tau_before : tau;
        return 0.5
               * (sigma_0 * sigma * (1. / law.normal_stiffness)
                  + tau_0 * tau * (1. / law.shear_stiffness));
      }
    }

    /** Normal and shear stiffness after advance() [Pa/m]. */
    QUOIN_INLINE void stiffness(const Law &law, Value (&result)[2]) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if constexpr (Law::stiffens)
          result[d] = F::each([&](const int l)
                              { return law.stiffness_at(F::at(sigma, l))[d]; });
        else
          result[d] = Value{} + law.stiffness_at(0.)[d];
    }

    /** Writes the points as they are after advance(), and these. */
    QUOIN_INLINE void store(const Value &area, const Value &opening,
                            const Value &lean, const Value &sideways,
                            const bool has_new_anchor)
    {
      L::store_four([&](const int l) { return &points[l]->normal_traction; },
                    { sigma, tau, area, opening });
      if (has_flowed
          || F::any((lean != lean_before) | (sideways != sideways_before)))
        L::store_four(
            [&](const int l) { return &points[l]->plastic_slip; },
            { F::load(now.values[2]), F::load(now.values[3]), lean, sideways });
      if (!has_flowed && !has_new_anchor)
        return;
      if constexpr (lanes > 1)
        rest = (Value)(((Bits)rest & ~last_byte) | states());
      L::store_four([&](const int l) { return &points[l]->slip_offset; },
                    { anchor.slip_offset, anchor.lower, anchor.upper, rest });
      if constexpr (lanes == 1)
        points[0]->state = now.state[0];
      if constexpr (n_internal > 0)
      {
        Value row[4];
        for (unsigned int i = 0; i < 4; ++i)
          row[i] = F::load(now.values[4 + i]);
        L::store_four([&](const int l) { return points[l]->internal; }, row);
      }
    }

  private:
    static constexpr unsigned int n_internal = PointOf<Law>::internal.size();
    static_assert(n_internal <= ContactPoint::most_internal
                  && ContactPoint::most_internal == 4);
    /** Springs of constant stiffness carry energy that tractions tell. */
    static constexpr bool keeps_before = Law::stiffens || lanes == 1;

    struct Variables
    {
      alignas(64) double values[4 + ContactPoint::most_internal][lanes];
      JointState state[8];
    };
    static PointArrays<dim> arrays(Variables &of)
    {
      PointArrays<dim> result{ of.values[0], of.values[1], of.values[2],
                               of.values[3], {},           of.state };
      for (unsigned int i = 0; i < ContactPoint::most_internal; ++i)
        result.internal[i] = of.values[4 + i];
      return result;
    }

    static constexpr std::int64_t last_byte = 0xff;
    QUOIN_INLINE Bits states() const
    {
      return F::load_bytes(reinterpret_cast<const std::uint8_t *>(now.state));
    }
    QUOIN_INLINE Bits is(const JointState state) const
    {
      if constexpr (lanes == 1)
        return now.state[0] == state;
      else
        return states() == static_cast<int>(state);
    }

    ContactPoint *points[lanes];
    ContactPoint left_out; /**< in place of what is not present */
    Value rest;            /**< of the row of anchors, with the state */
    Variables now, before;
    bool has_flowed;
  };
} // namespace quoin

#endif
