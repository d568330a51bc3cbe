// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/joint_laws/continuously_yielding_law.h>
#include <quoin/joint_laws/law_entries.h>

namespace quoin
{
  using constants::degree;

  PowerClosure::PowerClosure(const PowerStiffness &stiffness)
    : law(stiffness), low_stiffness(law.at(law.lowest)),
      high_stiffness(law.at(law.highest)),
      low_closure(law.lowest / low_stiffness)
  {
    const double e     = 1. - law.exponent;
    const double ratio = law.highest / law.lowest;
    high_closure
        = low_closure
          * (1. + (e == 0. ? std::log(ratio) : (std::pow(ratio, e) - 1.) / e));
  }

  double PowerClosure::closure(const double traction) const
  {
    if (traction <= law.lowest)
      return traction / low_stiffness;
    if (traction >= law.highest)
      return high_closure + (traction - law.highest) / high_stiffness;
    const double e     = 1. - law.exponent;
    const double ratio = traction / law.lowest;
    return low_closure
           * (1. + (e == 0. ? std::log(ratio) : (std::pow(ratio, e) - 1.) / e));
  }

  double PowerClosure::energy(const double traction) const
  {
    if (traction <= law.lowest)
      return 0.5 * traction * traction / low_stiffness;
    const double curved = std::min(traction, law.highest);
    const double e      = 2. - law.exponent;
    const double beyond = traction - curved;
    return law.lowest * low_closure
               * (0.5 + (std::pow(curved / law.lowest, e) - 1.) / e)
           + (0.5 * beyond + curved) * beyond / high_stiffness;
  }

  ContinuouslyYieldingLaw ContinuouslyYieldingLaw::read(LawEntries &entries)
  {
    refuse_bond(entries);
    PowerStiffness normal;
    normal.reference_traction = 1e6;
    normal.lowest             = 1e4;
    normal.highest            = 1e8;
    entries.positive("Reference stress", normal.reference_traction,
                     "normal pressure at which the stiffnesses are 'Normal "
                     "stiffness' and 'Shear stiffness'",
                     "Pa");
    entries.positive("Lowest stress", normal.lowest,
                     "normal pressure below which the stiffnesses are constant",
                     "Pa");
    entries.positive("Highest stress", normal.highest,
                     "normal pressure above which the stiffnesses are "
                     "constant, on which the critical time step is based",
                     "Pa");
    entries.check(normal.highest >= normal.lowest, "Highest stress",
                  "must not be less than 'Lowest stress', below which "
                  "stiffnesses are constant too.");
    PowerStiffness shear = normal;
    entries.positive("Normal stiffness", normal.reference,
                     "normal stiffness kn at 'Reference stress'", "Pa/m");
    entries.within(
        "Normal exponent", normal.exponent, 0., 1.,
        "exponent of the normal pressure in the normal stiffness, from 0 to 1",
        "-");
    entries.positive("Shear stiffness", shear.reference,
                     "shear stiffness ks at 'Reference stress'", "Pa/m");
    entries.within(
        "Shear exponent", shear.exponent, 0., 1.,
        "exponent of the normal pressure in the shear stiffness, from 0 to 1",
        "-");

    ContinuouslyYieldingLaw law{ {}, PowerClosure(normal), shear };
    law.residual_angle = read_residual_angle(entries);
    double angle       = 0.;
    entries.within("Friction angle", angle, 0., 89.,
                   "friction angle of the unworn joint", "deg");
    law.initial_angle = angle * degree;
    entries.check(law.initial_angle >= law.residual_angle, "Friction angle",
                  "must not be less than 'Residual friction angle': it is that "
                  "of the joint before it is worn.");
    entries.positive("Roughness", law.roughness,
                     "roughness parameter R, the inelastic slip over which the "
                     "friction angle decreases from 'Friction angle' towards "
                     "'Residual friction angle'",
                     "m");
    return law;
  }

  std::string ContinuouslyYieldingLaw::text() const
  {
    return "continuously yielding, "
           + named_number("friction angle from", initial_angle / degree,
                          "degrees")
           + " " + named_number("down to", residual_angle / degree, "degrees");
  }

  ContinuouslyYieldingLaw
  ContinuouslyYieldingLaw::reduced(const double factor) const
  {
    ContinuouslyYieldingLaw weak = *this;
    weak.initial_angle           = std::atan(std::tan(initial_angle) / factor);
    weak.residual_angle          = std::atan(std::tan(residual_angle) / factor);
    return weak;
  }
} // namespace quoin
