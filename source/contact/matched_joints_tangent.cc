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

    /**
     * How an increment counts that adds to @p total: as more of it, so that
     * slip on the way back does not, or by its size where there is none yet.
     */
    double sign_of_growth(const double total, const double increment)
    {
      return total != 0.       ? std::copysign(1., total)
             : increment != 0. ? std::copysign(1., increment)
                               : 0.;
    }

    /** A point brought to its gap, and the derivatives there. */
    struct Response
    {
      JointTangent<2> tangent;
      std::array<double, 2> stiffness;      /**< kn, ks of the moment [Pa/m] */
      double slip_by_pressure;              /**< of the law [m/Pa] */
      double plastic_opening, plastic_slip; /**< what was added [m] */
      double opens, slips;                  /**< sign_of_growth() of these */
    };

    /** Brings point @p p to @p opening and @p slip [m]. */
    template <typename Law>
    Response respond(const Law &law, const double opening, const double slip,
                     const bool may_break, const double weight,
                     JointHistory &history, const unsigned int p,
                     EnergyAccounts &energy)
    {
      auto point                 = read_point(law, history, p);
      const double total_opening = point.plastic_opening;
      const double total_slip    = point.plastic_slip;
      Response result;
      JointDissipation lost;
      if constexpr (Law::is_brittle)
        lost = law.update_waiting(point, opening, slip, may_break,
                                  result.tangent);
      else
        lost = law.update(point, opening, slip, result.tangent);
      book(lost, weight, energy);
      write_point(point, history, p);
      result.stiffness        = law.stiffness_at(point.normal_traction);
      result.slip_by_pressure = law.slip_by_pressure(point);
      result.plastic_opening  = point.plastic_opening - total_opening;
      result.plastic_slip     = point.plastic_slip - total_slip;
      // An open joint may keep the plastic opening that it had.
      result.opens
          = result.plastic_opening == 0.
                ? 0.
                : sign_of_growth(total_opening, result.plastic_opening);
      result.slips = sign_of_growth(total_slip, result.plastic_slip);
      return result;
    }

    /**
     * How the frame of four nodes turns with their displacements [1/m]:
     * d phi = (E x dE) / |E|^2, E the sum of both edges.
     */
    Row turn_of_frame(const NodeRecord<2> *nodes,
                      const std::array<unsigned int, 4> &corners)
    {
      double edge[2] = { 0., 0. };
      for (unsigned int d = 0; d < 2; ++d)
        for (const unsigned int side : { 0U, 2U })
        {
          const NodeRecord<2> &a = nodes[corners[side]];
          const NodeRecord<2> &b = nodes[corners[side + 1]];
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
      return turn;
    }
  } // namespace

  void MatchedJoints::linearise(State<2> &state, const bool with_stiffness,
                                const TakeElement<2> &take) const
  {
    const BreakingJoints *breaking = state.find<BreakingJoints>();
    const std::vector<std::uint8_t> broken
        = breaking ? breaking->points : std::vector<std::uint8_t>(n_points());
    JointHistory &history = state.get<JointHistory>();
    JointLinearisation segment;
    for (unsigned int i = 0; i < all_segments.size(); ++i)
    {
      linearise(i, state.nodes.data(), broken, history, state.energy, segment,
                with_stiffness);
      take({ segment.nodes.data(), 4, segment.force.data(),
             segment.stiffness[0].data(), 8, all_segments[i].share,
             segment.inelastic, segment.inelastic_gradient.data(),
             all_segments[i].set });
    }
  }

  void MatchedJoints::linearise(const unsigned int i,
                                const NodeRecord<2> *nodes,
                                const std::vector<std::uint8_t> &broken,
                                JointHistory &history, EnergyAccounts &energy,
                                JointLinearisation &result,
                                const bool with_stiffness) const
  {
    const JointSegment &segment = all_segments[i];
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

    const Row turn
        = with_stiffness ? turn_of_frame(nodes, result.nodes) : Row();
    for (unsigned int k = 0; k < 2; ++k)
    {
      const auto local_gap = joint_gap(segment, local, nodes, k);
      const double opening = local_gap[0], slip = local_gap[1];
      const double area    = segment.area[k];
      const unsigned int p = 2 * i + k;
      Response point;
      std::visit(
          [&](const auto &law)
          {
            point = respond(law, opening, slip, broken[p], area * segment.share,
                            history, p, energy);
          },
          all_laws[segment.set]);
      result.inelastic += area
                          * (point.opens * point.plastic_opening
                             + point.slips * point.plastic_slip);

      const double sigma       = history.normal_traction[p];
      const double tau         = history.shear_traction[p];
      const unsigned int lower = 2 * k, upper = 4 + 2 * k;
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double traction
            = sigma * local.normal[d] + tau * local.tangent[d];
        result.force[lower + d] += area * traction;
        result.force[upper + d] -= area * traction;
      }
      const JointTangent<2> &tangent = point.tangent;
      for (unsigned int j = 0; with_stiffness && j < 8; ++j)
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
              = area
                * ((d_sigma + tau * turn[j]) * local.normal[e]
                   + (d_tau - sigma * turn[j]) * local.tangent[e]);
          result.stiffness[lower + e][j] -= change;
          result.stiffness[upper + e][j] += change;
        }
        result.inelastic_gradient[j]
            += area
               * (point.opens * (d_opening - d_sigma / point.stiffness[0])
                  + point.slips
                        * (d_slip - d_tau / point.stiffness[1]
                           - point.slip_by_pressure * d_sigma));
      }
    }
  }

  double MatchedJoints::excess(const unsigned int p,
                               const JointHistory &history) const
  {
    double excess = 0.;
    if (!history.handed_over[p / 2])
      std::visit(
          [&](const auto &law)
          {
            if constexpr (std::decay_t<decltype(law)>::is_brittle)
              excess = law.excess(read_point(law, history, p));
          },
          all_laws[all_segments[p / 2].set]);
    return excess;
  }
} // namespace quoin
