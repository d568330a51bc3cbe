// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/analytic_signal.h>

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/fourier_plan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace quoin
{
  namespace
  {
    using constants::pi;

    using Complex = std::complex<double>;

    /** Points of the interpolating polynomials. */
    constexpr long n_points = 8;
    /** Points that a table has beyond each end of the range. */
    constexpr long margin = n_points / 2;
    /** Depths are equally spaced first, by one sample, then geometrically. */
    constexpr long n_equal = 10;
    const double growth    = 1.1;

    /** The depth of a table, in samples. */
    double depth(const long m)
    {
      return m < n_equal ? double(m)
                         : double(n_equal) * std::pow(growth, m - n_equal);
    }

    /** (exp(i pi z) - 1) / (i pi z) at z = j + i d. */
    Complex kernel(const long j, const double d)
    {
      if (j == 0 && d == 0.)
        return 1.;
      const double wave = (j % 2 == 0 ? 1. : -1.) * std::exp(-pi * d);
      return (wave - 1.) / (Complex(0., pi) * Complex(double(j), d));
    }

    /** In place, without a factor. */
    void transform(std::vector<Complex> &values, const int sign)
    {
      auto *const data       = reinterpret_cast<fftw_complex *>(values.data());
      const FourierPlan plan = owned(fftw_plan_dft_1d(
          int(values.size()), data, data, sign, FFTW_ESTIMATE));
      fftw_execute(plan.get());
    }

    /** Weights of the values at @p nodes of the polynomial's value at @p x. */
    std::array<double, n_points>
    lagrange(const std::array<double, n_points> &nodes, const double x)
    {
      std::array<double, n_points> weights{};
      for (long i = 0; i < n_points; ++i)
      {
        double above = 1., below = 1.;
        for (long j = 0; j < n_points; ++j)
          if (j != i)
          {
            above *= x - nodes[j];
            below *= nodes[i] - nodes[j];
          }
        weights[i] = above / below;
      }
      return weights;
    }
  } // namespace

  AnalyticSignal::AnalyticSignal(std::function<double(double)> f,
                                 const SignalRange &range)
    : f(std::move(f)), range(range)
  {
    const double n = std::ceil((range.end - range.begin) / range.step);
    if (!(range.step > 0. && n >= 1. && n < 1e8))
      throw InputError("the Hilbert transform of a signal needs the range of "
                       "times in which it is evaluated, and samples of it.");
    n_steps = long(n);
    samples.resize(2 * n_steps + 1);
    for (long k = 0; k <= 2 * n_steps; ++k)
    {
      const double fade
          = k <= n_steps ? 1. : 0.5 * (1. + std::cos(pi * (k - n_steps) / n));
      samples[k] = fade * this->f(range.begin + k * range.step);
    }
    std::size_t size = 1;
    while (long(size) < 3 * n_steps + 2 * margin + 1)
      size *= 2;
    spectrum.assign(size, 0.);
    std::copy(samples.begin(), samples.end(), spectrum.begin());
    transform(spectrum, FFTW_FORWARD);
  }

  Complex AnalyticSignal::operator()(const Complex &time) const
  {
    const double t = (time.real() - range.begin) / range.step;
    const double d = std::max(0., time.imag() / range.step);
    // Nothing changes on a scale that is much smaller than a sample.
    const bool at_surface = d < 1e-9;
    Complex value         = 0.;
    if (!(t >= 0. && t <= double(n_steps)))
      value = sum({ t, d });
    else
    {
      const long j    = long(t);
      const auto in_t = lagrange({ -3., -2., -1., 0., 1., 2., 3., 4. }, t - j);
      const auto row  = [&](const std::size_t m)
      {
        const Complex *const first = level(m).data() + j - 3 + margin;
        Complex sum                = 0.;
        for (long i = 0; i < n_points; ++i)
          sum += in_t[i] * first[i];
        return sum;
      };
      if (at_surface)
        value = row(0);
      else
      {
        const double m
            = d < n_equal ? d
                          : n_equal + std::log(d / n_equal) / std::log(growth);
        const long first = std::max(0L, long(m) - 3);
        std::array<double, n_points> nodes{};
        for (long i = 0; i < n_points; ++i)
          nodes[i] = depth(first + i);
        const auto in_d = lagrange(nodes, d);
        for (long i = 0; i < n_points; ++i)
          value += in_d[i] * row(first + i);
      }
    }
    return at_surface ? Complex(f(time.real()), value.imag()) : value;
  }

  Complex AnalyticSignal::sum(const Complex &z) const
  {
    // The wave of the kernel is that of the first sample with a sign.
    const Complex wave = std::exp(Complex(0., pi) * z);
    Complex total      = 0.;
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const Complex distance = z - double(k);
      const double sign      = k % 2 == 0 ? 1. : -1.;
      total += std::abs(distance) < 1e-9 ? samples[k]
                                         : samples[k] * (sign * wave - 1.)
                                               / (Complex(0., pi) * distance);
    }
    return total;
  }

  const std::vector<Complex> &AnalyticSignal::level(const std::size_t m) const
  {
    if (m >= levels.size())
      levels.resize(m + 1);
    if (levels[m].empty())
    {
      const long size = long(spectrum.size());
      const double d  = depth(long(m));
      std::vector<Complex> product(spectrum.size(), 0.);
      for (long j = -margin - 2 * n_steps; j <= n_steps + margin; ++j)
        product[j < 0 ? j + size : j] = kernel(j, d) / double(size);
      transform(product, FFTW_FORWARD);
      for (long k = 0; k < size; ++k)
        product[k] *= spectrum[k];
      transform(product, FFTW_BACKWARD);
      levels[m].resize(n_steps + 1 + 2 * margin);
      for (long j = -margin; j <= n_steps + margin; ++j)
        levels[m][j + margin] = product[j < 0 ? j + size : j];
    }
    return levels[m];
  }
} // namespace quoin
