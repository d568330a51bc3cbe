// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_law_lanes_composite_lanes_h
#define quoin_law_lanes_composite_lanes_h

#include <quoin/joint_laws/composite_law.h>
#include <quoin/joint_laws/composite_return_map.h>
#include <quoin/joints/joint_lanes.h>

#include <limits>

namespace quoin
{
  /**
   * Cracks that close, flow that Newton's method finds without crushing and
   * dilation, and crushing alone are in lanes; CompositeLaw itself does the
   * rest, point by point.
   */
  template <int lanes, int dim>
  class LawLanes<CompositeLaw, lanes, dim>
  {
  public:
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    explicit LawLanes(const CompositeLaw &law)
      : law(law), opening_softening(law.opening_softening()),
        slip_softening(law.slip_softening()),
        has_cap(std::isfinite(law.cap.compression)),
        peak_rate(1. / law.cap.peak_crushing),
        width_rate(1. / (law.cap.middle_crushing() - law.cap.peak_crushing)),
        crush_compliance(0.5 / (law.normal_stiffness * law.cap.normal)),
        crush_ratio(2. * law.shear_stiffness * law.cap.shear
                    * crush_compliance),
        cap_centre(-0.5 * law.cap.offset / law.cap.normal),
        by_normal(0.5 / law.cap.normal), by_shear(0.5 / law.cap.shear),
        normal_stiffness(Value{} + law.normal_stiffness),
        shear_stiffness(Value{} + law.shear_stiffness),
        tension(Value{} + law.tension), cohesion(Value{} + law.cohesion),
        residual_friction(Value{} + law.residual_friction),
        friction_loss(Value{} + (law.friction - law.residual_friction)),
        cap_normal(Value{} + law.cap.normal),
        cap_offset(Value{} + law.cap.offset),
        cap_shear(Value{} + law.cap.shear),
        lowest_load(Value{} + law.cap.lowest_load())
    {
    }

    QUOIN_INLINE Bits try_elastic(PointLanes<lanes, dim> &points) const
    {
      const PointArrays<dim> &at = points.arrays;
      points.sigma
          = normal_stiffness
            * (points.opening - F::load(points.of(at.plastic_opening)));
      points.tau
          = shear_stiffness
            * (points.slip - Slips::load(points.slips_of(at.plastic_slip)));
      const Bits state = points.load_state();
      const Value none{};
      // Intact points have all of their bond and no crack. Not to load these
      // is faster in three dimensions, where history is the most of the data.
      if constexpr (dim == 3)
        if (F::all(state == 0))
        {
          points.elastic
              = is_elastic(points, points.sigma, points.tau, none + 1., none);
          return points.elastic;
        }
      points.elastic
          = is_elastic(points, points.sigma, points.tau,
                       F::load(points.of(at.internal[bond])),
                       F::load(points.of(at.internal[crack_opening])));
      return points.elastic
             & ((state == 0) | (state == elastic_state(points.sigma)));
    }

    QUOIN_INLINE void update(PointLanes<lanes, dim> &points,
                             const Bits &present, const Value &weight,
                             DissipationLanes<lanes> &lost) const
    {
      const Bits failing = present & ~points.elastic;
      if (F::any(failing))
      {
        // fail() gets a copy, so that the points of all other packs, whose
        // address nobody takes, stay in registers.
        PointLanes<lanes, dim> all = points;
        fail(all, present, failing, weight, lost);
        points.sigma = all.sigma;
        points.tau   = all.tau;
        return;
      }
      const Bits state = points.load_state();
      points.store_tractions(present);
      points.store_state(state == 0 ? state : elastic_state(points.sigma),
                         present);
    }

  private:
    /** Places in CompositePoint::internal. */
    static constexpr unsigned int bond = 0, crushing = 1, crack_opening = 2;

    /** Where the return map takes points, as CompositeFlow. */
    struct Flow
    {
      Value sigma, tau, opening, slip, bond, cap, crushing;
      Bits found{}; /**< for which this is the answer */
    };

    static QUOIN_INLINE Bits fill(const JointState state)
    {
      return Bits{} + static_cast<int>(state);
    }
    /** The state of points that have failed before and are elastic now. */
    static QUOIN_INLINE Bits elastic_state(const Value &sigma)
    {
      return sigma > 0. ? fill(JointState::open) : fill(JointState::slipped);
    }

