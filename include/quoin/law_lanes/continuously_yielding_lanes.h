// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_law_lanes_continuously_yielding_lanes_h
#define quoin_law_lanes_continuously_yielding_lanes_h

#include <quoin/joint_laws/continuously_yielding_law.h>
#include <quoin/law_lanes/rock_lanes.h>

namespace quoin
{
  /**
   * Each step of each point is in lanes, as there is no elastic range, but for
   * points whose law became weaker: they do it once, in the first step after.
   */
  template <int lanes, int dim>
  class LawLanes<ContinuouslyYieldingLaw, lanes, dim>
  {
  public:
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    explicit LawLanes(const ContinuouslyYieldingLaw &law)
      : law(law), wear_rate(1. / law.roughness),
        initial_friction(std::tan(law.initial_angle)),
        residual_friction(std::tan(law.residual_angle)),
        most_dilation(std::tan(law.initial_angle - law.residual_angle))
    {
    }

    QUOIN_INLINE Bits try_elastic(PointLanes<lanes, dim> &points) const
    {
      points.elastic = Bits{};
      points.sigma   = Value{};
      points.tau     = Slips{};
      return Bits{};
    }

    QUOIN_INLINE void update(PointLanes<lanes, dim> &points,
                             const Bits &present, const Value &weight,
                             DissipationLanes<lanes> &lost) const
    {
      // move() gets a copy, as fail() of CompositeLaw does.
      PointLanes<lanes, dim> all = points;
      move(all, present, weight, lost);
      points.sigma = all.sigma;
      points.tau   = all.tau;
    }

  private:
    using Dual = ClosureDual<lanes>;
    using Flow = RockFlowLanes<lanes, dim>;

    /** See PowerStiffness::at(). */
    static QUOIN_INLINE Dual stiffness_at(const PowerStiffness &stiffness,
                                          const Dual &pressure)
    {
      const Value none{};
      if (stiffness.exponent == 0.)
        return { none + stiffness.reference, none };
      const Value s
          = F::minimum(F::maximum(pressure.value, none + stiffness.lowest),
                       none + stiffness.highest);
      const Bits inside = s == pressure.value;
      const Value k     = stiffness.reference
                      * power(s * (1. / stiffness.reference_traction),
                              stiffness.exponent);
      return { k, inside ? stiffness.exponent * k / s * pressure.by : none };
    }

    /** See PowerClosure::traction(). */
    QUOIN_INLINE Dual pressure_at(const Dual &closure) const
    {
      const PowerClosure &curve = law.closure;
      const Value none{};
      const Value V      = closure.value;
      const double e     = 1. - curve.law.exponent;
      const Value curved = F::minimum(F::maximum(V, none + curve.low_closure),
                                      none + curve.high_closure);
      const Bits low = V <= curve.low_closure, high = V >= curve.high_closure;
      const Value x = (curved - curve.low_closure)
                      * (curve.low_stiffness / curve.law.lowest);
      const Value base = 1. + e * x;
      const Value s    = curve.law.lowest
                      * (e == 0. ? F::exponential(x) : power(base, 1. / e));
      const Value slope = (curve.low_stiffness / curve.law.lowest) * s / base;
      const Value value
          = low ? curve.low_stiffness * V
                : (high ? curve.law.highest
                              + curve.high_stiffness * (V - curve.high_closure)
                        : s);
      const Bits closed = V >= 0.;
      return { closed ? value : none,
               closed ? (low ? none + curve.low_stiffness
                             : (high ? none + curve.high_stiffness : slope))
                            * closure.by
                      : none };
    }

    /** @p a, which is positive, to the power of @p exponent. */
    static QUOIN_INLINE Value power(const Value &a, const double exponent)
    {
      if (exponent == 1.)
        return a;
      if (exponent == 2.)
        return a * a;
      if (exponent == 0.5)
        return F::square_root(a);
      return F::exponential(exponent * F::logarithm(a));
    }

    /** exp(-a), which is nothing beside other numbers long before it becomes
        one that the processor is slow with. */
    static QUOIN_INLINE Value decay(const Value &a)
    {
      return F::exponential(-F::minimum(a, Value{} + 700.));
    }

    /** tan(phi_m) [-] after @p worn slip [m]. */
    QUOIN_INLINE Dual friction_after(const Dual &worn) const
    {
      // The slip of new contacts is infinite.
      const Value left = (law.initial_angle - law.residual_angle)
                         * decay(worn.value * wear_rate);
      Value sine, cosine;
      F::sine_cosine(law.residual_angle + left, sine, cosine);
      const Value tangent = sine / cosine;
      return { tangent,
               -(1. + tangent * tangent) * left * wear_rate * worn.by };
    }

    /** What ContinuouslyYieldingLaw::flow() of points needs, and that at a
        closure. */
    class Flows
    {
    public:
      QUOIN_INLINE Flows(const LawLanes &laws,
                         const PointLanes<lanes, dim> &points)
        : laws(laws)
      {
        const PointArrays<dim> &at = points.arrays;
        const Value none{};
        const Value sigma = F::load(points.of(at.normal_traction));
        before            = Slips::load(points.slips_of(at.shear_traction));
        size_before       = magnitude(before);
        stiffness_before
            = stiffness_at(laws.law.stiffness, Dual{ -sigma, none }).value;
        const Slips elastic = (1. / stiffness_before) * before;
        moved = points.slip - Slips::load(points.slips_of(at.plastic_slip))
                - elastic;
        turns = dot(before, moved + ContinuouslyYieldingLaw::rounding * elastic)
                < 0.;
        if constexpr (dim == 2)
          nearest = none;
        else
          nearest = F::absolute(before.component[0] * moved.component[1]
                                - before.component[1] * moved.component[0])
                    / magnitude(moved);
        worn     = F::load(points.of(at.internal[RockInternal::worn_slip]));
        reload   = F::load(points.of(at.internal[RockInternal::reload]));
        friction = laws.friction_after(Dual{ worn, none }).value;
        // See ContinuouslyYieldingLaw::lowered().
        became_weaker
            = (size_before > 0.) & (sigma < 0.)
              & (friction < (1. - 1e-12)
                                * F::load(points.of(
                                    at.internal[RockInternal::friction])));
      }

