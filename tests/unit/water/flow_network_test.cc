// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/water/flow_network.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  constexpr double mu = 1e-3, gamma_w = 1e4, kw = 2e9;
  const Fluid water{ mu, gamma_w, kw, false };
  const Fluid free_water{ mu, gamma_w, kw, true };

  /** Flow by pressure of a channel of constant aperture. */
  double conductance(const double aperture, const double length,
                     const double thickness = 1.)
  {
    return thickness * std::pow(aperture, 3) / (12. * mu * length);
  }

  double sum(const std::vector<double> &values)
  {
    double result = 0.;
    for (const double value : values)
      result += value;
    return result;
  }
} // namespace

TEST(FlowNetwork, ParallelPlatesFollowTheCubicLaw)
{
  // Two pieces of 3 m and 1 m from 4 m down to 1 m of height.
  const FlowNetwork network(water, { 4., 2., 1. },
                            { { { 0, 1 }, 3., 0.5, { 2e-4, 2e-4 } },
                              { { 1, 2 }, 1., 0.5, { 2e-4, 2e-4 } } });
  FlowConditions given(3);
  given.is_given          = { 1, 0, 1 };
  given.pressure          = { 5e4, 0., 1e4 };
  const FlowSolution flow = network.steady(given);
  const double drop       = 5e4 - 1e4 + 3. * gamma_w;
  const double q          = conductance(2e-4, 4., 0.5) * drop;
  EXPECT_NEAR(flow.inflow[0], q, 1e-12 * q);
  EXPECT_NEAR(flow.inflow[2], -q, 1e-12 * q);
  EXPECT_NEAR(flow.inflow[1], 0., 1e-20);
  EXPECT_NEAR(flow.pressure[1], 5e4 + 2. * gamma_w - 0.75 * drop, 1e-8);
  EXPECT_NEAR(flow.residual, 0., 1e-12 * q);
}

TEST(FlowNetwork, ATaperedChannelIsExact)
{
  // The same channel cut into many of nearly constant aperture.
  constexpr unsigned int n = 2000;
  double resistance        = 0.;
  for (unsigned int i = 0; i < n; ++i)
  {
    const double a = 1e-4 + (i + 0.5) / n * 3e-4;
    resistance += 1. / conductance(a, 2. / n);
  }
  const FlowChannel channel{ { 0, 1 }, 2., 1., { 1e-4, 4e-4 } };
  const FlowNetwork network(water, { 0., 0. }, { channel });
  EXPECT_NEAR(network.conductance(channel) * resistance, 1., 1e-5);
}

TEST(FlowNetwork, SpokesAndRingsAreThoseOfASeries)
{
  // Water from a well flows along 6 spokes through 4 rings, in which nothing
  // flows: pressures are those of resistances in series.
  constexpr unsigned int n_spokes = 6, n_rings = 4;
  const auto node = [](const unsigned int ring, const unsigned int spoke)
  { return 1 + ring * n_spokes + spoke % n_spokes; };
  std::vector<FlowChannel> channels;
  for (unsigned int s = 0; s < n_spokes; ++s)
    for (unsigned int r = 0; r < n_rings; ++r)
    {
      const double a = 1e-4 * (1. + r);
      channels.push_back({ { r == 0 ? 0 : node(r - 1, s), node(r, s) },
                           1. + r,
                           1.,
                           { a, a } });
      channels.push_back(
          { { node(r, s), node(r, s + 1) }, 2., 1., { 2e-4, 2e-4 } });
    }
  const FlowNetwork network(
      water, std::vector<double>(1 + n_rings * n_spokes, 7.), channels);
  FlowConditions given(network.n_nodes());
  constexpr double well = 3e-4;
  given.source[0]       = well;
  for (unsigned int s = 0; s < n_spokes; ++s)
  {
    given.is_given[node(n_rings - 1, s)] = 1;
    given.pressure[node(n_rings - 1, s)] = 2e4;
  }
  const FlowSolution flow = network.steady(given);
  double expected         = 2e4;
  for (unsigned int r = n_rings; r-- > 0;)
  {
    for (unsigned int s = 0; s < n_spokes; ++s)
      EXPECT_NEAR(flow.pressure[node(r, s)], expected, 1e-10 * expected);
    expected += well / n_spokes / conductance(1e-4 * (1. + r), 1. + r);
  }
  EXPECT_NEAR(flow.pressure[0], expected, 1e-10 * expected);
  EXPECT_NEAR(flow.residual, 0., 1e-12 * well);
}

