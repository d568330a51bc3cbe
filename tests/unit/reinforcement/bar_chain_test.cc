// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Bars of bonded elements: closed forms of pull-out, energies, derivatives.

#include <quoin/base/constants.h>
#include <quoin/reinforcement/bar_chain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace quoin;

namespace
{
  constexpr double modulus = 200e9, diameter = 0.0254;

  BarLaw grouted()
  {
    BarLaw law;
    law.stiffness
        = modulus * constants::pi * diameter * diameter / 4.; // 101 MN
    law.bond_stiffness = 1e9;
    return law;
  }

  /** @p n bonded elements over @p length, behind one without bond. */
  BarChain chain_of(const unsigned int n, const double length,
                    const double free = 0.1)
  {
    BarChain chain;
    chain.length.assign(n + 1, length / n);
    chain.length[0] = free;
    chain.bond.assign(n + 2, length / n);
    chain.bond[0] = 0.;
    chain.bond[1] = chain.bond[n + 1] = 0.5 * length / n;
    return chain;
  }

  BarState at_rest(const BarChain &chain)
  {
    BarState state;
    state.resize(chain, 0);
    return state;
  }

  /** Moves the head of a bar with a stiff plate away from the others. */
  double pull(const BarLaw &law, const BarChain &chain, BarState &state,
              const double motion)
  {
    std::vector<double> stretch(chain.n_elements(), 0.);
    stretch[0] = motion;
    update(law, chain, stretch, state);
    return state.force[0];
  }
} // namespace

TEST(BarChain, PullOutStiffness)
{
  BarLaw law          = grouted();
  law.plate_stiffness = 1e10;
  const BarChain bar  = chain_of(40, 0.5);
  BarState state      = at_rest(bar);
  const double force  = pull(law, bar, state, 1e-4);
  const double beta   = std::sqrt(law.bond_stiffness / law.stiffness);
  EXPECT_NEAR(beta, 3.1413, 1e-4);
  EXPECT_NEAR(force / state.slip[1],
              -law.stiffness * beta * std::tanh(0.5 * beta), 292e3);
}

TEST(BarChain, WholeBondSlipsAtItsStrength)
{
  BarLaw law          = grouted();
  law.plate_stiffness = 1e10;
  law.bond_strength   = 300e3;
  const BarChain bar  = chain_of(40, 0.5);
  BarState state      = at_rest(bar);
  EXPECT_LT(pull(law, bar, state, 4e-4), 150e3);
  EXPECT_NEAR(pull(law, bar, state, 5e-3), 150e3, 1e-3);
  // Pressure on the bond makes it stronger.
  law.bond_friction = 0.08;
  std::fill(state.pressure.begin(), state.pressure.end(), 1e6);
  EXPECT_NEAR(pull(law, bar, state, 1e-2), 190e3, 1e-3);
}

TEST(BarChain, BondRemembersItsSlip)
{
  BarLaw law          = grouted();
  law.plate_stiffness = 1e10;
  law.bond_strength   = 300e3;
  const BarChain bar  = chain_of(40, 0.5);
  BarState state      = at_rest(bar);
  const auto slipped  = [&](const std::uint8_t wanted)
  { return std::count(state.bond.begin(), state.bond.end(), wanted); };
  // Over the length a with F = s (a + tanh(b (L - a)) / b).
  const double beta  = std::sqrt(law.bond_stiffness / law.stiffness),
               force = pull(law, bar, state, 6e-4);
  double low = 0., high = 0.5;
  while (high - low > 1e-9)
  {
    const double a = 0.5 * (low + high);
    (law.bond_strength * (a + std::tanh(beta * (0.5 - a)) / beta) < force
         ? low
         : high)
        = a;
  }
  EXPECT_NEAR(slipped(bond_state::slips), low * 80. + 0.5, 1.);
  EXPECT_EQ(state.bond[0], bond_state::elastic); // without bond
  EXPECT_EQ(slipped(bond_state::has_slipped), 0);
  const auto n = slipped(bond_state::slips);
  pull(law, bar, state, 5.9e-4);
  EXPECT_EQ(slipped(bond_state::has_slipped), n);
  EXPECT_EQ(slipped(bond_state::slips), 0);
  pull(law, bar, state, 6.1e-4);
  EXPECT_GE(slipped(bond_state::slips), n);
}

