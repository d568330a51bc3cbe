// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// SpaceJoints::linearise(): against add_forces() and differences, along random
// paths through the branches of the laws.

#include "space_stack.h"

#include <quoin/joint_elements/joint_tangent.h>

#include <deal.II/lac/full_matrix.h>

#include <gtest/gtest.h>

using namespace quoin;
using namespace quoin::test;
using namespace quoin::test::space_stack;

namespace
{
  /** What the elements add up to; the last row: the inelastic volume. */
  struct Sums
  {
    std::vector<double> force;
    dealii::FullMatrix<double> stiffness;
    double inelastic = 0.;
    std::vector<double> gradient;

    explicit Sums(const unsigned int n)
      : force(n, 0.), stiffness(n, n), gradient(n, 0.)
    {
    }
  };

  Sums linearised(const Stack &stack, State<3> state, State<3> *end = nullptr,
                  const bool with_stiffness = true)
  {
    const unsigned int n = 3 * state.nodes.size();
    Sums sums(n);
    state.add<BreakingJoints<3>>().points.assign(stack.joints.n_points(), 1);
    stack.joints.linearise(
        state, with_stiffness,
        [&](const ElementLinearisation<3> &element)
        {
          const auto dof = [&](const unsigned int i)
          { return 3 * element.nodes[i / 3] + i % 3; };
          sums.inelastic += element.inelastic;
          for (unsigned int i = 0; i < 3 * element.n_nodes; ++i)
          {
            sums.force[dof(i)] += element.force[i];
            sums.gradient[dof(i)] += element.inelastic_gradient[i];
            for (unsigned int j = 0; j < 3 * element.n_nodes; ++j)
              sums.stiffness(dof(i), dof(j))
                  += element.stiffness[i * element.row_length + j];
          }
        });
    if (end)
      *end = state;
    return sums;
  }

  /** Largest errors of the derivatives, by the elastic stiffness and by the
      area, where both one-sided differences agree. */
  struct Errors
  {
    double stiffness = 0., gradient = 0.;
    unsigned int n_smooth = 0, n_kinks = 0;
  };

  void add_errors(const Stack &stack, const State<3> &state, const double h,
                  Errors &errors)
  {
    const Sums here      = linearised(stack, state);
    const unsigned int n = here.force.size();
    const double area = stack.joints.faces()[0].area, scale = area * kn;
    for (unsigned int j = 0; j < n; ++j)
    {
      std::vector<std::vector<double>> slopes;
      for (const double side : { h, -h })
      {
        State<3> moved    = state;
        double &u         = moved.nodes[j / 3].u[j % 3];
        const double from = u;
        u += side;
        const Sums there = linearised(stack, moved);
        slopes.emplace_back();
        for (unsigned int i = 0; i < n; ++i)
          slopes.back().push_back((there.force[i] - here.force[i]) / (u - from)
                                  / scale);
        slopes.back().push_back((there.inelastic - here.inelastic) / (u - from)
                                / area);
      }
      double kink = 0.;
      for (unsigned int i = 0; i <= n; ++i)
        kink = std::max(kink, std::abs(slopes[0][i] - slopes[1][i]));
      if (kink > 0.01)
      {
        ++errors.n_kinks;
        continue;
      }
      ++errors.n_smooth;
      const auto mean = [&](const unsigned int i)
      { return 0.5 * (slopes[0][i] + slopes[1][i]); };
      for (unsigned int i = 0; i < n; ++i)
        errors.stiffness = std::max(
            errors.stiffness, std::abs(here.stiffness(i, j) / scale + mean(i)));
      errors.gradient = std::max(errors.gradient,
                                 std::abs(here.gradient[j] / area - mean(n)));
    }
  }
} // namespace

