// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_state.h>
#include <quoin/operators/archive.h>
#include <quoin/block_problem/state_gathering.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace quoin;

namespace
{
  std::string archived(const State<2> &state)
  {
    std::ostringstream stream;
    boost::archive::binary_oarchive archive(stream);
    archive << state;
    return stream.str();
  }

  EntryNumbers numbers_of(const EntryNumbers::List &nodes)
  {
    EntryNumbers numbers;
    numbers.nodes         = nodes;
    numbers.n_owned_nodes = nodes.size();
    numbers.own[RigidBlockStates::slice_name];
    return numbers;
  }

  State<2> state_at(const EntryNumbers &numbers, const double u)
  {
    State<2> state;
    state.add<ImplicitState>();
    for (const std::uint64_t number : numbers.nodes)
      state.nodes.push_back({ {}, dealii::Point<2>(double(number), u) });
    return state;
  }
} // namespace

TEST(StateGathering, OfAJumpTheEquilibriumBeforeItToo)
{
  const std::vector<EntryNumbers> there
      = { numbers_of({ 2, 0 }), numbers_of({ 1 }) };
  const EntryNumbers here = numbers_of({ 0, 1, 2 });
  State<2> state          = state_at(numbers_of({}), 0.);
  StateGathering<2> gathering(here, true, state);
  for (const unsigned int rank : { 1, 0 })
  {
    State<2> part           = state_at(there[rank], 2.);
    ImplicitState &implicit = part.get<ImplicitState>();
    implicit.jumps          = true;
    implicit.before_jump    = archived(state_at(there[rank], 1.));
    gathering.take(part, there[rank]);
  }
  gathering.finish();

  State<2> before = state_at(numbers_of({}), 0.);
  std::istringstream stream(state.get<ImplicitState>().before_jump);
  boost::archive::binary_iarchive archive(stream);
  archive >> before;
  ASSERT_EQ(state.nodes.size(), 3U);
  ASSERT_EQ(before.nodes.size(), 3U);
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(state.nodes[i].u[0], i);
    EXPECT_EQ(before.nodes[i].u[0], i);
    EXPECT_EQ(state.nodes[i].u[1], 2.);
    EXPECT_EQ(before.nodes[i].u[1], 1.);
  }
}
