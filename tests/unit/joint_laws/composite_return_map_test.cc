// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "composite_walk.h"

#include <random>
#include <vector>

using namespace quoin;
using namespace quoin::composite_test;

namespace
{
  /** So weak in compression that its cap cuts off the corner in tension. */
  CompositeLaw weak()
  {
    CompositeLaw law    = wall();
    law.cap.compression = 0.45e6;
    law.tension         = 0.3e6;
    law.cohesion        = 0.3e6;
    law.cap.shear       = 1.;
    return law;
  }
} // namespace

TEST(CompositeReturnMap, Corners)
{
  for (const CompositeLaw &law : { wall(), dilatant() })
    for (const double sense : { 1., -1. })
    {
      // Tension and shear: both softening laws at once.
      CompositePoint<2> point;
      auto lost = law.update(point, 1e-5, sense * 2e-5);
      EXPECT_NEAR(opening_excess(law, point), 0., 1e-6);
      EXPECT_NEAR(slip_excess(law, point), 0., 1e-6);
      EXPECT_GT(lost.tension, 0.);
      EXPECT_GT(lost.shear, 0.);
      const double slid = sense * point.plastic_slip;
      const double psi  = law.dilation
                         * std::exp(law.dilation_decay * std::log(point.bond)
                                    * 125. / 0.35e6);
      const double opened = point.plastic_opening - psi * slid;
      const double k2 = std::hypot(0.35e6 * slid / 125., 0.25e6 * opened / 18.);
      EXPECT_NEAR(point.bond, std::exp(-k2), 1e-9);

      // Shear and cap.
      point = CompositePoint<2>();
      lost  = law.update(point, -3e-5, sense * 4e-4);
      EXPECT_NEAR(cap_excess(law, point), 0., 1e-5);
      EXPECT_NEAR(slip_excess(law, point), 0., 1e-5);
      EXPECT_GT(point.crushing, 0.);
      EXPECT_LT(point.bond, 1.);
      EXPECT_GT(sense * point.shear_traction, 0.);
    }

  // Tension and cap, all three.
  const CompositeLaw law = weak();
  for (const double slip : { 1e-6, 1e-5 })
  {
    CompositePoint<2> point;
    law.update(point, 2e-5, slip);
    EXPECT_GT(point.crushing, 0.);
    EXPECT_NEAR(opening_excess(law, point), 0., 1e-6);
    EXPECT_NEAR(cap_excess(law, point), 0., 1e-5);
    if (slip > 5e-6)
    {
      EXPECT_NEAR(slip_excess(law, point), 0., 1e-6);
    }
    else
    {
      EXPECT_LT(slip_excess(law, point), -1e3);
    }
  }
}

TEST(CompositeReturnMap, StepsDoNotMatterOnStraightPaths)
{
  // One step against a thousand: the fewer steps, the larger the error, but
  // never beyond first order.
  const double paths[][2]
      = { { 1e-4, 0. },    { 0., 1e-3 },    { 3e-5, 1e-4 },
          { -1e-5, 5e-4 }, { -4e-4, 1e-4 }, { -4e-4, 1e-3 } };
  for (const CompositeLaw &law : { wall(), dilatant() })
    for (const auto &path : paths)
    {
      double error[3];
      Walk exact = begin(law);
      exact.go(path[0], path[1], 64000);
      unsigned int n = 10;
      for (double &e : error)
      {
        Walk walk = begin(law);
        walk.go(path[0], path[1], n);
        e = std::hypot(walk.point.normal_traction - exact.point.normal_traction,
                       walk.point.shear_traction - exact.point.shear_traction);
        n *= 10;
      }
      EXPECT_LT(error[1], 0.3 * error[0] + 10.);
      EXPECT_LT(error[2], 0.3 * error[1] + 10.);
      EXPECT_LT(error[2], 2e-3 * 1e6);

      Walk leap = begin(law);
      leap.go(path[0], path[1], 1);
      EXPECT_LE(opening_excess(law, leap.point), 1e-6);
      EXPECT_LE(slip_excess(law, leap.point), 1e-6);
    }
}

