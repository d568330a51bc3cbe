// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How a Model<2> changes between stages.

#include <quoin/blocks/cell_states.h>
#include <quoin/model/model.h>

#include <algorithm>

namespace quoin
{
  template <>
  AlignedArray<double> Model<2>::packed_initial_stress() const
  {
    AlignedArray<double> result;
    for (unsigned int c = 0;
         c < node_map.cells().n_deformable && !cell_stress.empty(); ++c)
      for (const double stress : cell_stress[c])
        result.push_back(stress);
    return result;
  }

  ModelProperties reduced(ModelProperties properties, const double factor,
                          const bool joints, const bool blocks)
  {
    if (joints)
      for (JointSetParameters &set : properties.joints)
        set.law = reduced(set.law, factor);
    if (blocks)
      for (MaterialParameters &material : properties.materials)
        material = reduced(material, factor);
    return properties;
  }

  template <>
  void Model<2>::set_properties(const ModelProperties &properties,
                                const ConstructionState &construction)
  {
    now = properties;
    find_masses();
    pack_blocks(construction);
    matched_joints.set_laws(now.joints);
    if (block_contacts)
    {
      block_contacts->set_laws(now.joints);
      block_contacts->set_materials(now.material_of_group);
    }
    if (!node_map.table().is_quadratic)
      find_stable_step();
  }

  template <>
  void Model<2>::clear_initial_stress(const std::vector<bool> &groups,
                                      ConstructionState &construction)
  {
    if (construction.initial_stress.empty())
      construction.initial_stress = packed_initial_stress();
    auto &stress = construction.initial_stress;
    for (unsigned int c = 0; 4 * c < stress.size(); ++c)
      if (groups[node_map.cells().group[c]])
        std::fill_n(&stress[4 * c], 4, 0.);
  }

  template <>
  void Model<2>::change_properties(const ModelProperties &properties,
                                   State<2> &state)
  {
    std::vector<PlaneStiffness> stiffness;
    std::vector<std::optional<MohrCoulomb>> laws;
    for (const MaterialParameters &material : properties.materials)
    {
      stiffness.push_back(plane_stiffness(material.elastic, given.plane));
      laws.emplace_back();
      if (material.strength)
        laws.back().emplace(material.elastic, *material.strength, given.plane);
    }
    auto &initial           = state.get<ConstructionState>().initial_stress;
    PlasticHistory &plastic = state.get<PlasticHistory>();
    for (unsigned int c = 0; c < node_map.cells().n_deformable; ++c)
    {
      const unsigned int m
          = properties.material_of_group[node_map.cells().group[c]];
      const MohrCoulomb *law          = laws[m] ? &*laws[m] : nullptr;
      const BlockForcesData<2> &cells = block_forces.cell_data();
      const auto *nodes               = state.nodes.data();
      const auto after = stress_of_strain(block_forces, nodes, c, stiffness[m]);
      std::array<double, 4> bears;
      if (cells.law_of(c) && plastic.yielding[c] != 0)
      {
        // Its stress has nothing of the initial one any more.
        if (law && !(cells.stiffness_of(c) == stiffness[m]))
          take_over_stress(block_forces, nodes, c, *law, plastic);
        if (law)
          continue;
        bears = turning_stress(block_forces, nodes, plastic, c);
        forget_history(block_forces, c, plastic);
      }
      else
      {
        bears = cells.initial_stress_of(c);
        const auto before
            = stress_of_strain(block_forces, nodes, c, cells.stiffness_of(c));
        for (unsigned int k = 0; k < 4; ++k)
          bears[k] += before[k];
        if (law)
          std::copy(bears.begin(), bears.end(), plastic.cells[c].stress);
        if (before == after)
          continue;
      }
      if (initial.empty())
        initial = packed_initial_stress();
      initial.resize(4 * node_map.cells().n_deformable, 0.);
      for (unsigned int k = 0; k < 4; ++k)
        initial[4 * c + k] = bears[k] - after[k];
    }
    set_properties(properties, state.get<ConstructionState>());
    keep_joint_tractions(matched_joints, state);
  }
} // namespace quoin
