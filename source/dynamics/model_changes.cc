// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How a Model changes between stages.

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/dynamics/model.h>

#include <algorithm>

namespace quoin
{
  std::vector<bool> Model::find_groups(const std::vector<std::string> &names,
                                       const std::string &where) const
  {
    std::vector<bool> result(table().group_names.size(), false);
    for (const std::string &name : names)
    {
      const auto found = std::find(table().group_names.begin(),
                                   table().group_names.end(), name);
      if (found == table().group_names.end())
        throw InputError(where + ": the mesh has no physical surface '" + name
                         + "'. It has: " + known_names(table().group_names)
                         + ". Name one of these.");
      result[found - table().group_names.begin()] = true;
    }
    return result;
  }

  std::vector<bool> Model::absent_nodes(const State<2> &state) const
  {
    std::vector<bool> result(node_map.n_local(), false);
    if (!state.block_marks.empty())
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = state.is_absent(node_map.block_of_node(i));
    return result;
  }

  std::vector<bool> Model::groups_present_at_start() const
  {
    std::vector<bool> present = absent_group;
    present.flip();
    return present;
  }

  void Model::bring_to_rest(const unsigned int block, State<2> &state) const
  {
    const NodeRange range = block_nodes(block);
    for (std::size_t i = range.begin; i < range.end; ++i)
      state.velocity[i] = NodeVector<2>{ { 0., 0. } };
    if (table().is_rigid[block])
    {
      if (range.size() > 0)
        std::fill_n(state.get<RigidBlockStates>()[rigid_number(block)].velocity,
                    3, 0.);
      return;
    }
    double mean[2]{};
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        mean[d] += state.nodes[i].u[d] / range.size();
    for (std::size_t i = range.begin; i < range.end; ++i)
      std::copy(mean, mean + 2, state.nodes[i].u);
    forget_yielding(block, state.get<PlasticHistory>());
  }

  void Model::place(const unsigned int block, State<2> &state) const
  {
    bring_to_rest(block, state);
    const NodeRange range = block_nodes(block);
    for (std::size_t i = range.begin; i < range.end; ++i)
      std::fill_n(state.nodes[i].u, 2, 0.);
    if (table().is_rigid[block] && range.size() > 0)
      state.get<RigidBlockStates>()[rigid_number(block)] = RigidBlockState();
  }

  bool Model::is_at_absent_block(const unsigned int segment,
                                 const State<2> &state) const
  {
    const JointNodes<2> &face
        = node_map.joint_faces()[matched_joints.segment(segment).face];
    return state.is_absent(face.blocks[0]) || state.is_absent(face.blocks[1]);
  }

  AlignedArray<double> Model::packed_initial_stress() const
  {
    AlignedArray<double> result;
    for (unsigned int c = 0; c < n_deformable_cells() && !cell_stress.empty();
         ++c)
      for (const double stress : cell_stress[c])
        result.push_back(stress);
    return result;
  }

  void Model::set_properties(const ModelProperties &properties,
                             const ConstructionState &construction)
  {
    now = properties;
    find_masses();
    pack_blocks(construction);
    matched_joints.set_laws(now.joints);
    if (!table().is_quadratic)
      find_stable_step();
  }

  void Model::forget_initial_stress(const std::vector<bool> &groups,
                                    ConstructionState &construction)
  {
    if (construction.initial_stress.empty())
      construction.initial_stress = packed_initial_stress();
    auto &stress = construction.initial_stress;
    for (unsigned int c = 0; 4 * c < stress.size(); ++c)
      if (groups[node_map.group_of_cell(c)])
        std::fill_n(&stress[4 * c], 4, 0.);
  }

  void Model::change_properties(const ModelProperties &properties,
                                State<2> &state)
  {
    std::vector<PlaneStiffness> stiffness;
    std::vector<std::optional<MohrCoulomb>> laws;
    for (const MaterialParameters &material : properties.materials)
    {
      stiffness.push_back(plane_stiffness(material.elastic, parameters.plane));
      laws.emplace_back();
      if (material.strength)
        laws.back().emplace(material.elastic, *material.strength,
                            parameters.plane);
    }
    auto &initial           = state.get<ConstructionState>().initial_stress;
    PlasticHistory &plastic = state.get<PlasticHistory>();
    for (unsigned int c = 0; c < n_deformable_cells(); ++c)
    {
      const unsigned int m
          = properties.material_of_group[node_map.group_of_cell(c)];
      const MohrCoulomb *law = laws[m] ? &*laws[m] : nullptr;
      const auto before      = block_forces.stress_of_strain(
               state.nodes.data(), plastic, c, block_forces.cell_stiffness(c),
               block_forces.cell_law(c));
      const auto after = block_forces.stress_of_strain(
          state.nodes.data(), plastic, c, stiffness[m], law);
      const auto bears = block_forces.initial_stress(c);
      if (law)
        for (unsigned int k = 0; k < 4; ++k)
          plastic.cells[c].stress[k] = bears[k] + before[k];
      if (before == after)
        continue;
      if (initial.empty())
        initial = packed_initial_stress();
      initial.resize(4 * n_deformable_cells(), 0.);
      for (unsigned int k = 0; k < 4; ++k)
        initial[4 * c + k] = bears[k] + before[k] - after[k];
    }
    set_properties(properties, state.get<ConstructionState>());
    matched_joints.keep_tractions(state.nodes.data(),
                                  state.get<JointHistory>());
  }
} // namespace quoin
