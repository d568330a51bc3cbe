// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_state_gathering_h
#define quoin_block_problem_state_gathering_h

#include <quoin/operators/redistribution.h>
#include <quoin/operators/state.h>

#include <memory>

namespace quoin
{
  /** Assembles the State of this rank from the archives of another number of
      ranks, by Redistribution. */
  template <int dim>
  class StateGathering
  {
  public:
    /** @p state, which must outlive this object, has all slices. */
    StateGathering(const EntryNumbers &here, bool is_first_rank,
                   State<dim> &state);

    /** Takes the state of a rank with the entries @p numbers; the first rank's
        comes last. */
    void take(State<dim> &part, const EntryNumbers &numbers);

    /** Throws a std::runtime_error if something is missing. */
    void finish();

  private:
    Redistribution moves;
    State<dim> &state;
    /** The equilibrium before the current jump. */
    std::unique_ptr<State<dim>> before_jump;
  };
} // namespace quoin

#endif
