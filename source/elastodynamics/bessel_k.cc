// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/bessel_k.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    using Complex = std::complex<double>;

    using constants::pi;
    constexpr double euler_gamma = 0.57721566490153286061;

    BesselK power_series(const Complex z)
    {
      const Complex q         = 0.25 * z * z;
      const Complex logarithm = std::log(0.5 * z);

      Complex term = 1.;           // q^k / (k!)^2
      double psi   = -euler_gamma; // digamma(k + 1)
      Complex K0 = 0., regular = 0.;
      for (unsigned k = 0; k < 30; ++k)
      {
        const Complex contribution = term * (psi - logarithm);
        K0 += contribution;
        // digamma(k + 2) = digamma(k + 1) + 1/(k + 1)
        regular += term / (k + 1.)
                   * (0.5 * logarithm - 0.25 * (2. * psi + 1. / (k + 1.)));
        if (std::norm(term) < 1e-36)
          break;
        psi += 1. / (k + 1.);
        term *= q / ((k + 1.) * (k + 1.));
      }
      return { K0, 1. / z + z * regular, regular };
    }

    Complex regular_part(const Complex z, const Complex K1)
    {
      return (K1 - 1. / z) / z;
    }

    /** x^2 and h exp(-x^2) for x = 0, h, 2h, ...; all but the first doubled. */
    template <int points>
    struct TrapezoidalRule
    {
      /** As many as fill SIMD registers; those beyond the last have no weight.
       */
      using Array  = Eigen::Array<double, (points + 7) / 8 * 8, 1>;
      Array square = Array::Zero(), weight = Array::Zero();

      explicit TrapezoidalRule(const double h)
      {
        for (int k = 0; k < points; ++k)
        {
          square[k] = (k * h) * (k * h);
          weight[k] = (k == 0 ? 1. : 2.) * h * std::exp(-square[k]);
        }
      }

      BesselK operator()(const Complex z) const
      {
        // The roots have a real part of at least one.
        const Complex half_inverse = 0.5 / z;
        const Array a              = 1. + square * half_inverse.real(),
                    b              = square * half_inverse.imag();
        const Array modulus        = (a * a + b * b).sqrt();
        const Array re             = (0.5 * (modulus + a)).sqrt();
        const Array im             = 0.5 * b / re;
        const Array inverse        = weight / modulus;
        const Array twice          = 2. * weight * square;
        const Complex factor       = std::sqrt(half_inverse) * std::exp(-z);
        const Complex K1
            = factor * Complex((twice * re).sum(), (twice * im).sum());
        return { factor * Complex((inverse * re).sum(), -(inverse * im).sum()),
                 K1, regular_part(z, K1) };
      }
    };

    BesselK asymptotic_series(const Complex z)
    {
      const Complex eighth = 0.125 / z;
      Complex term0 = 1., term1 = 1., sum0 = 1., sum1 = 1.;
      for (unsigned k = 1; k < 36; ++k)
      {
        const double odd = (2. * k - 1.) * (2. * k - 1.);
        term0 *= -odd * eighth / double(k);
        term1 *= (4. - odd) * eighth / double(k);
        sum0 += term0;
        sum1 += term1;
        if (std::norm(term1) < 1e-34)
          break;
      }
      const Complex factor = std::sqrt(pi * 0.5 / z) * std::exp(-z);
      const Complex K1     = factor * sum1;
      return { factor * sum0, K1, regular_part(z, K1) };
    }
  } // namespace

  BesselK bessel_k(const std::complex<double> z)
  {
    const double size = std::norm(z);
    if (size < 4.)
      return power_series(z);
    // The nearest branch points are x = +-i sqrt(2 z), at a distance of at
    // least d = sqrt(|z|) from the real axis: error exp(d^2 - 2 pi d / h).
    static const TrapezoidalRule<27> fine(0.235);
    static const TrapezoidalRule<17> coarse(0.38);
    if (size < 8. * 8.)
      return fine(z);
    if (size < 18. * 18.)
      return coarse(z);
    return asymptotic_series(z);
  }
} // namespace quoin
