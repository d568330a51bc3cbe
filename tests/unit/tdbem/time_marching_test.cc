// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/tdbem/time_marching.h>
#include <quoin/tdbem/direct_history.h>
#include <quoin/tdbem/influence_matrices.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cavity.h"

using namespace quoin;
using Eigen::VectorXd;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  struct March
  {
    InfluenceMatrices kernel;
    DirectHistory history;
    TimeMarching marching;

    March(const Boundary &boundary, const double dt,
          const std::vector<bool> &traction_is_given)
      : kernel(boundary, medium, dt), history(kernel),
        marching(kernel, history, traction_is_given)
    {
    }
  };

  double pulse(const double t)
  {
    return t < 2. ? std::pow(std::sin(0.5 * M_PI * t), 2) : 0.;
  }
} // namespace

/** The wall of a cavity, with pressure given, against the closed form. */
TEST(TimeMarching, pressurised_cavity)
{
  const double bounds[2] = { 3e-3, 5e-4 };
  for (unsigned k = 0; k < 2; ++k)
  {
    const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 32 << k, true);
    const double dt         = boundary.elements[0].length() / medium.c1;
    March run(boundary, dt, std::vector<bool>(boundary.n_unknowns(), true));
    const VectorXd p = test::unit_pressure(boundary);
    double error     = 0.;
    for (unsigned step = 1; step * dt * medium.c1 < 20.; ++step)
    {
      run.marching.step(p);
      const double u = 2. * medium.mu()
                       * test::radial_displacement(boundary, run.marching.u());
      error = std::max(
          error,
          std::abs(u - test::cavity_wall_displacement(medium, 1., step * dt)));
    }
    EXPECT_LT(error / 1.1914, bounds[k]);
  }
}

/** Tractions from the motion that they made: any mixture of conditions. */
TEST(TimeMarching, given_fields_can_be_exchanged)
{
  const Boundary boundary = Boundary::polygon(
      { { 0., 0. }, { 1., 0. }, { 1.2, 0.7 }, { 0.1, 0.6 } }, 0.25, true);
  const unsigned n = unsigned(boundary.n_unknowns());
  const double dt  = 0.15;
  std::vector<bool> all(n, true), some(n);
  std::mt19937 random(3);
  for (unsigned k = 0; k < n; ++k)
    some[k] = random() % 2 == 0;
  March first(boundary, dt, all), second(boundary, dt, some);
  for (unsigned step = 1; step < 60; ++step)
  {
    VectorXd given = VectorXd::Zero(n);
    given.head(4).setConstant(pulse(step * dt));
    first.marching.step(given);
    for (unsigned k = 0; k < n; ++k)
      given(k) = some[k] ? first.marching.p()(k) : first.marching.u()(k);
    second.marching.step(given);
    EXPECT_LT((first.marching.u() - second.marching.u()).norm(), 1e-8);
    EXPECT_LT((first.marching.p() - second.marching.p()).norm(), 1e-8);
  }
}

/** F = A u + C on the interface is what a step finds there. */
TEST(TimeMarching, condensation)
{
  // Interface at the bottom, loaded at the right, free elsewhere.
  const Boundary boundary = Boundary::polygon(
      { { 0., 0. }, { 1., 0. }, { 1., 1. }, { 0., 1. } }, 0.25, false);
  const unsigned n = unsigned(boundary.n_unknowns());
  std::vector<bool> traction_is_given(n, true);
  std::vector<unsigned> interface;
  for (unsigned k = 0; k < 8; ++k)
  {
    interface.push_back(k);
    traction_is_given[k] = false;
  }
  March run(boundary, 0.2, traction_is_given);
  const Eigen::MatrixXd A = run.marching.condensed_matrix(interface);
  EXPECT_EQ(A.rows(), 8);
  for (unsigned step = 1; step < 40; ++step)
  {
    const double t = 0.2 * step;
    VectorXd given = VectorXd::Zero(n);
    given.segment(8, 8).setConstant(0.1 * pulse(t - 1.));
    const VectorXd C = run.marching.condensed_load(interface, given);
    for (unsigned k = 0; k < 8; ++k)
      given(k) = 0.01 * (k % 3) * pulse(t);
    run.marching.step(given);
    const VectorXd expected = A * given.head(8) + C;
    EXPECT_LT((run.marching.p().head(8) - expected).norm(), 1e-12 * A.norm());
  }
}

/** A rigid interface with no mass: its stiffness is an impedance at first. */
TEST(TimeMarching, instantaneous_impedance)
{
  // Normal to itself an element radiates P waves, along itself S waves.
  const Boundary boundary = Boundary::polygon(
      { { 0., 0. }, { 9., 0. }, { 9., 9. }, { 0., 9. } }, 1., true);
  const unsigned n = unsigned(boundary.n_unknowns());
  const double dt  = 0.02 / medium.c1; // before neighbours matter
  March run(boundary, dt, std::vector<bool>(n, false));
  std::vector<unsigned> all(n);
  for (unsigned k = 0; k < n; ++k)
    all[k] = k;
  const Eigen::MatrixXd Z     = dt * run.marching.condensed_matrix(all);
  const unsigned e            = 4; // in the middle of a side
  const auto normal           = to_eigen(boundary.elements[e].normal());
  const Eigen::Matrix2d local = Z.block<2, 2>(2 * e, 2 * e);
  const double along_normal   = normal.dot(local * normal);
  EXPECT_NEAR(along_normal / (medium.density * medium.c1), 1., 0.02);
  EXPECT_NEAR((local.trace() - along_normal) / (medium.density * medium.c2), 1.,
              0.02);
}
