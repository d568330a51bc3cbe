// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/point_text.h>
#include <quoin/farfield/boundary_geometry.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/plane_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <utility>

namespace quoin
{
  namespace
  {
    using constants::pi;

    using Points = std::vector<dealii::Point<2>>;

    [[noreturn]] void fail(const std::string &name, const std::string &why)
    {
      throw InputError("section 'Boundary elements/" + name + "': " + why);
    }

    /** A polyline; if it is closed, the first point is not repeated. */
    struct Curve
    {
      Points points;
      bool closed = false;

      std::size_t n_edges() const
      {
        return closed ? points.size() : points.size() - 1;
      }
      const dealii::Tensor<1, 2> &end(const std::size_t edge) const
      {
        return points[(edge + 1) % points.size()];
      }
      void reverse()
      {
        std::reverse(points.begin(), points.end());
      }
      double area() const
      {
        double twice = 0.;
        for (std::size_t k = 0; k < points.size(); ++k)
          twice += points[k][0] * end(k)[1] - points[k][1] * end(k)[0];
        return 0.5 * twice;
      }
    };

    /** Shares @p n elements among pieces, at least one for each. */
    std::vector<unsigned int> shares(const std::vector<double> &lengths,
                                     const unsigned int n)
    {
      std::vector<unsigned int> result(lengths.size(), 1);
      for (unsigned int k = lengths.size(); k < n; ++k)
      {
        // The piece with the longest elements gets one more.
        std::size_t best = 0;
        for (std::size_t i = 1; i < lengths.size(); ++i)
          if (lengths[i] / result[i]
              > lengths[best] / result[best] * (1. + 1e-9))
            best = i;
        ++result[best];
      }
      return result;
    }

    /** More would not fit into any memory: lags need the square of it. */
    constexpr double most_elements = 20000.;

    /** @p n elements that a length needs; refuses too many. */
    unsigned int checked(const BoundaryCurveParameters &parameters,
                         const double n, const double element_length)
    {
      if (!(n <= most_elements))
      {
        std::ostringstream why;
        why << "'Element length = " << element_length << "' makes " << n
            << " elements, more than " << most_elements
            << ". Give a longer one.";
        fail(parameters.name, why.str());
      }
      return static_cast<unsigned int>(n);
    }

    /** Cuts the edges of a curve into equal elements. */
    Curve cut(const Curve &curve, const BoundaryCurveParameters &parameters,
              const double element_length)
    {
      std::vector<double> lengths;
      for (std::size_t k = 0; k < curve.n_edges(); ++k)
        lengths.push_back((curve.end(k) - curve.points[k]).norm());
      std::vector<unsigned int> numbers(lengths.size());
      if (parameters.n_elements > 0)
      {
        if (parameters.n_elements < lengths.size())
          fail(parameters.name,
               "'Elements = " + std::to_string(parameters.n_elements)
                   + "' is less than the number of straight "
                     "pieces, "
                   + std::to_string(lengths.size())
                   + ". Give at least one for each.");
        numbers = shares(lengths, parameters.n_elements);
      }
      else
        for (std::size_t k = 0; k < lengths.size(); ++k)
          // A quotient that should be whole is not rounded up.
          numbers[k]
              = checked(parameters,
                        std::max(1., std::ceil(lengths[k] / element_length
                                               * (1. - 1e-9))),
                        element_length);
      Curve result;
      result.closed = curve.closed;
      for (std::size_t k = 0; k < lengths.size(); ++k)
        for (unsigned int i = 0; i < numbers[k]; ++i)
          result.points.push_back(curve.points[k]
                                  + (curve.end(k) - curve.points[k])
                                        * (double(i) / numbers[k]));
      if (!curve.closed)
        result.points.push_back(curve.points.back());
      return result;
    }

