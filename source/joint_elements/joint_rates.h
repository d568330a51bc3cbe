// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_joint_rates_h
#define quoin_source_joint_elements_joint_rates_h

#include <quoin/joint_elements/dashpot_tractions.h>

#include "joint_frame.h"
#include "space_face.h"

// Forces of a joint face that follow from velocities.

namespace quoin
{
  /** Opening and slip of a point [m] and their rates [m/s]. */
  template <int dim>
  struct PointMotion
  {
    JointVector<dim> gap, rate;
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
      const auto [opening, slip]  = joint_gap(segment, local, nodes, k);
      const PointMotion<2> motion = { { opening, slip },
                                      { v * local.normal - slip * turn,
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

  /** How fast @p frame turns as its nodes move with @p velocity [1/s]. */
  inline dealii::Tensor<1, 3>
  rotation_rate(const SpaceJointFace &face, const SpaceJointFrame &frame,
                const dealii::Tensor<1, 3> *velocity)
  {
    const auto edge = [&](const unsigned int k)
    {
      return 0.5
             * (velocity[face.lower[k]] - velocity[face.lower[0]]
                + velocity[face.upper[k]] - velocity[face.upper[0]]);
    };
    const Vector v1 = edge(1), v2 = edge(2);
    const double about_t = -(v1 * frame.n) / frame.length;
    return (v2 * frame.n + about_t * frame.along) / frame.above * frame.s
           + about_t * frame.t + v1 * frame.t / frame.length * frame.n;
  }

  /** As above, for the points k of @p face. */
  template <typename Acts, typename Traction>
  void add_rate_forces(const SpaceJointFace &face, const NodeRecord<3> *nodes,
                       const dealii::Tensor<1, 3> *velocity, const Acts &acts,
                       const Traction &traction, dealii::Tensor<1, 3> *force)
  {
    const SpaceJointFrame frame = joint_frame(face, nodes);
    const Vector turn           = rotation_rate(face, frame, velocity);
    const auto parts            = [&frame](const Vector &v)
    {
      JointVector<3> result;
      result.normal   = v * frame.n;
      result.shear[0] = v * frame.s;
      result.shear[1] = v * frame.t;
      return result;
    };
    add_face_forces(
        face, frame, nodes,
        [&](const unsigned int k, const Vector &gap)
        {
          if (!acts(k))
            return Vector();
          const Vector rate = velocity[face.upper[k]] - velocity[face.lower[k]]
                              - cross_product_3d(turn, gap);
          const auto [normal, shear]
              = traction(k, PointMotion<3>{ parts(gap), parts(rate) });
          return Vector(face.area * traction_vector(frame, normal, shear));
        },
        force);
  }
} // namespace quoin

#endif
