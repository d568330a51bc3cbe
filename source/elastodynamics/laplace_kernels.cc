// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/elastodynamics/laplace_kernels.h>

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/bessel_k.h>

namespace quoin
{
  namespace
  {
    using constants::pi;
  }

  LaplaceKernels::LaplaceKernels(const ElasticMedium &medium,
                                 const std::complex<double> s,
                                 const RayleighDamping &damping)
    : ratio_(medium.c2 / medium.c1)
  {
    if (!(s.real() > 0.))
      throw InputError("Laplace kernels: the real part of s must be "
                       "positive.");
    const std::complex<double> viscous = 1. + damping.stiffness * s;
    modulus_                           = medium.mu() * viscous;
    // Roots of each factor, none of which crosses the cut, and not of the
    // product, which may.
    k2_ = std::sqrt(s) * std::sqrt(s + damping.mass)
          / (medium.c2 * std::sqrt(viscous));
  }

  LaplaceKernels::Radial LaplaceKernels::radial(const double r) const
  {
    const BesselK S = bessel_k(k2_ * r);
    const BesselK P = bessel_k(k2_ * (ratio_ * r));
    const double g2 = ratio_ * ratio_;
    // The terms 1/z^2 of the S and the P wave cancel; they are left out here.
    const auto psi = S.K0 + S.K1_regular - g2 * P.K1_regular;
    const auto chi = S.K0 + 2. * S.K1_regular - g2 * (P.K0 + 2. * P.K1_regular);
    const auto chi_r = chi / r;
    const auto psi1  = -chi_r - k2_ * S.K1;
    const auto chi1  = -2. * chi_r - k2_ * (S.K1 - ratio_ * g2 * P.K1);

    const auto u_factor   = 1. / (2. * pi * modulus_);
    const double p_factor = 0.5 / pi;
    Radial radial;
    radial.u_delta = u_factor * psi;
    radial.u_rr    = -u_factor * chi;
    radial.p_sum   = p_factor * (psi1 - chi_r);
    radial.p_nr
        = p_factor * (-2. * chi_r + (1. / g2 - 2.) * (psi1 - chi1 - chi_r));
    radial.p_rrn = p_factor * (4. * chi_r - 2. * chi1);
    return radial;
  }

  Eigen::Matrix2cd LaplaceKernels::displacement(const dealii::Point<2> &d) const
  {
    const double r               = d.norm();
    const dealii::Tensor<1, 2> e = d / r;
    const Radial f               = radial(r);
    return f.u_delta * Eigen::Matrix2d::Identity() + f.u_rr * dyad(e, e);
  }

  Eigen::Matrix2cd LaplaceKernels::traction(const dealii::Point<2> &d,
                                            const dealii::Tensor<1, 2> &n) const
  {
    const double r               = d.norm();
    const dealii::Tensor<1, 2> e = d / r;
    const double rn              = e * n;
    const Radial f               = radial(r);
    return f.p_sum * (rn * Eigen::Matrix2d::Identity() + dyad(e, n))
           + f.p_nr * dyad(n, e) + (f.p_rrn * rn) * dyad(e, e);
  }
} // namespace quoin
