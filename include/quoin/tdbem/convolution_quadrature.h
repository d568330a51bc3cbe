// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_convolution_quadrature_h
#define quoin_tdbem_convolution_quadrature_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/tdbem/laplace_matrices.h>

#include <complex>
#include <functional>
#include <vector>

namespace quoin
{
  /**
   * delta(w) = 3/2 - 2 w + w^2/2, the generating function of the backward
   * differentiation formula of second order: delta(w) / dt is the Laplace
   * frequency that belongs to w, the transform of a delay by one step. It maps
   * the unit disc into the right half-plane.
   */
  std::complex<double> bdf2_symbol(std::complex<double> w);

  /**
   * Coefficients 0 to n - 1 of the power series of a real function that is
   * analytic in the unit disc and given by an array of values.
   *
   * @p values(w, result) stores the function's values at w in result, an array
   * of @p n_values; result k of the returned matrix is column k. Cauchy's
   * integral over |w| = radius by the trapezoidal rule with 2 n points, by fast
   * Fourier transform, @cite Lubich1988. With radius^(2n) = 1e-10 the
   * coefficients that alias are suppressed by 1e-10, and rounding errors grow
   * by radius^-n = 1e5, so that the error is 1e-10 of the largest value if the
   * values have 15 digits. @p values is called n + 1 times.
   */
  Eigen::MatrixXd power_series_coefficients(
      unsigned n, Eigen::Index n_values,
      const std::function<void(std::complex<double>, Eigen::VectorXcd &)>
          &values);

  /**
   * Time stepping by convolution quadrature, @cite Lubich1988: the matrices of
   * lag n are the coefficients of w^n in G(s) and H(s) at s = delta(w) / dt,
   * with delta of the backward differentiation formula of second order. The
   * kernels are needed in the Laplace domain only, which admits damping that
   * is the Rayleigh damping of the equations of motion. Displacements and
   * tractions are those at t_m, and the method is of second order in dt if
   * they start smoothly.
   *
   * The matrices of all lags are kept: 2 (2N)^2 numbers a lag for N elements,
   * and as many complex ones while they are computed. They do not vanish
   * before the first arrival but decay quickly ahead of it.
   */
  class ConvolutionQuadrature : public InfluenceKernel
  {
  public:
    /**
     * Computes lags 0 to @p n_lags - 1 for the step @p time_step [s]. Throws
     * InputError if either is not positive.
     */
    ConvolutionQuadrature(const Boundary &boundary, const ElasticMedium &medium,
                          double time_step, unsigned n_lags,
                          Projection projection,
                          const RayleighDamping &damping = RayleighDamping());

    unsigned size() const override
    {
      return size_;
    }

    double time_step() const override
    {
      return time_step_;
    }

    /** Throws std::out_of_range from lag n_lags on. */
    void lag(unsigned n, Eigen::MatrixXd &G, Eigen::MatrixXd &H) const override;
    void blocks(const ElementRange &rows, const ElementRange &columns,
                unsigned begin, unsigned end, Eigen::MatrixXd &G,
                Eigen::MatrixXd &H) const override;

    /** Judged by the size of the matrices, which do not vanish before an
     * arrival. */
    unsigned first_lag(const ElementRange &rows, const ElementRange &columns,
                       double distance) const override;

    /**
     * The method spreads a front in proportion to the root of the number of
     * steps since it left.
     */
    unsigned first_decaying_lag(double distance, double share) const override
    {
      return decaying_lag(medium_, time_step_, distance, share,
                          damping_.stiffness);
    }

    /** first_decaying_lag() before an object exists, to size it. */
    static unsigned decaying_lag(const ElasticMedium &medium, double time_step,
                                 double distance, double share,
                                 double stiffness_damping);

    void cut_blocks(const ElementRange &rows, const ElementRange &columns,
                    double lambda, Eigen::MatrixXd &G,
                    Eigen::MatrixXd &H) const override;

    /**
     * The residue of 1 / (delta(w) / dt + lambda) at its pole near 1, of which
     * the lags are powers; the other pole, beyond 2, is left out.
     */
    DecayFactors decay_factors(double lambda) const override;
    std::vector<double> cut_jumps() const override;
    double largest_rate() const override;

  private:
    Boundary boundary_;
    ElasticMedium medium_;
    Projection projection_;
    RayleighDamping damping_;
    unsigned size_;
    double time_step_;
    Eigen::MatrixXd G_, H_; /**< a column of size^2 entries for each lag */
  };
} // namespace quoin

#endif
