// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_signals_record_h
#define quoin_signals_record_h

#include <quoin/signals/signal.h>
#include <quoin/signals/time_table.h>

#include <string>

namespace quoin
{
  /** Extension of the name of @p file, in capitals and without the dot; empty:
      it has none. */
  std::string file_extension(const std::string &file);

  /**
   * Baseline corrections. The record a has the integrals v and u, and the
   * duration T.
   */
  enum class Baseline
  {
    none,
    linear,   /**< a constant is added to a: v(T) = 0 */
    quadratic /**< a line is added to a: v(T) = 0 and u(T) = 0 */
  };

  /**
   * A recorded ground motion: samples, mostly of acceleration, linear in
   * between and zero before the first and after the last one. Its integrals are
   * then those of the trapezoidal rule and of linear acceleration, exactly.
   */
  class Record
  {
  public:
    /**
     * Reads a table (read_time_table()) or, if the name ends in .at2, .vt2 or
     * .dt2, a file of the PEER strong motion database: a header with the number
     * of points and the time step ("NPTS= 2000, DT= .02 SEC" or
     * "2000 .02 NPTS, DT"), and values. Units that its header names, g or cm
     * and seconds, are changed to m and s; without any, they are g in .at2
     * and cm in others. Throws InputError.
     */
    static Record read(const std::string &file);

    /** Throws InputError if there are less than two samples. */
    explicit Record(TimeTable samples);

    /** Times [s] and values. */
    const TimeTable &samples() const
    {
      return table;
    }

    /** Tapers both ends by a cosine, over @p share of the duration each. */
    void taper(double share);

    /** Corrects the baseline. Call it last, as it depends on the ends. */
    void correct(Baseline baseline);

    void scale(double factor);

    double peak() const;
    double final_integral() const;
    double final_second_integral() const;
    double duration() const;

    /** The record with its integrals. */
    Signal signal() const;

  private:
    TimeTable table;
  };
} // namespace quoin

#endif