TEST(FlowNetwork, WhatIsNotConnectedHasNoPressure)
{
  FlowNetwork network(water, { 0., 0., 0., 5. },
                      { { { 0, 1 }, 1., 1., { 1e-4, 1e-4 } },
                        { { 1, 2 }, 1., 1., { 1e-4, 1e-4 }, false },
                        { { 2, 3 }, 1., 1., { 1e-4, 1e-4 } } });
  FlowConditions given(4);
  given.is_given[0] = 1;
  given.pressure[0] = 3e4;
  EXPECT_EQ(network.unconnected_nodes(given),
            (std::vector<std::uint8_t>{ 0, 0, 1, 1 }));
  const FlowSolution flow = network.steady(given);
  EXPECT_NEAR(flow.pressure[1], 3e4, 1e-8);
  EXPECT_EQ(flow.pressure[2], 0.);
  EXPECT_EQ(flow.pressure[3], 0.);
  EXPECT_NEAR(sum(flow.inflow), 0., 1e-20);
}

TEST(FlowNetwork, TransientFlowKeepsItsWater)
{
  // A part of the water of the first node goes to the second; nothing else
  // comes or goes.
  const FlowNetwork network(water, { 0., 0. },
                            { { { 0, 1 }, 2., 1., { 1e-4, 3e-4 } } });
  std::vector<double> content = network.contents({ 1e6, 0. });
  const double all            = sum(content);
  const std::vector<double> none(2, 0.);
  FlowSolution flow;
  for (unsigned int i = 0; i < 200; ++i)
  {
    flow    = network.transient(FlowConditions(2), 1e-4, content, none, none);
    content = flow.content;
    EXPECT_NEAR(sum(content), all, 1e-15 * all);
  }
  const auto volume = network.volumes();
  EXPECT_NEAR(volume[0] + volume[1], 4e-4, 1e-18);
  const double last = 1e6 * volume[0] / 4e-4;
  EXPECT_NEAR(flow.pressure[0], last, 1e-6 * last);
  EXPECT_NEAR(flow.pressure[1], last, 1e-6 * last);
}

TEST(FlowNetwork, BackwardEulerOfOneNode)
{
  // V/K p' = C (p0 - p): p = p0 (1 - (1 + dt C K/V)^-n).
  const FlowNetwork network(water, { 0., 0. },
                            { { { 0, 1 }, 2., 1., { 1e-4, 1e-4 } } });
  FlowConditions given(2);
  given.is_given[0] = 1;
  given.pressure[0] = 1e5;
  const std::vector<double> none(2, 0.);
  std::vector<double> content = network.contents({ 1e5, 0. });
  const double rate = conductance(1e-4, 2.) * kw / 1e-4, dt = 0.1 / rate;
  double inflow = 0.;
  FlowSolution flow;
  for (unsigned int i = 0; i < 10; ++i)
  {
    flow    = network.transient(given, dt, content, none, none);
    content = flow.content;
    inflow += flow.inflow[0];
    EXPECT_NEAR(flow.residual, 0., 1e-10 * flow.inflow[0]);
  }
  const double expected = 1e5 * (1. - std::pow(1.1, -10.));
  EXPECT_NEAR(flow.pressure[1], expected, 1e-7 * expected);
  EXPECT_NEAR(inflow, 1e-4 * expected / kw, 1e-6 * inflow);
}

