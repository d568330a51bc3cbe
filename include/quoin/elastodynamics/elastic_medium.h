// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_elastic_medium_h
#define quoin_elastodynamics_elastic_medium_h

#include <cmath>

namespace quoin
{
  /** A homogeneous isotropic elastic medium in plane strain. */
  struct ElasticMedium
  {
    double density; /**< [kg/m^3] */
    double c1;      /**< speed of P waves [m/s] */
    double c2;      /**< speed of S waves [m/s] */

    /** Medium with Young's modulus [Pa] and Poisson's ratio < 1/2. */
    static ElasticMedium from_young(const double density, const double young,
                                    const double poisson)
    {
      const double mu = 0.5 * young / (1. + poisson);
      const double c2 = std::sqrt(mu / density);
      const double c1
          = c2 * std::sqrt(2. * (1. - poisson) / (1. - 2. * poisson));
      return { density, c1, c2 };
    }

    /** Shear modulus [Pa]. */
    double mu() const
    {
      return density * c2 * c2;
    }

    /** Lame's first parameter [Pa]. */
    double lambda() const
    {
      return density * (c1 * c1 - 2. * c2 * c2);
    }

    /** Poisson's ratio. */
    double poisson() const
    {
      return (0.5 * c1 * c1 - c2 * c2) / (c1 * c1 - c2 * c2);
    }
  };
} // namespace quoin

#endif
