// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_signal_advice_h
#define quoin_advice_signal_advice_h

#include <quoin/advice/advice.h>

namespace quoin
{
  /**
   * Warns of functions of time that hardly mean what they say: gravity that
   * begins anew in a later stage, acts twice or along y, records of velocity
   * that end in motion, incident waves in mm/s, and rows of histories that are
   * farther apart than the run is long. @p dim: 2 or 3.
   */
  void check_signals(const Parameters &parameters, unsigned int dim,
                     Advice &advice);
} // namespace quoin

#endif