    /** Places 0 = s_0 < ... < s_n = 1 of the ends of graded elements. */
    std::vector<double> graded(const BoundaryCurveParameters &parameters,
                               const double length, const double element_length)
    {
      const double g    = parameters.grading;
      const auto places = [&](const unsigned int n)
      {
        std::vector<double> s(n + 1, 0.);
        for (unsigned int k = 0; k < n; ++k)
          s[k + 1] = s[k] + (n > 1 ? std::pow(g, double(k) / (n - 1)) : 1.);
        for (double &place : s)
          place /= s.back();
        // Division by itself, but of a value that the loop has changed.
        s.back() = 1.;
        return s;
      };
      if (parameters.n_elements > 0)
        return places(parameters.n_elements);
      const double wanted = element_length / length * (1. + 1e-9);
      const auto shortest = [&](const unsigned int n)
      {
        const auto s = places(n);
        return g > 1. ? s[1] : s[n] - s[n - 1];
      };
      unsigned int most = 1;
      while (shortest(most) > wanted)
        most = checked(parameters, 2. * most, element_length);
      unsigned int least = most / 2; // too few
      while (most - least > 1)
      {
        const unsigned int middle                  = (most + least) / 2;
        (shortest(middle) > wanted ? least : most) = middle;
      }
      return places(most);
    }

    Curve make_circle(const BoundaryCurveParameters &parameters,
                      const double element_length)
    {
      const unsigned int n
          = parameters.n_elements > 0
                ? parameters.n_elements
                : checked(
                    parameters,
                    std::max(3., std::ceil(2. * pi * parameters.radius
                                           / element_length * (1. - 1e-9))),
                    element_length);
      const double part = pi / n;
      double radius     = parameters.radius;
      if (parameters.polygon == CirclePolygon::equal_area)
        radius *= std::sqrt(2. * part / std::sin(2. * part));
      else if (parameters.polygon == CirclePolygon::equal_perimeter)
        radius *= part / std::sin(part);
      Curve curve;
      curve.closed = true;
      for (unsigned int k = 0; k < n; ++k)
      {
        const double angle = parameters.angles[0] + 2. * pi * k / n;
        curve.points.push_back(
            dealii::Point<2>(parameters.centre[0], parameters.centre[1])
            + radius * dealii::Point<2>(std::cos(angle), std::sin(angle)));
      }
      return curve;
    }

    Curve make_arc(const BoundaryCurveParameters &parameters,
                   const double element_length)
    {
      const double from = parameters.angles[0];
      const double span = parameters.angles[1] - from;
      Curve curve;
      for (const double s : graded(
               parameters, parameters.radius * std::abs(span), element_length))
      {
        const double angle = from + s * span;
        curve.points.push_back(
            dealii::Point<2>(parameters.centre[0], parameters.centre[1])
            + parameters.radius
                  * dealii::Point<2>(std::cos(angle), std::sin(angle)));
      }
      return curve;
    }

    using MeshEdge = std::array<unsigned int, 2>;

    /**
     * The edges of named curves of a mesh, those of the first curve first.
     * Vertices at one place become one: blocks that touch without sharing
     * vertices are passed without a gap.
     */
    std::vector<MeshEdge>
    edges_of_curves(const BoundaryCurveParameters &parameters,
                    const MeshData<2> &mesh)
    {
      double size = 0.;
      for (const auto &vertex : mesh.vertices)
        size = std::max({ size, std::abs(vertex[0]), std::abs(vertex[1]) });
      std::map<std::array<long long, 2>, unsigned int> vertex_at;
      const auto one_at = [&](const unsigned int v)
      {
        const double scale = 1e9 / size;
        const long long i  = std::llround(mesh.vertices[v][0] * scale);
        const long long k  = std::llround(mesh.vertices[v][1] * scale);
        // Rounding may part places that are the same, by one.
        for (const long long di : { 0, -1, 1 })
          for (const long long dk : { 0, -1, 1 })
            if (const auto found = vertex_at.find({ { i + di, k + dk } });
                found != vertex_at.end())
              return found->second;
        vertex_at[{ { i, k } }] = v;
        return v;
      };
      std::vector<MeshEdge> edges;
      for (const std::string &name : parameters.curves)
      {
        const auto found
            = std::find(mesh.face_names.begin(), mesh.face_names.end(), name);
        const unsigned int number = found - mesh.face_names.begin();
        const std::size_t before  = edges.size();
        for (std::size_t l = 0; l < mesh.faces.size(); ++l)
          if (mesh.face_name[l] == number)
            edges.push_back(
                { { one_at(mesh.faces[l][0]), one_at(mesh.faces[l][1]) } });
        if (edges.size() == before)
          fail(parameters.name, "'Curves' names '" + name
                                    + "', which is no physical curve of the "
                                      "mesh. These are: "
                                    + known_names_like(name, mesh.face_names)
                                    + ".");
      }
      return edges;
    }

