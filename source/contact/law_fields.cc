// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/law_fields.h>

#include <algorithm>

#include "contact_points.h"

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

  namespace
  {
    /** The field @p name of the point that @p read makes for @p law. */
    template <typename Read>
    double field_of(const JointLaw &law, const std::string &name,
                    const Read &read)
    {
      double value = 0.;
      std::visit(
          [&](const auto &own)
          {
            for (const auto &field : own.template fields<2>())
              if (field.name == name)
                value = field.value(read(own));
          },
          law);
      return value;
    }
  } // namespace

  double law_field(const MatchedJoints &joints, const std::string &name,
                   const unsigned int p, const JointHistory &history)
  {
    return field_of(joints.laws()[joints.segments()[p / 2].set], name,
                    [&](const auto &law)
                    { return read_point(law, history, p); });
  }

  double law_field(const MatchedJoints &joints, const std::string &name,
                   const unsigned int set, const ContactPoint &point)
  {
    return field_of(joints.laws()[set], name,
                    [&](const auto &law) { return read_point(law, point); });
  }
} // namespace quoin
