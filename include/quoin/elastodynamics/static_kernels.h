// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_static_kernels_h
#define quoin_elastodynamics_static_kernels_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/projection.h>

namespace quoin
{
  /**
   * Displacement i [m] at @p d = y - x [m] due to a static line force of 1 N/m
   * in direction j at x, Kelvin's solution in plane strain:
   * @f[ U_{ij} = \frac{1}{8 \pi \mu (1 - \nu)}
   *     [-(3 - 4 \nu) \ln(r / r_0) \delta_{ij} + r_i r_j] . @f]
   * The @p reference_length r_0 [m] is arbitrary: a medium without end has no
   * place at rest.
   */
  Eigen::Matrix2d static_displacement_kernel(const ElasticMedium &medium,
                                             const dealii::Point<2> &d,
                                             double reference_length = 1.);

  /** The integral equation H u = G p of statics, as LaplaceMatrices. */
  struct StaticMatrices
  {
    Eigen::MatrixXd G; /**< [m/Pa] */
    Eigen::MatrixXd H; /**< [1], with the free term one half */
  };

  /**
   * Computes G and H in closed form: exactly, but for rounding. The rows of H
   * sum to zero (2x2 blocks) if the boundary is that of a bounded domain, and
   * to the identity if it is that of holes in an unbounded one; G times the
   * lengths of the rows' elements is symmetric for Projection::galerkin.
   *
   * With z = (y - x)_1 + i (y - x)_2, force F and normal n as complex numbers,
   * and the factors a = 1 / (8 pi mu (1 - nu)), b = 1 / (4 pi (1 - nu)),
   * @f[ U F = a \left[ \left( \tfrac12 - (3 - 4 \nu) \ln |z / r_0| \right) F
   *     + \tfrac12 \frac{z}{\bar z} \bar F \right], @f]
   * @f[ P F = -b \left[ (1 - 2 \nu) \frac{\bar n}{\bar z} F
   *     + \tfrac12 \left( \frac{\bar n}{\bar z} + \frac{n}{z} \right) F
   *     + \tfrac12 \left( \bar n \frac{z}{\bar z^2} + \frac{n}{\bar z} \right)
   *       \bar F \right] . @f]
   * The derivative along the direction t is t d/dz + conj(t) d/dconj(z), so
   * that functions conj(z)^k f(z), k = 0, 1, have antiderivatives of the same
   * form along one and along two directions, whatever the angle between them.
   */
  StaticMatrices static_matrices(const Boundary &boundary,
                                 const ElasticMedium &medium,
                                 Projection projection,
                                 double reference_length = 1.);

  /**
   * G and H, of two rows each, of the representation u(x) = G p - H u of the
   * displacement at a point @p x of the domain, not on the boundary. H has no
   * free term.
   */
  StaticMatrices static_point_matrices(const Boundary &boundary,
                                       const ElasticMedium &medium,
                                       const dealii::Point<2> &x,
                                       double reference_length = 1.);
} // namespace quoin

#endif
