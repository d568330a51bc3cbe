// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_joint_crack_h
#define quoin_loads_joint_crack_h

#include <quoin/joint_elements/matched_joints.h>
#include <quoin/loads/uplift_diagram.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * The crack that opens a joint from the heel of a dam on. It ends in the face
   * that is closed at its farther point where opening and closure, both by
   * stress, would be 0 if they were linear there, so that its length is a
   * continuous function of the state.
   */
  class JointCrack
  {
  public:
    /** Keeps references. Throws an InputError, which names @p load, if there is
        no joint on @p curves. Collective. */
    JointCrack(const UpliftDiagram &diagram,
               const std::vector<std::string> &curves, const std::string &load,
               const NodeMap<2> &nodes, const MatchedJoints &joints);

    /** Its length from the heel on in @p state [m]. Collective. */
    double length(const State<2> &state) const;

  private:
    struct Face
    {
      unsigned int segment;
      unsigned int near;   /**< point nearer to the heel, 0 or 1 */
      double distances[2]; /**< of that and of the other point [m] */
    };

    const NodeMap<2> &nodes;
    const MatchedJoints &joints;
    std::vector<Face> faces;
    double begin, end; /**< of the joint by the distance from the heel [m] */
  };
} // namespace quoin

#endif
