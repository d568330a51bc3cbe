// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/signals/synthetic_record.h>

#include <cmath>
#include <random>

namespace quoin
{
  namespace
  {
    using constants::gravity;
    using constants::pi;

    /** Normal deviates, mean 0 and variance 1. */
    class NormalDeviates
    {
    public:
      explicit NormalDeviates(const std::uint64_t seed) : random(seed)
      {
      }

      double operator()()
      {
        // Uniform in (0, 1], of the upper 53 bits.
        const auto uniform
            = [this]() { return (double(random() >> 11) + 1.) * 0x1p-53; };
        const double radius = std::sqrt(-2. * std::log(uniform()));
        return radius * std::cos(2. * pi * uniform());
      }

    private:
      std::mt19937_64 random;
    };

    /** x'' + 2 z w x' + w^2 x = -b, with b constant during each step. */
    class Oscillator
    {
    public:
      Oscillator(const double omega, const double damping, const double step)
        : omega(omega), damping(damping)
      {
        const double wd    = omega * std::sqrt(1. - damping * damping);
        const double decay = std::exp(-damping * omega * step);
        c                  = decay * std::cos(wd * step);
        s                  = decay * std::sin(wd * step) / wd;
      }

      /** One step under the acceleration @p base of the base. */
      void advance(const double base)
      {
        // Free vibration about the position of equilibrium.
        const double rest = -base / (omega * omega);
        const double y    = x - rest;
        const double rate = v + damping * omega * y;
        x                 = rest + c * y + s * rate;
        v = c * v - s * (omega * omega * y + damping * omega * v);
      }

      /** Acceleration relative to the base. */
      double relative_acceleration(const double base) const
      {
        return -base - 2. * damping * omega * v - omega * omega * x;
      }

      double absolute_acceleration() const
      {
        return -2. * damping * omega * v - omega * omega * x;
      }

    private:
      double omega, damping, c, s;
      double x = 0., v = 0.;
    };

    double envelope(const Envelope kind, const double share)
    {
      if (kind == Envelope::trapezoidal)
        return std::min(1., std::min(share / 0.15, (1. - share) / 0.35));
      const double at_peak = 0.2, at_end = 0.05;
      const double b = -at_peak * std::log(at_end)
                       / (1. + at_peak * (std::log(at_peak) - 1.));
      const double s = share / at_peak;
      return std::pow(s, b) * std::exp(b * (1. - s));
    }
  } // namespace

  Record synthetic_record(const SyntheticRecordParameters &parameters)
  {
    const double low_frequency = parameters.low_frequency > 0.
                                     ? parameters.low_frequency
                                     : 0.1 * parameters.frequency;
    if (!(parameters.step > 0. && parameters.frequency > 0.
          && parameters.frequency * parameters.step <= 0.1))
      throw InputError("a synthetic record needs ten samples or more in a "
                       "period of the ground: give a shorter 'step'.");
    if (!(low_frequency * parameters.step <= 0.1))
      throw InputError("a synthetic record needs ten samples or more in a "
                       "period of its 'high-pass': lower it, or give a shorter "
                       "'step'.");
    if (!(parameters.damping > 0. && parameters.damping < 1.
          && parameters.low_damping > 0. && parameters.low_damping < 1.))
      throw InputError("the damping of a synthetic record must be between 0 "
                       "and 1.");
    const double n_steps = std::round(parameters.duration / parameters.step);
    // The motion becomes stationary before it is recorded.
    const double warm_up = std::ceil(
        3. / (low_frequency * parameters.low_damping * parameters.step));
    if (!(parameters.duration * parameters.frequency >= 2. && n_steps < 1e7))
      throw InputError("a synthetic record must last for two periods of the "
                       "ground or more, and have less than ten million "
                       "samples.");

    if (!(warm_up < 1e7))
      throw InputError("a synthetic record becomes stationary only after ten "
                       "million samples, because its 'high-pass' is so low: "
                       "raise it.");

    NormalDeviates noise(parameters.seed);
    Oscillator ground(2. * pi * parameters.frequency, parameters.damping,
                      parameters.step);
    Oscillator low(2. * pi * low_frequency, parameters.low_damping,
                   parameters.step);
    TimeTable table;
    for (long k = -long(warm_up); k <= long(n_steps); ++k)
    {
      ground.advance(noise());
      const double acceleration = ground.absolute_acceleration();
      const double high         = low.relative_acceleration(acceleration);
      low.advance(acceleration);
      if (k >= 0)
        table.emplace_back(double(k) * parameters.step,
                           envelope(parameters.envelope, double(k) / n_steps)
                               * high);
    }
    Record record(std::move(table));
    record.taper(0.05);
    record.correct(Baseline::quadratic);
    if (parameters.arias > 0.)
    {
      double sum = 0.;
      for (const auto &[time, value] : record.samples())
        sum += value * value;
      record.scale(std::sqrt(2. * gravity * parameters.arias
                             / (pi * sum * parameters.step)));
    }
    else
      record.scale(parameters.peak / record.peak());
    return record;
  }
} // namespace quoin
