// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/eigen_core.h>
#include <quoin/tdbem/static_solver.h>

#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/static_kernels.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Whether the domain is bounded, from the sums of the rows of H. */
    bool is_bounded(const Eigen::MatrixXd &H)
    {
      double from_zero = 0., from_identity = 0.;
      Eigen::VectorXd x = Eigen::VectorXd::Zero(H.cols());
      for (unsigned i = 0; i < 2; ++i)
      {
        for (unsigned k = 0; k < x.size(); ++k)
          x(k) = k % 2 == i ? 1. : 0.;
        const Eigen::VectorXd sum = H * x;
        from_zero = std::max(from_zero, sum.lpNorm<Eigen::Infinity>());
        from_identity
            = std::max(from_identity, (sum - x).lpNorm<Eigen::Infinity>());
      }
      if (std::min(from_zero, from_identity) > 1e-6)
        throw InputError("section 'Boundary elements': 'Analysis = static' "
                         "needs closed boundaries, all with the domain on the "
                         "same side. Close open ones, or change 'Domain'.");
      return from_zero < from_identity;
    }

    /**
     * The rigid motions that move no component whose displacement is known,
     * a column each.
     */
    Eigen::MatrixXd
    free_rigid_motions(const Boundary &boundary, const double diameter,
                       const std::vector<bool> &displacement_known)
    {
      const unsigned n              = unsigned(boundary.n_elements());
      const dealii::Point<2> centre = boundary.elements.front().middle();
      Eigen::MatrixXd motions(2 * n, 3);
      for (unsigned e = 0; e < n; ++e)
      {
        const dealii::Tensor<1, 2> x
            = (boundary.elements[e].middle() - centre) / diameter;
        motions.middleRows<2>(2 * e) << 1., 0., -x[1], 0., 1., x[0];
      }
      Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
      for (unsigned k = 0; k < 2 * n; ++k)
        if (displacement_known[k])
          held += motions.row(k).transpose() * motions.row(k);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(held);
      // Eigenvalues in ascending order.
      unsigned n_free = 0;
      while (n_free < 3 && eigen.eigenvalues()(n_free) < 1e-10)
        ++n_free;
      return motions * eigen.eigenvectors().leftCols(n_free);
    }
  } // namespace

  StaticSolution solve_static(const Boundary &boundary,
                              const ElasticMedium &medium,
                              const Projection projection,
                              const StaticConditions &conditions)
  {
    const unsigned n    = unsigned(boundary.n_unknowns());
    const auto &known_u = conditions.displacement_known;
    if (n == 0 || conditions.values.size() != n || known_u.size() != n)
      throw InputError("Static boundary elements: there must be one condition "
                       "for each component on each element.");
    const StaticMatrices matrices
        = static_matrices(boundary, medium, projection);
    const bool bounded    = is_bounded(matrices.H);
    const double diameter = boundary.diameter();
    const unsigned n_constants
        = std::find(known_u.begin(), known_u.end(), true) != known_u.end() ? 2
                                                                           : 0;
    Eigen::VectorXd length(n);
    for (unsigned k = 0; k < n; ++k)
      length(k) = boundary.elements[k / 2].length() / diameter;

    Eigen::MatrixXd motions(n, 0);
    if (bounded)
      motions = free_rigid_motions(boundary, diameter, known_u);
    const unsigned n_motions = unsigned(motions.cols());

    // Unknown tractions are in units of mu / diameter, so that all numbers
    // are lengths.
    const double unit           = medium.mu() / diameter;
    const unsigned size         = n + n_constants + n_motions;
    Eigen::MatrixXd system      = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd rhs         = Eigen::VectorXd::Zero(size);
    Eigen::VectorXd known_force = Eigen::VectorXd::Zero(n);
    for (unsigned k = 0; k < n; ++k)
      if (known_u[k])
      {
        system.col(k).head(n) = -unit * matrices.G.col(k);
        rhs.head(n) -= conditions.values(k) * matrices.H.col(k);
        system(n + k % 2, k) = length(k);
      }
      else
      {
        system.col(k).head(n) = matrices.H.col(k);
        rhs.head(n) += conditions.values(k) * matrices.G.col(k);
        known_force(k) = length(k) * diameter * conditions.values(k);
        for (unsigned m = 0; m < n_motions; ++m)
          system(n + n_constants + m, k) = length(k) * motions(k, m);
      }
    for (unsigned i = 0; i < n_constants; ++i)
    {
      double force = bounded ? 0. : conditions.net_force[i];
      for (unsigned k = i; k < n; k += 2)
      {
        system(k, n + i) = -1.;
        force -= known_force(k);
      }
      rhs(n + i) = force / medium.mu();
    }
    system.topRightCorner(n, n_motions) = motions;

    const double imbalance
        = n_motions > 0
              ? (motions.transpose() * known_force).lpNorm<Eigen::Infinity>()
              : 0.;
    if (imbalance > 1e-3 * known_force.lpNorm<1>())
      throw InputError("section 'Boundary elements': with 'Analysis = static' "
                       "the body may move freely and the tractions on it are "
                       "not in balance. Give more displacements, or tractions "
                       "whose resultant is zero.");

    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(system);
    if (!(factors.rcond() > 1e-13))
      throw InputError("section 'Boundary elements': the static equations are "
                       "singular. Look for elements that coincide.");
    const Eigen::VectorXd x = factors.solve(rhs);

    StaticSolution solution{ Eigen::VectorXd(n), Eigen::VectorXd(n),
                             dealii::Tensor<1, 2>() };
    for (unsigned k = 0; k < n; ++k)
    {
      solution.displacement(k) = known_u[k] ? conditions.values(k) : x(k);
      solution.traction(k) = known_u[k] ? unit * x(k) : conditions.values(k);
    }
    if (n_constants > 0)
      solution.constant = vector_at(x, n / 2);
    return solution;
  }
} // namespace quoin
