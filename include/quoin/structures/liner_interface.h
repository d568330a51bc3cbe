// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_liner_interface_h
#define quoin_structures_liner_interface_h

#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/structures/beam_line.h>
#include <quoin/structures/lined_boundary.h>

#include <vector>

namespace quoin
{
  /** The joint between a liner and the blocks at its nodes. A free beam has one
      without points. */
  struct LinerInterface
  {
    JointLaw law;
    unsigned int first = 0; /**< number of the first point in BeamState */
    std::vector<InterfacePoint> points;

    /** Place of a block relative to the liner. */
    struct Gap
    {
      double opening, slip; /**< [m] */
      /** Directions of opening and slip. */
      dealii::Tensor<1, 2> normal, tangent;
    };

    /** Connects the liner to the blocks that are there, at the positions of
        BeamState::block_motion, where its nodes are placed. Throws an
        InputError if they are on both sides or not everywhere. */
    void attach(const BeamLine &line, State<2> &state) const;
    /** Whether point @p k connects the liner to a block. */
    bool acts(unsigned int k, const State<2> &state,
              const BeamState &beams) const
    {
      return beams.attached[first + k] && !state.is_absent(points[k].block);
    }
    /** Gap at point @p k, whose block is at BeamState::block_motion. */
    Gap gap(const BeamLine &line, unsigned int k, const BeamState &beams) const;
    /** Bound of the stiffness at both nodes of point @p k [N/m]. */
    double stiffness_bound(unsigned int k) const;
    /** Updates internal variables; adds forces to the nodes of all beams and
        returns the sum of their sizes [N]. @p state tells which blocks are
        absent; the forces on blocks are the opposite of @p by_point, of each
        point of all liners [N]. */
    double add_forces(const BeamLine &line, const State<2> &state,
                      BeamState &beams, EnergyAccounts &energy,
                      dealii::Tensor<1, 2> *force,
                      dealii::Tensor<1, 2> *by_point) const;
  };

  /** A beam or liner. */
  struct Beam
  {
    BeamLine line;
    LinerInterface interface;
  };
} // namespace quoin

#endif
