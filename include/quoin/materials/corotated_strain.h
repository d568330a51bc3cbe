// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_corotated_strain_h
#define quoin_materials_corotated_strain_h

#include <array>
#include <cmath>

namespace quoin
{
  /** Three components of a symmetric tensor: 11, 22, 12. */
  using PlaneTensor = std::array<double, 3>;

  /**
   * Rotation and Biot strain e = U - I of a displacement gradient H,
   * F = I + H = R U. With
   * @f[ T = H_{11} + H_{22}, \quad B = H_{21} - H_{12}, \quad
   *     h_1 = H_{11} - H_{22}, \quad h_2 = H_{12} + H_{21}, @f]
   * @f[ n = \sqrt{(2 + T)^2 + B^2} = \mathrm{tr}\, U, \quad
   *     c = (2 + T) / n, \quad s = B / n, @f]
   * @f[ \mathrm{tr}\, e = n - 2 = \frac{T (4 + T) + B^2}{n + 2}, \quad
   *     e_{11} - e_{22} = c h_1 + s h_2, \quad 2 e_{12} = c h_2 - s h_1 . @f]
   * The quotient for tr e has no cancellation at small strains and no
   * singularity at any angle.
   */
  struct CorotatedStrain
  {
    double n;      /**< tr U */
    double c;      /**< cosine of the rotation */
    double s;      /**< sine of the rotation */
    PlaneTensor e; /**< strain in the frame that rotates with the triangle */

    explicit CorotatedStrain(const std::array<double, 4> &H)
    {
      const double sum   = H[0] + H[3];
      const double skew  = H[2] - H[1];
      const double h1    = H[0] - H[3];
      const double h2    = H[1] + H[2];
      n                  = std::sqrt((2. + sum) * (2. + sum) + skew * skew);
      c                  = (2. + sum) / n;
      s                  = skew / n;
      const double trace = (sum * (4. + sum) + skew * skew) / (n + 2.);
      const double difference = c * h1 + s * h2;
      e = { 0.5 * (trace + difference), 0.5 * (trace - difference),
            0.5 * (c * h2 - s * h1) };
    }

    /** R t R^T: from the rotating frame to the fixed one. */
    PlaneTensor to_global(const PlaneTensor &t) const
    {
      return turned(t, 2. * c * s);
    }

    /** R^T t R: from the fixed frame to the rotating one. */
    PlaneTensor to_rotating(const PlaneTensor &t) const
    {
      return turned(t, -2. * c * s);
    }

  private:
    PlaneTensor turned(const PlaneTensor &t, const double sin2) const
    {
      const double mean = 0.5 * (t[0] + t[1]);
      const double half = 0.5 * (t[0] - t[1]);
      const double cos2 = c * c - s * s;
      const double a    = cos2 * half - sin2 * t[2];
      return { mean + a, mean - a, sin2 * half + cos2 * t[2] };
    }
  };

  /**
   * A (I + Q) for A [[11, 12], [21, 22]] and a symmetric Q, components 11, 22,
   * 12 of which are read.
   */
  template <typename Symmetric>
  std::array<double, 4> stretched(const std::array<double, 4> &A,
                                  const Symmetric &Q)
  {
    return { A[0] + A[0] * Q[0] + A[1] * Q[2], A[1] + A[0] * Q[2] + A[1] * Q[1],
             A[2] + A[2] * Q[0] + A[3] * Q[2],
             A[3] + A[2] * Q[2] + A[3] * Q[1] };
  }

  /** (I + H) (I + Q) - I, in which small H and Q keep their digits. */
  template <typename Symmetric>
  std::array<double, 4> stretched_gradient(const std::array<double, 4> &H,
                                           const Symmetric &Q)
  {
    const auto G = stretched(H, Q);
    return { G[0] + Q[0], G[1] + Q[2], G[2] + Q[2], G[3] + Q[1] };
  }
} // namespace quoin

#endif
