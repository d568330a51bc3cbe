// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/farfield/boundary_values.h>
#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/gauss_legendre.h>

#include <cmath>
#include <memory>
#include <sstream>

namespace quoin
{
  BoundaryValues::BoundaryValues(const BoundaryGeometry &geometry,
                                 const BoundaryElementParameters &parameters)
    : geometry(geometry), parameters(parameters),
      mean_of_tractions(!parameters.is_static
                        && parameters.formulation
                               != Formulation::convolution_quadrature),
      elements(parameters.boundaries.size()),
      means(parameters.boundaries.size())
  {
    for (unsigned int e = 0; e < geometry.owner.size(); ++e)
    {
      const auto &curve = parameters.boundaries[geometry.owner[e]];
      elements[geometry.owner[e]].push_back(e);
      for (const bool given : curve.traction_is_given)
        is_traction.push_back(given);
    }
    for (unsigned int k = 0; k < means.size(); ++k)
    {
      const auto &curve    = parameters.boundaries[k];
      means[k][0].function = &curve.value[0];
      means[k][1].function = &curve.value[1];
      means[k][2].function = &curve.pressure;
      for (Means &mean : means[k])
        mean.values.resize(elements[k].size());
    }
  }

  void BoundaryValues::update(Means &means, const unsigned int curve,
                              const double begin, const double end,
                              const bool mean_in_time) const
  {
    if (means.are_final)
      return;
    means.are_final                   = !means.function->depends_on_time();
    const SpaceTimeFunction &function = *means.function;
    const auto mean_at                = [&](const dealii::Point<2> &x)
    {
      if (!mean_in_time || means.are_final)
        return function(x, end);
      const GaussRule &rule = gauss_legendre(4);
      double sum            = 0.;
      for (unsigned int k = 0; k < rule.points.size(); ++k)
        sum += rule.weights[k]
               * function(x, begin + rule.points[k] * (end - begin));
      return sum;
    };
    if (!function.depends_on_place())
    {
      means.values.assign(means.values.size(), mean_at(dealii::Point<2>()));
      return;
    }
    const GaussRule &rule = gauss_legendre(3);
    for (unsigned int i = 0; i < means.values.size(); ++i)
    {
      const auto &element = geometry.boundary.elements[elements[curve][i]];
      means.values[i]     = 0.;
      for (unsigned int k = 0; k < rule.points.size(); ++k)
        means.values[i]
            += rule.weights[k]
               * mean_at(element.a + rule.points[k] * (element.b - element.a));
    }
  }

  Eigen::VectorXd BoundaryValues::operator()(const double begin,
                                             const double end)
  {
    return evaluate(begin, end, mean_of_tractions);
  }

  Eigen::VectorXd BoundaryValues::at(const double time)
  {
    return evaluate(time, time, false);
  }

  Eigen::VectorXd BoundaryValues::evaluate(const double begin, const double end,
                                           const bool mean)
  {
    Eigen::VectorXd result(geometry.boundary.n_unknowns());
    for (unsigned int k = 0; k < means.size(); ++k)
    {
      const auto &given = parameters.boundaries[k].traction_is_given;
      for (unsigned int i = 0; i < 3; ++i)
        update(means[k][i], k, begin, end, mean && (i == 2 || given[i]));
      for (unsigned int j = 0; j < elements[k].size(); ++j)
      {
        const unsigned int e = elements[k][j];
        const dealii::Tensor<1, 2> normal
            = geometry.boundary.elements[e].normal();
        for (unsigned int i = 0; i < 2; ++i)
        {
          double &value = result[2 * e + i];
          value         = means[k][i].values[j];
          if (given[i])
            value -= means[k][2].values[j] * normal[i];
          if (!std::isfinite(value))
          {
            std::ostringstream message;
            message << "what is prescribed on the boundary '"
                    << parameters.boundaries[k].name
                    << "' is not a finite number at time " << end
                    << " s. Correct its expressions.";
            throw RunError(message.str());
          }
        }
      }
    }
    return result;
  }

  void BoundaryValues::check_start()
  {
    const std::string names[] = { "Horizontal", "Vertical" };
    for (unsigned int k = 0; k < means.size(); ++k)
      for (unsigned int i = 0; i < 2; ++i)
      {
        const auto &curve = parameters.boundaries[k];
        if (curve.traction_is_given[i])
          continue;
        Means start = means[k][i];
        update(start, k, 0., 0., false);
        for (const double value : start.values)
          if (!(std::abs(value) <= 1e-14))
          {
            std::ostringstream message;
            message << "section 'Boundary elements/" << curve.name
                    << "': the displacement '" << names[i] << "' is " << value
                    << " at t = 0. It must begin at 0, because everything is "
                       "at rest before: let it rise from 0.";
            throw InputError(message.str());
          }
      }
  }

  FarFieldDomain far_field_domain(const BoundaryGeometry &geometry,
                                  const BoundaryElementParameters &settings)
  {
    FarFieldDomain domain;
    domain.boundary    = geometry.boundary;
    domain.medium      = settings.medium;
    domain.formulation = settings.formulation_options();
    domain.scheme      = settings.coupling;
    for (unsigned int e = 0; e < geometry.owner.size(); ++e)
      if (settings.boundaries[geometry.owner[e]].shape
          == BoundaryShape::interface)
        domain.interface.push_back(e);
    const auto given = std::make_shared<BoundaryValues>(geometry, settings);
    given->check_start();
    domain.traction_is_given = given->traction_is_given();
    domain.given             = [given](const double begin, const double end)
    { return (*given)(begin, end); };
    return domain;
  }
} // namespace quoin
