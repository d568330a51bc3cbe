// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_tdbem_cavity_h
#define quoin_tests_tdbem_cavity_h

#include <quoin/base/packed_vectors.h>
#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/bessel_k.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/elastodynamics/laplace_kernels.h>

#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <vector>

/**
 * The circular cavity in an infinite medium under a uniform pressure p that is
 * switched on at t = 0 (Selberg 1952; Chou and Koenig 1966).
 */
namespace quoin::test
{
  /**
   * 2 mu u / (p a) at the wall at @p time, from the transform
   * K_1(z) / (K_1(z) + kappa z K_0(z)) / s, z = k_1 a, with damping: Fourier
   * series on a line in the right half-plane with Euler's summation (Abate and
   * Whitt 1995).
   */
  inline double cavity_wall_displacement(const ElasticMedium &medium,
                                         const double radius, const double time,
                                         const RayleighDamping &damping
                                         = RayleighDamping())
  {
    constexpr double pi  = 3.14159265358979323846;
    constexpr double A   = 23.; // discretisation error e^-23
    const double nu      = medium.poisson();
    const double kappa   = (1. - nu) / (1. - 2. * nu);
    const auto transform = [&](const std::complex<double> s)
    {
      const LaplaceKernels kernels(medium, s, damping);
      const std::complex<double> z = kernels.k1() * radius;
      const BesselK K              = bessel_k(z);
      return K.K1
             / ((K.K1 + kappa * z * K.K0) * s * (1. + damping.stiffness * s));
    };
    // Sums of the alternating series, averaged binomially.
    const unsigned n = 60, m = 20;
    double sum = 0.5 * transform(A / (2. * time)).real(), average = 0.;
    double binomial = std::pow(0.5, m);
    for (unsigned k = 1; k <= n + m; ++k)
    {
      sum += (k % 2 ? -1. : 1.)
             * transform({ A / (2. * time), k * pi / time }).real();
      if (k >= n)
      {
        average += binomial * sum;
        binomial *= double(m - (k - n)) / (k - n + 1.);
      }
    }
    return std::exp(0.5 * A) / time * average;
  }

  /** The polygon of @p n edges with the area of the circle. */
  inline Boundary cavity(const double radius, const unsigned n)
  {
    constexpr double pi = 3.14159265358979323846;
    const double area   = 0.5 * n * std::sin(2. * pi / n);
    return Boundary::circle({ 0., 0. }, radius * std::sqrt(pi / area), n, true);
  }

  /** Tractions of 1 Pa that press the wall outwards. */
  inline Eigen::VectorXd unit_pressure(const Boundary &boundary)
  {
    Eigen::VectorXd p(boundary.n_unknowns());
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
      set_vector(p, e, -boundary.elements[e].normal());
    return p;
  }

  /** Mean displacement away from the centre. */
  inline double radial_displacement(const Boundary &boundary,
                                    const Eigen::VectorXd &u)
  {
    return u.dot(unit_pressure(boundary)) / double(boundary.n_elements());
  }

  /**
   * Displacements at t_1, t_2, ... [m], a column each, under the tractions
   * @p p that are switched on at t = 0.
   */
  inline Eigen::MatrixXd step_response(const InfluenceKernel &kernel,
                                       const Eigen::VectorXd &p,
                                       const unsigned n_steps)
  {
    std::vector<Eigen::MatrixXd> H(n_steps);
    Eigen::MatrixXd G;
    Eigen::MatrixXd u(kernel.size(), n_steps);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(kernel.size());
    Eigen::PartialPivLU<Eigen::MatrixXd> H0;
    for (unsigned step = 0; step < n_steps; ++step)
    {
      kernel.lag(step, G, H[step]);
      if (step == 0)
        H0.compute(H[0]);
      load += G * p;
      Eigen::VectorXd rhs = load;
      for (unsigned k = 1; k <= step; ++k)
        rhs -= H[k] * u.col(step - k);
      u.col(step) = H0.solve(rhs);
    }
    return u;
  }
} // namespace quoin::test

#endif
