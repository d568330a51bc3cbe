// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "yield_planes.h"
#include "yielding_sample.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

// Returns against what defines them: the closest point of the elastic domain,
// Koiter's rule, and integration in small substeps.

using namespace quoin;

namespace
{
  using Strain = std::array<double, 3>;
  using Stress = std::array<double, 4>;

  // So stiff that Biot's stress is Cauchy's.
  const std::vector<LinearElastic> rocks{ { 2500., 10e18, 0.25 },
                                          { 2500., 10e18, 0. },
                                          { 2500., 10e18, 0.45 },
                                          { 2500., 10e18, -0.4 } };
  constexpr LinearElastic real_rock{ 2500., 10e9, 0.25 };

  /** Principal trial stresses xx, yy, zz that reach every region. */
  Stress random_trial(std::mt19937 &random, const PlaneAssumption plane)
  {
    std::uniform_real_distribution<double> any(-1., 1.);
    const double size   = std::pow(10., 6.5 + any(random));
    const double centre = 2. * any(random);
    const double zz     = plane == PlaneAssumption::plane_strain
                              ? size * (centre + any(random))
                              : 0.;
    return { size * (centre + any(random)), size * (centre + any(random)), 0.,
             zz };
  }

  /** The return of principal stresses, and what flowed off. */
  struct Returned
  {
    Vector3 stress, flowed;
  };
  Returned returned(const MohrCoulomb &law, const LinearElastic &rock,
                    const Stress &trial)
  {
    YieldingSample sample{ law };
    sample.bear(rock, trial[0], trial[1], trial[3]);
    const auto before = sample.point.inverse_stretch;
    sample.deform({});
    const auto &after = sample.point.inverse_stretch;
    const auto stress = sample.stress();
    return { { stress[0], stress[1], stress[3] },
             { before[0] - after[0], before[1] - after[1],
               before[3] - after[3] } };
  }

  Vector3 diagonal(const Stress &t)
  {
    return { t[0], t[1], t[3] };
  }
} // namespace

TEST(MohrCoulombReturn, IsTheClosestPointIfAssociated)
{
  std::mt19937 random(3);
  for (const auto plane :
       { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress })
    for (const auto &rock : rocks)
      for (const auto &strength : strengths(true))
      {
        const MohrCoulomb law(rock, strength, plane);
        const Domain domain(strength);
        const int n = plane == PlaneAssumption::plane_strain ? 3 : 2;
        for (int i = 0; i < 300; ++i)
        {
          const Stress trial = random_trial(random, plane);
          if (law.is_elastic(trial))
          {
            EXPECT_LE(domain.excess(diagonal(trial)), 1e-9 * domain.scale);
            continue;
          }
          const Vector3 expected
              = closest(domain, diagonal(trial), compliance(rock), n);
          EXPECT_LT((returned(law, rock, trial).stress - expected).norm(),
                    1e-8 * (domain.scale + diagonal(trial).norm()));
        }
      }
}

TEST(MohrCoulombReturn, ObeysKoitersRule)
{
  std::mt19937 random(5);
  for (const auto plane :
       { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress })
    for (const auto &rock : rocks)
      for (const auto &strength : strengths(false))
      {
        const MohrCoulomb law(rock, strength, plane);
        const Domain domain(strength);
        for (int i = 0; i < 300; ++i)
        {
          const Stress trial = random_trial(random, plane);
          if (law.is_elastic(trial))
            continue;
          const auto [s, p] = returned(law, rock, trial);
          // On the domain, to rounding of the trial stress.
          EXPECT_LE(std::abs(domain.excess(s)),
                    1e-12 * (domain.scale + diagonal(trial).norm()));
          EXPECT_LT(koiter_distance(domain, s, p), 1e-6)
              << "phi " << strength.friction_angle / degree << " psi "
              << strength.dilation_angle / degree << " ft " << strength.tension
              << " nu " << rock.poisson << " plane " << static_cast<int>(plane)
              << " trial " << trial[0] << " " << trial[1] << " " << trial[3];
          // What the stress lost is the stiffness times the flow, to the size
          // of the strains, up to 1e-11.
          const Vector3 lost = compliance(rock) * (diagonal(trial) - s);
          const int n        = plane == PlaneAssumption::plane_strain ? 3 : 2;
          EXPECT_LT((lost - p).head(n).norm(),
                    1e-12 * p.norm()
                        + 1e-10 * diagonal(trial).norm() / rock.young);
        }
      }
}

TEST(MohrCoulombReturn, MillionRandomStrains)
{
  std::mt19937 random(17);
  std::uniform_real_distribution<double> any(-1., 1.);
  for (const auto plane :
       { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress })
    for (const auto &strength : strengths(false))
    {
      const MohrCoulomb law(real_rock, strength, plane);
      YieldingSample sample{ law };
      YieldingSample::Tensor H{};
      double slow_loss = 0.;
      for (int i = 0; i < 40000; ++i)
      {
        // Mostly small steps, at times a jump, and now and then a new cell.
        const bool jump = i % 10 == 0;
        const double size
            = jump ? std::pow(10., -3. + 1.7 * any(random)) : 2e-5;
        if (i % 100 == 0)
        {
          sample = { law,
                     { -1e6, -3e6, 0.2e6,
                       plane == PlaneAssumption::plane_stress ? 0. : -2e6 } };
          H      = {};
        }
        for (double &component : H)
          component += size * any(random);
        const double sheared = sample.point.plastic_shear;
        const double lost    = sample.deform(H);

        const auto stress = sample.stress();
        double largest    = 2e6;
        for (const double s : stress)
        {
          ASSERT_TRUE(std::isfinite(s));
          largest = std::max(largest, std::abs(s));
        }
        const auto f       = law.yield_functions(stress);
        const double round = 1e-11 * largest;
        ASSERT_LE(f.shear, round);
        ASSERT_LE(f.tension, round);
        ASSERT_GE(sample.point.plastic_shear, sheared);
        ASSERT_TRUE(std::isfinite(lost));
        if (!jump)
          slow_loss += lost;
      }
      EXPECT_GT(slow_loss, 0.);
    }
}

