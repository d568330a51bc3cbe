// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_joint_handover_h
#define quoin_contact_joint_handover_h

#include <quoin/contact_geometry/contact_edges.h>
#include <quoin/joint_elements/matched_joints.h>

// Matched joints that become general contacts.

namespace quoin
{
  /** Marks interfaces with joints of this rank that are to become general
      contacts, ContactState::handed_over, because an end that has failed has
      slipped or opened by more than @p share of the length of its edge; whether
      there are any. */
  bool find_handovers(const ContactEdges &edges, const MatchedJoints &joints,
                      double share, State<2> &state);

  /** Makes general contacts of the joints of marked interfaces. Collective. */
  void hand_over(const ContactEdges &edges, const MatchedJoints &joints,
                 MPI_Comm communicator, State<2> &state);
} // namespace quoin

#endif
