// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "rock_walk.h"

using namespace quoin;
using namespace quoin::rock_test;

namespace
{
  constexpr double kni = 10e9, Vm = 0.3e-3, largest = 250e9;

  /** s tan(phi_r + share i) of rough() at the pressure @p s [Pa]. */
  double strength(const double s, const double share)
  {
    const double i = 10. * std::log10(100e6 / s);
    return s * std::tan((28. + share * i) * degree);
  }

  double dilation(const double s, const double share)
  {
    return std::tan(0.5 * share * 10. * std::log10(100e6 / s) * degree);
  }
} // namespace

TEST(BartonBandisLaw, ClosesAlongTheHyperbola)
{
  const BartonBandisLaw law = rough();
  Walk<BartonBandisLaw> walk{ law };
  for (const double V : { 1e-5, 5e-5, 1e-4, 2e-4, 1e-4, 5e-5, 0. })
  {
    walk.move(-V, 0.);
    EXPECT_NEAR(walk.point.normal_traction, -kni * V / (1. - V / Vm), 1e-3);
    EXPECT_NEAR(law.closure.closure(-walk.point.normal_traction), V, 1e-18);
    EXPECT_EQ(walk.point.state, JointState::intact);
  }
  EXPECT_EQ(walk.lost, 0.);
}

TEST(BartonBandisLaw, ClosureGoesOnStraightAtTheLargestStiffness)
{
  const HyperbolicClosure closure(kni, Vm, largest);
  // kn = kni / (1 - V/Vm)^2 is 25 kni at V = 0.8 Vm, s = 4 kni Vm.
  EXPECT_NEAR(closure.traction(0.8 * Vm), 4. * kni * Vm, 1.);
  EXPECT_NEAR(closure.stiffness(3.9999 * kni * Vm), largest, 1e-4 * largest);
  EXPECT_EQ(closure.stiffness(5. * kni * Vm), largest);
  EXPECT_NEAR(closure.traction(2. * Vm), 4. * kni * Vm + 1.2 * Vm * largest,
              1.);
  for (const double s : { 1e5, 1e6, 1.1e7, 1.3e7, 8e7 })
  {
    EXPECT_NEAR(closure.traction(closure.closure(s)), s, 1e-9 * s);
    // Energy is the integral of the traction.
    const double h = 1e-4 * s;
    EXPECT_NEAR((closure.energy(s + h) - closure.energy(s - h))
                    / (closure.closure(s + h) - closure.closure(s - h)),
                s, 1e-6 * s);
    EXPECT_NEAR(closure.stiffness(s),
                2. * h / (closure.closure(s + h) - closure.closure(s - h)),
                1e-6 * closure.stiffness(s));
  }
}

TEST(BartonBandisLaw, MobilisesRoughnessByTheTable)
{
  const double s      = 2e6;
  const double slip[] = { 0.3, 0.6, 1., 2., 4., 10., 25., 60., 120. };
  const double share[]
      = { 0., 0.75, 1., 0.85, 0.7, 0.5, 0.4, 0.4 * 40. / 75., 0. };
  for (const double sense : { 1., -1. })
  {
    auto walk = closed(rough(), -s);
    for (unsigned int i = 0; i < 9; ++i)
    {
      walk.slide(-s, sense * slip[i] * 1e-3, 20);
      EXPECT_NEAR(walk.point.shear_traction, sense * strength(s, share[i]),
                  1e-6 * s)
          << slip[i];
      EXPECT_EQ(walk.point.state, JointState::slipping);
    }
  }
}

TEST(BartonBandisLaw, FrictionGrowsFromNothing)
{
  const double s = 2e6;
  auto walk      = closed(rough(), -s);
  // Softer than ks from the start: a third of the way to phi_r.
  walk.slide(-s, 1e-4, 10);
  EXPECT_NEAR(walk.point.shear_traction, s * std::tan(28. / 3. * degree), 10.);
  EXPECT_EQ(walk.point.dilated, 0.);
}

TEST(BartonBandisLaw, StrengthHasItsLimits)
{
  const BartonBandisLaw law = rough();
  double tangent;
  // phi_r + i at most 70 degrees: 10 log10(JCS/s) = 42 at s = 6.3 kPa
  for (const double s : { 6.2e3, 1e2, 1e-3 })
    EXPECT_NEAR(law.strength(s, 1e-3, tangent), s * std::tan(70. * degree),
                1e-6 * s);
  EXPECT_NEAR(tangent, std::tan(21. * degree), 1e-9);
  EXPECT_LT(law.strength(6.4e3, 1e-3, tangent),
            6.4e3 * std::tan(69.99 * degree));
  // No roughness that lowers the friction of a joint pressed beyond JCS
  EXPECT_NEAR(law.strength(2e8, 1e-3, tangent), 2e8 * std::tan(28. * degree),
              1.);
  EXPECT_EQ(tangent, 0.);
  EXPECT_EQ(law.strength(0., 1e-3, tangent), 0.);
}

TEST(BartonBandisLaw, DilatesByHalfTheRoughness)
{
  const double s = 2e6;
  auto walk      = closed(rough(), -s);
  walk.slide(-s, 5e-3, 200);
  const double before = walk.point.dilated, slip = walk.point.plastic_slip;
  walk.slide(-s, 5.01e-3, 1);
  EXPECT_NEAR((walk.point.dilated - before) / (walk.point.plastic_slip - slip),
              dilation(s, 0.7 - 0.2 * 1.01 / 6.), 1e-8);
  EXPECT_NEAR(walk.opening, walk.point.dilated - walk.law.closure.closure(s),
              1e-12);
}

