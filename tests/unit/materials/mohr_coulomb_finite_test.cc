// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "yielding_sample.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

// Mohr-Coulomb at strains of order one: closed forms of shear and compression,
// rotation, energy, and what comes before and after.

using namespace quoin;

namespace
{
  using Tensor = YieldingSample::Tensor;

  constexpr double degree   = 0.017453292519943295;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr LinearElastic soil{ 2000., 100e6, 0.3 };
  constexpr double cohesion = 0.1e6;
  const double shear = plane_stiffness(soil, PlaneAssumption::plane_strain).c33;
  constexpr PlaneAssumption both_assumptions[]
      = { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress };

  const MohrCoulombStrength clay{ cohesion, 0., 0., infinity };
  const MohrCoulombStrength sand{ cohesion, 30. * degree, 0., infinity };
  const MohrCoulombStrength cut{ cohesion, 30. * degree, 0., 0.05e6 };
  const MohrCoulombStrength dilatant{ cohesion, 30. * degree, 10. * degree,
                                      infinity };

  double number(const double angle)
  {
    return (1. + std::sin(angle)) / (1. - std::sin(angle));
  }

  double cube(const MohrCoulombStrength &strength)
  {
    return 2. * strength.cohesion * std::sqrt(number(strength.friction_angle));
  }

  YieldingSample sample_of(const MohrCoulombStrength &strength,
                           const PlaneAssumption plane
                           = PlaneAssumption::plane_strain)
  {
    return { MohrCoulomb(soil, strength, plane) };
  }

  double excess(const YieldingSample &sample)
  {
    const auto f = sample.law.yield_functions(sample.stress());
    return std::max(f.shear, f.tension);
  }

  /** F R(angle) from the left, less I. */
  Tensor turned(const Tensor &H, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const double F[4] = { 1. + H[0], H[1], H[2], 1. + H[3] };
    return { c * F[0] - s * F[2] - 1., c * F[1] - s * F[3], s * F[0] + c * F[2],
             s * F[1] + c * F[3] - 1. };
  }

  /** A path of shear, stretch and rotation up to strains of one half. */
  Tensor winding(const double t)
  {
    return turned({ 0.4 * std::sin(2. * t), 0.5 * t * t, -0.1 * t,
                    -0.3 * std::sin(2. * t) },
                  0.8 * t);
  }

  /** Presses along y to F_yy = @p height while xx is free. */
  void compress(YieldingSample &sample, const double height, const int n_steps,
                const std::function<void(double)> &look)
  {
    double width = 1.;
    for (int step = 1; step <= n_steps; ++step)
    {
      const double y  = std::pow(height, double(step) / n_steps);
      const auto held = sample;
      double slope = soil.young, last = 0., last_width = 0.;
      for (int round = 0; round < 60; ++round)
      {
        sample = held;
        sample.deform({ width - 1., 0., 0., y - 1. });
        const double off = sample.piola[0];
        if (std::abs(off) < 1e-12 * cohesion)
          break;
        if (round > 0 && width != last_width)
          slope = std::max((off - last) / (width - last_width),
                           1e-4 * soil.young);
        last       = off;
        last_width = width;
        width -= off / slope;
      }
      EXPECT_NEAR(sample.piola[0], 0., 1e-9 * cohesion);
      look(y);
    }
  }
} // namespace

// Simple shear to 200 %: the top's area stays, and so does the force on it, c
// for clay. The principal axes of a stress in steady flow are those of the
// rate of strain to c / G.
TEST(MohrCoulombFinite, SimpleShear)
{
  for (const auto plane : both_assumptions)
    for (const auto &strength : { clay, sand, cut })
    {
      YieldingSample sample = sample_of(strength, plane);
      double lost           = 0.;
      constexpr int n_steps = 2000;
      for (int step = 1; step <= n_steps; ++step)
      {
        const double slip = 2. * step / n_steps;
        lost += sample.deform({ 0., slip, 0., 0. });
        ASSERT_LE(excess(sample), 1e-10 * cohesion);
        if (strength.friction_angle > 0. || step < 20)
          continue;
        ASSERT_GE(excess(sample), -1e-10 * cohesion);
        if (plane == PlaneAssumption::plane_strain)
        {
          ASSERT_NEAR(sample.piola[1], cohesion, 1e-5 * cohesion);
          ASSERT_NEAR(sample.stress()[0] - sample.stress()[1], 0.,
                      3. * cohesion / shear * cohesion);
          // Elastic work in the first steps is cohesion / shear of slip.
          ASSERT_NEAR(lost, cohesion * (slip - cohesion / shear),
                      1e-4 * cohesion);
        }
      }
      EXPECT_GT(lost, 0.);
    }
}

