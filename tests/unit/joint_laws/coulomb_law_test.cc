// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_laws/coulomb_law.h>

#include <gtest/gtest.h>

#include <random>

using namespace quoin;

namespace
{
  constexpr double kn       = 8e9;
  constexpr double ks       = 3e9;
  constexpr double cohesion = 1e6;
  constexpr double mu       = 0.75;
  constexpr double ft       = 0.4e6;

  JointPoint<2> fresh()
  {
    return { 0., 0., 0., 0., JointState::intact };
  }

  /** Loses cohesion and tension when it fails, keeps its friction. */
  CoulombLaw brittle()
  {
    CoulombLaw law;
    law.normal_stiffness = kn;
    law.shear_stiffness  = ks;
    law.peak             = { cohesion, mu, ft };
    law.residual         = { 0., mu, 0. };
    return law;
  }

  /** A joint that has slipped back and forth and is closed without shear. */
  JointPoint<2> failed(const CoulombLaw &law)
  {
    JointPoint<2> point = fresh();
    law.update(point, -1e6 / kn, 2e6 / ks);
    EXPECT_EQ(point.state, JointState::slipping);
    return point;
  }

  /** Work per area by the trapezoidal rule and what became of it. */
  struct Ledger
  {
    double work = 0., turnover = 0., friction = 0., fracture = 0.;
    double opening = 0., slip = 0.;

    JointDissipation move(const CoulombLaw &law, JointPoint<2> &point,
                          const double new_opening, const double new_slip)
    {
      const double sigma = point.normal_traction;
      const double tau   = point.shear_traction;
      const auto lost    = law.update(point, new_opening, new_slip);
      const double step
          = 0.5 * (sigma + point.normal_traction) * (new_opening - opening)
            + 0.5 * (tau + point.shear_traction) * (new_slip - slip);
      work += step;
      turnover += std::abs(step);
      friction += lost.friction;
      fracture += lost.fracture;
      opening = new_opening;
      slip    = new_slip;
      return lost;
    }
  };
} // namespace

TEST(CoulombLaw, ElasticBelowItsStrength)
{
  const CoulombLaw law = brittle();
  JointPoint<2> point  = fresh();
  for (const double opening : { 0.9 * ft / kn, -3e-4, 0. })
    for (const double slip : { 0.2e6 / ks, -0.1e6 / ks, 0. })
    {
      const auto lost = law.update(point, opening, slip);
      EXPECT_DOUBLE_EQ(point.normal_traction, kn * opening);
      EXPECT_DOUBLE_EQ(point.shear_traction, ks * slip);
      EXPECT_EQ(point.state, JointState::intact);
      EXPECT_EQ(lost.friction + lost.fracture, 0.);
      EXPECT_DOUBLE_EQ(law.stored_energy(point, opening),
                       0.5 * kn * opening * opening + 0.5 * ks * slip * slip);
    }
}

TEST(CoulombLaw, ShearPeakThenResidualAtOnce)
{
  CoulombLaw law        = brittle();
  law.residual.cohesion = 0.1e6;
  law.residual.friction = 0.5;

  const double sigma = -2e6;
  const double peak  = cohesion - sigma * mu;
  for (const double sense : { 1., -1. })
  {
    JointPoint<2> point = fresh();
    law.update(point, sigma / kn, sense * 0.999999 * peak / ks);
    EXPECT_EQ(point.state, JointState::intact);
    EXPECT_DOUBLE_EQ(point.shear_traction, sense * 0.999999 * peak);

    law.update(point, sigma / kn, sense * 1.000001 * peak / ks);
    EXPECT_EQ(point.state, JointState::slipping);
    const double rest = 0.1e6 - sigma * 0.5;
    EXPECT_NEAR(point.shear_traction, sense * rest, 1e-9 * rest);
    EXPECT_DOUBLE_EQ(point.normal_traction, sigma);

    // It stays there however far it slips, and lets go elastically.
    law.update(point, sigma / kn, sense * 7. * peak / ks);
    EXPECT_NEAR(point.shear_traction, sense * rest, 1e-9 * rest);
    law.update(point, sigma / kn, sense * (7. * peak - 0.5 * rest) / ks);
    EXPECT_NEAR(point.shear_traction, sense * 0.5 * rest, 1e-9 * rest);
    EXPECT_EQ(point.state, JointState::slipped);
  }
}

