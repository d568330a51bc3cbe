// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"

#include <quoin/farfield/incident_waves.h>
#include <quoin/base/exceptions.h>
#include <quoin/signals/signal.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  const ElasticMedium medium{ 2000., 400., 200. };
  constexpr double duration = 1., time_step = 1e-3;

  /** Upwards, f = 5 Hz. */
  IncidentWaveParameters wave(const std::string &name,
                              const IncidentWaveType type,
                              const double amplitude, const double delay = 0.5)
  {
    IncidentWaveParameters result;
    result.name         = name;
    result.type         = type;
    result.amplitude    = amplitude;
    result.signal       = ricker_wavelet(5., delay);
    result.signal_entry = "Signal";
    return result;
  }

  Boundary level_line()
  {
    Boundary boundary;
    boundary.add_curve({ { -1., 0. }, { 0., 0. }, { 1., 0. } }, false);
    return boundary;
  }

  IncidentWaves waves_on(const Boundary &boundary,
                         const BoundaryElementParameters &settings)
  {
    return { settings, medium, boundary, {}, duration, time_step };
  }
} // namespace

// u = f(t - y/c): on y = 0 the signal itself, its traction -rho c f' n_y.
TEST(IncidentWaves, AddUpAndHaveTheirTractions)
{
  const Boundary boundary = level_line();
  BoundaryElementParameters settings;
  settings.waves      = { wave("p", IncidentWaveType::plane_p, 1e-3),
                          wave("more", IncidentWaveType::plane_p, 2e-3),
                          wave("sv", IncidentWaveType::plane_sv, 5e-3) };
  const Signal f      = ricker_wavelet(5., 0.5);
  const double normal = boundary.elements[0].normal()[1];
  for (const double t : { 0.4, 0.47, 0.5 })
  {
    settings.formulation      = Formulation::galerkin;
    const IncidentWaves waves = waves_on(boundary, settings);
    const Eigen::VectorXd u   = waves.displacements(t);
    const Eigen::VectorXd p   = waves.tractions(t, t + time_step);
    const double rate = (f.value(t + time_step) - f.value(t)) / time_step;
    ASSERT_EQ(u.size(), 4);
    for (const unsigned int e : { 0U, 1U })
    {
      EXPECT_NEAR(u[2 * e], 5e-3 * f.value(t), 1e-12);
      EXPECT_NEAR(u[2 * e + 1], 3e-3 * f.value(t), 1e-12);
      EXPECT_NEAR(p[2 * e], -2000. * 200. * 5e-3 * rate * normal, 1e-3);
      EXPECT_NEAR(p[2 * e + 1], -2000. * 400. * 3e-3 * rate * normal, 1e-3);
    }
    const dealii::Tensor<1, 2> within = waves.displacement({ 0., 10. }, t);
    EXPECT_NEAR(within[0], 5e-3 * f.value(t - 10. / 200.), 1e-12);
    EXPECT_NEAR(within[1], 3e-3 * f.value(t - 10. / 400.), 1e-12);

    // by convolution quadrature about the end of the step
    settings.formulation = Formulation::convolution_quadrature;
    const Eigen::VectorXd at_end
        = waves_on(boundary, settings).tractions(t, t + time_step);
    const double rate_at_end
        = (f.value(t + 1.5 * time_step) - f.value(t + 0.5 * time_step))
          / time_step;
    EXPECT_NEAR(at_end[1], -2000. * 400. * 3e-3 * rate_at_end * normal, 1e-3);
  }
}

TEST(IncidentWaves, MustNotHaveArrivedAtTheStart)
{
  const Boundary boundary = level_line();
  BoundaryElementParameters settings;
  settings.waves = { wave("early", IncidentWaveType::plane_p, 1e-3, 0.1) };
  const std::string message
      = message_of<InputError>([&] { waves_on(boundary, settings); });
  EXPECT_NE(message.find("section 'Incident waves/early'"), std::string::npos);
  EXPECT_NE(message.find("at t = 0"), std::string::npos);
}

// Of two along the same way it is that of their sum.
TEST(IncidentWaves, BringTheEnergyOfTheirVelocity)
{
  const Boundary boundary = level_line();
  BoundaryElementParameters settings;
  settings.waves = { wave("sv", IncidentWaveType::plane_sv, 1e-3),
                     wave("more", IncidentWaveType::plane_sv, 2e-3) };
  // Integral of the square of the derivative of Ricker's wavelet.
  const double square = 3.75 * M_PI * 5. * std::sqrt(0.5 * M_PI) * 9e-6;
  EXPECT_NEAR(
      waves_on(boundary, settings).energy(medium, { 0, 1 }, duration, time_step)
          / (2000. * 200. * 2. * square),
      1., 1e-2);
}

TEST(IncidentWaves, SayHowMuchLaterTheirPrecursorsAllow)
{
  Boundary boundary;
  boundary.add_curve({ { 1., 0. }, { 0., 0. }, { -1., 0. } }, false);
  BoundaryElementParameters settings;
  const auto message = [&](const double delay)
  {
    settings.waves = { wave("early", IncidentWaveType::rayleigh, 1e-3, delay) };
    settings.waves[0].half_plane = true;
    settings.waves[0].angle      = 0.5 * M_PI;
    return message_of<InputError>([&] { waves_on(boundary, settings); });
  };
  const std::string early = message(0.2), words = "Let it start ";
  const auto place = early.find(words);
  ASSERT_NE(place, std::string::npos) << early;
  const double later = std::stod(early.substr(place + words.size()));
  EXPECT_EQ(message(0.2 + later), "nothing was thrown");
  EXPECT_NE(message(0.2 + 0.8 * later), "nothing was thrown");
}
