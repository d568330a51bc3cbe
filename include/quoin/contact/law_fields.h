// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_law_fields_h
#define quoin_contact_law_fields_h

#include <quoin/contact_geometry/contact_state.h>
#include <quoin/joint_elements/matched_joints.h>

#include <string>

namespace quoin
{
  /** Names of the fields for results that laws of the sets have. */
  std::vector<std::string> law_field_names(const MatchedJoints &joints);

  /** The field @p name at entry @p point of @p history; 0 if the law there has
      none. */
  double law_field(const MatchedJoints &joints, const std::string &name,
                   unsigned int point, const JointHistory &history);

  /** The field @p name at the @p point of a general contact that follows the
      law of @p set; 0 if the law has none. */
  double law_field(const MatchedJoints &joints, const std::string &name,
                   unsigned int set, const ContactPoint &point);
} // namespace quoin

#endif