TEST(CoulombLaw, ShearFailureTakesTensionToo)
{
  const CoulombLaw law = brittle();
  JointPoint<2> point  = failed(law);
  law.update(point, 0.01 * ft / kn, 2e6 / ks);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_EQ(point.shear_traction, 0.);
}

TEST(CoulombLaw, TensionFailureTakesCohesionToo)
{
  const CoulombLaw law = brittle();
  JointPoint<2> point  = fresh();
  law.update(point, 1.001 * ft / kn, 0.);
  EXPECT_EQ(point.state, JointState::open);

  // Closed again, friction alone holds it.
  const double sigma = -1e6;
  law.update(point, sigma / kn, 0.9 * cohesion / ks);
  EXPECT_EQ(point.state, JointState::slipping);
  EXPECT_NEAR(point.shear_traction, -sigma * mu, 1e-9 * cohesion);
}

TEST(CoulombLaw, KnowsThatABondIsLostWhichWouldHold)
{
  const CoulombLaw law = brittle();
  EXPECT_TRUE(law.behaviour().has_bond);
  JointPoint<2> point = fresh();
  law.update(point, -1e6 / kn, 0.);
  EXPECT_FALSE(law.lost_its_bond(point)); // intact
  law.update(point, 2. * ft / kn, 0.);
  EXPECT_FALSE(law.lost_its_bond(point)); // open
  law.update(point, -1e6 / kn, 0.);
  EXPECT_TRUE(law.lost_its_bond(point));
  CoulombLaw ductile = law;
  ductile.residual   = ductile.peak;
  EXPECT_FALSE(ductile.behaviour().has_bond);
  EXPECT_FALSE(ductile.lost_its_bond(point));
}

TEST(CoulombLaw, TensionCutOff)
{
  const CoulombLaw law = brittle();
  JointPoint<2> point  = fresh();
  law.update(point, ft * (1. - 1e-12) / kn, 0.);
  EXPECT_EQ(point.state, JointState::intact);
  EXPECT_NEAR(point.normal_traction, ft, 1e-9 * ft);
  law.update(point, ft * (1. + 1e-12) / kn, 0.);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(point.normal_traction, 0.);
}

TEST(CoulombLaw, TensionBeyondTheApexOfTheConeLeavesNoShear)
{
  // Where cohesion - sigma mu is negative no shear may remain.
  CoulombLaw law = brittle();
  law.peak       = { 0.1e6, 1., ft };
  law.residual   = law.peak;
  JointPoint<2> point{ 0., 0., 0., 0., JointState::slipped };
  law.update(point, 0.5 * ft / kn, 0.3e6 / ks);
  EXPECT_EQ(point.state, JointState::slipping);
  EXPECT_DOUBLE_EQ(point.normal_traction, 0.5 * ft);
  EXPECT_NEAR(point.shear_traction, 0., 1e-9 * ft);
}

TEST(CoulombLaw, ResidualTensionIsAPlateau)
{
  CoulombLaw law       = brittle();
  law.residual.tension = 0.25 * ft;
  JointPoint<2> point  = fresh();
  law.update(point, 1.1 * ft / kn, 0.);
  EXPECT_EQ(point.state, JointState::open);
  for (const double factor : { 2., 50., 3. })
  {
    law.update(point, factor * ft / kn, 1e-3 * factor);
    EXPECT_DOUBLE_EQ(point.normal_traction, 0.25 * ft);
    EXPECT_EQ(point.shear_traction, 0.);
    EXPECT_EQ(point.state, JointState::open);
    // What comes back on closing: the area below the plateau and the slope.
    const double yield = 0.25 * ft / kn, opening = factor * ft / kn;
    EXPECT_NEAR(law.stored_energy(point, opening),
                0.25 * ft * (opening - yield) + 0.5 * 0.25 * ft * yield,
                1e-12 * ft * opening);
  }
  law.update(point, 0.1 * ft / kn, 3e-3);
  EXPECT_DOUBLE_EQ(point.normal_traction, 0.1 * ft);
  EXPECT_EQ(point.state, JointState::slipped);
}

