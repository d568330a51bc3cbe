// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "composite_walk.h"

using namespace quoin;
using namespace quoin::composite_test;

TEST(CompositeLaw, ElasticInsideItsSurfaces)
{
  const CompositeLaw law = wall();
  CompositePoint<2> point;
  for (const double sigma : { 0.249e6, -1e6, -3.4e6, 0. })
    for (const double tau : { 0.15e6, -0.1e6, 0. })
    {
      const auto lost = law.update(point, sigma / 82e9, tau / 36e9);
      EXPECT_DOUBLE_EQ(point.normal_traction, sigma);
      EXPECT_DOUBLE_EQ(point.shear_traction, tau);
      EXPECT_EQ(point.state, JointState::intact);
      EXPECT_EQ(lost.total(), 0.);
    }
}

TEST(CompositeLaw, TensionTakesItsFractureEnergy)
{
  Walk walk   = begin(wall());
  double peak = 0., area = 0.;
  const unsigned int n = 200000;
  for (unsigned int i = 1; i <= n; ++i)
  {
    walk.move(1.2e-3 * i / n, 0.);
    peak           = std::max(peak, walk.point.normal_traction);
    const double w = walk.point.plastic_opening;
    EXPECT_NEAR(walk.point.normal_traction,
                w > 0. ? 0.25e6 * std::exp(-0.25e6 * w / 18.)
                       : 82e9 * walk.opening,
                1e-9 * 0.25e6);
  }
  area = walk.work;
  EXPECT_NEAR(peak, 0.25e6, 0.25e3);
  EXPECT_NEAR(area, 18., 18e-4);
  EXPECT_NEAR(walk.lost.tension, 18., 18e-4);
  EXPECT_EQ(walk.lost.total(), walk.lost.tension);
  EXPECT_EQ(walk.point.state, JointState::open);
}

TEST(CompositeLaw, ShearUnderPressure)
{
  // Peak c0 - sigma tan(phi0), residual -sigma tan(phi_r); above the residual
  // lies GfII, and what is below is friction.
  for (const CompositeLaw &law : { wall(), dilatant() })
    for (const double sigma : { 0., -0.1e6, -0.5e6, -1e6 })
      for (const double sense : { 1., -1. })
      {
        CompositeLaw plain = law;
        plain.dilation     = 0.;
        Walk walk          = begin(plain);
        walk.move(sigma / law.normal_stiffness, 0.);
        walk.work            = 0.;
        double peak          = 0.;
        const unsigned int n = 100000;
        for (unsigned int i = 1; i <= n; ++i)
        {
          walk.move(sigma / law.normal_stiffness, sense * 6e-3 * i / n);
          peak = std::max(peak, sense * walk.point.shear_traction);
        }
        const double residual = -sigma * law.residual_friction;
        EXPECT_NEAR(peak, 0.35e6 - sigma * 0.75, 1e3);
        EXPECT_NEAR(sense * walk.point.shear_traction, residual, 5.);
        EXPECT_EQ(walk.point.state, JointState::slipping);
        EXPECT_NEAR(walk.lost.shear, 125., 0.125);
        EXPECT_EQ(walk.lost.tension + walk.lost.crushing, 0.);
        // tan(phi) - tan(phi_r) fades as the cohesion does.
        const double extra
            = -sigma * (law.friction - law.residual_friction) * 125. / 0.35e6;
        const double slid = sense * walk.point.plastic_slip;
        EXPECT_NEAR(walk.lost.friction, residual * slid + extra,
                    1e-3 * residual * slid + 0.01);
      }
}

