// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"

#include <quoin/operators/archive.h>
#include <quoin/operators/state.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  using quoin::serialize;

  struct Item
  {
    std::vector<double> force;
    double share = 0.;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.owned_nodes(force, 2);
      visitor.same(share);
    }
  };

  struct Pair
  {
    unsigned int lower, upper;
    double slip;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &lower &upper &slip;
    }
  };

  /** A member of each kind. */
  struct Slice
  {
    static constexpr const char *slice_name = "slice";

    std::vector<double> of_cells, of_own;
    unsigned int n_own = 0;
    double centre[2]{};
    std::vector<Pair> pairs;
    std::vector<std::string> parts;
    std::vector<Item> items;
    double sum = 0.;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.cells(of_cells);
      visitor.same(n_own, centre);
      visitor.own(of_own, n_own);
      visitor.between(pairs);
      visitor.joined(parts);
      visitor.each(items);
      visitor.sums(sum);
    }
  };

  using List = EntryNumbers::List;

  /** A rank that owns @p owned and has copies of @p ghosts; cells and own
      entries have the numbers of owned nodes and a hundred or two more. */
  EntryNumbers numbers_of(const List &owned, const List &ghosts)
  {
    EntryNumbers result;
    result.nodes         = owned;
    result.n_owned_nodes = owned.size();
    for (const std::uint64_t number : owned)
    {
      result.cells.push_back(number + 100);
      result.own["slice"].push_back(number + 200);
    }
    // Edges of other ranks than this one's are not here.
    result.own["slice"];
    result.own["slice, edges"] = owned;
    result.nodes.insert(result.nodes.end(), ghosts.begin(), ghosts.end());
    return result;
  }

  /** The state of such a rank, whose values tell their numbers. */
  State<2> state_of(const EntryNumbers &numbers, const bool is_first_rank)
  {
    State<2> state;
    state.time = 3.;
    state.block_marks.assign(2, block_mark::left_box);
    for (const std::uint64_t number : numbers.nodes)
    {
      state.nodes.push_back(
          { { double(number), 1. }, dealii::Point<2>(0.1, 0.2) });
      state.velocity.push_back(dealii::Point<2>(0., 2. * double(number)));
    }
    // Copies of other ranks' nodes may be old.
    for (unsigned int i = numbers.n_owned_nodes; i < numbers.nodes.size(); ++i)
      state.velocity[i][1] = -1.;
    state.energy.friction = is_first_rank ? 1. : 10.;
    Slice &slice          = state.add<Slice>();
    slice.n_own           = 2;
    slice.centre[1]       = 7.;
    slice.sum             = is_first_rank ? 1. : 10.;
    slice.items.resize(1);
    slice.items[0].share = 0.5;
    for (unsigned int i = 0; i < numbers.n_owned_nodes; ++i)
    {
      const double number = numbers.nodes[i];
      slice.of_cells.push_back(3. * number);
      for (const double more : { 0., 0.5 })
      {
        slice.of_own.push_back(number + more);
        slice.items[0].force.push_back(-number - more);
      }
      slice.parts.push_back(std::to_string(numbers.nodes[i]));
      // With the next edge, which may be another rank's.
      slice.pairs.push_back({ unsigned(numbers.nodes[i]),
                              unsigned(numbers.nodes[i] + 1), number });
    }
    return state;
  }

  State<2> empty_state()
  {
    State<2> state;
    state.add<Slice>();
    // As an initial motion leaves it.
    state.energy.friction = 5.;
    return state;
  }

  const std::vector<EntryNumbers> two_ranks
      = { numbers_of({ 4, 0, 2 }, { 3, 1 }), numbers_of({ 1, 3 }, { 2 }) };

  State<2> gathered(const EntryNumbers &here, const bool is_first_rank,
                    const std::vector<EntryNumbers> &ranks = two_ranks)
  {
    State<2> state = empty_state();
    Redistribution moves(here, is_first_rank);
    for (unsigned int rank = ranks.size(); rank-- > 0;)
    {
      State<2> part = state_of(ranks[rank], rank == 0);
      moves.begin_part(ranks[rank]);
      state.take(part, moves);
    }
    moves.check_complete();
    return state;
  }
} // namespace