TEST(CoulombLaw, ClosesAtZeroGapAndTakesUpShearAfresh)
{
  const CoulombLaw law = brittle();
  JointPoint<2> point  = fresh();
  law.update(point, 1e-4, 0.05e6 / ks);
  law.update(point, 2e-4, 5e-3);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(point.normal_traction, 0.);

  law.update(point, 1e-12, 5e-3);
  EXPECT_EQ(point.state, JointState::open);
  law.update(point, 0., 5e-3);
  EXPECT_EQ(point.state, JointState::slipped);
  EXPECT_EQ(point.shear_traction, 0.);

  const double opening = -1e6 / kn, slip = 5e-3 + 0.3e6 / ks;
  law.update(point, opening, slip);
  EXPECT_EQ(point.state, JointState::slipped);
  EXPECT_DOUBLE_EQ(point.normal_traction, kn * opening);
  EXPECT_NEAR(point.shear_traction, 0.3e6, 1e-3);
}

TEST(CoulombLaw, DilationIsSolvedWithTheNormalTraction)
{
  CoulombLaw law           = brittle();
  law.dilation             = 0.3;
  law.residual             = { 0.2e6, 0.6, 0. };
  const double opening     = -0.5e6 / kn;
  double previous_traction = -0.5e6, previous_opening = 0.;
  JointPoint<2> point = fresh();
  for (const double slip : { 1e-3, 1.2e-3, 1.9e-3, 5e-3 })
  {
    const double slip_before = point.plastic_slip;
    law.update(point, opening, slip);
    EXPECT_EQ(point.state, JointState::slipping);
    EXPECT_NEAR(point.shear_traction, 0.2e6 - point.normal_traction * 0.6,
                1e-9 * point.shear_traction);
    EXPECT_NEAR(point.shear_traction, ks * (slip - point.plastic_slip),
                1e-9 * point.shear_traction);
    EXPECT_NEAR(point.normal_traction, kn * (opening - point.plastic_opening),
                1e-9 * point.shear_traction);
    EXPECT_NEAR(point.plastic_opening - previous_opening,
                0.3 * (point.plastic_slip - slip_before), 1e-15);
    // Held apart, the joint is pressed together ever more.
    EXPECT_LT(point.normal_traction, previous_traction);
    previous_traction = point.normal_traction;
    previous_opening  = point.plastic_opening;
  }
}

TEST(CoulombLaw, DilationInEitherSense)
{
  CoulombLaw law      = brittle();
  law.dilation        = 0.3;
  JointPoint<2> forth = fresh(), back = fresh();
  law.update(forth, -1e-4, 2e-3);
  law.update(back, -1e-4, -2e-3);
  EXPECT_GT(forth.plastic_opening, 0.);
  EXPECT_DOUBLE_EQ(forth.plastic_opening, back.plastic_opening);
  EXPECT_DOUBLE_EQ(forth.shear_traction, -back.shear_traction);
}

TEST(CoulombLaw, DilationStopsAtTheCriticalShearDisplacement)
{
  CoulombLaw law                  = brittle();
  law.dilation                    = 0.3;
  law.critical_shear_displacement = 2e-3;
  JointPoint<2> point             = fresh();
  law.update(point, -1e-4, 1.5e-3);
  const double below = point.plastic_opening;
  EXPECT_GT(below, 0.);
  law.update(point, -1e-4, 1.9e-3);
  const double last = point.plastic_opening;
  EXPECT_GT(last, below);
  for (const double slip : { 2.0e-3, 2.5e-3, 9e-3 })
  {
    const double slip_before = point.plastic_slip;
    law.update(point, -1e-4, slip);
    EXPECT_GT(point.plastic_slip, slip_before);
    EXPECT_EQ(point.plastic_opening, last);
  }
}

