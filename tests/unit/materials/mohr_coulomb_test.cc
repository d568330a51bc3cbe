// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "yielding_sample.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace quoin;

namespace
{
  using Strain = std::array<double, 3>;
  using Stress = std::array<double, 4>;

  constexpr double degree   = 0.017453292519943295;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double cohesion = 2e6, phi = 35. * degree;
  constexpr LinearElastic rock{ 2500., 10e9, 0.25 };
  const double n_phi = (1. + std::sin(phi)) / (1. - std::sin(phi));
  const double cube  = 2. * cohesion * std::cos(phi) / (1. - std::sin(phi));

  MohrCoulomb law(const double psi, const double tension,
                  const PlaneAssumption assumption)
  {
    return MohrCoulomb(rock, { cohesion, phi, psi, tension }, assumption);
  }

  constexpr auto strain_plane = PlaneAssumption::plane_strain;
  constexpr auto stress_plane = PlaneAssumption::plane_stress;

  /**
   * Presses along y to @p shortening in steps while the stress along x is held
   * at @p side, by secants on the strain xx. Returns the sample.
   */
  YieldingSample compress(const MohrCoulomb &law, const double side,
                          const double shortening)
  {
    YieldingSample sample{ law };
    Strain e{};
    constexpr int n_steps = 200;
    for (int step = 0; step <= n_steps; ++step)
    {
      e[1]            = -shortening * step / n_steps;
      const auto held = sample;
      double slope = rock.young, last = 0., off = 0.;
      for (int iteration = 0; iteration < 50; ++iteration)
      {
        sample = held;
        sample.strain(e);
        off = side - sample.stress()[0];
        if (std::abs(off) < 1e-9 * cohesion)
          break;
        // On a plateau the elastic stiffness still leads out.
        if (iteration > 0 && last != off)
          slope = std::max(std::abs(slope * (last - off) / last),
                           1e-3 * rock.young);
        last = off;
        e[0] += off / slope;
      }
      EXPECT_NEAR(off, 0., 1e-8 * cohesion);
    }
    return sample;
  }
} // namespace

TEST(MohrCoulomb, CubeInPlaneStressBearsItsStrength)
{
  const auto sample
      = compress(law(10. * degree, 0.5e6, stress_plane), 0., 0.01);
  EXPECT_NEAR(sample.stress()[1], -cube, 1e-8 * cube);
  EXPECT_EQ(sample.stress()[3], 0.);
  EXPECT_EQ(sample.point.state & yielding::shear_now, yielding::shear_now);
}

TEST(MohrCoulomb, ConfinementLine)
{
  // sigma_3 = N sigma_1 - 2 c sqrt(N), with or without stress out of plane.
  for (const double side : { -20e6, -5e6, -1e6, 0. })
  {
    const auto sample     = compress(law(0., 0.5e6, strain_plane), side, 0.02);
    const auto stress     = sample.stress();
    const double strength = n_phi * side - cube;
    EXPECT_NEAR(stress[1], strength, 1e-7 * cube);
    EXPECT_LE(stress[3], side + 1.);
    EXPECT_GE(stress[3], strength - 1.);
    EXPECT_EQ(sample.point.state & yielding::shear_now, yielding::shear_now);
  }
}

TEST(MohrCoulomb, OutOfPlaneStressCanBeTheMajorOne)
{
  // Both in-plane stresses equal: edge sigma_2 = sigma_3.
  YieldingSample sample{ law(0., infinity, strain_plane),
                         { -10e6, -10e6, 0., 1.5e6 } };
  sample.strain({ -1e-5, -1e-5, 0. });
  const auto stress = sample.stress();
  EXPECT_GT(stress[3], stress[0]);
  EXPECT_NEAR(stress[0], stress[1], 1e-3);
  EXPECT_NEAR(sample.law.yield_functions(stress).shear, 0., 1e-12 * cube);
  EXPECT_GT(sample.point.plastic_shear, 0.);
}

