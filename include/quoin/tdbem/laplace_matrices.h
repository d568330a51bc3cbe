// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_laplace_matrices_h
#define quoin_tdbem_laplace_matrices_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/laplace_kernels.h>
#include <quoin/elastodynamics/projection.h>

#include <complex>

namespace quoin
{
  /**
   * The boundary integral equation of one Laplace frequency s,
   * H(s) u = G(s) p: row 2 e + j is the equation of element e in direction j,
   * column 2 f + i belongs to component i on element f. The free term one
   * half is in H.
   */
  struct LaplaceMatrices
  {
    Eigen::MatrixXcd G; /**< [m/Pa] */
    Eigen::MatrixXcd H; /**< [1] */
  };

  /**
   * Computes G(s) and H(s), to about 1e-11 of their largest entry.
   *
   * Pairs of elements are cut until they are as far apart as they are long
   * and then integrated by Gauss rules. Two elements with a common end are
   * integrated in polar-like coordinates about it, and an element with itself
   * in r = |y - x| alone, both with a power of t for the distance, which takes
   * the logarithm out of the reach of the rule. The principal value of the
   * traction kernel over a straight element is zero by antisymmetry, for its
   * middle as well as for its mean.
   *
   * Throws InputError if elements cross or overlap.
   */
  LaplaceMatrices
  laplace_matrices(const Boundary &boundary, const ElasticMedium &medium,
                   std::complex<double> s, Projection projection,
                   const RayleighDamping &damping = RayleighDamping());
} // namespace quoin

#endif
