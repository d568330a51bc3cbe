// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_rock_walk_h
#define quoin_tests_rock_walk_h

#include <quoin/joint_laws/barton_bandis_law.h>
#include <quoin/joint_laws/continuously_yielding_law.h>

#include <gtest/gtest.h>

#include <random>

namespace quoin
{
  namespace rock_test
  {
    constexpr double degree = 3.14159265358979323846 / 180.;

    /** A rough joint in granite. */
    inline BartonBandisLaw rough()
    {
      BartonBandisLaw law{ {}, HyperbolicClosure(10e9, 0.3e-3, 250e9) };
      law.stiffness      = 5e9;
      law.residual_angle = 28. * degree;
      law.roughness      = 10. * degree;
      law.wall_strength  = 100e6;
      law.peak_slip      = 1e-3;
      return law;
    }

    inline ContinuouslyYieldingLaw yielding(const double shear_exponent = 0.4)
    {
      const PowerStiffness normal{ 20e9, 0.5, 1e6, 1e4, 1e8 };
      const PowerStiffness shear{ 8e9, shear_exponent, 1e6, 1e4, 1e8 };
      return {
        {}, PowerClosure(normal), shear, 50. * degree, 30. * degree, 1e-3
      };
    }

    /** Moves a point and keeps the books, by the trapezoidal rule. */
    template <typename Law>
    struct Walk
    {
      Law law;
      RockPoint<2> point{};
      double opening = 0., slip = 0.;
      double work = 0., turnover = 0., lost = 0., least = 0.;

      void move(const double new_opening, const double new_slip)
      {
        const double sigma = point.normal_traction;
        const double tau   = point.shear_traction;
        const auto gone    = law.update(point, new_opening, new_slip);
        const double by_opening
            = 0.5 * (sigma + point.normal_traction) * (new_opening - opening);
        const double by_slip
            = 0.5 * (tau + point.shear_traction) * (new_slip - slip);
        work += by_opening + by_slip;
        turnover += std::abs(by_opening) + std::abs(by_slip);
        EXPECT_EQ(gone.fracture, 0.);
        lost += gone.friction;
        least   = std::min(least, gone.friction);
        opening = new_opening;
        slip    = new_slip;
      }

      /** In a straight line. */
      void go(const double new_opening, const double new_slip,
              const unsigned int n_steps)
      {
        const double u = opening, v = slip;
        for (unsigned int i = 1; i <= n_steps; ++i)
          move(u + (new_opening - u) * i / n_steps,
               v + (new_slip - v) * i / n_steps);
      }

      /** Slips under a constant normal traction [Pa], by Newton's method. */
      void slide(const double sigma, const double new_slip,
                 const unsigned int n_steps = 1)
      {
        const double from = slip;
        for (unsigned int n = 1; n <= n_steps; ++n)
        {
          const double there = from + (new_slip - from) * n / n_steps;
          double next        = opening;
          for (unsigned int i = 0; i < 50; ++i)
          {
            RockPoint<2> trial = point;
            JointTangent<2> tangent;
            law.update(trial, next, there, tangent);
            const double rest = sigma - trial.normal_traction;
            if (std::abs(rest) < 1e-9 * std::abs(sigma))
              break;
            ASSERT_LT(i, 49U) << "no convergence at " << there;
            next += tangent.normal_opening > 0.
                        ? rest / tangent.normal_opening
                        : point.plastic_opening - 1e-5 - next;
          }
          move(next, there);
        }
      }

      /** Work that is neither stored nor lost, by all that was turned over. */
      double residual() const
      {
        return (work - lost - law.stored_energy(point)) / turnover;
      }
    };

    /** Closes it to a normal traction [Pa]. */
    template <typename Law>
    Walk<Law> closed(const Law &law, const double sigma)
    {
      Walk<Law> walk{ law };
      walk.go(-law.closure.closure(-sigma), 0., 50);
      return walk;
    }

    /** Along a random path of straight pieces, @p n steps each. */
    template <typename Law>
    Walk<Law> random_walk(const Law &law, const unsigned int n)
    {
      std::mt19937 random(5);
      std::uniform_real_distribution<double> uniform(0., 1.);
      Walk<Law> walk{ law };
      for (unsigned int i = 0; i < 100; ++i)
      {
        const double opening = -3e-4 * uniform(random) + 0.5e-4;
        const double slip    = 4e-3 * (2. * uniform(random) - 1.);
        walk.go(walk.point.dilated + opening, slip, n);
      }
      return walk;
    }

    /**
     * The tangent against differences of both sides along random paths, as a
     * share of 1e11 Pa/m; @p n_checked: entries where both sides agree.
     */
    template <typename Law>
    double tangent_error(const Law &law, const double reach,
                         unsigned int &n_checked)
    {
      std::mt19937 random(11);
      std::uniform_real_distribution<double> uniform(0., 1.);
      constexpr double h = 1e-11, scale = 1e11;
      double worst = 0.;
      n_checked    = 0;
      for (unsigned int path = 0; path < 40; ++path)
      {
        RockPoint<2> point;
        for (unsigned int i = 0; i < 40; ++i)
        {
          const double opening
              = point.dilated - 2.5e-4 * uniform(random) + 0.3e-4;
          const double slip = reach * (2. * uniform(random) - 1.);
          RockPoint<2> here = point;
          JointTangent<2> tangent;
          law.update(here, opening, slip, tangent);
          const auto difference = [&](const double du, const double dv)
          {
            RockPoint<2> there = point;
            law.update(there, opening + du, slip + dv);
            return std::array<double, 2>{
              (there.normal_traction - here.normal_traction) / (du + dv),
              (there.shear_traction - here.shear_traction) / (du + dv)
            };
          };
          const double expected[2][2]
              = { { tangent.normal_opening, tangent.shear_opening },
                  { tangent.normal_slip, tangent.shear_slip } };
          for (const unsigned int by : { 0U, 1U })
          {
            const double du = by == 0 ? h : 0., dv = h - du;
            const auto ahead = difference(du, dv);
            const auto back  = difference(-du, -dv);
            for (const unsigned int of : { 0U, 1U })
            {
              if (std::abs(ahead[of] - back[of]) > 1e-3 * scale)
                continue;
              ++n_checked;
              worst = std::max(worst, std::abs(0.5 * (ahead[of] + back[of])
                                               - expected[by][of])
                                          / scale);
            }
          }
          point = here;
        }
      }
      return worst;
    }
  } // namespace rock_test
} // namespace quoin

#endif