TEST(MohrCoulomb, ElasticStateIsBitwiseLinearElasticity)
{
  for (const auto plane : { strain_plane, stress_plane })
  {
    const auto stiffness = plane_stiffness(rock, plane);
    const auto rock_law  = law(0., infinity, plane);
    PlasticPoint point;
    const Strain e{ -3e-5, 2e-5, 1e-5 };
    EXPECT_EQ(rock_law.update(point, e).dissipated, 0.);
    EXPECT_EQ(point.state, 0);
    EXPECT_DOUBLE_EQ(point.stress[0],
                     stiffness.c11 * e[0] + stiffness.c12 * e[1]);
    EXPECT_DOUBLE_EQ(point.stress[1],
                     stiffness.c12 * e[0] + stiffness.c11 * e[1]);
    EXPECT_DOUBLE_EQ(point.stress[2], 2. * stiffness.c33 * e[2]);
    EXPECT_NEAR(point.stress[3],
                stiffness.zz_over_sum * (point.stress[0] + point.stress[1]),
                1e-9);
    for (const double q : point.inverse_stretch)
      EXPECT_EQ(q, 0.);
  }
}

TEST(MohrCoulomb, TensionCutOff)
{
  constexpr double ft     = 0.3e6;
  const double free_shear = cube / n_phi;
  for (const auto plane : { strain_plane, stress_plane })
  {
    YieldingSample one{ law(10. * degree, ft, plane) }, two = one;
    one.strain({ 1e-4, -0.25e-4, 0. });
    EXPECT_NEAR(one.stress()[0], ft, 1e-12 * ft);
    EXPECT_LT(one.stress()[1], ft);
    EXPECT_EQ(one.point.state, yielding::tension_now);
    // Associated: the opening is along x alone.
    EXPECT_LT(one.point.inverse_stretch[0], -1e-5);
    EXPECT_NEAR(one.point.inverse_stretch[1], 0., 1e-18);
    EXPECT_NEAR(one.point.inverse_stretch[3], 0., 1e-18);

    two.strain({ 2e-4, 1e-4, 0. });
    EXPECT_NEAR(two.stress()[0], ft, 1e-12 * ft);
    EXPECT_NEAR(two.stress()[1], ft, 1e-12 * ft);
    EXPECT_NEAR(two.stress()[2], 0., 1e-9);
    EXPECT_EQ(two.point.state, yielding::tension_now);
  }

  // Without a cut-off a free body shears out of the plane in tension.
  YieldingSample uncut{ law(phi, infinity, stress_plane) };
  uncut.strain({ 1e-3, 0., 0. });
  EXPECT_NEAR(uncut.stress()[0], free_shear, 1e-12 * free_shear);
  EXPECT_EQ(uncut.point.state, yielding::shear_now);
  const double opened = std::log1p(uncut.point.inverse_stretch[0]);
  EXPECT_NEAR(std::log1p(uncut.point.inverse_stretch[3]), -opened / n_phi,
              1e-12 * std::abs(opened));
}

TEST(MohrCoulomb, ApexAndItsLimit)
{
  const double apex = cohesion / std::tan(phi);
  for (const double psi : { 0., phi })
  {
    const auto uncut = law(psi, infinity, strain_plane);
    EXPECT_NEAR(uncut.tensile_strength(), apex, 1e-12 * apex);
    EXPECT_EQ(law(psi, 10. * apex, strain_plane).tensile_strength(),
              uncut.tensile_strength());
    // All three principal stresses reach the limit.
    YieldingSample sample{ uncut };
    sample.strain({ 3e-3, 3.1e-3, 1e-4 });
    for (const int i : { 0, 1, 3 })
      EXPECT_NEAR(sample.stress()[i], apex, 1e-12 * apex);
    EXPECT_NEAR(sample.stress()[2], 0., 1e-9 * apex);
  }
}

TEST(MohrCoulomb, VertexOfShearAndTension)
{
  constexpr double ft = 0.4e6;
  YieldingSample sample{ law(5. * degree, ft, strain_plane) };
  sample.strain({ 2e-3, -2e-3, 0. });
  EXPECT_NEAR(sample.stress()[0], ft, 1e-12 * cube);
  EXPECT_NEAR(sample.stress()[1], n_phi * ft - cube, 1e-12 * cube);
  EXPECT_EQ(sample.point.state, yielding::shear_now | yielding::tension_now);
  sample.strain({ 1.99e-3, -1.99e-3, 0. });
  EXPECT_EQ(sample.point.state, yielding::shear_past | yielding::tension_past);
}

