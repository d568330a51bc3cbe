// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_added_mass_h
#define quoin_dynamics_added_mass_h

#include <quoin/blocks/rigid_blocks.h>
#include <quoin/blocks/stable_time_step.h>
#include <quoin/model/model.h>
#include <quoin/structures/beam_motion.h>

#include <string>
#include <vector>

namespace quoin
{
  /** What mass scaling changes in a model. */
  struct AddedMass
  {
    double share  = 0.; /**< added mass by the mass of the model [-] */
    double bodies = 0.; /**< share of nodes and rigid blocks made heavier [-] */
    double factor = 1.; /**< largest one of the mass of any of them [-] */
    /** Blocks and beams made heavier by more than a twentieth, so that their
        own motions are slower by 2.5 % or more: their number, and their share
        of the mass of the model [-]. */
    unsigned int n_slow = 0;
    double slow_share   = 0.;
    double frequency    = 0.; /**< above it frequencies are lowered [Hz] */

    /** "mass scaling adds ...", for the log. */
    std::string text() const;

    /**
     * A sentence for a stage that follows motion, if mass scaling changes it:
     * there is more than 0.25 % of added mass, or blocks and beams with more
     * than 1 % of the mass move more slowly, or frequencies up to four times
     * @p highest, that of the loads [Hz], are lowered, which waves need that
     * the mesh resolves. Otherwise empty.
     */
    std::string warning(double highest) const;
  };

  /**
   * What it changes if the local nodes of @p model have the masses @p mass
   * [kg] and its rigid blocks the mass @p factors [-], so that the critical
   * step is @p time_step [s]; @p beams: see BeamMotion::masses(). Collective.
   */
  template <int dim>
  AddedMass find_added_mass(const Model<dim> &model,
                            const std::vector<double> &mass,
                            const std::vector<double> &factors,
                            const BeamMasses &beams, double time_step);

  /** Masses of a stage, with which its critical step is at least the one that
      mass scaling is to reach. */
  template <int dim>
  struct ScaledMasses
  {
    /** @p stability: of @p model; @p time_step: that step [s]; 0: nothing is
        scaled. @p beams: of the run, or null; finds their masses, too.
        Collective. */
    ScaledMasses(const Model<dim> &model, const StableTimeStep<dim> &stability,
                 double time_step, BeamMotion *beams, const State<dim> &state);

    std::vector<double> nodes;        /**< of local nodes [kg] */
    std::vector<double> rigid_factor; /**< of the mass of rigid blocks [-] */
    AddedMass added;
    /** Largest one of beams and of the nodes to which they are tied
        [1/s^2]. */
    double beam_eigenvalue = 0.;

  private:
    void find_beam_masses(const StableTimeStep<dim> &stability,
                          double time_step, BeamMotion &beams,
                          const State<dim> &state);
  };

  template <>
  void ScaledMasses<2>::find_beam_masses(const StableTimeStep<2> &stability,
                                         double time_step, BeamMotion &beams,
                                         const State<2> &state);
} // namespace quoin

#endif
