// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How MatchedJoints begin: under stress, anew, or with other laws.

#include <quoin/contact/matched_joints.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include "joint_frame.h"
#include "joint_points.h"

namespace quoin
{
  namespace
  {
    /** keep_tractions() of point @p p, whose opening and slip are @p gap. */
    template <typename Law>
    void keep_traction(const Law &law, const std::array<double, 2> &gap,
                       JointHistory &history, const unsigned int p)
    {
      auto point = read_point(law, history, p);
      // What is open keeps what its opening counts from, unless it may bear
      // tension.
      if (point.state == JointState::open && !Law::bridges)
        return;
      auto at_rest = point;
      law.initialise(at_rest, point.normal_traction, point.shear_traction);
      point.normal_traction = at_rest.normal_traction;
      point.shear_traction  = at_rest.shear_traction;
      point.plastic_opening = at_rest.plastic_opening + gap[0];
      point.plastic_slip    = at_rest.plastic_slip + gap[1];
      write_point(point, history, p);
    }
  } // namespace

  JointHistory MatchedJoints::make_history() const
  {
    unsigned int most = 0;
    for (const JointLaw &law : laws)
      most = std::max(most, n_internal(law));
    JointHistory history;
    history.resize(n_points(), most);
    for (unsigned int i = 0; i < segments.size(); ++i)
      with_law(segments[i].set,
               [&](const auto &law)
               {
                 for (const unsigned int p : { 2 * i, 2 * i + 1 })
                   write_point(PointOf<decltype(law)>(), history, p);
               });
    return history;
  }

  void MatchedJoints::initialise(const std::vector<FaceStress> &face_stress,
                                 const State<2> &state,
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
        with_law(segments[i].set,
                 [&](const auto &law)
                 {
                   auto point = read_point(law, history, 2 * i + k);
                   law.initialise(point, normal, shear);
                   write_point(point, history, 2 * i + k);
                 });
      }
    }
  }

  double MatchedJoints::n_beyond_strength(const JointHistory &history,
                                          const MPI_Comm communicator) const
  {
    double n = 0.;
    for (unsigned int i = 0; i < segments.size(); ++i)
      with_law(segments[i].set,
               [&](const auto &law)
               {
                 for (const unsigned int p : { 2 * i, 2 * i + 1 })
                   if (!law.holds(read_point(law, history, p)))
                     n += segments[i].share;
               });
    return dealii::Utilities::MPI::sum(n, communicator);
  }

  void MatchedJoints::add_traction_forces(const unsigned int i,
                                          const NodeRecord<2> *nodes,
                                          const JointHistory &history,
                                          NodeVector<2> *force) const
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

  void MatchedJoints::detach(const unsigned int i, JointHistory &history) const
  {
    history.handed_over[i] = 1;
    for (const unsigned int p : { 2 * i, 2 * i + 1 })
    {
      history.normal_traction[p] = history.shear_traction[p] = 0.;
      history.state[p]                                       = JointState::open;
    }
  }

  void MatchedJoints::begin_anew(const unsigned int i,
                                 const NodeRecord<2> *nodes,
                                 JointHistory &history) const
  {
    history.handed_over[i] = 0;
    const auto gap         = gaps(nodes, i);
    with_law(segments[i].set,
             [&](const auto &law)
             {
               for (unsigned int k = 0; k < 2; ++k)
               {
                 PointOf<decltype(law)> point;
                 point.plastic_opening = gap[k][0];
                 point.plastic_slip    = gap[k][1];
                 write_point(point, history, 2 * i + k);
               }
             });
  }

  void MatchedJoints::set_laws(const std::vector<JointSetParameters> &sets)
  {
    laws.clear();
    for (const auto &set : sets)
      laws.push_back(set.law);
  }

  void MatchedJoints::keep_tractions(const NodeRecord<2> *nodes,
                                     JointHistory &history) const
  {
    for (unsigned int i = 0; i < segments.size(); ++i)
    {
      if (history.handed_over[i])
        continue;
      const auto gap = gaps(nodes, i);
      with_law(segments[i].set,
               [&](const auto &law)
               {
                 for (unsigned int k = 0; k < 2; ++k)
                   keep_traction(law, gap[k], history, 2 * i + k);
               });
    }
  }
} // namespace quoin
