// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/none.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/traction_field.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

namespace quoin
{
  namespace
  {
    /** How often an edge is halved at most: a jump is found to a thousandth
        of it. */
    constexpr unsigned int most_halvings = 10;
    /** How often a triangle is divided at most: cut ones have edges of a
        sixteenth in the end. */
    constexpr unsigned int most_divisions = 4;
    /** By how much of the largest traction one in a part of a face may differ
        from quadratic, for which the rule of three points is nearly exact. */
    constexpr double most_deviation = 1e-3;

    /** An interval on an edge of length 1. */
    struct Interval
    {
      double begin, end;
      unsigned int halvings = 0;

      /** The place at @p x between -1 and 1. */
      double at(const double x) const
      {
        return begin + 0.5 * (end - begin) * (1. + x);
      }
      double middle() const
      {
        return at(0.);
      }
    };
    /** Places and weights of the Gauss rule of an interval. */
    const std::array<double, 3> gauss = { -std::sqrt(0.6), 0., std::sqrt(0.6) };
    constexpr std::array<double, 3> gauss_weights
        = { 5. / 18., 8. / 18., 5. / 18. };

    /** Whether @p q, a vector by place, at the outer points of the rule of
        @p part differs from the quadratic function that is @p q at its middle
        and just inside of its ends, where there may be jumps. */
    template <typename Q>
    bool deviates(const Interval &part, const Q &q)
    {
      constexpr double inside           = 1. - 1e-6;
      const dealii::Tensor<1, 2> low    = q(part.at(-inside)),
                                 middle = q(part.middle()),
                                 high   = q(part.at(inside));
      const double largest
          = std::max({ low.norm(), middle.norm(), high.norm() });
      for (const double x : { gauss[0], gauss[2] })
      {
        const dealii::Tensor<1, 2> value     = q(part.at(x));
        const dealii::Tensor<1, 2> quadratic = 0.5 * x * (x - 1.) * low
                                               + (1. - x * x) * middle
                                               + 0.5 * x * (x + 1.) * high;
        // No interval is divided where the traction is no number.
        if ((value - quadratic).norm()
            > most_deviation * std::max(largest, value.norm()))
          return true;
      }
      return false;
    }

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

    using Barycentric = std::array<double, 3>;
    using Triangle    = std::array<Barycentric, 3>;

    /** The point of @p triangle with the coordinates @p at in it. */
    Barycentric point_of(const Triangle &triangle, const Barycentric &at)
    {
      Barycentric result{};
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int d = 0; d < 3; ++d)
          result[d] += at[k] * triangle[k][d];
      return result;
    }

    /** The rule of three points of @p triangle. */
    std::array<Barycentric, 3> rule_of(const Triangle &triangle)
    {
      constexpr double most = 2. / 3., least = 1. / 6.;
      return { point_of(triangle, { most, least, least }),
               point_of(triangle, { least, most, least }),
               point_of(triangle, { least, least, most }) };
    }

    /** The four similar triangles of @p triangle; the last one is between the
        middles of its edges. */
    std::array<Triangle, 4> parts_of(const Triangle &triangle)
    {
      const auto &[a, b, c] = triangle;
      const Barycentric ab  = point_of(triangle, { 0.5, 0.5, 0. }),
                        bc  = point_of(triangle, { 0., 0.5, 0.5 }),
                        ca  = point_of(triangle, { 0.5, 0., 0.5 });
      return {
        { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { bc, ca, ab } }
      };
    }