TEST(FixedPointAcceleration, SolvesWhatPlainIterationDoesNot)
{
  // x = g(x) with slopes -4, 3 and 0.5: plain iteration runs away.
  const std::vector<double> slope = { -4., 3., 0.5 }, at_zero = { 1., 2., 3. };
  FixedPointAcceleration acceleration;
  std::vector<double> x(3, 0.);
  for (unsigned int i = 0; i < 6; ++i)
  {
    std::vector<double> value(3);
    for (unsigned int k = 0; k < 3; ++k)
      value[k] = at_zero[k] + slope[k] * x[k];
    x = acceleration.next(x, value);
  }
  for (unsigned int k = 0; k < 3; ++k)
    EXPECT_NEAR(x[k], at_zero[k] / (1. - slope[k]), 1e-9);
}

namespace
{
  /** A joint of @p n channels, with the first node at y = 0 and the others
      lower, at @p slope [m] by length. */
  FlowNetwork free_joint(const unsigned int n, const double length,
                         const double slope)
  {
    std::vector<double> elevation;
    std::vector<FlowChannel> channels;
    for (unsigned int i = 0; i <= n; ++i)
    {
      elevation.push_back(-slope * length * i / n);
      if (i > 0)
        channels.push_back({ { i - 1, i }, length / n, 1., { 1e-4, 1e-4 } });
    }
    return { free_water, elevation, channels };
  }
} // namespace

// A front of water in a dry horizontal joint lies at the root of 2 k p t
// (Washburn 1921), k = a^2 / (12 mu).
TEST(FlowNetwork, AFrontFillsADryJoint)
{
  constexpr unsigned int n  = 200;
  const FlowNetwork network = free_joint(n, 10., 0.);
  const std::vector<double> none(n + 1, 0.);
  FlowConditions given(n + 1);
  given.is_given[0] = 1;
  given.pressure[0] = 1e5;
  FlowSolution flow{ none, none, none, none, 0. };
  const double dt = 0.5;
  double entered  = 0.;
  for (unsigned int step = 1; step <= 300; ++step)
  {
    flow = network.transient(given, dt, flow.content, none, flow.pressure);
    entered += sum(flow.inflow);
    EXPECT_NEAR(flow.residual, 0., 1e-16);
    if (step % 100 != 0)
      continue;
    const double front = std::sqrt(2. * 1e-8 / (12. * mu) * 1e5 * dt * step);
    EXPECT_NEAR(sum(flow.content) / 1e-4, front, 0.01 * front) << step;
    EXPECT_NEAR(entered, sum(flow.content), 1e-12 * entered);
  }
}

// Water that runs out of a vertical joint is that of the equation of Buckley
// and Leverett with the flux f = s^2 (3 - 2 s): behind a jump from 1 to 1/4,
// which falls by 9/8 of the speed of full flow, comes a fan of f'(s) = z / t.
// The scheme is of first order: 1.4 % with these steps, 0.8 % with half of
// them.
TEST(FlowNetwork, AVerticalJointRunsEmpty)
{
  constexpr unsigned int n  = 400;
  const double length       = 8.;
  const FlowNetwork network = free_joint(n, length, 1.);
  const std::vector<double> none(n + 1, 0.);
  FlowConditions given(n + 1);
  given.is_outlet[n] = 1;
  FlowSolution flow{ none, none, none, network.volumes(), 0. };
  const double full  = sum(flow.content);
  const double speed = gamma_w * 1e-8 / (12. * mu); // [m/s]
  const double dt    = 0.005 * length / speed;
  for (unsigned int step = 1; step <= 800; ++step)
  {
    flow = network.transient(given, dt, flow.content, none, flow.pressure);
    EXPECT_NEAR(flow.residual, 0., 1e-16);
    const double t = 0.005 * step; // in which full flow passes the joint
    double exact   = 1. - t;
    if (t > 8. / 9.)
    {
      const double s = 0.5 * (1. - std::sqrt(1. - 2. / (3. * t)));
      exact          = s - t * s * s * (3. - 2. * s);
    }
    EXPECT_NEAR(sum(flow.content) / full, exact, 0.015) << step;
  }
}

