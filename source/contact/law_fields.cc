// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/law_fields.h>

#include <algorithm>

#include "joint_points.h"

namespace quoin
{
  std::vector<std::string> law_field_names(const MatchedJoints &joints)
  {
    std::vector<std::string> names;
    for (const JointLaw &law : joints.laws())
      std::visit(
          [&](const auto &own)
          {
            for (const auto &field : own.template fields<2>())
              if (std::find(names.begin(), names.end(), field.name)
                  == names.end())
                names.push_back(field.name);
          },
          law);
    return names;
  }

  double law_field(const MatchedJoints &joints, const std::string &name,
                   const unsigned int p, const JointHistory &history)
  {
    double value = 0.;
    std::visit(
        [&](const auto &law)
        {
          for (const auto &field : law.template fields<2>())
            if (field.name == name)
              value = field.value(read_point(law, history, p));
        },
        joints.laws()[joints.segments()[p / 2].set]);
    return value;
  }
} // namespace quoin
