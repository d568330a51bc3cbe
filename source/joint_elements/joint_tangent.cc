// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/joint_tangent.h>

#include <algorithm>

#include "joint_rates.h"
#include "joint_response.h"
#include <quoin/joint_elements/joint_points.h>

namespace quoin
{
  namespace
  {
    using Row = std::array<double, 8>;

    /** How the frame turns with the displacements of its four nodes [1/m]:
        d phi = (E x dE)/|E|^2, E the sum of both edges. */
    Row turn_of_frame(const JointFrame &frame)
    {
      Row turn;
      for (unsigned int i = 0; i < 8; ++i)
        turn[i] = (i / 2 % 2 == 1 ? -1. : 1.) * frame.normal[i % 2]
                  * frame.inverse_length;
      return turn;
    }

    /** 1 at the upper node of point @p k, -1 at the lower one, else 0. */
    double side_of(const unsigned int node, const unsigned int k)
    {
      return node == 2 + k ? 1. : node == k ? -1. : 0.;
    }

    /** The second derivative of phi by components @p i and @p j of its nodes'
        displacements [1/m^2]. */
    double second_turn(const JointFrame &frame, const unsigned int i,
                       const unsigned int j)
    {
      const double sign             = (i / 2 + j / 2) % 2 == 1 ? -1. : 1.;
      const dealii::Tensor<1, 2> &n = frame.normal, &s = frame.tangent;
      return -sign * (s[i % 2] * n[j % 2] + n[i % 2] * s[j % 2])
             * frame.inverse_length * frame.inverse_length;
    }
  } // namespace

  void linearise(const MatchedJoints &joints, const unsigned int i,
                 const NodeRecord<2> *nodes,
                 const std::vector<std::uint8_t> &broken, JointHistory &history,
                 EnergyAccounts &energy, JointLinearisation &result,
                 const bool with_stiffness)
  {
    const JointSegment &segment = joints.segments()[i];
    const JointFrame local      = joint_frame(segment, nodes);
    result.nodes = { { segment.lower[0], segment.lower[1], segment.upper[0],
                       segment.upper[1] } };
    result.force.fill(0.);
    result.inelastic = 0.;
    if (with_stiffness)
    {
      for (Row &row : result.stiffness)
        row.fill(0.);
      result.inelastic_gradient.fill(0.);
    }
    if (history.handed_over[i])
      return;

    const Row turn = turn_of_frame(local);
    double couple  = 0.;
    for (unsigned int k = 0; k < 2; ++k)
    {
      const auto local_gap = joint_gap(segment, local, nodes, k);
      const double opening = local_gap[0], slip = local_gap[1];
      const double area    = segment.area[k];
      const unsigned int p = 2 * i + k;
      JointResponse<2> point;
      std::visit(
          [&](const auto &law)
          {
            point
                = respond<2>(law, opening, slip_since_placing(history, p, slip),
                             static_cast<JointLoss>(broken[p]),
                             area * segment.share, history, p, energy);
          },
          joints.laws()[segment.set]);
      result.inelastic += area * point.growth();

      const double sigma = area * history.normal_traction[p];
      const double tau   = area * history.shear_traction[p];
      // How opening and slip change with the displacements of the nodes.
      Row by_opening, by_slip;
      for (unsigned int j = 0; j < 8; ++j)
      {
        const double side = side_of(j / 2, k);
        by_opening[j]     = side * local.normal[j % 2] - slip * turn[j];
        by_slip[j]        = side * local.tangent[j % 2] + opening * turn[j];
        result.force[j] -= sigma * by_opening[j] + tau * by_slip[j];
      }
      couple += tau * opening - sigma * slip;
      const JointTangent<2> &tangent = point.tangent;
      for (unsigned int j = 0; with_stiffness && j < 8; ++j)
      {
        const double d_sigma = tangent.normal_opening * by_opening[j]
                               + tangent.normal_slip * by_slip[j];
        const double d_tau = tangent.shear_opening * by_opening[j]
                             + tangent.shear_slip * by_slip[j];
        for (unsigned int i = 0; i < 8; ++i)
        {
          const double side = side_of(i / 2, k);
          result.stiffness[i][j]
              += area * (d_sigma * by_opening[i] + d_tau * by_slip[i])
                 + sigma
                       * (-side * local.tangent[i % 2] * turn[j]
                          - turn[i] * by_slip[j])
                 + tau
                       * (side * local.normal[i % 2] * turn[j]
                          + turn[i] * by_opening[j]);
        }
        result.inelastic_gradient[j]
            += area
               * (point.opens * (by_opening[j] - d_sigma / point.stiffness[0])
                  + point.slips
                        * (by_slip[j] - d_tau / point.stiffness[1]
                           - point.slip_by_pressure * d_sigma));
      }
    }
    for (unsigned int j = 0; with_stiffness && j < 8; ++j)
      for (unsigned int i = 0; i < 8; ++i)
        result.stiffness[i][j] += couple * second_turn(local, i, j);
  }

  double excess(const MatchedJoints &joints, const unsigned int p,
                const JointHistory &history)
  {
    double excess = 0.;
    if (!history.handed_over[p / 2])
      std::visit(
          [&](const auto &law)
          {
            if constexpr (std::decay_t<decltype(law)>::waits)
              excess = law.excess(read_point(law, history, p));
          },
          joints.laws()[joints.segments()[p / 2].set]);
    return excess;
  }

  void add_elastic_forces(const MatchedJoints &joints,
                          const NodeRecord<2> *nodes,
                          const dealii::Tensor<1, 2> *displacement,
                          dealii::Tensor<1, 2> *force)
  {
    for (const JointSegment &segment : joints.segments())
    {
      const auto [kn, ks] = stiffness_bound(joints.laws()[segment.set]);
      add_rate_forces(
          segment, nodes, displacement, [](unsigned int) { return true; },
          [kn = kn, ks = ks](unsigned int, const PointMotion<2> &motion) {
            return JointVector<2>{ kn * motion.rate.normal,
                                   ks * motion.rate.shear };
          },
          force);
    }
  }
} // namespace quoin
