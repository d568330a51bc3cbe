// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Laws of rock joints whose slip is a vector that turns, against their rate
// equations, integrated in small explicit increments, and closed forms.

#include "rock_walk.h"

using namespace quoin;
using namespace quoin::rock_test;

namespace
{
  Slip<3> vector(const double x, const double y)
  {
    Slip<3> slip;
    slip[0] = x;
    slip[1] = y;
    return slip;
  }

  /** Forth, round a turn, along a spiral, and back across: of the length
      @p size [m]; t from 0 to 1. */
  Slip<3> turning(const double t, const double size)
  {
    const double angle = 5. * t * t;
    return size * std::sin(4. * t) * vector(std::cos(angle), std::sin(angle));
  }

  /** What an explicit increment of the rate equations reads and overwrites. */
  struct Rates
  {
    double closure = 0.;   /**< V [m] */
    Slip<3> tau;           /**< [Pa] */
    double plastic   = 0.; /**< sum of |dp| [m] */
    double mobilised = 0.; /**< slip that mobilises roughness [m] */
    double opening   = 0.; /**< w less that at the start [m] */
    double reload    = 0.; /**< r */
    bool unloads     = false;
  };

  /** Barton & Choubey 1977 with the roughness of Barton, Bandis & Bakhtar 1985,
      slip along the traction; dilation by its component along all slip. */
  void add_rough(Rates &at, const Slip<3> &du, const Slip<3> &slip)
  {
    constexpr double ks = 5e9, kni = 10e9, Vm = 0.3e-3, peak_slip = 1e-3;
    const double s      = at.closure < 0.8 * Vm
                              ? kni * at.closure / (1. - at.closure / Vm)
                              : 4. * kni * Vm + 250e9 * (at.closure - 0.8 * Vm);
    const Slip<3> trial = at.tau + ks * du;
    const double size   = trial.norm();
    if (size == 0.)
      return;
    const Slip<3> along = trial / size;
    at.mobilised += (size - at.tau.norm()) / ks;
    const double x[]       = { 0., 0.3, 0.6, 1., 2., 4., 10., 25., 100. };
    const double roughness = 10. * std::log10(100e6 / s);
    const double share[]
        = { -28. / roughness, 0., 0.75, 1., 0.85, 0.7, 0.5, 0.4, 0. };
    const double d = at.mobilised / peak_slip;
    double m       = 0.;
    for (unsigned int i = 0; i < 8; ++i)
      if (d >= x[i] && d < x[i + 1])
        m = share[i]
            + (share[i + 1] - share[i]) * (d - x[i]) / (x[i + 1] - x[i]);
    const double strength = s * std::tan((28. + m * roughness) * degree);
    at.tau                = trial;
    if (size <= strength)
      return;
    at.tau          = strength * along;
    const double dp = (size - strength) / ks;
    at.plastic += dp;
    double dw = std::tan(0.5 * std::max(m, 0.) * roughness * degree) * dp
                * (along * slip) / slip.norm();
    dw = std::max(dw, -at.opening);
    at.opening += dw;
    at.closure += dw;
  }

  /** Cundall & Hart 1984, for the size of the traction. */
  void add_yielding(Rates &at, const Slip<3> &du, const Slip<3> &)
  {
    // kn = 20 GPa/m (s/MPa)^0.5: V = 2 sqrt(s MPa)/20e9, but for its start
    // below 10 kPa, where it is straight.
    const double V0 = 1e4 / 2e9, Vs = at.closure - V0;
    const double root     = std::sqrt(1e4) + Vs * 20e9 / (2. * std::sqrt(1e6));
    const double s        = root * root;
    const double ks       = 8e9 * std::pow(s / 1e6, 0.4);
    const double phi      = 30. + 20. * std::exp(-at.plastic / 1e-3);
    const double strength = s * std::tan(phi * degree);
    const double size     = at.tau.norm();
    const double by       = size > 0. ? at.tau * du / size : du.norm();
    double F              = 1.;
    if (by >= 0.)
    {
      if (at.unloads)
        at.reload = std::min(0.75, size / strength);
      F = std::min(1., (1. - size / strength) / (1. - at.reload));
    }
    at.unloads         = by < 0.;
    const double dp    = (1. - F) * by;
    const Slip<3> dtau = ks * (du - (size > 0. ? dp / size : 0.) * at.tau);
    const double angle = std::atan(size / s) / degree - 30.;
    const double dw
        = std::tan(std::min(20., std::max(0., angle)) * degree) * dp;
    at.tau += dtau;
    at.plastic += dp;
    at.opening += dw;
    at.closure += dw;
  }