// Through a dam of a square grid of joints flows what the pressures at both
// sides give, wherever the free surface lies: horizontal flow is that of
// differences of pressure, whose sum over the height is linear across the dam
// (Dupuit's discharge, as Charny proved it).
TEST(FlowNetwork, DischargeOfADamIsDupuits)
{
  constexpr unsigned int n_x = 5, n_y = 10;
  const auto at = [](const unsigned int i, const unsigned int j)
  { return (n_y + 1) * i + j; };
  std::vector<double> elevation;
  std::vector<FlowChannel> channels;
  for (unsigned int i = 0; i <= n_x; ++i)
    for (unsigned int j = 0; j <= n_y; ++j)
    {
      elevation.push_back(j);
      if (i > 0)
        channels.push_back(
            { { at(i - 1, j), at(i, j) }, 1., 1., { 2e-4, 2e-4 } });
      if (j > 0)
        channels.push_back(
            { { at(i, j - 1), at(i, j) }, 1., 1., { 2e-4, 2e-4 } });
    }
  const FlowNetwork network(free_water, elevation, channels);
  FlowConditions given(network.n_nodes());
  const double above = 8.4, below = 2.;
  double pressures = 0.;
  for (unsigned int j = 0; j <= n_y; ++j)
  {
    // The reservoir, and tailwater below a face at which water comes out.
    const double high = std::max(0., above - j), low = std::max(0., below - j);
    given.is_given[at(0, j)]    = high > 0.;
    given.pressure[at(0, j)]    = gamma_w * high;
    given.is_given[at(n_x, j)]  = low > 0.;
    given.pressure[at(n_x, j)]  = gamma_w * low;
    given.is_outlet[at(n_x, j)] = low == 0.;
    pressures += gamma_w * (high - low);
  }
  const FlowSolution flow = network.steady(given, network.volumes());
  const double q          = conductance(2e-4, 1.) * pressures / n_x;
  double enters = 0., falls = 0.;
  for (unsigned int j = 0; j <= n_y; ++j)
  {
    enters += flow.inflow[at(0, j)];
    if (j > below)
      falls -= flow.inflow[at(n_x, j)];
  }
  EXPECT_NEAR(enters, q, 1e-10 * q);
  EXPECT_NEAR(flow.residual, 0., 1e-12 * q);
  // Some comes out above the tailwater, and joints above are empty.
  EXPECT_GT(falls, 0.05 * q);
  EXPECT_LT(flow.saturation[at(n_x - 1, n_y)], 1e-3);
  EXPECT_EQ(flow.saturation[at(n_x / 2, 0)], 1.);
}

// A wide crack across closed joints has the head of its mouth: water runs down
// behind it, from there through the joints, however different they are.
TEST(FlowNetwork, FreeSurfaceBesideAWideCrack)
{
  constexpr unsigned int n = 10;
  std::vector<double> elevation;
  std::vector<FlowChannel> channels;
  for (unsigned int j = 0; j <= n; ++j)
    for (unsigned int i = 0; i <= n; ++i)
    {
      elevation.push_back(j);
      const unsigned int at = (n + 1) * j + i;
      const double a        = j == 5 && i <= n / 2 ? 1e-2 : 1e-5;
      if (i > 0)
        channels.push_back({ { at - 1, at }, 1., 1., { a, a } });
      if (j > 0)
        channels.push_back({ { at - n - 1, at }, 1., 1., { 1e-5, 1e-5 } });
    }
  const FlowNetwork network(free_water, elevation, channels);
  FlowConditions given(network.n_nodes());
  for (unsigned int j = 0; j <= n; ++j)
  {
    given.is_given[(n + 1) * j]      = j < 8;
    given.pressure[(n + 1) * j]      = gamma_w * std::max(0., 8. - j);
    given.is_outlet[(n + 1) * j + n] = 1;
  }
  const FlowSolution flow = network.steady(given, network.volumes());
  const unsigned int tip  = (n + 1) * 5 + n / 2;
  EXPECT_NEAR(flow.pressure[tip], 3. * gamma_w, 1e-6 * gamma_w);
  double enters = 0.;
  for (const double inflow : flow.inflow)
    enters += std::max(0., inflow);
  EXPECT_NEAR(flow.residual, 0., 1e-10 * enters);
}
