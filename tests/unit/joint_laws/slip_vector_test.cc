// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Joint laws where slip is a vector: joints of bodies in three dimensions.

#include "composite_walk.h"
#include "rock_walk.h"

#include <quoin/joint_laws/composite_law.h>
#include <quoin/joint_laws/coulomb_law.h>
#include <quoin/joint_laws/slip_weakening_law.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace quoin;

namespace
{
  /** Opening and slip [m]. */
  template <int dim>
  struct Gap
  {
    double opening = 0.;
    Slip<dim> slip{};
  };

  Slip<3> along(const double angle, const double size)
  {
    Slip<3> slip;
    slip[0] = size * std::cos(angle);
    slip[1] = size * std::sin(angle);
    return slip;
  }

  Slip<3> turned(const Slip<3> &slip, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    Slip<3> result;
    result[0] = c * slip[0] - s * slip[1];
    result[1] = s * slip[0] + c * slip[1];
    return result;
  }

  CoulombLaw dilatant_coulomb()
  {
    CoulombLaw law;
    law.normal_stiffness            = 8e9;
    law.shear_stiffness             = 3e9;
    law.peak                        = { 1e6, 0.75, 0.4e6 };
    law.residual                    = { 0.1e6, 0.6, 0.05e6 };
    law.dilation                    = 0.3;
    law.critical_shear_displacement = 3e-3;
    return law;
  }

  std::vector<CompositeLaw> composite_laws()
  {
    CompositeLaw closing = composite_test::dilatant();
    closing.cracks_close = true;
    return { composite_test::wall(), composite_test::dilatant(), closing };
  }

  SlipWeakeningLaw fault()
  {
    SlipWeakeningLaw law;
    law.normal_stiffness  = 8e9;
    law.shear_stiffness   = 3e9;
    law.cohesion          = 0.5e6;
    law.residual_cohesion = 0.1e6;
    law.friction          = 0.7;
    law.residual_friction = 0.4;
    law.weakening_slip    = 5e-3;
    return law;
  }

  /** Laws of rock joints, whose closures are straight if @p exact: others
      leave the trapezoidal error of their curve to the energy residual. */
  BartonBandisLaw rough_joint(const bool exact = false)
  {
    BartonBandisLaw law = rock_test::rough();
    if (exact)
      law.closure = HyperbolicClosure(10e9, 0.3e-3, 10e9);
    return law;
  }
  ContinuouslyYieldingLaw yielding_joint(const bool exact = false)
  {
    ContinuouslyYieldingLaw law = rock_test::yielding(exact ? 0. : 0.4);
    if (exact)
      law.closure = PowerClosure({ 20e9, 0., 1e6, 1e4, 1e8 });
    return law;
  }

  double total(const JointDissipation &lost)
  {
    return lost.friction + lost.fracture + lost.crushing;
  }

  /** Moves a point and keeps the books, by the trapezoidal rule. */
  template <typename Law, int dim>
  struct Walk
  {
    Law law;
    typename Law::template Point<dim> point{};
    Gap<dim> gap{};
    double work = 0., turnover = 0., lost = 0., least = 0.;

    void move(const Gap<dim> &next)
    {
      const double sigma  = point.normal_traction;
      const Slip<dim> tau = point.shear_traction;
      const double gone   = total(law.update(point, next.opening, next.slip));
      const double by_opening = 0.5 * (sigma + point.normal_traction)
                                * (next.opening - gap.opening);
      const double by_slip
          = 0.5 * (tau + point.shear_traction) * (next.slip - gap.slip);
      work += by_opening + by_slip;
      turnover += std::abs(by_opening) + std::abs(by_slip);
      lost += gone;
      least = std::min(least, gone);
      gap   = next;
    }

    /** In a straight line. */
    void go(const Gap<dim> &end, const unsigned int n_steps)
    {
      const Gap<dim> start = gap;
      for (unsigned int i = 1; i <= n_steps; ++i)
      {
        const double share = double(i) / n_steps;
        move({ start.opening + share * (end.opening - start.opening),
               start.slip + share * (end.slip - start.slip) });
      }
    }
  };

