// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What every solution in time must satisfy whatever the formulation: its
// static limit, the speed of the P wave, reciprocity, convergence at corners.

#include <quoin/base/packed_vectors.h>
#include <quoin/tdbem/time_marching.h>
#include <quoin/tdbem/formulation.h>
#include <quoin/tdbem/static_solver.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

using namespace quoin;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  /** A square hole with sides of 1 m around the origin. */
  Boundary square_hole(const unsigned elements_per_side)
  {
    return Boundary::polygon(
        { { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } },
        1. / elements_per_side, true);
  }

  VectorXd
  pressure(const Boundary &boundary,
           const std::function<double(const dealii::Point<2> &)> &value)
  {
    VectorXd p(boundary.n_unknowns());
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
      set_vector(p, e,
                 -value(boundary.elements[e].middle())
                     * boundary.elements[e].normal());
    return p;
  }

  /** On the side x = 1/2. */
  VectorXd one_side(const Boundary &boundary)
  {
    return pressure(boundary, [](const dealii::Point<2> &x)
                    { return x[0] > 0.499 ? 1. : 0.; });
  }

  /** A marching and what it needs, its steps kept as columns. */
  class Solution
  {
  public:
    Solution(const Boundary &boundary, const double beta,
             const bool traction_given, const unsigned n_steps,
             const Formulation formulation = Formulation::galerkin)
      : n_steps(n_steps)
    {
      options.formulation = formulation;
      options.time_step   = beta * boundary.elements[0].length() / medium.c1;
      options.n_steps     = n_steps;
      kernel              = make_lag_kernel(boundary, medium, options);
      history  = make_history(*kernel, boundary, options, MPI_COMM_SELF);
      marching = std::make_unique<TimeMarching>(
          *kernel, *history,
          std::vector<bool>(boundary.n_unknowns(), traction_given));
      u.resize(kernel->size(), n_steps);
      p.resize(kernel->size(), n_steps);
    }

    /** The given field is @p shape times @p value of the step's end. */
    void operator()(const VectorXd &shape,
                    const std::function<double(double)> &value)
    {
      for (unsigned step = 0; step < n_steps; ++step)
      {
        marching->step(value((step + 1) * time_step()) * shape);
        u.col(step) = marching->u();
        p.col(step) = marching->p();
      }
    }

    double time_step() const
    {
      return options.time_step;
    }

    MatrixXd u, p;

  private:
    unsigned n_steps;
    FormulationOptions options;
    std::unique_ptr<InfluenceKernel> kernel;
    std::unique_ptr<BoundaryHistory> history;
    std::unique_ptr<TimeMarching> marching;
  };

  /** From 0 to 1 in @p duration, smoothly. */
  std::function<double(double)> ramp(const double duration)
  {
    return [duration](const double time)
    {
      const double s = std::min(1., time / duration);
      return s * s * (3. - 2. * s);
    };
  }

  StaticConditions conditions(const VectorXd &values,
                              const bool displacement_known)
  {
    return { values,
             std::vector<bool>(std::size_t(values.size()), displacement_known),
             {} };
  }

  /** Without the mean of each component; all elements are equally long. */
  VectorXd without_mean(VectorXd u)
  {
    for (const unsigned i : { 0u, 1u })
    {
      double mean = 0.;
      for (Eigen::Index k = i; k < u.size(); k += 2)
        mean += 2. * u(k) / double(u.size());
      for (Eigen::Index k = i; k < u.size(); k += 2)
        u(k) -= mean;
    }
    return u;
  }

  double relative(const VectorXd &value, const VectorXd &reference)
  {
    return (value - reference).norm() / reference.norm();
  }

  /** How much further the side x = 1/2 has moved than the one opposite [m]. */
  double opening(const Boundary &boundary, const VectorXd &u)
  {
    double sum = 0.;
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
    {
      const double x = boundary.elements[e].middle()[0];
      if (std::abs(x) > 0.499)
        sum += u(2 * e) * boundary.elements[e].length() * (x > 0. ? 1. : -1.);
    }
    return sum;
  }
} // namespace

class StaticLimit : public testing::TestWithParam<Formulation>
{
};

INSTANTIATE_TEST_SUITE_P(Formulations, StaticLimit,
                         testing::Values(Formulation::galerkin,
                                         Formulation::convolution_quadrature));

/** Long after the load has come to rest: Kelvin's equations. */
TEST_P(StaticLimit, of_given_tractions)
{
  const Boundary boundary = square_hole(4);
  const VectorXd all
      = pressure(boundary, [](const dealii::Tensor<1, 2> &) { return 1.; });
  const auto p_static = solve_static(boundary, medium, Projection::galerkin,
                                     conditions(all, false));
  Solution run(boundary, 1., true, 400, GetParam());
  run(all, ramp(3.));
  const double error = relative(run.u.rightCols<1>(), p_static.displacement);
  EXPECT_LT(error, 1e-4);

  // The resultant pushes everything away for ever, but more and more uniformly.
  const VectorXd load = one_side(boundary);
  const auto expected = solve_static(boundary, medium, Projection::galerkin,
                                     conditions(load, false));
  Solution pushed(boundary, 1., true, 400, GetParam());
  pushed(load, ramp(3.));
  const double relative_motion = relative(without_mean(pushed.u.rightCols<1>()),
                                          without_mean(expected.displacement));
  EXPECT_LT(relative_motion, 2e-4);
  EXPECT_GT(pushed.u.rightCols<1>().norm(), 1.1 * pushed.u.col(200).norm());
}

