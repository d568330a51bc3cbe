// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_triangle_tangent_h
#define quoin_block_elements_triangle_tangent_h

#include <quoin/block_elements/triangle.h>

#include <array>

/**
 * The derivative of the co-rotated element of triangle.h, for Newton solvers.
 *
 * The energy of the element is a function of q = (T, B, h_1, h_2). With the
 * stresses that are conjugate to (tr e, e_11 - e_22, 2 e_12),
 * @f[ M = \tfrac12 (S_{11} + S_{22}), \quad D = \tfrac12 (S_{11} - S_{22}),
 *     \quad G = S_{12}, @f]
 * the gradient of the energy density with respect to q is linear in them, and
 * its Hessian is that of the material plus a geometric part, in which only
 * the rotation's gradient and one more vector appear.
 */
namespace quoin
{
  /** A vector over (T, B, h_1, h_2). */
  using PlaneGradient = std::array<double, 4>;

  /** Derivative of stresses S11, S22, S12 by strains e11, e22 and 2 e12. */
  using PlaneTangent = std::array<std::array<double, 3>, 3>;

  inline PlaneTangent elastic_tangent(const PlaneStiffness &stiffness)
  {
    return { { { { stiffness.c11, stiffness.c12, 0. } },
               { { stiffness.c12, stiffness.c11, 0. } },
               { { 0., 0., stiffness.c33 } } } };
  }

  /** The nodal gradient b [1/m] on (T, B, h_1, h_2), for u_x and for u_y. */
  inline std::array<PlaneGradient, 2>
  node_gradients(const dealii::Tensor<1, 2> &b)
  {
    return { { { { b[0], -b[1], b[0], b[1] } },
               { { b[1], b[0], -b[1], b[0] } } } };
  }

  /** First and second derivative of the energy density by q. */
  struct ElementDerivatives
  {
    PlaneGradient first{};                 /**< [Pa] */
    std::array<PlaneGradient, 4> second{}; /**< [Pa] */

    /**
     * @p stress: S11, S22, S12 in the rotating frame, initial stress
     * included; @p tangent: its derivative, without which there is no second
     * one.
     */
    ElementDerivatives(const CorotatedStrain &strain, const PlaneTensor &stress,
                       const PlaneTangent *tangent)
    {
      const double c = strain.c, s = strain.s, n = strain.n;
      const double d = strain.e[0] - strain.e[1], g = 2. * strain.e[2];
      const double M = 0.5 * (stress[0] + stress[1]);
      const double D = 0.5 * (stress[0] - stress[1]);
      const double G = stress[2];

      const PlaneGradient along{ { c, s, 0., 0. } }; // of n = tr U
      const PlaneGradient turn{ { -s / n, c / n, 0., 0. } };
      const PlaneGradient a{ { 0., 0., c, s } }, b{ { 0., 0., -s, c } };
      std::array<PlaneGradient, 3> strains; // of tr e, e11 - e22, 2 e12
      const double twist = D * g - G * d;
      PlaneGradient partner;
      for (unsigned int i = 0; i < 4; ++i)
      {
        strains[0][i] = along[i];
        strains[1][i] = a[i] + g * turn[i];
        strains[2][i] = b[i] - d * turn[i];
        first[i]   = M * strains[0][i] + D * strains[1][i] + G * strains[2][i];
        partner[i] = 0.5 * (n * M - D * d - G * g) * turn[i] + D * b[i]
                     - G * a[i] - twist / n * along[i];
      }

      if (tangent == nullptr)
        return;
      // A C A^T with A = ((1, 1, 0), (1, -1, 0), (0, 0, 2)) / 2.
      const auto &C = *tangent;
      const double sums[2][3]
          = { { 0.5 * (C[0][0] + C[1][0]), 0.5 * (C[0][1] + C[1][1]),
                0.5 * (C[0][2] + C[1][2]) },
              { 0.5 * (C[0][0] - C[1][0]), 0.5 * (C[0][1] - C[1][1]),
                0.5 * (C[0][2] - C[1][2]) } };
      double material[3][3];
      for (unsigned int i = 0; i < 3; ++i)
      {
        const double *row
            = i < 2 ? sums[i] : static_cast<const double *>(C[2].data());
        material[i][0] = 0.5 * (row[0] + row[1]);
        material[i][1] = 0.5 * (row[0] - row[1]);
        material[i][2] = row[2];
      }
      for (unsigned int k = 0; k < 4; ++k)
      {
        double by_strain[3];
        for (unsigned int i = 0; i < 3; ++i)
          by_strain[i] = material[i][0] * strains[0][k]
                         + material[i][1] * strains[1][k]
                         + material[i][2] * strains[2][k];
        for (unsigned int j = 0; j < 4; ++j)
          second[j][k] = strains[0][j] * by_strain[0]
                         + strains[1][j] * by_strain[1]
                         + strains[2][j] * by_strain[2] + turn[j] * partner[k]
                         + partner[j] * turn[k];
      }
    }
  };
} // namespace quoin

#endif
