// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beam_state_h
#define quoin_structures_beam_state_h

#include <quoin/joints/joint_history.h>
#include <quoin/operators/state.h>

namespace quoin
{
  /** The nodes of all beams, the same on all ranks. */
  struct BeamState
  {
    static constexpr const char *slice_name = "beams";

    AlignedArray<std::uint8_t> placed; /**< flag of each beam */
    AlignedArray<NodeRecord<2>> nodes; /**< X: where they were placed */
    AlignedArray<dealii::Tensor<1, 2>> velocity; /**< at time - dt/2 */
    AlignedArray<double> plastic;        /**< plastic turning angle [rad] */
    AlignedArray<double> moment;         /**< of the last step [N m] */
    AlignedArray<std::uint8_t> attached; /**< flag of each interface point */
    /** Opening and slip at placement [m]. */
    AlignedArray<dealii::Tensor<1, 2>> offset;
    JointHistory interface; /**< of the interface points */
    // What the last step leaves behind.
    /** Displacement of blocks at these points, from BeamLine::places: positions
        far from the origin have fewer digits [m]. */
    AlignedArray<double> block_motion;
    AlignedArray<dealii::Tensor<1, 2>> load;      /**< of equilibrium [N] */
    double stored_strain = 0., stored_joint = 0.; /**< [J] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(placed, nodes, velocity, plastic, moment, attached, offset,
                   block_motion, load, stored_strain, stored_joint);
      visitor.same(interface.normal_traction, interface.shear_traction,
                   interface.plastic_slip, interface.plastic_opening,
                   interface.state);
      for (AlignedArray<double> &variable : interface.internal)
        visitor.same(variable);
    }
  };
} // namespace quoin

#endif
