// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/gauss_legendre.h>
#include <quoin/elastodynamics/plane_wave.h>

#include "field_checks.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

using namespace quoin;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2000., 3e7, 1. / 3.);
  const double degree        = M_PI / 180.;

  /** A smooth signal. */
  double wavelet(const double t)
  {
    return t > 0. ? std::pow(t, 4) * std::exp(-40. * t) : 0.;
  }

  double wavelet_rate(const double t)
  {
    return t > 0. ? (4. - 40. * t) * std::pow(t, 3) * std::exp(-40. * t) : 0.;
  }

  PlaneWave wave(const PlaneWave::Type type, const bool half_plane,
                 const double degrees)
  {
    return PlaneWave(medium, type, half_plane, degrees * degree, wavelet);
  }

  struct Incidence
  {
    PlaneWave::Type type;
    double degrees;
  };

  /** P and SV waves that a half-plane admits; the last is exactly critical. */
  const Incidence incidences[]
      = { { PlaneWave::Type::P, 0. },    { PlaneWave::Type::P, -35. },
          { PlaneWave::Type::P, 60. },   { PlaneWave::Type::P, 89. },
          { PlaneWave::Type::SV, 0. },   { PlaneWave::Type::SV, 20. },
          { PlaneWave::Type::SV, -29. }, { PlaneWave::Type::SV, 30. } };
} // namespace

TEST(PlaneWave, PropagatesAlongItsDirectionWithItsSpeed)
{
  const dealii::Point<2> direction(std::sin(0.7), std::cos(0.7));
  const dealii::Point<2> clockwise(std::cos(0.7), -std::sin(0.7));
  const dealii::Point<2> x(3., 5.);
  const double t = 0.1 + (x * direction) / medium.c2;

  const PlaneWave p(medium, PlaneWave::Type::P, false, 0.7, wavelet);
  const PlaneWave sv(medium, PlaneWave::Type::SV, false, 0.7, wavelet);
  const double f = wavelet(0.1);
  EXPECT_LT((sv.displacement(x, t) - f * clockwise).norm(), 1e-12 * f);
  const double delay = (x * direction) / medium.c1;
  EXPECT_LT((p.displacement(x, 0.1 + delay) - f * direction).norm(), 1e-12 * f);
}

TEST(PlaneWave, ImpedanceOnWavefrontsIsDensityTimesSpeed)
{
  const dealii::Point<2> direction(std::sin(-0.4), std::cos(-0.4));
  const dealii::Point<2> clockwise(std::cos(-0.4), -std::sin(-0.4));
  const double rate = (wavelet(0.12) - wavelet(0.1)) / 0.02;
  const PlaneWave p(medium, PlaneWave::Type::P, false, -0.4, wavelet);
  const PlaneWave sv(medium, PlaneWave::Type::SV, false, -0.4, wavelet);
  const dealii::Point<2> origin;
  const double zp = medium.density * medium.c1;
  const double zs = medium.density * medium.c2;
  EXPECT_LT(
      (p.mean_traction(origin, direction, 0.1, 0.12) + zp * rate * direction)
          .norm(),
      1e-12 * zp * std::abs(rate));
  EXPECT_LT(
      (sv.mean_traction(origin, direction, 0.1, 0.12) + zs * rate * clockwise)
          .norm(),
      1e-12 * zs * std::abs(rate));
}

TEST(PlaneWave, SurfaceOfHalfPlaneIsTractionFree)
{
  const dealii::Point<2> up(0., 1.);
  const double scale = medium.density * medium.c1 * wavelet(0.1) / 0.01;
  for (const Incidence &i : incidences)
  {
    const PlaneWave free_field = wave(i.type, true, i.degrees);
    for (const double x : { -7., 0., 4. })
      for (const double t : { 0.05, 0.1, 0.2 })
        EXPECT_LT(free_field.mean_traction({ x, 0. }, up, t, t + 0.01).norm(),
                  1e-12 * scale)
            << i.degrees;
  }
}

TEST(PlaneWave, SurfaceMovesTwiceAtVerticalIncidence)
{
  const double f = wavelet(0.1);
  const auto p   = wave(PlaneWave::Type::P, true, 0.);
  const auto sv  = wave(PlaneWave::Type::SV, true, 0.);
  EXPECT_LT(
      (p.displacement({ 2., 0. }, 0.1) - dealii::Point<2>(0., 2. * f)).norm(),
      1e-12 * f);
  EXPECT_LT(
      (sv.displacement({ 2., 0. }, 0.1) - dealii::Point<2>(2. * f, 0.)).norm(),
      1e-12 * f);
}

