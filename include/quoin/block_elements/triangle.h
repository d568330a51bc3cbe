// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_triangle_h
#define quoin_block_elements_triangle_h

#include <quoin/base/node_record.h>
#include <quoin/materials/corotated_strain.h>
#include <quoin/materials/linear_elastic.h>

#include <array>
#include <cmath>

/**
 * The constant-strain triangle in a frame that rotates with it.
 *
 * The displacement gradient H is taken from differences of displacements, not
 * of positions, so that strains keep their digits in a large model. With
 * F = I + H and the rotation R of its polar decomposition F = R U the strain
 * is Biot's, e = U - I, symmetric and zero for every rigid motion.
 *
 * In two dimensions all follows from four numbers, see CorotatedStrain.
 */
namespace quoin
{
  /** Reference geometry of one cell. */
  struct Triangle
  {
    double det;              /**< twice the reference area, signed [m^2] */
    dealii::Tensor<1, 2> e1; /**< reference edge from node 0 to node 1 [m] */
    dealii::Tensor<1, 2> e2; /**< reference edge from node 0 to node 2 [m] */

    Triangle(const NodeRecord<2> &n0, const NodeRecord<2> &n1,
             const NodeRecord<2> &n2)
      : e1(n1.X - n0.X), e2(n2.X - n0.X)
    {
      det = e1[0] * e2[1] - e1[1] * e2[0];
    }

    /** Reference area [m^2]. */
    double area() const
    {
      return 0.5 * std::abs(det);
    }

    /** Lets (I + @p q) act on the nodal gradients, components 11, 22, 12: those
        of the elastic part of a deformation after flow. */
    void flow(const double (&q)[4])
    {
      // On edges turned by a right angle, as the gradients are.
      for (dealii::Tensor<1, 2> *e : { &e1, &e2 })
      {
        const double x = (*e)[0], y = (*e)[1];
        (*e)[0] = x + q[1] * x - q[2] * y;
        (*e)[1] = y + q[0] * y - q[2] * x;
      }
    }

    /** Gradient [[11, 12], [21, 22]] of a field given at the nodes. */
    std::array<double, 4> gradient(const dealii::Tensor<1, 2> &a,
                                   const dealii::Tensor<1, 2> &b,
                                   const dealii::Tensor<1, 2> &c) const
    {
      const double bx = b[0] - a[0], by = b[1] - a[1];
      const double cx = c[0] - a[0], cy = c[1] - a[1];
      return { (bx * e2[1] - cx * e1[1]) / det, (cx * e1[0] - bx * e2[0]) / det,
               (by * e2[1] - cy * e1[1]) / det,
               (cy * e1[0] - by * e2[0]) / det };
    }
  };

  inline PlaneTensor elastic_stress(const PlaneStiffness &stiffness,
                                    const PlaneTensor &e)
  {
    return { stiffness.c11 * e[0] + stiffness.c12 * e[1],
             stiffness.c12 * e[0] + stiffness.c11 * e[1],
             2. * stiffness.c33 * e[2] };
  }

  /**
   * First Piola-Kirchhoff stress [[11, 12], [21, 22]] of a stress @p elastic
   * that shares its principal directions with the strain, plus a given stress
   * @p initial that turns with the triangle. The latter is the gradient of
   * the energy initial : e with respect to F,
   * @f[ P_0 = R S_0 + \frac{\tau}{n} J R, \quad
   *     \tau = (S_{11} - S_{22}) e_{12} - S_{12} (e_{11} - e_{22}), @f]
   * J the quarter turn; the second term, small as the strains are, makes the
   * moment of the nodal forces vanish and the energy balance exact.
   */
  inline std::array<double, 4> piola_stress(const CorotatedStrain &strain,
                                            const PlaneTensor &elastic,
                                            const PlaneTensor &initial)
  {
    const double c = strain.c, s = strain.s;
    const double s11  = elastic[0] + initial[0];
    const double s22  = elastic[1] + initial[1];
    const double s12  = elastic[2] + initial[2];
    const double turn = ((initial[0] - initial[1]) * strain.e[2]
                         - initial[2] * (strain.e[0] - strain.e[1]))
                        / strain.n;
    return { c * s11 - s * s12 - turn * s, c * s12 - s * s22 - turn * c,
             s * s11 + c * s12 + turn * c, s * s12 + c * s22 - turn * s };
  }

  /**
   * Adds the nodal forces -V P grad N_i [N] of a first Piola-Kirchhoff stress
   * P [Pa]; they sum to zero.
   */
  inline void add_nodal_forces(const Triangle &triangle, const double thickness,
                               const std::array<double, 4> &P,
                               dealii::Tensor<1, 2> &f0,
                               dealii::Tensor<1, 2> &f1,
                               dealii::Tensor<1, 2> &f2)
  {
    const double w   = std::copysign(0.5 * thickness, triangle.det);
    const auto &e1   = triangle.e1;
    const auto &e2   = triangle.e2;
    const double f1x = -w * (P[0] * e2[1] - P[1] * e2[0]);
    const double f1y = -w * (P[2] * e2[1] - P[3] * e2[0]);
    const double f2x = w * (P[0] * e1[1] - P[1] * e1[0]);
    const double f2y = w * (P[2] * e1[1] - P[3] * e1[0]);
    f0[0] -= f1x + f2x;
    f0[1] -= f1y + f2y;
    f1[0] += f1x;
    f1[1] += f1y;
    f2[0] += f2x;
    f2[1] += f2y;
  }

  /**
   * Largest squared circular frequency [1/s^2] of one free element whose mass
   * is lumped to its nodes in equal thirds. The largest over all elements
   * bounds that of the assembled, lumped mesh, so that 2 / sqrt of it is a
   * stable time step of central differences.
   *
   * With the nodal gradients b_i the nonzero eigenvalues of B^T C B are those
   * of the matrix of (tr e, e_11 - e_22, 2 e_12),
   * @f[ \begin{pmatrix} K m & \sqrt{KG} p & \sqrt{KG} q \\
   *     \cdot & G m & 0 \\ \cdot & \cdot & G m \end{pmatrix}, \quad
   *     m = \sum |b_i|^2, \; p + i q = \sum (b_{i1} + i b_{i2})^2, @f]
   * whose largest is the root of a quadratic.
   */
  inline double
  largest_eigenvalue_squared_frequency(const Triangle &triangle,
                                       const PlaneStiffness &stiffness,
                                       const double density)
  {
    const double det = triangle.det;
    const double b1x = triangle.e2[1] / det, b1y = -triangle.e2[0] / det;
    const double b2x = -triangle.e1[1] / det, b2y = triangle.e1[0] / det;
    const double b0x = -b1x - b2x, b0y = -b1y - b2y;
    const double xx    = b0x * b0x + b1x * b1x + b2x * b2x;
    const double yy    = b0y * b0y + b1y * b1y + b2y * b2y;
    const double xy    = b0x * b0y + b1x * b1y + b2x * b2y;
    const double m     = xx + yy;
    const double pq    = (xx - yy) * (xx - yy) + 4. * xy * xy;
    const double bulk  = stiffness.bulk();
    const double shear = stiffness.c33;
    const double root  = std::sqrt((bulk - shear) * (bulk - shear) * m * m
                                   + 4. * bulk * shear * pq);
    return 3. / density * 0.5 * ((bulk + shear) * m + root);
  }
} // namespace quoin

#endif
