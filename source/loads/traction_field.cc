// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/none.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/traction_field.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace quoin
{
  namespace
  {
    /** Parts of the edge of a triangle that a jump or a kink cuts. */
    constexpr unsigned int n_parts = 8;

    template <int dim>
    dealii::Point<3> in_space(const dealii::Point<dim> &point)
    {
      dealii::Point<3> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = point[d];
      return result;
    }

    /** Whether @p place along @p normal is inside the face. */
    template <std::size_t n>
    bool is_cut(const std::array<dealii::Point<3>, n> &points,
                const dealii::Tensor<1, 3> &normal, const double place)
    {
      double low  = std::numeric_limits<double>::max(),
             high = std::numeric_limits<double>::lowest();
      for (const dealii::Point<3> &point : points)
      {
        low  = std::min(low, normal * point);
        high = std::max(high, normal * point);
      }
      return low < place && place < high;
    }

    dealii::Tensor<1, 3> unit_vector(const unsigned int axis)
    {
      dealii::Tensor<1, 3> result;
      result[axis] = 1.;
      return result;
    }
  } // namespace

  template <int dim>
  TractionField<dim>::TractionField(
      const LoadParameters &parameters, const NodeMap<dim> &node_map,
      const std::vector<BoundaryFace<dim>> &all_faces,
      const Thickness &thickness)
    : components(parameters.components), pressure(parameters.pressure),
      distribution(parameters.distribution), shape(parameters.shape)
  {
    std::map<unsigned int, unsigned int> slots;
    for (const BoundaryFace<dim> &given : all_faces)
    {
      Face face;
      bool is_here = false;
      for (unsigned int k = 0; k < dim; ++k)
      {
        face.points[k] = in_space<dim>(given.points[k]);
        face.shares[k] = given.shares[k];
        face.slots[k]  = none;
        if (!node_map.exchange().owns(given.nodes[k]))
          continue;
        is_here                   = true;
        const auto [slot, is_new] = slots.emplace(
            node_map.exchange().local(given.nodes[k]), node_list.size());
        if (is_new)
          node_list.push_back(slot->first);
        face.slots[k] = slot->second;
      }
      face.outward = thickness[given.group] * outward_area(given.points);
      if (is_here)
        faces.push_back(face);
    }
    last_forces.resize(node_list.size());
  }

  template <int dim>
  std::vector<double> TractionField<dim>::data_at(const TimePoint &time) const
  {
    std::vector<double> data;
    if (shape)
      data = shape->at(time);
    for (const LoadComponent *part :
         { &components[0], &components[1], &components[2], &pressure })
    {
      if (part->quantity == LoadQuantity::free)
        continue;
      data.push_back(part->value(time));
      if (part->field && part->field->is_function_of_time())
        data.insert(data.end(), { time.stage, time.total });
      if (part->field && part->field->uplift())
        data.insert(data.end(),
                    { part->field->uplift()->headwater(time),
                      part->field->uplift()->tailwater(time), crack_length });
    }
    return data;
  }

  template <int dim>
  std::vector<typename TractionField<dim>::Cut>
  TractionField<dim>::cuts_at(const TimePoint &time) const
  {
    std::vector<Cut> cuts;
    if (shape)
    {
      std::vector<double> places;
      shape->add_kinks(shape->at(time), places);
      for (const double place : places)
        cuts.push_back({ unit_vector(shape->axis), place });
    }
    if (pressure.field && pressure.field->level())
      cuts.push_back(
          { unit_vector(dim - 1), (*pressure.field->level())(time) });
    if (pressure.field && pressure.field->uplift())
    {
      const UpliftDiagram &uplift = *pressure.field->uplift();
      const dealii::Tensor<1, 2> base
          = (uplift.toe - uplift.heel) / uplift.length();
      const dealii::Point<3> along(base[0], base[1], 0.);
      const double start = base * uplift.heel;
      for (const double kink : uplift.kinks(crack_length))
        cuts.push_back({ along, start + kink });
    }
    return cuts;
  }

  template <>
  void TractionField<2>::find_points(const Face &face,
                                     const std::vector<Cut> &cuts,
                                     std::vector<QuadraturePoint> &points) const
  {
    const double gauss[]       = { -std::sqrt(0.6), 0., std::sqrt(0.6) };
    constexpr double weights[] = { 5. / 18., 8. / 18., 5. / 18. };
    std::vector<double> ends   = { 0., 1. };
    for (const Cut &cut : cuts)
      if (is_cut(face.points, cut.normal, cut.place))
      {
        const double first = cut.normal * face.points[0];
        ends.push_back((cut.place - first)
                       / (cut.normal * face.points[1] - first));
      }
    std::sort(ends.begin(), ends.end());
    points.clear();
    for (unsigned int i = 0; i + 1 < ends.size(); ++i)
    {
      const double length = ends[i + 1] - ends[i];
      for (unsigned int q = 0; q < 3; ++q)
      {
        const double at = ends[i] + 0.5 * length * (1. + gauss[q]);
        points.push_back({ { { 1. - at, at } }, weights[q] * length });
      }
    }
  }

  template <>
  void TractionField<3>::find_points(const Face &face,
                                     const std::vector<Cut> &cuts,
                                     std::vector<QuadraturePoint> &points) const
  {
    const bool divided
        = std::any_of(cuts.begin(), cuts.end(),
                      [&](const Cut &cut)
                      { return is_cut(face.points, cut.normal, cut.place); });
    const unsigned int n = divided ? n_parts : 1;
    points.clear();
    // Triangles of the grid with the edge 1/n, upright and upside down.
    const auto add = [&](const double i, const double j, const double turn)
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        const double u = (i + turn * (k == 1 ? 2. / 3. : 1. / 6.)) / n,
                     v = (j + turn * (k == 2 ? 2. / 3. : 1. / 6.)) / n;
        points.push_back({ { { 1. - u - v, u, v } }, 1. / (3. * n * n) });
      }
    };
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; i + j < n; ++j)
      {
        add(i, j, 1.);
        if (i + j + 1 < n)
          add(i + 1., j + 1., -1.);
      }
  }

  template <int dim>
  dealii::Tensor<1, dim>
  TractionField<dim>::traction(const dealii::Point<3> &place,
                               const TimePoint &time,
                               const std::vector<double> &centres,
                               const dealii::Tensor<1, dim> &normal) const
  {
    dealii::Tensor<1, dim> result;
    double factor = shape ? shape->factor(place[shape->axis], centres) : 1.;
    if (factor == 0.)
      return result;
    if (distribution)
      factor *= (*distribution)(place, 0.);
    const auto value = [&](const LoadComponent &part)
    {
      return part.field ? (*part.field)(place, time, dim - 1, crack_length)
                        : part.value(time);
    };
    for (unsigned int d = 0; d < dim; ++d)
      if (components[d].quantity != LoadQuantity::free)
        result[d] = value(components[d]);
    if (pressure.quantity != LoadQuantity::free)
      result -= value(pressure) * normal;
    return factor * result;
  }

  template <int dim>
  const std::vector<dealii::Tensor<1, dim>> &
  TractionField<dim>::forces(const TimePoint &time) const
  {
    std::vector<double> data = data_at(time);
    if (data == last_data)
      return last_forces;
    last_data = std::move(data);
    last_forces.assign(node_list.size(), dealii::Tensor<1, dim>());
    const std::vector<Cut> cuts = cuts_at(time);
    const std::vector<double> centres
        = shape ? shape->at(time) : std::vector<double>();
    std::vector<QuadraturePoint> points;
    for (const Face &face : faces)
    {
      const double area = face.outward.norm();
      find_points(face, cuts, points);
      for (const QuadraturePoint &point : points)
      {
        dealii::Point<3> place;
        for (unsigned int k = 0; k < dim; ++k)
          place += point.coordinates[k] * face.points[k];
        const dealii::Tensor<1, dim> force
            = area * point.weight
              * traction(place, time, centres, face.outward / area);
        for (unsigned int k = 0; k < dim; ++k)
        {
          if (face.slots[k] == none)
            continue;
          const double part = point.coordinates[k] + face.shares[k] - 1. / dim;
          for (unsigned int d = 0; d < dim; ++d)
            last_forces[face.slots[k]][d] += part * force[d];
        }
      }
    }
    return last_forces;
  }

  template <int dim>
  std::vector<dealii::Point<3>>
  sample_places(const std::vector<BoundaryFace<dim>> &faces)
  {
    constexpr std::size_t most = 16;
    const std::size_t n        = std::min(most, faces.size());
    std::vector<dealii::Point<3>> places;
    for (std::size_t i = 0; i < n; ++i)
      places.push_back(
          in_space<dim>(faces[i * faces.size() / n].points[i % dim]));
    return places;
  }

  template class TractionField<2>;
  template class TractionField<3>;
  template std::vector<dealii::Point<3>>
  sample_places(const std::vector<BoundaryFace<2>> &);
  template std::vector<dealii::Point<3>>
  sample_places(const std::vector<BoundaryFace<3>> &);
} // namespace quoin