      QUOIN_INLINE Value pressure_at(const Value &closure) const
      {
        return laws.pressure_at(Dual{ closure, Value{} }).value;
      }

      QUOIN_INLINE Flow at(const Dual &closure) const
      {
        const Value none{};
        const Dual pressure   = laws.pressure_at(closure);
        const Dual ks         = stiffness_at(laws.law.stiffness, pressure);
        const Slips trial     = before + ks.value * moved;
        const Value length    = magnitude(trial);
        const Slips direction = direction_of(trial, length);
        const Dual size{ length, dot(direction, moved) * ks.by };
        // By the wear in the middle of the step.
        const Load first  = load(friction * pressure, ks, trial, size);
        const Dual middle = laws.friction_after(
            Dual{ worn + 0.5 * first.wear.value, 0.5 * first.wear.by });
        const Load result = load(middle * pressure, ks, trial, size);

        // tan(i), by the difference of two angles whose tangents are known.
        const double residual = laws.residual_friction;
        const Dual sum        = pressure + residual * result.tau;
        const Dual at_most{ none + laws.most_dilation, none };
        const Dual at_zero{
          (middle.value - residual) / (1. + residual * middle.value), none
        };
        const Bits steep
            = result.tau.value >= pressure.value * laws.initial_friction;
        const Dual dilation = Dual::choose(
            steep, Dual::choose(pressure.value > 0., at_most, at_zero),
            (result.tau - residual * pressure) / sum);
        return {
          pressure.value,
          ks.value,
          Slips::choose(result.is_loaded, result.tau.value * direction, trial),
          Dual::choose(dilation.value > 0., dilation * result.wear, Dual{}),
          result.wear.value,
          result.reload,
          result.slips
        };
      }

      Slips before, moved;
      Value size_before, stiffness_before;
      Bits became_weaker;
      Value worn;

    private:
      /** See ContinuouslyYieldingLaw::load(); sizes of shear tractions. */
      struct Load
      {
        Dual tau, wear;
        Value reload;
        Bits is_loaded, slips;
      };
      QUOIN_INLINE Load load(const Dual &strength, const Dual &ks,
                             const Slips &trial, const Dual &size) const
      {
        const Value none{}, one = none + 1.;
        const Bits is_loaded = turns ? dot(trial, moved) > 0. : size.value > 0.;
        const Bits is_strong = strength.value > 0.;
        const Dual start     = Dual::choose(
                turns, Dual::choose(is_loaded, Dual{ nearest, none }, size),
                Dual{ size_before, none });
        Dual again = Dual::choose(is_strong, start / strength, Dual{});
        again      = Dual::choose(
                 again.value > ContinuouslyYieldingLaw::largest_reload,
                 Dual{ none + ContinuouslyYieldingLaw::largest_reload, none },
                 again);
        again = Dual::choose(turns, again, Dual{ reload, none });

        // See ContinuouslyYieldingLaw::loaded().
        const Dual growth = size - start;
        const Dual stiff  = again * strength - start;
        const Bits bends  = stiff.value > 0.;
        const Dual tau    = Dual::choose(bends, start + stiff, start);
        const Dual rest   = Dual::choose(bends, growth - stiff, growth);
        const Dual way    = rest / (strength * (Dual{ one, none } - again));
        const Value left  = decay(way.value);
        const Dual yields
            = strength - (strength - tau) * Dual{ left, -left * way.by };
        const Dual reached = Dual::choose(
            (stiff.value > growth.value) | (growth.value < 0.), start + growth,
            Dual::choose(is_strong, yields, Dual{}));
        const Dual lost = size - reached;
        return { Dual::choose(is_loaded, reached, size),
                 Dual::choose(is_loaded, lost / ks, Dual{}), again.value,
                 is_loaded,
                 is_loaded & (growth.value > 0.)
                     & (lost.value > 0.5 * growth.value) };
      }

      const LawLanes &laws;
      Bits turns;
      Value nearest, reload, friction;
    };

    void move(PointLanes<lanes, dim> &points, const Bits &present,
              const Value &weight, DissipationLanes<lanes> &lost) const
    {
      const Flows flows(*this, points);
      const Bits weaker = present & flows.became_weaker;
      const Bits moving = present & ~weaker;
      const Value start
          = F::load(points.of(points.arrays.plastic_opening)) - points.opening;
      const auto step = find_step<lanes, dim>(flows, start, moving);
      take_step(
          points, step, moving, Bits{}, flows.stiffness_before,
          friction_after(Dual{ flows.worn + step.flow.wear, Value{} }).value,
          weight, lost);
      const unsigned int rest = F::set_lanes(weaker);
      for (int l = 0; l < lanes && rest >> l != 0; ++l)
        if (rest >> l & 1)
          update_point(law, points, l, weight[l], lost);
    }

    const ContinuouslyYieldingLaw law;
    const double wear_rate;         /**< 1/R [1/m] */
    const double initial_friction;  /**< tan(phi_m0) */
    const double residual_friction; /**< tan(phi) */
    const double most_dilation;     /**< tan(phi_m0 - phi) */
  };
} // namespace quoin

#endif