TEST(BartonBandisLaw, ConfinedDilationPressesTheJoint)
{
  auto walk = closed(rough(), -1e6);
  walk.go(walk.opening, 3e-3, 3000);
  EXPECT_LT(walk.point.normal_traction, -8e6);
  // One large step ends near many small ones.
  auto once = closed(rough(), -1e6);
  once.go(once.opening, 3e-3, 30);
  EXPECT_NEAR(once.point.normal_traction, walk.point.normal_traction,
              0.02 * std::abs(walk.point.normal_traction));
}

TEST(BartonBandisLaw, SlipBackGoesOnWearingAndClosesWhatItOpened)
{
  const double s = 2e6;
  auto walk      = closed(rough(), -s);
  walk.slide(-s, 4e-3, 400);
  const double tau = walk.point.shear_traction, up = walk.point.dilated;
  const double elastic = tau / 5e9;
  walk.slide(-s, 4e-3 - elastic, 10);
  EXPECT_NEAR(walk.point.shear_traction, 0., 1e-3 * tau);
  EXPECT_EQ(walk.point.state, JointState::slipped);
  EXPECT_EQ(walk.point.dilated, up);

  walk.slide(-s, 2e-3, 200);
  // Slip that counts: 4 mm forth, and back but for the elastic return
  const double counted = 4e-3 + 2e-3 - 2. * elastic;
  const double share   = 0.7 - 0.2 * (counted / 1e-3 - 4.) / 6.;
  EXPECT_NEAR(walk.point.shear_traction, -strength(s, share), 4e-3 * tau);
  EXPECT_LT(walk.point.dilated, up - 1e-4);
  EXPECT_GT(walk.point.dilated, 0.);
}

TEST(BartonBandisLaw, SlipBackTakesBackNoMoreThanThereIs)
{
  const double s = 2e6;
  auto walk      = closed(rough(), -s);
  // Forth without dilation, back with
  walk.slide(-s, 0.29e-3, 10);
  EXPECT_EQ(walk.point.dilated, 0.);
  walk.slide(-s, 0., 50);
  EXPECT_EQ(walk.point.dilated, 0.);
  EXPECT_NEAR(walk.opening, -walk.law.closure.closure(s), 1e-12);
  walk.slide(-s, -1e-3, 50);
  EXPECT_GT(walk.point.dilated, 0.);
}

TEST(BartonBandisLaw, AnOpenJointTransfersNothingAndIsNotWorn)
{
  const double s = 2e6;
  auto walk      = closed(rough(), -s);
  walk.slide(-s, 1e-3, 50);
  walk.go(1e-3, 1e-3, 100);
  EXPECT_EQ(walk.point.state, JointState::open);
  const double worn = walk.point.worn_slip, up = walk.point.plastic_opening;
  walk.go(1e-3, 5e-3, 10);
  EXPECT_EQ(walk.point.normal_traction, 0.);
  EXPECT_EQ(walk.point.shear_traction, 0.);
  EXPECT_EQ(walk.law.stored_energy(walk.point), 0.);
  EXPECT_EQ(walk.point.worn_slip, worn);
  walk.go(up - 1e-4, 5e-3, 10);
  EXPECT_NEAR(walk.point.normal_traction, -kni * 1e-4 / (1. - 1e-4 / Vm),
              0.02 * s);
  EXPECT_EQ(walk.point.shear_traction, 0.);
}

TEST(BartonBandisLaw, EnergyAlongARandomPath)
{
  const auto coarse = random_walk(rough(), 200);
  const auto fine   = random_walk(rough(), 1600);
  EXPECT_LT(std::abs(coarse.residual()), 1e-4);
  EXPECT_LT(std::abs(fine.residual()), 1e-5);
  EXPECT_GT(fine.lost, 0.5 * fine.work);
  // Nothing but rounding is created.
  EXPECT_GT(fine.least, -1e-9);
  EXPECT_GT(fine.point.worn_slip, 0.1);
}

TEST(BartonBandisLaw, TangentIsThatOfTheUpdate)
{
  for (const double reach : { 2e-4, 2e-3, 2e-2 })
  {
    unsigned int n;
    EXPECT_LT(tangent_error(rough(), reach, n), 1e-4) << reach;
    EXPECT_GT(n, 6000U);
  }
}

TEST(BartonBandisLaw, StartsAtRestUnderAnyTraction)
{
  const BartonBandisLaw law = rough();
  for (const double share : { 0.1, 0.4, 0.75, 0.9, 0.999 })
    for (const double sense : { 1., -1. })
      for (const double s : { 1e4, 2e6, 3e6 })
      {
        const double tau = sense * share * strength(s, 1.);
        RockPoint<2> point;
        law.initialise(point, -s, tau);
        EXPECT_EQ(point.normal_traction, -s);
        EXPECT_EQ(point.shear_traction, tau);
        law.update(point, 0., 0.);
        EXPECT_NEAR(point.normal_traction, -s, 1e-9 * s);
        EXPECT_NEAR(point.shear_traction, tau, 1e-9 * s);
        EXPECT_EQ(point.state, JointState::intact);
        // Not stronger than it need be, if ks is not what it lacks
        const double more   = law.peak_slip * 0.05;
        RockPoint<2> beyond = point;
        law.update(beyond, 0., sense * more);
        EXPECT_LT(std::abs(beyond.shear_traction),
                  std::abs(tau) + 5e9 * more * (1. + 1e-12));
      }
  // What it cannot bear it sheds.
  RockPoint<2> point;
  law.initialise(point, -2e6, 1.5 * strength(2e6, 1.));
  law.update(point, 0., 0.);
  EXPECT_EQ(point.state, JointState::slipping);
  law.initialise(point, 1e6, 1e6);
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_EQ(point.shear_traction, 0.);
}
