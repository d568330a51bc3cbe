// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_composite_walk_h
#define quoin_tests_composite_walk_h

#include <quoin/joint_laws/composite_law.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace quoin
{
  namespace composite_test
  {
    /** The joints of the shear walls J4D and J5D, in SI units. */
    inline CompositeLaw wall()
    {
      CompositeLaw law;
      law.normal_stiffness       = 82e9;
      law.shear_stiffness        = 36e9;
      law.tension                = 0.25e6;
      law.tension_energy         = 18.;
      law.cohesion               = 0.35e6;
      law.shear_energy           = 125.;
      law.friction               = 0.75;
      law.residual_friction      = 0.75;
      law.cap.compression        = 10.5e6;
      law.cap.compression_energy = 5000.;
      law.cap.peak_crushing      = 0.09e-3;
      return law;
    }

    /** The same, but it dilates and its friction softens too. */
    inline CompositeLaw dilatant()
    {
      CompositeLaw law      = wall();
      law.dilation          = 0.4;
      law.dilation_pressure = 1.5e6;
      law.dilation_decay    = 2000.;
      law.residual_friction = 0.6;
      law.cap.offset        = 0.5e6;
      return law;
    }

    inline double cohesion_at(const CompositeLaw &law,
                              const CompositePoint<2> &point)
    {
      return law.cohesion * point.bond;
    }

    /** f1, f2 and f3, the last as a traction [Pa]. */
    inline double opening_excess(const CompositeLaw &law,
                                 const CompositePoint<2> &point)
    {
      return point.normal_traction - law.tension * point.bond;
    }
    inline double slip_excess(const CompositeLaw &law,
                              const CompositePoint<2> &point)
    {
      return std::abs(point.shear_traction)
             + point.normal_traction * law.friction_at(point.bond)
             - cohesion_at(law, point);
    }
    inline double cap_excess(const CompositeLaw &law,
                             const CompositePoint<2> &point)
    {
      if (std::isinf(law.cap.compression))
        return -1.;
      const double load
          = law.cap.load(point.normal_traction, point.shear_traction);
      return std::sqrt(std::max(0., load)) - law.cap.limit(point.crushing);
    }

    /** Moves a point and keeps the books, by the trapezoidal rule. */
    struct Walk
    {
      CompositeLaw law;
      CompositePoint<2> point;
      double opening = 0., slip = 0.;
      double work = 0., turnover = 0.;
      CompositeDissipation lost;

      CompositeDissipation move(const double new_opening, const double new_slip)
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
        lost.tension += gone.tension;
        lost.shear += gone.shear;
        lost.friction += gone.friction;
        lost.crushing += gone.crushing;
        opening = new_opening;
        slip    = new_slip;
        return gone;
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
      void slide(const double sigma, const double new_slip)
      {
        double next = opening;
        for (unsigned int i = 0; i < 30; ++i)
        {
          CompositePoint<2> trial = point;
          JointTangent<2> tangent;
          law.update(trial, next, new_slip, tangent);
          const double rest = sigma - trial.normal_traction;
          if (std::abs(rest) < 1e-9 * std::abs(sigma))
          {
            move(next, new_slip);
            return;
          }
          next += rest / tangent.normal_opening;
        }
        FAIL() << "no convergence at " << new_slip;
      }
    };

    inline Walk begin(const CompositeLaw &law)
    {
      Walk walk;
      walk.law = law;
      return walk;
    }
  } // namespace composite_test
} // namespace quoin

#endif