TEST(CompositeLaw, TensionAndShearSoftenTogether)
{
  // Half of the tensile strength gone: half of the cohesion gone.
  Walk walk            = begin(wall());
  const double opening = 18. / 0.25e6 * std::log(2.);
  walk.go(opening + 0.125e6 / 82e9, 0., 1000);
  EXPECT_NEAR(walk.point.normal_traction, 0.125e6, 1.);
  EXPECT_NEAR(cohesion_at(walk.law, walk.point), 0.175e6, 1.);

  // Closed again, which takes no more than the elastic way back.
  walk.go(walk.point.plastic_opening - 0.5e6 / 82e9, 0., 100);
  EXPECT_NEAR(walk.point.normal_traction, -0.5e6, 1.);
  EXPECT_EQ(walk.point.state, JointState::slipped);
  const double strength   = 0.175e6 + 0.75 * 0.5e6;
  CompositePoint<2> point = walk.point;
  walk.law.update(point, walk.opening, 0.999 * strength / 36e9);
  EXPECT_EQ(point.state, JointState::slipped);
  walk.law.update(point, walk.opening, 1.001 * strength / 36e9);
  EXPECT_EQ(point.state, JointState::slipping);

  // And the other way round, by slip: k2 that halves the cohesion.
  Walk slid = begin(wall());
  slid.go(0., 125. / 0.35e6 * std::log(2.) + 0.175e6 / 36e9, 1000);
  EXPECT_NEAR(slid.point.shear_traction, 0.175e6, 1.);
  CompositePoint<2> pulled = slid.point;
  slid.law.update(pulled, 0.12499e6 / 82e9, slid.slip - 0.175e6 / 36e9);
  EXPECT_NE(pulled.bond, 1.);
  EXPECT_NEAR(pulled.normal_traction, 0.12499e6, 1e-3);
  EXPECT_EQ(pulled.bond, slid.point.bond);
}

TEST(CompositeLaw, CompressionCurve)
{
  const CompositeLaw law = wall();
  const double km        = law.cap.middle_crushing();
  EXPECT_NEAR(km, 75. / 67. * 5000. / 10.5e6 + 0.09e-3, 1e-12);
  EXPECT_DOUBLE_EQ(law.cap.limit(0.), 3.5e6);
  EXPECT_DOUBLE_EQ(law.cap.limit(0.09e-3), 10.5e6);
  EXPECT_DOUBLE_EQ(law.cap.limit(km), 5.25e6);
  EXPECT_DOUBLE_EQ(law.cap.limit(1.), 1.5e6);
  // The slope is the derivative, continuous at km.
  for (const double k : { 1e-5, 8e-5, 1e-4, 5e-4, 1e-3 })
  {
    double slope;
    law.cap.limit(k, slope);
    EXPECT_NEAR(slope,
                (law.cap.limit(k + 1e-9) - law.cap.limit(k - 1e-9)) / 2e-9,
                1e-6 * std::abs(slope) + 1e3);
  }
  EXPECT_NEAR(law.cap.limit(km - 1e-9) - 5.25e6,
              5.25e6 - law.cap.limit(km + 1e-9), 1e-2);

  // The update follows it: k3 is the plastic closing.
  Walk walk = begin(law);
  for (unsigned int i = 1; i <= 20000; ++i)
  {
    walk.move(-4e-3 * i / 20000, 0.);
    const double k = walk.point.crushing;
    EXPECT_NEAR(k, -walk.point.plastic_opening, 1e-15);
    if (k > 0.)
    {
      EXPECT_NEAR(walk.point.normal_traction, -law.cap.limit(k), 1e-9 * 10.5e6);
    }
  }
  EXPECT_NEAR(walk.point.normal_traction, -1.5e6, 0.02e6);
  EXPECT_EQ(walk.lost.total(), walk.lost.crushing);
  EXPECT_NEAR(walk.work, walk.lost.total() + law.stored_energy(walk.point),
              1e-12 * walk.work);
}

TEST(CompositeLaw, ShearAddsToCrushing)
{
  // Css = 9: at zero normal traction the cap holds a third of the shear.
  CompositeLaw law = wall();
  law.cohesion     = 100e6;
  law.tension      = 1e6;
  Walk walk        = begin(law);
  walk.go(0., 2e-4, 100);
  EXPECT_NEAR(walk.point.normal_traction, 0., 1e-3);
  EXPECT_NEAR(walk.point.shear_traction,
              law.cap.limit(walk.point.crushing) / 3., 1e-3);
  EXPECT_NEAR(walk.point.plastic_slip, walk.point.crushing, 1e-15);
}