TEST(Redistribution, EachTakesItsOwn)
{
  for (const bool is_first_rank : { true, false })
  {
    // A node may be a ghost twice.
    const EntryNumbers here = numbers_of({ 0, 1, 4 }, { 3, 2, 3 });
    const State<2> state    = gathered(here, is_first_rank);
    EXPECT_EQ(state.time, 3.);
    EXPECT_EQ(state.block_marks.size(), 2U);
    EXPECT_EQ(state.energy.friction, is_first_rank ? 11. : 0.);
    ASSERT_EQ(state.nodes.size(), 6U);
    ASSERT_EQ(state.velocity.size(), 6U);
    for (unsigned int i = 0; i < 6; ++i)
    {
      EXPECT_EQ(state.nodes[i].X[0], double(here.nodes[i]));
      EXPECT_EQ(state.velocity[i][1], 2. * double(here.nodes[i]));
    }
    const Slice &slice = state.get<Slice>();
    EXPECT_EQ(slice.of_cells, (std::vector<double>{ 0., 3., 12. }));
    EXPECT_EQ(slice.of_own, (std::vector<double>{ 0., 0.5, 1., 1.5, 4., 4.5 }));
    EXPECT_EQ(slice.centre[1], 7.);
    ASSERT_EQ(slice.items.size(), 1U);
    EXPECT_EQ(slice.items[0].share, 0.5);
    EXPECT_EQ(slice.items[0].force,
              (std::vector<double>{ 0., -0.5, -1., -1.5, -4., -4.5 }));
    EXPECT_EQ(slice.parts,
              (std::vector<std::string>{ "4", "0", "2", "1", "3" }));
    EXPECT_EQ(slice.sum, is_first_rank ? 11. : 0.);
    // 2 and 3 are not here; 3 and 4 are by the latter.
    ASSERT_EQ(slice.pairs.size(), 4U);
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_EQ(slice.pairs[i].lower,
                (std::array<unsigned int, 4>{ 0, 1, 3, 4 })[i]);
  }
}

TEST(Redistribution, ToTheSameRanksIsTheSame)
{
  for (unsigned int rank = 0; rank < 2; ++rank)
  {
    State<2> before      = state_of(two_ranks[rank], rank == 0);
    const State<2> after = gathered(two_ranks[rank], rank == 0);
    for (unsigned int i = 0; i < two_ranks[rank].n_owned_nodes; ++i)
      EXPECT_EQ(after.velocity[i][1], before.velocity[i][1]);
    EXPECT_EQ(after.get<Slice>().of_own, before.get<Slice>().of_own);
    EXPECT_EQ(after.get<Slice>().items[0].force,
              before.get<Slice>().items[0].force);
  }
}

TEST(Redistribution, ARankMayHaveNothing)
{
  const State<2> state = gathered(numbers_of({}, {}), false);
  EXPECT_TRUE(state.nodes.empty());
  EXPECT_TRUE(state.get<Slice>().of_own.empty());
  EXPECT_EQ(state.get<Slice>().centre[1], 7.);
}

TEST(Redistribution, RefusesWhatDoesNotFit)
{
  const auto refusal
      = [](const EntryNumbers &here, const std::vector<EntryNumbers> &ranks)
  {
    return message_of<std::runtime_error>([&]()
                                          { gathered(here, true, ranks); });
  };
  EXPECT_EQ(refusal(numbers_of({ 0, 9 }, {}), two_ranks),
            "those of all ranks lack some of 'nodes'");

  EntryNumbers lacks = numbers_of({ 0, 1 }, {});
  lacks.own.erase("slice");
  EXPECT_EQ(refusal(numbers_of({ 0 }, {}), { lacks }),
            "it says nothing of 'slice'");

  // A slice whose entries nobody has numbered.
  State<2> state = empty_state(), part = state_of(lacks, true);
  Redistribution moves(lacks, true);
  moves.begin_part(lacks);
  EXPECT_EQ(message_of<std::runtime_error>([&]() { state.take(part, moves); }),
            "it has entries of something unknown");
}