    /** Vertices in the order of a walk along @p edges from @p first; and
        whether it passes the first edge forward. */
    std::pair<std::vector<unsigned int>, bool>
    walk(const std::vector<MeshEdge> &edges,
         const std::map<unsigned int, std::vector<std::size_t>> &edges_of,
         const unsigned int first, const std::string &boundary)
    {
      std::vector<bool> used(edges.size(), false);
      std::vector<unsigned int> order = { first };
      bool forward                    = true;
      while (true)
      {
        std::size_t next = edges.size();
        // A loop begins with its first edge.
        for (const std::size_t e : edges_of.at(order.back()))
          if (!used[e] && (next == edges.size() || e < next))
            next = e;
        if (next == edges.size())
          break;
        used[next] = true;
        if (next == 0)
          forward = edges[0][0] == order.back();
        order.push_back(edges[next][0] == order.back() ? edges[next][1]
                                                       : edges[next][0]);
      }
      if (std::find(used.begin(), used.end(), false) != used.end())
        fail(boundary, "'Curves': they do not hang together. Make one "
                       "boundary of each closed curve.");
      return { order, forward };
    }

    /** Joins the edges of named curves of a mesh end to end, in the direction
        of the first edge of the first curve. */
    Curve chain(const BoundaryCurveParameters &parameters,
                const MeshData<2> &mesh)
    {
      const auto edges = edges_of_curves(parameters, mesh);
      std::map<unsigned int, std::vector<std::size_t>> edges_of;
      for (std::size_t e = 0; e < edges.size(); ++e)
        for (const unsigned int v : edges[e])
          edges_of[v].push_back(e);
      const auto position = [&](const unsigned int v)
      { return dealii::Point<2>(mesh.vertices[v][0], mesh.vertices[v][1]); };
      std::vector<unsigned int> ends;
      for (const auto &[v, list] : edges_of)
        if (list.size() > 2)
          fail(parameters.name, "'Curves': they branch at "
                                    + point_text(position(v))
                                    + ". Make one boundary of each branch.");
        else if (list.size() == 1)
          ends.push_back(v);
      if (ends.size() > 2)
        fail(parameters.name, "'Curves': they do not hang together; ends are "
                              "at "
                                  + point_text(position(ends[0])) + ", "
                                  + point_text(position(ends[1])) + " and "
                                  + point_text(position(ends[2]))
                                  + ". Make one boundary of each piece.");

      auto [order, forward]
          = walk(edges, edges_of, ends.empty() ? edges[0][0] : ends.front(),
                 parameters.name);
      Curve curve;
      curve.closed = ends.empty();
      if (curve.closed)
        order.pop_back();
      for (const unsigned int v : order)
        curve.points.push_back(position(v));
      if (!forward)
        curve.reverse();
      return curve;
    }

    /** Removes the points between collinear edges. */
    Curve without_straight_points(const Curve &curve)
    {
      const std::size_t n = curve.points.size();
      Curve result;
      result.closed = curve.closed;
      for (std::size_t k = 0; k < n; ++k)
      {
        const bool is_end = !curve.closed && (k == 0 || k + 1 == n);
        const dealii::Tensor<1, 2> before
            = curve.points[k] - curve.points[(k + n - 1) % n];
        const dealii::Tensor<1, 2> after = curve.end(k) - curve.points[k];
        const double sine = (before[0] * after[1] - before[1] * after[0])
                            / (before.norm() * after.norm());
        if (is_end || std::abs(sine) > 1e-6 || before * after < 0.)
          result.points.push_back(curve.points[k]);
      }
      return result;
    }

    /**
     * Divides edges that end at the places @p place, from 0 on, among
     * @p n_parts elements, where their ends are nearest to equal parts: the
     * places at which elements begin, and the end of the last, by number.
     */
    std::vector<std::size_t> divided(const std::vector<double> &place,
                                     const std::size_t n_parts)
    {
      std::vector<std::size_t> ends = { 0 };
      for (std::size_t part = 0; part < n_parts; ++part)
      {
        const double wanted = place.back() * double(part + 1) / n_parts;
        // At least one edge for this element and each one to come.
        const std::size_t last = place.size() - 1 - (n_parts - part - 1);
        std::size_t at         = ends.back() + 1;
        while (at < last
               && std::abs(place[at + 1] - wanted)
                      <= std::abs(place[at] - wanted))
          ++at;
        ends.push_back(at);
      }
      return ends;
    }

