// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "rock_walk.h"

using namespace quoin;
using namespace quoin::rock_test;

namespace
{
  constexpr double pressure = 2e6;

  /** ks of yielding() at the pressure. */
  double shear_stiffness()
  {
    return 8e9 * std::pow(2., 0.4);
  }

  /** tau_m after @p worn [m]. */
  double strength(const double worn)
  {
    return pressure * std::tan((30. + 20. * std::exp(-worn / 1e-3)) * degree);
  }
} // namespace

TEST(ContinuouslyYieldingLaw, ClosureIsTheIntegralOfTheStiffness)
{
  for (const double exponent : { 0., 0.3, 0.5, 1. })
  {
    const PowerStiffness stiffness{ 20e9, exponent, 1e6, 1e4, 2e7 };
    const PowerClosure closure(stiffness);
    EXPECT_EQ(closure.traction(-1e-4), 0.);
    for (const double s : { 1e3, 2e4, 1e6, 1.9e7, 2.5e7, 1e8 })
    {
      const double V = closure.closure(s), h = 1e-4 * s;
      EXPECT_NEAR(closure.traction(V), s, 1e-9 * s);
      const double kept = std::min(std::max(s, 1e4), 2e7);
      EXPECT_NEAR(closure.stiffness(s), 20e9 * std::pow(kept / 1e6, exponent),
                  1.);
      EXPECT_NEAR(2. * h / (closure.closure(s + h) - closure.closure(s - h)),
                  closure.stiffness(s), 1e-6 * closure.stiffness(s));
      EXPECT_NEAR((closure.energy(s + h) - closure.energy(s - h)),
                  s * (closure.closure(s + h) - closure.closure(s - h)),
                  1e-6 * s * (closure.closure(s + h) - closure.closure(s - h)));
    }
  }
}

TEST(ContinuouslyYieldingLaw, YieldsFromTheFirstSlipOn)
{
  auto walk       = closed(yielding(), -pressure);
  const double ks = shear_stiffness(), tau_m = strength(0.);
  walk.slide(-pressure, 1e-9);
  EXPECT_NEAR(walk.point.shear_traction, ks * 1e-9, 1e-5 * ks * 1e-9);
  // With little wear an exponential
  walk.slide(-pressure, 1e-5, 10);
  EXPECT_NEAR(walk.point.shear_traction,
              tau_m * (1. - std::exp(-ks * 1e-5 / tau_m)), 1e-3 * tau_m);
  EXPECT_EQ(walk.point.state, JointState::intact);
}

TEST(ContinuouslyYieldingLaw, PeaksWhereItMeetsTheBoundAndWearsDown)
{
  auto walk   = closed(yielding(), -pressure);
  double peak = 0., worn = 0., above = 0.;
  for (unsigned int i = 1; i <= 2000; ++i)
  {
    walk.slide(-pressure, 1e-5 * i);
    if (walk.point.shear_traction > peak)
    {
      peak = walk.point.shear_traction;
      worn = walk.point.worn_slip;
    }
    above = walk.point.shear_traction - strength(walk.point.worn_slip);
  }
  EXPECT_NEAR(peak, strength(worn), 1e-3 * peak);
  EXPECT_NEAR(walk.point.shear_traction, pressure * std::tan(30. * degree),
              10.);
  EXPECT_GT(above, 0.);
  EXPECT_EQ(walk.point.state, JointState::slipping);
  // tan(i) R (phi_m0 - phi) and less, as the traction grows from nothing
  EXPECT_GT(walk.point.dilated, 1e-4);
  EXPECT_LT(walk.point.dilated, 1e-3 * 20. * degree);
}

