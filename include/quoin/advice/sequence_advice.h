// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_sequence_advice_h
#define quoin_advice_sequence_advice_h

#include <quoin/advice/advice.h>

namespace quoin
{
  /** Warns of forces of platens, of tractions where the next stage moves the
      boundary, and of supports of ground under initial stress that this stage
      does not name and nothing replaces. Collective. */
  template <int dim>
  void check_ended_loads(const Parameters &parameters,
                         const NodeMap<dim> &nodes, Advice &advice);

  /** Warns of bars, beams and liners that a stage places after which nothing
      changes. */
  void check_late_supports(const Parameters &parameters, Advice &advice);
} // namespace quoin

#endif
