// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <vector>

using namespace quoin;

namespace
{
  struct Item
  {
    std::string text;
    std::string name() const
    {
      return text;
    }
  };
} // namespace

TEST(KnownNames, AreJoinedWithoutThoseThatAreEmpty)
{
  EXPECT_EQ(known_names(std::vector<std::string>{ "", "bed", "", "head" }),
            "bed, head");
  EXPECT_EQ(known_names(std::set<std::string>{ "stone" }), "stone");
  EXPECT_EQ(known_names(std::vector<std::string>{ "" }), "none");
}

TEST(KnownNames, AreThoseOfAnyItems)
{
  const std::vector<Item> items{ { "bed" }, { "head" } };
  EXPECT_EQ(known_names(items, &Item::text), "bed, head");
  std::vector<std::unique_ptr<Item>> pointers;
  pointers.push_back(std::make_unique<Item>(items[1]));
  EXPECT_EQ(known_names(pointers, &Item::name), "head");
}

TEST(KnownNames, WithTheOneThatWasLikelyMeant)
{
  const std::vector<std::string> names{ "top", "bottom", "left" };
  EXPECT_EQ(known_names_like("botton", names),
            "top, bottom, left. The nearest one is 'bottom'");
  EXPECT_EQ(nearest_name("btotom", names), "bottom"); // letters changed places
  EXPECT_EQ(nearest_name("lfet", names), "left");
  EXPECT_EQ(nearest_name("tp", names), "top");
  // Nothing is near.
  EXPECT_EQ(known_names_like("base", names), "top, bottom, left");
  EXPECT_EQ(nearest_name("bed", names), "");
  EXPECT_EQ(nearest_name("", {}), "");
}
