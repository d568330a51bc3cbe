// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/face_contacts.h>
#include <quoin/contact_geometry/pair_lanes.h>
#include <quoin/operators/archive.h>

#include <cmath>

namespace quoin
{
  FaceContact contact_on_face(const BlockContacts &contacts,
                              const State<2> &state,
                              const JointSegment &segment, const unsigned int k)
  {
    FaceContact result;
    const ContactState &all = state.get<ContactState>();
    if (!contacts.is_bound(all))
      return result;
    const NearPairs &near     = contacts.near_pairs();
    const MovingEdges &moving = near.moving_edges();
    const unsigned int edge   = moving.local_edge(
          contacts.contact_edges().joint_edges(segment.face).edges[0]);
    if (edge == moving.n_edges()) // no pair has it
      return result;
    double nearest = 0.5; // of the length of the face
    for (const unsigned int i : near.entries_of(edge))
    {
      NearPairs::Geometry g;
      if (i >= all.pairs.size() || !all.pairs[i].active
          || !near.geometry(all.pairs[i], i, g))
        continue;
      const ContactPair &pair = all.pairs[i];
      const double *place     = near.edges_of(i)[0] == edge ? g.lower : g.upper;
      for (unsigned int end = 0; end < 2; ++end)
        if (const double distance = std::abs(place[end] - double(k));
            distance < nearest)
        {
          nearest = distance;
          result  = { &pair.points[end], pair.set };
        }
    }
    return result;
  }
} // namespace quoin
