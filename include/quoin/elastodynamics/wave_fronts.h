// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_wave_fronts_h
#define quoin_elastodynamics_wave_fronts_h

#include <quoin/elastodynamics/elastic_medium.h>

#include <cmath>

namespace quoin
{
  /** Quantities of the kernels at distance r and time T; see time_kernels.h. */
  struct WaveFronts
  {
    double R1, R2; /**< [s], zero before arrival */
    double D1, D3; /**< (R_1^k - R_2^k) / r^2, k = 1, 3 */

    WaveFronts(const ElasticMedium &medium, const double time, const double r)
    {
      const double t1 = r / medium.c1, t2 = r / medium.c2;
      R1 = t1 < time ? std::sqrt((time - t1) * (time + t1)) : 0.;
      R2 = t2 < time ? std::sqrt((time - t2) * (time + t2)) : 0.;
      // Without the subtraction of nearly equal numbers if possible.
      D1 = R2 > 0.
               ? (1. / (medium.c2 * medium.c2) - 1. / (medium.c1 * medium.c1))
                     / (R1 + R2)
               : (R1 > 0. ? R1 / (r * r) : 0.);
      D3 = D1 * (R1 * R1 + R1 * R2 + R2 * R2);
    }

    /** arcosh(c T / r), or zero before arrival. */
    static double arcosh(const double c, const double time, const double R,
                         const double r)
    {
      return R > 0. ? std::log(c * (time + R) / r) : 0.;
    }
  };

  /**
   * The scalars of the kernels at distance r and time T, such that with the
   * direction e and the normal n
   *
   *   4 pi rho A_ij = a (2 e_i e_j - delta_ij) + b delta_ij,
   *   4 pi     B_ij = x e_i e_j e_n + y (delta_ij e_n + n_j e_i) + z n_i e_j.
   */
  struct RadialTerms
  {
    double a, b, x, y, z;

    RadialTerms(const ElasticMedium &medium, const double time, const double r)
    {
      const WaveFronts w(medium, time, r);
      const double c1 = medium.c1, c2 = medium.c2;
      const double q1 = 1. / (c1 * c1), q2 = 1. / (c2 * c2);
      const double mu = c2 * c2, lambda = c1 * c1 - 2. * mu; // over density
      const double Q1 = q1 * w.R1 / r, Q2 = q2 * w.R2 / r;
      const double W = 4. / 3. * w.D3 / r;
      a              = time * w.D1;
      b              = q1 * WaveFronts::arcosh(c1, time, w.R1, r)
          + q2 * WaveFronts::arcosh(c2, time, w.R2, r);
      x = -4. * mu * (Q1 - Q2 + W);
      y = mu * (W - 2. * Q2);
      z = mu * W - 2. * lambda * Q1;
    }
  };
} // namespace quoin

#endif