TEST(SpaceJointTangent, ForcesAreThoseOfExplicitSteps)
{
  for (const JointLaw &law : all_laws())
  {
    if (std::visit([](const auto &own)
                   { return std::decay_t<decltype(own)>::waits; },
                   law)
        && can_fail(law))
      continue; // loses strength where it is told to
    Stack stack(law);
    for (unsigned int step = 0; step < 20; ++step)
    {
      stack.shake(2e-4, step);
      if (step == 10) // as if blocks had been placed there
        stack.history().placed_slip.assign(2 * stack.joints.n_points(), 1e-4);
      State<3> end;
      const bool with_stiffness = step % 2 == 0;
      const Sums sums = linearised(stack, stack.state, &end, with_stiffness);
      stack.energy    = EnergyAccounts();
      stack.update();
      double scale = 0., error = 0.;
      for (unsigned int i = 0; i < sums.force.size(); ++i)
      {
        scale = std::max(scale, std::abs(stack.force[i / 3][i % 3]));
        error = std::max(error,
                         std::abs(sums.force[i] - stack.force[i / 3][i % 3]));
      }
      EXPECT_GT(scale, 0.);
      EXPECT_LT(error, 1e-12 * scale);
      EXPECT_NEAR(end.energy.friction + end.energy.fracture
                      + end.energy.crushing,
                  stack.lost(), 1e-12 * (1. + std::abs(stack.lost())));
    }
  }
}

TEST(SpaceJointTangent, StiffnessIsTheDerivativeOfTheForces)
{
  for (const JointLaw &law : all_laws())
  {
    Stack stack(law);
    Errors errors;
    for (unsigned int step = 0; step < 12; ++step)
    {
      // The whole turns, too, by up to a radian.
      const Matrix turn = rotation(Vector({ 0.2, -0.1, 0.3 }));
      for (unsigned int i = 0; i < stack.state.nodes.size(); ++i)
        stack.place(i, turn * stack.position(i));
      stack.shake(step % 3 == 0 ? 2e-5 : 1e-3, 50 + step);
      add_errors(stack, stack.state, 1e-8, errors);
      State<3> end;
      linearised(stack, stack.state, &end);
      stack.history() = end.get<SpaceJointHistory>();
    }
    EXPECT_LT(errors.stiffness, 2e-5);
    EXPECT_LT(errors.gradient, 2e-5);
    EXPECT_GT(errors.n_smooth, 8 * errors.n_kinks);
  }
}

TEST(SpaceJointTangent, AnElasticJointHasASymmetricStiffness)
{
  Stack stack(elastic());
  const Matrix turn = rotation(Vector({ 0.5, 0.4, -0.3 }));
  for (unsigned int i = 0; i < stack.state.nodes.size(); ++i)
    stack.place(i, turn * stack.position(i));
  stack.shake(1e-2);
  const Sums sums = linearised(stack, stack.state);
  double skew = 0., size = 0.;
  for (unsigned int i = 0; i < sums.force.size(); ++i)
    for (unsigned int j = 0; j < i; ++j)
    {
      skew = std::max(skew,
                      std::abs(sums.stiffness(i, j) - sums.stiffness(j, i)));
      size = std::max(size, std::abs(sums.stiffness(i, j)));
    }
  EXPECT_LT(skew, 1e-12 * size);
}

TEST(SpaceJointTangent, AnIntactBrittleJointWaits)
{
  Stack stack(coulomb());
  const Vector n
      = joint_frame(stack.joints.faces()[0], stack.state.nodes.data()).n;
  for (unsigned int i = 0; i < stack.state.nodes.size(); ++i)
    if (stack.is_high(i))
      stack.state.nodes[i].u += 1e-3 * n;
  State<3> state = stack.state;
  state.add<BreakingJoints<3>>().points.assign(stack.joints.n_points(), 0);
  stack.joints.linearise(state, false, [](const ElementLinearisation<3> &) {});
  // kn times 1 mm of opening above a tensile strength of 0.4 MPa.
  for (unsigned int p = 0; p < stack.joints.n_points(); ++p)
  {
    EXPECT_EQ(state.get<SpaceJointHistory>().state[p], JointState::intact);
    EXPECT_NEAR(excess(stack.joints, p, state.get<SpaceJointHistory>()),
                (8e6 - 0.4e6) / 8e6, 1e-6);
  }
}
