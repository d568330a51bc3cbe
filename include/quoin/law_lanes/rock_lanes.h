// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_law_lanes_rock_lanes_h
#define quoin_law_lanes_rock_lanes_h

#include <quoin/joint_laws/rock_point.h>
#include <quoin/joints/joint_lanes.h>

#include <limits>

// rock_point.h for several points at once.

namespace quoin
{
  /** A number in each lane, and its derivative by the closure there. */
  template <int lanes>
  struct ClosureDual
  {
    using Value = typename Lanes<lanes>::Value;
    using Bits  = typename Lanes<lanes>::Bits;

    Value value{}, by{};

    static QUOIN_INLINE ClosureDual choose(const Bits &mask,
                                           const ClosureDual &a,
                                           const ClosureDual &b)
    {
      return { mask ? a.value : b.value, mask ? a.by : b.by };
    }
    friend QUOIN_INLINE ClosureDual operator+(const ClosureDual &a,
                                              const ClosureDual &b)
    {
      return { a.value + b.value, a.by + b.by };
    }
    friend QUOIN_INLINE ClosureDual operator-(const ClosureDual &a,
                                              const ClosureDual &b)
    {
      return { a.value - b.value, a.by - b.by };
    }
    friend QUOIN_INLINE ClosureDual operator*(const ClosureDual &a,
                                              const ClosureDual &b)
    {
      return { a.value * b.value, a.by * b.value + a.value * b.by };
    }
    friend QUOIN_INLINE ClosureDual operator/(const ClosureDual &a,
                                              const ClosureDual &b)
    {
      const Value inverse = 1. / b.value, value = a.value * inverse;
      return { value, (a.by - value * b.by) * inverse };
    }
    /** @p factor: a number, or one for each lane. */
    template <typename Factor>
    friend QUOIN_INLINE ClosureDual operator*(const Factor &factor,
                                              const ClosureDual &a)
    {
      return { factor * a.value, factor * a.by };
    }
  };

  /** Places in RockPoint::internal. */
  struct RockInternal
  {
    static constexpr unsigned int worn_slip = 0, dilated = 1, reload = 2,
                                  friction = 3;
  };

  /** RockFlow, and the pressure and the shear stiffness that belong to it. */
  template <int lanes, int dim>
  struct RockFlowLanes
  {
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    Value pressure, stiffness;
    Slips shear_traction;
    ClosureDual<lanes> opening;
    Value wear, reload;
    Bits slips;

    static QUOIN_INLINE RockFlowLanes choose(const Bits &mask,
                                             const RockFlowLanes &a,
                                             const RockFlowLanes &b)
    {
      return { mask ? a.pressure : b.pressure,
               mask ? a.stiffness : b.stiffness,
               Slips::choose(mask, a.shear_traction, b.shear_traction),
               ClosureDual<lanes>::choose(mask, a.opening, b.opening),
               mask ? a.wear : b.wear,
               mask ? a.reload : b.reload,
               mask ? a.slips : b.slips };
    }
  };

  template <int lanes, int dim>
  struct RockStepLanes
  {
    typename LaneFunctions<lanes>::Value closure;
    RockFlowLanes<lanes, dim> flow;
  };

  /**
   * Newton's iteration of find_step() from the @p step without it, for the
   * points of @p coupled; takes those that have no root out of it. Lanes that
   * have converged stay where they are while others go on.
   */
  template <int lanes, int dim, typename Flows, typename Value, typename Bits>
  QUOIN_INLINE void couple(const Flows &flows, const Value &start,
                           Bits &coupled, RockStepLanes<lanes, dim> &step)
  {
    using F                      = LaneFunctions<lanes>;
    using Dual                   = ClosureDual<lanes>;
    constexpr double least_slope = 0.1;
    constexpr double infinity    = std::numeric_limits<double>::infinity();
    constexpr unsigned int most_iterations = 60;
    const Value none{}, one = none + 1.;
    const Value first     = step.flow.opening.value;
    const Value uncoupled = F::maximum(start, none);
    const Bits back       = first < 0.;
    Value low             = back ? none : uncoupled,
          high            = back ? uncoupled : infinity + none;
    // The flow at V0 tells how the next one differs, unless there is no
    // pressure there.
    Value closure
        = (~back & (start > 0.))
              ? start + first / F::maximum(one, one - step.flow.opening.by)
              : step.closure;
    // Newton's next step squares the error, but only away from where slip ends.
    const Value size = F::absolute(start) + F::absolute(first);
    const Value precision
        = F::maximum(F::minimum(1e-10 * size, 1e-3 * F::absolute(first)),
                     4. * std::numeric_limits<double>::epsilon() * size);
    Bits active = coupled;
    for (unsigned int i = 0; i < most_iterations && F::any(active); ++i)
    {
      const Dual trial{ closure, one };
      const Dual opening  = flows.at(trial).opening;
      const Value rest    = closure - start - opening.value;
      const Value slope   = 1. - opening.by;
      const Bits rootless = active & back & (slope < least_slope);
      coupled &= ~rootless;
      active &= ~rootless;
      const Bits above  = rest > 0.;
      high              = above ? closure : high;
      low               = above ? low : closure;
      const Value next  = closure - rest / slope;
      const Bits ends   = F::absolute(rest) <= precision;
      const Value other = high < infinity ? 0.5 * (low + high)
                                          : closure + 2. * F::absolute(rest);
      const Bits inside = ends | ((next > low) & (next < high));
      closure           = active ? (inside ? next : other) : closure;
      active &= ~ends;
    }
    step.closure = coupled ? closure : step.closure;
    step.flow    = RockFlowLanes<lanes, dim>::choose(
           coupled, flows.at(Dual{ closure, one }), step.flow);
  }

