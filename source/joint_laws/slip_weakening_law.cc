// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/joint_laws/law_entries.h>
#include <quoin/joint_laws/slip_weakening_law.h>

#include <cmath>

namespace quoin
{
  SlipWeakeningLaw SlipWeakeningLaw::read(LawEntries &entries)
  {
    SlipWeakeningLaw law;
    double angle = 0.;
    entries.positive("Normal stiffness", law.normal_stiffness,
                     "normal stiffness kn", "Pa/m");
    entries.positive("Shear stiffness", law.shear_stiffness,
                     "shear stiffness ks", "Pa/m");
    entries.nonnegative("Cohesion", law.cohesion, "peak cohesion c", "Pa");
    entries.within("Friction angle", angle, 0., 89., "friction angle phi",
                   "deg");
    entries.nonnegative("Residual cohesion", law.residual_cohesion,
                        "cohesion of the failed joint", "Pa");
    double residual = angle;
    entries.angle_or_same(
        "Residual friction angle", residual,
        "friction angle of the failed joint, at most 'Friction angle' where it "
        "loses no cohesion, or "
        "'same' as it");
    entries.check_residual_angle(residual, angle, false);
    entries.check(law.residual_cohesion <= law.cohesion, "Residual cohesion",
                  "must not exceed 'Cohesion'.");
    law.friction          = tangent_of_degrees(angle);
    law.residual_friction = tangent_of_degrees(residual);
    entries.positive("Weakening slip", law.weakening_slip,
                     "slip-weakening distance Dc, over which cohesion and "
                     "friction decrease to their residual values",
                     "m");
    for (const char *name :
         { "Tensile strength", "Residual tensile strength", "Dilation angle" })
      entries.zero(name, "must be 0 for the law 'slip weakening', which bears "
                         "no tension and does not dilate.");
    return law;
  }

  std::string SlipWeakeningLaw::text() const
  {
    const auto angle = [](const std::string &name, const double friction)
    {
      return named_number(name, std::atan(friction) / constants::degree,
                          "degrees");
    };
    return "slip weakening, " + angle("friction angle from", friction) + " "
           + angle("down to", residual_friction) + ", "
           + named_number("cohesion from", cohesion, "Pa") + " "
           + named_number("down to", residual_cohesion, "Pa") + " over "
           + number_text(weakening_slip) + " m";
  }

  SlipWeakeningLaw SlipWeakeningLaw::reduced(const double factor) const
  {
    SlipWeakeningLaw weak = *this;
    weak.cohesion /= factor;
    weak.residual_cohesion /= factor;
    weak.friction /= factor;
    weak.residual_friction /= factor;
    return weak;
  }

  std::string SlipWeakeningLaw::warning() const
  {
    const double drop = loss(0.) / weakening_slip;
    if (drop < shear_stiffness)
      return "";
    return "the joint drops by itself at failure and does not dissipate its "
           "fracture energy. 'Shear stiffness' should be above what the "
           "strength loses by 'Weakening slip', "
           + number_text(drop) + " Pa/m without any pressure and more under "
           + "pressure.";
  }
} // namespace quoin