TEST(ContinuouslyYieldingLaw, UnloadsElasticallyAndBeginsAnew)
{
  auto walk       = closed(yielding(), -pressure);
  const double ks = shear_stiffness();
  walk.slide(-pressure, 1e-3, 1000);
  const double tau = walk.point.shear_traction, worn = walk.point.worn_slip;
  EXPECT_EQ(walk.point.reload, 0.);
  const double down = 0.5 * tau / ks;
  walk.slide(-pressure, 1e-3 - down, 10);
  EXPECT_NEAR(walk.point.shear_traction, 0.5 * tau, 1e-6 * tau);
  EXPECT_NEAR(walk.point.worn_slip, worn, 1e-12);
  EXPECT_NEAR(walk.point.reload, 0.5 * tau / strength(worn), 1e-6);
  EXPECT_EQ(walk.point.state, JointState::slipped);

  // The same way again: F = 1 at first
  walk.slide(-pressure, 1e-3 - down + 1e-8);
  EXPECT_NEAR(walk.point.shear_traction - 0.5 * tau, ks * 1e-8,
              1e-3 * ks * 1e-8);
  EXPECT_NEAR(walk.point.reload, 0.5 * tau / strength(worn), 1e-6);

  // The other way, through zero: as from the first slip on
  walk.slide(-pressure, walk.slip - walk.point.shear_traction / ks, 10);
  walk.slide(-pressure, walk.slip - 1e-5, 10);
  EXPECT_EQ(walk.point.reload, 0.);
  const double tau_m = strength(worn);
  EXPECT_NEAR(walk.point.shear_traction,
              -tau_m * (1. - std::exp(-ks * 1e-5 / tau_m)), 1e-3 * tau_m);
}

TEST(ContinuouslyYieldingLaw, ReloadingNearTheBoundIsSofter)
{
  auto walk = closed(yielding(), -pressure);
  walk.slide(-pressure, 5e-3, 2000);
  walk.slide(-pressure, walk.slip - 1e-6);
  EXPECT_EQ(walk.point.reload, 0.75);
}

TEST(ContinuouslyYieldingLaw, RoundingTakesNothingBack)
{
  auto held = closed(yielding(), -pressure), through = held;
  for (auto *walk : { &held, &through })
    walk->slide(-pressure, 2e-4, 100);
  const double opening = held.opening, slip = held.slip;
  // The slip of blocks that have gone a long way is less exact than this.
  for (unsigned int i = 0; i < 1000; ++i)
    held.move(opening, slip + (i % 3 - 1.) * 1e-15);
  held.move(opening, slip);
  EXPECT_EQ(held.point.reload, 0.);
  EXPECT_NEAR(held.point.worn_slip, through.point.worn_slip, 1e-12);
  for (auto *walk : { &held, &through })
    walk->slide(-pressure, 4e-4, 100);
  EXPECT_NEAR(held.point.shear_traction, through.point.shear_traction,
              1e-8 * pressure);
  EXPECT_NEAR(held.lost, through.lost, 1e-8 * through.lost);
}

TEST(ContinuouslyYieldingLaw, VibrationsOfPressureLeaveShearAlone)
{
  auto walk = closed(yielding(), -pressure);
  walk.slide(-pressure, 2e-5, 50);
  const double sheared = walk.point.shear_traction, lost = walk.lost;
  const double worn = walk.point.worn_slip, opening = walk.opening;
  for (unsigned int i = 0; i < 100; ++i)
    for (const double ratio : { 0.5, 2., 1. })
      walk.go(walk.point.plastic_opening
                  - walk.law.closure.closure(ratio * pressure),
              walk.slip, 20);
  EXPECT_NEAR(walk.opening, opening, 1e-15);
  EXPECT_NEAR(walk.point.shear_traction, sheared, 1e-9 * sheared);
  EXPECT_NEAR(walk.point.worn_slip, worn, 1e-15);
  EXPECT_NEAR(walk.lost, lost, 1e-9 * lost);
}

TEST(ContinuouslyYieldingLaw, WithConstantShearStiffnessNothingComesBack)
{
  // Shear under high pressure, unload under low, and the other way round
  for (const double ratio : { 0.25, 4. })
  {
    auto walk = closed(yielding(0.), -pressure);
    walk.slide(-pressure, 2e-5, 50);
    walk.go(walk.point.plastic_opening
                - walk.law.closure.closure(ratio * pressure),
            walk.slip, 200);
    walk.go(walk.opening, walk.slip - 4e-5, 2000);
    EXPECT_GT(walk.least, -1e-12);
  }
}

