// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_materials_yielding_sample_h
#define quoin_tests_materials_yielding_sample_h

#include <quoin/block_elements/triangle.h>
#include <quoin/materials/mohr_coulomb.h>

#include <array>

namespace quoin
{
  /** A material point that is given one deformation after the other. */
  struct YieldingSample
  {
    using Tensor = std::array<double, 4>; /**< 11, 12, 21, 22 */

    MohrCoulomb law;
    std::array<double, 4> initial{};
    PlasticPoint point{};
    Tensor gradient{}; /**< H = F - I */
    Tensor piola{};    /**< first Piola-Kirchhoff stress [Pa] */

    /** The elastic part of the deformation. */
    CorotatedStrain elastic() const
    {
      return CorotatedStrain(
          stretched_gradient(gradient, point.inverse_stretch));
    }

    /** Returns what that dissipated [J/m^3]. */
    double deform(const Tensor &H)
    {
      gradient                     = H;
      const CorotatedStrain strain = elastic();
      const auto before            = point.inverse_stretch;
      const PlasticStep step       = law.update(point, strain.e, initial);
      piola = stretched(piola_stress(strain, { 0., 0., 0. }, step.stress),
                        before);
      return step.dissipated;
    }

    /** The same for a symmetric H: xx, yy, xy. */
    double strain(const PlaneTensor &e)
    {
      return deform({ e[0], e[2], e[2], e[1] });
    }

    /** Cauchy's stress xx, yy, xy, zz in the fixed frame [Pa]. */
    std::array<double, 4> stress() const
    {
      const CorotatedStrain strain = elastic();
      const auto s   = law.cauchy_stress(point, strain.e, initial);
      const auto now = strain.to_global({ s[0], s[1], s[2] });
      return { now[0], now[1], now[2], s[3] };
    }

    /**
     * As if the sample had yielded before and bore the Biot stress diag(xx, yy,
     * zz) [Pa] without deformation.
     */
    void bear(const LinearElastic &material, const double xx, const double yy,
              const double zz)
    {
      const double side = material.poisson * (xx + yy + zz);
      const auto strain = [&](const double s)
      { return ((1. + material.poisson) * s - side) / material.young; };
      const bool is_free
          = law.plane_assumption() == PlaneAssumption::plane_stress;
      point.inverse_stretch
          = { strain(xx), strain(yy), 0., is_free ? 0. : strain(zz) };
      point.stress = { xx, yy, 0., zz };
      point.state  = yielding::shear_past;
    }

    /** Logarithms of the inverse plastic stretch: principal in the plane, zz.
     */
    std::array<double, 3> logarithms() const
    {
      const auto &q     = point.inverse_stretch;
      const double mean = 0.5 * (q[0] + q[1]);
      const double radius
          = std::sqrt(0.25 * (q[0] - q[1]) * (q[0] - q[1]) + q[2] * q[2]);
      return { std::log1p(mean + radius), std::log1p(mean - radius),
               std::log1p(q[3]) };
    }
  };
} // namespace quoin

#endif
