// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joints/continuously_yielding_law.h>

namespace quoin
{
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

  void ContinuouslyYieldingLaw::initialise(RockPoint &point,
                                           const double normal,
                                           const double shear) const
  {
    const double traction = std::max(0., -normal);
    point.normal_traction = -traction;
    point.shear_traction  = traction > 0. ? shear : 0.;
    point.plastic_opening = closure.closure(traction);
    point.plastic_slip    = -point.shear_traction / shear_stiffness(traction);
  }
} // namespace quoin
