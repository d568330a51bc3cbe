// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_entry_numbers_h
#define quoin_results_entry_numbers_h

#include <quoin/dynamics/solver.h>
#include <quoin/operators/redistribution.h>

namespace quoin
{
  /**
   * Global numbers of what the entries of this rank's State belong to, see
   * Redistribution. Redistribution::Mover::own() means segments of matched
   * joints, rigid blocks, boundary nodes of contacts, and nodes of a load.
   */
  template <int dim>
  EntryNumbers number_entries(const Model<dim> &model,
                              const Solver<dim> &solver);

  /** Leaves out the cells if no entry of @p state belongs to one. */
  template <int dim>
  EntryNumbers number_entries_of(const State<dim> &state,
                                 const Model<dim> &model,
                                 const Solver<dim> &solver);
} // namespace quoin

#endif
