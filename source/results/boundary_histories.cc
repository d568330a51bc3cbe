// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/results/boundary_histories.h>
#include <quoin/base/exceptions.h>

#include <algorithm>
#include <sstream>

namespace quoin
{
  BoundaryHistories::BoundaryHistories(
      const std::vector<HistoryParameters> &parameters,
      const BoundaryGeometry &geometry,
      const BoundaryElementParameters &boundaries, const double thickness)
    : geometry(geometry), thickness(thickness)
  {
    for (const BoundaryCurveParameters &curve : boundaries.boundaries)
      names.push_back(curve.name);
    for (const HistoryParameters &wanted : parameters)
    {
      Probe probe;
      probe.parameters = wanted;
      const dealii::Point<2> point(wanted.point[0], wanted.point[1]);
      const NearestElement nearest = nearest_element(geometry.boundary, point);
      const double length
          = geometry.boundary.elements[nearest.element].length();
      std::ostringstream message;
      message << "section 'Histories/" << wanted.name
              << "': 'Point = " << point[0] << ", " << point[1] << "' is ";
      if (wanted.is_of_interior())
      {
        if (!nearest.inside_domain)
          throw InputError(message.str()
                           + "not in the domain. Give a point in it, or take a "
                             "boundary quantity.");
        if (nearest.distance < 0.25 * length)
        {
          message << nearest.distance
                  << " m from the boundary, less than a quarter of an element, "
                  << length
                  << " m long. Give a point farther inside, or take a boundary "
                     "quantity.";
          throw InputError(message.str());
        }
        probe.entity = points.size();
        points.push_back(point);
      }
      else if (wanted.quantity == HistoryQuantity::boundary_force)
      {
        if (std::find(names.begin(), names.end(), wanted.curve) == names.end())
          throw InputError("section 'Histories/" + wanted.name
                           + "': 'Curve = " + wanted.curve
                           + "' is no boundary of section 'Boundary elements': "
                             "name one of its 'Names'.");
      }
      else
      {
        if (nearest.distance > 2. * length)
        {
          message << nearest.distance
                  << " m from the nearest element, more than twice its length. "
                     "Give a point of the boundary in metres.";
          throw InputError(message.str());
        }
        probe.entity = nearest.element;
      }
      probes.push_back(probe);
    }
  }

  std::vector<std::string> BoundaryHistories::column_names() const
  {
    std::vector<std::string> result = { "time [s]" };
    for (const Probe &probe : probes)
      result.push_back(probe.parameters.name + " [" + probe.parameters.unit
                       + "]");
    return result;
  }

  double BoundaryHistories::force(const HistoryParameters &wanted,
                                  const BoundaryState &state) const
  {
    double sum = 0.;
    for (unsigned int e = 0; e < geometry.boundary.n_elements(); ++e)
    {
      if (names[geometry.owner[e]] != wanted.curve)
        continue;
      const BoundaryElement &element = geometry.boundary.elements[e];
      const dealii::Tensor<1, 2> part
          = thickness * element.length() * vector_at(state.traction, e);
      const dealii::Tensor<1, 2> arm
          = element.middle()
            - dealii::Point<2>(wanted.point[0], wanted.point[1]);
      sum += wanted.component < 2 ? part[wanted.component] : cross(arm, part);
    }
    return sum;
  }

  std::vector<double> BoundaryHistories::row(const double time,
                                             const BoundaryState &state) const
  {
    std::vector<double> result = { time };
    for (const Probe &probe : probes)
    {
      const HistoryParameters &wanted = probe.parameters;
      const unsigned int k            = 2 * probe.entity + wanted.component;
      double value                    = 0.;
      switch (wanted.quantity)
      {
      case HistoryQuantity::boundary_displacement:
        value = state.displacement[k];
        break;
      case HistoryQuantity::boundary_velocity:
        value = state.velocity[k];
        break;
      case HistoryQuantity::boundary_traction:
        value = state.traction[k];
        break;
      case HistoryQuantity::boundary_hoop_stress:
        value = state.hoop_stress[probe.entity];
        break;
      case HistoryQuantity::boundary_force:
        value = force(wanted, state);
        break;
      default:
        break;
      }
      result.push_back(value);
    }
    return result;
  }

  void BoundaryHistories::set_interior(std::vector<double> &row,
                                       const Eigen::VectorXd &displacement,
                                       const Eigen::VectorXd &velocity) const
  {
    for (std::size_t i = 0; i < probes.size(); ++i)
    {
      const HistoryParameters &wanted = probes[i].parameters;
      const unsigned int k            = 2 * probes[i].entity + wanted.component;
      if (wanted.quantity == HistoryQuantity::displacement)
        row[1 + i] = displacement[k];
      else if (wanted.quantity == HistoryQuantity::velocity)
        row[1 + i] = velocity[k];
    }
  }
} // namespace quoin
