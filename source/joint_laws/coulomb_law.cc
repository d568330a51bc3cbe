// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/joint_laws/coulomb_law.h>
#include <quoin/joint_laws/law_entries.h>

namespace quoin
{
  namespace
  {
    JointStrength divided(const JointStrength &strength, const double factor)
    {
      return { strength.cohesion / factor, strength.friction / factor,
               strength.tension / factor };
    }

    /** What of @p strength differs from @p other. */
    std::string strength_text(const JointStrength &strength,
                              const JointStrength &other)
    {
      std::string text;
      const auto add = [&](const std::string &part)
      { text += (text.empty() ? "" : ", ") + part; };
      if (strength.friction != other.friction)
        add(named_number("friction angle",
                         std::atan(strength.friction) / constants::degree,
                         "degrees"));
      if (strength.cohesion != other.cohesion)
        add(named_number("cohesion", strength.cohesion, "Pa"));
      if (strength.tension != other.tension)
        add(named_number("tensile strength", strength.tension, "Pa"));
      return text;
    }
  } // namespace

  CoulombLaw CoulombLaw::read(LawEntries &entries)
  {
    CoulombLaw law;
    entries.positive("Normal stiffness", law.normal_stiffness,
                     "normal stiffness kn", "Pa/m");
    entries.positive("Shear stiffness", law.shear_stiffness,
                     "shear stiffness ks", "Pa/m");
    if (entries.law() == "elastic")
      return law;

    law.peak                        = { 0., 0., 0. };
    law.critical_shear_displacement = 1e300;
    double peak_angle = 0., dilation_angle = 0.;
    entries.nonnegative("Cohesion", law.peak.cohesion, "peak cohesion c", "Pa");
    entries.within("Friction angle", peak_angle, 0., 89., "friction angle phi",
                   "deg");
    entries.nonnegative("Tensile strength", law.peak.tension,
                        "tensile strength ft", "Pa");
    law.peak.friction = tangent_of_degrees(peak_angle);
    law.residual      = law.peak;

    double failed_angle = peak_angle;
    if (entries.law() == "Coulomb")
    {
      law.residual.cohesion = law.residual.tension = 0.;
      entries.nonnegative("Residual cohesion", law.residual.cohesion,
                          "cohesion of the failed joint", "Pa");
      entries.angle_or_same("Residual friction angle", failed_angle,
                            "friction angle of the failed joint, at most "
                            "'Friction angle' where it "
                            "loses no cohesion, or "
                            "'same' as it");
      entries.nonnegative("Residual tensile strength", law.residual.tension,
                          "tensile strength of the failed joint", "Pa");
      entries.check_residual_angle(failed_angle, peak_angle,
                                   law.residual.cohesion < law.peak.cohesion);
      entries.check(law.residual.cohesion <= law.peak.cohesion,
                    "Residual cohesion", "must not exceed 'Cohesion'.");
      entries.check(law.residual.tension <= law.peak.tension,
                    "Residual tensile strength",
                    "must not exceed 'Tensile strength'.");
      law.residual.friction = tangent_of_degrees(failed_angle);
    }
    else
    {
      law.is_no_tension = true;
      entries.check(law.peak.tension == 0., "Tensile strength",
                    "must be 0 for the law 'no tension'; use the law "
                    "'Coulomb' for a joint that holds tension.");
    }

    // A joint dilates once it has failed: beyond the residual friction that
    // would create energy.
    entries.within("Dilation angle", dilation_angle, 0.,
                   std::min(peak_angle, failed_angle),
                   "dilation angle psi, at most the smaller of the friction "
                   "angles before and after failure",
                   "deg");
    law.dilation = tangent_of_degrees(dilation_angle);
    entries.nonnegative("Critical shear displacement",
                        law.critical_shear_displacement,
                        "slip, its elastic part included, beyond which the "
                        "joint no longer dilates",
                        "m");
    return law;
  }

  std::string CoulombLaw::text() const
  {
    if (!behaviour().fails)
      return "elastic";
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (is_no_tension)
      return "no tension, " + strength_text(peak, { nan, nan, 0. });
    const std::string failed = strength_text(residual, peak);
    return "Coulomb, " + strength_text(peak, { nan, nan, nan })
           + (failed.empty() ? "" : " (once failed " + failed + ")");
  }

  std::string CoulombLaw::warning() const
  {
    const double apex = peak.cohesion / peak.friction;
    // The failed joint keeps its tension, but bears no shear beyond its apex.
    if (!behaviour().fails || !(peak.tension > (1. + 1e-6) * apex))
      return "";
    return text_of("'Tensile strength = ", peak.tension,
                   "' Pa is above cohesion / tan(friction angle), ", apex,
                   " Pa, at which the least shear breaks the joint: that acts "
                   "in its place. Give at most that.");
  }

  CoulombLaw CoulombLaw::reduced(const double factor) const
  {
    CoulombLaw weak = *this;
    weak.peak       = divided(peak, factor);
    weak.residual   = divided(residual, factor);
    weak.dilation   = std::min(
          dilation, std::min(weak.peak.friction, weak.residual.friction));
    return weak;
  }
} // namespace quoin
