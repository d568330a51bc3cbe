// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/elastodynamics/time_kernels.h>

#include <cmath>

#include <quoin/elastodynamics/wave_fronts.h>

namespace quoin
{
  using constants::pi;

  TimeKernels time_kernels(const ElasticMedium &medium, const double time,
                           const Eigen::Vector2d &distance,
                           const Eigen::Vector2d &normal)
  {
    const double r = distance.norm();
    if (medium.c1 * time <= r)
      return { Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero() };

    const RadialTerms terms(medium, time, r);
    const Eigen::Vector2d e        = distance / r;
    const double en                = e.dot(normal);
    const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d square   = e * e.transpose();
    return { (2. * terms.a * square + (terms.b - terms.a) * identity)
                 / (4. * pi * medium.density),
             (terms.x * en * square
              + terms.y * (en * identity + e * normal.transpose())
              + terms.z * normal * e.transpose())
                 / (4. * pi) };
  }

  Eigen::Matrix2d static_traction_kernel(const ElasticMedium &medium,
                                         const Eigen::Vector2d &distance,
                                         const Eigen::Vector2d &normal)
  {
    const double nu         = medium.poisson();
    const double r          = distance.norm();
    const Eigen::Vector2d e = distance / r;
    const double k          = 1. - 2. * nu;
    return -1. / (4. * pi * (1. - nu) * r)
           * (e.dot(normal)
                  * (k * Eigen::Matrix2d::Identity() + 2. * e * e.transpose())
              + k * (e * normal.transpose() - normal * e.transpose()));
  }
} // namespace quoin
