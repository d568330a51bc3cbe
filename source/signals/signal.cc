// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/signals/signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace quoin
{
  namespace
  {
    using constants::pi;

    /** The integral of a function, tabulated. */
    std::function<double(double)>
    integral_of(const std::function<double(double)> &f, const double begin,
                const double end, const double step)
    {
      const std::size_t n
          = std::size_t(std::max(1., std::ceil((end - begin) / step)));
      const auto sums   = std::make_shared<std::vector<double>>(1, 0.);
      const auto values = std::make_shared<std::vector<double>>(1, f(begin));
      for (std::size_t k = 0; k < n; ++k)
      {
        // Gauss's rule with three points.
        const double middle = begin + (double(k) + 0.5) * step;
        const double off    = 0.5 * step * std::sqrt(0.6);
        const double mean
            = (8. * f(middle) + 5. * (f(middle - off) + f(middle + off))) / 18.;
        sums->push_back(sums->back() + step * mean);
        values->push_back(f(begin + double(k + 1) * step));
      }
      return [=](const double t)
      {
        const double place = (t - begin) / step;
        if (!(place > 0.))
          return 0.;
        if (place >= double(n))
          return sums->back();
        // Cubic Hermite interpolation.
        const std::size_t k = std::size_t(place);
        const double x      = place - double(k);
        const double y      = 1. - x;
        return (*sums)[k] * y * y * (1. + 2. * x)
               + (*sums)[k + 1] * x * x * (1. + 2. * y)
               + step * x * y * ((*values)[k] * y - (*values)[k + 1] * x);
      };
    }
  } // namespace

  Signal ricker_wavelet(const double frequency, const double delay)
  {
    const double a = pi * frequency;
    Signal signal;
    signal.value = [=](const double t)
    {
      const double x = a * (t - delay);
      return (1. - 2. * x * x) * std::exp(-x * x);
    };
    signal.integral = [=](const double t)
    {
      const double x = a * (t - delay);
      return x / a * std::exp(-x * x);
    };
    signal.second_integral = [=](const double t)
    {
      const double x = a * (t - delay);
      return -0.5 / (a * a) * std::exp(-x * x);
    };
    return signal;
  }

  Signal gabor_wavelet(const double frequency, const double width,
                       const double phase, const double delay)
  {
    Signal signal;
    signal.value = [=](const double t)
    {
      const double s = t - delay;
      return std::exp(-0.5 * s * s / (width * width))
             * std::cos(2. * pi * frequency * s + phase);
    };
    return signal;
  }

  Signal half_sine_pulse(const double duration)
  {
    const double omega = pi / duration;
    const auto inside
        = [=](const double t) { return std::clamp(t, 0., duration); };
    Signal signal;
    signal.value = [=](const double t)
    { return t > 0. && t < duration ? std::sin(omega * t) : 0.; };
    signal.integral = [=](const double t)
    { return (1. - std::cos(omega * inside(t))) / omega; };
    signal.second_integral = [=](const double t)
    {
      const double s = inside(t);
      return (s - std::sin(omega * s) / omega) / omega
             + 2. / omega * std::max(0., t - duration);
    };
    return signal;
  }

  Signal triangular_pulse(const double rise, const double decay)
  {
    // Three changes of slope; integrals of (t - t_k)_+.
    const std::array<double, 3> time{ { 0., rise, rise + decay } };
    const std::array<double, 3> change{ { 1. / rise, -1. / rise - 1. / decay,
                                          1. / decay } };
    const auto sum = [=](const double t, const int power, const double factor)
    {
      double result = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        if (t > time[k])
          result += change[k] * std::pow(t - time[k], power) / factor;
      return result;
    };
    Signal signal;
    signal.value = [=](const double t)
    {
      if (!(t > 0. && t < rise + decay))
        return 0.;
      return t < rise ? t / rise : (rise + decay - t) / decay;
    };
    const double end = rise + decay;
    signal.integral
        = [=](const double t) { return sum(std::min(t, end), 2, 2.); };
    signal.second_integral = [=](const double t) {
      return sum(std::min(t, end), 3, 6.) + 0.5 * end * std::max(0., t - end);
    };
    return signal;
  }

  Signal exponential_pulse(const double rise, const double decay)
  {
    if (!(rise > 0. && rise < decay))
      throw InputError("an exponential pulse must rise in less time than it "
                       "takes to decay: give 0 < RISE < DECAY.");
    // b = k a has the peak at ln k / ((k - 1) a), which falls with k from 1/a.
    const double a = 1. / decay;
    double low = 0., high = 1.; // ln k
    const auto peak_time
        = [a](const double log_k) { return log_k / (std::expm1(log_k) * a); };
    while (peak_time(high) > rise)
      high *= 2.;
    for (unsigned int i = 0; i < 200; ++i)
    {
      const double middle                     = 0.5 * (low + high);
      (peak_time(middle) > rise ? low : high) = middle;
    }
    const double b  = a * std::exp(0.5 * (low + high));
    const double xi = 1. / (std::exp(-a * rise) - std::exp(-b * rise));
    // Integrals of exp(-a t) from 0.
    const auto once = [](const double a, const double t)
    { return -std::expm1(-a * t) / a; };
    const auto twice = [once](const double a, const double t)
    { return (t - once(a, t)) / a; };
    Signal signal;
    signal.value = [=](const double t)
    { return t > 0. ? xi * (std::exp(-a * t) - std::exp(-b * t)) : 0.; };
    signal.integral = [=](const double t)
    { return t > 0. ? xi * (once(a, t) - once(b, t)) : 0.; };
    signal.second_integral = [=](const double t)
    { return t > 0. ? xi * (twice(a, t) - twice(b, t)) : 0.; };
    return signal;
  }

  Signal friedlander_pulse(const double duration, const double coefficient)
  {
    const double b = coefficient;
    // Integrals of exp(-b x) and x exp(-b x) from 0, once and twice.
    const auto e = [b](const double x) { return -std::expm1(-b * x) / b; };
    const auto f
        = [=](const double x) { return (e(x) - x * std::exp(-b * x)) / b; };
    Signal signal;
    signal.value = [=](const double t)
    {
      const double x = t / duration;
      return t > 0. ? (1. - x) * std::exp(-b * x) : 0.;
    };
    signal.integral = [=](const double t)
    {
      const double x = t / duration;
      return t > 0. ? duration * (e(x) - f(x)) : 0.;
    };
    signal.second_integral = [=](const double t)
    {
      const double x = t / duration, twice_e = (x - e(x)) / b;
      return t > 0. ? duration * duration * (twice_e - (twice_e - f(x)) / b)
                    : 0.;
    };
    return signal;
  }

  Signal sine_cycles(const double rate, const std::vector<double> &amplitudes)
  {
    const auto value = [rate, amplitudes](double t)
    {
      if (t < 0.)
        return 0.;
      for (const double amplitude : amplitudes)
      {
        const double phase = rate * t / amplitude;
        if (phase < 2. * pi)
          return amplitude * std::sin(phase);
        t -= 2. * pi * amplitude / rate;
      }
      return 0.;
    };
    return { value, nullptr, nullptr, "" };
  }

  std::function<double(double)> integrated(const Signal &signal,
                                           const unsigned int n,
                                           const double begin, const double end,
                                           const double step)
  {
    if (n == 0)
      return signal.value;
    const std::function<double(double)> once
        = signal.integral ? signal.integral
                          : integral_of(signal.value, begin, end, step);
    if (n == 1)
      return once;
    return signal.second_integral ? signal.second_integral
                                  : integral_of(once, begin, end, step);
  }
} // namespace quoin