TEST(CompositeReturnMap, CyclesNeverCreateEnergy)
{
  // Steps small against the elastic range. All modes must be met.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (const CompositeLaw &law : { wall(), dilatant() })
  {
    CompositeDissipation all;
    for (unsigned int run = 0; run < 12; ++run)
    {
      Walk walk      = begin(law);
      double least   = 0.;
      double opening = 0., slip = 0., v_opening = 0., v_slip = 0.;
      for (unsigned int i = 0; i < 40000; ++i)
      {
        v_opening += 0.1 * uniform(random) - 0.004 * v_opening;
        v_slip += 0.1 * uniform(random) - 0.004 * v_slip;
        opening += 3e-8 * v_opening - 1e-4 * (opening + 2e-5);
        slip += 1e-7 * v_slip - 1e-4 * slip;
        const auto gone = walk.move(opening, slip);
        least = std::min({ least, gone.total(), gone.tension, gone.shear,
                           gone.friction, gone.crushing });
        ASSERT_NEAR(walk.work,
                    law.stored_energy(walk.point) + walk.lost.total(),
                    1e-11 * walk.turnover + 1e-12);
      }
      EXPECT_GE(least, -1e-9);
      all.tension += walk.lost.tension;
      all.shear += walk.lost.shear;
      all.friction += walk.lost.friction;
      all.crushing += walk.lost.crushing;
    }
    EXPECT_GT(all.tension, 1.);
    EXPECT_GT(all.shear, 10.);
    EXPECT_GT(all.friction, 10.);
    EXPECT_GT(all.crushing, 10.);
  }
}

TEST(CompositeReturnMap, TellsSnapBack)
{
  EXPECT_TRUE(softens_gently(wall()));
  EXPECT_TRUE(softens_gently(dilatant(), -1e6));
  CompositeLaw law   = wall();
  law.tension_energy = 0.25e6 * 0.25e6 / 82e9 * 0.99;
  EXPECT_FALSE(softens_gently(law));
  law              = wall();
  law.shear_energy = 0.35e6 * 0.35e6 / 36e9 * 0.99;
  EXPECT_FALSE(softens_gently(law));
  law                   = wall();
  law.residual_friction = 0.5;
  law.shear_energy      = 0.35e6 * 0.35e6 / 36e9 * 1.01;
  EXPECT_TRUE(softens_gently(law));
  EXPECT_FALSE(softens_gently(law, -1e6));
  law                        = wall();
  law.cap.compression_energy = 50.;
  EXPECT_FALSE(softens_gently(law));

  // It drops at once, and loses what it had stored and no more.
  law                = wall();
  law.tension_energy = 0.01;
  Walk walk          = begin(law);
  walk.go(1e-5, 0., 100000);
  EXPECT_LT(walk.point.normal_traction, 1.);
  EXPECT_NEAR(walk.work, 0.25e6 * 0.25e6 / (2. * 82e9), 1e-3 * walk.work);
}

namespace
{
  /** The error of a tangent against central differences, by the stiffness. */
  double tangent_error(const CompositeLaw &law, const CompositePoint<2> &start,
                       const double opening, const double slip)
  {
    const auto tractions = [&](const double u, const double v)
    {
      CompositePoint<2> point = start;
      law.update(point, u, v);
      return point;
    };
    CompositePoint<2> point = start;
    JointTangent<2> tangent;
    law.update(point, opening, slip, tangent);
    const double h      = 1e-9;
    const auto by_u     = tractions(opening + h, slip);
    const auto by_minus = tractions(opening - h, slip);
    const auto by_v     = tractions(opening, slip + h);
    const auto by_back  = tractions(opening, slip - h);
    const double differences[]
        = { by_u.normal_traction - by_minus.normal_traction,
            by_v.normal_traction - by_back.normal_traction,
            by_u.shear_traction - by_minus.shear_traction,
            by_v.shear_traction - by_back.shear_traction };
    const double tangents[] = { tangent.normal_opening, tangent.normal_slip,
                                tangent.shear_opening, tangent.shear_slip };
    double error            = 0.;
    for (unsigned int i = 0; i < 4; ++i)
      error = std::max(error, std::abs(differences[i] / (2. * h) - tangents[i])
                                  / law.normal_stiffness);
    return error;
  }

