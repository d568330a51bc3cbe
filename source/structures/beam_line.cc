// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/structures/beam_line.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 2>;

    double turn(const Vector &a, const Vector &b)
    {
      return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    }

    Vector along(const NodeRecord<2> &a, const NodeRecord<2> &b,
                 const bool at_rest)
    {
      const double now = at_rest ? 0. : 1.;
      return Vector({ b.X[0] - a.X[0] + now * (b.u[0] - a.u[0]),
                      b.X[1] - a.X[1] + now * (b.u[1] - a.u[1]) });
    }

    /** Least turning angle of both neighbours where a line is curved, by that
        of a node [-]. */
    constexpr double least_share = 0.5;
  } // namespace

  BeamLine::BeamLine(const BeamParameters &given, const double thickness,
                     const unsigned int begin,
                     const std::vector<dealii::Point<2>> &places,
                     const bool is_closed)
    : given(given), begin(begin), end(begin + places.size()),
      is_closed(is_closed), share(thickness / given.spacing),
      axial_stiffness(share * given.modulus * given.area),
      bending_stiffness(share * given.modulus * given.second_moment),
      hinge(share * given.hinge_moment), places(places), rest(places.size())
  {
  }

  boost::container::static_vector<unsigned int, 2>
  BeamLine::segments_at(const unsigned int node) const
  {
    boost::container::static_vector<unsigned int, 2> result;
    if (has_before(node))
      result.push_back(previous(node));
    if (has_after(node))
      result.push_back(node);
    return result;
  }

  bool BeamLine::held(const unsigned int node, const unsigned int d) const
  {
    if (is_closed || (node != begin && node + 1 != end))
      return false;
    const BeamSupport &support = given.supports[node == begin ? 0 : 1];
    return d == 0 ? support.holds_x : support.holds_y;
  }

  void BeamLine::find_rest(const BeamState &beams)
  {
    const auto &nodes = beams.nodes;
    rest.assign(rest.size(), AtRest());
    for (unsigned int i = begin; i < end; ++i)
    {
      if (!has_after(i))
        continue;
      const Vector way        = along(nodes[i], nodes[next(i)], true);
      rest[i - begin].segment = std::hypot(way[0], way[1]);
    }
    for (unsigned int i = begin; i < end; ++i)
    {
      AtRest &node = rest[i - begin];
      for (const unsigned int first : segments_at(i))
        node.length += 0.5 * at_rest(first).segment;
      if (has_before(i) && has_after(i))
        node.angle = turn(along(nodes[previous(i)], nodes[i], true),
                          along(nodes[i], nodes[next(i)], true));
    }
    // A line is curved where its neighbours turn as well; elsewhere there is
    // a corner.
    for (unsigned int i = begin; i < end; ++i)
    {
      AtRest &node   = rest[i - begin];
      bool is_curved = has_before(i) && has_after(i);
      for (const unsigned int other : { previous(i), next(i) })
        is_curved = is_curved
                    && (at_rest(other).angle / node.angle > least_share
                        || !has_before(other) || !has_after(other));
      if (is_curved)
        node.curvature = node.angle / node.length;
    }
  }

  BeamLine::Segment BeamLine::segment(const unsigned int first,
                                      const BeamState &beams) const
  {
    const Vector now
        = along(beams.nodes[first], beams.nodes[next(first)], false);
    const double size = std::hypot(now[0], now[1]);
    return { Vector({ now[0] / size, now[1] / size }), size,
             at_rest(first).segment };
  }

  bool BeamLine::turning(const unsigned int node, const BeamState &beams,
                         double &angle) const
  {
    const bool is_start = !has_before(node);
    const bool is_end   = !has_after(node);
    if ((is_start && !given.supports[0].holds_rotation)
        || (is_end && !given.supports[1].holds_rotation))
      return false;
    const auto &nodes = beams.nodes;
    const auto &a = nodes[previous(node)], &b = nodes[node],
               &c = nodes[next(node)];
    // The direction of a fixed end is that at rest.
    if (is_start)
      angle = turn(along(b, c, true), along(b, c, false));
    else if (is_end)
      angle = turn(along(a, b, false), along(a, b, true));
    else
    {
      const AtRest &at_start = at_rest(node);
      const Vector before = along(a, b, false), after = along(b, c, false);
      angle = turn(before, after) - at_start.angle;
      if (at_start.curvature != 0.)
        angle -= at_start.curvature
                 * (0.5
                        * (std::hypot(before[0], before[1])
                           + std::hypot(after[0], after[1]))
                    - at_start.length);
    }
    return true;
  }

  std::array<double, 2> BeamLine::hinge_moment(const unsigned int node,
                                               const BeamState &beams) const
  {
    if (hinge != BeamParameters::by_section)
      return { { hinge, 0. } };
    // The mean strain of both segments; at an end that of one.
    double strain = 0., n = 0.;
    for (const unsigned int first : segments_at(node))
    {
      const Segment s = segment(first, beams);
      strain += (s.length - s.rest) / s.rest;
      n += 1.;
    }
    const double axial = axial_stiffness * strain / n
                         - at_rest(node).curvature * beams.moment[node];
    // Stress blocks of both strengths on a rectangle.
    const double area     = share * given.area,
                 tension  = given.tensile_strength * area - axial,
                 pressure = given.compressive_strength * area + axial;
    if (tension <= 0. || pressure <= 0.)
      return { { 0., 0. } };
    const double factor
        = 0.5 * given.depth
          / (area * (given.tensile_strength + given.compressive_strength));
    return { { factor * tension * pressure, factor * (tension - pressure) } };
  }

  double BeamLine::moment(const unsigned int node, const BeamState &beams,
                          const double angle, double &plastic) const
  {
    const double k       = bending_stiffness / at_rest(node).length;
    const double trial   = k * (angle - plastic);
    const double largest = hinge_moment(node, beams)[0];
    if (std::abs(trial) <= largest)
      return trial;
    const double limit = std::copysign(largest, trial);
    plastic += (trial - limit) / k;
    return limit;
  }

  double BeamLine::axial_force(const unsigned int first, const Segment &s,
                               const BeamState &beams) const
  {
    const unsigned int last = next(first);
    return axial_stiffness * (s.length - s.rest) / s.rest
           - 0.5
                 * (at_rest(first).curvature * beams.moment[first]
                    + at_rest(last).curvature * beams.moment[last]);
  }

  double BeamLine::add_forces(BeamState &beams, EnergyAccounts &energy,
                              dealii::Tensor<1, 2> *force) const
  {
    double size = 0.;
    for (unsigned int i = begin; i < end; ++i)
    {
      double angle;
      if (!turning(i, beams, angle))
        continue;
      const double before = beams.plastic[i], moment_before = beams.moment[i],
                   length = at_rest(i).length;
      beams.moment[i]     = moment(i, beams, angle, beams.plastic[i]);
      energy.plastic += 0.5 * (moment_before + beams.moment[i])
                        * (beams.plastic[i] - before);
      beams.stored_strain += 0.5 * beams.moment[i] * beams.moment[i] * length
                             / bending_stiffness;
      size += std::abs(beams.moment[i]) / length;
    }
    for (unsigned int k = 0; k < n_segments(); ++k)
    {
      const unsigned int a = begin + k, b = next(a);
      const Segment s      = segment(a, beams);
      const double axial   = axial_force(a, s, beams);
      const double shear   = (beams.moment[b] - beams.moment[a]) / s.length;
      const double stretch = s.length - s.rest;
      beams.stored_strain += 0.5 * axial_stiffness / s.rest * stretch * stretch;
      size += std::abs(axial);
      const dealii::Point<2> f(axial * s.direction[0] + shear * s.direction[1],
                               axial * s.direction[1] - shear * s.direction[0]);
      force[a] += f;
      force[b] -= f;
    }
    return size;
  }

  std::vector<dealii::Tensor<1, 2>>
  BeamLine::loads(const TimePoint &time, const double grown,
                  const dealii::Tensor<1, 2> &acceleration) const
  {
    std::vector<Vector> result(places.size());
    for (unsigned int d = 0; d < acceleration.dimension; ++d)
    {
      const double by_length = grown * given.distributed[d](time)
                               + given.density * given.area * acceleration[d];
      for (unsigned int k = 0; k < result.size(); ++k)
        result[k][d] = rest[k].length * by_length;
      if (!is_closed)
      {
        result.front()[d] += grown * given.forces[0][d](time);
        result.back()[d] += grown * given.forces[1][d](time);
      }
      for (Vector &load : result)
        load[d] *= share;
    }
    return result;
  }
} // namespace quoin
