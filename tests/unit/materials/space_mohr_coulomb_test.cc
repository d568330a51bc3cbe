// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "yield_planes.h"
#include "yielding_sample.h"

#include <quoin/materials/space_mohr_coulomb.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

// Returns in space against what defines them: the closest point of the elastic
// domain, Koiter's rule, and the law in plane strain.

using namespace quoin;

namespace
{
  using Eigen::Matrix3d;

  // So stiff that Biot's stress is Cauchy's.
  constexpr LinearElastic stiff_rock{ 2500., 10e18, 0.25 };
  constexpr LinearElastic real_rock{ 2500., 10e9, 0.25 };

  Matrix3d random_rotation(std::mt19937 &random)
  {
    std::normal_distribution<double> any;
    return Eigen::Quaterniond(any(random), any(random), any(random),
                              any(random))
        .normalized()
        .toRotationMatrix();
  }

  SpaceTensor components(const Matrix3d &s)
  {
    return { s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2) };
  }

  Matrix3d matrix(const SpaceTensor &s)
  {
    Matrix3d m;
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return m;
  }

  /** A material point that is given one deformation after the other. */
  struct SpaceSample
  {
    SpaceMohrCoulomb law;
    SpaceTensor initial{};
    SpacePlasticPoint point{};
    Matrix3d gradient = Matrix3d::Zero(); /**< H = F - I */
    Matrix3d piola    = Matrix3d::Zero(); /**< first Piola-Kirchhoff [Pa] */

    SpaceStrain elastic() const
    {
      const Matrix3d Q = matrix(point.inverse_stretch);
      const Matrix3d A = gradient + Q + gradient * Q;
      double H[3][3];
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          H[r][c] = A(r, c);
      return SpaceStrain(H);
    }

    /** Returns what that dissipated [J/m^3]. */
    double deform(const Matrix3d &H)
    {
      gradient                 = H;
      const SpaceStrain strain = elastic();
      const Matrix3d before    = matrix(point.inverse_stretch);
      const auto step          = law.update(point, strain, initial);
      double T[3][3];
      strain.turning_stress(step.stress, T);
      Matrix3d R, stress;
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
        {
          R(r, c)      = strain.R[r][c];
          stress(r, c) = T[r][c];
        }
      piola = R * stress * (Matrix3d::Identity() + before);
      return step.dissipated;
    }

    /** Cauchy's stress in the fixed frame [Pa]. */
    Matrix3d stress() const
    {
      const SpaceStrain strain = elastic();
      return matrix(
          strain.to_global(law.cauchy_stress(point, strain, initial)));
    }
  };

  /** Principal trial stresses that reach every region. */
  Vector3 random_trial(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> any(-1., 1.);
    const double size   = std::pow(10., 6.5 + any(random));
    const double centre = 2. * any(random);
    return size
           * Vector3(centre + any(random), centre + any(random),
                     centre + any(random));
  }

  /** The return of the stress with the principal values @p trial along the
      columns of @p axes, and what flowed off, both along them. */
  struct Returned
  {
    Vector3 stress, flowed;
    double across; /**< the largest component that is no principal one [Pa] */
  };
  Returned returned(const SpaceMohrCoulomb &law, const Vector3 &trial,
                    const Matrix3d &axes)
  {
    SpaceSample sample{ law };
    const Vector3 strain = compliance(stiff_rock) * trial;
    const Matrix3d Q     = axes * strain.asDiagonal() * axes.transpose();
    sample.point.inverse_stretch = components(Q);
    sample.point.stress
        = components(axes * trial.asDiagonal() * axes.transpose());
    sample.point.state = yielding::shear_past;
    sample.deform(Matrix3d::Zero());
    const Matrix3d s = axes.transpose() * sample.stress() * axes;
    const Matrix3d p
        = axes.transpose() * (Q - matrix(sample.point.inverse_stretch)) * axes;
    return { s.diagonal(), p.diagonal(),
             std::max(
                 { std::abs(s(0, 1)), std::abs(s(0, 2)), std::abs(s(1, 2)) }) };
  }
} // namespace

TEST(SpaceMohrCoulomb, ReturnsToTheClosestPointIfAssociated)
{
  std::mt19937 random(3);
  for (const auto &strength : strengths(true))
  {
    const SpaceMohrCoulomb law(stiff_rock, strength);
    const Domain domain(strength);
    for (int i = 0; i < 300; ++i)
    {
      const Vector3 trial = random_trial(random);
      const auto result   = returned(law, trial, random_rotation(random));
      const double scale  = domain.scale + trial.norm();
      EXPECT_LT(result.across, 1e-8 * scale);
      const Vector3 expected
          = domain.excess(trial) <= 0.
                ? trial
                : closest(domain, trial, compliance(stiff_rock), 3);
      EXPECT_LT((result.stress - expected).norm(), 2e-8 * scale);
    }
  }
}

