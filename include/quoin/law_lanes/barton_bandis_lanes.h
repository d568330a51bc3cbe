// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_law_lanes_barton_bandis_lanes_h
#define quoin_law_lanes_barton_bandis_lanes_h

#include <quoin/joint_laws/barton_bandis_law.h>
#include <quoin/law_lanes/rock_lanes.h>

namespace quoin
{
  /**
   * All of the law is in lanes: what sticks by its basic friction, and the flow
   * of the rest with its dilation.
   */
  template <int lanes, int dim>
  class LawLanes<BartonBandisLaw, lanes, dim>
  {
  public:
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    explicit LawLanes(const BartonBandisLaw &law)
      : law(law), compliance(1. / law.stiffness), peak_rate(1. / law.peak_slip),
        roughness(law.roughness / std::log(10.)),
        wall_logarithm(std::log(law.wall_strength)),
        least_pressure(
            std::max(law.wall_strength
                         * std::exp((law.residual_angle - law.largest_angle)
                                    / roughness),
                     std::numeric_limits<double>::min())),
        basic_friction(std::tan(law.residual_angle)),
        curve_rate(1. / law.closure.limit)
    {
    }

    QUOIN_INLINE Bits try_elastic(PointLanes<lanes, dim> &points) const
    {
      const PointArrays<dim> &at = points.arrays;
      const Value none{}, one = none + 1.;
      const Value closure = closure_of(points);
      const Value pressure
          = pressure_at(Dual{ F::maximum(closure, none), one }).value;
      points.sigma = -pressure;
      points.tau
          = law.stiffness
            * (points.slip - Slips::load(points.slips_of(at.plastic_slip)));
      const Value size  = magnitude(points.tau);
      const Value worn  = worn_share(points, size);
      const Bits closed = closure >= 0.;

      // Those that stick without roughness, and with the first terms of the
      // tangent, stick all the more with them. Most points that stick do; the
      // others are found to stick by flows of their own, which takes the
      // logarithm and the tangent.
      const Value basic = basic_share(worn), angle = law.residual_angle * basic;
      const Value least = basic < 1. ? angle * (1. + angle * angle / 3.)
                                     : none + basic_friction;
      points.elastic    = closed & (law.divisor * size <= pressure * least);
      // A stage may put this law in place of one that remembers friction,
      // which the first step forgets.
      points.elastic
          &= F::load(points.of(at.internal[RockInternal::friction])) == 0.;
      const Bits state = points.load_state();
      return points.elastic
             & ((state == number(JointState::intact))
                | (state == number(JointState::slipped)));
    }

    QUOIN_INLINE void update(PointLanes<lanes, dim> &points,
                             const Bits &present, const Value &weight,
                             DissipationLanes<lanes> &lost) const
    {
      const Bits failing = present & ~points.elastic;
      if (F::any(failing))
      {
        // move() gets a copy, as fail() of CompositeLaw does.
        PointLanes<lanes, dim> all = points;
        move(all, present, failing, weight, lost);
        points.sigma = all.sigma;
        points.tau   = all.tau;
        return;
      }
      const Bits state = points.load_state();
      points.store_tractions(present);
      points.store_state(state == number(JointState::intact)
                             ? state
                             : Bits{} + number(JointState::slipped),
                         present);
    }

  private:
    using Dual = ClosureDual<lanes>;
    using Flow = RockFlowLanes<lanes, dim>;

    static constexpr int number(const JointState state)
    {
      return static_cast<int>(state);
    }

    /** V0 [m], see quoin::find_step(). */
    static QUOIN_INLINE Value closure_of(const PointLanes<lanes, dim> &points)
    {
      return F::load(points.of(points.arrays.plastic_opening)) - points.opening;
    }

    /** See HyperbolicClosure::traction(). */
    QUOIN_INLINE Dual pressure_at(const Dual &closure) const
    {
      const HyperbolicClosure &curve = law.closure;
      const Value none{};
      const Value curved = F::minimum(closure.value, none + curve.end_closure);
      const Bits beyond  = closure.value >= curve.end_closure;
      const Value growth = 1. / (1. - curved * curve_rate);
      const Value slope
          = beyond ? none + curve.largest : curve.first * growth * growth;
      const Value value = curve.first * curved * growth
                          + curve.largest * (closure.value - curved);
      const Bits closed = closure.value >= 0.;
      return { closed ? value : none, closed ? slope * closure.by : none };
    }

    /** Slip that counts by the peak slip, with shear tractions of @p size. */
    QUOIN_INLINE Value worn_share(const PointLanes<lanes, dim> &points,
                                  const Value &size) const
    {
      return (F::load(
                  points.of(points.arrays.internal[RockInternal::worn_slip]))
              + size * compliance)
             * peak_rate;
    }