    /**
     * Divides edges as divided() into as many elements as make the sum of the
     * squares of their differences from @p element_length [m] least. Elements
     * that span more than one edge are at most a fifth longer than that. A
     * stricter limit would leave short edges as elements of their own, and the
     * shortest element bounds the time step.
     */
    std::vector<std::size_t> divided_by_length(const std::vector<double> &place,
                                               const double element_length)
    {
      constexpr double longest = 1.2;
      const std::size_t n      = place.size() - 1;
      // For the edges before each place: the least sum of squares, and the
      // place where the last element of that division begins.
      std::vector<double> least(n + 1, 0.);
      std::vector<std::size_t> begin(n + 1, 0);
      for (std::size_t end = 1; end <= n; ++end)
      {
        least[end] = std::numeric_limits<double>::infinity();
        for (std::size_t at = end; at-- > 0;)
        {
          const double length = place[end] - place[at];
          if (at + 1 < end && length > longest * element_length)
            break;
          const double distance = length - element_length;
          const double sum      = least[at] + distance * distance;
          if (sum < least[end])
          {
            least[end] = sum;
            begin[end] = at;
          }
        }
      }
      std::vector<std::size_t> ends = { n };
      while (ends.back() > 0)
        ends.push_back(begin[ends.back()]);
      std::reverse(ends.begin(), ends.end());
      return ends;
    }

    /**
     * Leaves out points so that the edges are about as long as wanted; corners
     * of more than 20 degrees stay.
     */
    Curve with_whole_edges(const Curve &curve,
                           const BoundaryCurveParameters &parameters,
                           const double element_length)
    {
      const double corner      = std::cos(20. * constants::degree);
      const std::size_t n      = curve.points.size();
      const std::size_t n_edge = curve.n_edges();
      double total             = 0.;
      for (std::size_t k = 0; k < n_edge; ++k)
        total += (curve.end(k) - curve.points[k]).norm();

      // Begin at a corner, if a closed curve has one.
      const auto is_corner = [&](const std::size_t k)
      {
        if (!curve.closed && (k == 0 || k + 1 == n))
          return true;
        const dealii::Tensor<1, 2> before
            = curve.points[k] - curve.points[(k + n - 1) % n];
        const dealii::Tensor<1, 2> after = curve.end(k) - curve.points[k];
        return before * after < corner * before.norm() * after.norm();
      };
      std::size_t first = 0;
      while (first + 1 < n && !is_corner(first))
        ++first;
      if (!is_corner(first))
        first = 0;

      Curve result;
      result.closed = curve.closed;
      for (std::size_t k = 0; k < n_edge;)
      {
        // A piece from corner to corner.
        std::vector<double> place = { 0. };
        std::size_t end           = k;
        do
        {
          const std::size_t edge = (first + end) % n;
          place.push_back(place.back()
                          + (curve.end(edge) - curve.points[edge]).norm());
          ++end;
        } while (end < n_edge && !is_corner((first + end) % n));
        const std::size_t n_parts = std::clamp<std::size_t>(
            std::size_t(
                std::lround(place.back() / total * parameters.n_elements)),
            1, end - k);
        const auto ends = parameters.n_elements > 0
                              ? divided(place, n_parts)
                              : divided_by_length(place, element_length);
        for (std::size_t part = 0; part + 1 < ends.size(); ++part)
          result.points.push_back(curve.points[(first + k + ends[part]) % n]);
        k = end;
      }
      if (!curve.closed)
        result.points.push_back(curve.points.back());
      return result;
    }

