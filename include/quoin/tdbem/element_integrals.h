// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_element_integrals_h
#define quoin_tdbem_element_integrals_h

#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/time_kernels.h>

namespace quoin
{
  /**
   * Integrals of the kernels A [m^2] and B [N/m] of time_kernels.h over a
   * straight element, in closed form, for a source at @p source at @p time
   * [s]: entry (i, j) is component i on the element, j the direction of the
   * force.
   *
   * In the frame of the element let the source be at distance d below it along
   * the normal and the ends at s_1 and s_2 along the tangent. The integrals are
   * differences between the ends of elementary functions of s, d and T. With
   * the notation of time_kernels.h, q = s^2 + d^2,
   * @f[ \Psi_a = \arctan \frac{s}{c_a R_a}, \quad
   *     \Phi_a = \arctan \frac{s T}{d R_a}, \quad
   *     J_a = T \Phi_a - d \Psi_a / c_a, \quad O_a = R_a - T L_a, \quad
   *     D_k = (R_1^k - R_2^k) / q , @f]
   * t the tangential and n the normal component,
   * @f[ 4 \pi \rho \int A_{tt} = -T s D_1 + s (q_1 L_1 + q_2 L_2)
   *       + 2 q_2 (c_2 T \Psi_2 - d \Phi_2), @f]
   * @f[ 4 \pi \rho \int A_{nn} = T s D_1 + s (q_1 L_1 + q_2 L_2)
   *       + 2 q_1 (c_1 T \Psi_1 - d \Phi_1), @f]
   * @f[ 4 \pi \rho \int A_{tn} = d (-T D_1 + q_1 L_1 - q_2 L_2), @f]
   * @f[ \int B_{tt} = -\frac{J_2}{2 \pi}
   *       + \frac{\mu}{3 \pi \rho} \frac{d s D_3}{q}, \quad
   *     \int B_{nn} = -\frac{J_1}{2 \pi}
   *       - \frac{\mu}{3 \pi \rho} \frac{d s D_3}{q}, @f]
   * @f[ 4 \pi \rho \int B_{tn} = \frac{2 \mu}{3} D_3 \frac{d^2 - s^2}{q}
   *       - 2 \mu q_1 O_1, @f]
   * @f[ 4 \pi \rho \int B_{nt} = \frac{2 \mu}{3} D_3 \frac{d^2 - s^2}{q}
   *       - 2 (\rho - \mu q_1) O_1 + 2 \rho O_2 . @f]
   * Beyond the front of a wave R and L are zero and the angles +-pi/2, so the
   * integrals are exact while a front crosses the element. They are exact
   * also for a source close to the element. For one on it, d = 0, the integral
   * of B is Cauchy's principal value; the source must not be at an end, where
   * that is infinite.
   */
  TimeKernels element_integrals(const ElasticMedium &medium, double time,
                                const dealii::Point<2> &source,
                                const BoundaryElement &element);

  /**
   * element_integrals() in the frame of the element: components t and n instead
   * of x and y, for a source at distance @p d below the element (d > 0: on the
   * side of the domain) and ends at @p s1 and @p s2 > @p s1 along the tangent
   * [m].
   */
  TimeKernels local_element_integrals(const ElasticMedium &medium, double time,
                                      double d, double s1, double s2);
} // namespace quoin

#endif
