// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What MatchedJoints gives to solvers that need derivatives.

#include <quoin/contact/matched_joints.h>

#include <algorithm>
#include <cmath>

#include "joint_frame.h"
#include "joint_points.h"

namespace quoin
{
  namespace
  {
    using Row = std::array<double, 8>;

    JointDissipation update(const CoulombLaw &law, JointPoint &point,
                            const double opening, const double slip,
                            const bool may_break, JointTangent &tangent)
    {
      if (point.state != JointState::intact)
        return law.update(point, opening, slip, tangent);
      if (may_break)
      {
        // Its strength is the residual one from now on.
        CoulombLaw weak = law;
        weak.peak       = law.residual;
        return weak.update(point, opening, slip, tangent);
      }
      tangent = { law.normal_stiffness, 0., 0., law.shear_stiffness };
      point.normal_traction
          = law.normal_stiffness * (opening - point.plastic_opening);
      point.shear_traction = law.shear_stiffness * (slip - point.plastic_slip);
      return {};
    }

    template <typename Law>
    auto update(const Law &law, typename Law::Point &point,
                const double opening, const double slip, bool,
                JointTangent &tangent)
    {
      return law.update(point, opening, slip, tangent);
    }

    /** What elastic slip [m] changes by with the normal traction [m/Pa]. */
    template <typename Law>
    double slip_by_pressure(const Law &law, const double sigma,
                            const double tau)
    {
      if constexpr (std::is_same_v<Law, ContinuouslyYieldingLaw>)
      {
        const DualNumber ks = law.stiffness.at(DualNumber(-sigma, -1., 0.));
        return -tau * ks.by[0] / (ks.value * ks.value);
      }
      else
        return 0.;
    }

    /**
     * How an increment counts that adds to @p total: as more of it, so that
     * slip on the way back does not, or by its size where there is none yet.
     */
    double direction(const double total, const double increment)
    {
      return total != 0.       ? std::copysign(1., total)
             : increment != 0. ? std::copysign(1., increment)
                               : 0.;
    }
  } // namespace

  void MatchedJoints::linearise(const unsigned int i, const NodeRecord *nodes,
                                const std::vector<std::uint8_t> &broken,
                                JointHistory &history, EnergyAccounts &energy,
                                JointLinearisation &result) const
  {
    const Segment &segment = segments[i];
    const Frame local      = frame(segment, nodes);
    result.nodes = { { segment.lower[0], segment.lower[1], segment.upper[0],
                       segment.upper[1] } };
    result.force.fill(0.);
    for (Row &row : result.stiffness)
      row.fill(0.);
    result.inelastic = 0.;
    result.inelastic_gradient.fill(0.);
    if (history.handed_over[i])
      return;

    // The frame turns by d phi = (E x dE) / |E|^2, E the sum of both edges.
    double edge[2] = { 0., 0. };
    for (unsigned int d = 0; d < 2; ++d)
      for (const unsigned int side : { 0U, 2U })
      {
        const NodeRecord &a = nodes[result.nodes[side]];
        const NodeRecord &b = nodes[result.nodes[side + 1]];
        edge[d] += (b.X[d] - a.X[d]) + (b.u[d] - a.u[d]);
      }
    const double square = edge[0] * edge[0] + edge[1] * edge[1];
    Row turn;
    for (unsigned int node = 0; node < 4; ++node)
    {
      const double direction = node % 2 == 1 ? 1. : -1.;
      turn[2 * node]         = -direction * edge[1] / square;
      turn[2 * node + 1]     = direction * edge[0] / square;
    }

    for (unsigned int k = 0; k < 2; ++k)
    {
      const auto [opening, slip] = gap(segment, local, nodes, k);
      const unsigned int p       = 2 * i + k;
      JointTangent tangent;
      const double total_opening = history.plastic_opening[p];
      const double total_slip    = history.plastic_slip[p];
      double plastic_opening = 0., plastic_slip = 0.; // increments
      std::array<double, 2> stiffness;
      double coupling    = 0.;
      const auto advance = [&, opening = opening, slip = slip](const auto &law)
      {
        auto point = read_point(law, history, p);
        book(update(law, point, opening, slip, broken[p], tangent),
             segment.area[k] * segment.share, energy);
        write_flow(point, history, p);
        write_tractions(point, history, p);
        plastic_opening = point.plastic_opening - total_opening;
        plastic_slip    = point.plastic_slip - total_slip;
        stiffness       = stiffness_of(law, point.normal_traction);
        coupling        = slip_by_pressure(law, point.normal_traction,
                                           point.shear_traction);
      };
      with_law(segment.set, advance);

      const double sigma = history.normal_traction[p];
      const double tau   = history.shear_traction[p];
      // An open Coulomb joint keeps the plastic opening that it had.
      const double opens = plastic_opening == 0.
                               ? 0.
                               : direction(total_opening, plastic_opening);
      const double slips = direction(total_slip, plastic_slip);
      result.inelastic
          += segment.area[k] * (opens * plastic_opening + slips * plastic_slip);
      double traction[2];
      for (unsigned int d = 0; d < 2; ++d)
        traction[d] = sigma * local.normal[d] + tau * local.tangent[d];
      const unsigned int lower = 2 * k, upper = 4 + 2 * k;
      for (unsigned int d = 0; d < 2; ++d)
      {
        result.force[lower + d] += segment.area[k] * traction[d];
        result.force[upper + d] -= segment.area[k] * traction[d];
      }
      for (unsigned int j = 0; j < 8; ++j)
      {
        const unsigned int d = j % 2;
        const double side    = j - d == upper ? 1. : j - d == lower ? -1. : 0.;
        const double d_opening = side * local.normal[d] - slip * turn[j];
        const double d_slip    = side * local.tangent[d] + opening * turn[j];
        const double d_sigma
            = tangent.normal_opening * d_opening + tangent.normal_slip * d_slip;
        const double d_tau
            = tangent.shear_opening * d_opening + tangent.shear_slip * d_slip;
        for (unsigned int e = 0; e < 2; ++e)
        {
          const double change
              = segment.area[k]
                * ((d_sigma + tau * turn[j]) * local.normal[e]
                   + (d_tau - sigma * turn[j]) * local.tangent[e]);
          result.stiffness[lower + e][j] -= change;
          result.stiffness[upper + e][j] += change;
        }
        result.inelastic_gradient[j]
            += segment.area[k]
               * (opens * (d_opening - d_sigma / stiffness[0])
                  + slips
                        * (d_slip - d_tau / stiffness[1] - coupling * d_sigma));
      }
    }
  }

  double MatchedJoints::excess(const unsigned int p,
                               const JointHistory &history) const
  {
    const Segment &segment = segments[p / 2];
    const auto *brittle    = std::get_if<CoulombLaw>(&laws[segment.set]);
    if (!brittle || history.state[p] != JointState::intact
        || history.handed_over[p / 2] || !std::isfinite(brittle->peak.tension))
      return 0.;
    const JointStrength &peak = brittle->peak;
    const double sigma        = history.normal_traction[p];
    const double tau          = std::abs(history.shear_traction[p]);
    const double shear        = tau + sigma * peak.friction - peak.cohesion;
    const double size         = std::max(std::abs(sigma), tau);
    return size > 0. ? std::max(sigma - peak.tension, shear) / size : 0.;
  }
} // namespace quoin
