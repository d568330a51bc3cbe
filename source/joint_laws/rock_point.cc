// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/joint_laws/law_entries.h>
#include <quoin/joint_laws/rock_point.h>

namespace quoin
{
  double read_residual_angle(LawEntries &entries)
  {
    const std::string name = "Residual friction angle";
    double angle           = 0.;
    const bool is_given    = entries.angle_or_same(
           name, angle, "friction angle of the worn joint");
    entries.check(is_given, name,
                  "must be given for this law: the angle that is left when "
                  "the joint is smooth, in degrees.");
    entries.check(angle > 0. && angle < 70., name,
                  "must lie between 0 and 70 degrees for this law.");
    return angle * constants::degree;
  }

  void refuse_bond(LawEntries &entries)
  {
    for (const char *name :
         { "Cohesion", "Tensile strength", "Residual cohesion",
           "Residual tensile strength", "Dilation angle" })
      entries.zero(name, "must be 0 for this law, whose strength is "
                         "friction and whose dilation follows from it. "
                         "Use 'Coulomb' for a joint that is bonded.");
  }
} // namespace quoin