TEST(CoulombLaw, DilationDecreasesOnReturn)
{
  CoulombLaw law = brittle();
  law.dilation   = 0.2;
  // Softer than the shear stiffness, so that the way back stays solvable.
  law.normal_stiffness = 1e9;
  JointPoint<2> point  = fresh();
  law.update(point, -1e-3, 4e-3);
  const double top = point.plastic_opening;
  EXPECT_NEAR(top, 0.2 * point.plastic_slip, 1e-15);

  law.update(point, -1e-3, 1e-3);
  EXPECT_EQ(point.state, JointState::slipping);
  EXPECT_LT(point.shear_traction, 0.);
  EXPECT_LT(point.plastic_opening, top);
  EXPECT_NEAR(point.plastic_opening, 0.2 * point.plastic_slip, 1e-15);
  EXPECT_NEAR(-point.shear_traction, -point.normal_traction * mu,
              -1e-9 * point.shear_traction);
}

TEST(CoulombLaw, NoTensionKeepsCohesion)
{
  CoulombLaw law      = brittle();
  law.peak.tension    = 0.;
  law.residual        = law.peak;
  JointPoint<2> point = fresh();
  law.update(point, 1e-3, 2e-3);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(point.normal_traction, 0.);

  const double sigma = -0.1e6, limit = cohesion - sigma * mu;
  law.update(point, sigma / kn, 2e-3 + 0.99 * limit / ks);
  EXPECT_EQ(point.state, JointState::slipped);
  EXPECT_NEAR(point.shear_traction, 0.99 * limit, 1e-9 * limit);
  law.update(point, sigma / kn, 2e-3 + 1.5 * limit / ks);
  EXPECT_EQ(point.state, JointState::slipping);
  EXPECT_NEAR(point.shear_traction, limit, 1e-9 * limit);
}

TEST(CoulombLaw, ElasticNeverFails)
{
  CoulombLaw law;
  law.normal_stiffness = kn;
  law.shear_stiffness  = ks;
  JointPoint<2> point  = fresh();
  for (const double size : { 1., -1., 1e6 })
  {
    const auto lost = law.update(point, size, -2. * size);
    EXPECT_EQ(point.normal_traction, kn * size);
    EXPECT_EQ(point.shear_traction, -2. * ks * size);
    EXPECT_EQ(point.state, JointState::intact);
    EXPECT_EQ(lost.friction + lost.fracture, 0.);
  }
}

TEST(CoulombLaw, WorkOnClosedPathsIsStoredOrDissipated)
{
  // Slips and sticks, in either sense, at a normal traction that changes,
  // also while the joint is intact. All combinations of dilation and residual
  // strength; the law starts with a traction at zero opening.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (const double dilation : { 0., 0.25 })
    for (const double residual_cohesion : { 0., 0.3e6 })
    {
      CoulombLaw law                  = brittle();
      law.residual.cohesion           = residual_cohesion;
      law.dilation                    = dilation;
      law.critical_shear_displacement = 5e-3;
      JointPoint<2> point
          = { -0.7e6, 0.2e6, -0.2e6 / ks, 0.7e6 / kn, JointState::intact };
      Ledger ledger;
      const double stored  = law.stored_energy(point, 0.);
      unsigned int n_slips = 0, n_sticks = 0;
      for (unsigned int i = 0; i < 20000; ++i)
      {
        const double slip = 4e-3 * std::sin(2e-3 * i) + 2e-4 * uniform(random);
        const double opening
            = point.plastic_opening - (1.1 + uniform(random)) * 2e-4;
        ledger.move(law, point, opening, slip);
        ASSERT_NE(point.state, JointState::open);
        n_slips += point.state == JointState::slipping;
        n_sticks += point.state == JointState::slipped;
      }
      EXPECT_GT(n_slips, 1000U);
      EXPECT_GT(n_sticks, 1000U);
      EXPECT_EQ(ledger.fracture, 0.);
      EXPECT_GT(ledger.friction, 0.);
      const double change = law.stored_energy(point, ledger.opening) - stored;
      EXPECT_NEAR(ledger.work - change - ledger.friction, 0.,
                  1e-12 * ledger.turnover);
    }
}

