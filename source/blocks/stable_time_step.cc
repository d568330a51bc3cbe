// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/stable_time_step.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    double largest_eigenvalue_of(const StableTimeStep<2>::Bound &S)
    {
      const auto [xx, yy, xy] = S;
      return 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
    }

    double largest_eigenvalue_of(const StableTimeStep<3>::Bound &S)
    {
      const auto [xx, yy, zz, xy, xz, yz] = S;
      Eigen::Matrix3d matrix;
      matrix << xx, xy, xz, xy, yy, yz, xz, yz, zz;
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                 matrix, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .maxCoeff();
    }
  } // namespace

  template <int dim>
  StableTimeStep<dim>::StableTimeStep(const std::vector<Bound> &bound)
  {
    for (const Bound &S : bound)
      eigenvalue.push_back(largest_eigenvalue_of(S));
  }

  template <int dim>
  double StableTimeStep<dim>::largest_eigenvalue(
      const std::vector<double> &mass,
      const std::vector<double> &rigid_factors) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < eigenvalue.size(); ++i)
      largest = std::max(largest, eigenvalue[i] / mass[i]);
    for (unsigned int b = 0; b < rigid_eigenvalue.size(); ++b)
      largest = std::max(largest,
                         rigid_eigenvalue[b]
                             / (rigid_factors.empty() ? 1. : rigid_factors[b]));
    return largest;
  }

  template <int dim>
  double StableTimeStep<dim>::critical(const double largest_eigenvalue,
                                       const double beta)
  {
    const double omega = std::sqrt(largest_eigenvalue);
    const double xi    = 0.5 * beta * omega;
    // sqrt(1 + xi^2) - xi without cancellation.
    return 2. / omega / (std::sqrt(1. + xi * xi) + xi);
  }

  template class StableTimeStep<2>;
  template class StableTimeStep<3>;
} // namespace quoin
