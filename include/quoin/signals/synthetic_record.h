// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_synthetic_record_h
#define quoin_signals_synthetic_record_h

#include <quoin/signals/record.h>

#include <cstdint>

namespace quoin
{
  /** Envelope of the shaking as a function of s, time by duration. */
  enum class Envelope
  {
    /**
     * a s^b exp(-c s) with its peak 1 at s = 0.2 and 0.05 at the end
     * @cite SaragoniHart1974 @cite Boore1983
     */
    saragoni_hart,
    trapezoidal /**< rises until 0.15, falls linearly from 0.65 on */
  };

  struct SyntheticRecordParameters
  {
    double frequency = 2.5; /**< frequency of the ground [Hz] */
    double damping   = 0.6; /**< damping ratio of the ground [-] */
    /** Frequency of the high-pass filter; 0: frequency / 10 [Hz]. */
    double low_frequency = 0.;
    double low_damping = 0.6;  /**< damping ratio of the high-pass filter [-] */
    double duration    = 20.;  /**< [s] */
    double step        = 0.01; /**< time between samples [s] */
    double peak        = 1.;   /**< acceleration; 0: see arias [m/s^2] */
    double arias       = 0.;   /**< Arias intensity [m/s] */
    Envelope envelope  = Envelope::saragoni_hart;
    std::uint64_t seed = 1;
  };

  /**
   * An artificial accelerogram [m/s^2]: Gaussian white noise through a layer of
   * ground, an oscillator whose base is shaken, as the absolute acceleration
   * @cite Kanai1957 @cite Tajimi1960, and through a second oscillator, as the
   * relative one, which removes low frequencies @cite CloughPenzien1975; then
   * times the envelope, tapered over 5 % of the duration at each end, corrected
   * so that velocity and displacement end at zero (Baseline::quadratic), and
   * scaled. The spectral density of the stationary motion is
   *
   *   (1 + 4 z^2 x^2) / ((1 - x^2)^2 + 4 z^2 x^2)
   *     * y^4 / ((1 - y^2)^2 + 4 z_l^2 y^2),
   *
   * x = w/w_g, y = w/w_l. The noise is constant during a step and the
   * oscillators are integrated exactly. The Arias intensity is
   * pi/(2 g) times the integral of the squared acceleration.
   *
   * Normal deviates are made from std::mt19937_64 by Box and Muller's
   * transform, so that a seed gives the same record with any standard library.
   * Throws InputError for frequencies that the step does not resolve.
   */
  Record synthetic_record(const SyntheticRecordParameters &parameters);
} // namespace quoin

#endif
