// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How MatchedJoints begin: under stress, anew, or with other laws.

#include <quoin/contact/matched_joints.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "joint_frame.h"
#include "joint_points.h"

namespace quoin
{
  void MatchedJoints::initialise(const std::vector<FaceStress> &face_stress,
                                 const State &state,
                                 JointHistory &history) const
  {
    for (unsigned int i = 0; i < segments.size(); ++i)
    {
      const Frame local = frame(segments[i], state.nodes.data());
      const double *n = local.normal, *s = local.tangent;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto &[xx, yy, xy] = face_stress[segments[i].face][k];
        const double traction[2]
            = { xx * n[0] + xy * n[1], xy * n[0] + yy * n[1] };
        const double normal = traction[0] * n[0] + traction[1] * n[1];
        const double shear  = traction[0] * s[0] + traction[1] * s[1];
        with_law(segments[i].set, [&](const auto &law)
                 { initialise_point(law, normal, shear, history, 2 * i + k); });
      }
    }
  }

  double MatchedJoints::n_beyond_strength(const JointHistory &history,
                                          const MPI_Comm communicator) const
  {
    // Tractions at the limit are not beyond it.
    constexpr double margin = 1e-9;
    double n                = 0.;
    for (unsigned int i = 0; i < segments.size(); ++i)
      for (unsigned int p = 2 * i; p < 2 * i + 2; ++p)
      {
        const unsigned int set = segments[i].set;
        const double sigma     = history.normal_traction[p];
        const double tau       = history.shear_traction[p];
        const double size      = std::abs(sigma) + std::abs(tau);
        bool is_beyond;
        if (rocks[set])
        {
          // Their strength depends on their history.
          is_beyond
              = !std::visit([&](const auto &law)
                            { return law.holds(read_point(law, history, p)); },
                            *rocks[set]);
        }
        else
        {
          const JointStrength &peak = laws[set].peak;
          is_beyond                 = sigma > peak.tension + margin * size
                      || std::abs(tau) + sigma * peak.friction
                             > peak.cohesion + margin * size;
        }
        if (is_beyond)
          n += segments[i].share;
      }
    return dealii::Utilities::MPI::sum(n, communicator);
  }

  void MatchedJoints::add_traction_forces(const unsigned int i,
                                          const NodeRecord *nodes,
                                          const JointHistory &history,
                                          NodeVector *force) const
  {
    const Segment &segment = segments[i];
    const Frame local      = frame(segment, nodes);
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double f
            = segment.area[k]
              * (history.normal_traction[2 * i + k] * local.normal[d]
                 + history.shear_traction[2 * i + k] * local.tangent[d]);
        force[segment.lower[k]].v[d] += f;
        force[segment.upper[k]].v[d] -= f;
      }
  }

  void MatchedJoints::let_go(const unsigned int i, JointHistory &history) const
  {
    history.handed_over[i] = 1;
    for (const unsigned int p : { 2 * i, 2 * i + 1 })
    {
      history.normal_traction[p] = history.shear_traction[p] = 0.;
      history.state[p]                                       = JointState::open;
    }
  }

  void MatchedJoints::begin_anew(const unsigned int i, const NodeRecord *nodes,
                                 JointHistory &history) const
  {
    history.handed_over[i] = 0;
    const auto gap         = gaps(nodes, i);
    for (unsigned int k = 0; k < 2; ++k)
    {
      const unsigned int p       = 2 * i + k;
      history.normal_traction[p] = history.shear_traction[p] = 0.;
      history.plastic_opening[p]                             = gap[k][0];
      history.plastic_slip[p]                                = gap[k][1];
      history.state[p] = JointState::intact;
      if (!history.bond.empty())
      {
        history.bond[p]     = 1.;
        history.crushing[p] = history.crack_opening[p] = 0.;
      }
      if (!history.worn_slip.empty())
        history.worn_slip[p] = history.dilated[p] = history.reload[p] = 0.;
    }
  }

  void MatchedJoints::set_laws(const std::vector<JointSetParameters> &sets)
  {
    laws.clear();
    composites.clear();
    rocks.clear();
    for (const auto &set : sets)
    {
      laws.push_back(set.law);
      composites.push_back(set.composite);
      rocks.push_back(set.rock);
    }
    const auto is_given = [](const auto &law) { return law.has_value(); };
    softens = std::any_of(composites.begin(), composites.end(), is_given);
    wears   = std::any_of(rocks.begin(), rocks.end(), is_given);
  }

  void MatchedJoints::keep_tractions(const NodeRecord *nodes,
                                     JointHistory &history) const
  {
    for (unsigned int i = 0; i < segments.size(); ++i)
    {
      if (history.handed_over[i])
        continue;
      const unsigned int set = segments[i].set;
      const bool is_coulomb  = !composites[set] && !rocks[set];
      const auto gap         = gaps(nodes, i);
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int p   = 2 * i + k;
        const JointState state = history.state[p];
        // What is open keeps what its opening counts from.
        if (state == JointState::open && (is_coulomb || rocks[set]))
          continue;
        const double worn = rocks[set] ? history.worn_slip[p] : 0.;
        with_law(set,
                 [&](const auto &law)
                 {
                   initialise_point(law, history.normal_traction[p],
                                    history.shear_traction[p], history, p);
                 });
        if (rocks[set]) // as worn as it was
          history.worn_slip[p] = worn;
        history.state[p] = state;
        history.plastic_opening[p] += gap[k][0];
        history.plastic_slip[p] += gap[k][1];
      }
    }
  }
} // namespace quoin
