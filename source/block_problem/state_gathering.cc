// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_state.h>
#include <quoin/operators/archive.h>
#include <quoin/block_problem/state_gathering.h>

#include <sstream>

namespace quoin
{
  template <int dim>
  StateGathering<dim>::StateGathering(const EntryNumbers &here,
                                      const bool is_first_rank,
                                      State<dim> &state)
    : moves(here, is_first_rank), state(state)
  {
  }

  template <int dim>
  void StateGathering<dim>::take(State<dim> &part, const EntryNumbers &numbers)
  {
    moves.begin_part(numbers);
    state.take(part, moves);
    if (!part.template find<ImplicitState>()
        || !part.template get<ImplicitState>().jumps)
      return;
    if (!before_jump)
      before_jump = std::make_unique<State<dim>>(state); // with its slices
    std::istringstream archived(part.template get<ImplicitState>().before_jump);
    boost::archive::binary_iarchive(archived) >> part;
    before_jump->take(part, moves);
  }

  template <int dim>
  void StateGathering<dim>::finish()
  {
    moves.check_complete();
    if (!before_jump)
      return;
    std::ostringstream archived;
    boost::archive::binary_oarchive archive(archived);
    archive << *before_jump;
    state.template get<ImplicitState>().before_jump = archived.str();
  }

  template class StateGathering<2>;
  template class StateGathering<3>;
} // namespace quoin
