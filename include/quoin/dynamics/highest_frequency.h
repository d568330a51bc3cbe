// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_highest_frequency_h
#define quoin_dynamics_highest_frequency_h

#include <quoin/blocks/rigid_blocks.h>
#include <quoin/model/model.h>

#include <vector>

namespace quoin
{
  /** The highest frequency of one stiffness with one set of masses. */
  struct KnownFrequency
  {
    /** First coefficients of the Lanczos iteration [1/s^2]: those of another
        stiffness or other masses are others. */
    double diagonal, beside;
    double squared; /**< omega^2 [1/s^2] */
  };

  /**
   * The largest omega^2 [1/s^2] of K u = omega^2 M u, a little too high rather
   * than too low: K the elastic stiffness of blocks and of intact joints in
   * the reference configuration, or the bound of what contacts may add where
   * displacements are large; M the lumped masses @p mass of the owned nodes
   * [kg], of rigid blocks those of @p rigid_stage.
   *
   * By the Lanczos iteration with the operators themselves, from a random
   * start, without Rayleigh's bound by elements and springs, which joints of
   * different directions and neighbouring cells never reach together. The
   * largest Ritz value is never too high; to it comes the mean error that it
   * has after so many iterations from such a start, whatever the spectrum
   * (@cite KuczynskiWozniakowski1992). Dashpots of joints are not in it.
   * What is in @p known, for the stages of a run, is not computed again; what
   * is new is added there.
   * Collective; the same on all ranks to rounding.
   */
  template <int dim>
  double highest_squared_frequency(const Model<dim> &model,
                                   const std::vector<double> &mass,
                                   const RigidBlockStage &rigid_stage,
                                   std::vector<KnownFrequency> &known);
} // namespace quoin

#endif
