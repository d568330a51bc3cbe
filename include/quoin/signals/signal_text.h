// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_signal_text_h
#define quoin_signals_signal_text_h

#include <quoin/signals/signal.h>

#include <string>

namespace quoin
{
  /**
   * Whether @p text begins like a signal of read_signal(): with one of the
   * words wavelet, pulse, cycles, record, synthetic.
   */
  bool is_signal_text(const std::string &text);

  /**
   * A signal from its description in a parameter file. Times and delays are in
   * seconds, frequencies in Hz, and all but records have the peak 1 unless
   * stated; entries in brackets are optional.
   *
   *   wavelet Ricker FREQUENCY [DELAY]         delay 1.5 / FREQUENCY
   *   wavelet Gabor FREQUENCY WIDTH PHASE DELAY         phase in degrees
   *   pulse half-sine DURATION [DELAY]
   *   pulse triangular RISE DECAY [DELAY]
   *   pulse exponential RISE DECAY [DELAY]
   *   pulse Friedlander DURATION COEFFICIENT [DELAY]
   *   cycles RATE AMPLITUDE [AMPLITUDE ...]      not of peak 1: sine_cycles()
   *   record FILE [OPTIONS]
   *   synthetic [OPTIONS]
   *
   * Options of records, each a word and a value: taper SHARE, baseline none,
   * linear or quadratic (in this order, see Record), integrated once or twice,
   * delay DELAY. Those of synthetic records: frequency, damping, high-pass,
   * duration, step, seed, peak or Arias, envelope Saragoni-Hart or trapezoidal
   * (see SyntheticRecordParameters), integrated, delay.
   *
   * File names are relative to @p folder. Throws an InputError that says what
   * is wrong, without naming section or parameter.
   */
  Signal read_signal(const std::string &text, const std::string &folder);

  /**
   * Why the signal in @p text is not that of a displacement derived @p
   * derivative times by time (velocity: 1), and what to do, without a stop at
   * the end; empty: nothing is known against it. It is known of records of the
   * PEER database, whose names end in what they are of, and of synthetic ones,
   * which are accelerations.
   */
  std::string other_motion_text(const std::string &text, int derivative);

  /** The word for a displacement derived @p derivative times. */
  std::string motion_word(int derivative);
} // namespace quoin

#endif
