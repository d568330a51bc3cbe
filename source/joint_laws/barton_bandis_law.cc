// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/joint_laws/barton_bandis_law.h>
#include <quoin/joint_laws/law_entries.h>

namespace quoin
{
  namespace
  {
    using constants::degree;

    /** Where 'Largest normal stiffness = 0' puts the end of the hyperbola. */
    constexpr double stiffening = 25.;
  } // namespace

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

  BartonBandisLaw BartonBandisLaw::read(LawEntries &entries)
  {
    refuse_bond(entries);
    entries.ignore("Friction angle");
    double first = 0., limit = 0., largest = 0.;
    entries.positive("Normal stiffness", first,
                     "normal stiffness kn of the unloaded joint", "Pa/m");
    entries.positive("Largest closure", limit,
                     "maximum closure Vm, the limit of the joint closure under "
                     "high pressure",
                     "m");
    entries.nonnegative(
        "Largest normal stiffness", largest,
        "upper limit of the normal stiffness, on which the critical time step "
        "is based; 0: 25 times 'Normal stiffness'",
        "Pa/m");
    if (largest == 0.)
      largest = stiffening * first;
    entries.check(largest >= first, "Largest normal stiffness",
                  "must not be less than 'Normal stiffness', with which the "
                  "joint begins; 0 takes 25 times that.");

    BartonBandisLaw law{ {}, HyperbolicClosure(first, limit, largest) };
    double roughness = 0., length = 0., samples = 0.;
    entries.positive("Shear stiffness", law.stiffness, "shear stiffness ks",
                     "Pa/m");
    law.residual_angle = read_residual_angle(entries);
    entries.within(
        "Joint roughness", roughness, 0., 30.,
        "joint roughness coefficient JRC, from 0 (smooth) to 20, at most 30",
        "-");
    entries.positive("Joint wall strength", law.wall_strength,
                     "joint wall compressive strength JCS", "Pa");
    entries.nonnegative("Peak slip", law.peak_slip,
                        "slip at the peak shear strength; 0: "
                        "(L/500)(JRC/L)^0.33 with 'Joint length' L in m",
                        "m");
    entries.nonnegative("Joint length", length,
                        "length of the joint between others that cross it",
                        "m");
    entries.nonnegative(
        "Laboratory length", samples,
        "length of the laboratory samples of JRC and JCS, for their scale "
        "correction to 'Joint length'; 0: no correction",
        "m");
    if (samples > 0.)
    {
      entries.check(length >= samples, "Joint length",
                    "must be given, and not be less than 'Laboratory length', "
                    "if roughness and wall strength are to be corrected for "
                    "it.");
      const double ratio = length / samples;
      law.wall_strength *= std::pow(ratio, -0.03 * roughness);
      roughness *= std::pow(ratio, -0.02 * roughness);
    }
    law.roughness = roughness * degree;
    if (law.peak_slip == 0.)
    {
      entries.check(length > 0. && roughness > 0., "Peak slip",
                    "must be given, or 'Joint length' and 'Joint roughness', "
                    "from which it follows.");
      law.peak_slip = length / 500. * std::pow(roughness / length, 0.33);
    }
    return law;
  }

  std::string BartonBandisLaw::text() const
  {
    return "Barton-Bandis, "
           + named_number("residual friction angle", residual_angle / degree,
                          "degrees")
           + ", JRC " + number_text(roughness / degree) + ", "
           + named_number("JCS", wall_strength, "Pa");
  }

  BartonBandisLaw BartonBandisLaw::reduced(const double factor) const
  {
    BartonBandisLaw weak = *this;
    weak.divisor *= factor;
    return weak;
  }

  double BartonBandisLaw::mobilising_slip(const double tau,
                                          const double traction) const
  {
    // The rising branch of the mobilisation, turned round.
    using Table          = RoughnessTable;
    const double angle   = std::atan(divisor * tau / traction);
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
    return slip * peak_slip;
  }
} // namespace quoin