TEST(CompositeLaw, DilationLiftsTheJoint)
{
  // Free to rise under pressure it rises at tan(psi0) (1 - p/sigma_u), less
  // and less; above sigma_u it does not.
  CompositeLaw law    = wall();
  law.dilation        = 0.4;
  law.dilation_decay  = 2000.;
  law.cap.compression = CompositeLaw::infinity;
  for (const double pressure : { 0.2e6, 0.75e6, 1.4e6, 2e6 })
  {
    law.dilation_pressure = 1.5e6;
    Walk walk             = begin(law);
    walk.move(-pressure / 82e9, 0.);
    for (unsigned int i = 1; i <= 2000; ++i)
      walk.slide(-pressure, 2e-3 * i / 2000);
    const double slid     = walk.point.plastic_slip;
    const double expected = 0.4 * std::max(0., 1. - pressure / 1.5e6)
                            * (1. - std::exp(-2000. * slid)) / 2000.;
    EXPECT_NEAR(walk.point.plastic_opening, expected, 2e-3 * expected + 1e-12);
  }

  // Held, it is pressed together until dilation ends at sigma_u.
  Walk held               = begin(law);
  held.law.dilation_decay = 0.;
  held.move(-0.1e6 / 82e9, 0.);
  held.go(-0.1e6 / 82e9, 3e-3, 20000);
  EXPECT_NEAR(held.point.normal_traction, -1.5e6, 1e-3 * 1.5e6);
}

TEST(CompositeLaw, ClosingCrackCarriesCompressionAtItsPlasticOpening)
{
  Walk walk = begin(wall());
  walk.go(5e-4, 0., 100);
  const double kept = walk.point.plastic_opening;
  EXPECT_NEAR(kept, 5e-4, 1e-5);
  walk.go(kept, 0., 100);
  EXPECT_NEAR(walk.point.normal_traction, 0., 1e-3);
  walk.go(kept - 1e-5, 0., 1);
  EXPECT_DOUBLE_EQ(walk.point.normal_traction,
                   -82e9 * (walk.point.plastic_opening - walk.opening));
  EXPECT_NEAR(walk.point.normal_traction, -0.82e6, 10.);
  EXPECT_EQ(walk.point.state, JointState::slipped);
}

TEST(CompositeLaw, CrackThatClosesCarriesNothingUntilItIsClosed)
{
  CompositeLaw law = wall();
  law.cracks_close = true;
  Walk walk        = begin(law);
  walk.go(1e-4, 0., 200);
  const double strength = law.tension * walk.point.bond;
  EXPECT_DOUBLE_EQ(walk.point.normal_traction, strength);
  EXPECT_NEAR(walk.point.crack_opening, 1e-4 - strength / 82e9, 1e-15);
  // Half way back nothing, opened again up to what is left of the strength.
  walk.go(5e-5, 0., 37);
  EXPECT_EQ(walk.point.normal_traction, 0.);
  EXPECT_EQ(walk.point.state, JointState::open);
  walk.go(5e-5 + 0.5 * strength / 82e9, 0., 3);
  EXPECT_NEAR(walk.point.normal_traction, 0.5 * strength, 1e-6 * strength);
  walk.go(6e-5, 0., 50);
  EXPECT_DOUBLE_EQ(walk.point.normal_traction, law.tension * walk.point.bond);
  // Compression from the closed joint on, no earlier.
  walk.go(1e-7, 0., 50);
  EXPECT_EQ(walk.point.normal_traction, 0.);
  walk.go(-1e-5, 0., 50);
  EXPECT_NEAR(walk.point.normal_traction, -0.82e6, 1e-6);
  EXPECT_EQ(walk.point.crack_opening, 0.);
  EXPECT_NEAR(walk.point.plastic_opening, 0., 1e-18);
  EXPECT_EQ(walk.point.state, JointState::slipped);
  EXPECT_NEAR(walk.work, law.stored_energy(walk.point) + walk.lost.total(),
              1e-12 * walk.turnover);
  EXPECT_GT(walk.lost.tension, 0.);
}

