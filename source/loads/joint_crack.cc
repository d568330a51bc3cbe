// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/loads/joint_crack.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace quoin
{
  JointCrack::JointCrack(const UpliftDiagram &diagram,
                         const std::vector<std::string> &curves,
                         const std::string &load, const NodeMap<2> &nodes,
                         const MatchedJoints &joints)
    : nodes(nodes), joints(joints)
  {
    begin = end = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointSegment &segment = joints.segments()[i];
      const std::string &name
          = nodes.table().face_names[nodes.faces().joints[segment.face].name];
      if (!std::count(curves.begin(), curves.end(), name))
        continue;
      const double s[2] = { diagram.distance(nodes.point(segment.lower[0])),
                            diagram.distance(nodes.point(segment.lower[1])) };
      const unsigned int near = s[0] < s[1] ? 0 : 1;
      faces.push_back({ i, near, { s[near], s[1 - near] } });
      begin = std::min(begin, s[near]);
      end   = std::min(end, -s[1 - near]); // the last one, in one message
    }
    double ends[2] = { begin, end };
    MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MIN,
                  nodes.communicator());
    begin = ends[0];
    end   = -ends[1];
    if (begin > end)
      throw InputError("section 'Loads/" + load
                       + "': 'In cracks = full head', but there is no joint on "
                         "'Boundary' that could open. Name the joint below the "
                         "dam, or take 'given'.");
  }

  double JointCrack::length(const State<2> &state) const
  {
    const JointHistory &history = state.get<JointHistory>();
    double tip                  = end;
    for (const Face &face : faces)
    {
      const unsigned int a = 2 * face.segment + face.near,
                         b = 2 * face.segment + 1 - face.near;
      if (history.state[a] != JointState::open)
        tip = std::min(tip, face.distances[0]);
      else if (history.state[b] != JointState::open)
      {
        const auto gaps
            = joint_gaps(joints.segments()[face.segment], state.nodes.data());
        const double open
            = std::max(0., gaps[face.near][0] - history.plastic_opening[a]);
        const double close
            = std::max(0., history.plastic_opening[b] - gaps[1 - face.near][0]);
        const double share = open > 0. ? open / (open + close) : 0.;
        tip                = std::min(tip,
                                      face.distances[0]
                                          + share * (face.distances[1] - face.distances[0]));
      }
    }
    tip = dealii::Utilities::MPI::min(tip, nodes.communicator());
    return tip <= begin ? 0. : tip;
  }
} // namespace quoin
