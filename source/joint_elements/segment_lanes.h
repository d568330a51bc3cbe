// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_segment_lanes_h
#define quoin_source_joint_elements_segment_lanes_h

#include <quoin/base/lane_functions.h>

#include "face_nodes.h"

// The geometry of joint_frame.h for several segments at once, one in each lane.

namespace quoin
{
  template <int lanes>
  struct SegmentLanes
  {
    static constexpr unsigned int dim = 2;
    using F                           = LaneFunctions<lanes>;
    using L                           = Lanes<lanes>;
    using Value                       = typename F::Value;
    using Bits                        = typename F::Bits;

    using Group = FaceGroup<dim, lanes>;

    Value normal[2];
    Value inverse_length;         /**< see JointFrame [1/m] */
    Value opening[2], slip[1][2]; /**< of both points [m] */

    /** Lanes that are not @p present have frames and gaps of zero. */
    QUOIN_INLINE SegmentLanes(const Group &group, const FaceNodes<2> &nodes,
                              const Bits &present)
    {
      // Differences of X, Y, u and v, of which those of X and of u are taken
      // apart as in between(); both are added as rows become columns.
      using Row = Lanes<4>::Value;
      Row along[lanes], apart[2][lanes];
      const char *base = reinterpret_cast<const char *>(nodes.nodes);
      for (int l = 0; l < lanes; ++l)
      {
        Row node[4];
        for (unsigned int i = 0; i < 4; ++i)
          node[i] = Lanes<4>::four(reinterpret_cast<const double *>(
              base + 2 * std::size_t(group.nodes[i][l])));
        along[l]    = (node[1] - node[0]) + (node[3] - node[2]);
        apart[0][l] = node[2] - node[0];
        apart[1][l] = node[3] - node[1];
      }
      const Value none{};
      Value edge[dim];
      L::add_halves(along, edge[0], edge[1]);
      inverse_length
          = 1. / F::square_root(edge[0] * edge[0] + edge[1] * edge[1]);
      inverse_length = present ? inverse_length : none;
      normal[0]      = edge[1] * inverse_length;
      normal[1]      = -edge[0] * inverse_length;
      for (unsigned int k = 0; k < 2; ++k)
      {
        Value gap[dim];
        L::add_halves(apart[k], gap[0], gap[1]);
        opening[k] = gap[0] * normal[0] + gap[1] * normal[1];
        slip[0][k] = gap[0] * normal[1] - gap[1] * normal[0];
      }
    }

    /** Adds what the resultants @p sigma and @p tau [N] at both points do to
        the nodes, with what the turning of the frame adds (joint_frame.h). */
    QUOIN_INLINE void add_forces(const Group &group, const Value (&sigma)[2],
                                 const Value (&tau)[1][2],
                                 FaceNodes<2> &nodes) const
    {
      char *to = reinterpret_cast<char *>(nodes.force);
      const Value couple
          = inverse_length
            * ((tau[0][0] * opening[0] - sigma[0] * slip[0][0])
               + (tau[0][1] * opening[1] - sigma[1] * slip[0][1]));
      const Value end[2] = { couple * normal[0], couple * normal[1] };
      Value pull[2][2];
      for (unsigned int k = 0; k < 2; ++k)
      {
        pull[k][0] = sigma[k] * normal[0] + tau[0][k] * normal[1];
        pull[k][1] = sigma[k] * normal[1] - tau[0][k] * normal[0];
      }
      L::add(to, group.nodes[0], pull[0][0] - end[0], pull[0][1] - end[1]);
      L::add(to, group.nodes[1], pull[1][0] + end[0], pull[1][1] + end[1]);
      L::add(to, group.nodes[2], -pull[0][0] - end[0], -pull[0][1] - end[1]);
      L::add(to, group.nodes[3], end[0] - pull[1][0], end[1] - pull[1][1]);
    }

    /** Rates [m/s] of the openings and slips of both points. */
    QUOIN_INLINE void find_rates(const Group &group, const FaceNodes<2> &nodes,
                                 Value (&opening_rate)[2],
                                 Value (&slip_rate)[1][2]) const
    {
      const char *base = reinterpret_cast<const char *>(nodes.velocity);
      Value v[4][dim];
      for (unsigned int i = 0; i < 4; ++i)
        L::load(base, 1, group.nodes[i], v[i][0], v[i][1]);
      Value turn{};
      for (unsigned int d = 0; d < dim; ++d)
        turn -= normal[d] * ((v[1][d] - v[0][d]) + (v[3][d] - v[2][d]));
      turn *= inverse_length;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const Value x = v[2 + k][0] - v[k][0], y = v[2 + k][1] - v[k][1];
        opening_rate[k] = x * normal[0] + y * normal[1] - slip[0][k] * turn;
        slip_rate[0][k] = x * normal[1] - y * normal[0] + opening[k] * turn;
      }
    }
  };
} // namespace quoin

#endif
