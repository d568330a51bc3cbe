// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/node_update.h>

#include <deal.II/base/array_view.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace quoin;

namespace
{
  template <int dim>
  struct NodeSet
  {
    AlignedArray<NodeRecord<dim>> nodes;
    AlignedArray<dealii::Tensor<1, dim>> velocity, force, viscous;
    std::vector<double> mass, inverse_mass;

    explicit NodeSet(const unsigned int n, const unsigned int seed = 1)
    {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-1., 1.);
      const auto fill = [&](dealii::Tensor<1, dim> &values)
      {
        for (double &value : dealii::make_array_view(values))
          value = uniform(random);
      };
      nodes.resize(n);
      velocity.resize(n);
      force.resize(n);
      viscous.resize(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        fill(nodes[i].X);
        fill(nodes[i].u);
        fill(velocity[i]);
        fill(force[i]);
        fill(viscous[i]);
        mass.push_back(2. + uniform(random));
        inverse_mass.push_back(1. / mass.back());
      }
    }

    template <bool adaptive = false>
    DampingWork damped(const DampingFactors &factors, const double dt)
    {
      return advance_nodes_damped<adaptive>(
          0, nodes.size(), nodes.data(), velocity.data(), force.data(),
          viscous.data(), mass.data(), inverse_mass.data(), factors, dt);
    }
  };

  using Nodes = NodeSet<2>;
} // namespace

TEST(NodeUpdate, UndampedStep)
{
  Nodes set(5);
  const Nodes before       = set;
  const double dt_velocity = 0.3, dt = 0.4;
  advance_nodes(1, 4, set.nodes.data(), set.velocity.data(), set.force.data(),
                set.inverse_mass.data(), dt_velocity, dt);
  for (unsigned int i = 0; i < 5; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      const bool inside = i >= 1 && i < 4;
      const double v
          = before.velocity[i][d]
            + (inside ? dt_velocity * before.force[i][d] / before.mass[i] : 0.);
      EXPECT_NEAR(set.velocity[i][d], v, 1e-15);
      EXPECT_NEAR(set.nodes[i].u[d],
                  before.nodes[i].u[d] + (inside ? dt * v : 0.), 1e-15);
      EXPECT_EQ(set.nodes[i].X[d], before.nodes[i].X[d]);
      EXPECT_EQ(set.force[i][d], inside ? 0. : before.force[i][d]);
    }
}

TEST(NodeUpdate, MassDampingIsCentredInTime)
{
  // m (v1 - v0) / dt + alpha m (v1 + v0) / 2 = f + f_viscous.
  Nodes set(20);
  const Nodes before = set;
  const double alpha = 1.7, dt_before = 0.2, dt_velocity = 0.25, dt = 0.3;
  const auto work    = set.damped({ 0., alpha, dt_before, dt_velocity }, dt);
  double before_work = 0., after_work = 0.;
  for (unsigned int i = 0; i < 20; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double m = before.mass[i], v0 = before.velocity[i][d];
      const double fv = before.viscous[i][d];
      const double v1 = (v0 * (1. / dt_velocity - 0.5 * alpha)
                         + (before.force[i][d] + fv) / m)
                        / (1. / dt_velocity + 0.5 * alpha);
      EXPECT_NEAR(set.velocity[i][d], v1, 1e-14);
      EXPECT_NEAR(set.nodes[i].u[d], before.nodes[i].u[d] + dt * v1, 1e-14);
      EXPECT_EQ(set.force[i][d], 0.);
      EXPECT_EQ(set.viscous[i][d], 0.);
      const double drag = alpha * m * 0.5 * (v0 + v1) - fv;
      before_work += 0.5 * dt_before * drag * v0;
      after_work += 0.5 * dt * drag * v1;
    }
  EXPECT_NEAR(work.before, before_work, 1e-13);
  EXPECT_NEAR(work.after, after_work, 1e-13);
}

TEST(NodeUpdate, LocalDampingTakesAShareOfTheForce)
{
  // Where the velocity is large the damping force is the full share.
  Nodes set(20);
  const double c = 0.8, dt = 0.01;
  for (auto &v : set.velocity)
    v = dealii::Point<2>(3., -3.);
  for (auto &f : set.viscous)
    f = dealii::Point<2>(0., 0.);
  const Nodes before = set;
  set.damped({ c, 0., dt, dt }, dt);
  for (unsigned int i = 0; i < 20; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double f     = before.force[i][d];
      const double sense = before.velocity[i][d] > 0. ? 1. : -1.;
      EXPECT_NEAR(set.velocity[i][d],
                  before.velocity[i][d]
                      + dt / before.mass[i] * (f - sense * c * std::abs(f)),
                  1e-14);
    }
}