TEST(MohrCoulomb, FlowFollowsTheDilationAngle)
{
  // Volume over the difference of the principal strains is sin(psi) in plane
  // shear; out of the plane nothing flows while sigma_zz is in between.
  for (const double psi : { 0., 10. * degree, phi })
    for (const auto plane : { strain_plane, stress_plane })
    {
      YieldingSample sample{ law(psi, infinity, plane) };
      if (plane == strain_plane)
        sample.bear(rock, -5e6, -5e6, -12e6);
      const auto before = sample.logarithms();
      if (plane == strain_plane)
        sample.strain({ 4e-4, -22e-4, 15e-4 });
      else
        sample.strain({ 3e-4, -3e-4, 1e-5 });
      ASSERT_EQ(sample.point.state & 3, yielding::shear_now);
      const auto after = sample.logarithms();
      // The larger one is that of the side which flows less.
      const double slipped = after[0] - after[1];
      EXPECT_GT(slipped, 1e-5);
      double volume = 0.;
      for (int i = 0; i < 3; ++i)
        volume += before[i] - after[i];
      EXPECT_NEAR(volume, std::sin(psi) * slipped, 1e-11 * slipped);
      EXPECT_NEAR(after[2], before[2], 1e-11 * slipped);
      if (psi == 0.)
      {
        EXPECT_NEAR(sample.point.plastic_shear, 0.5 * slipped, 1e-11 * slipped);
      }
    }
  // At a free cube that is squeezed, too, out of the plane.
  for (const double psi : { 0., 10. * degree, phi })
  {
    YieldingSample sample{ law(psi, infinity, stress_plane) };
    const double n = (1. + std::sin(psi)) / (1. - std::sin(psi));
    sample.strain({ -1e-3, -22e-4, 0. });
    ASSERT_EQ(sample.point.state, yielding::shear_now);
    const auto flowed = sample.logarithms();
    EXPECT_NEAR(flowed[2], -n * (flowed[0] + flowed[1]), 1e-15);
  }
}

TEST(MohrCoulomb, TrescaWithoutFriction)
{
  for (const double ft : { infinity, 1e6 })
    for (const auto plane : { strain_plane, stress_plane })
    {
      const MohrCoulomb tresca(rock, { cohesion, 0., 0., ft }, plane);
      EXPECT_EQ(tresca.tensile_strength(), ft);
      YieldingSample sample{ tresca };
      sample.strain({ 0., 0., 3e-3 });
      const auto f = tresca.yield_functions(sample.stress());
      EXPECT_NEAR(f.shear, 0., 1e-12 * cohesion);
      EXPECT_LE(f.tension, 1e-12 * cohesion);
      if (ft == infinity)
      {
        EXPECT_NEAR(sample.stress()[2], cohesion, 1e-12 * cohesion);
        const auto flowed = sample.logarithms();
        EXPECT_NEAR(flowed[0] + flowed[1] + flowed[2], 0., 1e-17);
      }
      // Any pressure, no more strength.
      if (plane == strain_plane)
      {
        YieldingSample deep{ tresca, { -1e9, -1e9, 0., -1e9 } };
        deep.strain({ 0., 0., 3e-3 });
        EXPECT_NEAR(deep.stress()[2], cohesion, 1e-6 * cohesion);
      }
    }
}

TEST(MohrCoulomb, NoStrengthBearsNothing)
{
  for (const double friction : { 0., phi })
    for (const auto plane : { strain_plane, stress_plane })
    {
      YieldingSample sand{ MohrCoulomb(rock, { 0., friction, 0., infinity },
                                       plane) };
      sand.strain({ 1e-3, 2e-3, 5e-4 });
      const auto stress = sand.stress();
      if (friction == 0. && plane == strain_plane)
        EXPECT_NEAR(stress[0], stress[1], 1e-6);
      else
        for (const double s : stress)
          EXPECT_NEAR(s, 0., 1e-6);
    }
}