TEST(SpaceMohrCoulomb, ObeysKoitersRule)
{
  std::mt19937 random(5);
  for (const auto &strength : strengths(false))
  {
    const SpaceMohrCoulomb law(stiff_rock, strength);
    const Domain domain(strength);
    for (int i = 0; i < 300; ++i)
    {
      const Vector3 trial = random_trial(random);
      if (domain.excess(trial) <= 1e-6 * domain.scale)
        continue;
      const auto result = returned(law, trial, random_rotation(random));
      const double size = domain.scale + trial.norm();
      EXPECT_LE(std::abs(domain.excess(result.stress)), 1e-11 * size);
      EXPECT_LT(koiter_distance(domain, result.stress, result.flowed), 1e-5);
    }
  }
}

TEST(SpaceMohrCoulomb, IsTheLawOfPlaneStrainInAPlane)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1., 1.);
  for (const auto &strength : strengths(false))
  {
    const Matrix3d axes = random_rotation(random);
    YieldingSample plane{ MohrCoulomb(real_rock, strength,
                                      PlaneAssumption::plane_strain),
                          { -1e6, -3e6, 0.2e6, -2e6 } };
    SpaceSample space{ SpaceMohrCoulomb(real_rock, strength) };
    const auto lift = [](const double xx, const double xy, const double yx,
                         const double yy, const double zz)
    {
      Matrix3d result = Matrix3d::Zero();
      result.topLeftCorner<2, 2>() << xx, xy, yx, yy;
      result(2, 2) = zz;
      return result;
    };
    const auto &s0 = plane.initial;
    space.initial  = components(axes * lift(s0[0], s0[2], s0[2], s0[1], s0[3])
                                * axes.transpose());
    plane.point.stress = plane.initial;
    space.point.stress = space.initial;
    YieldingSample::Tensor H{};
    for (int i = 0; i < 200; ++i)
    {
      for (double &component : H)
        component += 2e-4 * any(random);
      const double lost = plane.deform(H);
      EXPECT_NEAR(space.deform(axes * lift(H[0], H[1], H[2], H[3], 0.)
                               * axes.transpose()),
                  lost, 1e-7 * (std::abs(lost) + 1.));
      const auto s         = plane.stress();
      const Matrix3d found = axes.transpose() * space.stress() * axes;
      EXPECT_LT((found - lift(s[0], s[2], s[2], s[1], s[3])).norm(),
                1e-8 * (found.norm() + 2e6));
      EXPECT_EQ(space.point.state, plane.point.state);
      EXPECT_NEAR(space.point.plastic_shear, plane.point.plastic_shear,
                  1e-9 * (1e-4 + plane.point.plastic_shear));
    }
    EXPECT_GT(plane.point.plastic_shear, 0.);
  }
}

TEST(SpaceMohrCoulomb, DissipationClosesTheBalance)
{
  // Trapezoidal work = change of stored energy + dissipation, in every step
  // that does not turn, however large.
  std::mt19937 random(23);
  std::uniform_real_distribution<double> any(-1., 1.);
  for (const auto &strength : strengths(false))
  {
    const SpaceMohrCoulomb law(real_rock, strength);
    const Matrix3d axes = random_rotation(random);
    SpaceSample sample{ law };
    Vector3 e = Vector3::Zero();
    for (int i = 0; i < 500; ++i)
    {
      const SpaceSample old = sample;
      const double before   = law.stored_energy(sample.point.stress);
      for (int k = 0; k < 3; ++k)
        e[k] = std::max(-0.1, std::min(0.1, e[k] + 3e-3 * any(random)));
      const double lost
          = sample.deform(axes * e.asDiagonal() * axes.transpose());
      const double work = 0.5
                          * (old.piola + sample.piola)
                                .cwiseProduct(sample.gradient - old.gradient)
                                .sum();
      const double change = law.stored_energy(sample.point.stress) - before;
      EXPECT_NEAR(work, change + lost,
                  1e-10
                      * (std::abs(work) + std::abs(change) + std::abs(lost)
                         + before + 1e3));
    }
  }
}

TEST(SpaceMohrCoulomb, RotationsChangeNothing)
{
  std::mt19937 random(29);
  std::uniform_real_distribution<double> any(-1., 1.);
  const SpaceMohrCoulomb law(real_rock, { 2e6, 35. * degree, 10. * degree });
  SpaceSample still{ law }, turned{ law };
  still.initial = turned.initial = { -1e6, -3e6, -2e6, 0.3e6, 0., -0.2e6 };
  still.point.stress = turned.point.stress = still.initial;
  Matrix3d H                               = Matrix3d::Zero();
  const Matrix3d I                         = Matrix3d::Identity();
  for (int i = 0; i < 200; ++i)
  {
    for (int k = 0; k < 9; ++k)
      H(k / 3, k % 3) += 2e-4 * any(random);
    const Matrix3d R  = random_rotation(random);
    const double lost = still.deform(H);
    EXPECT_NEAR(turned.deform(R * (I + H) - I), lost,
                1e-6 * (std::abs(lost) + 1.));
    EXPECT_LT((turned.stress() - R * still.stress() * R.transpose()).norm(),
              1e-7 * still.stress().norm());
    // No moment.
    const Matrix3d kirchhoff = turned.piola * (I + turned.gradient).transpose();
    EXPECT_LT((kirchhoff - kirchhoff.transpose()).norm(),
              1e-9 * (1e6 + kirchhoff.norm()));
  }
  EXPECT_GT(still.point.plastic_shear, 0.);
}
