// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/operators/state.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace quoin;

namespace
{
  using quoin::serialize;

  struct Temperature
  {
    static constexpr const char *slice_name = "temperature";

    std::vector<double> values;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.own(values);
    }
  };

  std::string archived(const State<2> &state)
  {
    std::ostringstream stream;
    boost::archive::binary_oarchive archive(stream);
    archive << state;
    return stream.str();
  }

  void restore(const std::string &text, State<2> &state)
  {
    std::istringstream stream(text);
    boost::archive::binary_iarchive archive(stream);
    archive >> state;
  }
} // namespace

TEST(StateSlices, AreCopiedWithTheState)
{
  State<2> state;
  state.add<Temperature>().values   = { 1., 2. };
  State<2> copy                     = state;
  copy.get<Temperature>().values[0] = 3.;
  EXPECT_EQ(state.get<Temperature>().values[0], 1.);
  state = copy;
  EXPECT_EQ(state.get<Temperature>().values[0], 3.);
  // What is there stays as it is.
  EXPECT_EQ(state.add<Temperature>().values[1], 2.);
}

TEST(StateSlices, AreFoundByNameAndType)
{
  State<3> state;
  state.add<Temperature>("upper").values = { 1. };
  state.add<Temperature>("lower").values = { 2. };
  EXPECT_EQ(state.get<Temperature>("lower").values[0], 2.);
  EXPECT_EQ(state.find<Temperature>(), nullptr);
  EXPECT_EQ(state.find<EnergyAccounts>("upper"), nullptr);
  EXPECT_THROW(state.get<Temperature>(), std::logic_error);
}

TEST(StateSlices, AreArchivedByNameInAnyOrder)
{
  State<2> state;
  state.time                             = 0.5;
  state.add<Temperature>("upper").values = { 1. };
  state.add<Temperature>("lower").values = { 2., 3. };
  state.energy.radiated                  = 7.;
  State<2> other;
  other.add<Temperature>("lower");
  other.add<Temperature>("upper");
  restore(archived(state), other);
  EXPECT_EQ(other.time, 0.5);
  EXPECT_EQ(other.energy.radiated, 7.);
  EXPECT_EQ(other.get<Temperature>("upper").values, std::vector<double>{ 1. });
  EXPECT_EQ(other.get<Temperature>("lower").values.size(), 2U);
}

TEST(StateSlices, OfAnotherModelAreRefused)
{
  State<2> state, other, more;
  state.add<Temperature>("upper");
  other.add<Temperature>("lower");
  EXPECT_THROW(restore(archived(state), other),
               boost::archive::archive_exception);
  more.add<Temperature>("upper");
  more.add<Temperature>("lower");
  EXPECT_THROW(restore(archived(state), more),
               boost::archive::archive_exception);
}

// Scripts read the columns of energies.csv.
TEST(EnergyAccounts, ColumnsKeepTheirOrder)
{
  std::vector<std::string> names;
  for (const EnergyAccount &account : energy_accounts)
    names.push_back(account.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{
                "kinetic", "strain", "joint", "reinforcement", "friction",
                "fracture", "crushing", "plastic", "damping", "viscous",
                "contact", "radiated", "far field", "external" }));
}

TEST(EnergyAccounts, AllCountInTheBalance)
{
  EXPECT_EQ(std::size(energy_accounts) * sizeof(double),
            sizeof(EnergyAccounts));
  EnergyAccounts accounts;
  for (const EnergyAccount &account : energy_accounts)
    EXPECT_EQ(accounts.*account.value += 1., 1.) << account.name;
  EXPECT_EQ(accounts.sum(EnergyKind::given), 1.);
  EXPECT_EQ(accounts.sum(EnergyKind::dissipated), 8.);
  EXPECT_EQ(accounts.sum(EnergyKind::stored), 5.);
}