  /**
   * find_step() for the points of @p asked, V0 = @p start. @p Flows has the
   * flow at() a closure and the pressure_at() one.
   */
  template <int lanes, int dim, typename Flows, typename Value, typename Bits>
  QUOIN_INLINE RockStepLanes<lanes, dim>
  find_step(const Flows &flows, const Value &start, const Bits &asked)
  {
    using F    = LaneFunctions<lanes>;
    using Dual = ClosureDual<lanes>;
    const Value none{};
    RockStepLanes<lanes, dim> step{
      start, flows.at(Dual{ F::maximum(start, none), none + 1. })
    };
    const Value first = step.flow.opening.value;
    step.closure      = start + first;
    Bits coupled      = asked & (first != 0.) & (step.closure > 0.);
    const Bits back   = first < 0.;
    if (F::any(coupled))
      couple(flows, start, coupled, step);
    // Where slip back closes it without a root, or altogether, the flow is that
    // at V0.
    const Bits at_start = asked & back & ~coupled;
    if (F::any(at_start))
      step.flow.pressure
          = at_start ? flows.pressure_at(step.closure) : step.flow.pressure;
    return step;
  }

  /**
   * take_step() for the points of @p moving; those of @p sticking keep all but
   * their tractions, which are those of @p points. @p stiffness: ks [Pa/m]
   * before, @p friction: RockPoint::friction at the end.
   */
  template <int lanes, int dim, typename Value, typename Bits>
  QUOIN_INLINE void
  take_step(PointLanes<lanes, dim> &points,
            const RockStepLanes<lanes, dim> &step, const Bits &moving,
            const Bits &sticking, const Value &stiffness, const Value &friction,
            const Value &weight, DissipationLanes<lanes> &lost)
  {
    using F         = LaneFunctions<lanes>;
    using Slips     = SlipLanes<lanes, dim>;
    const auto fill = [](const JointState state) __attribute__((always_inline))
    {
      return Bits{} + static_cast<int>(state);
    };
    const PointArrays<dim> &at = points.arrays;
    const Value none{};
    const auto &flow  = step.flow;
    const Bits closed = step.closure >= 0.;

    const Value sigma_old = F::load(points.of(at.normal_traction));
    const Slips tau_old   = Slips::load(points.slips_of(at.shear_traction));
    const Value sigma     = closed ? -flow.pressure : none;
    const Slips tau       = Slips::choose(closed, flow.shear_traction, Slips{});
    const Value opened    = closed ? flow.opening.value : none;

    const Slips elastic = (1. / stiffness) * tau_old;
    const Slips moved
        = points.slip - Slips::load(points.slips_of(at.plastic_slip)) - elastic;
    const Value rubbed
        = 0.5
          * (dot(tau_old + tau, moved) + dot(tau_old, elastic)
             - dot(tau, tau) / flow.stiffness + (sigma_old + sigma) * opened);
    lost.friction += weight * (moving ? rubbed : none);

    const Bits intact = points.load_state() == 0;
    points.sigma      = moving ? sigma : points.sigma;
    points.tau        = Slips::choose(moving, tau, points.tau);
    points.store_tractions(moving | sticking);
    (points.slip - (1. / flow.stiffness) * tau)
        .store(points.slips_of(at.plastic_slip), moving);
    const auto add = [&](double *array, const Value &increment,
                         const Bits &mask) __attribute__((always_inline))
    {
      F::store(points.of(array), F::load(points.of(array)) + increment, mask);
    };
    using Internal = RockInternal;
    add(at.plastic_opening, opened, moving);
    add(at.internal[Internal::dilated], opened, moving);
    add(at.internal[Internal::worn_slip], flow.wear, moving & closed);
    F::store(points.of(at.internal[Internal::reload]),
             closed ? flow.reload : none, moving);
    F::store(points.of(at.internal[Internal::friction]),
             closed ? friction : none, moving);
    const Bits at_rest
        = intact ? fill(JointState::intact) : fill(JointState::slipped);
    points.store_state(
        moving ? (closed ? (flow.slips ? fill(JointState::slipping) : at_rest)
                         : fill(JointState::open))
               : at_rest,
        moving | sticking);
  }
} // namespace quoin

#endif
