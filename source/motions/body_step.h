// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_motions_body_step_h
#define quoin_source_motions_body_step_h

#include <quoin/base/eigen_core.h>
#include <quoin/base/local_damping.h>
#include <quoin/operators/force_operator.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace quoin
{
  /**
   * A step of the n velocities of a rigid body, of which the first n_moved are
   * along the axes and the others about them. Driven ones become the velocity
   * that is given. The others follow the load G that is given, the force F of
   * the nodes and damping, with the matrix of inertia I: by a = dt alpha/2 of
   * mass damping
   *
   *   (1 + a) I_ff dv_f = dt (F + G)_f - I_fd dv_d - 2 a I_ff v_f .
   */
  template <int n, int n_moved>
  struct BodyStep
  {
    using Values = std::array<double, n>;
    using Vector = Eigen::Matrix<double, n, 1>;
    using Matrix = Eigen::Matrix<double, n, n>;

    std::array<bool, n> driven;
    Values given{};         /**< velocities [m/s, rad/s], or loads [N, N m] */
    Values drive{};         /**< forces and moments that drive it or load it */
    Values damping{};       /**< forces and moments of damping */
    double unbalanced = 0.; /**< sum of those that are not balanced [N] */

    void advance(const Matrix &I, const Vector &force, const StepContext &step,
                 double *velocity)
    {
      const Eigen::Map<const Vector> before(velocity);
      const double a = 0.5 * step.dt_velocity * step.mass_damping;
      Matrix matrix  = I;
      Vector right, total = force, local = Vector::Zero();
      for (int d = 0; d < n; ++d)
      {
        if (driven[d])
        {
          matrix.row(d).setZero();
          matrix(d, d) = 1.;
          right[d]     = given[d] - before[d];
          continue;
        }
        total[d] += given[d];
        right[d] = step.dt_velocity * total[d];
        for (int e = 0; e < n; ++e)
          if (!driven[e])
          {
            matrix(d, e) *= 1. + a;
            right[d] -= 2. * a * I(d, e) * before[e];
          }
      }
      Vector change = matrix.partialPivLu().solve(right);
      unbalanced    = 0.;
      for (int d = 0; d < n; ++d)
        if (!driven[d])
        {
          local[d] = -local_damping_velocity(step.local_damping
                                                 * step.dt_velocity / (1. + a)
                                                 / I(d, d) * std::abs(total[d]),
                                             before[d], before[d] + change[d]);
          // A moment counts as a force at the radius of gyration.
          unbalanced += std::abs(total[d])
                        / (d < n_moved ? 1. : std::sqrt(I(d, d) / I(0, 0)));
        }
      change += local;
      for (int d = 0; d < n; ++d)
      {
        drive[d]   = driven[d]
                         ? I.row(d).dot(change) / step.dt_velocity - force[d]
                         : given[d];
        damping[d] = 0.;
        for (int e = 0; e < n; ++e)
          if (!driven[d] && !driven[e])
            damping[d]
                += I(d, e)
                   * ((1. + a) / step.dt_velocity * local[e]
                      - step.mass_damping * (before[e] + 0.5 * change[e]));
      }
      for (int d = 0; d < n; ++d)
        velocity[d] += change[d];
    }
  };
} // namespace quoin

#endif