TEST(BarChain, YieldsAndBreaksInItsFreeLength)
{
  BarLaw law          = grouted();
  law.plate_stiffness = 1e10;
  law.yield           = 80e3;
  law.rupture_strain  = 5e-3;
  const BarChain bar  = chain_of(20, 0.5);
  BarState state      = at_rest(bar);
  EXPECT_NEAR(pull(law, bar, state, 6e-4), 80e3, 1e-6);
  const double bonded = state.slip[1], head = state.slip[0];
  const double whole = 5e-3 * 0.1 - bonded + head;
  EXPECT_NEAR(pull(law, bar, state, whole - 1e-9), 80e3, 1e-6);
  EXPECT_FALSE(state.broken[0]);
  EXPECT_NEAR(pull(law, bar, state, whole + 1e-9), 80e3, 1e-6);
  EXPECT_TRUE(state.broken[0]);
  EXPECT_EQ(pull(law, bar, state, whole + 2e-9), 0.);
  EXPECT_NEAR(state.slip[1], 0., 1e-15);
}

TEST(BarChain, PretensionIsThatOfThePlate)
{
  BarLaw law          = grouted();
  law.plate_stiffness = 1e9;
  for (const double anchor : { 0., 1e9 })
  {
    law.anchor_stiffness = anchor;
    const BarChain bar   = chain_of(20, 2., 3.);
    BarState state       = at_rest(bar);
    ASSERT_TRUE(pretension(law, bar, 100e3, state));
    const auto before = state;
    update(law, bar, std::vector<double>(bar.n_elements(), 0.), state);
    EXPECT_NEAR(state.plate_force, 100e3, 1e-6);
    EXPECT_NEAR(state.force[0], 100e3, 1e-6);
    EXPECT_NEAR(state.anchor_force, anchor > 0. ? -100e3 : 0., 1e-6);
    if (anchor > 0.)
    {
      EXPECT_NEAR(state.bond_force[5], 0., 1e-6);
    }
    EXPECT_NEAR(state.slip[0], before.slip[0], 1e-12);
  }
  law.anchor_stiffness = 0.;
  law.bond_strength    = 40e3;
  const BarChain bar   = chain_of(20, 2., 3.);
  BarState state       = at_rest(bar);
  EXPECT_FALSE(pretension(law, bar, 100e3, state));
}

/** A random walk through slip, yield and rupture. */
TEST(BarChain, WorkIsStoredOrDissipated)
{
  BarLaw law           = grouted();
  law.bond_strength    = 200e3;
  law.anchor_stiffness = 1e8;
  law.anchor_strength  = 30e3;
  law.yield            = 100e3;
  law.rupture_strain   = 0.02;
  BarChain bar         = chain_of(8, 0.8);
  bar.bond[0]          = 0.5;
  BarState state       = at_rest(bar);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> change(-1., 1.);
  std::vector<double> stretch(bar.n_elements(), 0.);
  double work = 0., lost = 0., tensile = 0.;
  for (unsigned int step = 0; step < 2000; ++step)
  {
    auto next = stretch;
    for (double &s : next)
      s += 2e-4 * (change(random) + 0.1);
    const auto before        = state.force;
    const BarDissipation now = update(law, bar, next, state, nullptr, false);
    lost += now.plastic + now.friction + now.fracture;
    for (std::size_t e = 0; e < next.size(); ++e)
      work += 0.5 * (before[e] + state.force[e]) * (next[e] - stretch[e]);
    stretch = next;
    tensile = std::max(tensile, state.force[3]);
  }
  EXPECT_GT(tensile, 50e3);
  EXPECT_GT(std::count(state.broken.begin(), state.broken.end(), 1), 0);
  EXPECT_NEAR(work, stored_energy(law, bar, state) + lost, 1e-9 * lost);
}

TEST(BarChain, TangentIsTheDerivative)
{
  BarLaw law           = grouted();
  law.plate_stiffness  = 5e8;
  law.bond_strength    = 200e3;
  law.anchor_stiffness = 1e8;
  law.yield            = 70e3;
  const BarChain bar   = chain_of(6, 0.6);
  BarState state       = at_rest(bar);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> change(-1., 1.);
  std::vector<double> stretch(bar.n_elements(), 0.), tangent;
  const std::size_t m = bar.n_elements();
  for (unsigned int step = 0; step < 30; ++step)
  {
    for (double &s : stretch)
      s += 1e-4 * change(random);
    BarState at = state;
    update(law, bar, stretch, at, &tangent);
    constexpr double h = 1e-9;
    for (std::size_t f = 0; f < m; ++f)
    {
      auto up = stretch, down = stretch;
      up[f] += h;
      down[f] -= h;
      BarState a = state, b = state;
      update(law, bar, up, a);
      update(law, bar, down, b);
      for (std::size_t e = 0; e < m; ++e)
        EXPECT_NEAR(tangent[e * m + f], (a.force[e] - b.force[e]) / (2. * h),
                    1e-4 * law.stiffness / bar.length[0]);
    }
    state = at;
  }
}
