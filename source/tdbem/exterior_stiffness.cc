// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/tdbem/exterior_stiffness.h>

#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/static_kernels.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace quoin
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** What H makes of the two translations: zero of a bounded domain. */
    MatrixXd translations(const MatrixXd &H)
    {
      MatrixXd motion = MatrixXd::Zero(H.cols(), 2);
      for (Index k = 0; k < H.cols(); ++k)
        motion(k, k % 2) = 1.;
      const MatrixXd sums = H * motion;
      // Then the constant comes out zero, but the equations need it.
      return sums.lpNorm<Eigen::Infinity>() < 1e-6 ? motion : sums;
    }

    void check_energy(const MatrixXd &forces)
    {
      const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(
                                  forces, Eigen::EigenvaluesOnly)
                                  .eigenvalues();
      if (!(values(0) > -1e-6 * values(values.size() - 1)))
        throw InputError(
            "section 'Boundary elements': the rock beyond the blocks would "
            "release energy in a static stage. Let the boundary be closed, or "
            "its free surfaces reach as far on both sides as the blocks are "
            "wide.");
    }
  } // namespace

  ExteriorStiffness
  exterior_stiffness(const Boundary &boundary, const ElasticMedium &medium,
                     const Projection projection,
                     const std::vector<unsigned int> &interface,
                     const std::vector<bool> &traction_is_given)
  {
    const auto n = Index(boundary.n_unknowns());
    const StaticMatrices matrices
        = static_matrices(boundary, medium, projection);
    const VectorXd lengths = boundary.lengths();

    // Unknown tractions are in units of mu / diameter: all are lengths.
    const double diameter = boundary.diameter();
    const double unit     = medium.mu() / diameter;
    MatrixXd system       = MatrixXd::Zero(n + 2, n + 2);
    for (Index k = 0; k < n; ++k)
      if (traction_is_given[k])
        system.col(k).head(n) = matrices.H.col(k);
      else
      {
        system.col(k).head(n) = -unit * matrices.G.col(k);
        system(n + k % 2, k)  = lengths(k / 2) / diameter;
      }
    system.topRightCorner(n, 2) = -translations(matrices.H);
    const Eigen::PartialPivLU<MatrixXd> factors(system);
    if (!(factors.rcond() > 1e-13))
      throw InputError("section 'Boundary elements': the static equations are "
                       "singular. Look for elements that coincide.");

    MatrixXd loads = MatrixXd::Zero(n + 2, Index(interface.size()));
    VectorXd length(loads.cols());
    for (Index j = 0; j < loads.cols(); ++j)
    {
      loads.col(j).head(n) = -matrices.H.col(interface[j]);
      length(j)            = lengths(interface[j] / 2);
    }
    const MatrixXd solution = factors.solve(loads);

    MatrixXd given = MatrixXd::Zero(n + 2, n);
    for (Index k = 0; k < n; ++k)
      if (traction_is_given[k])
      {
        given.col(k).head(n) = matrices.G.col(k);
        given(n + k % 2, k)  = -lengths(k / 2) / (unit * diameter);
      }
      else
        given.col(k).head(n) = -matrices.H.col(k);
    for (const unsigned int k : interface)
      given.col(k).setZero();
    const MatrixXd of_given = factors.solve(given);
    MatrixXd forces(loads.cols(), loads.cols());
    for (Index i = 0; i < forces.rows(); ++i)
      forces.row(i) = length(i) * unit * solution.row(interface[i]);

    ExteriorStiffness result;
    result.traction_by_given  = unit * of_given(interface, Eigen::all);
    const MatrixXd transposed = forces.transpose();
    result.asymmetry          = (forces - transposed).cwiseAbs().maxCoeff()
                       / forces.cwiseAbs().maxCoeff();
    forces = 0.5 * (forces + transposed);
    check_energy(forces);
    result.traction = length.cwiseInverse().asDiagonal() * forces;
    return result;
  }
} // namespace quoin