    Curve make_curve(const BoundaryCurveParameters &parameters,
                     const double default_length, const MeshData<2> &mesh)
    {
      const double length = parameters.element_length > 0.
                                ? parameters.element_length
                                : default_length;
      Curve curve;
      switch (parameters.shape)
      {
      case BoundaryShape::circle:
        curve = make_circle(parameters, length);
        break;
      case BoundaryShape::arc:
        curve = make_arc(parameters, length);
        break;
      case BoundaryShape::polygon:
      case BoundaryShape::line:
        curve.closed = parameters.shape == BoundaryShape::polygon;
        for (const auto &point : parameters.points)
          curve.points.emplace_back(point[0], point[1]);
        if (!curve.closed && parameters.grading != 1.)
        {
          const dealii::Point<2> a = curve.points[0], b = curve.points[1];
          curve.points.clear();
          for (const double s : graded(parameters, (b - a).norm(), length))
            curve.points.push_back((1. - s) * a + s * b);
        }
        else
          curve = cut(curve, parameters, length);
        break;
      case BoundaryShape::mesh:
      case BoundaryShape::interface:
      {
        curve           = chain(parameters, mesh);
        const bool side = parameters.domain == DomainSide::left
                          || parameters.domain == DomainSide::right;
        if (side == curve.closed)
          fail(parameters.name,
               curve.closed
                   ? "'Domain' is left or right, but the curves are closed. "
                     "Use inside or outside."
                   : "'Domain' is inside or outside, but the curves are open: "
                     "they go from "
                         + point_text(curve.points.front()) + " to "
                         + point_text(curve.points.back())
                         + ". Use left or right of that direction.");
        if (parameters.n_elements == 0 && length == 0.)
          break;
        if (parameters.shape == BoundaryShape::interface)
          curve = with_whole_edges(curve, parameters, length);
        else
          curve = cut(without_straight_points(curve), parameters, length);
        break;
      }
      }

      const bool keep
          = parameters.domain == DomainSide::left
            || (parameters.domain == DomainSide::inside && curve.area() > 0.)
            || (parameters.domain == DomainSide::outside && curve.area() < 0.);
      if (!keep)
        curve.reverse();
      return curve;
    }

    void check_elements(const BoundaryGeometry &geometry,
                        const BoundaryElementParameters &parameters)
    {
      const auto &elements = geometry.boundary.elements;
      const auto name      = [&](const std::size_t e)
      { return parameters.boundaries[geometry.owner[e]].name; };
      for (std::size_t e = 0; e < elements.size(); ++e)
        for (std::size_t f = 0; f < e; ++f)
        {
          const BoundaryElement &E = elements[e], &F = elements[f];
          if ((E.middle() - F.middle()).norm()
              > 0.5001 * (E.length() + F.length()))
            continue;
          const std::string where = ": elements near " + point_text(E.middle())
                                    + ", of '" + name(e) + "' and '" + name(f)
                                    + "', ";
          if ((E.a == F.a && E.b != F.b) || (E.b == F.b && E.a != F.a))
            fail(name(e), "'Domain'" + where
                              + "meet, but have the domain on different "
                                "sides. Change 'Domain' of one of them.");
          const bool in_line = E.b == F.a || E.a == F.b;
          if (in_line && !(E.b == F.a && E.a == F.b))
          {
            // Neighbours: they must not lie on each other.
            const dealii::Point<2> turned = E.b == F.a ? F.b : F.a;
            const dealii::Point<2> other  = E.b == F.a ? E.a : E.b;
            const double reach = std::min(distance_to_segment(turned, E.a, E.b),
                                          distance_to_segment(other, F.a, F.b));
            if (reach > 1e-6 * std::min(E.length(), F.length()))
              continue;
          }
          const double least = std::min({ distance_to_segment(E.a, F.a, F.b),
                                          distance_to_segment(E.b, F.a, F.b),
                                          distance_to_segment(F.a, E.a, E.b),
                                          distance_to_segment(F.b, E.a, E.b) });
          if (least < 1e-6 * std::min(E.length(), F.length())
              || segments_meet(E.a, E.b, F.a, F.b))
            fail(name(e), "the boundary crosses, touches or lies on itself"
                              + where
                              + "have points in common. Boundaries may meet "
                                "only end to end, at ends of elements.");
        }
    }
  } // namespace

  namespace
  {
    /** What closed curves enclose must be on the domain's side of others. */
    void check_sides(const std::vector<Curve> &curves,
                     const BoundaryGeometry &geometry,
                     const BoundaryElementParameters &parameters)
    {
      for (std::size_t k = 0; k < curves.size(); ++k)
      {
        if (!curves[k].closed)
          continue;
        Boundary alone;
        alone.add_curve(curves[k].points, true);
        for (std::size_t e = 0; e < geometry.owner.size(); ++e)
          if (geometry.owner[e] != k
              && !nearest_element(alone, geometry.boundary.elements[e].middle())
                      .inside_domain)
          {
            const auto &name  = parameters.boundaries[k].name;
            const auto &other = parameters.boundaries[geometry.owner[e]].name;
            fail(name, "'Domain': the boundary '" + other
                           + "' is not on the side of '" + name
                           + "' where the domain is. Change 'Domain' of one of "
                             "them, or move it.");
          }
      }
    }
  } // namespace