TEST(CoulombLaw, SlipWithoutDilationNeverGainsEnergy)
{
  // Steps small against the elastic slip at the limit: only then does the
  // shear traction at both ends of a step point the same way.
  const CoulombLaw law = brittle();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  JointPoint<2> point = fresh();
  Ledger ledger;
  double slip = 0.;
  for (unsigned int i = 0; i < 20000; ++i)
  {
    slip += 0.4e6 / ks * (uniform(random) + 0.5 * std::sin(0.01 * i));
    const double sigma = -0.9e6 + 0.05e6 * uniform(random);
    const auto lost    = ledger.move(law, point, sigma / kn, slip);
    EXPECT_GE(lost.friction, 0.);
    EXPECT_EQ(lost.fracture, 0.);
  }
  EXPECT_GT(ledger.friction, 1e3 * ft * ft / kn);
}

TEST(CoulombLaw, BreakingInTensionTakesItsStoredEnergy)
{
  const CoulombLaw law  = brittle();
  const double energy   = ft * ft / (2. * kn);
  double previous_error = 1.;
  for (const unsigned int n : { 10, 100, 1000, 10000 })
  {
    // In steps that never meet the strength exactly.
    JointPoint<2> point = fresh();
    Ledger ledger;
    for (unsigned int i = 1; i <= 2 * n; ++i)
      ledger.move(law, point, (i - 0.5) / n * ft / kn, 0.);
    EXPECT_EQ(point.state, JointState::open);
    EXPECT_EQ(ledger.friction, 0.);
    EXPECT_NEAR(ledger.work, ledger.fracture, 1e-12 * energy);
    const double error = std::abs(ledger.fracture / energy - 1.);
    EXPECT_LT(error, 2. / n);
    EXPECT_LT(error, previous_error);
    previous_error = error;
  }
}

TEST(CoulombLaw, BreakingInTensionUnderShearTakesBothEnergies)
{
  CoulombLaw law       = brittle();
  law.residual.tension = 0.2 * ft;
  const double shear   = 0.5 * cohesion;
  JointPoint<2> point  = fresh();
  Ledger ledger;
  ledger.move(law, point, 0., shear / ks);
  const unsigned int n = 1000;
  for (unsigned int i = 1; i <= 2 * n; ++i)
    ledger.move(law, point, (i - 0.5) / n * ft / kn, shear / ks);
  EXPECT_EQ(point.state, JointState::open);

  // The triangle above the plateau, and the shear energy.
  const double expected
      = (ft * ft - 0.2 * ft * (2. * ft - 0.2 * ft)) / (2. * kn)
        + shear * shear / (2. * ks);
  EXPECT_NEAR(ledger.fracture, expected, 3e-3 * expected);
  EXPECT_EQ(ledger.friction, 0.);
  EXPECT_NEAR(ledger.work - law.stored_energy(point, ledger.opening)
                  - ledger.fracture,
              0., 1e-12 * ledger.turnover);
}

TEST(CoulombLaw, OpeningAfterSlipTakesTheShearEnergy)
{
  const CoulombLaw law = brittle();
  JointPoint<2> point  = failed(law);
  const double slip    = 2e6 / ks;
  const double stored  = law.stored_energy(point, -1e6 / kn);
  Ledger ledger;
  ledger.opening     = -1e6 / kn;
  ledger.slip        = slip;
  const double shear = point.shear_traction;
  EXPECT_NEAR(shear, 1e6 * mu, 1e-3);
  for (unsigned int i = 1; i <= 1001; ++i)
    ledger.move(law, point, (i - 1000.) / 1000. * 1e6 / kn, slip);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(ledger.fracture, 0.);
  EXPECT_NEAR(ledger.work - (0. - stored) - ledger.friction, 0., 1e-3 * stored);
  EXPECT_NEAR(ledger.friction, 0.5 * shear * shear / ks, 1e-2 * stored);
}
