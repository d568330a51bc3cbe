// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_dashpot_forces_h
#define quoin_source_joint_elements_dashpot_forces_h

#include <quoin/joint_elements/dashpot_tractions.h>
#include <quoin/joint_elements/joint_dashpots.h>

#include <type_traits>

#include "joint_rates.h"

namespace quoin
{
  /** Whether a dashpot acts at point @p p: a point that never failed carries
      tension, too, but of rock joints, which stiffen. */
  template <int dim, typename Law, typename History>
  bool bears(const unsigned int p, const History &history,
             const std::uint8_t *gone)
  {
    return !gone[p / dim]
           && (history.normal_traction[p] < 0.
               || (history.state[p] == JointState::intact && !Law::stiffens));
  }

  template <int dim, typename Face, typename History>
  void JointDashpots::add_forces(const std::vector<Face> &faces,
                                 const std::vector<JointLaw> &laws,
                                 const NodeRecord<dim> *nodes,
                                 const History &history,
                                 const std::uint8_t *gone,
                                 const dealii::Tensor<1, dim> *velocity,
                                 dealii::Tensor<1, dim> *force)
  {
    pairs.clear();
    for (unsigned int p = 0; p < dim * faces.size(); ++p)
      std::visit(
          [&](const auto &law)
          {
            using Law = std::decay_t<decltype(law)>;
            if (!bears<dim, Law>(p, history, gone))
              return;
            const Face &face    = faces[p / dim];
            const double area   = point_area(face, p % dim);
            const auto [kn, ks] = law.stiffness_at(history.normal_traction[p]);
            pairs.add_springs(p / dim, face.share, area * kn, area * ks);
          },
          laws[faces[p / dim].set]);
    pairs.sum_over_ranks();

    for (unsigned int i = 0; i < faces.size(); ++i)
      add_face_forces(i, faces, laws, nodes, history, gone, velocity, force);
  }

  template <int dim, typename Face, typename History>
  void JointDashpots::add_face_forces(const unsigned int i,
                                      const std::vector<Face> &faces,
                                      const std::vector<JointLaw> &laws,
                                      const NodeRecord<dim> *nodes,
                                      const History &history,
                                      const std::uint8_t *gone,
                                      const dealii::Tensor<1, dim> *velocity,
                                      dealii::Tensor<1, dim> *force) const
  {
    // The frame of a face that has gone may be anything, also none at all where
    // its edges lie against each other.
    const JointDamping &damping = all_dampings[faces[i].set];
    if (!damping.acts() || gone[i])
      return;
    std::visit(
        [&](const auto &law)
        {
          using Law = std::decay_t<decltype(law)>;
          add_rate_forces(
              faces[i], nodes, velocity,
              [&](const unsigned int k)
              { return bears<dim, Law>(dim * i + k, history, gone); },
              [&](const unsigned int k, const PointMotion<dim> &motion)
              {
                const unsigned int p = dim * i + k;
                JointVector<dim> gap = motion.gap;
                gap.shear = slip_since_placing(history, p, gap.shear);
                return dashpot_tractions<dim>(
                    law, read_point(law, history, p), gap, motion.rate,
                    pairs.times(i, damping,
                                law.stiffness_at(history.normal_traction[p])));
              },
              force);
        },
        laws[faces[i].set]);
  }
} // namespace quoin

#endif
