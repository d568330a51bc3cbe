// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_passivity_h
#define quoin_tdbem_passivity_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/influence_kernel.h>

#include <complex>
#include <functional>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Computes G(w) = sum_n G^n w^n [m/Pa] and H(w) likewise, free term
   * included; w is the transform of a delay by one step.
   */
  using ZTransform = std::function<void(
      std::complex<double> w, Eigen::MatrixXcd &G, Eigen::MatrixXcd &H)>;

  /**
   * The sums over the lags 0 to @p n_lags - 1 of @p kernel, which are computed
   * once. Since |w| < 1 the lags that are left out matter by |w|^n_lags at
   * most; take n_lags = 20 / (1 - |w|) to be safe. The kernel itself is not
   * needed any more.
   */
  ZTransform z_transform(const InfluenceKernel &kernel, unsigned n_lags);

  /** Frequency at which the boundary may add most energy. */
  struct PassivityReport
  {
    /**
     * Smallest eigenvalue of the Hermitian part of Z(w) among the examined w,
     * in units of rho c_2: negative if the boundary can add energy.
     */
    double smallest_eigenvalue;
    double frequency;   /**< arg w / (2 pi dt) of it [Hz] */
    double nyquist;     /**< 1 / (2 dt) [Hz] */
    unsigned n_scanned; /**< number of frequencies examined */
    std::vector<double>
        frequencies; /**< examined frequencies, ascending [Hz] */
    std::vector<double> eigenvalues; /**< the smallest at each [rho c_2] */

    /** Whether the boundary is passive, up to a tolerance of 1e-6. */
    bool passive() const
    {
      return smallest_eigenvalue > -1e-6;
    }

    /** Result in words and, unless the boundary is passive, the remedy. */
    std::string advice() const;
  };

  /**
   * Searches for energy that a discrete boundary element domain may add.
   *
   * With velocities constant in each step, their transform is
   * v(w) = (1 - w) u(w) / dt, and p = Z v with the discrete impedance
   * @f[ Z(w) = G(w)^{-1} H(w) \frac{\Delta t}{1 - w} . @f]
   * The work on the domain, the sum over steps and elements of L p . v dt, is
   * never negative if and only if the Hermitian part of L Z(w), L the lengths,
   * is positive semidefinite for all |w| < 1. Scaled with the lengths' roots on
   * either side, L^(1/2) Z L^(-1/2), its eigenvalues are impedances.
   *
   * The scan first takes @p n_frequencies equally spaced ones on |w| = @p
   * radius from near zero to the highest that the step @p time_step [s]
   * represents, then up to half as many again, each in the middle of that
   * interval which is next to the lowest value and still wider than half a
   * band. What is not passive comes in bands at the eigenfrequencies of the
   * complement of the domain. They are at least as wide as 1 - radius, in
   * radians per step, and have shallow slopes: a band between two of the first
   * frequencies is found if it shows there, as a value below most others. To
   * see every band, take 3 / (1 - radius) frequencies. Energy that is created
   * more slowly than by the factor 1 / radius in a step is not seen at all.
   *
   * Each frequency costs @p transform, one factorisation of a complex matrix of
   * size 2N and, by Lanczos' method, about a hundred solutions with it. The
   * eigenvalues have three digits. Throws InputError unless 0 < radius < 1 and
   * n_frequencies > 0.
   */
  PassivityReport scan_passivity(const ZTransform &transform,
                                 const Boundary &boundary,
                                 const ElasticMedium &medium, double time_step,
                                 unsigned n_frequencies, double radius);
} // namespace quoin

#endif
