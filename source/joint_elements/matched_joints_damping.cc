// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Forces of MatchedJoints that follow from velocities.

#include <quoin/joint_elements/matched_joints.h>

#include <algorithm>

#include <quoin/joint_elements/dashpot_tractions.h>
#include "joint_frame.h"
#include "segment_lanes.h"

namespace quoin
{
  template <typename Acts, typename Traction>
  void MatchedJoints::add_rate_forces(const unsigned int i,
                                      const NodeRecord<2> *nodes,
                                      const dealii::Tensor<1, 2> *velocity,
                                      const Acts &acts,
                                      const Traction &traction,
                                      dealii::Tensor<1, 2> *force) const
  {
    const JointSegment &segment = all_segments[i];
    const JointFrame local      = joint_frame(segment, nodes);
    const double turn           = rotation_rate(segment, local, velocity);
    double couple               = 0.;
    for (unsigned int k = 0; k < 2; ++k)
    {
      if (!acts(2 * i + k))
        continue;
      const dealii::Tensor<1, 2> v
          = velocity[segment.upper[k]] - velocity[segment.lower[k]];
      Motion motion;
      motion.gap                  = joint_gap(segment, local, nodes, k);
      const auto &[opening, slip] = motion.gap;
      motion.rate                 = { { v * local.normal - slip * turn,
                                        v * local.tangent + opening * turn } };
      const auto [normal, shear]  = traction(2 * i + k, motion);
      const double sigma          = segment.area[k] * normal;
      const double tau            = segment.area[k] * shear;
      couple += tau * opening - sigma * slip;
      const dealii::Tensor<1, 2> f = sigma * local.normal + tau * local.tangent;
      force[segment.lower[k]] += f;
      force[segment.upper[k]] -= f;
    }
    subtract_couple(segment, local, couple, force);
  }

  template <typename Law>
  void MatchedJoints::add_set_viscous_forces(
      const unsigned int set, const Law &law, const NodeRecord<2> *nodes,
      const JointHistory &history, const dealii::Tensor<1, 2> *velocity,
      const double beta, dealii::Tensor<1, 2> *force) const
  {
    using F     = LaneFunctions<native_lanes>;
    using Bits  = F::Bits;
    using Value = F::Value;
    for (unsigned int g = group_begin[set]; g < group_begin[set + 1]; ++g)
    {
      const auto &group = groups[g];
      // beta kn and beta ks times the area, of the points that act.
      double factor[2][2 * native_lanes]{};
      bool acts = false;
      for (unsigned int j = 0; j < 2 * group.size; ++j)
      {
        const unsigned int p = 2 * group.first + j;
        if (history.state[p] == JointState::slipping
            || history.state[p] == JointState::open)
          continue;
        const auto [kn, ks] = law.stiffness_at(history.normal_traction[p]);
        factor[0][j]        = beta * kn * group.area[j];
        factor[1][j]        = beta * ks * group.area[j];
        acts                = true;
      }
      if (!acts)
        continue;
      const Bits present = SegmentLanes<native_lanes>::present(
          group, history.handed_over.data());
      const SegmentLanes<native_lanes> segments(group, nodes, present);
      Value opening_rate[2], slip_rate[2];
      segments.find_rates(group, velocity, opening_rate, slip_rate);
      const auto of_point = [](const double *values, Value(&result)[2])
      {
        const Value a = F::load(values), b = F::load(values + native_lanes);
        result[0] = F::even(a, b);
        result[1] = F::odd(a, b);
      };
      Value sigma[2], tau[2];
      of_point(factor[0], sigma);
      of_point(factor[1], tau);
      for (unsigned int k = 0; k < 2; ++k)
      {
        sigma[k] *= opening_rate[k];
        tau[k] *= slip_rate[k];
      }
      segments.add_forces(group, sigma, tau, force);
    }
  }

  void MatchedJoints::add_viscous_forces(const NodeRecord<2> *nodes,
                                         const JointHistory &history,
                                         const dealii::Tensor<1, 2> *velocity,
                                         const double beta,
                                         dealii::Tensor<1, 2> *force) const
  {
    for (unsigned int set = 0; set < all_laws.size(); ++set)
      std::visit(
          [&](const auto &law) {
            add_set_viscous_forces(set, law, nodes, history, velocity, beta,
                                   force);
          },
          all_laws[set]);
  }

  void
  MatchedJoints::add_elastic_forces(const NodeRecord<2> *nodes,
                                    const dealii::Tensor<1, 2> *displacement,
                                    dealii::Tensor<1, 2> *force) const
  {
    for (unsigned int i = 0; i < all_segments.size(); ++i)
    {
      const auto [kn, ks] = stiffness_bound(all_laws[all_segments[i].set]);
      add_rate_forces(
          i, nodes, displacement, [](unsigned int) { return true; },
          [kn = kn, ks = ks](unsigned int, const Motion &motion)
          {
            return std::array<double, 2>{ { kn * motion.rate[0],
                                            ks * motion.rate[1] } };
          },
          force);
    }
  }

  void MatchedJoints::set_blocks(const DashpotBlocks &blocks)
  {
    dashpots.set_blocks(blocks);
    dashpots.bind(segment_sides);
  }

  bool MatchedJoints::has_dashpots() const
  {
    return dashpots.knows_blocks()
           && std::any_of(dampings.begin(), dampings.end(),
                          [](const JointDamping &damping)
                          { return damping.acts(); });
  }

  void MatchedJoints::add_dashpot_forces(const NodeRecord<2> *nodes,
                                         const JointHistory &history,
                                         const dealii::Tensor<1, 2> *velocity,
                                         dealii::Tensor<1, 2> *force)
  {
    // A point that never failed carries tension, too.
    const auto bears = [&](const unsigned int p)
    {
      return !history.handed_over[p / 2]
             && (history.state[p] == JointState::intact
                 || history.normal_traction[p] < 0.);
    };
    const auto stiffness = [&](const unsigned int p)
    {
      return std::visit(
          [&](const auto &law)
          { return law.stiffness_at(history.normal_traction[p]); },
          all_laws[all_segments[p / 2].set]);
    };
    dashpots.clear();
    for (unsigned int p = 0; p < n_points(); ++p)
      if (bears(p))
      {
        const JointSegment &segment = all_segments[p / 2];
        const auto [kn, ks]         = stiffness(p);
        dashpots.add_springs(p / 2, segment.share, segment.area[p % 2] * kn,
                             segment.area[p % 2] * ks);
      }
    dashpots.sum_over_ranks();

    for (unsigned int i = 0; i < all_segments.size(); ++i)
      if (const JointDamping &damping = dampings[all_segments[i].set];
          damping.acts())
        std::visit(
            [&](const auto &law)
            {
              add_rate_forces(
                  i, nodes, velocity, bears,
                  [&](const unsigned int p, const Motion &motion)
                  {
                    return dashpot_tractions(
                        law, read_point(law, history, p), motion.gap,
                        motion.rate, dashpots.times(i, damping, stiffness(p)));
                  },
                  force);
            },
            all_laws[all_segments[i].set]);
  }
} // namespace quoin