  /** What flowed from @p start to @p point: 1 opening, 2 slip, 4 cap. */
  unsigned int active(const CompositeDissipation &lost,
                      const CompositePoint<2> &start,
                      const CompositePoint<2> &point)
  {
    return (lost.tension != 0.) + 2 * (lost.shear + lost.friction != 0.)
           + 4 * (point.crushing > start.crushing);
  }
} // namespace

TEST(CompositeReturnMap, TangentIsTheDerivative)
{
  // Single modes and corners, fresh and with a history, in either sense.
  struct Case
  {
    double opening, slip;
    unsigned int active;
  };
  const Case cases[]
      = { { 2e-6, 2e-6, 0 },    { 1e-5, 1e-6, 1 },   { 1e-4, 0., 1 },
          { -5e-6, 5e-5, 2 },   { -5e-6, -4e-4, 2 }, { 1e-6, 5e-5, 2 },
          { -1.0e-5, 6e-5, 2 }, { 1e-5, 2e-5, 3 },   { 2e-5, -3e-5, 3 },
          { -6e-5, 1e-5, 4 },   { -2e-4, -1e-5, 4 }, { -2e-3, 2e-5, 4 },
          { -3e-5, 4e-4, 6 },   { -3e-5, -4e-4, 6 }, { -3e-5, 6e-4, 6 } };
  for (const CompositeLaw &law : { wall(), dilatant() })
    for (const Case &c : cases)
    {
      CompositePoint<2> fresh, end;
      const auto lost = law.update(end, c.opening, c.slip);
      EXPECT_EQ(active(lost, fresh, end), c.active)
          << c.opening << " " << c.slip;
      EXPECT_LT(tangent_error(law, fresh, c.opening, c.slip), 1e-6)
          << c.opening << " " << c.slip;

      // Once more, from where that ended.
      EXPECT_LT(tangent_error(law, end, 1.3 * c.opening, 1.2 * c.slip), 1e-6)
          << c.opening << " " << c.slip;
    }
  for (const double slip : { 1e-6, -1e-6, 1e-5, -1e-5 })
  {
    const CompositePoint<2> fresh;
    EXPECT_LT(tangent_error(weak(), fresh, 2e-5, slip), 1e-6) << slip;
  }
}

TEST(CompositeReturnMap, NewtonConvergesQuadratically)
{
  // A joint in series with springs of half its stiffness, drawn to a point
  // far beyond failure: tractions and spring forces in balance.
  const double drawn[][2] = { { 2e-5, 0. },
                              { 2e-5, 4e-5 },
                              { -1e-5, 2e-4 },
                              { -3e-4, 2e-5 },
                              { -9e-5, 9e-4 } };
  for (const CompositeLaw &law : { wall(), dilatant() })
    for (const auto &target : drawn)
    {
      const double kn = 0.5 * law.normal_stiffness;
      const double ks = 0.5 * law.shear_stiffness;
      double u = 0., v = 0.;
      std::vector<double> residuals;
      for (unsigned int i = 0; i < 30; ++i)
      {
        CompositePoint<2> point;
        JointTangent<2> d;
        law.update(point, u, v, d);
        const double r = kn * (target[0] - u) - point.normal_traction;
        const double s = ks * (target[1] - v) - point.shear_traction;
        residuals.push_back(std::hypot(r, s) / 1e6);
        if (residuals.back() < 1e-12)
          break;
        const double a = kn + d.normal_opening, b = d.normal_slip,
                     c = d.shear_opening, e = ks + d.shear_slip;
        const double det = a * e - b * c;
        u += (e * r - b * s) / det;
        v += (a * s - c * r) / det;
      }
      EXPECT_LT(residuals.back(), 1e-12) << target[0] << " " << target[1];
      EXPECT_LT(residuals.size(), 15U) << target[0] << " " << target[1];
      // Digits double at the end.
      const std::size_t n = residuals.size();
      const double last   = residuals[n - 2];
      if (n > 3 && residuals[n - 3] < 1e-2)
      {
        EXPECT_LT(last, 1e3 * residuals[n - 3] * residuals[n - 3] + 1e-12);
      }
    }
}

