// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/input_advice.h>
#include <quoin/base/number_text.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace quoin
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Beyond it triangles of constant strain lock in plane strain. */
    constexpr double locking_poisson = 0.45;
    /** Normal stiffness of joints by E/h of the cells beside. */
    constexpr double stiff_joint = 100.;
    /** The same by E/L of blocks: of their displacement, of which a joint
        closes by the inverse, double precision keeps six more digits. */
    constexpr double rigid_joint = 1e10;
    /** The same by E/L of the blocks beside. */
    constexpr double soft_joint = 1e-3;
    /** More moments of fields than one can look at. */
    constexpr double many_moments = 5000.;

    bool names(const std::vector<std::string> &list, const std::string &name)
    {
      return std::find(list.begin(), list.end(), name) != list.end();
    }

    bool is_in_set(const JointNodes<2> &face, const JointSetParameters &set,
                   const BlockTable<2> &table)
    {
      return names(set.curves,
                   face.name == 0 ? "unnamed" : table.face_names[face.name]);
    }

    /** Whether the set has joints where the run begins. Collective. */
    bool has_joints(const JointSetParameters &set, const NodeMap<2> &nodes)
    {
      const auto &faces = nodes.joint_faces();
      const bool has    = std::any_of(faces.begin(), faces.end(),
                                      [&](const JointNodes<2> &face) {
                                     return is_in_set(face, set, nodes.table());
                                   });
      return dealii::Utilities::MPI::max(has ? 1U : 0U, nodes.communicator())
             == 1U;
    }

    /** Whether stages let other joints become like @p set. */
    bool is_taken_later(const JointSetParameters &set,
                        const std::vector<StageParameters> &stages)
    {
      return std::any_of(stages.begin(), stages.end(),
                         [&](const StageParameters &stage)
                         {
                           return std::any_of(stage.joint_properties.begin(),
                                              stage.joint_properties.end(),
                                              [&](const auto &pair) {
                                                return pair.second == set.name;
                                              });
                         });
    }

    /** Diagonal of the box around each block [m]. Collective. */
    std::vector<double> block_sizes(const NodeMap<2> &nodes)
    {
      // Upper corners with the other sign: one minimum finds both.
      const unsigned int n_blocks = nodes.table().n_blocks();
      std::vector<double> box(4 * n_blocks, infinity);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          double *corners = &box[4 * nodes.block_of_node(i) + d];
          corners[0]      = std::min(corners[0], nodes.point(i)[d]);
          corners[2]      = std::min(corners[2], -nodes.point(i)[d]);
        }
      dealii::Utilities::MPI::min(box, nodes.communicator(), box);
      std::vector<double> sizes;
      for (unsigned int b = 0; b < n_blocks; ++b)
        sizes.push_back(std::hypot(box[4 * b] + box[4 * b + 2],
                                   box[4 * b + 1] + box[4 * b + 3]));
      return sizes;
    }

    /** E/length of the stiffest and the softest neighbour [Pa/m]. */
    struct Neighbours
    {
      double stiffest_cell = 0., softest_block = infinity;
    };

    Neighbours neighbours(const JointSetParameters &set,
                          const std::vector<MaterialParameters> &materials,
                          const Model &model)
    {
      // Boxes of blocks are of all ranks' parts.
      const NodeMap<2> &nodes = model.nodes();
      const auto sizes        = block_sizes(nodes);
      Neighbours result;
      for (const JointNodes<2> &face : nodes.joint_faces())
      {
        if (!is_in_set(face, set, model.table()))
          continue;
        for (unsigned int side = 0; side < 2; ++side)
        {
          const unsigned int cell = face.cells[side];
          if (!face.is_own[side]
              || materials[model.material_of_cell(cell)].rigid)
            continue;
          const double young
              = materials[model.material_of_cell(cell)].elastic.young;
          double shortest = infinity;
          for (unsigned int k = 0; k < 3; ++k)
            shortest = std::min(
                shortest,
                nodes.point(nodes.cell(cell)[k])
                    .distance(nodes.point(nodes.cell(cell)[(k + 1) % 3])));
          result.stiffest_cell
              = std::max(result.stiffest_cell, young / shortest);
          result.softest_block = std::min(result.softest_block,
                                          young / sizes[face.blocks[side]]);
        }
      }
      result.stiffest_cell = dealii::Utilities::MPI::max(result.stiffest_cell,
                                                         nodes.communicator());
      result.softest_block = dealii::Utilities::MPI::min(result.softest_block,
                                                         nodes.communicator());
      return result;
    }

    void advise_about_joints(const Parameters &parameters, const Model &model,
                             std::vector<std::string> &advice)
    {
      for (const JointSetParameters &set : parameters.model.joints)
      {
        const bool takes_new
            = set.all_new_contacts || !set.new_contacts.empty();
        const std::string begin = "joints " + set.name + ": ";
        if (!has_joints(set, model.nodes()))
        {
          if (!takes_new && !set.curves.empty()
              && !is_taken_later(set, parameters.stages))
            advice.push_back(begin
                             + "there are none on its curves: they act on "
                               "nothing. Name the curves in 'Joints along' of "
                               "section 'Mesh', or remove the set.");
          continue;
        }
        const Neighbours beside
            = neighbours(set, parameters.model.materials, model);
        const double kn = stiffness_bound(set.law)[0];
        // Of rock joints it is a bound that few of them come near.
        if (!parameters.is_implicit && !stiffens(set.law)
            && beside.stiffest_cell > 0.
            && kn > stiff_joint * beside.stiffest_cell)
          advice.push_back(
              begin + "the normal stiffness " + number_text(kn) + " Pa/m is "
              + number_text(kn / beside.stiffest_cell)
              + " times E/h of the smallest triangles beside them: they, not "
                "the blocks, make the time step short, about "
              + number_text(std::sqrt(kn / beside.stiffest_cell))
              + " times. Unless it was measured take some ten times E/h, "
              + number_text(10. * beside.stiffest_cell) + " Pa/m.");
        if (parameters.is_implicit && kn > rigid_joint * beside.softest_block)
          advice.push_back(
              begin + "the normal stiffness " + number_text(kn) + " Pa/m is "
              + number_text(kn / beside.softest_block)
              + " times E/L of the softest block beside them: what closes "
                "them is lost in the rounding of its displacements, and no "
                "equilibrium may be found. Take "
              + number_text(1e4 * beside.softest_block) + " Pa/m or less.");
        if (kn < soft_joint * beside.softest_block
            && std::isfinite(beside.softest_block))
          advice.push_back(
              begin + "the normal stiffness " + number_text(kn)
              + " Pa/m is less than a thousandth of E/L of the blocks beside "
                "them, "
              + number_text(beside.softest_block)
              + " Pa/m: blocks hardly deform. Check its unit, or make the "
                "blocks rigid, which takes far fewer steps.");
      }
    }

    void advise_about_materials(const Parameters &parameters,
                                const Model &model,
                                std::vector<std::string> &advice)
    {
      if (parameters.triangles != TriangleKind::plain
          || parameters.model.plane != PlaneAssumption::plane_strain)
        return;
      std::vector<unsigned int> is_used(parameters.model.materials.size(), 0);
      for (unsigned int c = 0; c < model.nodes().n_cells(); ++c)
        is_used[model.material_of_cell(c)] = 1;
      dealii::Utilities::MPI::max(is_used, model.nodes().communicator(),
                                  is_used);
      for (unsigned int m = 0; m < is_used.size(); ++m)
      {
        const MaterialParameters &material = parameters.model.materials[m];
        if (is_used[m] && !material.rigid
            && material.elastic.poisson > locking_poisson)
          advice.push_back("material " + material.name
                           + ": with Poisson's ratio "
                           + number_text(material.elastic.poisson)
                           + " plain triangles lock in plane strain, they are "
                             "too stiff. Take 'Triangles = crossed' in section "
                             "'Mesh'.");
      }
    }

    void advise_about_output(const Parameters &parameters,
                             std::vector<std::string> &advice)
    {
      if (parameters.field_interval == 0.)
        return;
      double duration = 0.;
      for (const StageParameters &stage : parameters.stages)
        if (stage.end == StageEnd::time)
          duration += stage.duration;
      const double n = duration / parameters.field_interval;
      if (n > many_moments)
        advice.push_back("'Field interval = "
                         + number_text(parameters.field_interval)
                         + "' in section 'Output' writes fields "
                         + std::to_string(std::uint64_t(std::min(n, 1e18)))
                         + " times. Some hundred make a film: take "
                         + number_text(duration / 200.) + " s.");
    }
  } // namespace

  std::vector<std::string> model_advice(const Parameters &parameters,
                                        const Model &model)
  {
    std::vector<std::string> advice;
    advise_about_materials(parameters, model, advice);
    advise_about_joints(parameters, model, advice);
    advise_about_output(parameters, advice);
    return advice;
  }

  std::vector<std::string>
  free_body_advice(const std::string &stage,
                   const std::vector<PushedBody> &bodies)
  {
    if (bodies.empty())
      return {};
    const PushedBody &first = bodies.front();
    std::string text        = "stage " + stage + ": block "
                       + std::to_string(first.block) + ", at ("
                       + number_text(first.centre[0]) + ", "
                       + number_text(first.centre[1]) + ") m";
    if (first.n_blocks > 1)
      text += ", and the " + std::to_string(first.n_blocks - 1)
              + (first.n_blocks == 2 ? " block" : " blocks") + " joined to it,";
    text += first.is_loose ? " is held by nothing"
                           : " is not held where its loads push it";
    text += ": it will move away as a rigid body.";
    if (bodies.size() > 1)
      text += " So will " + std::to_string(bodies.size() - 1) + " more.";
    return { text
             + " Join it to its neighbours ('Joints along' in section 'Mesh'), "
               "hold it by a load, or, if it lies on other blocks, take "
               "'Displacements = large' in section 'Contact'." };
  }
} // namespace quoin