    /** Whether @p q, a vector by place, at the points of the rule of @p
       triangle differs from the quadratic function that is @p q at its corners
       and in the middle of its edges. */
    template <typename Q>
    bool deviates(const Triangle &triangle, const Q &q)
    {
      const std::array<Triangle, 4> parts = parts_of(triangle);
      std::array<dealii::Tensor<1, 3>, 3> corner, opposite;
      double largest = 0.;
      for (unsigned int k = 0; k < 3; ++k)
      {
        corner[k]   = q(triangle[k]);
        opposite[k] = q(parts[3][k]);
        largest = std::max({ largest, corner[k].norm(), opposite[k].norm() });
      }
      const std::array<Barycentric, 3> rule = rule_of(triangle);
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int l = (k + 1) % 3, m = (k + 2) % 3;
        const dealii::Tensor<1, 3> value = q(rule[k]);
        const dealii::Tensor<1, 3> quadratic
            = (2. * corner[k] - corner[l] - corner[m] + opposite[k]
               + 4. * (opposite[l] + opposite[m]))
              / 9.;
        // No triangle is divided where the traction is no number.
        if ((value - quadratic).norm()
            > most_deviation * std::max(largest, value.norm()))
          return true;
      }
      return false;
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
    const auto is_by_place = [](const LoadComponent &part)
    { return part.field && part.field->is_function_of_place(); };
    is_function_of_place
        = distribution || shape || is_by_place(pressure)
          || std::any_of(components.begin(), components.end(), is_by_place);
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
      face.outward = thickness.common(given.group, given.across)
                     * outward_area(given.points);
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
  void TractionField<2>::find_points(
      const Face &face, const std::vector<Cut> &cuts,
      const std::function<dealii::Tensor<1, 2>(const dealii::Point<3> &)> &q,
      std::vector<QuadraturePoint> &points) const
  {
    std::vector<double> ends = { 0., 1. };
    for (const Cut &cut : cuts)
      if (is_cut(face.points, cut.normal, cut.place))
      {
        const double first = cut.normal * face.points[0];
        ends.push_back((cut.place - first)
                       / (cut.normal * face.points[1] - first));
      }
    std::sort(ends.begin(), ends.end());
    const auto q_at = [&](const double at)
    {
      return q(
          dealii::Point<3>((1. - at) * face.points[0] + at * face.points[1]));
    };
    points.clear();
    std::vector<Interval> left;
    for (unsigned int i = 0; i + 1 < ends.size(); ++i)
      left.push_back({ ends[i], ends[i + 1] });
    while (!left.empty())
    {
      const Interval part = left.back();
      left.pop_back();
      if (is_function_of_place && part.halvings < most_halvings
          && deviates(part, q_at))
      {
        left.push_back({ part.begin, part.middle(), part.halvings + 1 });
        left.push_back({ part.middle(), part.end, part.halvings + 1 });
        continue;
      }
      for (unsigned int k = 0; k < 3; ++k)
      {
        const double at = part.at(gauss[k]);
        points.push_back({ { { 1. - at, at } },
                           gauss_weights[k] * (part.end - part.begin) });
      }
    }
  }

  template <>
  void TractionField<3>::find_points(
      const Face &face, const std::vector<Cut> &cuts,
      const std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &)> &q,
      std::vector<QuadraturePoint> &points) const
  {
    const auto place = [&](const Barycentric &at)
    {
      dealii::Point<3> result;
      for (unsigned int k = 0; k < 3; ++k)
        result += at[k] * face.points[k];
      return result;
    };
    const auto is_divided = [&](const Triangle &triangle)
    {
      const std::array<dealii::Point<3>, 3> corners
          = { place(triangle[0]), place(triangle[1]), place(triangle[2]) };
      return std::any_of(cuts.begin(), cuts.end(),
                         [&](const Cut &cut)
                         { return is_cut(corners, cut.normal, cut.place); })
             || (is_function_of_place
                 && deviates(triangle, [&](const Barycentric &at)
                             { return q(place(at)); }));
    };
    points.clear();
    std::vector<std::pair<Triangle, unsigned int>> left
        = { { { { { 1., 0., 0. }, { 0., 1., 0. }, { 0., 0., 1. } } }, 0 } };
    while (!left.empty())
    {
      const auto [triangle, divisions] = left.back();
      left.pop_back();
      if (divisions < most_divisions && is_divided(triangle))
        for (const Triangle &part : parts_of(triangle))
          left.emplace_back(part, divisions + 1);
      else
        for (const Barycentric &at : rule_of(triangle))
          points.push_back({ at, std::ldexp(1. / 3., -2 * int(divisions)) });
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
      const double area                   = face.outward.norm();
      const dealii::Tensor<1, dim> normal = face.outward / area;
      const auto q                        = [&](const dealii::Point<3> &place)
      { return traction(place, time, centres, normal); };
      find_points(face, cuts, std::cref(q), points);
      for (const QuadraturePoint &point : points)
      {
        dealii::Point<3> place;
        for (unsigned int k = 0; k < dim; ++k)
          place += point.coordinates[k] * face.points[k];
        const dealii::Tensor<1, dim> force = area * point.weight * q(place);
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
