// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/structures/beam_fields.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  BeamFields beam_fields(const Beam &beam, const State<2> &state)
  {
    const auto &[line, interface] = beam;
    const BeamState &beams        = state.get<BeamState>();
    const unsigned int n          = line.places.size();
    BeamFields result;
    result.is_closed = line.is_closed;
    BeamState now    = beams; // with the moments of the present angles
    for (auto *values :
         { &result.axial, &result.shear, &result.moment, &result.plastic,
           &result.least_stress, &result.largest_stress, &result.utilisation,
           &result.normal_traction, &result.shear_traction, &result.opening,
           &result.slip, &result.state })
      values->assign(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int at = line.begin + i;
      const auto &node      = beams.nodes[at];
      result.position.push_back(node.position());
      result.displacement.push_back(node.u);
      double angle;
      if (line.turning(at, beams, angle))
        now.moment[at] = line.moment(at, now, angle, now.plastic[at]);
      result.plastic[i] = now.plastic[at];
      result.moment[i]  = now.moment[at] / line.share;
    }
    for (unsigned int a = 0; a < line.n_segments(); ++a)
    {
      const unsigned int first  = line.begin + a,
                         b      = line.next(first) - line.begin;
      const BeamLine::Segment s = line.segment(first, beams);
      const double axial        = line.axial_force(first, s, now) / line.share;
      const double shear = (result.moment[b] - result.moment[a]) / s.length;
      for (const unsigned int i : { a, b })
      {
        result.axial[i] += axial;
        result.shear[i] += shear;
      }
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      const double n_segments = line.segments_at(line.begin + i).size();
      result.axial[i] /= n_segments;
      result.shear[i] /= n_segments;
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
    for (unsigned int k = interface.points.size(); k-- > 0;)
      if (const unsigned int p = interface.first + k; beams.attached[p])
      {
        const unsigned int i          = interface.points[k].at;
        const LinerInterface::Gap gap = interface.gap(line, k, beams);
        result.normal_traction[i]     = beams.interface.normal_traction[p];
        result.shear_traction[i]      = beams.interface.shear_traction[p];
        result.opening[i]             = gap.opening;
        result.slip[i]                = gap.slip;
        result.state[i]               = double(beams.interface.state[p]);
      }
    return result;
  }

  std::string overstress_text(const BeamLine &line, const BeamFields &fields)
  {
    const BeamParameters &given = line.given;
    if (given.hinge_moment != BeamParameters::by_section
        || fields.axial.empty())
      return "";
    const auto [least, most]
        = std::minmax_element(fields.axial.begin(), fields.axial.end());
    const double pressure = -*least / given.area, tension = *most / given.area;
    const bool is_crushed = pressure / given.compressive_strength
                            > tension / given.tensile_strength;
    const double stress = is_crushed ? pressure : tension;
    const double strength
        = is_crushed ? given.compressive_strength : given.tensile_strength;
    if (stress <= strength)
      return "";
    return text_of(
        "the axial force of the beam '", given.name, "' is ",
        is_crushed ? *least : *most, " N at ",
        point_text(fields.position[(is_crushed ? least : most)
                                   - fields.axial.begin()]),
        " m, N/A = ", stress, " Pa, beyond its '",
        is_crushed ? "Compressive" : "Tensile", " strength' of ", strength,
        " Pa: the section bears no moment there, and nothing limits its axial "
        "force, so that the beam bears more than it can. Take a thicker or "
        "stronger section, or relax the rock more before it is placed.");
  }

  namespace
  {
    /** Between two corners of a polygon that stands for a smooth curve. */
    struct Chord
    {
      unsigned int from, to; /**< corners, counted along the beam */
      double sagitta;        /**< of the curve [m] */
      double bent;           /**< moment by the axial force and that [N m] */
    };

    /** The chord with nodes within it that bends the beam most. */
    Chord worst_chord(const BeamLine &line, const BeamFields &fields)
    {
      // Corners of a polygon with ten sides or more, all turning alike.
      constexpr double largest_turn = 0.2 * dealii::numbers::PI;
      constexpr double most_alike = 1.5, straight = 0.02;
      const unsigned int n = line.places.size();
      const auto turn      = [&](const unsigned int i)
      { return line.at_rest(line.begin + i % n).angle; };
      double mean = 0.;
      for (unsigned int i = 0; i < n; ++i)
        mean += std::abs(turn(i)) / n;
      std::vector<unsigned int> corners;
      for (unsigned int i = 0; i < n; ++i)
        if (std::abs(turn(i)) > straight * mean)
          corners.push_back(i);
      if (line.is_closed && !corners.empty())
        corners.push_back(corners.front() + n);
      Chord worst{};
      for (unsigned int c = 0; c + 1 < corners.size(); ++c)
      {
        const unsigned int from = corners[c], to = corners[c + 1];
        const double before = turn(from), behind = turn(to);
        const double ratio = behind / before;
        if (to == from + 1 || !(ratio < most_alike)
            || !(most_alike * ratio > 1.)
            || std::max(std::abs(before), std::abs(behind)) > largest_turn)
          continue;
        double axial = 0.;
        for (unsigned int i = from + 1; i < to; ++i)
          axial += std::abs(fields.axial[i % n]) / (to - from - 1);
        const double length = line.places[from].distance(line.places[to % n]);
        const double sagitta
            = length * (std::abs(before) + std::abs(behind)) / 16.;
        // The largest difference of the moments of a parabola whose mean is 0.
        const double bent = 2. / 3. * axial * sagitta;
        if (bent > worst.bent)
          worst = { from, to % n, sagitta, bent };
      }
      return worst;
    }
  } // namespace

  std::string chord_text(const BeamLine &line, const BeamFields &fields)
  {
    /** Share of the largest moment from which chords count [-]. */
    constexpr double least_share = 0.1;
    if (!line.given.is_liner())
      return "";
    const Chord worst = worst_chord(line, fields);
    double largest    = 0.;
    for (const double moment : fields.moment)
      largest = std::max(largest, std::abs(moment));
    if (worst.bent <= least_share * largest)
      return "";
    return text_of(
        "the liner '", line.given.name,
        "' follows the chords of a curve: between ",
        point_text(line.places[worst.from]), " and ",
        point_text(line.places[worst.to]), " m its nodes lie up to ",
        worst.sagitta,
        " m within the arc, and its axial force bends it there by some ",
        worst.bent, " N m, ", 100. * worst.bent / largest,
        " % of its largest moment. These are moments of a polygon, not of the "
        "curve. Give the outline a corner for each node of the liner, as many "
        "'Corners' as segments, and not 'Triangles = quadratic', whose nodes "
        "lie in the middle of straight edges; axial forces are right.");
  }

  unsigned int nearest_node(const BeamLine &line, const dealii::Point<2> &point)
  {
    unsigned int best = 0;
    double least      = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < line.places.size(); ++i)
      if (const double distance = line.places[i].distance(point);
          distance < least - 1e-9)
      {
        least = distance;
        best  = i;
      }
    return best;
  }

  std::string beam_text(const BeamLine &line)
  {
    const BeamParameters &beam = line.given;
    double length              = 0.;
    for (unsigned int k = 0; k < line.n_segments(); ++k)
      length += line.places[k].distance(
          line.places[line.next(line.begin + k) - line.begin]);
    return text_of(
        "beam ", beam.name, ": ", line.n_segments(), " segments, ", length,
        " m", line.is_closed ? ", closed" : "", ", EA ",
        beam.modulus * beam.area, " N, EI ", beam.modulus * beam.second_moment,
        " N m^2, ", beam.density * beam.area, " kg/m",
        beam.spacing != 1. ? text_of(", every ", beam.spacing, " m") : "",
        beam.is_liner() ? ", on " + beam.boundary + " by " + beam.interface : "",
        beam.stage.empty() ? "" : ", placed in stage " + beam.stage);
  }
} // namespace quoin
