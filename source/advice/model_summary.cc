// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/known_names.h>
#include <quoin/base/number_text.h>
#include <quoin/dynamics/solver.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/signals/signal_frequency.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/advice/joint_rotation.h>
#include <quoin/advice/model_summary.h>

#include <deal.II/base/mpi.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace quoin
{
  namespace
  {
    bool is_in_pattern(const StageParameters &stage, const LoadParameters &load)
    {
      return stage.pattern && is_among(load.name, stage.pattern->loads);
    }

    /** Smallest to largest value, or level of the water, over the stages in
     * which @p load acts; where its factor is sought that at the factor 1. */
    std::string value_text(const Parameters &parameters,
                           const LoadParameters &load,
                           const LoadComponent &component)
    {
      std::vector<double> values;
      for (unsigned int i = 0; i < parameters.stages.size(); ++i)
      {
        const StageParameters &stage = parameters.stages[i];
        if (is_in_pattern(stage, load)) // constant
          values.push_back(component.value({ 0., 0. }));
        if (!names_load(stage, load.name))
          continue;
        const double start = start_of_stage(parameters.stages, i);
        const auto value   = [&](const double t) {
          return component.value({ t, start + t });
        };
        const bool ends = stage.end == StageEnd::time;
        const double duration
            = ends ? stage.duration : std::max(stage.minimum_duration, 1.);
        if (component.value.is_constant())
          values.push_back(value(0.));
        else
          for (const double v : extremes(value, duration))
            values.push_back(v);
        if (!ends)
          values.push_back(value(late_time));
      }
      if (values.empty())
        return "0";
      const auto [low, high]
          = std::minmax_element(values.begin(), values.end());
      return range_text(*low, *high);
    }

    /** The nodes of its curves, or the blocks of its groups. */
    template <int dim>
    std::string place_text(const LoadParameters &load,
                           const NodeMap<dim> &node_map)
    {
      using boost::algorithm::join;
      if (!load.boundaries.empty())
      {
        std::set<unsigned int> nodes;
        for (const BoundaryFace<dim> &face :
             faces_of_curves(node_map, load.boundaries, load.name,
                             load.is_pressure_alone()))
          nodes.insert(face.nodes.begin(), face.nodes.end());
        return " on " + count_text(nodes.size(), "node") + " of "
               + join(load.boundaries, ", ");
      }
      if (load.groups.empty())
        return load.type == LoadType::boundary_elements ? "" : " on all blocks";
      const auto groups = groups_of_names(node_map, load.groups, load.name);
      unsigned int n    = 0;
      for (const unsigned int group : node_map.table().group)
        n += std::count(groups.begin(), groups.end(), group) > 0;
      return " on " + count_text(n, "block") + " of " + join(load.groups, ", ");
    }
  } // namespace

  template <int dim>
  std::vector<std::string>
  material_lines(const Parameters &parameters, const NodeMap<dim> &nodes,
                 const std::vector<unsigned int> &material_of_group)
  {
    const auto &materials       = parameters.model.materials;
    const unsigned int n_blocks = nodes.table().n_blocks();
    std::vector<double> has(materials.size() * n_blocks, 0.);
    std::vector<double> n_cells(materials.size(), 0.);
    for (unsigned int c = 0; c < nodes.cells().size(); ++c)
    {
      const unsigned int m = material_of_group[nodes.cells().group[c]];
      has[m * n_blocks + nodes.blocks().block_of_cell(c)] = 1.;
      n_cells[m] += nodes.table().is_quadratic ? 0.25 : 1.;
    }
    dealii::Utilities::MPI::max(has, nodes.communicator(), has);
    dealii::Utilities::MPI::sum(n_cells, nodes.communicator(), n_cells);
    std::vector<std::string> lines;
    for (unsigned int m = 0; m < materials.size(); ++m)
    {
      const auto begin = has.begin() + m * n_blocks;
      lines.push_back(text_of(
          "material ", materials[m].name, ": ",
          count_text(std::count(begin, begin + n_blocks, 1.), "block"), ", ",
          dim == 2 ? count_text(n_cells[m], "triangle")
                   : text_of(std::uint64_t(n_cells[m]), " tetrahedra"),
          "; ", material_text(materials[m], parameters.model.plane)));
    }
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
            = report.joint_size.find(curve == "unnamed" ? "" : curve);
        if (found != report.joint_size.end())
          length += found->second;
      }
      const bool takes_new = set.all_new_contacts || !set.new_contacts.empty();
      const auto stiffness = stiffness_bound(set.law);
      lines.push_back(
          text_of("joints ", set.name, ": ", length,
                  report.dimension == 2 ? " m" : " m2",
                  takes_new ? " and new contacts" : "", "; ", law_text(set.law),
                  ", ", stiffens(set.law) ? "up to " : "", "kn ", stiffness[0],
                  " Pa/m, ks ", stiffness[1], " Pa/m"));
    }
    return lines;
  }

  template <int dim>
  std::vector<std::string> face_lines(const Parameters &parameters,
                                      const NodeMap<dim> &nodes)
  {
    if (nodes.table().is_quadratic)
      return {};
    const std::vector<BlockJoint> joints = block_joints(nodes, {}, false);
    std::vector<std::string> lines;
    for (const JointSetParameters &set : parameters.model.joints)
    {
      unsigned int fewest = -1, most = 0;
      double largest = 0.;
      for (const BlockJoint &joint : joints)
        if (is_among(nodes.table().joint_name(joint.name), set.curves))
        {
          fewest  = std::min(fewest, joint.n_faces);
          most    = std::max(most, joint.n_faces);
          largest = std::max(largest, joint.excess);
        }
      if (most > 0)
        lines.push_back(text_of(
            "joints ", set.name, ": ",
            fewest == most ? count_text(most, "face")
                           : text_of(fewest, " to ", most, " faces"),
            " between two blocks, which while they are closed make a joint ",
            fewest == most ? "" : "up to ", std::round(1000. * largest) / 10.,
            " % too stiff when its blocks rotate"));
    }
    return lines;
  }

  template <int dim>
  std::vector<std::string> rigid_face_lines(const Parameters &parameters,
                                            const NodeMap<dim> &nodes)
  {
    /** Excess of the stiffness below which nothing is said [-]. */
    constexpr double least = 0.1;
    const auto &table      = nodes.table();
    if (table.is_quadratic)
      return {};
    std::vector<bool> is_rigid = table.is_rigid;
    for (const LoadParameters &load : parameters.loads)
      if (load.type == LoadType::platen)
        for (unsigned int b = 0; b < table.n_blocks(); ++b)
          if (is_among(table.group_names[table.group[b]], load.groups))
            is_rigid[b] = true;
    const BlockJoint *worst              = nullptr;
    const std::vector<BlockJoint> joints = block_joints(nodes, is_rigid, true);
    for (const BlockJoint &joint : joints)
      if (joint.excess > least && (!worst || joint.excess > worst->excess))
        worst = &joint;
    if (!worst)
      return {};
    const double percent = std::round(1000. * worst->excess) / 10.;
    return { text_of(
        "joint '", table.joint_name(worst->name), "' has ",
        count_text(worst->n_faces, "face"),
        " between two blocks that are rigid, which while they are closed make "
        "it up to ",
        percent, " % too stiff when these rotate: they tilt too little, up to ",
        std::round(1000. * worst->excess / (1. + worst->excess)) / 10.,
        " %. The moment at which a joint without tension overturns is exact. "
        "Where tilts or periods matter take smaller elements there") };
  }
  template std::vector<std::string> rigid_face_lines(const Parameters &,
                                                     const NodeMap<2> &);
  template std::vector<std::string> rigid_face_lines(const Parameters &,
                                                     const NodeMap<3> &);
  template std::vector<std::string> face_lines(const Parameters &,
                                               const NodeMap<2> &);
  template std::vector<std::string> face_lines(const Parameters &,
                                               const NodeMap<3> &);

  namespace
  {
    std::array<double, 4> initial_stress(const LoadParameters &load,
                                         const dealii::Point<2> &place)
    {
      return load.initial_stress(place[0], place[1], 0.);
    }
    std::array<double, 6> initial_stress(const LoadParameters &load,
                                         const dealii::Point<3> &place)
    {
      return load.initial_stress(place);
    }

    /** Range of the initial stress of @p load at the cells of its groups. */
    template <int dim>
    std::string stress_text(const LoadParameters &load,
                            const NodeMap<dim> &nodes)
    {
      constexpr unsigned int n = dim * (dim + 1) / 2;
      const auto groups        = groups_of_names(nodes, load.groups, load.name);
      std::vector<double> low(n, std::numeric_limits<double>::max());
      std::vector<double> minus_high = low;
      for (unsigned int c = 0; c < nodes.cells().size(); ++c)
      {
        if (!groups.empty()
            && std::count(groups.begin(), groups.end(), nodes.cells().group[c])
                   == 0)
          continue;
        dealii::Point<dim> centre;
        for (const unsigned int node : nodes.cells().nodes[c])
          centre += nodes.point(node) / (dim + 1.);
        const auto stress = initial_stress(load, centre);
        for (unsigned int k = 0; k < n; ++k)
        {
          low[k]        = std::min(low[k], stress[k]);
          minus_high[k] = std::min(minus_high[k], -stress[k]);
        }
      }
      dealii::Utilities::MPI::min(low, nodes.communicator(), low);
      dealii::Utilities::MPI::min(minus_high, nodes.communicator(), minus_high);
      std::string text;
      const std::vector<std::string> names
          = dim == 2 ? std::vector<std::string>{ "xx", "yy", "xy" }
                     : std::vector<std::string>{ "xx", "yy", "zz",
                                                 "xy", "xz", "yz" };
      for (unsigned int k = 0; k < n && low[0] <= -minus_high[0]; ++k)
        text += text_of(k == 0 ? ": " : ", ", names[k], " ",
                        range_text(low[k], -minus_high[k]));
      return text.empty() ? text : text + " Pa";
    }
  } // namespace

  std::vector<const SlenderBlock *>
  coarse_slender_blocks(const Parameters &parameters, const MeshReport &report,
                        const std::vector<unsigned int> &material_of_group)
  {
    /** Part of the faces that is no joint, where a block bends freely. */
    constexpr double most_free = 0.75;
    std::vector<const SlenderBlock *> result;
    if (parameters.cells.kind != TriangleKind::plain)
      return result;
    for (const SlenderBlock &block : report.slender)
    {
      double outer = 0.;
      for (const auto &[name, size] : block.outer)
        outer += size;
      if (outer >= most_free * block.faces
          && !parameters.model.materials[material_of_group[block.group]].rigid)
        result.push_back(&block);
    }
    return result;
  }

  std::vector<std::string>
  bending_lines(const Parameters &parameters, const MeshReport &report,
                const std::vector<unsigned int> &material_of_group)
  {
    const auto blocks
        = coarse_slender_blocks(parameters, report, material_of_group);
    if (blocks.empty())
      return {};
    const SlenderBlock &worst
        = **std::min_element(blocks.begin(), blocks.end(),
                             [](const SlenderBlock *a, const SlenderBlock *b)
                             { return a->n_across < b->n_across; });
    return { text_of(
        "bending: ", count_text(blocks.size(), "slender block"),
        blocks.size() == 1 ? " has" : " have", " fewer than four linear ",
        report.dimension == 2 ? "triangles" : "tetrahedra",
        " across, the fewest ", 0.1 * std::round(10. * worst.n_across),
        " across ", worst.thickness, " m at ", report.position(worst.middle),
        " m: free bending would be up to ",
        std::round(100. * worst.lost_deflection(report.dimension)),
        " % too small there") };
  }

  template <int dim>
  std::vector<std::string> load_lines(const Parameters &parameters,
                                      const NodeMap<dim> &nodes)
  {
    std::vector<std::string> lines;
    for (const LoadParameters &load : parameters.loads)
    {
      std::string text = "load " + load.name + ": " + load.type_text()
                         + place_text(load, nodes);
      for (const auto &given : load.given_components())
      {
        text += ", " + given.name + " ";
        const bool is_water
            = given.component.field && given.component.field->level();
        if (given.component.field && !is_water)
          text += "by place";
        else
          text += (is_water ? "of water, level " : "")
                  + value_text(parameters, load, given.component) + " "
                  + (is_water ? "m" : given.unit);
      }
      if (load.shape)
        text += text_of(", moving, over ", load.shape->width, " m");
      if (load.type == LoadType::free_field)
        text += ", on the base " + load.base;
      if (load.type == LoadType::initial_stress)
        text += stress_text(load, nodes);
      for (const StageParameters &stage : parameters.stages)
        if (is_in_pattern(stage, load))
          text += ", times the factor that stage " + stage.name + " seeks";
      lines.push_back(text);
    }
    return lines;
  }

  template std::vector<std::string>
  material_lines(const Parameters &, const NodeMap<2> &,
                 const std::vector<unsigned int> &);
  template std::vector<std::string> load_lines(const Parameters &,
                                               const NodeMap<2> &);
  template std::vector<std::string>
  material_lines(const Parameters &, const NodeMap<3> &,
                 const std::vector<unsigned int> &);
  template std::vector<std::string> load_lines(const Parameters &,
                                               const NodeMap<3> &);
} // namespace quoin
