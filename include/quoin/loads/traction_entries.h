// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_traction_entries_h
#define quoin_loads_traction_entries_h

#include <quoin/base/parameter_entries.h>
#include <quoin/loads/load_parameters.h>

namespace quoin
{
  /** Enters what tractions alone have: the shape of one that moves, the uplift
      below a dam and the mass of the water before it. */
  void enter_traction(ParameterEntries &entries, LoadParameters &load);
} // namespace quoin

#endif
