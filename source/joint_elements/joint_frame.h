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
    dealii::Tensor<1, 2> normal;
    dealii::Tensor<1, 2> tangent;
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
    const dealii::Tensor<1, 2> edge
        = (a1.X - a0.X) + (b1.X - b0.X) + (a1.u - a0.u) + (b1.u - b0.u);
    const double inverse_length
        = 1. / std::sqrt(edge[0] * edge[0] + edge[1] * edge[1]);
    const double nx = edge[1] * inverse_length, ny = -edge[0] * inverse_length;
    return { dealii::Point<2>(nx, ny), dealii::Point<2>(ny, -nx),
             inverse_length };
  }

  /** Opening and slip [m] of point @p k. */
  inline std::array<double, 2> joint_gap(const JointSegment &segment,
                                         const JointFrame &frame,
                                         const NodeRecord<2> *nodes,
                                         const unsigned int k)
  {
    const NodeRecord<2> &a = nodes[segment.lower[k]];
    const NodeRecord<2> &b = nodes[segment.upper[k]];

    const dealii::Tensor<1, 2> way = (b.X - a.X) + (b.u - a.u);
    // In the order of the lanes, so that both round in the same way.
    return { { way[0] * frame.normal[0] + way[1] * frame.normal[1],
               way[0] * frame.tangent[0] + way[1] * frame.tangent[1] } };
  }

  /** How fast @p frame turns [1/s] as its nodes move with @p velocity. */
  inline double rotation_rate(const JointSegment &segment,
                              const JointFrame &frame,
                              const dealii::Tensor<1, 2> *velocity)
  {
    return -frame.inverse_length
           * (frame.normal
              * ((velocity[segment.lower[1]] - velocity[segment.lower[0]])
                 + (velocity[segment.upper[1]] - velocity[segment.upper[0]])));
  }

  /**
   * Subtracts from the end nodes of both edges what the rotation phi of the
   * frame adds to the derivative of the energy: @p couple [N m], the derivative
   * by phi, times that of phi by the nodes, d phi = (E x dE)/|E|^2. Without it
   * a joint that turns does work that it does not store, and a couple of
   * traction times slip acts on nothing.
   */
  inline void subtract_couple(const JointSegment &segment,
                              const JointFrame &frame, const double couple,
                              dealii::Tensor<1, 2> *force)
  {
    const dealii::Tensor<1, 2> end
        = couple * frame.inverse_length * frame.normal;
    force[segment.lower[0]] -= end;
    force[segment.upper[0]] -= end;
    force[segment.lower[1]] += end;
    force[segment.upper[1]] += end;
  }
} // namespace quoin

#endif
