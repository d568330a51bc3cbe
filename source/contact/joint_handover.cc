// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/joint_handover.h>
#include <quoin/contact_geometry/contact_state.h>
#include <quoin/operators/archive.h>

#include <cmath>

namespace quoin
{
  bool find_handovers(const ContactEdges &edges, const MatchedJoints &joints,
                      const double share, State<2> &state)
  {
    ContactState &contacts      = state.get<ContactState>();
    const JointHistory &history = state.get<JointHistory>();
    bool found                  = false;
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointEdges &joint = edges.joint_edges(joints.segments()[i].face);
      if (history.handed_over[i]
          || (history.state[2 * i] == JointState::intact
              && history.state[2 * i + 1] == JointState::intact)
          || edges.has_tip(joint.interface))
        continue;
      const double limit = share * edges[joint.edges[0]].length;
      const auto gaps    = joint_gaps(joints.segments()[i], state.nodes.data());
      for (const auto &[opening, slip] : gaps)
        if (opening > limit || std::abs(slip) > limit)
        {
          contacts.handed_over[joint.interface] = 1;
          found                                 = true;
        }
    }
    return found;
  }

  void hand_over(const ContactEdges &edges, const MatchedJoints &joints,
                 const MPI_Comm communicator, State<2> &state)
  {
    ContactState &contacts = state.get<ContactState>();
    JointHistory &history  = state.get<JointHistory>();
    // Joints between two blocks go together, whatever their ranks.
    MPI_Allreduce(MPI_IN_PLACE, contacts.handed_over.data(),
                  contacts.handed_over.size(), MPI_UINT8_T, MPI_MAX,
                  communicator);
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointEdges &joint = edges.joint_edges(joints.segments()[i].face);
      if (history.handed_over[i] || !contacts.handed_over[joint.interface])
        continue;
      const auto &segment = joints.segments()[i];
      const auto gaps = joint_gaps(joints.segments()[i], state.nodes.data());
      ContactPair pair;
      pair.lower       = joint.edges[0];
      pair.upper       = joint.edges[1];
      pair.set         = segment.set;
      pair.active      = 1;
      pair.was_joint   = 1;
      pair.shift       = 0.5 * (gaps[0][1] + gaps[1][1]);
      pair.shift_start = pair.shift;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int p  = 2 * i + k;
        ContactPoint &point   = pair.points[k];
        point.normal_traction = history.normal_traction[p];
        point.shear_traction  = history.shear_traction[p];
        point.plastic_slip    = history.plastic_slip[p];
        point.plastic_opening = history.plastic_opening[p];
        for (unsigned int j = 0; j < JointHistory::most_internal; ++j)
          if (!history.internal[j].empty())
            point.internal[j] = history.internal[j][p];
        point.state   = history.state[p];
        point.area    = segment.area[k];
        point.opening = gaps[k][0];
        // The vertices that coincided; the upper edge runs backwards.
        point.anchor_lower         = k;
        point.anchor_upper         = 1. - k;
        history.normal_traction[p] = 0.;
        history.shear_traction[p]  = 0.;
        history.state[p]           = JointState::open;
      }
      history.handed_over[i] = 1;
      contacts.pairs.push_back(pair);
    }
  }
} // namespace quoin
