// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/tetrahedron.h>

#include <Eigen/Dense>

#include <algorithm>

namespace quoin
{
  double largest_eigenvalue_squared_frequency(const Tetrahedron<OneLane> &cell,
                                              const SpaceStiffness &stiffness,
                                              const double density)
  {
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
    Eigen::Matrix<double, 4, 3> b;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
        b(k + 1, i) = cell.cofactor[k][i] / cell.det;
    b.row(0) = -b.bottomRows<3>().colwise().sum();

    const Eigen::Vector3d alpha
        = Solver(b.transpose() * b, Eigen::EigenvaluesOnly).eigenvalues();
    const Eigen::Vector3d root = alpha.cwiseMax(0.).cwiseSqrt();
    Eigen::Matrix3d normal     = stiffness.lambda * root * root.transpose();
    normal.diagonal() += 2. * stiffness.mu * alpha;
    const double largest
        = std::max(Solver(normal, Eigen::EigenvaluesOnly).eigenvalues()(2),
                   stiffness.mu * (alpha(1) + alpha(2)));
    return 4. / density * largest;
  }
} // namespace quoin