    /** See BartonBandisLaw::mobilise(). */
    static QUOIN_INLINE Value basic_share(const Value &slip)
    {
      const Value none{};
      return F::minimum(slip * (1. / RoughnessTable::slip[0]), none + 1.);
    }
    static QUOIN_INLINE Value mobilised(const Value &slip)
    {
      using Table             = RoughnessTable;
      constexpr unsigned last = Table::size - 1;
      const Value none{};
      // The slip of new contacts is infinite.
      const Value x = F::minimum(slip, none + Table::slip[last]);
      Value share{}, slope{};
      for (unsigned int i = 0; i < last; ++i)
      {
        const double rise = (Table::share[i + 1] - Table::share[i])
                            / (Table::slip[i + 1] - Table::slip[i]);
        const Bits reached = x >= Table::slip[i];
        share = reached ? none + (Table::share[i] - rise * Table::slip[i])
                        : share;
        slope = reached ? none + rise : slope;
      }
      return x < Table::slip[last] ? share + slope * x : none;
    }

    struct Strength
    {
      Dual friction, dilation; /**< tan of either [-] */
    };
    /** See BartonBandisLaw::strength(). */
    QUOIN_INLINE Strength friction(const Dual &pressure, const Value &basic,
                                   const Value &mobilised_now) const
    {
      const Value none{};
      const Value s
          = F::minimum(F::maximum(pressure.value, none + least_pressure),
                       none + law.wall_strength);
      const Bits inside = s == pressure.value;
      const Value share = roughness * mobilised_now;
      const Dual angle{ share * (wall_logarithm - F::logarithm(s)),
                        inside ? -share * pressure.by / s : none };
      // tan(phi_r + i) and tan(i/2) by sine and cosine of i, or of the share
      // of phi_r on the way to it, where i is zero.
      const Bits rises = basic < 1.;
      const Value base = rises ? none : none + basic_friction;
      Value sine, cosine;
      F::sine_cosine(rises ? law.residual_angle * basic : angle.value, sine,
                     cosine);
      const Value tangent = (base * cosine + sine) / (cosine - base * sine);
      const Value half    = rises ? none : sine / (1. + cosine);
      Strength result{ (1. / law.divisor)
                           * Dual{ tangent,
                                   (1. + tangent * tangent) * angle.by },
                       { half, 0.5 * (1. + half * half) * angle.by } };
      result.dilation = Dual::choose(half > result.friction.value,
                                     result.friction, result.dilation);
      return result;
    }

    /** What BartonBandisLaw::flow() of points needs, and that at a closure. */
    class Flows
    {
    public:
      QUOIN_INLINE Flows(const LawLanes &laws,
                         const PointLanes<lanes, dim> &points)
        : laws(laws), size(magnitude(points.tau)),
          direction(direction_of(points.tau, size))
      {
        const PointArrays<dim> &at = points.arrays;
        const Value worn           = laws.worn_share(points, size);
        basic                      = basic_share(worn);
        mobilised_now              = mobilised(worn);
        const Slips before
            = Slips::load(points.slips_of(at.plastic_slip))
              + laws.compliance
                    * Slips::load(points.slips_of(at.shear_traction));
        away    = growth(direction, before, points.slip);
        dilated = F::load(points.of(at.internal[RockInternal::dilated]));
      }

      QUOIN_INLINE Value pressure_at(const Value &closure) const
      {
        return laws.pressure_at(Dual{ closure, Value{} }).value;
      }

      QUOIN_INLINE Flow at(const Dual &closure) const
      {
        const Value none{};
        const Dual pressure  = laws.pressure_at(closure);
        const Strength share = laws.friction(pressure, basic, mobilised_now);
        const Dual limit     = pressure * share.friction;
        const Bits slips     = size > limit.value;
        const Dual wear      = laws.compliance * (Dual{ size, none } - limit);
        Dual opening         = away * (share.dilation * wear);
        // Back down: no farther than it came up, nor than it is closed.
        const Bits back = away < 0.;
        opening         = Dual::choose(back & (-opening.value > dilated),
                                       Dual{ -dilated, none }, opening);
        opening         = Dual::choose(back & (-opening.value > closure.value),
                                       -1. * closure, opening);
        return { pressure.value,
                 none + laws.law.stiffness,
                 (slips ? limit.value : size) * direction,
                 Dual::choose(slips, opening, Dual{}),
                 slips ? wear.value : none,
                 none,
                 slips };
      }

    private:
      const LawLanes &laws;
      const Value size;
      const Slips direction;
      Value basic, mobilised_now, away, dilated;
    };

    /** update() of points of which those of @p failing are not elastic. */
    void move(PointLanes<lanes, dim> &points, const Bits &present,
              const Bits &failing, const Value &weight,
              DissipationLanes<lanes> &lost) const
    {
      const Flows flows(*this, points);
      const auto step
          = find_step<lanes, dim>(flows, closure_of(points), failing);
      take_step(points, step, failing, present & ~failing,
                Value{} + law.stiffness, Value{}, weight, lost);
    }

    const BartonBandisLaw law;
    const double compliance;     /**< 1/ks [m/Pa] */
    const double peak_rate;      /**< 1/peak slip [1/m] */
    const double roughness;      /**< by the logarithm to the base e [rad] */
    const double wall_logarithm; /**< log(JCS) */
    const double least_pressure; /**< below it phi_r + i is the largest [Pa] */
    const double basic_friction; /**< tan(phi_r) */
    const double curve_rate;     /**< 1/Vm [1/m] */
  };
} // namespace quoin

#endif
