// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/water/flow_network.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{
  constexpr double mu = 1e-3, gamma_w = 1e4, kw = 2e9;
  const Fluid water{ mu, gamma_w, kw };

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
