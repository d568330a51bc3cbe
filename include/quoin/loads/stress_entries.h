// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_stress_entries_h
#define quoin_loads_stress_entries_h

#include <quoin/base/parameter_entries.h>
#include <quoin/loads/load_parameters.h>

namespace quoin
{
  /** Enters what initial and in-situ stresses alone have. */
  void enter_initial_stress(ParameterEntries &entries, LoadParameters &load);
} // namespace quoin

#endif
