// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_signal_frequency_h
#define quoin_signals_signal_frequency_h

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace quoin
{
  using FunctionOfTime = std::function<double(double)>;

  /** Share of a signal's energy below its highest frequency [-]. */
  constexpr double energy_share = 0.99;

  /** @p function at @p n times from 0 to @p duration, ends included. */
  std::vector<double> sampled(const FunctionOfTime &function, double duration,
                              unsigned int n);

  /**
   * Smallest and largest value of @p function from 0 to @p duration [s]: those
   * of many samples, as of a record, and of what is between the neighbours of
   * both, such as the peak of a pulse that is much shorter than the duration.
   * Values that are no numbers do not count.
   */
  std::array<double, 2> extremes(const FunctionOfTime &function,
                                 double duration);

  /** Differences of @p samples, @p interval [s] apart, over the interval. */
  std::vector<double> derivative(const std::vector<double> &samples,
                                 double interval);

  /** Integral of @p samples from the first one, by the trapezoidal rule. */
  std::vector<double> integral(const std::vector<double> &samples,
                               double interval);

  /**
   * The frequency [Hz] below which energy_share of the energy of @p samples,
   * @p interval [s] apart, lies, by their discrete Fourier transform. First the
   * line from the first to the last sample is subtracted and the last quarter
   * is tapered by a cosine: a signal cut off at the end has no jump there, and
   * the frequency of a constant or a ramp is 0. The remaining mean does not
   * count.
   */
  double highest_frequency(std::vector<double> samples, double interval);

  /**
   * The largest jump of @p function within @p duration: the limit of the
   * steepest change as the interval around it shrinks.
   */
  struct Jump
  {
    double time   = 0.; /**< [s] */
    double height = 0.; /**< height, not negative */
  };
  Jump largest_jump(const FunctionOfTime &function, double duration);

  /** Meaning of a function of time for particle motion. */
  enum class SignalKind
  {
    velocity,     /**< velocity, or a stress proportional to it in a wave */
    displacement, /**< displacement, or the moment of a source */
    acceleration
  };

  /** highest_frequency() of the velocity that belongs to @p function within
      @p duration [s], with as many samples as it needs; 0 if a value is not
     finite, an error of the run. */
  double velocity_frequency(const FunctionOfTime &function, SignalKind kind,
                            double duration);

  /** A dynamic signal and its highest frequency [Hz]; 0: none. */
  struct Shaking
  {
    std::string name; /**< "the load 'push'" */
    double frequency = 0.;

    /** Becomes the signal @p other_name if its frequency is higher. */
    void take_faster(const std::string &other_name, double other_frequency);
  };

  /**
   * Edges per S wave length below which a warning is given: eight to ten are
   * right, with five it is seven per cent too slow; theory.md, "Critical time
   * step".
   */
  constexpr double fewest_edges = 5.;
} // namespace quoin

#endif