// Compression to half the height in plane strain: the stress is q, the force q
// by the present width, which grows by N_psi times the shortening, logarithms,
// with the elastic strain q / E by and by for the volume.
TEST(MohrCoulombFinite, Compression)
{
  for (const auto &strength : { clay, sand, dilatant })
  {
    YieldingSample sample = sample_of(strength);
    const double q        = cube(strength);
    compress(sample, 0.5, 200,
             [&](const double height)
             {
               const double width = 1. + sample.gradient[0];
               ASSERT_LE(excess(sample), 1e-10 * q);
               if (height > 0.99)
                 return;
               EXPECT_NEAR(sample.stress()[1], -q, 1e-9 * q);
               EXPECT_NEAR(sample.piola[3], -q * width, 1e-9 * q);
               const double dilated
                   = std::pow(height, -number(strength.dilation_angle));
               EXPECT_NEAR(width / dilated, 1., 2. * q / soil.young);
             });
    // Without friction the elastic volume is constant in flow, hence exact.
    if (strength.friction_angle == 0.)
    {
      YieldingSample again = sample_of(strength);
      double volume        = 0.;
      compress(again, 0.5, 100,
               [&](const double height)
               {
                 if (height > 0.98)
                   return;
                 const double now = height * (1. + again.gradient[0]);
                 volume           = volume == 0. ? now : volume;
                 EXPECT_NEAR(now, volume, 1e-10);
               });
    }
  }
}

// A free cube in plane stress: the force is q by the present area, its width by
// its thickness, whose product is known from the volume.
TEST(MohrCoulombFinite, CompressionOfAFreeCube)
{
  YieldingSample sample = sample_of(clay, PlaneAssumption::plane_stress);
  const double q        = cube(clay);
  compress(sample, 0.5, 200,
           [&](const double height)
           {
             if (height > 0.99)
               return;
             EXPECT_NEAR(sample.stress()[1], -q, 1e-9 * q);
             EXPECT_NEAR(sample.piola[3], -q / height, 2. * q / soil.young * q);
           });
}

TEST(MohrCoulombFinite, TurnsWithTheBody)
{
  for (const auto plane : both_assumptions)
    for (const auto &strength : { clay, sand, cut })
    {
      YieldingSample here  = sample_of(strength, plane);
      here.initial         = { -3e4, -8e4, 2e4,
                       plane == PlaneAssumption::plane_stress ? 0. : -5e4 };
      YieldingSample there = here;
      double lost = 0., scale = 0.;
      for (int step = 0; step <= 400; ++step)
      {
        const double t = step / 400.;
        const double a = here.deform(winding(t));
        const double b = there.deform(turned(winding(t), 5. * t));
        scale += std::abs(a);
        lost += b - a;
        const auto expected = here.stress();
        const double c = std::cos(10. * t), s = std::sin(10. * t);
        const double mean = 0.5 * (expected[0] + expected[1]);
        const double half = 0.5 * (expected[0] - expected[1]);
        const auto stress = there.stress();
        ASSERT_NEAR(stress[0], mean + half * c - expected[2] * s,
                    1e-9 * cohesion);
        ASSERT_NEAR(stress[1], mean - half * c + expected[2] * s,
                    1e-9 * cohesion);
        ASSERT_NEAR(stress[2], half * s + expected[2] * c, 1e-9 * cohesion);
        ASSERT_NEAR(stress[3], expected[3], 1e-9 * cohesion);
        ASSERT_LE(excess(here), 1e-10 * cohesion);
      }
      EXPECT_GT(here.point.plastic_shear, 0.1);
      EXPECT_NEAR(lost, 0., 1e-9 * scale);
    }
}

// Along a path that turns, the balance of trapezoidal work closes with the
// square of the step.
TEST(MohrCoulombFinite, WorkIsStoredOrDissipated)
{
  for (const auto plane : both_assumptions)
    for (const auto &strength : { clay, sand, cut })
    {
      std::vector<double> residuals;
      for (const int n_steps : { 1000, 4000 })
      {
        YieldingSample sample = sample_of(strength, plane);
        sample.initial        = { -3e4, -8e4, 2e4,
                           plane == PlaneAssumption::plane_stress ? 0. : -5e4 };
        sample.point.stress   = sample.initial;
        sample.deform({});
        const double start = sample.law.stored_energy(sample.point.stress);
        double work = 0., lost = 0.;
        for (int step = 1; step <= n_steps; ++step)
        {
          const auto old = sample;
          lost += sample.deform(winding(1. * step / n_steps));
          for (int k = 0; k < 4; ++k)
            work += 0.5 * (old.piola[k] + sample.piola[k])
                    * (sample.gradient[k] - old.gradient[k]);
        }
        const double stored
            = sample.law.stored_energy(sample.point.stress) - start;
        EXPECT_GT(lost, 0.1 * cohesion);
        residuals.push_back(std::abs(work - stored - lost) / lost);
      }
      EXPECT_LT(residuals[0], 1e-4);
      EXPECT_LT(residuals[1], 0.1 * residuals[0] + 1e-9);
    }
}