TEST(NodeUpdate, LocalDampingNeverReversesTheMeanVelocity)
{
  const double v0 = -0.3;
  for (const double v1 : { -2., -0.1, 0.2, 0.29, 0.31, 5. })
    for (const double strength : { 0., 0.01, 0.1, 100. })
    {
      const double taken = local_damping_velocity(strength, v0, v1);
      const double sum   = v0 + v1;
      EXPECT_LE(std::abs(taken), strength);
      EXPECT_GE(taken * sum, 0.);
      EXPECT_GE((sum - taken) * sum, 0.);
    }
  EXPECT_EQ(local_damping_velocity(0.1, 1., 2.), 0.1);
  EXPECT_EQ(local_damping_velocity(0.1, -1., -2.), -0.1);
  EXPECT_DOUBLE_EQ(local_damping_velocity(1e9, 1., 2.), 1.5);
}

TEST(NodeUpdate, LocalDampingNeverDoesPositiveWork)
{
  // Node by node, with forces that change sign every step as at the critical
  // step, and mass damping beside it.
  for (const double alpha : { 0., 0.5 })
    for (unsigned int seed = 0; seed < 200; ++seed)
    {
      Nodes set(1, seed);
      set.viscous[0] = dealii::Point<2>(0., 0.);
      double taken   = 0.;
      for (unsigned int step = 0; step < 5; ++step)
      {
        const auto work = set.damped({ 0.8, alpha, 0.1, 0.1 }, 0.1);
        EXPECT_GE(work.before + work.after, 0.);
        taken += work.before + work.after;
        set.force[0] = dealii::Point<2>(-70. * set.velocity[0][0],
                                        -20. * set.velocity[0][1]);
      }
      EXPECT_GT(taken, 0.);
    }
}

TEST(NodeUpdate, WhatDampingTakesIsMissingFromTheKineticEnergy)
{
  // 1/2 m (v1^2 - v0^2) = force power - damping, with equal steps.
  Nodes set(50);
  const Nodes before = set;
  const double dt    = 0.2;
  const auto work    = set.damped<true>({ 0.7, 1.3, dt, dt }, dt);
  double change = 0., power = 0., mass_power = 0.;
  for (unsigned int i = 0; i < 50; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double v0 = before.velocity[i][d], v1 = set.velocity[i][d];
      change += 0.5 * before.mass[i] * (v1 * v1 - v0 * v0);
      power += 0.5 * dt * before.force[i][d] * (v0 + v1);
      mass_power += before.mass[i] * 0.25 * (v0 + v1) * (v0 + v1);
    }
  EXPECT_NEAR(change, power - work.before - work.after, 1e-13);
  EXPECT_NEAR(work.kinetic_change, change, 1e-13);
  EXPECT_NEAR(work.mass_power, mass_power, 1e-13);
}

TEST(NodeUpdate, ZeroFactorsAreUndamped)
{
  Nodes damped(30);
  for (auto &f : damped.viscous)
    f = dealii::Point<2>(0., 0.);
  Nodes undamped  = damped;
  const auto work = damped.damped({ 0., 0., 0.1, 0.15 }, 0.2);
  advance_nodes(0, 30, undamped.nodes.data(), undamped.velocity.data(),
                undamped.force.data(), undamped.inverse_mass.data(), 0.15, 0.2);
  for (unsigned int i = 0; i < 30; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(damped.velocity[i][d], undamped.velocity[i][d], 1e-15);
      EXPECT_NEAR(damped.nodes[i].u[d], undamped.nodes[i].u[d], 1e-15);
    }
  EXPECT_EQ(work.before, 0.);
  EXPECT_EQ(work.after, 0.);
}

TEST(NodeUpdate, NodesBesideEachOtherMoveAsOneByOne)
{
  // Without forces of viscous damping there is no array of them.
  const DampingFactors factors{ 0.8, 0.5, 0.1, 0.15 };
  for (const bool has_viscous : { true, false })
  {
    NodeSet<2> together(11), alone(11);
    DampingWork sum;
    const auto advance
        = [&](NodeSet<2> &set, const unsigned int begin, const unsigned int end)
    {
      return advance_nodes_damped<true>(
          begin, end, set.nodes.data(), set.velocity.data(), set.force.data(),
          has_viscous ? set.viscous.data() : nullptr, set.mass.data(),
          set.inverse_mass.data(), factors, 0.2);
    };
    const auto work = advance(together, 0, 11);
    for (unsigned int i = 0; i < 11; ++i)
      sum += advance(alone, i, i + 1);
    for (unsigned int i = 0; i < 11; ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        EXPECT_NEAR(together.velocity[i][d], alone.velocity[i][d], 1e-15);
        EXPECT_NEAR(together.nodes[i].u[d], alone.nodes[i].u[d], 1e-15);
        EXPECT_EQ(together.force[i][d], 0.);
        EXPECT_EQ(together.viscous[i][d] == 0., has_viscous);
      }
    EXPECT_NEAR(work.before, sum.before, 1e-14);
    EXPECT_NEAR(work.after, sum.after, 1e-14);
    EXPECT_NEAR(work.mass_power, sum.mass_power, 1e-14);
    EXPECT_NEAR(work.kinetic_change, sum.kinetic_change, 1e-14);
  }
}

