// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_law_lanes_slip_weakening_lanes_h
#define quoin_law_lanes_slip_weakening_lanes_h

#include <quoin/joint_laws/slip_weakening_law.h>
#include <quoin/joints/joint_lanes.h>

namespace quoin
{
  template <int lanes, int dim>
  class LawLanes<SlipWeakeningLaw, lanes, dim>
  {
  public:
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    explicit LawLanes(const SlipWeakeningLaw &law)
      : law(law), weakening_rate(1. / law.weakening_slip)
    {
    }

    QUOIN_INLINE Bits try_elastic(PointLanes<lanes, dim> &points) const
    {
      const PointArrays<dim> &at = points.arrays;
      const Bits state           = points.load_state();
      points.sigma
          = law.normal_stiffness
            * (points.opening - F::load(points.of(at.plastic_opening)));
      points.tau
          = law.shear_stiffness
            * (points.slip - Slips::load(points.slips_of(at.plastic_slip)));
      points.elastic
          = (points.sigma <= 0.)
            & is_within(points.tau,
                        strength(points.sigma,
                                 F::load(points.of(at.internal[slipped]))));
      return points.elastic
             & ((state == number(JointState::intact))
                | (state == number(JointState::slipped)));
    }

    QUOIN_INLINE void update(PointLanes<lanes, dim> &points,
                             const Bits &present, const Value &weight,
                             DissipationLanes<lanes> &lost) const
    {
      const PointArrays<dim> &at = points.arrays;
      const double ks            = law.shear_stiffness;
      const Value none{};
      const Bits intact  = points.load_state() == number(JointState::intact);
      const Bits failing = present & ~points.elastic;
      Bits state
          = intact ? fill(JointState::intact) : fill(JointState::slipped);
      if (F::any(failing))
      {
        // See SlipWeakeningLaw::update_failing().
        const Value sigma_old = F::load(points.of(at.normal_traction));
        const Slips tau_old   = Slips::load(points.slips_of(at.shear_traction));
        const Slips plastic_slip
            = Slips::load(points.slips_of(at.plastic_slip));
        const Value slipped_old = F::load(points.of(at.internal[slipped]));
        const Value sigma       = points.sigma;
        const Slips tau         = points.tau;
        const Value size        = magnitude(tau);
        const Slips direction   = direction_of(tau, size);
        const Bits open         = sigma > 0.;

        // See SlipWeakeningLaw::find_slip(). New contacts have slipped without
        // end, which leaves them the residual strength.
        const Value weakening = weakening_rate * loss(sigma);
        const Value on_the_way
            = (size - strength(sigma, slipped_old)) / (ks - weakening);
        const Value dp       = ((weakening < ks)
                          & (slipped_old + on_the_way <= law.weakening_slip))
                                   ? on_the_way
                                   : (size - residual_strength(sigma)) / ks;
        const Slips tau_slid = tau - dp * (ks * direction);

        const Value work   = 0.5 * dot(tau_old + tau_slid, direction) * dp;
        const Value rubbed = F::minimum(
            work,
            0.5 * (residual_strength(sigma_old) + residual_strength(sigma))
                * dp);
        const Value unloaded = 0.5 * dot(tau_old, points.slip - plastic_slip);
        lost.friction += weight * (failing ? (open ? unloaded : rubbed) : none);
        lost.fracture += weight * ((failing & ~open) ? work - rubbed : none);

        points.sigma = (failing & open) ? none : sigma;
        points.tau   = Slips::choose(failing,
                                     Slips::choose(open, Slips{}, tau_slid), tau);
        Slips::choose(open, points.slip, plastic_slip + dp * direction)
            .store(points.slips_of(at.plastic_slip), failing);
        F::store(points.of(at.internal[slipped]), slipped_old + dp,
                 failing & ~open);
        state = failing ? (open ? fill(JointState::open)
                                : fill(JointState::slipping))
                        : state;
      }
      points.store_tractions(present);
      points.store_state(state, present);
    }

  private:
    /** Place in SlipWeakeningPoint::internal. */
    static constexpr unsigned int slipped = 0;

    static constexpr int number(const JointState state)
    {
      return static_cast<int>(state);
    }
    static QUOIN_INLINE Bits fill(const JointState state)
    {
      return Bits{} + number(state);
    }

    QUOIN_INLINE Value residual_strength(const Value &sigma) const
    {
      return law.residual_cohesion - sigma * law.residual_friction;
    }
    QUOIN_INLINE Value loss(const Value &sigma) const
    {
      return law.cohesion - law.residual_cohesion
             - sigma * (law.friction - law.residual_friction);
    }
    QUOIN_INLINE Value strength(const Value &sigma,
                                const Value &slipped_now) const
    {
      const Value left = F::maximum(Value{}, 1. - slipped_now * weakening_rate);
      return residual_strength(sigma) + left * loss(sigma);
    }

    const SlipWeakeningLaw law;
    const double weakening_rate; /**< 1/D_c [1/m] */
  };
} // namespace quoin

#endif
