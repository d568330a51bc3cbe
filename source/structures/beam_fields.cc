// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/structures/beam_fields.h>

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
