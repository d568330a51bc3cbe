// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joints/barton_bandis_law.h>

namespace quoin
{
  HyperbolicClosure::HyperbolicClosure(const double first,
                                       const double largest_closure,
                                       const double largest)
    : first(first), limit(largest_closure), largest(largest)
  {
    const double root = std::sqrt(first / largest);
    end_closure       = limit * (1. - root);
    end_traction      = first * end_closure / root;
  }

  double HyperbolicClosure::closure(const double traction) const
  {
    if (traction >= end_traction)
      return end_closure + (traction - end_traction) / largest;
    return traction / (first + traction / limit);
  }

  double HyperbolicClosure::stiffness(const double traction) const
  {
    if (traction >= end_traction)
      return largest;
    const double growth = 1. + traction / (first * limit);
    return first * growth * growth;
  }

  double HyperbolicClosure::energy(const double traction) const
  {
    const double curved = std::min(traction, end_traction);
    const double v      = closure(curved) / limit;
    const double beyond = (traction - curved) / largest;
    return first * limit * limit * (-v - std::log1p(-v))
           + 0.5 * (traction + curved) * beyond;
  }

  void BartonBandisLaw::initialise(RockPoint &point, const double normal,
                                   const double shear) const
  {
    const double traction = std::max(0., -normal);
    const double tau      = traction > 0. ? shear : 0.;
    point.normal_traction = -traction;
    point.shear_traction  = tau;
    point.plastic_opening = closure.closure(traction);
    point.plastic_slip    = -tau / stiffness;
    point.worn_slip       = 0.;
    if (tau == 0.)
      return;

    // The rising branch of the mobilisation, turned round.
    using Table          = RoughnessTable;
    const double angle   = std::atan(divisor * std::abs(tau) / traction);
    const double peak    = peak_roughness(traction);
    const double excess  = angle - residual_angle;
    constexpr double top = 1.;
    double slip          = top;
    if (excess <= 0.)
      slip = Table::slip[0] * angle / residual_angle;
    else
      for (unsigned int i = 0; Table::share[i] < top; ++i)
        if (excess < peak * Table::share[i + 1])
        {
          slip = Table::slip[i]
                 + (Table::slip[i + 1] - Table::slip[i])
                       * (excess / peak - Table::share[i])
                       / (Table::share[i + 1] - Table::share[i]);
          break;
        }
    slip *= 1. + 1e-9; // so that rounding does not make it slip
    point.worn_slip
        = std::max(0., slip * peak_slip - std::abs(tau) / stiffness);
  }
} // namespace quoin
