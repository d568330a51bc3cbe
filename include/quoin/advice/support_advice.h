// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_support_advice_h
#define quoin_advice_support_advice_h

#include <quoin/advice/advice.h>

namespace quoin
{
  /** Warns of bars that bear less than their entries say: elements too long
      for the forces, active lengths for which there is no room, ends at joints
      and free lengths across them, or no joint at all. Collective. */
  void check_bars(const Model<2> &model, Advice &advice);

  /** Warns of pressures in joints that section 'Water' fills as well, and of
      uplift off its joint. Collective. */
  void check_water(const Parameters &parameters, const NodeMap<2> &nodes,
                   Advice &advice);
} // namespace quoin

#endif