TEST_P(StaticLimit, of_given_motion)
{
  // A square that grows has no resultant. Tractions are singular at corners.
  const Boundary boundary = square_hole(4);
  VectorXd motion(boundary.n_unknowns());
  for (unsigned e = 0; e < boundary.n_elements(); ++e)
    set_vector<2>(motion, e, boundary.elements[e].middle());
  const auto expected = solve_static(boundary, medium, Projection::galerkin,
                                     conditions(motion, true));
  Solution run(boundary, 1., false, 400, GetParam());
  run(motion, ramp(3.));
  const double error = relative(run.p.rightCols<1>(), expected.traction);
  EXPECT_LT(error, 1e-4);
}

/** Nothing is faster than the P wave: exactly from one hole to another. */
TEST(TimeMarchingLimits, causality)
{
  Boundary boundary      = square_hole(5);
  const unsigned n_first = unsigned(boundary.n_unknowns());
  const VectorXd load    = one_side(boundary);
  const double distance  = 1.2;
  for (BoundaryElement element : square_hole(5).elements)
  {
    element.a[0] += 1. + distance;
    element.b[0] += 1. + distance;
    boundary.elements.push_back(element);
  }
  VectorXd both      = VectorXd::Zero(2 * n_first);
  both.head(n_first) = load;
  Solution run(boundary, 0.7, true, 25);
  run(both, [](double) { return 1.; });
  const double peak = run.u.cwiseAbs().maxCoeff();
  for (unsigned step = 0; step < 25; ++step)
  {
    const double arrival = distance / (medium.c1 * run.time_step()); // in steps
    const double other   = run.u.col(step).tail(n_first).cwiseAbs().maxCoeff();
    if (step + 1 <= arrival)
    {
      EXPECT_EQ(other, 0.);
    }
    else if (step + 1 > arrival + 2.)
    {
      EXPECT_GT(other, 1e-4 * peak);
    }
  }
}

/** Around one hole but for the reach of an implicit step, a few elements. */
TEST(TimeMarchingLimits, causality_along_a_boundary)
{
  const Boundary boundary = square_hole(16);
  Solution run(boundary, 1., true, 40);
  run(one_side(boundary), [](double) { return 1.; });
  double early = 0., late = 0.;
  for (unsigned step = 0; step < 40; ++step)
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
      if (boundary.elements[e].middle()[0] < -0.499)
      {
        double &greatest = step < 13 ? early : late;
        greatest = std::max(greatest, run.u.col(step).segment<2>(2 * e).norm());
      }
  EXPECT_LT(early, 1e-4 * late);
}

/**
 * Betti in time: the tractions of one state do as much work on the
 * displacements of the other, one of them reversed in time, as vice versa.
 */
TEST(TimeMarchingLimits, reciprocity)
{
  const auto mismatch = [](const unsigned per_side, const bool traction_given)
  {
    const Boundary boundary = square_hole(per_side);
    const double length     = boundary.elements[0].length();
    VectorXd first(boundary.n_unknowns()), second(boundary.n_unknowns());
    for (unsigned e = 0; e < boundary.n_elements(); ++e)
    {
      const dealii::Point<2> x = boundary.elements[e].middle();
      set_vector<2>(first, e, dealii::Point<2>(1. + x[0], x[1] * x[1]));
      set_vector<2>(second, e, dealii::Point<2>(x[0] * x[1], std::exp(-x[0])));
    }
    const unsigned n_steps = 6 * per_side;
    Solution one(boundary, 1., traction_given, n_steps);
    Solution two(boundary, 1., traction_given, n_steps);
    one(first,
        [](const double time) { return std::pow(std::sin(1.3 * time), 2); });
    two(second,
        [](const double time) { return time * time * std::exp(-time); });
    double greatest = 0., size = 0.;
    for (unsigned step = 0; step < n_steps; ++step)
    {
      double left = 0., right = 0.;
      for (unsigned k = 0; k <= step; ++k)
      {
        left += length * one.p.col(k).dot(two.u.col(step - k));
        right += length * two.p.col(k).dot(one.u.col(step - k));
      }
      greatest = std::max(greatest, std::abs(left - right));
      size     = std::max(size, std::abs(left));
    }
    return greatest / size;
  };
  for (const bool traction_given : { true, false })
  {
    const double coarse = mismatch(4, traction_given);
    const double fine   = mismatch(8, traction_given);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_LT(fine, (traction_given ? 0.5 : 0.9) * coarse);
  }
}

/** Tractions that jump at two corners, in motion and at rest. */
TEST(TimeMarchingLimits, pressure_on_one_side)
{
  const auto solve = [](const unsigned per_side)
  {
    const Boundary boundary = square_hole(per_side);
    const VectorXd load     = one_side(boundary);
    // Until the waves have crossed three sides, c_1 dt = L.
    Solution run(boundary, 1., true, 3 * per_side);
    run(load, [](double) { return 1.; });
    const auto at_rest = solve_static(boundary, medium, Projection::galerkin,
                                      conditions(load, false));
    return dealii::Point<2>(opening(boundary, run.u.rightCols<1>()),
                            opening(boundary, at_rest.displacement));
  };
  const dealii::Tensor<1, 2> coarse = solve(6), middle = solve(12),
                             fine = solve(24);
  for (const unsigned k : { 0u, 1u })
  {
    // The corners leave order one.
    const double first = std::abs(middle[k] - coarse[k]);
    const double last  = std::abs(fine[k] - middle[k]);
    EXPECT_LT(last, 0.65 * first);
    EXPECT_LT(last, 0.01 * std::abs(fine[k]));
  }
}