    QUOIN_INLINE Value friction_at(const Value &bond) const
    {
      return residual_friction + friction_loss * bond;
    }

    /** See CompositeLaw::update_elastic(). */
    QUOIN_INLINE Bits is_elastic(const PointLanes<lanes, dim> &points,
                                 const Value &sigma, const Slips &tau,
                                 const Value &bond_now,
                                 const Value &crack_opening) const
    {
      const Bits below = (sigma <= tension * bond_now)
                         & is_within(tau, cohesion * bond_now
                                              - sigma * friction_at(bond_now))
                         & ~((sigma < 0.) & (crack_opening > 0.));
      return below & within_cap(points, sigma, dot(tau, tau), below);
    }

    /** Whether tractions leave the cap as it was, for the points of @p asked.
        @p squared: that of the shear traction. */
    QUOIN_INLINE Bits within_cap(const PointLanes<lanes, dim> &points,
                                 const Value &sigma, const Value &squared,
                                 const Bits &asked) const
    {
      const Value load
          = (cap_normal * sigma + cap_offset) * sigma + cap_shear * squared;
      const Bits is_far = load <= lowest_load;
      if (!has_cap || !F::any(asked & ~is_far))
        return is_far;
      const Value limit
          = cap_limit(F::load(points.of(points.arrays.internal[crushing])));
      return is_far | (load <= limit * limit);
    }

    /** See CompositeCap::limit(). */
    QUOIN_INLINE Value cap_limit(const Value &crushing) const
    {
      Value slope;
      return cap_limit(crushing, slope);
    }
    QUOIN_INLINE Value cap_limit(const Value &crushing, Value &slope) const
    {
      const CompositeCap &cap = law.cap;
      const double first = cap.compression / 3., middle = cap.compression / 2.,
                   last   = cap.compression / 7.;
      const double km     = cap.middle_crushing();
      const Value rising  = crushing * peak_rate;
      const Value falling = (crushing - cap.peak_crushing) * width_rate;
      const double m      = 2. * (middle - cap.compression) * width_rate;
      const Bits rises    = crushing < cap.peak_crushing;
      const Value root    = F::square_root(rising * (2. - rising));
      const Value limit
          = rises ? first + (cap.compression - first) * root
                  : cap.compression
                        + (middle - cap.compression) * falling * falling;
      slope                = rises ? (cap.compression - first) * peak_rate
                          * ((1. - rising) / root)
                                   : m * falling;
      const Bits is_beyond = crushing >= km;
      if (!F::any(is_beyond))
        return limit;
      const Value decay = F::exponential(m * (crushing - km) / (middle - last));
      slope             = is_beyond ? m * decay : slope;
      return is_beyond ? last + (middle - last) * decay : limit;
    }

