// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/elastodynamics/gauss_legendre.h>
#include <quoin/elastodynamics/incident_field.h>

namespace quoin
{
  namespace
  {
    /** The mean of @p value(x, n) over each element. */
    template <typename Function>
    Eigen::VectorXd element_means(const Boundary &boundary,
                                  const Function &value)
    {
      const GaussRule &rule  = gauss_legendre(4);
      Eigen::VectorXd result = Eigen::VectorXd::Zero(boundary.n_unknowns());
      for (std::size_t e = 0; e < boundary.n_elements(); ++e)
      {
        const BoundaryElement &element    = boundary.elements[e];
        const dealii::Tensor<1, 2> normal = element.normal();
        for (std::size_t g = 0; g < rule.points.size(); ++g)
        {
          const dealii::Point<2> x
              = element.a + rule.points[g] * (element.b - element.a);
          add_to_vector(result, e, rule.weights[g] * value(x, normal));
        }
      }
      return result;
    }
  } // namespace

  Eigen::VectorXd IncidentField::displacements(const Boundary &boundary,
                                               const double t) const
  {
    return element_means(
        boundary, [&](const dealii::Point<2> &x, const dealii::Tensor<1, 2> &)
        { return displacement(x, t); });
  }

  Eigen::VectorXd IncidentField::mean_tractions(const Boundary &boundary,
                                                const double t0,
                                                const double t1) const
  {
    return element_means(
        boundary, [&](const dealii::Point<2> &x, const dealii::Tensor<1, 2> &n)
        { return mean_traction(x, n, t0, t1); });
  }
} // namespace quoin
