// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/number_text.h>
#include <quoin/joints/point_arrays.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/operators/archive.h>
#include <quoin/structures/beams.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace quoin
{
  namespace
  {
    using Place = std::array<double, 2>;

    [[noreturn]] void refuse(const BeamParameters &beam, const std::string &why)
    {
      throw InputError("section 'Beams/" + beam.name + "': " + why);
    }

    double turn(const Place &a, const Place &b)
    {
      return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    }

    Place along(const NodeRecord<2> &a, const NodeRecord<2> &b,
                const bool at_rest)
    {
      const double now = at_rest ? 0. : 1.;
      return { { b.X[0] - a.X[0] + now * (b.u[0] - a.u[0]),
                 b.X[1] - a.X[1] + now * (b.u[1] - a.u[1]) } };
    }

    /** Least turning angle of both neighbours where a line is curved, by that
        of a node [-]. */
    constexpr double least_share = 0.5;

    /** Edges between places in one line: anticlockwise if it is closed, or else
        from the left, from the lower end if both are one above the other. */
    struct Chain
    {
      std::vector<Place> places;
      bool is_closed = false;
    };

    /** Throws a string that says why @p edges are not one line. */
    Chain chain_of(const std::vector<std::array<Place, 2>> &edges)
    {
      std::map<Place, std::vector<Place>> neighbours;
      const auto connect = [&](const Place &a, const Place &b)
      {
        std::vector<Place> &known = neighbours[a];
        if (std::find(known.begin(), known.end(), b) == known.end())
          known.push_back(b);
      };
      for (const auto &[a, b] : edges)
      {
        connect(a, b);
        connect(b, a);
      }
      const std::string where = " Beams line one curve without branches.";
      Chain chain;
      Place at        = neighbours.begin()->first;
      chain.is_closed = true;
      for (auto &[place, others] : neighbours)
      {
        std::sort(others.begin(), others.end());
        if (others.size() > 2)
          throw "has branches." + where;
        if (others.size() == 1 && chain.is_closed)
        {
          at              = place;
          chain.is_closed = false;
        }
      }
      Place before = at;
      do
      {
        chain.places.push_back(at);
        const auto &others = neighbours[at];
        const Place to
            = others[0] != before || others.size() == 1 ? others[0] : others[1];
        if (others.size() == 1 && chain.places.size() > 1)
          break;
        before = at;
        at     = to;
      } while (at != chain.places.front());
      if (chain.places.size() != neighbours.size())
        throw "has several parts." + where;
      double area = 0.;
      for (unsigned int i = 0; i < chain.places.size(); ++i)
      {
        const Place &a = chain.places[i],
                    &b = chain.places[(i + 1) % chain.places.size()];
        area += a[0] * b[1] - a[1] * b[0];
      }
      const Place &first = chain.places.front(), &last = chain.places.back();
      const double x = last[0] - first[0], y = last[1] - first[1];
      if (chain.is_closed                    ? area < 0.
          : std::abs(x) > 1e-9 * std::abs(y) ? x < 0.
                                             : y < 0.)
        std::reverse(chain.places.begin(), chain.places.end());
      return chain;
    }
  } // namespace

  Beams::Beams(const std::vector<BeamParameters> &parameters,
               const NodeMap<2> &nodes,
               const std::vector<JointSetParameters> &sets,
               const double thickness, const Thickness &group_thickness)
    : node_map(nodes),
      is_first_rank(
          dealii::Utilities::MPI::this_mpi_process(nodes.communicator()) == 0),
      model_thickness(thickness)
  {
    for (const BeamParameters &beam : parameters)
    {
      Line line;
      line.given       = beam;
      line.begin       = rest.size();
      line.is_closed   = false;
      line.share       = model_thickness / beam.spacing;
      line.axial       = line.share * beam.modulus * beam.area;
      line.bending     = line.share * beam.modulus * beam.second_moment;
      line.hinge       = line.share * beam.hinge_moment;
      line.first_point = line.last_point = points.size();
      lines.push_back(line);
      if (beam.is_liner())
      {
        const auto *set = find_named(sets, beam.interface);
        if (!set)
          refuse(beam,
                 "'Interface = "
                     + beam.interface + "' is no set of joints. There are: "
                     + known_names_like(beam.interface, sets,
                                        &JointSetParameters::name)
                     + ".");
        lines.back().law = set->law;
        n_internal_variables
            = std::max(n_internal_variables, n_internal(set->law));
        add_liner(beam, group_thickness);
      }
      else
        add_free_line(beam);
      lines.back().end = rest.size();
    }
    mass.assign(rest.size(), 0.);
    inverse_mass.assign(rest.size(), 0.);
    for (auto *values :
         { &rest_segment, &rest_length, &rest_angle, &curvature })
      values->assign(rest.size(), 0.);
    force.assign(rest.size(), dealii::Tensor<1, 2>());
    viscous = velocity_before = force;
    point_force.assign(points.size(), dealii::Tensor<1, 2>());
  }

  void Beams::add_free_line(const BeamParameters &beam)
  {
    for (unsigned int i = 1; i < beam.points.size(); ++i)
      for (unsigned int k = 0; k < beam.n_segments; ++k)
      {
        const double s = double(k) / beam.n_segments;
        rest.push_back(
            { { (1. - s) * beam.points[i - 1][0] + s * beam.points[i][0],
                (1. - s) * beam.points[i - 1][1] + s * beam.points[i][1] } });
      }
    lines.back().is_closed = beam.points.front() == beam.points.back();
    if (!lines.back().is_closed)
      rest.push_back(beam.points.back());
    if (lines.back().is_closed && rest.size() - lines.back().begin < 3)
      refuse(beam, "'Points' must be three points or more if the beam is "
                   "closed.");
  }

  void Beams::add_liner(const BeamParameters &beam,
                        const Thickness &group_thickness)
  {
    Line &line             = lines.back();
    const auto &face_names = node_map.table().face_names;
    std::vector<bool> wanted;
    for (const std::string &name : face_names)
      wanted.push_back(name == beam.boundary);
    const auto faces = gather_faces(node_map, wanted, true);
    if (faces.empty())
      refuse(beam,
             "'Boundary = " + beam.boundary
                 + "' is no curve on the boundary of a block. Curves are: "
                 + known_names_like(beam.boundary, face_names) + ".");
    const auto place = [](const dealii::Point<2> &p) {
      return Place{ { p[0], p[1] } };
    };
    std::vector<std::array<Place, 2>> edges;
    for (const auto &face : faces)
      edges.push_back({ { place(face.points[0]), place(face.points[1]) } });
    Chain chain;
    try
    {
      chain = chain_of(edges);
    }
    catch (const std::string &why)
    {
      refuse(beam, "'Boundary = " + beam.boundary + "' " + why);
    }
    line.is_closed = chain.is_closed;
    std::map<Place, unsigned int> number;
    for (const Place &p : chain.places)
    {
      number[p] = rest.size();
      rest.push_back(p);
    }
    line.end = rest.size();

    // The cell of a face is on its left.
    std::map<unsigned int, unsigned int> point_of; // by global nodes
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const auto &face      = faces[f];
      const unsigned int a  = number.at(edges[f][0]);
      const bool is_forward = next(line, a) == number.at(edges[f][1]);
      const double length   = face.points[0].distance(face.points[1]);
      if (node_map.table().is_rigid[face.block])
        refuse(beam, "'Boundary = " + beam.boundary
                         + "' belongs to a rigid block. Give it a deformable "
                           "material, or line another boundary.");
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto [found, is_new]
            = point_of.insert({ face.nodes[k], points.size() });
        if (is_new)
          points.push_back({ node_map.exchange().owns(face.nodes[k])
                                 ? node_map.exchange().local(face.nodes[k])
                                 : NodeMap<2>::none,
                             face.block, number.at(edges[f][k]),
                             is_forward ? 1. : -1., 0. });
        points[found->second].area
            += face.shares[k] * length * group_thickness[face.group];
      }
    }
    // In an order that does not depend on the ranks.
    std::sort(points.begin() + line.first_point, points.end(),
              [](const Point &a, const Point &b) {
                return std::make_pair(a.at, a.block)
                       < std::make_pair(b.at, b.block);
              });
    line.last_point = points.size();
  }

  void Beams::prepare(State<2> &state) const
  {
    if (state.find<BeamState>())
      return;
    BeamState &beams = state.add<BeamState>();
    beams.placed.resize(lines.size(), 0);
    beams.nodes.resize(rest.size());
    for (unsigned int i = 0; i < rest.size(); ++i)
      beams.nodes[i].X = { rest[i][0], rest[i][1] };
    beams.velocity.resize(rest.size(), dealii::Tensor<1, 2>());
    beams.plastic.resize(rest.size(), 0.);
    beams.moment.resize(rest.size(), 0.);
    beams.attached.resize(points.size(), 0);
    beams.offset.resize(points.size(), dealii::Tensor<1, 2>());
    beams.interface.resize(points.size(), n_internal_variables);
    beams.block_position.resize(2 * points.size(), 0.);
    beams.load.resize(rest.size(), dealii::Tensor<1, 2>());
  }

  // -- a stage ---------------------------------------------------------------

  void Beams::begin_stage(const std::string &name, State<2> &state)
  {
    for (unsigned int b = 0; b < lines.size(); ++b)
    {
      const std::string &stage = lines[b].given.stage;
      if (!is_placed(b, state) && (stage.empty() || stage == name))
        place(lines[b], b, state);
      find_rest(lines[b], state.get<BeamState>());
    }
    velocity_before = state.get<BeamState>().velocity;
  }

  void Beams::set_gravity(const std::vector<const NodalLoad<2> *> &loads)
  {
    gravity.clear();
    std::copy_if(loads.begin(), loads.end(), std::back_inserter(gravity),
                 [](const NodalLoad<2> *load)
                 { return load->is_of_everything(); });
  }

  void Beams::place(const Line &line, const unsigned int beam,
                    State<2> &state) const
  {
    BeamState &beams     = state.get<BeamState>();
    const auto here      = block_positions(state);
    beams.block_position = here;
    std::vector<unsigned int> n_here(line.end - line.begin, 0);
    std::vector<Place> sum(line.end - line.begin, Place{});
    double side = 0.;
    for (unsigned int p = line.first_point; p < line.last_point; ++p)
    {
      beams.attached[p] = !state.is_absent(points[p].block);
      if (!beams.attached[p])
        continue;
      if (side * points[p].side < 0.)
        refuse(line.given,
               "'Boundary = " + line.given.boundary
                   + "' has blocks on both sides where the stage '"
                   + line.given.stage
                   + "' places the liner. Name the stage that excavates one of "
                     "them, or a later one, as its 'Stage'.");
      side                  = points[p].side;
      const unsigned int at = points[p].at - line.begin;
      n_here[at] += 1;
      for (unsigned int d = 0; d < 2; ++d)
        sum[at][d] += here[2 * p + d];
    }
    if (line.given.is_liner())
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        const unsigned int n = n_here[i - line.begin];
        if (n == 0)
          refuse(line.given,
                 "'Boundary = " + line.given.boundary
                     + "' has no block in a part of it where the stage places "
                       "the liner. Place it before they are excavated, or line "
                       "another curve.");
        for (unsigned int d = 0; d < 2; ++d)
          beams.nodes[i].X[d] = sum[i - line.begin][d] / n;
      }
    for (unsigned int p = line.first_point; p < line.last_point; ++p)
      if (beams.attached[p])
      {
        std::visit(
            [&](const auto &law)
            { write_point(PointOf<decltype(law)>(), beams.interface, p); },
            line.law);
        Place normal;
        beams.offset[p]     = dealii::Tensor<1, 2>();
        const auto at_start = gap(line, p, beams, here.data() + 2 * p, normal);
        beams.offset[p] = dealii::Tensor<1, 2>({ at_start[0], at_start[1] });
      }
    beams.placed[beam] = 1;
  }

  void Beams::find_rest(const Line &line, const BeamState &beams)
  {
    const auto &nodes = beams.nodes;
    for (unsigned int i = line.begin; i < line.end; ++i)
    {
      rest_segment[i] = 0.;
      if (!has_after(line, i))
        continue;
      const Place way = along(nodes[i], nodes[next(line, i)], true);
      rest_segment[i] = std::hypot(way[0], way[1]);
    }
    for (unsigned int i = line.begin; i < line.end; ++i)
    {
      rest_length[i] = rest_angle[i] = curvature[i] = 0.;
      if (has_after(line, i))
        rest_length[i] += 0.5 * rest_segment[i];
      if (has_before(line, i))
        rest_length[i] += 0.5 * rest_segment[previous(line, i)];
      if (has_before(line, i) && has_after(line, i))
        rest_angle[i] = turn(along(nodes[previous(line, i)], nodes[i], true),
                             along(nodes[i], nodes[next(line, i)], true));
    }
    // A line is curved where its neighbours turn as well; elsewhere there is
    // a corner.
    for (unsigned int i = line.begin; i < line.end; ++i)
    {
      bool is_curved = has_before(line, i) && has_after(line, i);
      for (const unsigned int other : { previous(line, i), next(line, i) })
        is_curved = is_curved
                    && (rest_angle[other] / rest_angle[i] > least_share
                        || !has_before(line, other) || !has_after(line, other));
      if (is_curved)
        curvature[i] = rest_angle[i] / rest_length[i];
    }
  }

  void Beams::find_masses(const double scaled_step, const State<2> &state)
  {
    for (const Line &line : lines)
      for (unsigned int i = line.begin; i < line.end; ++i)
        mass[i] = own_mass(line, i);
    if (scaled_step > 0.)
    {
      const auto bound = stiffness_bound_of(state);
      for (unsigned int i = 0; i < mass.size(); ++i)
        mass[i] = std::max(
            mass[i], 0.25 * scaled_step * scaled_step
                         * (0.5 * (bound[i][0] + bound[i][1])
                            + std::hypot(0.5 * (bound[i][0] - bound[i][1]),
                                         bound[i][2])));
    }
    for (unsigned int i = 0; i < mass.size(); ++i)
      inverse_mass[i] = 1. / mass[i];
  }

  BeamMasses Beams::masses(const State<2> &state) const
  {
    BeamMasses result;
    for (unsigned int b = 0; b < lines.size(); ++b)
      if (is_placed(b, state))
      {
        result.emplace_back();
        for (unsigned int i = lines[b].begin; i < lines[b].end; ++i)
          result.back().push_back({ own_mass(lines[b], i), mass[i] });
      }
    return result;
  }

  std::vector<double> Beams::interface_bound(const State<2> &state) const
  {
    const BeamState &beams = state.get<BeamState>();
    std::vector<double> result;
    for (const Line &line : lines)
      for (unsigned int p = line.first_point; p < line.last_point; ++p)
        if (beams.attached[p] && points[p].node != NodeMap<2>::none)
        {
          result.resize(node_map.n_local(), 0.);
          const auto [kn, ks] = quoin::stiffness_bound(line.law);
          result[points[p].node] += 2. * points[p].area * std::max(kn, ks);
        }
    return result;
  }

  std::vector<NodeStiffness<2>>
  Beams::stiffness_bound_of(const State<2> &state) const
  {
    const BeamState &beams = state.get<BeamState>();
    std::vector<NodeStiffness<2>> result(rest.size(), NodeStiffness<2>{});
    const auto add
        = [&](const unsigned int node, const double k, const Place &direction)
    {
      result[node][0] += k * direction[0] * direction[0];
      result[node][1] += k * direction[1] * direction[1];
      result[node][2] += k * direction[0] * direction[1];
    };
    for (unsigned int b = 0; b < lines.size(); ++b)
    {
      const Line &line = lines[b];
      if (!beams.placed[b])
        continue;
      std::vector<Segment> all;
      for (unsigned int s = 0; s < n_segments(line); ++s)
        all.push_back(segment(line, line.begin + s, beams));
      for (unsigned int s = 0; s < all.size(); ++s)
      {
        const unsigned int i = line.begin + s;
        const Place t{ { all[s].direction[0], all[s].direction[1] } };
        add(i, 2. * line.axial / all[s].rest, t);
        add(next(line, i), 2. * line.axial / all[s].rest, t);
      }
      // A hinge stores k (b . u)^2 / 2 with a vector b_j of each of its nodes,
      // and (b . u)^2 <= sum_j |b_j| sum_j (b_j . u_j)^2 / |b_j|.
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        double angle;
        if (!turning(line, i, beams, angle))
          continue;
        std::map<unsigned int, Place> b;
        const auto part = [&](const unsigned int s, const double sign)
        {
          const Place n{ { -all[s].direction[1] / all[s].length,
                           all[s].direction[0] / all[s].length } };
          const unsigned int from = line.begin + s, to = next(line, from);
          for (unsigned int d = 0; d < 2; ++d)
          {
            const double slope
                = sign * n[d] - 0.5 * curvature[i] * all[s].direction[d];
            b[to][d] += slope;
            b[from][d] -= slope;
          }
        };
        const unsigned int s = i - line.begin;
        if (s < all.size())
          part(s, 1.);
        if (s > 0 || line.is_closed)
          part(s > 0 ? s - 1 : all.size() - 1, -1.);
        double sum = 0.;
        for (const auto &[node, direction] : b)
          sum += std::hypot(direction[0], direction[1]);
        for (const auto &[node, direction] : b)
          if (const double size = std::hypot(direction[0], direction[1]);
              size > 0.)
            add(node, line.bending / rest_length[i] * sum / size, direction);
      }
      const auto [kn, ks] = quoin::stiffness_bound(line.law);
      for (unsigned int p = line.first_point; p < line.last_point; ++p)
        if (beams.attached[p])
        {
          const double k = 2. * points[p].area * std::max(kn, ks);
          add(points[p].at, k, { { 1., 0. } });
          add(points[p].at, k, { { 0., 1. } });
        }
    }
    return result;
  }

  double Beams::largest_eigenvalue(const State<2> &state) const
  {
    const auto bound = stiffness_bound_of(state);
    double largest   = 0.;
    for (unsigned int i = 0; i < mass.size(); ++i)
      largest = std::max(
          largest,
          (0.5 * (bound[i][0] + bound[i][1])
           + std::hypot(0.5 * (bound[i][0] - bound[i][1]), bound[i][2]))
              / mass[i]);
    return largest;
  }

  // -- geometry --------------------------------------------------------------

  Beams::Segment Beams::segment(const Line &line, const unsigned int first,
                                const BeamState &beams) const
  {
    const Place now
        = along(beams.nodes[first], beams.nodes[next(line, first)], false);
    const double size = std::hypot(now[0], now[1]);
    return { { now[0] / size, now[1] / size }, size, rest_segment[first] };
  }

  bool Beams::turning(const Line &line, const unsigned int node,
                      const BeamState &beams, double &angle) const
  {
    const bool is_start = !has_before(line, node);
    const bool is_end   = !has_after(line, node);
    if ((is_start && !line.given.supports[0].holds_rotation)
        || (is_end && !line.given.supports[1].holds_rotation))
      return false;
    const auto &nodes = beams.nodes;
    const auto &a = nodes[previous(line, node)], &b = nodes[node],
               &c = nodes[next(line, node)];
    // The direction of a fixed end is that at rest.
    if (is_start)
      angle = turn(along(b, c, true), along(b, c, false));
    else if (is_end)
      angle = turn(along(a, b, false), along(a, b, true));
    else
    {
      const Place before = along(a, b, false), after = along(b, c, false);
      angle = turn(before, after) - rest_angle[node];
      if (curvature[node] != 0.)
        angle -= curvature[node]
                 * (0.5
                        * (std::hypot(before[0], before[1])
                           + std::hypot(after[0], after[1]))
                    - rest_length[node]);
    }
    return true;
  }

  std::array<double, 2> Beams::hinge_moment(const Line &line,
                                            const unsigned int node,
                                            const BeamState &beams) const
  {
    if (line.hinge != BeamParameters::by_section)
      return { { line.hinge, 0. } };
    // The mean strain of both segments; at an end that of one.
    double strain = 0., n = 0.;
    for (const unsigned int first : { previous(line, node), node })
      if (first == node ? has_after(line, node) : has_before(line, node))
      {
        const Segment s = segment(line, first, beams);
        strain += (s.length - s.rest) / s.rest;
        n += 1.;
      }
    const double axial
        = line.axial * strain / n - curvature[node] * beams.moment[node];
    // Stress blocks of both strengths on a rectangle.
    const double area     = line.share * line.given.area,
                 tension  = line.given.tensile_strength * area - axial,
                 pressure = line.given.compressive_strength * area + axial;
    if (tension <= 0. || pressure <= 0.)
      return { { 0., 0. } };
    const double factor
        = 0.5 * line.given.depth
          / (area
             * (line.given.tensile_strength + line.given.compressive_strength));
    return { { factor * tension * pressure, factor * (tension - pressure) } };
  }

  double Beams::moment(const Line &line, const unsigned int node,
                       const BeamState &beams, const double angle,
                       double &plastic) const
  {
    const double k       = line.bending / rest_length[node];
    const double trial   = k * (angle - plastic);
    const double largest = hinge_moment(line, node, beams)[0];
    if (std::abs(trial) <= largest)
      return trial;
    const double limit = std::copysign(largest, trial);
    plastic += (trial - limit) / k;
    return limit;
  }

  double Beams::axial_force(const Line &line, const unsigned int first,
                            const Segment &s, const BeamState &beams) const
  {
    const unsigned int last = next(line, first);
    return line.axial * (s.length - s.rest) / s.rest
           - 0.5
                 * (curvature[first] * beams.moment[first]
                    + curvature[last] * beams.moment[last]);
  }

  bool Beams::held(const Line &line, const unsigned int node,
                   const unsigned int d) const
  {
    if (line.is_closed || (node != line.begin && node + 1 != line.end))
      return false;
    const BeamSupport &support
        = line.given.supports[node == line.begin ? 0 : 1];
    return d == 0 ? support.holds_x : support.holds_y;
  }

  std::array<double, 2> Beams::tangent(const Line &line,
                                       const unsigned int node,
                                       const BeamState &beams) const
  {
    Place sum{};
    const auto add = [&](const unsigned int first)
    {
      const Segment s = segment(line, first, beams);
      sum[0] += s.direction[0];
      sum[1] += s.direction[1];
    };
    if (node + 1 < line.end || line.is_closed)
      add(node);
    if (node > line.begin || line.is_closed)
      add(node == line.begin ? line.end - 1 : node - 1);
    const double size = std::hypot(sum[0], sum[1]);
    return { { sum[0] / size, sum[1] / size } };
  }

  AlignedArray<double> Beams::block_positions(const State<2> &state) const
  {
    AlignedArray<double> result(2 * points.size(), 0.);
    for (unsigned int p = 0; p < points.size(); ++p)
      if (points[p].node != NodeMap<2>::none)
        for (unsigned int d = 0; d < 2; ++d)
          result[2 * p + d] = state.nodes[points[p].node].X[d]
                              + state.nodes[points[p].node].u[d];
    if (!points.empty())
      MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE,
                    MPI_SUM, node_map.communicator());
    return result;
  }

  std::array<double, 2> Beams::gap(const Line &line, const unsigned int p,
                                   const BeamState &beams, const double *place,
                                   std::array<double, 2> &normal) const
  {
    const Point &point = points[p];
    const Place t      = tangent(line, point.at, beams);
    normal             = { { -point.side * t[1], point.side * t[0] } };
    const auto &node   = beams.nodes[point.at];
    const Place g{ { place[0] - node.X[0] - node.u[0],
                     place[1] - node.X[1] - node.u[1] } };
    return { { normal[0] * g[0] + normal[1] * g[1] - beams.offset[p][0],
               t[0] * g[0] + t[1] * g[1] - beams.offset[p][1] } };
  }

  // -- a step ----------------------------------------------------------------

  void Beams::add_forces(const StepContext &step, State<2> &state,
                         const NodeForces<2> &forces)
  {
    BeamState &beams = state.get<BeamState>();
    std::fill(force.begin(), force.end(), dealii::Tensor<1, 2>());
    std::fill(point_force.begin(), point_force.end(), dealii::Tensor<1, 2>());
    beams.stored_strain = beams.stored_joint = 0.;
    beams.block_position                     = block_positions(state);
    EnergyAccounts lost;
    for (unsigned int b = 0; b < lines.size(); ++b)
      if (beams.placed[b])
      {
        add_internal_forces(lines[b], beams, lost, force.data());
        add_interface_forces(lines[b], state, beams, lost, force.data(),
                             point_force.data());
        const Loads given = loads_of(lines[b], step.begin);
        for (unsigned int i = lines[b].begin; i < lines[b].end; ++i)
        {
          const auto f = load(lines[b], i, given);
          for (unsigned int d = 0; d < 2; ++d)
            force[i][d] += f[d];
        }
      }
    for (unsigned int p = 0; p < points.size(); ++p)
      if (points[p].node != NodeMap<2>::none)
        for (unsigned int d = 0; d < 2; ++d)
          forces.force[points[p].node][d] -= point_force[p][d];
    if (is_first_rank)
      state.energy += lost;
  }

  double Beams::add_internal_forces(const Line &line, BeamState &beams,
                                    EnergyAccounts &energy,
                                    dealii::Tensor<1, 2> *sum) const
  {
    double size = 0.;
    for (unsigned int i = line.begin; i < line.end; ++i)
    {
      double angle;
      if (!turning(line, i, beams, angle))
        continue;
      const double before = beams.plastic[i], moment_before = beams.moment[i];
      beams.moment[i] = moment(line, i, beams, angle, beams.plastic[i]);
      energy.plastic += 0.5 * (moment_before + beams.moment[i])
                        * (beams.plastic[i] - before);
      beams.stored_strain += 0.5 * beams.moment[i] * beams.moment[i]
                             * rest_length[i] / line.bending;
      size += std::abs(beams.moment[i]) / rest_length[i];
    }
    for (unsigned int k = 0; k < n_segments(line); ++k)
    {
      const unsigned int a = line.begin + k, b = next(line, a);
      const Segment s      = segment(line, a, beams);
      const double axial   = axial_force(line, a, s, beams);
      const double shear   = (beams.moment[b] - beams.moment[a]) / s.length;
      const double stretch = s.length - s.rest;
      beams.stored_strain += 0.5 * line.axial / s.rest * stretch * stretch;
      size += std::abs(axial);
      const double f[2] = { axial * s.direction[0] + shear * s.direction[1],
                            axial * s.direction[1] - shear * s.direction[0] };
      for (unsigned int d = 0; d < 2; ++d)
      {
        sum[a][d] += f[d];
        sum[b][d] -= f[d];
      }
    }
    return size;
  }

  double Beams::add_interface_forces(const Line &line, const State<2> &state,
                                     BeamState &beams, EnergyAccounts &energy,
                                     dealii::Tensor<1, 2> *sum,
                                     dealii::Tensor<1, 2> *by_point) const
  {
    double size      = 0.;
    const auto visit = [&](const auto &law)
    {
      for (unsigned int p = line.first_point; p < line.last_point; ++p)
      {
        if (!beams.attached[p] || state.is_absent(points[p].block))
          continue;
        Place n;
        const auto [opening, slip]
            = gap(line, p, beams, beams.block_position.data() + 2 * p, n);
        auto point = read_point(law, beams.interface, p);
        if (!law.update_elastic(point, opening, slip))
        {
          const JointDissipation lost
              = law.update_failing(point, opening, slip);
          energy.friction += points[p].area * lost.friction;
          energy.fracture += points[p].area * lost.fracture;
          energy.crushing += points[p].area * lost.crushing;
        }
        write_point(point, beams.interface, p);
        beams.stored_joint
            += points[p].area * law.stored_energy(point, opening);
        const Place t{ { points[p].side * n[1], -points[p].side * n[0] } };
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double f
              = points[p].area
                * (point.normal_traction * n[d] + point.shear_traction * t[d]);
          sum[points[p].at][d] += f;
          by_point[p][d] = f;
          size += std::abs(f);
        }
        // The frame turns with the segments at the node, by the mean of their
        // angles: what keeps the balance of moments and energy over a gap.
        const double couple
            = points[p].area * points[p].side
              * (point.normal_traction * (slip + beams.offset[p][1])
                 - point.shear_traction * (opening + beams.offset[p][0]));
        const unsigned int at = points[p].at;
        const bool before = has_before(line, at), after = has_after(line, at);
        const auto turn_segment = [&](const unsigned int first)
        {
          const Segment s = segment(line, first, beams);
          const double f  = couple / (before && after ? 2. : 1.) / s.length;
          const unsigned int last = next(line, first);
          sum[first][0] += f * s.direction[1];
          sum[first][1] -= f * s.direction[0];
          sum[last][0] -= f * s.direction[1];
          sum[last][1] += f * s.direction[0];
        };
        if (before)
          turn_segment(previous(line, at));
        if (after)
          turn_segment(at);
      }
    };
    std::visit(visit, line.law);
    return size;
  }

  Beams::Loads Beams::loads_of(const Line &line, const TimePoint &time) const
  {
    Place acceleration{};
    for (const NodalLoad<2> *load : gravity)
    {
      const auto amplitude = load->amplitude(time);
      for (unsigned int d = 0; d < 2; ++d)
        acceleration[d] += amplitude[d];
    }
    Loads result;
    for (unsigned int d = 0; d < 2; ++d)
    {
      result.by_length[d]
          = line.given.distributed[d](time)
            + line.given.density * line.given.area * acceleration[d];
      for (const unsigned int end : { 0, 1 })
        result.ends[end][d]
            = line.is_closed ? 0. : line.given.forces[end][d](time);
    }
    return result;
  }

  std::array<double, 2> Beams::load(const Line &line, const unsigned int node,
                                    const Loads &loads) const
  {
    Place result;
    for (unsigned int d = 0; d < 2; ++d)
    {
      result[d] = rest_length[node] * loads.by_length[d];
      if (node == line.begin)
        result[d] += loads.ends[0][d];
      if (node + 1 == line.end)
        result[d] += loads.ends[1][d];
      result[d] *= line.share;
    }
    return result;
  }

  void Beams::add_stored_energy(const State<2> &state,
                                EnergyAccounts &energies) const
  {
    if (!is_first_rank)
      return;
    energies.strain += state.get<BeamState>().stored_strain;
    energies.joint += state.get<BeamState>().stored_joint;
  }

  Beams::Work Beams::advance(const StepContext &step, const bool damped,
                             const bool adaptive, State<2> &state)
  {
    BeamState &beams = state.get<BeamState>();
    velocity_before  = beams.velocity;
    Work work;
    double given_before = 0., given_after = 0.;
    for (unsigned int b = 0; b < lines.size(); ++b)
    {
      const Line &line = lines[b];
      if (!beams.placed[b])
        continue;
      const Loads given = loads_of(line, step.begin);
      std::vector<Place> loads;
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        loads.push_back(load(line, i, given));
        work.applied += std::hypot(loads.back()[0], loads.back()[1]);
        for (unsigned int d = 0; d < 2; ++d)
        {
          given_before += loads.back()[d] * beams.velocity[i][d];
          if (!held(line, i, d))
            continue;
          work.applied += std::abs(force[i][d]);
          force[i][d] = 0.;
        }
        work.unbalanced += std::hypot(force[i][0], force[i][1]);
      }
      if (!damped)
        advance_nodes(line.begin, line.end, beams.nodes.data(),
                      beams.velocity.data(), force.data(), inverse_mass.data(),
                      step.dt_velocity, step.dt);
      else
      {
        const DampingFactors factors{ step.local_damping, step.mass_damping,
                                      step.dt_before, step.dt_velocity };
        const auto move = adaptive ? advance_nodes_damped<true, 2>
                                   : advance_nodes_damped<false, 2>;
        work.damping
            += move(line.begin, line.end, beams.nodes.data(),
                    beams.velocity.data(), force.data(), viscous.data(),
                    mass.data(), inverse_mass.data(), factors, step.dt);
      }
      for (unsigned int i = line.begin; i < line.end; ++i)
        for (unsigned int d = 0; d < 2; ++d)
          given_after += loads[i - line.begin][d] * beams.velocity[i][d];
    }
    if (!is_first_rank)
      return Work();
    state.energy.external += 0.5 * step.dt_before * given_before;
    state.pending.external += 0.5 * step.dt * given_after;
    return work;
  }

  double Beams::kinetic_energy(const State<2> &state, const double share) const
  {
    const BeamState &beams = state.get<BeamState>();
    double energy          = 0.;
    if (is_first_rank)
      for (unsigned int i = 0; i < mass.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double v = velocity_before[i][d];
          energy
              += 0.5 * mass[i] * v * (v + share * (beams.velocity[i][d] - v));
        }
    return energy;
  }

  double Beams::kinetic_energy(const State<2> &state) const
  {
    const BeamState &beams = state.get<BeamState>();
    double energy          = 0.;
    if (is_first_rank)
      for (unsigned int i = 0; i < mass.size(); ++i)
        energy += 0.5 * mass[i] * beams.velocity[i].norm_square();
    return energy;
  }

  double Beams::squared_change(const State<2> &state) const
  {
    const BeamState &beams = state.get<BeamState>();
    double sum             = 0.;
    if (is_first_rank)
      for (unsigned int i = 0; i < mass.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double change = beams.velocity[i][d] - velocity_before[i][d];
          sum += mass[i] * change * change;
        }
    return sum;
  }

  void Beams::check_finite(const State<2> &state) const
  {
    const BeamState &beams = state.get<BeamState>();
    for (const Line &line : lines)
      for (unsigned int i = line.begin; i < line.end; ++i)
        if (!(beams.nodes[i].u.norm() < 1e100)) // so with NaN, too
          throw RunError(text_of(
              "the motion of the beam '", line.given.name,
              "' is no longer finite, found at time ", state.time,
              " s. Look at its loads, or reduce 'Share of critical time "
              "step'. The last checkpoint is kept."));
  }

  // -- results ---------------------------------------------------------------

  std::vector<double> Beams::loads(const TimePoint &time) const
  {
    std::vector<double> result;
    for (const Line &line : lines)
      for (const auto *parts : { &line.given.forces[0], &line.given.forces[1],
                                 &line.given.distributed })
        for (const TimeFunction &part : *parts)
          result.push_back(part(time));
    return result;
  }

  std::vector<std::string> Beams::text() const
  {
    std::vector<std::string> result;
    for (const Line &line : lines)
    {
      const BeamParameters &beam = line.given;
      double length              = 0.;
      for (unsigned int k = 0; k < n_segments(line); ++k)
      {
        const Place &a = rest[line.begin + k],
                    &b = rest[next(line, line.begin + k)];
        length += std::hypot(b[0] - a[0], b[1] - a[1]);
      }
      result.push_back(text_of(
          "beam ", beam.name, ": ", n_segments(line), " segments, ", length,
          " m", line.is_closed ? ", closed" : "", ", EA ",
          beam.modulus * beam.area, " N, EI ",
          beam.modulus * beam.second_moment, " N m^2, ",
          beam.density * beam.area, " kg/m",
          beam.spacing != 1. ? text_of(", every ", beam.spacing, " m") : "",
          beam.is_liner() ? ", on " + beam.boundary + " by " + beam.interface : "",
          beam.stage.empty() ? "" : ", placed in stage " + beam.stage));
    }
    return result;
  }

  unsigned int Beams::find(const std::string &name) const
  {
    return std::find_if(lines.begin(), lines.end(),
                        [&](const Line &line)
                        { return line.given.name == name; })
           - lines.begin();
  }

  unsigned int Beams::nearest_node(const unsigned int beam,
                                   const std::array<double, 2> &point) const
  {
    const Line &line  = lines[beam];
    unsigned int best = 0;
    double least      = std::numeric_limits<double>::max();
    for (unsigned int i = line.begin; i < line.end; ++i)
      if (const double distance
          = std::hypot(rest[i][0] - point[0], rest[i][1] - point[1]);
          distance < least - 1e-9)
      {
        least = distance;
        best  = i - line.begin;
      }
    return best;
  }

  BeamFields Beams::fields(const unsigned int beam, const State<2> &state) const
  {
    const Line &line       = lines[beam];
    const BeamState &beams = state.get<BeamState>();
    const unsigned int n   = line.end - line.begin;
    BeamFields result;
    result.is_closed = line.is_closed;
    BeamState now    = beams; // with the moments of the present angles
    std::vector<double> shares(n, 0.);
    for (auto *values :
         { &result.axial, &result.shear, &result.moment, &result.plastic,
           &result.least_stress, &result.largest_stress, &result.utilisation,
           &result.normal_traction, &result.shear_traction, &result.opening,
           &result.slip, &result.state })
      values->assign(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto &node = beams.nodes[line.begin + i];
      result.position.push_back(
          { { node.X[0] + node.u[0], node.X[1] + node.u[1] } });
      result.displacement.push_back({ { node.u[0], node.u[1] } });
      const unsigned int at = line.begin + i;
      double angle;
      if (turning(line, at, beams, angle))
        now.moment[at] = moment(line, at, now, angle, now.plastic[at]);
      result.plastic[i] = now.plastic[at];
      result.moment[i]  = now.moment[at] / line.share;
    }
    for (unsigned int k = 0; k < n_segments(line); ++k)
    {
      const unsigned int a = k, b = next(line, line.begin + k) - line.begin;
      const Segment s = segment(line, line.begin + k, beams);
      const double axial
          = axial_force(line, line.begin + k, s, now) / line.share;
      const double shear = (result.moment[b] - result.moment[a]) / s.length;
      for (const unsigned int i : { a, b })
      {
        result.axial[i] += axial;
        result.shear[i] += shear;
        shares[i] += 1.;
      }
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      result.axial[i] /= shares[i];
      result.shear[i] /= shares[i];
      const double mean = result.axial[i] / line.given.area,
                   bent = 0.5 * line.given.depth * std::abs(result.moment[i])
                          / line.given.second_moment;
      result.least_stress[i]   = mean - bent;
      result.largest_stress[i] = mean + bent;
      result.utilisation[i]
          = std::max({ 0., (bent - mean) / line.given.compressive_strength,
                       (bent + mean) / line.given.tensile_strength });
    }
    // The first of several points at a node, as where a joint ends.
    for (unsigned int p = line.last_point; p-- > line.first_point;)
      if (beams.attached[p])
      {
        const unsigned int i = points[p].at - line.begin;
        Place normal;
        const auto [opening, slip]
            = gap(line, p, beams, beams.block_position.data() + 2 * p, normal);
        result.normal_traction[i] = beams.interface.normal_traction[p];
        result.shear_traction[i]  = beams.interface.shear_traction[p];
        result.opening[i]         = opening;
        result.slip[i]            = slip;
        result.state[i]           = double(beams.interface.state[p]);
      }
    return result;
  }
} // namespace quoin
