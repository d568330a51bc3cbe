// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_time_kernels_h
#define quoin_elastodynamics_time_kernels_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/elastic_medium.h>

/**
 * Fundamental solutions of two-dimensional elastodynamics, integrated in time.
 *
 * With the distance r, q_a = 1 / c_a^2 and R_a = sqrt(t^2 - q_a r^2) the
 * displacement i after a unit impulse in direction j per unit length of a line
 * source, at rest before, is
 * @f[ U_{ij} = \frac{1}{4 \pi \rho} \sum_{a=1,2} H(t - r / c_a) \left[
 *     s_a (2 r_{,i} r_{,j} - \delta_{ij}) \frac{R_a + t^2 / R_a}{r^2}
 *     + \delta_{ij} \frac{q_a}{R_a} \right], \quad s_1 = 1, s_2 = -1, @f]
 * the solution of Eringen and Suhubi that (@cite JinWangZhang1998, Eq. 2) is
 * based on. A discretisation with tractions and velocities constant in each
 * time step needs only its integral A over time and the tractions B of the
 * integral of A, both of which are continuous at the wave fronts:
 * @f[ 4 \pi \rho A_{ij} = (2 r_{,i} r_{,j} - \delta_{ij}) \, T D_1
 *     + \delta_{ij} (q_1 L_1 + q_2 L_2), @f]
 * @f[ 4 \pi \rho B_{ij} = -2 \lambda n_i r_{,j} Q_1
 *     + \mu \left[ -4 r_{,i} r_{,j} r_{,n} (Q_1 - Q_2 + W)
 *     + (\delta_{ij} r_{,n} + n_j r_{,i}) (W - 2 Q_2) + n_i r_{,j} W
 *     \right], @f]
 * @f[ L_a = \mathrm{arcosh} (c_a T / r), \quad Q_a = q_a R_a / r, \quad
 *     D_1 = (R_1 - R_2) / r^2, \quad W = \tfrac43 (R_1^3 - R_2^3) / r^3 . @f]
 * Terms of a wave that has not arrived are zero. Once both have arrived,
 * r^2 cancels in D_1 = (q_2 - q_1) / (R_1 + R_2) and likewise in W.
 */
namespace quoin
{
  /** The two kernels at one point; entry (i, j) as explained above. */
  struct TimeKernels
  {
    /**
     * Displacement i [m] at time T after a force of 1 N/m in direction j was
     * switched on.
     */
    Eigen::Matrix2d A;

    /**
     * Traction i [Pa] at time T after a force in direction j began to grow by
     * 1 N/m per second, on the plane with the given normal.
     */
    Eigen::Matrix2d B;
  };

  /**
   * The kernels at @p distance (from the source to the point where
   * displacement and traction are taken) [m], not zero, on a plane with unit
   * @p normal at @p time [s]. Exactly zero before the P wave arrives.
   */
  TimeKernels time_kernels(const ElasticMedium &medium, double time,
                           const dealii::Tensor<1, 2> &distance,
                           const dealii::Tensor<1, 2> &normal);

  /**
   * Tractions [Pa] at @p distance on a plane with unit @p normal under a
   * static line force of 1 N/m (Kelvin's solution in plane strain), the limit
   * of B / T for long times.
   */
  Eigen::Matrix2d static_traction_kernel(const ElasticMedium &medium,
                                         const dealii::Tensor<1, 2> &distance,
                                         const dealii::Tensor<1, 2> &normal);
} // namespace quoin

#endif
