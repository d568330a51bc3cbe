// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_signal_h
#define quoin_signals_signal_h

#include <functional>
#include <string>
#include <vector>

namespace quoin
{
  /** A function of time [s] and, if they are known, its integrals over time. */
  struct Signal
  {
    std::function<double(double)> value;
    /** Integral from the start of the signal; may be empty. */
    std::function<double(double)> integral;
    /** Integral of the integral; may be empty. */
    std::function<double(double)> second_integral;
    /** A line for the log, about records; may be empty. */
    std::string report;
  };

  /**
   * Ricker's wavelet @cite Ricker1953, (1 - 2 a^2) exp(-a^2) with
   * a = pi f (t - delay): the second derivative of a Gaussian, with the peak 1
   * and its spectrum's peak at the frequency f [Hz]. Neither it nor t times it
   * has an integral over all times. It is 1e-6 of its peak at 1.3/f before the
   * delay [s].
   */
  Signal ricker_wavelet(double frequency, double delay);

  /**
   * A Gabor wavelet @cite Gabor1946, an oscillation with the envelope of a
   * Gaussian: exp(-(t - delay)^2 / (2 width^2)) cos(2 pi f (t - delay) +
   * phase).
   *
   * @param frequency f [Hz]
   * @param width standard deviation of the envelope [s]
   * @param phase [rad]
   * @param delay [s]
   */
  Signal gabor_wavelet(double frequency, double width, double phase,
                       double delay);

  /** sin(pi t / duration) for 0 < t < duration [s]. */
  Signal half_sine_pulse(double duration);

  /** Linear from 0 to 1 in @p rise [s], and back to 0 in @p decay [s]. */
  Signal triangular_pulse(double rise, double decay);

  /**
   * The pressure of an explosion @cite Duvall1953,
   * xi (exp(-a t) - exp(-b t)), t > 0, with its peak, 1, at the time @p rise.
   * The tail falls by the factor e in 1/a = @p decay; b and xi follow.
   * Throws InputError unless 0 < rise < decay.
   */
  Signal exponential_pulse(double rise, double decay);

  /**
   * The overpressure of an explosion in air @cite Friedlander1946, (1 - t/T)
   * exp(-b t/T) for t > 0: from 0 to 1 at once, zero at the @p duration T [s],
   * then negative and decaying.
   *
   * @param coefficient b [-], decay coefficient
   */
  Signal friedlander_pulse(double duration, double coefficient);

  /**
   * Consecutive whole sine cycles with the @p amplitudes and the same largest
   * slope @p rate [1/s], at which all begin and end: the k-th takes 2 pi
   * amplitude_k / rate. Zero before and after.
   */
  Signal sine_cycles(double rate, const std::vector<double> &amplitudes);

  /**
   * The @p n-fold integral of @p signal, n = 0, 1 or 2, in closed form if it
   * has one. Otherwise it is integrated from @p begin, before which it is zero,
   * by Gauss's rule over steps, cubic in between, of fourth order in the
   * @p step [s]; after @p end the signal is taken as zero.
   */
  std::function<double(double)> integrated(const Signal &signal, unsigned int n,
                                           double begin, double end,
                                           double step);
} // namespace quoin

#endif
