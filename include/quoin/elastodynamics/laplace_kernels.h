// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_laplace_kernels_h
#define quoin_elastodynamics_laplace_kernels_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/elastic_medium.h>

#include <complex>

namespace quoin
{
  /**
   * Rayleigh damping of a continuum: the equation of motion is
   * @f[ \rho \, (\partial_t^2 + a_M \partial_t) u
   *     = (1 + b_K \partial_t) \, \mathrm{div}\, \sigma(u) , @f]
   * with tractions that include the viscous part.
   */
  struct RayleighDamping
  {
    double mass      = 0.; /**< a_M [1/s] */
    double stiffness = 0.; /**< b_K [s] */
  };

  /**
   * Plane-strain fundamental solutions in the Laplace domain for one complex
   * frequency s, Re s > 0.
   *
   * With r = |y - x| and n the normal at y, U_ij is component i of the
   * displacement at y due to a unit line force in direction j at x, P_ij that
   * of the traction (@cite Dominguez1993):
   * @f[ U_{ij} = \frac{1}{2 \pi \mu} [\psi \delta_{ij} - \chi r_i r_j] , @f]
   * @f[ P_{ij} = \frac{1}{2 \pi} \{ (\psi' - \chi / r)
   *     (\delta_{ij} r_n + r_i n_j) - (2 \chi / r)(n_i r_j - 2 r_i r_j r_n)
   *     - 2 \chi' r_i r_j r_n
   *     + (c_1^2 / c_2^2 - 2)(\psi' - \chi' - \chi / r) r_j n_i \} . @f]
   * Damping replaces s by sqrt(s (s + a_M)) and multiplies both moduli by
   * 1 + b_K s; a_M and b_K then mean what they mean in an equation of motion.
   */
  class LaplaceKernels
  {
  public:
    /** The functions of r alone, factors 1/(2 pi mu) and 1/(2 pi) included. */
    struct Radial
    {
      std::complex<double> u_delta, u_rr;
      /** Factors of delta_ij r_n + r_i n_j, n_i r_j and r_i r_j r_n. */
      std::complex<double> p_sum, p_nr, p_rrn;
    };

    /** Throws InputError unless Re s > 0. */
    LaplaceKernels(const ElasticMedium &medium, std::complex<double> s,
                   const RayleighDamping &damping = RayleighDamping());

    Radial radial(double r) const;

    /** U_ij [m^2/N] at @p d = y - x [m]. */
    Eigen::Matrix2cd displacement(const dealii::Point<2> &d) const;

    /** P_ij [1/m] at @p d = y - x [m] on a plane with the normal @p n. */
    Eigen::Matrix2cd traction(const dealii::Point<2> &d,
                              const dealii::Tensor<1, 2> &n) const;

    /** s / c_1, with damping [1/m]. */
    std::complex<double> k1() const
    {
      return k2_ * ratio_;
    }

    /** s / c_2, with damping [1/m]. */
    std::complex<double> k2() const
    {
      return k2_;
    }

  private:
    double ratio_; /**< c_2 / c_1 */
    std::complex<double> k2_;
    std::complex<double> modulus_; /**< mu (1 + b_K s) */
  };
} // namespace quoin

#endif