  /** Corners of a random path; @p low and @p high opening, @p reach of slip. */
  std::vector<Gap<3>> random_path(const double low, const double high,
                                  const double reach)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0., 1.);
    std::vector<Gap<3>> path;
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double opening = low + (high - low) * uniform(random);
      const double angle   = 2. * M_PI * uniform(random);
      path.push_back({ opening, along(angle, reach * uniform(random)) });
    }
    return path;
  }

  /** A path that is turned turns the tractions, and nothing else. */
  template <typename Law>
  void expect_isotropic(const Law &law, const std::vector<Gap<3>> &path)
  {
    constexpr double angle = 1.234;
    Walk<Law, 3> walk{ law }, other{ law };
    double largest = 0.;
    for (const Gap<3> &gap : path)
    {
      walk.go(gap, 20);
      other.go({ gap.opening, turned(gap.slip, angle) }, 20);
      const auto &a = walk.point, &b = other.point;
      largest = std::max(
          { largest, std::abs(a.normal_traction), a.shear_traction.norm() });
      const double tolerance = 1e-9 * largest;
      EXPECT_NEAR(a.normal_traction, b.normal_traction, tolerance);
      EXPECT_LE((turned(a.shear_traction, angle) - b.shear_traction).norm(),
                tolerance);
      EXPECT_EQ(a.state, b.state);
    }
    EXPECT_GT(largest, 0.);
  }

  /** Along a line through the origin it is the law of two dimensions. */
  template <typename Law>
  void expect_as_in_two_dimensions(const Law &law,
                                   const std::vector<Gap<3>> &path)
  {
    constexpr double angle = 2.2;
    Walk<Law, 2> flat{ law };
    Walk<Law, 3> walk{ law };
    for (const Gap<3> &gap : path)
    {
      const double slip = gap.slip[0];
      flat.go({ gap.opening, slip }, 20);
      walk.go({ gap.opening, along(angle, slip) }, 20);
      const auto &a = flat.point;
      const auto &b = walk.point;
      const double tolerance
          = 1e-9 * (std::abs(a.normal_traction) + std::abs(a.shear_traction))
            + 1e-3;
      EXPECT_NEAR(a.normal_traction, b.normal_traction, tolerance);
      EXPECT_LE((along(angle, a.shear_traction) - b.shear_traction).norm(),
                tolerance);
      EXPECT_NEAR(a.plastic_opening, b.plastic_opening, 1e-13);
      EXPECT_EQ(a.state, b.state);
    }
    EXPECT_NEAR(flat.lost, walk.lost, 1e-9 * flat.lost);
  }

  /** Work is stored or dissipated, and no step gives energy but for that
      @p share of all that was turned over where it jumps across the elastic
      range. */
  template <typename Law>
  void expect_balance(const Law &law, const std::vector<Gap<3>> &path,
                      const double share)
  {
    Walk<Law, 3> walk{ law };
    for (const Gap<3> &gap : path)
      walk.go(gap, 200);
    const double stored = law.stored_energy(walk.point, walk.gap.opening);
    EXPECT_NEAR(walk.work, stored + walk.lost, 1e-12 * walk.turnover);
    EXPECT_GT(walk.lost, 0.5 * walk.work);
    EXPECT_GE(walk.least, -share * walk.turnover);
  }

  /** Entries of the tangent, by opening and both slips. */
  std::array<std::array<double, 3>, 3> entries(const JointTangent<3> &t)
  {
    std::array<std::array<double, 3>, 3> result;
    result[0] = { t.normal_opening, t.normal_slip[0], t.normal_slip[1] };
    for (const unsigned int d : { 0U, 1U })
      result[d + 1]
          = { t.shear_opening[d], t.shear_slip[d][0], t.shear_slip[d][1] };
    return result;
  }

  /** The tangent against differences from both sides, where these agree. */
  template <typename Law>
  void expect_consistent_tangent(const Law &law,
                                 const std::vector<Gap<3>> &path)
  {
    using Point            = typename Law::template Point<3>;
    constexpr double scale = 1e10, h = 1e-12;
    const auto difference = [&](const Point &start, const Gap<3> &gap,
                                const unsigned int by, const double step)
    {
      const auto tractions = [&](const double size)
      {
        Point point = start;
        Gap<3> next = gap;
        (by == 0 ? next.opening : next.slip[by - 1]) += size;
        law.update(point, next.opening, next.slip);
        return std::array<double, 3>{ point.normal_traction,
                                      point.shear_traction[0],
                                      point.shear_traction[1] };
      };
      const auto a = tractions(0.), b = tractions(step);
      return std::array<double, 3>{ (b[0] - a[0]) / step, (b[1] - a[1]) / step,
                                    (b[2] - a[2]) / step };
    };
    unsigned int n_checked = 0, n_sliding = 0;
    Point point;
    Gap<3> last;
    for (const Gap<3> &end : path)
      for (unsigned int i = 1; i <= 20; ++i)
      {
        const Gap<3> gap{ last.opening
                              + 0.05 * i * (end.opening - last.opening),
                          last.slip + 0.05 * i * (end.slip - last.slip) };
        Point next = point, same = point;
        JointTangent<3> tangent;
        law.update(next, gap.opening, gap.slip, tangent);
        law.update(same, gap.opening, gap.slip);
        EXPECT_EQ(next.normal_traction, same.normal_traction);
        for (const unsigned int by : { 0U, 1U, 2U })
        {
          const auto ahead = difference(point, gap, by, h);
          const auto back  = difference(point, gap, by, -h);
          for (const unsigned int of : { 0U, 1U, 2U })
          {
            if (std::abs(ahead[of] - back[of]) > 1e-3 * scale)
              continue;
            ++n_checked;
            EXPECT_NEAR(0.5 * (ahead[of] + back[of]), entries(tangent)[of][by],
                        2e-3 * scale);
          }
        }
        n_sliding += next.state == JointState::slipping;
        point = next;
        if (i == 20)
          last = end;
      }
    EXPECT_GT(n_checked, 8000U);
    EXPECT_GT(n_sliding, 100U);
  }
} // namespace

