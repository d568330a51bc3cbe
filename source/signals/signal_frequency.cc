// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/signals/signal_frequency.h>
#include <quoin/base/constants.h>
#include <quoin/base/fourier_plan.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace quoin
{
  std::vector<double> sampled(const FunctionOfTime &function,
                              const double duration, const unsigned int n)
  {
    std::vector<double> samples(n);
    for (unsigned int i = 0; i < n; ++i)
      samples[i] = function(duration * i / (n - 1));
    return samples;
  }

  namespace
  {
    /** Largest value of @p function that a search by thirds finds between
        @p begin and @p end [s]. */
    double peak_between(const FunctionOfTime &function, double begin,
                        double end)
    {
      constexpr unsigned int n_thirds = 40;
      double peak = -std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i < n_thirds; ++i)
      {
        const double third          = (end - begin) / 3.;
        const double one            = function(begin + third),
                     other          = function(end - third);
        peak                        = std::max({ peak, one, other });
        (one < other ? begin : end) = one < other ? begin + third : end - third;
      }
      return peak;
    }
  } // namespace

  std::array<double, 2> extremes(const FunctionOfTime &function,
                                 const double duration)
  {
    constexpr unsigned int n_intervals = 16384;
    const auto time
        = [&](const unsigned int i) { return duration * i / n_intervals; };
    std::array<double, 2> result;
    for (unsigned int side = 0; side < 2; ++side)
    {
      const double sign           = side == 0 ? -1. : 1.;
      const FunctionOfTime rising = [&](const double t)
      {
        const double value = sign * function(t);
        return std::isnan(value) ? -std::numeric_limits<double>::infinity()
                                 : value;
      };
      const auto samples = sampled(rising, duration, n_intervals + 1);
      const auto largest = std::max_element(samples.begin(), samples.end());
      const auto i       = static_cast<unsigned int>(largest - samples.begin());
      result[side]
          = sign
                * std::max(*largest,
                           peak_between(rising, time(i > 0 ? i - 1 : 0),
                                        time(std::min(i + 1, n_intervals))))
            + 0.; // no negative zero
    }
    return result;
  }

  std::vector<double> derivative(const std::vector<double> &samples,
                                 const double interval)
  {
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
      result.push_back((samples[i + 1] - samples[i]) / interval);
    return result;
  }

  std::vector<double> integral(const std::vector<double> &samples,
                               const double interval)
  {
    std::vector<double> result(1, 0.);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i)
      result.push_back(result.back()
                       + 0.5 * interval * (samples[i] + samples[i + 1]));
    return result;
  }

  double highest_frequency(std::vector<double> samples, const double interval)
  {
    /** Relative amplitude below which a signal is the rounding of a line. */
    constexpr double rounding = 1e-6;
    if (samples.size() < 3)
      return 0.;
    // Without the line both ends are zero: one period has one sample less. An
    // oscillation that is cut off is tapered, as a jump at its end has a broad
    // spectrum.
    constexpr double fading_share = 0.25;
    const std::size_t n           = samples.size() - 1;
    const double first = samples.front(), last = samples.back();
    double largest = 0., left = 0.;
    for (std::size_t i = 0; i <= n; ++i)
    {
      largest = std::max(largest, std::abs(samples[i]));
      samples[i] -= first + (last - first) * double(i) / double(n);
      left = std::max(left, std::abs(samples[i]));
      const double to_go
          = std::min(1., (1. - double(i) / double(n)) / fading_share);
      samples[i] *= 0.5 - 0.5 * std::cos(constants::pi * to_go);
    }
    if (!(left > rounding * largest))
      return 0.;

    std::vector<std::complex<double>> spectrum(n / 2 + 1);
    const FourierPlan plan = owned(fftw_plan_dft_r2c_1d(
        int(n), samples.data(),
        reinterpret_cast<fftw_complex *>(spectrum.data()), FFTW_ESTIMATE));
    fftw_execute(plan.get());
    // The mean may be left by the line and does not count. The last of an even
    // number stands for one frequency, the others for two.
    const auto energy = [&](const std::size_t k)
    { return std::norm(spectrum[k]) * (2 * k == n ? 0.5 : 1.); };
    double total = 0.;
    for (std::size_t k = 1; k < spectrum.size(); ++k)
      total += energy(k);
    double below = 0.;
    for (std::size_t k = 1; k < spectrum.size(); ++k)
    {
      below += energy(k);
      if (below >= energy_share * total)
        return double(k) / (double(n) * interval);
    }
    return 0.5 / interval;
  }

  Jump largest_jump(const FunctionOfTime &function, const double duration)
  {
    constexpr unsigned int n_intervals = 4096, n_halvings = 30;
    const auto samples    = sampled(function, duration, n_intervals + 1);
    unsigned int steepest = 0;
    double change         = 0.;
    for (unsigned int i = 0; i < n_intervals; ++i)
      if (std::abs(samples[i + 1] - samples[i]) > change)
      {
        change   = std::abs(samples[i + 1] - samples[i]);
        steepest = i;
      }
    double begin   = duration * steepest / n_intervals;
    double end     = duration * (steepest + 1) / n_intervals;
    double f_begin = samples[steepest], f_end = samples[steepest + 1];
    for (unsigned int i = 0; i < n_halvings; ++i)
    {
      const double middle = 0.5 * (begin + end), f = function(middle);
      const bool is_first      = std::abs(f - f_begin) > std::abs(f_end - f);
      (is_first ? end : begin) = middle;
      (is_first ? f_end : f_begin) = f;
    }
    return { end, std::abs(f_end - f_begin) };
  }

  double velocity_frequency(const FunctionOfTime &function,
                            const SignalKind kind, const double duration)
  {
    // Powers of two, for fast transforms.
    constexpr unsigned int fewest = 1U << 14, most = 1U << 20;
    /** Share of the highest frequency that samples know, above which there may
        be others that they do not know. */
    constexpr double known_share = 0.25;
    for (unsigned int n = fewest;; n *= 4)
    {
      const double interval = duration / n;
      auto samples          = sampled(function, duration, n + 1);
      if (!std::all_of(samples.begin(), samples.end(),
                       [](const double v) { return std::isfinite(v); }))
        return 0.;
      if (kind == SignalKind::displacement)
        samples = derivative(samples, interval);
      else if (kind == SignalKind::acceleration)
        samples = integral(samples, interval);
      const double frequency = highest_frequency(std::move(samples), interval);
      if (n >= most || frequency < known_share * 0.5 / interval)
        return frequency;
    }
  }

  void Shaking::take_faster(const std::string &other_name,
                            const double other_frequency)
  {
    if (other_frequency > frequency)
      *this = { other_name, other_frequency };
  }
} // namespace quoin