TEST(PlaneWave, ReflectionConservesEnergy)
{
  for (const Incidence &i : incidences)
  {
    // The flux across the surface is proportional to the squared amplitude
    // times density, squared speed and vertical slowness.
    const PlaneWave free_field = wave(i.type, true, i.degrees);
    double sum = 0., scale = 0.;
    for (const PlaneWave::Component &c : free_field.components())
    {
      const double flux = c.amplitude.squaredNorm() * c.slowness[1].real()
                          / c.slowness.squaredNorm();
      sum += flux;
      scale += std::abs(flux);
    }
    EXPECT_LT(std::abs(sum), 1e-12 * scale) << i.degrees;
  }
}

TEST(PlaneWave, SatisfiesTheEquationOfMotion)
{
  // Newton's law on a small square: the tractions on its sides push its mass.
  const double h = 0.02, t = 0.35;
  for (const Incidence &i : incidences)
  {
    const PlaneWave free_field = wave(i.type, true, i.degrees);
    const dealii::Point<2> x(1.5, -2.);
    const double dt         = 1e-4;
    const Boundary square   = Boundary::polygon({ { x[0] - h, x[1] - h },
                                                  { x[0] + h, x[1] - h },
                                                  { x[0] + h, x[1] + h },
                                                  { x[0] - h, x[1] + h } },
                                                2. * h, false);
    const Eigen::VectorXd p = free_field.mean_tractions(square, t - dt, t + dt);
    dealii::Tensor<1, 2> force;
    for (unsigned e = 0; e < 4; ++e)
      force += 2. * h * vector_at(p, e);
    const double step = 2e-3;
    const dealii::Tensor<1, 2> acceleration
        = (free_field.displacement(x, t + step)
           - 2. * free_field.displacement(x, t)
           + free_field.displacement(x, t - step))
          / (step * step);
    const dealii::Tensor<1, 2> wanted
        = medium.density * 4. * h * h * acceleration;
    EXPECT_LT((force - wanted).norm(), 3e-3 * wanted.norm()) << i.degrees;
  }
}

TEST(PlaneWave, MeanTractionIsTheMeanOfTheTraction)
{
  // The traction by the signal's derivative, integrated over the step.
  const PlaneWave free_field = wave(PlaneWave::Type::SV, true, 25.);
  const PlaneWave rates(medium, PlaneWave::Type::SV, true, 25. * degree,
                        wavelet_rate);
  const dealii::Point<2> x(2., -3.), n(0.6, 0.8);
  const double t0 = 0.2, t1 = 0.29, h = 1e-3;
  EXPECT_LT(traction_residual(free_field, medium, x, n, t0, t1, h), 1e-5);

  // The rate of the displacement is the field of the signal's rate.
  const dealii::Tensor<1, 2> rate = (free_field.displacement(x, t1 + h)
                                     - free_field.displacement(x, t1 - h))
                                    / (2. * h);
  EXPECT_LT((rate - rates.displacement(x, t1)).norm(), 2e-3 * rate.norm());
}

TEST(PlaneWave, MeansOverElements)
{
  const PlaneWave free_field = wave(PlaneWave::Type::P, true, 40.);
  Boundary boundary;
  boundary.add_curve({ { 0., 0. }, { 1., -1. }, { 3., -1.5 } }, false);
  const Eigen::VectorXd u = free_field.displacements(boundary, 0.2);
  const Eigen::VectorXd p = free_field.mean_tractions(boundary, 0.2, 0.25);
  const GaussRule &rule   = gauss_legendre(30);
  for (unsigned e = 0; e < 2; ++e)
  {
    const BoundaryElement &element = boundary.elements[e];
    dealii::Tensor<1, 2> mean_u, mean_p = mean_u;
    for (std::size_t g = 0; g < rule.points.size(); ++g)
    {
      const dealii::Point<2> x
          = element.a + rule.points[g] * (element.b - element.a);
      mean_u += rule.weights[g] * free_field.displacement(x, 0.2);
      mean_p += rule.weights[g]
                * free_field.mean_traction(x, element.normal(), 0.2, 0.25);
    }
    EXPECT_LT((vector_at(u, e) - mean_u).norm(), 1e-6 * mean_u.norm());
    EXPECT_LT((vector_at(p, e) - mean_p).norm(), 1e-6 * mean_p.norm());
  }
}