TEST(SlipVector, IsotropicLaws)
{
  expect_isotropic(dilatant_coulomb(), random_path(-1e-3, 1e-4, 4e-3));
  expect_isotropic(fault(), random_path(-1e-3, 1e-4, 4e-3));
  expect_isotropic(rough_joint(), random_path(-3e-4, 1e-4, 4e-3));
  expect_isotropic(yielding_joint(), random_path(-3e-4, 1e-4, 4e-4));
  for (const CompositeLaw &law : composite_laws())
    expect_isotropic(law, random_path(-1e-4, 2e-5, 2e-4));
}

TEST(SlipVector, StraightPathsAreThoseOfTwoDimensions)
{
  expect_as_in_two_dimensions(dilatant_coulomb(),
                              random_path(-1e-3, 1e-4, 4e-3));
  expect_as_in_two_dimensions(fault(), random_path(-1e-3, 1e-4, 4e-3));
  expect_as_in_two_dimensions(rough_joint(), random_path(-3e-4, 1e-4, 4e-3));
  for (const double reach : { 4e-4, 4e-3 })
    expect_as_in_two_dimensions(yielding_joint(),
                                random_path(-3e-4, 1e-4, reach));
  for (const CompositeLaw &law : composite_laws())
    expect_as_in_two_dimensions(law, random_path(-1e-4, 2e-5, 2e-4));
}

