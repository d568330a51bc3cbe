// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_linear_elastic_h
#define quoin_materials_linear_elastic_h

#include <quoin/materials/plane_assumption.h>

#include <cmath>

namespace quoin
{
  /** Isotropic linear elasticity. */
  struct LinearElastic
  {
    double density; /**< [kg/m^3] */
    double young;   /**< Young's modulus [Pa] */
    double poisson; /**< Poisson's ratio, in (-1, 0.5) */
  };

  /**
   * Isotropic stiffness in the plane:
   * @f[ \sigma_{11} = c_{11} e_{11} + c_{12} e_{22}, \quad
   *     \sigma_{22} = c_{12} e_{11} + c_{11} e_{22}, \quad
   *     \sigma_{12} = 2 c_{33} e_{12}, \quad
   *     \sigma_{zz} = \nu_z (\sigma_{11} + \sigma_{22}) @f]
   * with $e_{12}$ the tensor's component (half the engineering shear strain)
   * and, because the material is isotropic, $c_{11} - c_{12} = 2 c_{33}$.
   */
  struct PlaneStiffness
  {
    double c11;         /**< [Pa] */
    double c12;         /**< [Pa] */
    double c33;         /**< shear modulus [Pa] */
    double zz_over_sum; /**< $\nu_z$: Poisson's ratio or 0 */

    /** Mean stress over area strain [Pa]: the plane bulk modulus. */
    double bulk() const
    {
      return 0.5 * (c11 + c12);
    }
  };

  inline bool operator==(const PlaneStiffness &a, const PlaneStiffness &b)
  {
    return a.c11 == b.c11 && a.c12 == b.c12 && a.c33 == b.c33
           && a.zz_over_sum == b.zz_over_sum;
  }

  inline PlaneStiffness plane_stiffness(const LinearElastic &material,
                                        const PlaneAssumption assumption)
  {
    const double young   = material.young;
    const double poisson = material.poisson;
    const double shear   = young / (2. * (1. + poisson));

    if (assumption == PlaneAssumption::plane_strain)
    {
      const double lame = 2. * shear * poisson / (1. - 2. * poisson);
      return { lame + 2. * shear, lame, shear, poisson };
    }
    const double c11 = young / (1. - poisson * poisson);
    return { c11, poisson * c11, shear, 0. };
  }

  /** Speeds of P and S waves [m/s]. */
  struct WaveSpeeds
  {
    double p, s;
  };

  inline WaveSpeeds wave_speeds(const LinearElastic &material,
                                const PlaneAssumption assumption)
  {
    const PlaneStiffness stiffness = plane_stiffness(material, assumption);
    return { std::sqrt(stiffness.c11 / material.density),
             std::sqrt(stiffness.c33 / material.density) };
  }

  /** Isotropic stiffness in space: Lamé's moduli. */
  struct SpaceStiffness
  {
    double lambda; /**< [Pa] */
    double mu;     /**< shear modulus [Pa] */
  };

  inline bool operator==(const SpaceStiffness &a, const SpaceStiffness &b)
  {
    return a.lambda == b.lambda && a.mu == b.mu;
  }

  inline SpaceStiffness space_stiffness(const LinearElastic &material)
  {
    const double mu = material.young / (2. * (1. + material.poisson));
    return { 2. * mu * material.poisson / (1. - 2. * material.poisson), mu };
  }
} // namespace quoin

#endif
