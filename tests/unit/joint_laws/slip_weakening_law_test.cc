// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"

#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/joint_laws/slip_weakening_law.h>

#include <cmath>

using namespace quoin;

namespace
{
  constexpr double kn = 10e9, ks = 5e9, critical = 2e-3;
  constexpr double sigma    = -1e6;
  constexpr double peak     = 0.5e6 + 0.7 * 1e6;
  constexpr double residual = 0.1e6 + 0.4 * 1e6;

  SlipWeakeningLaw fault()
  {
    SlipWeakeningLaw law;
    law.normal_stiffness  = kn;
    law.shear_stiffness   = ks;
    law.cohesion          = 0.5e6;
    law.residual_cohesion = 0.1e6;
    law.friction          = 0.7;
    law.residual_friction = 0.4;
    law.weakening_slip    = critical;
    return law;
  }

  /** Shear traction after the inelastic slip @p slipped under sigma. */
  double expected(const double slipped)
  {
    return residual + (peak - residual) * std::max(0., 1. - slipped / critical);
  }

  const std::string parameters = "set Law = slip weakening\n"
                                 "set Normal stiffness = 10e9\n"
                                 "set Shear stiffness = 5e9\n"
                                 "set Cohesion = 0.5e6\n"
                                 "set Friction angle = 35\n"
                                 "set Residual cohesion = 0.1e6\n"
                                 "set Residual friction angle = 20\n"
                                 "set Weakening slip = 2e-3\n";

  JointSetParameters read(const std::string &text)
  {
    return read_named_section<JointSetParameters>("bed", text);
  }

  void expect_refused(const std::string &text, const std::string &setting,
                      const std::string &why)
  {
    expect_section_refused("bed", setting + " = ", why,
                           [&] { read(parameters + text); });
  }
} // namespace

TEST(SlipWeakeningLaw, FallsInProportionToSlipWhateverTheStep)
{
  const SlipWeakeningLaw law = fault();
  for (const double sense : { 1., -1. })
    for (const unsigned int n : { 3U, 17U, 1000U })
    {
      SlipWeakeningPoint<2> point;
      double friction = 0., fracture = 0.;
      for (unsigned int i = 1; i <= n; ++i)
      {
        const double slip = 3e-3 * i / n;
        const auto lost   = law.update(point, sigma / kn, sense * slip);
        friction += lost.friction;
        fracture += lost.fracture;
        const double tau = sense * point.shear_traction;
        EXPECT_DOUBLE_EQ(point.normal_traction, sigma);
        if (ks * slip <= peak)
          EXPECT_NEAR(tau, ks * slip, 1e-9 * peak);
        else
          EXPECT_NEAR(tau, expected(slip - tau / ks), 1e-9 * peak);
      }
      EXPECT_EQ(point.state, JointState::slipping);
      if (n < 1000) // steps across a kink take its corner off
        continue;
      const double slid = 3e-3 - residual / ks;
      EXPECT_NEAR(fracture, 0.5 * (peak - residual) * critical,
                  1e-3 * fracture);
      EXPECT_NEAR(friction, residual * slid, 1e-3 * friction);
    }
}

TEST(SlipWeakeningLaw, DoesNotHealAndWeakensInBothSenses)
{
  const SlipWeakeningLaw law = fault();
  SlipWeakeningPoint<2> point;
  const auto slide_to = [&](const double slip)
  {
    const double start = 4e-6 * std::round(point.plastic_slip / 4e-6);
    for (unsigned int i = 0; i <= 1000; ++i)
      law.update(point, sigma / kn, start + (slip - start) * i / 1000.);
  };
  slide_to(1e-3);
  const double first = point.slipped;
  EXPECT_NEAR(point.shear_traction, expected(first), 1e-9 * peak);
  slide_to(0.);
  EXPECT_GT(point.slipped, first);
  EXPECT_NEAR(point.shear_traction, -expected(point.slipped), 1e-9 * peak);
  EXPECT_DOUBLE_EQ(law.strength(sigma, point.slipped), expected(point.slipped));
  // At rest it holds what it bears, under more pressure too, not under less.
  EXPECT_TRUE(law.holds(point));
  point.normal_traction *= 1.01;
  EXPECT_TRUE(law.holds(point));
  point.normal_traction *= 0.98;
  EXPECT_FALSE(law.holds(point));
}

TEST(SlipWeakeningLaw, OpenJointsBearNothingAndCloseWhereTheyParted)
{
  const SlipWeakeningLaw law = fault();
  SlipWeakeningPoint<2> point;
  const double slip = 0.5 * peak / ks;
  law.update(point, sigma / kn, slip);
  const double stored = 0.5 * std::pow(0.5 * peak, 2) / ks;
  EXPECT_DOUBLE_EQ(law.stored_energy(point), stored + 0.5 * sigma * sigma / kn);
  const auto lost = law.update(point, 1e-6, slip);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_EQ(point.shear_traction, 0.);
  EXPECT_DOUBLE_EQ(lost.friction, stored);
  EXPECT_EQ(law.stored_energy(point), 0.);
  law.update(point, sigma / kn, slip + 1e-5);
  EXPECT_EQ(point.state, JointState::slipped);
  EXPECT_DOUBLE_EQ(point.normal_traction, sigma);
  EXPECT_NEAR(point.shear_traction, ks * 1e-5, 1e-9 * peak);
  EXPECT_EQ(point.slipped, 0.);
}

