// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_law_lanes_coulomb_lanes_h
#define quoin_law_lanes_coulomb_lanes_h

#include <quoin/joint_laws/coulomb_law.h>
#include <quoin/joints/joint_lanes.h>

namespace quoin
{
  template <int lanes, int dim>
  class LawLanes<CoulombLaw, lanes, dim>
  {
  public:
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    using Bits  = typename F::Bits;
    using Slips = SlipLanes<lanes, dim>;

    explicit LawLanes(const CoulombLaw &law)
      : law(law), peak(law.peak), residual(law.residual),
        normal_stiffness(Value{} + law.normal_stiffness),
        shear_stiffness(Value{} + law.shear_stiffness)
    {
    }

    QUOIN_INLINE Bits try_elastic(PointLanes<lanes, dim> &points) const
    {
      const PointArrays<dim> &at = points.arrays;
      const Bits state           = points.load_state();
      const Bits intact          = state == number(JointState::intact);
      const Value none{};
      const Value tension  = intact ? peak.tension : residual.tension;
      const Value cohesion = intact ? peak.cohesion : residual.cohesion;
      const Value friction = intact ? peak.friction : residual.friction;

      points.sigma
          = normal_stiffness
            * (points.opening - F::load(points.of(at.plastic_opening)));
      points.tau
          = shear_stiffness
            * (points.slip - Slips::load(points.slips_of(at.plastic_slip)));
      points.elastic
          = (points.sigma <= tension)
            & is_within(points.tau,
                        F::maximum(none, cohesion - points.sigma * friction));
      return points.elastic & (intact | (state == number(JointState::slipped)));
    }

    QUOIN_INLINE void update(PointLanes<lanes, dim> &points,
                             const Bits &present, const Value &weight,
                             DissipationLanes<lanes> &lost) const
    {
      const PointArrays<dim> &at = points.arrays;
      const double kn = law.normal_stiffness, ks = law.shear_stiffness;
      const double tension  = law.residual.tension;
      const double friction = law.residual.friction;
      const Value none{};
      const Bits intact  = points.load_state() == number(JointState::intact);
      const Bits failing = present & ~points.elastic;
      Bits state         = intact ? none_of_state : fill(JointState::slipped);
      if (F::any(failing))
      {
        const Value sigma_old = F::load(points.of(at.normal_traction));
        const Slips tau_old   = Slips::load(points.slips_of(at.shear_traction));
        const Slips plastic_slip
            = Slips::load(points.slips_of(at.plastic_slip));
        const Value plastic_opening = F::load(points.of(at.plastic_opening));
        const Value sigma           = points.sigma;
        const Slips tau             = points.tau;
        const Bits open             = sigma > tension;

        // See CoulombLaw::update_failing().
        const Value opened = (0.5 * (sigma_old + tension) * (sigma - sigma_old)
                              + 0.5 * sigma_old * sigma_old
                              - tension * (sigma - 0.5 * tension))
                             / kn;
        const Value unloaded = dot(0.5 * tau_old, points.slip - plastic_slip);

        const Value size      = magnitude(tau);
        const Slips direction = direction_of(tau, size);
        Value psi{};
        if (law.dilation != 0.)
          psi = magnitude(points.slip) < law.critical_shear_displacement
                    ? law.dilation
                          * growth(direction, plastic_slip + tau_old / ks,
                                   points.slip)
                    : none;
        const Value excess = size - law.residual.cohesion + sigma * friction;
        Value stiffness    = ks + kn * psi * friction;
        stiffness          = stiffness > 0.1 * ks ? stiffness : none + ks;
        const Value dp
            = F::minimum(F::maximum(none, excess) / stiffness, size / ks);
        const Value sigma_slid = sigma - kn * psi * dp;
        const Slips tau_slid   = tau - dp * (ks * direction);
        const Value rubbed     = 0.5
                             * (dot(tau_old + tau_slid, direction)
                                + (sigma_old + sigma_slid) * psi)
                             * dp;

        lost.friction
            += weight
               * (failing ? (open ? (intact ? none : unloaded) : rubbed)
                          : none);
        lost.fracture
            += weight * ((failing & open & intact) ? opened + unloaded : none);

        const Value opening_slid = plastic_opening + psi * dp;
        const Slips slip_slid    = plastic_slip + dp * direction;
        points.sigma = failing ? (open ? none + tension : sigma_slid) : sigma;
        points.tau   = Slips::choose(failing,
                                     Slips::choose(open, Slips{}, tau_slid), tau);
        Slips::choose(open, points.slip, slip_slid)
            .store(points.slips_of(at.plastic_slip), failing);
        F::store(points.of(at.plastic_opening), opening_slid, failing & ~open);
        state = failing ? (open ? fill(JointState::open)
                                : fill(JointState::slipping))
                        : state;
      }
      points.store_tractions(present);
      points.store_state(state, present);
    }

  private:
    /** A strength in all lanes. */
    struct Strength
    {
      explicit Strength(const JointStrength &strength)
        : tension(Value{} + strength.tension),
          cohesion(Value{} + strength.cohesion),
          friction(Value{} + strength.friction)
      {
      }
      Value tension, cohesion, friction;
    };

    static constexpr Bits none_of_state{};

    static constexpr int number(const JointState state)
    {
      return static_cast<int>(state);
    }
    static QUOIN_INLINE Bits fill(const JointState state)
    {
      return Bits{} + number(state);
    }

    const CoulombLaw law;
    // In all lanes, as registers are too few to keep them there.
    const Strength peak, residual;
    const Value normal_stiffness, shear_stiffness;
  };
} // namespace quoin

#endif
