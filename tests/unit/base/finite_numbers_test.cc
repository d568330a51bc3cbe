// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/finite_numbers.h>

#include <gtest/gtest.h>

using namespace quoin;
using Numbers = std::vector<double>;

TEST(FiniteNumbers, WordsThatAreNumbers)
{
  EXPECT_EQ(finite_numbers({ "2", "-.5", " 1e3 " }),
            Numbers({ 2., -0.5, 1000. }));
  EXPECT_EQ(finite_numbers({}), Numbers());
}

TEST(FiniteNumbers, OneThatIsNoFiniteNumberLeavesNone)
{
  for (const char *word :
       { "", "x", "5m", "1 2", "nan", "inf", "-inf", "1e999" })
    EXPECT_EQ(finite_numbers({ "1", word, "2" }), Numbers()) << word;
}
