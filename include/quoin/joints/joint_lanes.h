// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_lanes_h
#define quoin_joints_joint_lanes_h

#include <quoin/joints/point_arrays.h>
#include <quoin/joints/slip_lanes.h>

namespace quoin
{
  /** Points under one law that are updated together, one in each lane. */
  template <int lanes, int dim>
  struct PointLanes
  {
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    PointArrays<dim> arrays; /**< the history that has the points */
    std::size_t first = 0;   /**< index of the first of them there */
    Value opening;           /**< where they are brought to [m] */
    Slips slip;              /**< where they are brought to [m] */
    Value sigma;             /**< their normal tractions there [Pa] */
    Slips tau;               /**< their shear tractions there [Pa] */
    Bits elastic;            /**< they neither fail, slip nor are open */

    /** The entries of the points in @p array of the history. */
    QUOIN_INLINE double *of(double *array) const
    {
      return array + first;
    }
    /** The entries of the points in an array of slips or shear tractions. */
    QUOIN_INLINE double *slips_of(double *array) const
    {
      return array + (dim - 1) * first;
    }

    QUOIN_INLINE Bits load_state() const
    {
      return F::load_bytes(
          reinterpret_cast<const std::uint8_t *>(arrays.state + first));
    }
    QUOIN_INLINE void store_state(const Bits &state, const Bits &mask) const
    {
      F::store_bytes(reinterpret_cast<std::uint8_t *>(arrays.state + first),
                     state, mask);
    }
    QUOIN_INLINE void store_tractions() const
    {
      F::store(of(arrays.normal_traction), sigma);
      tau.store(slips_of(arrays.shear_traction));
    }
    QUOIN_INLINE void store_tractions(const Bits &mask) const
    {
      F::store(of(arrays.normal_traction), sigma, mask);
      tau.store(slips_of(arrays.shear_traction), mask);
    }
  };

  /** Dissipated energies [J] of the points in each lane. */
  template <int lanes>
  struct DissipationLanes
  {
    typename Lanes<lanes>::Value friction{}, fracture{}, crushing{};
  };

  /** Brings the point in lane @p l to where it comes to, by @p law itself, and
      adds what that dissipated by its area @p weight. */
  template <typename Law, int lanes, int dim>
  void update_point(const Law &law, PointLanes<lanes, dim> &points, const int l,
                    const double weight, DissipationLanes<lanes> &lost)
  {
    auto point           = read_point(law, points.arrays, points.first + l);
    const double opening = points.opening[l];
    const Slip<dim> slip = points.slip.at(l);
    if (!points.elastic[l])
    {
      const JointDissipation own = law.update_failing(point, opening, slip);
      lost.friction[l] += weight * own.friction;
      lost.fracture[l] += weight * own.fracture;
      lost.crushing[l] += weight * own.crushing;
    }
    else
      law.update_elastic(point, opening, slip);
    write_point(point, points.arrays, points.first + l);
    points.sigma[l] = point.normal_traction;
    points.tau.set(l, point.shear_traction);
  }

  /**
   * The updates of @p Law for several points at once, with the numbers of the
   * law itself but for rounding. What a point comes to does not depend on those
   * in the other lanes, because two ranks may have it beside others. A law is
   * specialised where speed matters; this one takes the points one by one.
   */
  template <typename Law, int lanes, int dim>
  class LawLanes
  {
  public:
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;

    explicit LawLanes(const Law &law) : law(law)
    {
    }

    /**
     * Sets elastic of @p points, and the tractions of those that are; changes
     * no history. Returns those of which nothing but tractions changes.
     */
    Bits try_elastic(PointLanes<lanes, dim> &points) const
    {
      Bits steady{};
      points.elastic = Bits{};
      // Lanes without a point have forces, too, times an area of zero.
      points.sigma = Value{};
      points.tau   = typename PointLanes<lanes, dim>::Slips{};
      for (int l = 0; l < lanes; ++l)
      {
        auto point       = read_point(law, points.arrays, points.first + l);
        const auto state = point.state;
        if (!law.update_elastic(point, points.opening[l], points.slip.at(l)))
          continue;
        points.elastic[l] = -1;
        points.sigma[l]   = point.normal_traction;
        points.tau.set(l, point.shear_traction);
        steady[l] = point.state == state ? -1 : 0;
      }
      return steady;
    }

    /**
     * Brings the @p points of the mask @p present to where they come to, after
     * try_elastic(), and adds what that dissipated by their areas @p weight.
     */
    void update(PointLanes<lanes, dim> &points, const Bits &present,
                const Value &weight, DissipationLanes<lanes> &lost) const
    {
      for (int l = 0; l < lanes; ++l)
        if (present[l])
          update_point(law, points, l, weight[l], lost);
    }

  private:
    const Law law;
  };
} // namespace quoin

#endif