TEST(ContinuouslyYieldingLaw, AnOpenJointTransfersNothing)
{
  auto walk = closed(yielding(), -pressure);
  walk.slide(-pressure, 1e-3, 100);
  walk.go(1e-3, walk.slip, 100);
  EXPECT_EQ(walk.point.state, JointState::open);
  const double worn = walk.point.worn_slip, up = walk.point.plastic_opening;
  walk.go(1e-3, 3e-3, 10);
  EXPECT_EQ(walk.point.normal_traction, 0.);
  EXPECT_EQ(walk.point.shear_traction, 0.);
  EXPECT_EQ(walk.point.worn_slip, worn);
  walk.go(up - walk.law.closure.closure(pressure), 3e-3, 10);
  EXPECT_NEAR(walk.point.normal_traction, -pressure, 1e-3 * pressure);
  EXPECT_EQ(walk.point.shear_traction, 0.);
}

TEST(ContinuouslyYieldingLaw, EnergyAlongARandomPath)
{
  for (const double exponent : { 0., 0.4 })
  {
    const auto coarse = random_walk(yielding(exponent), 200);
    const auto fine   = random_walk(yielding(exponent), 1600);
    EXPECT_LT(std::abs(coarse.residual()), 1e-5);
    EXPECT_LT(std::abs(fine.residual()), 1e-6);
    EXPECT_GT(fine.lost, 0.5 * fine.work);
    // What the trapezoidal rule makes of unloading through zero, at most
    EXPECT_GT(fine.least, -1e-6 * fine.lost);
  }
}

TEST(ContinuouslyYieldingLaw, TangentIsThatOfTheUpdate)
{
  for (const double reach : { 1e-5, 2e-4, 2e-3 })
    for (const double exponent : { 0., 0.4 })
    {
      unsigned int n;
      EXPECT_LT(tangent_error(yielding(exponent), reach, n), 1e-4) << reach;
      EXPECT_GT(n, 5000U);
    }
}

TEST(ContinuouslyYieldingLaw, StartsAtRestUnderAnyTraction)
{
  const ContinuouslyYieldingLaw law = yielding();
  for (const double tau : { 0., 0.5e6, -1.5e6 })
    for (const double s : { 5e3, 2e6, 2e8 })
    {
      RockPoint<2> point;
      law.initialise(point, -s, tau * s / pressure);
      law.update(point, 0., 0.);
      EXPECT_NEAR(point.normal_traction, -s, 1e-9 * s);
      EXPECT_NEAR(point.shear_traction, tau * s / pressure, 1e-9 * s);
      EXPECT_EQ(point.state, JointState::intact);
    }
}

TEST(ContinuouslyYieldingLaw, ShearFallsWithTheStrength)
{
  const auto bound
      = [](const ContinuouslyYieldingLaw &law, const RockPoint<2> &point)
  {
    return -point.normal_traction
           * std::tan(law.bounding_angle(point.worn_slip));
  };
  const ContinuouslyYieldingLaw law = yielding();
  auto walk                         = closed(law, -pressure);
  walk.slide(-pressure, 2e-4, 200);
  const double tau = walk.point.shear_traction;
  ASSERT_GT(tau, 0.6 * bound(law, walk.point));
  ASSERT_LT(tau, 0.9 * bound(law, walk.point));

  // At rest, by a law that still bears it, and by one that does not.
  RockPoint<2> point = walk.point;
  law.reduced(1.1).update(point, walk.opening, walk.slip);
  EXPECT_NEAR(point.shear_traction, tau, 1e-9 * tau);
  const ContinuouslyYieldingLaw weak = law.reduced(2.);
  const JointDissipation lost = weak.update(point, walk.opening, walk.slip);
  EXPECT_LT(point.shear_traction, 0.9 * tau);
  EXPECT_NEAR(point.shear_traction,
              pressure * std::tan(weak.bounding_angle(point.worn_slip)),
              1e-6 * tau);
  EXPECT_EQ(point.state, JointState::slipping);
  EXPECT_GT(lost.friction, 0.);
  EXPECT_FALSE(weak.holds(walk.point));

  // A pressure that fell leaves more than the strength at rest, until that is
  // reduced.
  const double low = 0.25 * pressure;
  walk.go(walk.point.plastic_opening - law.closure.closure(low), walk.slip, 50);
  EXPECT_FALSE(law.holds(walk.point));
  point                              = walk.point;
  const ContinuouslyYieldingLaw less = law.reduced(1.01);
  less.update(point, walk.opening, walk.slip);
  EXPECT_NEAR(point.shear_traction,
              low * std::tan(less.bounding_angle(point.worn_slip)), 1e-6 * tau);
}