    /** update() of points of which those of @p failing are not elastic. */
    void fail(PointLanes<lanes, dim> &points, const Bits &present,
              const Bits &failing, const Value &weight,
              DissipationLanes<lanes> &lost) const
    {
      const PointArrays<dim> &at = points.arrays;
      const double kn = law.normal_stiffness, ks = law.shear_stiffness;
      const Value none{};
      const Value sigma_old = F::load(points.of(at.normal_traction));
      const Slips tau_old   = Slips::load(points.slips_of(at.shear_traction));
      const Value bond_old  = F::load(points.of(at.internal[bond]));
      const Value crack_old = F::load(points.of(at.internal[crack_opening]));
      const Bits intact     = points.load_state() == 0;
      const Value opening_trial = points.opening;
      Value plastic_opening     = F::load(points.of(at.plastic_opening));
      Value sigma               = points.sigma;
      const Slips tau           = points.tau;
      const Value size          = magnitude(tau);

      // The crack closes first, then the joint is elastic or fails.
      const Value gap        = plastic_opening - opening_trial;
      const Bits closes      = failing & (gap > 0.) & (crack_old > 0.);
      const Value closed     = closes ? F::minimum(gap, crack_old) : none;
      const Value crack_left = crack_old - closed;
      Bits sticks            = ~failing;
      if (F::any(closes))
      {
        plastic_opening = closes
                              ? (closed < crack_old ? opening_trial
                                                    : plastic_opening - closed)
                              : plastic_opening;
        sigma = closes ? kn * (opening_trial - plastic_opening) : sigma;
        sticks |= closes & is_elastic(points, sigma, tau, bond_old, crack_left);
      }

      const Slips direction = direction_of(tau, size);
      const Flow flow
          = find_flow(points, present & ~sticks, sigma, size, bond_old);
      const Bits flows = flow.found;
      const Bits done  = present & (sticks | flows);

      const Value sigma_new  = flows ? flow.sigma : sigma;
      const Slips tau_new    = Slips::choose(flows, flow.tau * direction, tau);
      const Value sigma_mean = 0.5 * (sigma_old + sigma_new);
      const Value slid = 0.5 * (dot(tau_old, direction) + flow.tau) * flow.slip;
      const Value cohesion_lost = F::minimum(
          slid, 0.5 * law.cohesion * (bond_old + flow.bond) * flow.slip);
      const Value opened = flows ? flow.opening : none;
      lost.friction += weight * (flows ? slid - cohesion_lost : none);
      lost.fracture += weight
                       * ((flows ? sigma_mean * opened + cohesion_lost : none)
                          - (done ? sigma_mean * closed : none));
      const Bits crushes = flow.cap > 0.;
      if (F::any(crushes))
      {
        const Value tau_mean = 0.5 * (dot(tau_old, direction) + flow.tau);
        lost.crushing
            += weight
               * (crushes ? flow.cap
                                * (sigma_mean
                                       * (2. * law.cap.normal * sigma_new
                                          + law.cap.offset)
                                   + tau_mean * (2. * law.cap.shear) * flow.tau)
                          : none);
        F::store(points.of(at.internal[crushing]), flow.crushing, crushes);
      }

      const Value crack_new
          = law.cracks_close ? crack_left + opened : crack_left;
      Bits state = sticks ? elastic_state(sigma)
                          : (flow.opening > 0. ? fill(JointState::open)
                             : flow.slip > 0.  ? fill(JointState::slipping)
                                               : fill(JointState::slipped));
      state      = (intact
               & (sticks | ~((flow.opening > 0.) | (flow.slip > 0.) | crushes)))
                       ? fill(JointState::intact)
                       : state;
      state      = (closes & (crack_new > 0.)) ? fill(JointState::open) : state;

      points.sigma = sigma_new;
      points.tau   = tau_new;
      points.store_tractions(done);
      points.store_state(state, done);
      F::store(points.of(at.plastic_opening),
               flows ? opening_trial - sigma_new / kn : plastic_opening,
               done & (closes | flows));
      (points.slip - tau_new / ks)
          .store(points.slips_of(at.plastic_slip), flows);
      F::store(points.of(at.internal[bond]), flow.bond, flows);
      F::store(points.of(at.internal[crack_opening]), crack_new,
               done & (closes | flows));

      const unsigned int rest = F::set_lanes(present & ~done);
      for (int l = 0; l < lanes && rest >> l != 0; ++l)
        if (rest >> l & 1)
          update_point(law, points, l, weight[l], lost);
    }

    /** The flow from trial tractions of the points of @p asked, where there is
        no dilation and no corner, or nothing but crushing. */
    QUOIN_INLINE Flow find_flow(const PointLanes<lanes, dim> &points,
                                const Bits &asked, const Value &sigma,
                                const Value &tau, const Value &bond_start) const
    {
      const Value strength
          = law.cohesion * bond_start - sigma * friction_at(bond_start);
      const Bits opens = sigma > law.tension * bond_start;
      const Bits slips = tau > strength;
      Flow flow{ sigma, tau, Value{}, Value{}, bond_start, Value{}, Value{} };
      if (law.dilation == 0.)
      {
        const Bits slides = asked & slips & ~opens;
        if (F::any(slides))
          slide(points, slides, sigma, tau, bond_start, flow);
        if (F::any(asked & opens))
          iterate(points, asked & opens, slips, sigma, tau, bond_start, flow);
      }
      // With dilation a crossed strength comes first, see
      // CompositeReturnMap::end().
      Bits left = asked & ~flow.found;
      if (law.dilation != 0.)
        left &= ~(opens | slips);
      if (has_cap && F::any(left))
        crush(points, left, sigma, tau, bond_start, flow);
      return flow;
    }

    QUOIN_INLINE Value tolerance(const Value &sigma) const
    {
      return 4. * std::numeric_limits<double>::epsilon()
             * (law.tension + law.cohesion + F::absolute(sigma));
    }

