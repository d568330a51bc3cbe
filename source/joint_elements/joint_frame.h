// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_joint_frame_h
#define quoin_source_joint_elements_joint_frame_h

#include <quoin/joint_elements/matched_joints.h>

#include <cmath>

// The geometry of a joint's segment.

namespace quoin
{
  struct JointFrame
  {
    double normal[2];
    double tangent[2];
    double inverse_length; /**< 1/|E|, E the sum of both edges [1/m] */
  };

  inline JointFrame joint_frame(const JointSegment &segment,
                                const NodeRecord<2> *nodes)
  {
    const NodeRecord<2> &a0 = nodes[segment.lower[0]];
    const NodeRecord<2> &a1 = nodes[segment.lower[1]];
    const NodeRecord<2> &b0 = nodes[segment.upper[0]];
    const NodeRecord<2> &b1 = nodes[segment.upper[1]];

    // Twice the mean edge of the two sides; the lower block is on its left.
    const double x = (a1.X[0] - a0.X[0]) + (b1.X[0] - b0.X[0])
                     + (a1.u[0] - a0.u[0]) + (b1.u[0] - b0.u[0]);
    const double y = (a1.X[1] - a0.X[1]) + (b1.X[1] - b0.X[1])
                     + (a1.u[1] - a0.u[1]) + (b1.u[1] - b0.u[1]);
    const double inverse_length = 1. / std::sqrt(x * x + y * y);
    const double nx = y * inverse_length, ny = -x * inverse_length;
    return { { nx, ny }, { ny, -nx }, inverse_length };
  }

  /** Opening and slip [m] of point @p k. */
  inline std::array<double, 2> joint_gap(const JointSegment &segment,
                                         const JointFrame &frame,
                                         const NodeRecord<2> *nodes,
                                         const unsigned int k)
  {
    const NodeRecord<2> &a = nodes[segment.lower[k]];
    const NodeRecord<2> &b = nodes[segment.upper[k]];

    const double x = (b.X[0] - a.X[0]) + (b.u[0] - a.u[0]);
    const double y = (b.X[1] - a.X[1]) + (b.u[1] - a.u[1]);
    return { { x * frame.normal[0] + y * frame.normal[1],
               x * frame.tangent[0] + y * frame.tangent[1] } };
  }

  /** How fast @p frame turns [1/s] as its nodes move with @p velocity. */
  inline double rotation_rate(const JointSegment &segment,
                              const JointFrame &frame,
                              const dealii::Tensor<1, 2> *velocity)
  {
    double rate = 0.;
    for (unsigned int d = 0; d < 2; ++d)
      rate -= frame.normal[d]
              * ((velocity[segment.lower[1]][d] - velocity[segment.lower[0]][d])
                 + (velocity[segment.upper[1]][d]
                    - velocity[segment.upper[0]][d]));
    return rate * frame.inverse_length;
  }

  /**
   * Subtracts from the end nodes of both edges what the rotation phi of the
   * frame adds to the derivative of the energy: @p couple [N m], the derivative
   * by phi, times that of phi by the nodes, d phi = (E x dE)/|E|^2. Without it
   * a joint that turns does work that it does not store, and a couple of
   * traction times slip acts on nothing.
   */
  template <typename Vector>
  void subtract_couple(const JointSegment &segment, const JointFrame &frame,
                       const double couple, Vector *force)
  {
    const double f = couple * frame.inverse_length;
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double end = f * frame.normal[d];
      force[segment.lower[0]][d] -= end;
      force[segment.upper[0]][d] -= end;
      force[segment.lower[1]][d] += end;
      force[segment.upper[1]][d] += end;
    }
  }
} // namespace quoin

#endif
