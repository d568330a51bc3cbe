// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/measurements.h>

#include <gtest/gtest.h>

using namespace quoin;

TEST(Measurements, BytesOfAStep)
{
  // Positions and displacements both ways, velocity, force, mass: 17 and 25
  // numbers of eight bytes.
  EXPECT_EQ(step_bytes(2, { 1., 0., 0., 0. }), 136.);
  EXPECT_EQ(step_bytes(3, { 1., 0., 0., 0. }), 200.);
  EXPECT_EQ(step_bytes(2, { 0., 1., 0., 0. }), 4.);
  // Two tractions, two plastic gaps and an area, two nodes and the state.
  EXPECT_EQ(step_bytes(2, { 0., 0., 1., 0. }), 49.);
  EXPECT_EQ(step_bytes(3, { 0., 0., 1., 0. }), 65.);
  EXPECT_GT(step_bytes(2, { 0., 0., 0., 1. }), 128.);
}

TEST(Measurements, SmallestStore)
{
  EXPECT_EQ(smallest_store(1e15), "memory");
  EXPECT_NE(smallest_store(1.), "");
}