TEST(NodeUpdate, ConstrainedNodesKeepTheirVelocity)
{
  Nodes set(4);
  set.mass[2] = set.inverse_mass[2] = 0.;
  const dealii::Tensor<1, 2> v      = set.velocity[2];
  Nodes undamped                    = set;
  const auto all = set.damped<true>({ 0.8, 2., 0.1, 0.1 }, 0.1);
  EXPECT_EQ(set.velocity[2][0], v[0]);
  EXPECT_EQ(set.velocity[2][1], v[1]);
  EXPECT_EQ(set.force[2][0], 0.);

  advance_nodes(0, 4, undamped.nodes.data(), undamped.velocity.data(),
                undamped.force.data(), undamped.inverse_mass.data(), 0.1, 0.1);
  EXPECT_EQ(undamped.velocity[2][0], v[0]);
  EXPECT_EQ(undamped.velocity[2][1], v[1]);
  EXPECT_NE(undamped.velocity[1][0], v[0]);

  // It counts in none of the sums.
  Nodes others(4);
  others.force[2] = others.viscous[2] = others.velocity[2]
      = dealii::Point<2>(0., 0.);
  const auto rest = others.damped<true>({ 0.8, 2., 0.1, 0.1 }, 0.1);
  EXPECT_DOUBLE_EQ(all.before, rest.before);
  EXPECT_DOUBLE_EQ(all.after, rest.after);
  EXPECT_DOUBLE_EQ(all.mass_power, rest.mass_power);
  EXPECT_DOUBLE_EQ(all.kinetic_change, rest.kinetic_change);
}

TEST(NodeUpdate, ThreeComponents)
{
  NodeSet<3> set(7), damped(7);
  const NodeSet<3> before  = set;
  const double dt_velocity = 0.3, dt = 0.4;
  advance_nodes(1, 6, set.nodes.data(), set.velocity.data(), set.force.data(),
                set.inverse_mass.data(), dt_velocity, dt);
  // Mass-proportional damping alone: m (v1 - v0) / dt = f + fv - alpha m mean.
  const double alpha = 0.8;
  const auto work    = damped.damped<true>({ 0., alpha, dt, dt }, dt);
  double taken = 0., power = 0., change = 0.;
  for (unsigned int i = 0; i < 7; ++i)
    for (unsigned int d = 0; d < 3; ++d)
    {
      const bool inside = i >= 1 && i < 6;
      const double m = before.mass[i], f = before.force[i][d],
                   v0 = before.velocity[i][d];
      const double v  = v0 + (inside ? dt_velocity * f / m : 0.);
      EXPECT_NEAR(set.velocity[i][d], v, 1e-15);
      EXPECT_NEAR(set.nodes[i].u[d],
                  before.nodes[i].u[d] + (inside ? dt * v : 0.), 1e-15);
      EXPECT_EQ(set.nodes[i].X[d], before.nodes[i].X[d]);
      EXPECT_EQ(set.force[i][d], inside ? 0. : f);

      const double fv = before.viscous[i][d], v1 = damped.velocity[i][d];
      EXPECT_NEAR(m * (v1 - v0) / dt, f + fv - alpha * m * 0.5 * (v0 + v1),
                  1e-13);
      EXPECT_NEAR(damped.nodes[i].u[d], before.nodes[i].u[d] + dt * v1, 1e-15);
      EXPECT_EQ(damped.force[i][d], 0.);
      EXPECT_EQ(damped.viscous[i][d], 0.);
      taken += 0.5 * dt * (alpha * m * 0.5 * (v0 + v1) - fv) * (v0 + v1);
      power += 0.25 * m * (v0 + v1) * (v0 + v1);
      change += 0.5 * m * (v1 * v1 - v0 * v0);
    }
  EXPECT_NEAR(work.before + work.after, taken, 1e-13);
  EXPECT_NEAR(work.mass_power, power, 1e-13);
  EXPECT_NEAR(work.kinetic_change, change, 1e-13);
}
