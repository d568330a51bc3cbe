// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_adaptive_quadrature_h
#define quoin_tests_adaptive_quadrature_h

#include <quoin/tdbem/graded_rule.h>
#include <quoin/elastodynamics/time_kernels.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace quoin
{
  using KernelFunction = std::function<TimeKernels(double)>;

  inline TimeKernels integrate(const KernelFunction &f, const double a,
                               const double b, const GaussRule &rule)
  {
    TimeKernels sum{ Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero() };
    for (std::size_t k = 0; k < rule.points.size(); ++k)
    {
      const TimeKernels value = f(a + (b - a) * rule.points[k]);
      sum.A += (b - a) * rule.weights[k] * value.A;
      sum.B += (b - a) * rule.weights[k] * value.B;
    }
    return sum;
  }

  /** Bisects until two halves together differ from their whole by less. */
  inline TimeKernels integrate_adaptively(const KernelFunction &f,
                                          const double a, const double b,
                                          const double tolerance,
                                          const unsigned depth = 30)
  {
    static const GaussRule rule = graded_rule(16);
    const double middle         = 0.5 * (a + b);
    const TimeKernels whole     = integrate(f, a, b, rule);
    const TimeKernels left      = integrate(f, a, middle, rule);
    const TimeKernels right     = integrate(f, middle, b, rule);
    const TimeKernels both{ left.A + right.A, left.B + right.B };
    if (depth == 0
        || ((both.A - whole.A).cwiseAbs().maxCoeff() < tolerance
            && (both.B - whole.B).cwiseAbs().maxCoeff() < tolerance))
      return both;
    const TimeKernels l
        = integrate_adaptively(f, a, middle, tolerance, depth - 1);
    const TimeKernels r
        = integrate_adaptively(f, middle, b, tolerance, depth - 1);
    return { l.A + r.A, l.B + r.B };
  }

  /** The same, cut at the @p kinks that are inside. */
  inline TimeKernels integrate_adaptively(const KernelFunction &f,
                                          const double a, const double b,
                                          std::vector<double> kinks,
                                          const double tolerance)
  {
    kinks.push_back(a);
    kinks.push_back(b);
    std::sort(kinks.begin(), kinks.end());
    TimeKernels sum{ Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero() };
    for (std::size_t k = 0; k + 1 < kinks.size(); ++k)
      if (kinks[k] >= a && kinks[k + 1] <= b && kinks[k + 1] > kinks[k])
      {
        const TimeKernels part
            = integrate_adaptively(f, kinks[k], kinks[k + 1], tolerance);
        sum.A += part.A;
        sum.B += part.B;
      }
    return sum;
  }
} // namespace quoin

#endif