// The tangent is that of the elastic part at constant plastic stretch.
TEST(MohrCoulombFinite, TangentIsTheDerivative)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1., 1.);
  constexpr double h = 1e-7;
  for (const auto plane : both_assumptions)
    for (const auto &strength : { clay, sand, cut })
    {
      int n_checked = 0, n_plastic = 0;
      for (int i = 0; i < 300; ++i)
      {
        YieldingSample sample = sample_of(strength, plane);
        for (int step = 1; step <= 50; ++step)
          sample.deform(winding(0.02 * step));
        PlaneTensor e = sample.elastic().e;
        for (double &component : e)
          component += 1e-2 * any(random);
        const auto K = sample.law.tangent(sample.point, e);
        double worst = 0., kink = 0.;
        for (int j = 0; j < 3; ++j)
        {
          const auto stress = [&](const double step)
          {
            PlaneTensor at = e;
            at[j] += j == 2 ? 0.5 * step : step; // of 2 xy
            PlasticPoint point = sample.point;
            return sample.law.update(point, at).stress;
          };
          const auto a = stress(h), b = stress(-h), middle = stress(0.);
          for (int k = 0; k < 3; ++k)
          {
            const double left  = (middle[k] - b[k]) / h;
            const double right = (a[k] - middle[k]) / h;
            kink  = std::max(kink, std::abs(left - right) / soil.young);
            worst = std::max(worst, std::abs(0.5 * (left + right) - K[k][j])
                                        / soil.young);
          }
        }
        if (kink > 1e-3) // on a border of regions
          continue;
        ++n_checked;
        n_plastic += K[2][2] != shear;
        EXPECT_LT(worst, 1e-6);
      }
      EXPECT_GT(n_checked, 290);
      EXPECT_GT(n_plastic, 200);
    }
}

// Nothing jumps where a cell under initial stress yields for the first time.
TEST(MohrCoulombFinite, BeginsToYieldContinuously)
{
  for (const auto plane : both_assumptions)
  {
    YieldingSample sample = sample_of(sand, plane);
    sample.initial        = { -3e4, -8e4, 2e4,
                       plane == PlaneAssumption::plane_stress ? 0. : -5e4 };
    const auto at         = [&](const double size)
    {
      YieldingSample now = sample;
      now.deform({ 2e-3 * size, 5e-3 * size, 1e-3 * size, -3e-3 * size });
      return now;
    };
    double below = 0., above = 1.;
    ASSERT_EQ(at(below).point.state, 0);
    ASSERT_NE(at(above).point.state, 0);
    while (above - below > 1e-13)
      (at(0.5 * (below + above)).point.state == 0 ? below : above)
          = 0.5 * (below + above);
    const auto a = at(below), b = at(above);
    ASSERT_NE(a.point.state, b.point.state);
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_NEAR(a.piola[k], b.piola[k], 1e-7 * cohesion);
      EXPECT_NEAR(a.stress()[k], b.stress()[k], 1e-7 * cohesion);
    }
    // By Biot's stress of another stretch: to the size of the elastic strain.
    EXPECT_NEAR(sample.law.stored_energy(a.point.stress)
                    / sample.law.stored_energy(b.point.stress),
                1., 2e-3);
  }
}

// A point on the yield surface does not flow again where it is.
TEST(MohrCoulombFinite, StaysWhereItIs)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1., 1.);
  for (const auto plane : both_assumptions)
    for (const auto &strength : { clay, sand, cut })
      for (int i = 0; i < 200; ++i)
      {
        YieldingSample sample = sample_of(strength, plane);
        Tensor H;
        for (double &component : H)
          component = 0.01 * any(random);
        sample.deform(H);
        const auto once = sample;
        sample.deform(turned(H, 2.));
        EXPECT_NEAR(sample.point.plastic_shear, once.point.plastic_shear,
                    1e-14);
        for (int k = 0; k < 4; ++k)
          EXPECT_NEAR(sample.point.inverse_stretch[k],
                      once.point.inverse_stretch[k], 1e-14);
      }
}

TEST(MohrCoulombFinite, AnotherLawTakesOverTheStress)
{
  for (const auto plane : both_assumptions)
  {
    YieldingSample sample = sample_of(sand, plane);
    for (int step = 1; step <= 50; ++step)
      sample.deform(winding(0.02 * step));
    const auto wanted = sample.stress();
    const MohrCoulomb firm({ 2000., 300e6, 0.1 }, sand, plane);
    firm.take_over(sample.point, sample.elastic().e, sample.law);
    sample.law        = firm;
    const auto stress = sample.stress();
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(stress[k], wanted[k], 1e-9 * cohesion);
    sample.deform(sample.gradient);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(sample.stress()[k], wanted[k], 1e-9 * cohesion);
  }
}

// An inverted cell is elastic: finite forces that push it back.
TEST(MohrCoulombFinite, InvertedCellsDoNotFlow)
{
  YieldingSample sample = sample_of(clay);
  EXPECT_EQ(sample.deform({ 0., 0., 0., -1.2 }), 0.);
  EXPECT_EQ(sample.point.state, 0);
  EXPECT_TRUE(std::isfinite(sample.piola[3]));
  EXPECT_LT(sample.piola[3], 0.);
}
