// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_signal_frequency_h
#define quoin_loads_signal_frequency_h

#include <functional>
#include <string>
#include <vector>

namespace quoin
{
  using FunctionOfTime = std::function<double(double)>;

  /** Share of a signal's energy that counts as all of it. */
  constexpr double energy_share = 0.99;

  /** @p function at @p n times from 0 to @p duration, both included. */
  std::vector<double> sampled(const FunctionOfTime &function, double duration,
                              unsigned int n);

  /** Differences of @p samples, @p interval [s] apart, over the interval. */
  std::vector<double> derivative(const std::vector<double> &samples,
                                 double interval);

  /** The integral from the first of them on, by the trapezoidal rule. */
  std::vector<double> integral(const std::vector<double> &samples,
                               double interval);

  /**
   * The frequency [Hz] below which energy_share of the energy of @p samples,
   * @p interval [s] apart, lies, by their discrete Fourier transform. The line
   * from the first to the last sample is taken off before, and the last quarter
   * fades by a cosine: what is cut off at the end has no jump there, and a
   * constant or a ramp has no frequency, 0. The mean that is left does not
   * count.
   */
  double highest_frequency(std::vector<double> samples, double interval);

  /**
   * The largest jump of @p function within @p duration, from its value at the
   * start on: what is left of the steepest change as the interval around it
   * shrinks.
   */
  struct Jump
  {
    double time   = 0.; /**< [s] */
    double height = 0.; /**< not negative */
  };
  Jump largest_jump(const FunctionOfTime &function, double duration);

  /** What a function of time gives of the motion of particles. */
  enum class SignalKind
  {
    velocity,     /**< or a stress, which goes with it in a wave */
    displacement, /**< or the moment of a source */
    acceleration
  };

  /** highest_frequency() of the velocity that belongs to @p function within
      @p duration [s]; 0 if a value is not finite, which the run will name. */
  double velocity_frequency(const FunctionOfTime &function, SignalKind kind,
                            double duration);

  /** A signal that shakes, and up to which frequency [Hz]; 0: it does not. */
  struct Shaking
  {
    std::string name; /**< "the load 'push'" */
    double frequency = 0.;

    /** Becomes the signal @p other_name if that is faster. */
    void take_faster(const std::string &other_name, double other_frequency);
  };

  /**
   * Edges of an S wave below which we warn: eight to ten are right, and with
   * five it runs seven per cent too slowly; theory.md, "Critical time step".
   */
  constexpr double fewest_edges = 5.;
} // namespace quoin

#endif