  bool segments_meet(const dealii::Point<2> &a, const dealii::Point<2> &b,
                     const dealii::Point<2> &c, const dealii::Point<2> &d)
  {
    return cross(b - a, c - a) * cross(b - a, d - a) <= 0.
           && cross(d - c, a - c) * cross(d - c, b - c) <= 0.
           && std::max(std::min(a[0], b[0]), std::min(c[0], d[0]))
                  <= std::min(std::max(a[0], b[0]), std::max(c[0], d[0]))
           && std::max(std::min(a[1], b[1]), std::min(c[1], d[1]))
                  <= std::min(std::max(a[1], b[1]), std::max(c[1], d[1]));
  }

  std::vector<dealii::Point<2>>
  BoundaryGeometry::middles(const unsigned int k) const
  {
    std::vector<dealii::Point<2>> result;
    for (unsigned int e = 0; e < owner.size(); ++e)
      if (owner[e] == k)
        result.push_back(boundary.elements[e].middle());
    return result;
  }

  BoundaryGeometry
  make_boundary_geometry(const BoundaryElementParameters &parameters,
                         const MeshData<2> &mesh)
  {
    std::vector<Curve> curves;
    dealii::Point<2> low, high;
    low[0] = low[1] = std::numeric_limits<double>::max();
    high            = -low;
    for (const BoundaryCurveParameters &curve : parameters.boundaries)
    {
      curves.push_back(make_curve(curve, parameters.element_length, mesh));
      for (const dealii::Point<2> &point : curves.back().points)
        for (unsigned int d = 0; d < point.dimension; ++d)
        {
          low[d]  = std::min(low[d], point[d]);
          high[d] = std::max(high[d], point[d]);
        }
    }

    // Ends that meet must be the same point to the last bit.
    const double tolerance = 1e-9 * (high - low).norm();
    Points ends;
    for (Curve &curve : curves)
      if (!curve.closed)
        for (dealii::Point<2> *end :
             { &curve.points.front(), &curve.points.back() })
        {
          const auto known
              = std::find_if(ends.begin(), ends.end(),
                             [&](const dealii::Point<2> &other)
                             { return (other - *end).norm() < tolerance; });
          if (known == ends.end())
            ends.push_back(*end);
          else
            *end = *known;
        }

    BoundaryGeometry geometry;
    for (std::size_t k = 0; k < curves.size(); ++k)
    {
      geometry.boundary.add_curve(curves[k].points, curves[k].closed);
      geometry.owner.resize(geometry.boundary.n_elements(), k);
    }
    if (double(geometry.owner.size()) > most_elements)
      throw InputError("section 'Boundary elements': the boundaries have "
                       + std::to_string(geometry.owner.size())
                       + " elements, more than "
                       + std::to_string(int(most_elements))
                       + " together. Lower 'Elements', or give a longer "
                         "'Element length'.");
    check_elements(geometry, parameters);
    check_sides(curves, geometry, parameters);
    return geometry;
  }

  NearestElement nearest_element(const Boundary &boundary,
                                 const dealii::Point<2> &point)
  {
    NearestElement nearest;
    nearest.distance = std::numeric_limits<double>::max();
    double height    = 0.; // of the point above the line of the element
    for (unsigned int e = 0; e < boundary.n_elements(); ++e)
    {
      const BoundaryElement &element = boundary.elements[e];
      const double distance = distance_to_segment(point, element.a, element.b);
      const double above    = -(element.normal() * (point - element.a));
      const double slack    = 1e-9 * element.length();
      // Of two elements whose common end is nearest, the one that the point
      // is farther off is certain to be on one side.
      if (distance < nearest.distance - slack
          || (distance < nearest.distance + slack
              && std::abs(above) > std::abs(height) + slack))
      {
        nearest = { e, distance, above > 0. };
        height  = above;
      }
    }
    return nearest;
  }
} // namespace quoin
