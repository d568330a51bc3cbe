// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_dashpot_forces_h
#define quoin_source_joint_elements_dashpot_forces_h

#include <quoin/joint_elements/dashpot_tractions.h>
#include <quoin/joint_elements/joint_dashpots.h>

#include "joint_rates.h"

namespace quoin
{
  template <int dim, typename Face, typename History>
  void JointDashpots::add_forces(const std::vector<Face> &faces,
                                 const std::vector<JointLaw> &laws,
                                 const NodeRecord<dim> *nodes,
                                 const History &history,
                                 const std::uint8_t *gone,
                                 const dealii::Tensor<1, dim> *velocity,
                                 dealii::Tensor<1, dim> *force)
  {
    // A point that never failed carries tension, too, but of rock joints, which
    // stiffen.
    const auto bears = [&](const unsigned int p)
    {
      return !gone[p / dim]
             && (history.normal_traction[p] < 0.
                 || (history.state[p] == JointState::intact
                     && !stiffens(laws[faces[p / dim].set])));
    };
    const auto stiffness = [&](const unsigned int p)
    {
      return std::visit(
          [&](const auto &law)
          { return law.stiffness_at(history.normal_traction[p]); },
          laws[faces[p / dim].set]);
    };
    pairs.clear();
    for (unsigned int p = 0; p < dim * faces.size(); ++p)
      if (bears(p))
      {
        const Face &face    = faces[p / dim];
        const double area   = point_area(face, p % dim);
        const auto [kn, ks] = stiffness(p);
        pairs.add_springs(p / dim, face.share, area * kn, area * ks);
      }
    pairs.sum_over_ranks();

    for (unsigned int i = 0; i < faces.size(); ++i)
      if (const JointDamping &damping = all_dampings[faces[i].set];
          damping.acts())
        std::visit(
            [&](const auto &law)
            {
              add_rate_forces(
                  faces[i], nodes, velocity,
                  [&](const unsigned int k) { return bears(dim * i + k); },
                  [&](const unsigned int k, const PointMotion<dim> &motion)
                  {
                    const unsigned int p = dim * i + k;
                    return dashpot_tractions<dim>(
                        law, read_point(law, history, p), motion.gap,
                        motion.rate, pairs.times(i, damping, stiffness(p)));
                  },
                  force);
            },
            laws[faces[i].set]);
  }
} // namespace quoin

#endif