TEST(MohrCoulomb, TurnsWithItsAxes)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> strain(-2e-3, 2e-3), angle(0., 6.);
  const auto turned
      = [](const double a, const double b, const double c, const double at)
  {
    const double mean = 0.5 * (a + b), half = 0.5 * (a - b);
    const double co = std::cos(2. * at), si = std::sin(2. * at);
    return Strain{ mean + half * co - c * si, mean - half * co + c * si,
                   half * si + c * co };
  };
  for (const auto plane : { strain_plane, stress_plane })
  {
    const auto rock_law = law(12. * degree, 0.7e6, plane);
    for (int i = 0; i < 10000; ++i)
    {
      const Strain e{ strain(random), strain(random), strain(random) };
      const double at = angle(random);
      PlasticPoint here, there;
      const double lost = rock_law.update(here, e).dissipated;
      EXPECT_NEAR(
          rock_law.update(there, turned(e[0], e[1], e[2], at)).dissipated, lost,
          1e-9 * (1. + lost));
      const auto expected
          = turned(here.stress[0], here.stress[1], here.stress[2], at);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(there.stress[k], expected[k], 1e-6);
      EXPECT_NEAR(there.stress[3], here.stress[3], 1e-6);
      EXPECT_EQ(there.state, here.state);
    }
  }
}

TEST(MohrCoulomb, TangentIsTheDerivative)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> strain(-2e-3, 2e-3),
      pressure(-15e6, 3e6);
  constexpr double h = 1e-9;
  for (const double psi : { 0., 12. * degree, phi })
    for (const double ft : { infinity, 0.7e6 })
      for (const auto plane : { strain_plane, stress_plane })
      {
        const auto rock_law = law(psi, ft, plane);
        int n_checked = 0, n_plastic = 0;
        for (int i = 0; i < 20000; ++i)
        {
          const Strain e{ strain(random), strain(random), strain(random) };
          const double p = pressure(random);
          const Stress initial{ p, p, 0., p + 4e6 * strain(random) / 2e-3 };
          const auto K = rock_law.tangent(PlasticPoint(), e, initial);
          double worst = 0., kink = 0.;
          for (int j = 0; j < 3; ++j)
          {
            Strain plus = e, minus = e;
            const double step = j == 2 ? 0.5 * h : h; // of 2 xy
            plus[j] += step;
            minus[j] -= step;
            const auto stress = [&](const Strain &at)
            {
              PlasticPoint point;
              return rock_law.update(point, at, initial).stress;
            };
            const auto a = stress(plus), b = stress(minus), middle = stress(e);
            for (int k = 0; k < 3; ++k)
            {
              const double left  = (middle[k] - b[k]) / h;
              const double right = (a[k] - middle[k]) / h;
              kink  = std::max(kink, std::abs(left - right) / rock.young);
              worst = std::max(worst, std::abs(0.5 * (left + right) - K[k][j])
                                          / rock.young);
            }
          }
          // On a border of regions there is no derivative.
          if (kink > 1e-4)
            continue;
          ++n_checked;
          n_plastic += K[2][2] != plane_stiffness(rock, plane).c33;
          EXPECT_LT(worst, 1e-6);
          // The flow is associated with Cauchy's stress, the stiffness
          // symmetric by Kirchhoff's: to the size of the elastic strains.
          if (psi == phi && ft == infinity && plane == strain_plane)
          {
            for (int j = 0; j < 3; ++j)
              for (int k = 0; k < j; ++k)
                EXPECT_NEAR(K[k][j], K[j][k], 1e-2 * rock.young);
          }
        }
        EXPECT_GT(n_checked, 19900);
        EXPECT_GT(n_plastic, 10000);
      }
}

TEST(MohrCoulomb, TangentWithEqualPrincipalStresses)
{
  // Elastic in the plane, yielding out of it: the shear modulus stays. Edge
  // sigma_2 = sigma_3 and two equal tensions: none is left.
  const double shear = plane_stiffness(rock, strain_plane).c33;
  const auto modulus = [](const double plane, const double zz)
  {
    YieldingSample sample{ law(0., 0.5e6, strain_plane) };
    sample.bear(rock, plane, plane, zz);
    return sample.law.tangent(sample.point, sample.elastic().e)[2][2];
  };
  EXPECT_NEAR(modulus(-1e6, 1e6), shear, 1e-3 * shear);
  EXPECT_NEAR(modulus(-9e6, 0.4e6), 0., 3e-3 * shear);
  EXPECT_NEAR(modulus(1e6, 0.), 0., 3e-3 * shear);
}
