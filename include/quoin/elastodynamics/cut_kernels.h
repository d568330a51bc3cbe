// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_cut_kernels_h
#define quoin_elastodynamics_cut_kernels_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/elastodynamics/laplace_kernels.h>
#include <quoin/elastodynamics/projection.h>

namespace quoin
{
  /**
   * The plane-strain fundamental solutions after the S wave has passed, as
   * densities of exponentials.
   *
   * In the plane the Laplace transforms of the fundamental solutions have a
   * branch cut along the negative real axis and no other singularity. For
   * t > r / c_2 the path of the inverse transform can be drawn tight around
   * the cut, where K_n(-x +- i 0) differ by 2 pi i I_n(x) up to the sign:
   * @f[ U_{ij}(r, t) = \int_0^\infty e^{-\lambda t} \tilde U_{ij}(r, \lambda)
   *     \, d\lambda , @f]
   * and likewise for the tractions, where the density has K_0, K_1, K_2 of
   * the transform (LaplaceKernels) replaced by I_0, -I_1 and I_2, for example
   * 1 / sqrt(t^2 - r^2 / c^2) by I_0(lambda r / c). With i_n(x) = I_n(x) / x^n,
   * x_a = lambda r / c_a and g = c_2 / c_1
   * @f[ \tilde\psi = I_0(x_2) - i_1(x_2) + g^2 i_1(x_1), \quad
   *     \tilde\chi = x_2^2 i_2(x_2) - g^2 x_1^2 i_2(x_1) . @f]
   * All of them are entire functions of x_a^2, so nothing is singular, not
   * even at r = 0.
   *
   * With Rayleigh damping x_a^2 = (r / c_a)^2 lambda (lambda - a_M)
   * / (1 - b_K lambda). Where it is negative, lambda < a_M, only one of the
   * two roots in the transform is cut, and the density has half the size.
   */
  class CutKernels
  {
  public:
    /** The functions of r alone, as LaplaceKernels::Radial. */
    struct Radial
    {
      double u_delta, u_rr;
      /** Factors of delta_ij r_n + r_i n_j, n_i r_j, r_i r_j r_n, over r. */
      double p_sum, p_nr, p_rrn;
    };

    /** @p lambda > 0 [1/s], below 1 / b_K. */
    CutKernels(const ElasticMedium &medium, double lambda,
               const RayleighDamping &damping = RayleighDamping());

    Radial radial(double r) const;

    /**
     * The blocks of the equations of the elements @p rows and of the unknowns
     * of @p columns: G [m/(Pa s)] of the displacements and H [1/s] of the
     * tractions, as LaplaceMatrices, without a free term.
     */
    void integrate(const Boundary &boundary, const ElementRange &rows,
                   const ElementRange &columns, Projection projection,
                   Eigen::MatrixXd &G, Eigen::MatrixXd &H) const;

  private:
    double ratio2;  /**< (c_2 / c_1)^2 */
    double square;  /**< (x_2 / r)^2 [1/m^2] */
    double modulus; /**< mu (1 - b_K lambda) [Pa] */
    double weight;
  };
} // namespace quoin

#endif
