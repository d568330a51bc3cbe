// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beam_equilibrium_h
#define quoin_structures_beam_equilibrium_h

#include <quoin/structures/liner_interface.h>

#include <Eigen/Dense>

#include <vector>

namespace quoin
{
  /** What a beam in equilibrium does to the blocks at its interface. */
  struct BeamReaction
  {
    /** Forces on the liner, minus those on the blocks, at each point of all
        liners [N]. */
    dealii::Tensor<1, 2> *force;
    /** Stiffness of blocks at the points of this one, x and y of each: minus
        the derivative of the forces on them where the beam stays in equilibrium
        [N/m]; null: not wanted. */
    Eigen::MatrixXd *stiffness;
  };

  /**
   * Finds the nodes of @p beam in equilibrium under the @p loads of its nodes
   * [N] with blocks at BeamState::block_motion, by Newton's method from the
   * last equilibrium @p beams, which becomes the new one; adds dissipation and
   * work of the loads to @p energy. @p model_size: which positions are rounded
   * by [m]; @p state: tells which blocks are absent. Returns false if there is
   * no equilibrium.
   */
  bool find_equilibrium(const Beam &beam,
                        const std::vector<dealii::Tensor<1, 2>> &loads,
                        double model_size, const State<2> &state,
                        BeamState &beams, EnergyAccounts &energy,
                        const BeamReaction &reaction);

  /**
   * Whether @p beam, where it is in equilibrium, would leave that if anything
   * disturbed it while blocks and loads stay, as a strut beyond Euler's load:
   * whether its stiffness, with hinges as they are, has a negative eigenvalue.
   */
  bool is_unstable(const Beam &beam, const State<2> &state,
                   const BeamState &now);
} // namespace quoin

#endif
