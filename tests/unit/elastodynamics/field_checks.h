// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_field_checks_h
#define quoin_field_checks_h

#include <quoin/base/packed_vectors.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/gauss_legendre.h>
#include <quoin/elastodynamics/incident_field.h>

namespace quoin
{
  /**
   * How far Newton's law is violated on a square with the sides 2 h [m] around
   * @p x: the tractions on its sides push its mass. Relative.
   */
  inline double motion_residual(const IncidentField &field,
                                const ElasticMedium &medium,
                                const dealii::Point<2> &x, const double t,
                                const double h, const double dt)
  {
    const Boundary square   = Boundary::polygon({ { x[0] - h, x[1] - h },
                                                  { x[0] + h, x[1] - h },
                                                  { x[0] + h, x[1] + h },
                                                  { x[0] - h, x[1] + h } },
                                                2. * h, false);
    const Eigen::VectorXd p = field.mean_tractions(square, t - dt, t + dt);
    dealii::Tensor<1, 2> force;
    for (unsigned e = 0; e < 4; ++e)
      force += 2. * h * vector_at(p, e);
    const dealii::Tensor<1, 2> acceleration
        = (field.displacement(x, t + dt) - 2. * field.displacement(x, t)
           + field.displacement(x, t - dt))
          / (dt * dt);
    const dealii::Tensor<1, 2> wanted
        = medium.density * 4. * h * h * acceleration;
    return (force - wanted).norm() / wanted.norm();
  }

  /**
   * How far the mean traction over [@p t0, @p t1] is from Hooke's law with
   * strains by central differences of displacements over @p h [m]. Relative.
   */
  inline double
  traction_residual(const IncidentField &field, const ElasticMedium &medium,
                    const dealii::Point<2> &x, const dealii::Tensor<1, 2> &n,
                    const double t0, const double t1, const double h)
  {
    const GaussRule &rule = gauss_legendre(20);
    dealii::Tensor<1, 2> mean;
    for (std::size_t g = 0; g < rule.points.size(); ++g)
    {
      const double t = t0 + rule.points[g] * (t1 - t0);
      dealii::Tensor<2, 2> slopes; // row j: derivative by x_j
      for (unsigned j = 0; j < 2; ++j)
      {
        const dealii::Tensor<1, 2> step = h * dealii::Point<2>::unit_vector(j);
        slopes[j]                       = (field.displacement(x + step, t)
                     - field.displacement(dealii::Point<2>(x - step), t))
                    / (2. * h);
      }
      mean += rule.weights[g]
              * (medium.lambda() * trace(slopes) * n
                 + medium.mu() * (slopes + transpose(slopes)) * n);
    }
    return (field.mean_traction(x, n, t0, t1) - mean).norm() / mean.norm();
  }
} // namespace quoin

#endif
