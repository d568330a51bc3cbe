// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_face_contacts_h
#define quoin_contact_face_contacts_h

#include <quoin/contact/block_contacts.h>

// What lies on the faces of joints that have become general contacts.

namespace quoin
{
  /** A point of a general contact on a face. */
  struct FaceContact
  {
    const ContactPoint *point = nullptr; /**< null: nothing lies there */
    unsigned int set          = 0;       /**< whose law it follows */

    JointState state() const
    {
      return point ? point->state : JointState::open;
    }
  };

  /**
   * The point of @p contacts on the lower face of @p segment that is nearest to
   * its vertex @p k and within the half of the face for which the point of the
   * joint stood, whatever block lies on it now. On the rank of the lower face,
   * for the pairs of the last step; before the first one there is none.
   */
  FaceContact contact_on_face(const BlockContacts &contacts,
                              const State<2> &state,
                              const JointSegment &segment, unsigned int k);
} // namespace quoin

#endif