  /** Largest difference of the shear tractions of @p law, in @p n steps along
      turning(), from those of @p rates, over the largest of these; and that
      of dilation and wear at the end, over their own size. */
  template <typename Law, typename Add>
  std::array<double, 3> differences(const Law &law, const Add &rates,
                                    const double size, const unsigned int n)
  {
    constexpr double pressure  = 2e6;
    constexpr unsigned int all = 400000;
    RockPoint<3> point;
    Rates at;
    at.closure = law.closure.closure(pressure);
    law.update(point, -at.closure, Slip<3>());
    const double opening = -at.closure;
    double largest = 0., difference = 0.;
    Slip<3> slip;
    for (unsigned int i = 1; i <= all; ++i)
    {
      const Slip<3> next = turning(double(i) / all, size);
      rates(at, next - slip, next);
      slip = next;
      if (i % (all / n) != 0)
        continue;
      law.update(point, opening, slip);
      largest    = std::max(largest, at.tau.norm());
      difference = std::max(difference, (point.shear_traction - at.tau).norm());
    }
    EXPECT_GT(at.opening, 0.);
    return { difference / largest,
             std::abs(point.dilated - at.opening) / at.opening,
             std::abs(point.worn_slip - at.plastic) / at.plastic };
  }
} // namespace

TEST(RockSlipVector, BartonBandisAlongATurningPath)
{
  // To first order in the step, as slip goes along the traction at its end.
  for (const double error : differences(rough(), add_rough, 1.5e-3, 2000))
    EXPECT_LT(error, 1.5e-3);
  for (const double error : differences(rough(), add_rough, 1.5e-3, 20000))
    EXPECT_LT(error, 1.5e-4);
}

TEST(RockSlipVector, ContinuouslyYieldingAlongATurningPath)
{
  for (const double size : { 4e-4, 2e-3 })
  {
    for (const double error : differences(yielding(), add_yielding, size, 2000))
      EXPECT_LT(error, 1e-2);
    for (const double error :
         differences(yielding(), add_yielding, size, 20000))
      EXPECT_LT(error, 1e-3);
  }
}

namespace
{
  /** Goes on along a circle of slip, under the constant strength @p tau [Pa] of
      a joint that is worn out: the traction is that of steady sliding, which
      turns with the slip. */
  template <typename Law>
  void expect_lag(const Law &law, const double ks, const double tau)
  {
    constexpr double radius = 1e-3, pressure = 2e6;
    constexpr unsigned int n = 20000;
    RockPoint<3> point;
    law.wear_out(point);
    for (unsigned int i = 0; i <= n; ++i)
    {
      const double angle = 6. * M_PI * i / n;
      law.update(point, -law.closure.closure(pressure),
                 radius * vector(std::cos(angle), std::sin(angle)));
    }
    // Across the traction ks du turns it by du/radius; the last increment was
    // along that slip in its middle.
    const double lag = std::asin(tau / (ks * radius)) + 3. * M_PI / n;
    EXPECT_GT(lag, 0.05);
    EXPECT_NEAR(point.shear_traction.norm(), tau, 1e-9 * tau);
    EXPECT_NEAR(std::atan2(point.shear_traction[0], point.shear_traction[1]),
                lag, 1e-5 * lag);
    EXPECT_NEAR(point.plastic_opening, 0., 1e-15);
    EXPECT_EQ(point.state, JointState::slipping);
  }
} // namespace

TEST(RockSlipVector, TractionFollowsSlipThatGoesRound)
{
  expect_lag(rough(), 5e9, 2e6 * std::tan(28. * degree));
  expect_lag(yielding(), 8e9 * std::pow(2., 0.4), 2e6 * std::tan(30. * degree));
}
