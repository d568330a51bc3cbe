// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How a Model<2> changes between stages.

#include <quoin/model/model.h>

#include <algorithm>

namespace quoin
{
  template <>
  void Model<2>::bring_to_rest(const std::vector<unsigned int> &blocks,
                               State<2> &state) const
  {
    // A deformable block may lie on several ranks, and so may its nodes.
    std::vector<double> sums(3 * blocks.size(), 0.);
    for (unsigned int k = 0; k < blocks.size(); ++k)
      for (const unsigned int i : owned_nodes(blocks[k]))
      {
        state.velocity[i] = NodeVector<2>{ { 0., 0. } };
        for (unsigned int d = 0; d < 2; ++d)
          sums[3 * k + d] += state.nodes[i].u[d];
        ++sums[3 * k + 2];
      }
    dealii::Utilities::MPI::sum(sums, node_map.communicator(), sums);
    for (unsigned int k = 0; k < blocks.size(); ++k)
    {
      const unsigned int block = blocks[k];
      if (table().is_rigid[block])
      {
        if (block_nodes(block).size() > 0)
          std::fill_n(
              state.get<RigidBlockStates>()[rigid_number(block)].velocity, 3,
              0.);
        continue;
      }
      for (const unsigned int i : owned_nodes(block))
        for (unsigned int d = 0; d < 2; ++d)
          state.nodes[i].u[d] = sums[3 * k + d] / sums[3 * k + 2];
      reset_plasticity(block, state.get<PlasticHistory>());
    }
  }

  template <>
  void Model<2>::place(const std::vector<unsigned int> &blocks,
                       State<2> &state) const
  {
    bring_to_rest(blocks, state);
    for (const unsigned int block : blocks)
    {
      const auto nodes = owned_nodes(block);
      for (const unsigned int i : nodes)
        std::fill_n(state.nodes[i].u, 2, 0.);
      if (table().is_rigid[block] && !nodes.empty())
        state.get<RigidBlockStates>()[rigid_number(block)] = RigidBlockState();
    }
  }

  template <>
  bool Model<2>::is_at_absent_block(const unsigned int segment,
                                    const State<2> &state) const
  {
    const JointNodes<2> &face
        = node_map.faces().joints[matched_joints.segment(segment).face];
    return state.is_absent(face.blocks[0]) || state.is_absent(face.blocks[1]);
  }

  template <>
  AlignedArray<double> Model<2>::packed_initial_stress() const
  {
    AlignedArray<double> result;
    for (unsigned int c = 0; c < n_deformable_cells() && !cell_stress.empty();
         ++c)
      for (const double stress : cell_stress[c])
        result.push_back(stress);
    return result;
  }

  template <>
  void Model<2>::set_properties(const ModelProperties &properties,
                                const ConstructionState &construction)
  {
    now = properties;
    find_masses();
    pack_blocks(construction);
    matched_joints.set_laws(now.joints);
    if (!table().is_quadratic)
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
          = properties.material_of_group[node_map.cells().group[c]];
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
