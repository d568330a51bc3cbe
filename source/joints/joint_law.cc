// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joints/joint_law.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    JointStrength divided(const JointStrength &strength, const double factor)
    {
      return { strength.cohesion / factor, strength.friction / factor,
               strength.tension / factor };
    }

    CoulombLaw weaker(const CoulombLaw &law, const double factor)
    {
      CoulombLaw weak = law;
      weak.peak       = divided(law.peak, factor);
      weak.residual   = divided(law.residual, factor);
      weak.dilation   = std::min(
            law.dilation, std::min(weak.peak.friction, weak.residual.friction));
      return weak;
    }

    CompositeLaw weaker(const CompositeLaw &law, const double factor)
    {
      CompositeLaw weak = law;
      weak.tension /= factor;
      weak.cohesion /= factor;
      weak.friction /= factor;
      weak.residual_friction /= factor;
      weak.dilation = std::min(law.dilation,
                               std::min(weak.friction, weak.residual_friction));
      return weak;
    }

    BartonBandisLaw weaker(const BartonBandisLaw &law, const double factor)
    {
      BartonBandisLaw weak = law;
      weak.divisor *= factor;
      return weak;
    }

    ContinuouslyYieldingLaw weaker(const ContinuouslyYieldingLaw &law,
                                   const double factor)
    {
      ContinuouslyYieldingLaw weak = law;
      weak.initial_angle  = std::atan(std::tan(law.initial_angle) / factor);
      weak.residual_angle = std::atan(std::tan(law.residual_angle) / factor);
      return weak;
    }
  } // namespace

  std::array<double, 2> stiffness_bound(const JointLaw &law)
  {
    return std::visit(
        [](const auto &own) -> std::array<double, 2>
        {
          if constexpr (is_rock_law<std::decay_t<decltype(own)>>)
            return { own.closure.largest_stiffness(),
                     own.largest_shear_stiffness() };
          else
            return { own.normal_stiffness, own.shear_stiffness };
        },
        law);
  }

  bool stiffens(const JointLaw &law)
  {
    return std::visit([](const auto &own)
                      { return is_rock_law<std::decay_t<decltype(own)>>; },
                      law);
  }

  bool can_fail(const JointLaw &law)
  {
    const auto *coulomb = std::get_if<CoulombLaw>(&law);
    return !coulomb || std::isfinite(coulomb->peak.tension);
  }

  bool can_dilate(const JointLaw &law)
  {
    const auto *coulomb = std::get_if<CoulombLaw>(&law);
    return !coulomb || coulomb->dilation != 0.;
  }

  JointLaw reduced(const JointLaw &law, const double factor)
  {
    return std::visit(
        [=](const auto &own) -> JointLaw { return weaker(own, factor); }, law);
  }
} // namespace quoin