TEST(CompositeReturnMap, AnyIncrementHasAnAdmissibleEnd)
{
  // Random laws, random paths, increments from a nanometre to a kilometre.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const auto power = [&](const double from, const double to)
  { return std::pow(10., from + (to - from) * uniform(random)); };
  const auto sense      = [&]() { return uniform(random) < 0.5 ? -1. : 1.; };
  unsigned int n_gentle = 0, n_off = 0;
  for (unsigned int run = 0; run < 4000; ++run)
  {
    CompositeLaw law;
    law.normal_stiffness  = power(8., 12.);
    law.shear_stiffness   = law.normal_stiffness * power(-1., 0.3);
    law.cohesion          = power(4., 6.5);
    law.friction          = uniform(random);
    law.residual_friction = law.friction * uniform(random);
    law.tension = law.cohesion * uniform(random) / std::max(0.1, law.friction);
    law.tension_energy = power(-2., 3.);
    law.shear_energy   = power(-1., 4.);
    if (run % 2 == 1)
    {
      law.dilation          = law.residual_friction * uniform(random);
      law.dilation_pressure = power(5., 7.);
      law.dilation_decay    = power(0., 4.);
    }
    if (run % 3 != 2)
    {
      law.cap.compression        = power(5., 8.);
      law.cap.compression_energy = law.cap.compression * power(-5., -2.);
      law.cap.peak_crushing      = power(-6., -3.);
      law.cap.shear              = power(-1., 1.5);
      law.cap.offset
          = run % 5 == 0 ? law.cap.compression * uniform(random) : 0.;
    }
    ASSERT_LE(law.tension * law.friction, law.cohesion * (1. + 1e-12));
    const double largest = run % 4 == 0 ? 3. : -3.;

    CompositePoint<2> point;
    double opening = 0., slip = 0.;
    for (unsigned int i = 0; i < 250; ++i)
    {
      opening += sense() * power(-9., largest);
      slip += sense() * power(-9., largest);
      if (uniform(random) < 0.2)
        opening = point.plastic_opening;
      const CompositePoint<2> start = point;
      const auto lost               = law.update(point, opening, slip);
      ASSERT_TRUE(std::isfinite(lost.total()));
      ASSERT_TRUE(std::isfinite(point.plastic_opening + point.plastic_slip));
      ASSERT_GE(point.bond, 0.);
      ASSERT_LE(point.bond, start.bond);
      ASSERT_GE(point.crushing, start.crushing);
      // To rounding of the trial tractions, which may be large.
      const double trial
          = law.normal_stiffness * std::abs(opening - start.plastic_opening)
            + law.shear_stiffness * std::abs(slip - start.plastic_slip);
      const double allowed
          = 1e-7
                * (law.tension + law.cohesion + std::abs(point.normal_traction)
                   + std::abs(point.shear_traction))
            + 1e-15 * trial;
      ASSERT_LT(opening_excess(law, point), allowed) << run << " " << i;
      ASSERT_LT(slip_excess(law, point), allowed) << run << " " << i;
      ASSERT_LT(cap_excess(law, point), allowed) << run << " " << i;

      // What flowed is on its surface, unless the law snaps back or dilation
      // fades within the step. Friction that is not associated leaves a few
      // large steps without an answer that is.
      const double deepest = -law.normal_stiffness * std::abs(opening);
      if (law.dilation == 0.
          && softens_gently(law, std::min({ deepest, start.normal_traction,
                                            point.normal_traction })))
      {
        const unsigned int flowed = active(lost, start, point);
        ++n_gentle;
        n_off += ((flowed & 1) && opening_excess(law, point) < -allowed)
                 || ((flowed & 2) && slip_excess(law, point) < -allowed)
                 || ((flowed & 4) && cap_excess(law, point) < -allowed);
      }
    }
  }
  EXPECT_GT(n_gentle, 30000U);
  EXPECT_LE(n_off, 1U);
}
