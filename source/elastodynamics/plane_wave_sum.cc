// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/elastodynamics/plane_wave_sum.h>

#include <algorithm>
#include <complex>
#include <utility>

namespace quoin
{
  namespace
  {
    /** The product without conjugation, unlike Eigen's. */
    template <typename A, typename B>
    auto product(const A &a, const B &b)
    {
      return a[0] * b[0] + a[1] * b[1];
    }

    /** Traction by rate of the signal: the displacement gradient is -A s F'. */
    template <typename Vector>
    Vector traction(const ElasticMedium &medium, const Vector &amplitude,
                    const Vector &slowness, const Vector &n)
    {
      return -(medium.lambda() * product(amplitude, slowness) * n
               + medium.mu()
                     * (product(slowness, n) * amplitude
                        + product(amplitude, n) * slowness));
    }
  } // namespace

  PlaneWaveSum::PlaneWaveSum(const ElasticMedium &medium,
                             std::function<double(double)> f)
    : medium(medium), f(std::move(f))
  {
  }

  void PlaneWaveSum::set_components(std::vector<Component> components,
                                    const SignalRange &range)
  {
    waves = std::move(components);
    if (std::any_of(waves.begin(), waves.end(),
                    [](const Component &wave) { return !wave.is_real(); }))
      signal = std::make_shared<const AnalyticSignal>(f, range);
  }

  bool PlaneWaveSum::has_precursors() const
  {
    return signal != nullptr;
  }

  dealii::Tensor<1, 2> PlaneWaveSum::displacement(const dealii::Point<2> &x,
                                                  const double t) const
  {
    dealii::Tensor<1, 2> sum;
    for (const Component &wave : waves)
      if (wave.is_real())
        sum += f(t - to_tensor(wave.slowness.real()) * x)
               * to_tensor(wave.amplitude.real());
      else
        sum += to_tensor(
            (wave.amplitude * (*signal)(t - product(wave.slowness, x))).real());
    return sum;
  }

  dealii::Tensor<1, 2>
  PlaneWaveSum::mean_traction(const dealii::Point<2> &x,
                              const dealii::Tensor<1, 2> &n, const double t0,
                              const double t1) const
  {
    dealii::Tensor<1, 2> sum;
    for (const Component &wave : waves)
      if (wave.is_real())
      {
        const auto d       = to_tensor(wave.amplitude.real());
        const auto s       = to_tensor(wave.slowness.real());
        const double delay = s * x;
        const double rate  = (f(t1 - delay) - f(t0 - delay)) / (t1 - t0);
        sum += rate * traction(medium, d, s, n);
      }
      else
      {
        const std::complex<double> delay = product(wave.slowness, x);
        const std::complex<double> rate
            = ((*signal)(t1 - delay) - (*signal)(t0 - delay)) / (t1 - t0);
        sum += to_tensor(
            (rate
             * traction<Eigen::Vector2cd>(medium, wave.amplitude, wave.slowness,
                                          to_eigen(n)))
                .real());
      }
    return sum;
  }
} // namespace quoin