TEST(SlipWeakeningLaw, ShearOfCohesionWaitsWhereAJointOpens)
{
  // After 0.5 mm of slip the cohesion is 0.4 MPa.
  const SlipWeakeningLaw law = fault();
  SlipWeakeningPoint<2> start;
  law.update(start, sigma / kn, 5e-4 + expected(5e-4) / ks);
  ASSERT_NEAR(start.slipped, 5e-4, 1e-9);
  const double origin = start.plastic_slip;
  JointTangent<2> tangent;
  auto at = [&](const double opening, const double shear, const JointLoss loss)
  {
    SlipWeakeningPoint<2> point = start;
    law.update_waiting(point, opening, origin + shear / ks, loss, tangent);
    return point;
  };
  auto point = at(1e-5, 0.3e6, JointLoss::nothing);
  EXPECT_EQ(point.state, JointState::open);
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_NEAR(point.shear_traction, 0.3e6, 1.);
  EXPECT_NEAR(law.excess(point), 0.6, 1e-5);
  EXPECT_EQ(tangent.normal_opening, 0.);
  EXPECT_EQ(tangent.shear_slip, ks);
  // Beyond that it slips: 0.6 MPa less ks dp are 0.4 MPa less 0.2 GPa/m dp.
  point = at(1e-5, 0.6e6, JointLoss::nothing);
  EXPECT_NEAR(point.slipped - start.slipped, 0.2e6 / (ks - 0.2e9), 1e-9);
  EXPECT_NEAR(point.shear_traction, 0.6e6 - 0.2e6 * ks / (ks - 0.2e9), 1.);
  EXPECT_EQ(tangent.shear_opening, 0.);
  // Without it there is none, nor where it touches without pressure.
  point = at(1e-5, 0.3e6, JointLoss::cohesion);
  EXPECT_EQ(point.shear_traction, 0.);
  EXPECT_EQ(law.excess(point), 0.);
  start = point;
  EXPECT_NEAR(at(-1e-12, 0.3e6, JointLoss::nothing).shear_traction, 0., 0.01);
}

TEST(SlipWeakeningLaw, DropsAtOnceIfItWeakensFasterThanItUnloads)
{
  SlipWeakeningLaw law = fault();
  law.weakening_slip   = 0.9 * (peak - residual) / ks;
  SlipWeakeningPoint<2> point;
  law.update(point, sigma / kn, 0.999 * peak / ks);
  EXPECT_EQ(point.state, JointState::intact);
  law.update(point, sigma / kn, 1.001 * peak / ks);
  EXPECT_NEAR(point.shear_traction, residual, 1e-9 * peak);
  EXPECT_EQ(law.warning(), ""); // without any pressure it loses less
  law.weakening_slip = 0.7e-4;
  EXPECT_NE(law.warning().find("5.714e+09 Pa/m"), std::string::npos)
      << law.warning();
}

TEST(SlipWeakeningLaw, InitialTractionsRest)
{
  const SlipWeakeningLaw law = fault();
  SlipWeakeningPoint<2> point;
  law.initialise(point, sigma, 0.3e6);
  EXPECT_TRUE(law.holds(point));
  law.update(point, 0., 0.);
  EXPECT_DOUBLE_EQ(point.normal_traction, sigma);
  EXPECT_DOUBLE_EQ(point.shear_traction, 0.3e6);
  law.initialise(point, 1e5, 0.3e6); // tension is dropped
  EXPECT_EQ(point.normal_traction, 0.);
  EXPECT_EQ(point.shear_traction, 0.);
  law.wear_out(point);
  law.update(point, sigma / kn, 1e-2);
  EXPECT_NEAR(point.shear_traction, residual, 1e-9 * residual);
}

TEST(SlipWeakeningLaw, Parameters)
{
  const JointSetParameters set = read(parameters);
  const auto &law              = std::get<SlipWeakeningLaw>(set.law);
  EXPECT_EQ(law.normal_stiffness, 10e9);
  EXPECT_EQ(law.shear_stiffness, 5e9);
  EXPECT_EQ(law.cohesion, 0.5e6);
  EXPECT_EQ(law.residual_cohesion, 0.1e6);
  EXPECT_NEAR(law.friction, 0.70021, 1e-5);
  EXPECT_NEAR(law.residual_friction, 0.36397, 1e-5);
  EXPECT_EQ(law.weakening_slip, 2e-3);
  EXPECT_EQ(law_text(set.law),
            "slip weakening, friction angle from 35 degrees down to 20 "
            "degrees, cohesion from 5e+05 Pa down to 1e+05 Pa over 0.002 m");

  const auto weak = std::get<SlipWeakeningLaw>(reduced(set.law, 2.));
  EXPECT_DOUBLE_EQ(weak.strength(sigma, 0.), 0.5 * law.strength(sigma, 0.));
  EXPECT_DOUBLE_EQ(weak.strength(sigma, 1.), 0.5 * law.strength(sigma, 1.));

  expect_refused("set Weakening slip = 0\n", "Weakening slip", "positive");
  expect_refused("set Residual cohesion = 1e6\n", "Residual cohesion",
                 "exceed 'Cohesion'");
  expect_refused("set Residual friction angle = 40\n",
                 "Residual friction angle", "'Friction angle'");
  expect_refused("set Tensile strength = 1e5\n", "Tensile strength",
                 "no tension");
  expect_refused("set Dilation angle = 5\n", "Dilation angle",
                 "does not dilate");
  expect_refused("set Critical shear displacement = 5\n",
                 "Critical shear displacement", "no effect");
}