TEST(SlipVector, EnergyAlongARandomPath)
{
  // Closed all the way: what a step makes of the kink where a joint opens is
  // left to the residual.
  expect_balance(dilatant_coulomb(), random_path(-1e-3, -5e-4, 4e-3), 1e-12);
  expect_balance(fault(), random_path(-1e-3, -1e-4, 4e-3), 1e-12);
  expect_balance(rough_joint(true), random_path(-3e-4, -1e-4, 4e-3), 1e-12);
  expect_balance(yielding_joint(true), random_path(-3e-4, -1e-4, 4e-4), 1e-6);
  for (const CompositeLaw &law : composite_laws())
    expect_balance(law, random_path(-1e-4, 2e-5, 2e-4), 1e-6);
}

TEST(SlipVector, TangentIsTheDerivative)
{
  expect_consistent_tangent(dilatant_coulomb(), random_path(-1e-3, 1e-4, 4e-3));
  SlipWeakeningLaw slow = fault(); // weakens all the way
  slow.weakening_slip   = 1.;
  for (const SlipWeakeningLaw &law : { fault(), slow })
    expect_consistent_tangent(law, random_path(-1e-3, 1e-4, 4e-3));
  expect_consistent_tangent(rough_joint(), random_path(-3e-4, 1e-4, 1e-2));
  expect_consistent_tangent(yielding_joint(), random_path(-3e-4, 1e-4, 2e-3));
  for (const CompositeLaw &law : composite_laws())
    expect_consistent_tangent(law, random_path(-1e-4, 2e-5, 2e-4));
}

TEST(SlipVector, FrictionOpposesSlipAndDilationIsACone)
{
  CoulombLaw law                  = dilatant_coulomb();
  law.normal_stiffness            = 8e8;
  law.shear_stiffness             = 3e12; // of little elastic slip
  law.critical_shear_displacement = 1.;
  const double radius = 2e-3, pressed = -1e-4;
  const double height = law.dilation * radius;
  Walk<CoulombLaw, 3> walk{ law };
  walk.go({ pressed, along(0., radius) }, 1000);
  EXPECT_NEAR(walk.point.plastic_opening, height, 1e-3 * height);
  // Round the origin, twice: traction along the path, height as it was.
  constexpr unsigned int n = 200000;
  for (unsigned int i = 1; i <= n; ++i)
    walk.move({ pressed, along(4. * M_PI * i / n, radius) });
  EXPECT_NEAR(walk.point.plastic_opening, height, 2e-3 * height);
  const double sigma   = law.normal_stiffness * (pressed - height);
  const double bearing = 0.1e6 - 0.6 * sigma;
  EXPECT_NEAR(walk.point.shear_traction[1], bearing, 2e-3 * bearing);
  EXPECT_NEAR(walk.point.shear_traction[0], 0., 2e-3 * bearing);
}

TEST(SlipVector, DilationInLargeStepsRoundTheOrigin)
{
  // On a circle the strength c bends the springs by e = c/ks along the path of
  // the plastic slip, so that the cosine between that and the slip is e/radius
  // and the plastic slip goes round on the circle sqrt(radius^2 - e^2).
  CoulombLaw law                  = dilatant_coulomb();
  law.residual                    = { 1e6, 0., 1e6 };
  law.critical_shear_displacement = 1.;
  constexpr double radius         = 2e-3;
  for (const double stiffness : { 3e9, 3e12 })
  {
    law.shear_stiffness = stiffness;
    const double e      = law.residual.cohesion / stiffness;
    const double rise   = law.dilation * e / radius * 2. * M_PI
                        * std::sqrt(radius * radius - e * e);
    constexpr unsigned int n = 200;
    JointPoint<3> point;
    point.state  = JointState::slipped;
    double start = 0.;
    for (unsigned int i = 0; i <= 3 * n; ++i)
    {
      law.update(point, 0., along(2. * M_PI * i / n, radius));
      if (i == 2 * n)
        start = point.plastic_opening;
    }
    // Radial return shortens the path by e/radius of half a step.
    EXPECT_NEAR(point.plastic_opening - start, rise,
                (1.2 * e / radius * M_PI / n + 1e-3) * rise);
  }
}
