// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/constants.h>
#include <quoin/elastodynamics/time_kernels.h>

#include <cmath>

#include <quoin/elastodynamics/wave_fronts.h>

namespace quoin
{
  using constants::pi;

  TimeKernels time_kernels(const ElasticMedium &medium, const double time,
                           const dealii::Tensor<1, 2> &distance,
                           const dealii::Tensor<1, 2> &normal)
  {
    const double r = distance.norm();
    if (medium.c1 * time <= r)
      return { Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero() };

    const RadialTerms terms(medium, time, r);
    const dealii::Tensor<1, 2> e   = distance / r;
    const double en                = e * normal;
    const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d square   = dyad(e, e);
    return { (2. * terms.a * square + (terms.b - terms.a) * identity)
                 / (4. * pi * medium.density),
             (terms.x * en * square
              + terms.y * (en * identity + dyad(e, normal))
              + terms.z * dyad(normal, e))
                 / (4. * pi) };
  }

  Eigen::Matrix2d static_traction_kernel(const ElasticMedium &medium,
                                         const dealii::Tensor<1, 2> &distance,
                                         const dealii::Tensor<1, 2> &normal)
  {
    const double nu              = medium.poisson();
    const double r               = distance.norm();
    const dealii::Tensor<1, 2> e = distance / r;
    const double k               = 1. - 2. * nu;
    return -1. / (4. * pi * (1. - nu) * r)
           * ((e * normal) * (k * Eigen::Matrix2d::Identity() + 2. * dyad(e, e))
              + k * (dyad(e, normal) - dyad(normal, e)));
  }
} // namespace quoin