TEST(PlaneWave, BeyondTheCriticalAngleItIsTheHarmonicSolution)
{
  // A steady oscillation, against plane waves exp(i w (t - p x + e y)) whose
  // amplitudes follow from the free surface as a system of equations.
  using Complex           = std::complex<double>;
  const double omega      = 2. * M_PI * 8.;
  const SignalRange range = { -1., 5., 2e-3 };
  const auto cosine       = [omega](const double t)
  {
    const double s = std::min(1., std::max(0., t + 0.5));
    return s * s * s * (10. - 15. * s + 6. * s * s) * std::cos(omega * t);
  };
  for (const double degrees : { 31., 45., -45., 60., 85. })
  {
    const PlaneWave field(medium, PlaneWave::Type::SV, true, degrees * degree,
                          cosine, range);
    EXPECT_TRUE(field.has_precursors());
    const double p  = std::sin(degrees * degree) / medium.c2;
    const double e2 = std::cos(degrees * degree) / medium.c2;
    const Complex down_p(0., std::sqrt(p * p - std::pow(medium.c1, -2)));
    // Traction on the surface, by -i w, of the displacement d with the slowness
    // s: the incident wave, the P wave, the reflected SV wave.
    const auto traction
        = [](const Eigen::Vector2cd &d, const Eigen::Vector2cd &s)
    {
      return Eigen::Vector2cd(medium.mu() * (d[0] * s[1] + d[1] * s[0]),
                              medium.lambda() * (d[0] * s[0] + d[1] * s[1])
                                  + 2. * medium.mu() * d[1] * s[1]);
    };
    const Eigen::Vector2cd s[3] = { { p, e2 }, { p, down_p }, { p, -e2 } };
    Eigen::Vector2cd d[3]
        = { medium.c2 * Eigen::Vector2cd(e2, -p), medium.c1 * s[1],
            medium.c2 * Eigen::Vector2cd(e2, p) };
    Eigen::Matrix2cd matrix;
    matrix << traction(d[1], s[1]), traction(d[2], s[2]);
    const Eigen::Vector2cd coefficients
        = matrix.fullPivLu().solve(-traction(d[0], s[0]));
    // All energy comes back in the SV wave.
    EXPECT_NEAR(std::abs(coefficients[1]), 1., 1e-12);
    d[1] *= coefficients[0];
    d[2] *= coefficients[1];
    for (const double y : { 0., -0.3, -2., -7.7 })
      for (const double t : { 2., 2.531, 3.017 })
      {
        dealii::Tensor<1, 2> wanted;
        for (unsigned k = 0; k < 3; ++k)
          wanted += to_tensor((d[k]
                               * std::exp(Complex(0., omega)
                                          * (t - s[k][0] * 4. - s[k][1] * y)))
                                  .real());
        EXPECT_LT((field.displacement({ 4., y }, t) - wanted).norm(), 2e-5)
            << degrees << ' ' << y;
      }
  }
}

TEST(PlaneWave, BeyondTheCriticalAngleItIsAFreeField)
{
  const auto ricker = [](const double t)
  {
    const double a = std::pow(M_PI * 8. * (t - 1.), 2);
    return (1. - 2. * a) * std::exp(-a);
  };
  const SignalRange range{ 0., 2., 2e-3 };
  for (const double degrees : { 31., -45., 70. })
  {
    const PlaneWave field(medium, PlaneWave::Type::SV, true, degrees * degree,
                          ricker, range);
    const double scale
        = field
              .mean_traction({ 0., -1. }, dealii::Point<2>(1., 0.), 1.02, 1.021)
              .norm();
    for (double t = 0.8; t < 1.3; t += 0.05)
      EXPECT_LT(
          field.mean_traction({ 3., 0. }, dealii::Point<2>(0., 1.), t, t + 1e-3)
              .norm(),
          1e-9 * scale)
          << degrees;
    for (const double y : { -0.5, -4. })
    {
      EXPECT_LT(motion_residual(field, medium, { 1.5, y }, 1.02, 0.02, 5e-4),
                2e-3)
          << degrees << ' ' << y;
      EXPECT_LT(traction_residual(field, medium, { 1.5, y },
                                  dealii::Point<2>(0.6, 0.8), 1., 1.01, 1e-3),
                1e-5)
          << degrees << ' ' << y;
    }
  }
}

TEST(PlaneWave, RefusesWhatItCannotReflect)
{
  EXPECT_THROW(wave(PlaneWave::Type::P, true, 90.), InputError);
  EXPECT_THROW(wave(PlaneWave::Type::P, true, 180.), InputError);
  EXPECT_NO_THROW(wave(PlaneWave::Type::P, false, 180.));
  EXPECT_NO_THROW(wave(PlaneWave::Type::SV, false, 31.));
  // The Hilbert transform needs the range of times.
  EXPECT_THROW(wave(PlaneWave::Type::SV, true, 31.), InputError);
}