TEST(MohrCoulombReturn, DissipationClosesTheBalance)
{
  // Trapezoidal work = change of stored energy + dissipation, in every step
  // that does not turn, however large.
  std::mt19937 random(23);
  std::uniform_real_distribution<double> any(-1., 1.);
  for (const auto plane :
       { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress })
    for (const auto &strength : strengths(false))
      for (const double turn : { 0., 0.7 })
      {
        const MohrCoulomb law(real_rock, strength, plane);
        YieldingSample sample{
          law,
          { -1e6, -3e6, 0., plane == PlaneAssumption::plane_stress ? 0. : -2e6 }
        };
        if (turn != 0.)
          sample.initial = {}; // whose axes would turn the cell's
        const double c = std::cos(turn), s = std::sin(turn);
        double a = 0., b = 0.;
        sample.point.stress = sample.initial;
        sample.deform({});
        for (int i = 0; i < 2000; ++i)
        {
          const auto old      = sample;
          const double before = law.stored_energy(sample.point.stress);
          a                   = std::clamp(a + 3e-3 * any(random), -0.1, 0.1);
          b                   = std::clamp(b + 3e-3 * any(random), -0.1, 0.1);
          const double lost
              = sample.deform({ c * c * a + s * s * b, c * s * (a - b),
                                c * s * (a - b), s * s * a + c * c * b });
          double work = 0.;
          for (int k = 0; k < 4; ++k)
            work += 0.5 * (old.piola[k] + sample.piola[k])
                    * (sample.gradient[k] - old.gradient[k]);
          const double change = law.stored_energy(sample.point.stress) - before;
          EXPECT_NEAR(work, change + lost,
                      1e-11
                          * (std::abs(work) + std::abs(change) + std::abs(lost)
                             + before + 1e3));
        }
      }
}

TEST(MohrCoulombReturn, AgreesWithSubsteps)
{
  // Plastic correctors on whichever plane is exceeded most, in plane strain,
  // along a path on which the principal axes turn; the error of the implicit
  // steps is of the first order in their size.
  const LinearElastic &rock = rocks[0];
  const MohrCoulombStrength strength{ 2e6, 30. * degree, 8. * degree, 0.6e6 };
  const Domain domain(strength);
  // For strains as small as the rock is stiff.
  const double scale      = real_rock.young / rock.young;
  const Eigen::Matrix3d D = compliance(rock).inverse();
  const double shear      = rock.young / (2. * (1. + rock.poisson));
  const auto path         = [&](const double t) -> Strain
  {
    return { -1.5e-3 * scale * t, 1e-3 * scale * (std::sin(3. * t) - t),
             1.2e-3 * scale * std::sin(2. * t) };
  };

  const auto reference = [&](const int n_steps) -> Stress
  {
    Stress s{};
    Strain before{};
    for (int i = 1; i <= n_steps; ++i)
    {
      const Strain now = path(2. * i / n_steps);
      const Vector3 de(now[0] - before[0], now[1] - before[1], 0.);
      const Vector3 ds = D * de;
      s                = { s[0] + ds[0], s[1] + ds[1],
                           s[2] + 2. * shear * (now[2] - before[2]), s[3] + ds[2] };
      before           = now;
      const double at  = 0.5 * std::atan2(2. * s[2], s[0] - s[1]);
      const double c = std::cos(at), n = std::sin(at);
      Vector3 p(c * c * s[0] + n * n * s[1] + 2. * c * n * s[2],
                n * n * s[0] + c * c * s[1] - 2. * c * n * s[2], s[3]);
      for (int k = 0; k < 200 && domain.excess(p) > 1e-6; ++k)
      {
        const Plane *worst = nullptr;
        double excess      = 0.;
        for (const Plane &plane : domain.planes)
          if (plane.normal.dot(p) - plane.limit > excess)
          {
            worst  = &plane;
            excess = plane.normal.dot(p) - plane.limit;
          }
        p -= excess / worst->normal.dot(D * worst->flow) * D * worst->flow;
      }
      s = { c * c * p[0] + n * n * p[1], n * n * p[0] + c * c * p[1],
            c * n * (p[0] - p[1]), p[2] };
    }
    return s;
  };

  const Stress fine = reference(200000);
  const MohrCoulomb law(rock, strength, PlaneAssumption::plane_strain);
  std::vector<double> errors;
  for (const int n_steps : { 100, 1000, 10000 })
  {
    YieldingSample sample{ law };
    for (int i = 1; i <= n_steps; ++i)
      sample.strain(path(2. * i / n_steps));
    EXPECT_NE(sample.point.state, 0);
    double error = 0.;
    for (int k = 0; k < 4; ++k)
      error = std::max(error, std::abs(sample.stress()[k] - fine[k]));
    errors.push_back(error / 1e6);
  }
  EXPECT_LT(errors[0], 0.1);
  EXPECT_LT(errors[1], 0.15 * errors[0]);
  EXPECT_LT(errors[2], 1e-3);
}