    /** See CompositeReturnMap::slide(). */
    QUOIN_INLINE void slide(const PointLanes<lanes, dim> &points,
                            const Bits &asked, const Value &sigma,
                            const Value &tau, const Value &bond_start,
                            Flow &flow) const
    {
      const double ks   = law.shear_stiffness;
      const Value most  = tolerance(sigma);
      const Value drive = tau + sigma * law.residual_friction;
      const Value loss
          = law.cohesion - sigma * (law.friction - law.residual_friction);
      Value slip{}, bond_now = bond_start;
      Bits active = asked, found{};
      for (unsigned int i = 0; i < 10; ++i)
      {
        const Value excess = drive - ks * slip - loss * bond_now;
        if (i > 0)
        {
          const Bits ends = active & (F::absolute(excess) <= most);
          found |= ends;
          active &= ~ends;
          if (!F::any(active))
            break;
        }
        const Value slope = ks - slip_softening * loss * bond_now;
        const Value next  = slip + excess / slope;
        active &= (slope > 0.) & (next >= 0.) & (ks * next <= tau);
        slip     = active ? next : slip;
        bond_now = active ? bond_start * F::exponential(-slip_softening * slip)
                          : bond_now;
      }
      const Value left = tau - ks * slip;
      found &= sigma - law.tension * bond_now <= most;
      found &= within_cap(points, sigma, left * left, found);
      flow.tau  = found ? left : flow.tau;
      flow.slip = found ? slip : flow.slip;
      flow.bond = found ? bond_now : flow.bond;
      flow.found |= found;
    }

    /** See CompositeReturnMap::crush(). */
    QUOIN_INLINE void crush(const PointLanes<lanes, dim> &points,
                            const Bits &asked, const Value &sigma_trial,
                            const Value &tau_trial, const Value &bond_now,
                            Flow &flow) const
    {
      const CompositeCap &cap = law.cap;
      const Value crushing_start
          = F::load(points.of(points.arrays.internal[crushing]));
      const Value start = cap_limit(crushing_start);
      const Value load  = (cap.normal * sigma_trial + cap.offset) * sigma_trial
                         + cap.shear * tau_trial * tau_trial;
      Bits active = asked & (load > start * start);
      if (!F::any(active))
        return;
      const Value none{};
      Value by_sigma, by_tau, sigma, tau, normal, shear, norm, crushing_now;
      const auto relax_by = [&](const Value &y) __attribute__((always_inline))
      {
        by_sigma     = 1. / (1. + y);
        by_tau       = 1. / (1. + crush_ratio * y);
        sigma        = cap_centre + by_sigma * (sigma_trial - cap_centre);
        tau          = by_tau * tau_trial;
        normal       = 2. * cap.normal * sigma + cap.offset;
        shear        = 2. * cap.shear * tau;
        norm         = F::square_root(normal * normal + shear * shear);
        crushing_now = crushing_start + crush_compliance * y * norm;
      };
      Value y = active ? F::square_root(load) / start - 1. : none;
      Bits found{};
      for (unsigned int i = 0; i < 10 && F::any(active); ++i)
      {
        relax_by(y);
        Value slope;
        const Value limit  = cap_limit(crushing_now, slope);
        const Value excess = (cap.normal * sigma + cap.offset) * sigma
                             + cap.shear * tau * tau - limit * limit;
        const Value d_normal = none - by_sigma * normal;
        const Value d_shear  = none - crush_ratio * by_tau * shear;
        const Value d_load
            = by_normal * normal * d_normal + by_shear * shear * d_shear;
        const Value d_norm = (normal * d_normal + shear * d_shear) / norm;
        const Value d_excess
            = d_load
              - 2. * crush_compliance * limit * slope * (norm + y * d_norm);
        active &= d_excess < CompositeReturnMap::steepest_softening * d_load;
        const Value step = excess / d_excess;
        const Bits ends
            = active & (step < y)
              & (step * step * F::maximum(crush_compliance * norm, crushing_now)
                 <= CompositeReturnMap::accurate_step * crushing_now);
        y = active ? (step < y ? y - step : 0.25 * y) : y;
        found |= ends;
        active &= ~ends;
      }
      relax_by(y);
      found &= (sigma - law.tension * bond_now <= tolerance(none))
               & (tau + sigma * friction_at(bond_now) - law.cohesion * bond_now
                  <= tolerance(sigma));
      flow.sigma    = found ? sigma : flow.sigma;
      flow.tau      = found ? tau : flow.tau;
      flow.bond     = found ? bond_now : flow.bond;
      flow.cap      = found ? crush_compliance * y : flow.cap;
      flow.crushing = found ? crushing_now : flow.crushing;
      flow.found |= found;
    }