TEST(CompositeLaw, WhatDilationOpenedDoesNotClose)
{
  CompositeLaw law = dilatant();
  law.cracks_close = true;
  Walk walk        = begin(law);
  walk.slide(-0.2e6, 1e-4);
  const double dilated = walk.point.plastic_opening;
  EXPECT_GT(dilated, 1e-6);
  EXPECT_EQ(walk.point.crack_opening, 0.);
  walk.go(dilated + 3e-5, walk.slip, 50);
  // As the shear traction goes, the joint still slips and dilates a little.
  const double kept = walk.point.plastic_opening - walk.point.crack_opening;
  EXPECT_GE(kept, dilated);
  EXPECT_GT(walk.point.crack_opening, 2e-5);
  walk.go(kept + 1e-6, walk.slip, 50);
  EXPECT_NEAR(walk.point.normal_traction, 0., 1e-3);
  walk.go(kept - 1e-6, walk.slip, 50);
  EXPECT_NEAR(walk.point.normal_traction, -82e3, 1e-3);
}

TEST(CompositeLaw, TangentOfACrackThatCloses)
{
  CompositeLaw law = wall();
  law.cracks_close = true;
  Walk walk        = begin(law);
  walk.go(1e-4, 2e-6, 100);
  const double h = 1e-10;
  // partly closed; wholly, sticking; wholly, slipping
  for (const auto &[opening, slip] : { std::array<double, 2>{ 5e-5, 3e-6 },
                                       std::array<double, 2>{ -1e-5, 3e-6 },
                                       std::array<double, 2>{ -1e-5, 9e-5 } })
  {
    CompositePoint<2> end = walk.point;
    JointTangent<2> tangent;
    law.update(end, opening, slip, tangent);
    const auto moved = [&](const double du, const double dv)
    {
      CompositePoint<2> point = walk.point;
      law.update(point, opening + du, slip + dv);
      return std::array<double, 2>{ point.normal_traction,
                                    point.shear_traction };
    };
    const auto right = moved(h, 0.), left = moved(-h, 0.);
    const auto above = moved(0., h), below = moved(0., -h);
    EXPECT_NEAR(tangent.normal_opening, (right[0] - left[0]) / (2. * h), 1e5);
    EXPECT_NEAR(tangent.shear_opening, (right[1] - left[1]) / (2. * h), 1e5);
    EXPECT_NEAR(tangent.normal_slip, (above[0] - below[0]) / (2. * h), 1e5);
    EXPECT_NEAR(tangent.shear_slip, (above[1] - below[1]) / (2. * h), 1e5);
  }
}

TEST(CompositeLaw, OpenJointHasNoShear)
{
  Walk walk = begin(wall());
  walk.go(3e-3, 0., 100);
  walk.go(4e-3, 2e-3, 10);
  EXPECT_NEAR(walk.point.shear_traction, 0., 1e-3);
  EXPECT_EQ(walk.point.state, JointState::open);
}

TEST(CompositeLaw, WithoutSofteningOrCapOrTension)
{
  CompositeLaw law   = wall();
  law.tension_energy = law.shear_energy = CompositeLaw::infinity;
  law.cap.compression                   = CompositeLaw::infinity;
  CompositePoint<2> point;
  law.update(point, 1., 0.);
  EXPECT_NEAR(point.normal_traction, 0.25e6, 1e-6);
  law.update(point, 2., 1.);
  EXPECT_NEAR(point.normal_traction, 0.25e6, 1e-6);
  EXPECT_NEAR(point.shear_traction, 0.35e6 - 0.75 * 0.25e6, 1e-6);
  EXPECT_EQ(point.bond, 1.);
  law.update(point, -1., 1.);
  EXPECT_NEAR(point.normal_traction, -82e9 * (1. + point.plastic_opening), 1.);
  EXPECT_EQ(point.crushing, 0.);
  EXPECT_TRUE(softens_gently(law));

  // No tension, but cohesion that opening does not take.
  law.tension = 0.;
  point       = CompositePoint<2>();
  law.update(point, 1e-3, 0.);
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_EQ(point.bond, 1.);
  law.update(point, point.plastic_opening - 1e-6, 1e-3);
  EXPECT_NEAR(point.shear_traction, 0.35e6 + 0.75 * 82e3, 1e-3);

  // Dry friction.
  law.cohesion = 0.;
  point        = CompositePoint<2>();
  law.update(point, -1e-6, 1e-3);
  EXPECT_NEAR(point.shear_traction, 0.75 * 82e3, 1e-6);
  law.update(point, 1e-6, 2e-3);
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_EQ(point.shear_traction, 0.);
}
