// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/model_summary.h>
#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/dynamics/solver.h>
#include <quoin/loads/nodal_load.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace quoin
{
  namespace
  {
    using constants::degree;

    std::string range_text(const double low, const double high,
                           const std::string &unit)
    {
      // Without the sign of a zero.
      const std::string first = number_text(low + 0.),
                        last  = number_text(high + 0.);
      return (low == high ? first : "from " + first + " to " + last) + " "
             + unit;
    }

    /** Of @p function at @p n_times times and in the middle of elements. */
    std::string values_on(const SpaceTimeFunction &function,
                          const std::vector<Eigen::Vector2d> &places,
                          const double duration, const std::string &unit)
    {
      const unsigned int n_times = function.depends_on_time() ? 512 : 0;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Eigen::Vector2d &x : places)
      {
        for (unsigned int i = 0; i <= n_times; ++i)
        {
          const double value
              = function(x, n_times == 0 ? 0. : duration * i / n_times);
          low  = std::min(low, value);
          high = std::max(high, value);
        }
        if (!function.depends_on_place())
          break;
      }
      return range_text(low, high, unit);
    }

    std::string type_text(const IncidentWaveParameters &wave)
    {
      switch (wave.type)
      {
      case IncidentWaveType::plane_p:
        return "plane P wave";
      case IncidentWaveType::plane_sv:
        return "plane SV wave";
      case IncidentWaveType::rayleigh:
        return "Rayleigh wave";
      default:
        return "line source";
      }
    }

    std::string count_text(const std::size_t n, const std::string &what)
    {
      return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    }

    std::string joined(const std::vector<std::string> &words)
    {
      return boost::algorithm::join(words, ", ");
    }

    /** Names and units of the components of a load. */
    std::vector<std::array<std::string, 2>>
    component_names(const LoadParameters &load)
    {
      const auto unit = [&](const unsigned int d, const std::string &force,
                            const std::string &angle)
      {
        switch (load.components[d].quantity)
        {
        case LoadQuantity::velocity:
          return angle + "/s";
        case LoadQuantity::displacement:
          return angle;
        default:
          return force;
        }
      };
      switch (load.type)
      {
      case LoadType::traction:
        return { { { "horizontal", "Pa" } },
                 { { "vertical", "Pa" } },
                 { { "pressure", "Pa" } } };
      case LoadType::gravity:
        return { { { "horizontal", "m/s^2" } }, { { "vertical", "m/s^2" } } };
      case LoadType::viscous_boundary:
        return { { { "incident normal velocity", "m/s" } },
                 { { "incident shear velocity", "m/s" } } };
      case LoadType::prescribed_motion:
        return { { { "horizontal", unit(0, "", "m") } },
                 { { "vertical", unit(1, "", "m") } } };
      case LoadType::platen:
        return { { { "horizontal", unit(0, "N", "m") } },
                 { { "vertical", unit(1, "N", "m") } },
                 { { "rotation", unit(2, "N m", "degrees") } } };
      default:
        return {};
      }
    }

    std::string type_text(const LoadParameters &load)
    {
      switch (load.type)
      {
      case LoadType::prescribed_motion:
        return "prescribed motion";
      case LoadType::traction:
        return "traction";
      case LoadType::viscous_boundary:
        return "viscous boundary";
      case LoadType::free_field:
        return "free-field boundary";
      case LoadType::platen:
        return "platen";
      case LoadType::gravity:
        return "gravity";
      case LoadType::initial_stress:
        return load.in_situ ? "in-situ stress" : "initial stress";
      case LoadType::boundary_elements:
        return "boundary elements";
      }
      return "";
    }

    std::string damping_text(const StageParameters &stage)
    {
      switch (stage.damping)
      {
      case DampingType::local:
        return "local damping " + number_text(stage.local_coefficient);
      case DampingType::adaptive:
        return "adaptive damping";
      case DampingType::rayleigh:
        return "Rayleigh damping, alpha " + number_text(stage.mass_coefficient)
               + " 1/s, beta " + number_text(stage.stiffness_coefficient)
               + " s";
      default:
        return "no damping";
      }
    }

    std::string end_text(const StageParameters &stage, const bool is_implicit)
    {
      if (stage.safety)
        return "looks for the factor of safety";
      if (stage.end == StageEnd::time)
        return "lasts " + number_text(stage.duration) + " s"
               + (stage.slows_loads() ? " of the loads' clock" : "");
      return is_implicit ? std::string("until the loads rest")
                         : "until unbalanced forces are "
                               + number_text(stage.static_ratio)
                               + " of the applied ones";
    }
  } // namespace

  WaveSpeeds wave_speeds(const LinearElastic &material,
                         const PlaneAssumption plane)
  {
    const PlaneStiffness stiffness = plane_stiffness(material, plane);
    return { std::sqrt(stiffness.c11 / material.density),
             std::sqrt(stiffness.c33 / material.density) };
  }

  std::string material_text(const MaterialParameters &material,
                            const PlaneAssumption plane)
  {
    const LinearElastic &elastic = material.elastic;
    const std::string density
        = "density " + number_text(elastic.density) + " kg/m^3";
    if (material.rigid)
      return "rigid, " + density;
    const WaveSpeeds speeds = wave_speeds(elastic, plane);
    std::string text = material.strength ? "Mohr-Coulomb, " : "elastic, ";
    text += "E " + number_text(elastic.young) + " Pa, nu "
            + number_text(elastic.poisson) + ", " + density + ", P waves "
            + number_text(speeds.p) + " m/s, S waves " + number_text(speeds.s)
            + " m/s";
    if (!material.strength)
      return text;
    const MohrCoulombStrength &strength = *material.strength;
    return text + ", " + named_number("cohesion", strength.cohesion, "Pa")
           + ", "
           + named_number("friction angle", strength.friction_angle / degree,
                          "degrees")
           + ", "
           + named_number("dilation angle", strength.dilation_angle / degree,
                          "degrees")
           + ", " + named_number("tensile strength", strength.tension, "Pa");
  }

  std::vector<std::string>
  material_lines(const Parameters &parameters, const NodeMap<2> &nodes,
                 const std::vector<unsigned int> &material_of_group)
  {
    const auto &materials       = parameters.model.materials;
    const unsigned int n_blocks = nodes.table().n_blocks();
    std::vector<double> has(materials.size() * n_blocks, 0.);
    std::vector<double> n_cells(materials.size(), 0.);
    for (unsigned int c = 0; c < nodes.n_cells(); ++c)
    {
      const unsigned int m = material_of_group[nodes.group_of_cell(c)];
      has[m * n_blocks + nodes.block_of_cell(c)] = 1.;
      n_cells[m] += nodes.table().is_quadratic ? 0.25 : 1.;
    }
    dealii::Utilities::MPI::max(has, nodes.communicator(), has);
    dealii::Utilities::MPI::sum(n_cells, nodes.communicator(), n_cells);
    std::vector<std::string> lines;
    for (unsigned int m = 0; m < materials.size(); ++m)
      lines.push_back(
          "material " + materials[m].name + ": "
          + count_text(std::count(has.begin() + m * n_blocks,
                                  has.begin() + (m + 1) * n_blocks, 1.),
                       "block")
          + ", " + count_text(n_cells[m], "triangle") + "; "
          + material_text(materials[m], parameters.model.plane));
    return lines;
  }

  std::vector<std::string> joint_lines(const Parameters &parameters,
                                       const MeshReport &report)
  {
    std::vector<std::string> lines;
    for (const JointSetParameters &set : parameters.model.joints)
    {
      double length = 0.;
      for (const std::string &curve : set.curves)
      {
        const auto found
            = report.joint_length.find(curve == "unnamed" ? "" : curve);
        if (found != report.joint_length.end())
          length += found->second;
      }
      const bool takes_new = set.all_new_contacts || !set.new_contacts.empty();
      const auto stiffness = stiffness_bound(set.law);
      lines.push_back("joints " + set.name + ": " + number_text(length) + " m"
                      + (takes_new ? " and new contacts" : "") + "; "
                      + law_text(set.law) + ", "
                      + (stiffens(set.law) ? "up to " : "") + "kn "
                      + number_text(stiffness[0]) + " Pa/m, ks "
                      + number_text(stiffness[1]) + " Pa/m");
    }
    return lines;
  }

  std::string value_text(const Parameters &parameters,
                         const LoadParameters &load,
                         const LoadComponent &component,
                         const std::string &unit)
  {
    constexpr unsigned int n_times = 512;
    double low = 0., high = 0., start = 0.;
    bool is_first = true;
    for (const StageParameters &stage : parameters.stages)
    {
      const bool ends = stage.end == StageEnd::time;
      const double duration
          = ends ? stage.duration : std::max(stage.minimum_duration, 1.);
      if (names_load(stage, load.name))
        for (unsigned int i = 0; i <= n_times + (ends ? 0 : 1); ++i)
        {
          const double t     = i > n_times ? late_time : duration * i / n_times;
          const double value = component.value({ t, start + t });
          low                = is_first ? value : std::min(low, value);
          high               = is_first ? value : std::max(high, value);
          is_first           = false;
        }
      start += ends ? duration : 0.;
    }
    return range_text(low, high, unit);
  }

  std::string place_text(const LoadParameters &load, const NodeMap<2> &node_map)
  {
    if (!load.boundaries.empty())
    {
      std::set<unsigned int> nodes;
      for (const BoundaryFace<2> &face :
           faces_of_curves(node_map, load.boundaries, load.name))
        nodes.insert(face.nodes.begin(), face.nodes.end());
      return " on " + count_text(nodes.size(), "node") + " of "
             + joined(load.boundaries);
    }
    if (load.groups.empty())
      return load.type == LoadType::boundary_elements ? "" : " on all blocks";
    const auto groups = groups_of_names(node_map, load.groups, load.name);
    unsigned int n    = 0;
    for (const unsigned int group : node_map.table().group)
      n += std::count(groups.begin(), groups.end(), group) > 0;
    return " on " + count_text(n, "block") + " of " + joined(load.groups);
  }

  std::vector<std::string> load_lines(const Parameters &parameters,
                                      const NodeMap<2> &nodes)
  {
    std::vector<std::string> lines;
    for (const LoadParameters &load : parameters.loads)
    {
      std::string text = "load " + load.name + ": " + type_text(load)
                         + place_text(load, nodes);
      const auto names = component_names(load);
      for (unsigned int d = 0; d < names.size(); ++d)
        if (const LoadComponent function = load.functions()[d];
            function.quantity != LoadQuantity::free)
          text += ", " + names[d][0] + " "
                  + value_text(parameters, load, function, names[d][1]);
      if (load.type == LoadType::free_field)
        text += ", on the base " + load.base;
      lines.push_back(text);
    }
    return lines;
  }

  std::string stage_line(const StageParameters &stage, const bool is_implicit)
  {
    std::string text = "stage " + stage.name + ": "
                       + (stage.loads.empty() ? std::string("no loads")
                                              : "loads " + joined(stage.loads))
                       + "; " + end_text(stage, is_implicit);
    if (!is_implicit)
      text += "; " + damping_text(stage);
    if (!stage.excavate.empty())
      text += "; excavates " + joined(stage.excavate);
    if (!stage.fill.empty())
      text += "; fills " + joined(stage.fill);
    for (const auto &[group, material] : stage.materials)
      text += "; " + group + " becomes " + material;
    for (const auto &[set, other] : stage.joint_properties)
      text += "; joints " + set + " become " + other;
    return text;
  }

  std::vector<std::string>
  boundary_lines(const BoundaryElementParameters &parameters,
                 const BoundaryGeometry &geometry, const double duration)
  {
    std::vector<std::string> lines;
    for (unsigned int k = 0; k < parameters.boundaries.size(); ++k)
    {
      const BoundaryCurveParameters &curve = parameters.boundaries[k];
      std::vector<Eigen::Vector2d> middles;
      for (unsigned int e = 0; e < geometry.owner.size(); ++e)
        if (geometry.owner[e] == k)
          middles.push_back(0.5
                            * (geometry.boundary.elements[e].a
                               + geometry.boundary.elements[e].b));
      if (curve.shape == BoundaryShape::interface || middles.empty())
        continue;
      std::vector<std::string> words;
      const auto add
          = [&](const std::string &name, const SpaceTimeFunction &function,
                const std::string &unit)
      {
        const std::string values = values_on(function, middles, duration, unit);
        if (values != "0 Pa")
          words.push_back(name + " " + values);
      };
      const std::string directions[] = { "horizontal ", "vertical " };
      for (unsigned int d = 0; d < 2; ++d)
      {
        const bool traction = curve.traction_is_given[d];
        add(directions[d] + (traction ? "traction" : "displacement"),
            curve.value[d], traction ? "Pa" : "m");
      }
      add("pressure", curve.pressure, "Pa");
      lines.push_back(
          "boundary " + curve.name + ": "
          + (words.empty() ? "free of traction" : "given " + joined(words)));
    }
    for (const IncidentWaveParameters &wave : parameters.waves)
    {
      if (duration == 0.)
        break;
      const bool is_source = wave.type == IncidentWaveType::line_source;
      const auto function  = wave.function(0., duration, duration / 512.);
      double low = function(0.), high = low;
      for (unsigned int i = 1; i <= 512; ++i)
      {
        low  = std::min(low, function(duration * i / 512.));
        high = std::max(high, function(duration * i / 512.));
      }
      lines.push_back("incident wave " + wave.name + ": " + type_text(wave)
                      + (wave.half_plane ? " in the half-plane" : "")
                      + (is_source ? ", moment " : ", displacement ")
                      + range_text(low, high, is_source ? "N" : "m"));
    }
    return lines;
  }
} // namespace quoin