    /** See CompositeReturnMap::iterate(), of points that open. */
    QUOIN_INLINE void iterate(const PointLanes<lanes, dim> &points,
                              const Bits &asked, const Bits &slips,
                              const Value &sigma_trial, const Value &tau_trial,
                              const Value &bond_start, Flow &flow) const
    {
      const double kn = law.normal_stiffness, ks = law.shear_stiffness;
      const double a = opening_softening, b = slip_softening;
      const Value none{};
      Value sigma = F::minimum(law.tension * bond_start, sigma_trial);
      Value tau
          = slips ? F::minimum(F::maximum(law.cohesion * bond_start
                                              - sigma * friction_at(bond_start),
                                          none),
                               tau_trial)
                  : tau_trial;
      Value opening{}, slip{}, bond_now = bond_start;
      Bits active = asked, found{};
      for (unsigned int i = 0; i < 10; ++i)
      {
        opening       = active ? (sigma_trial - sigma) / kn : opening;
        slip          = active ? (tau_trial - tau) / ks : slip;
        const Value u = a * opening, v = b * slip;
        const Value growth = F::square_root(u * u + v * v);
        bond_now = active ? bond_start * F::exponential(-growth) : bond_now;
        const Value friction = friction_at(bond_now);
        const Value f1       = sigma - law.tension * bond_now;
        const Value f2       = tau + sigma * friction - law.cohesion * bond_now;
        const Value most     = tolerance(sigma);
        const Bits ends      = active & (F::absolute(f1) <= most)
                          & (~slips | (F::absolute(f2) <= most));
        found |= ends & (f2 <= most);
        active &= ~ends;
        if (!F::any(active))
          break;

        const Value factor     = growth > 0. ? bond_now / growth : none;
        const Value bond_sigma = factor * a * u / kn;
        const Value bond_tau   = factor * b * v / ks;
        const Value f2_bond
            = sigma * (law.friction - law.residual_friction) - law.cohesion;
        const Value J11 = 1. - law.tension * bond_sigma;
        const Value J12 = -law.tension * bond_tau;
        const Value J21 = slips ? friction + f2_bond * bond_sigma : none;
        const Value J22 = slips ? 1. + f2_bond * bond_tau : none + 1.;
        const Value r2  = slips ? f2 : none;
        const Value determinant = J11 * J22 - J12 * J21;
        const Value sigma_next  = sigma - (J22 * f1 - J12 * r2) / determinant;
        const Value tau_next    = tau - (J11 * r2 - J21 * f1) / determinant;
        active &= (sigma_next <= sigma_trial) & (tau_next >= 0.)
                  & (tau_next <= tau_trial);
        sigma = active ? sigma_next : sigma;
        tau   = active ? tau_next : tau;
      }
      found &= within_cap(points, sigma, tau * tau, found);
      flow.sigma   = found ? sigma : flow.sigma;
      flow.tau     = found ? tau : flow.tau;
      flow.opening = found ? opening : flow.opening;
      flow.slip    = found ? slip : flow.slip;
      flow.bond    = found ? bond_now : flow.bond;
      flow.found |= found;
    }

    const CompositeLaw law;
    const double opening_softening, slip_softening;
    const bool has_cap;
    // Constants of the cap, by which points need not divide then; they have no
    // meaning without a cap.
    const double peak_rate, width_rate;                     /**< [1/m] */
    const double crush_compliance, crush_ratio, cap_centre; /**< see crush() */
    const double by_normal, by_shear; /**< 1/(2 Cnn), 1/(2 Css) [-] */
    // What points that stick need, in all lanes: registers are too few.
    const Value normal_stiffness, shear_stiffness, tension, cohesion;
    const Value residual_friction, friction_loss;
    const Value cap_normal, cap_offset, cap_shear, lowest_load;
  };
} // namespace quoin

#endif
