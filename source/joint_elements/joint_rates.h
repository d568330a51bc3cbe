// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_joint_rates_h
#define quoin_source_joint_elements_joint_rates_h

#include "joint_frame.h"

// Forces of a joint's segment that follow from velocities.

namespace quoin
{
  /** Opening and slip of a point [m] and their rates [m/s]. */
  struct PointMotion
  {
    std::array<double, 2> gap, rate;
  };

  /**
   * Adds to @p force, for the points k of @p segment, the tractions [Pa] that
   * @p traction (k, motion) gives if @p acts (k).
   */
  template <typename Acts, typename Traction>
  void add_rate_forces(const JointSegment &segment, const NodeRecord<2> *nodes,
                       const dealii::Tensor<1, 2> *velocity, const Acts &acts,
                       const Traction &traction, dealii::Tensor<1, 2> *force)
  {
    const JointFrame local = joint_frame(segment, nodes);
    const double turn      = rotation_rate(segment, local, velocity);
    double couple          = 0.;
    for (unsigned int k = 0; k < 2; ++k)
    {
      if (!acts(k))
        continue;
      const dealii::Tensor<1, 2> v
          = velocity[segment.upper[k]] - velocity[segment.lower[k]];
      PointMotion motion;
      motion.gap                  = joint_gap(segment, local, nodes, k);
      const auto &[opening, slip] = motion.gap;
      motion.rate                 = { { v * local.normal - slip * turn,
                                        v * local.tangent + opening * turn } };
      const auto [normal, shear]  = traction(k, motion);
      const double sigma          = segment.area[k] * normal;
      const double tau            = segment.area[k] * shear;
      couple += tau * opening - sigma * slip;
      const dealii::Tensor<1, 2> f = sigma * local.normal + tau * local.tangent;
      force[segment.lower[k]] += f;
      force[segment.upper[k]] -= f;
    }
    subtract_couple(segment, local, couple, force);
  }
} // namespace quoin

#endif
