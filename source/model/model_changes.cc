// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// How a Model changes between stages.

#include <quoin/blocks/cell_states.h>
#include <quoin/model/model.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Sets the last stress of a cell of a material that yields. */
    void set_stress(const std::array<double, 4> &stress,
                    const unsigned int cell, PlasticHistory &history)
    {
      std::copy(stress.begin(), stress.end(), history.cells[cell].stress);
    }
    void set_stress(const SpaceTensor &stress, const unsigned int cell,
                    PlasticHistory &history)
    {
      std::copy(stress.begin(), stress.end(), history.space_cells[cell].stress);
    }
  } // namespace

  template <int dim>
  AlignedArray<double> Model<dim>::packed_initial_stress() const
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

  template <int dim>
  void Model<dim>::set_properties(const ModelProperties &properties,
                                  const ConstructionState<dim> &construction)
  {
    now = properties;
    find_masses();
    pack_blocks(construction);
    matched_joints.set_laws(now.joints);
    if (block_contacts)
      block_contacts->set_properties(now.joints, now.material_of_group);
    if (!node_map.table().is_quadratic)
      find_stable_step();
  }

  template <int dim>
  void Model<dim>::clear_initial_stress(const std::vector<bool> &groups,
                                        ConstructionState<dim> &construction)
  {
    if (construction.initial_stress.empty())
      construction.initial_stress = packed_initial_stress();
    auto &stress             = construction.initial_stress;
    constexpr unsigned int n = ConstructionState<dim>::n_stresses;
    for (unsigned int c = 0; n * c < stress.size(); ++c)
      if (groups[node_map.cells().group[c]])
        std::fill_n(&stress[n * c], n, 0.);
  }

  template <int dim>
  void Model<dim>::change_properties(const ModelProperties &properties,
                                     State<dim> &state)
  {
    std::vector<CellStiffness<dim>> stiffness;
    for (const MaterialParameters &material : properties.materials)
      stiffness.push_back(stiffness_of(material));
    const auto laws          = laws_of(properties.materials);
    constexpr unsigned int n = ConstructionState<dim>::n_stresses;
    auto &initial = state.template get<ConstructionState<dim>>().initial_stress;
    PlasticHistory &plastic = state.template get<PlasticHistory>();
    for (unsigned int c = 0; c < node_map.cells().n_deformable; ++c)
    {
      const unsigned int m
          = properties.material_of_group[node_map.cells().group[c]];
      const YieldLaw<dim> *law          = laws[m] ? &*laws[m] : nullptr;
      const BlockForcesData<dim> &cells = block_forces.cell_data();
      const auto *nodes                 = state.nodes.data();
      const auto after = stress_of_strain(block_forces, nodes, c, stiffness[m]);
      CellStress<dim> bears;
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
        for (unsigned int k = 0; k < n; ++k)
          bears[k] += before[k];
        if (law)
          set_stress(bears, c, plastic);
        if (before == after)
          continue;
      }
      if (initial.empty())
        initial = packed_initial_stress();
      initial.resize(n * node_map.cells().n_deformable, 0.);
      for (unsigned int k = 0; k < n; ++k)
        initial[n * c + k] = bears[k] - after[k];
    }
    set_properties(properties, state.template get<ConstructionState<dim>>());
    keep_joint_tractions(matched_joints, state);
  }

  template AlignedArray<double> Model<2>::packed_initial_stress() const;
  template void Model<2>::set_properties(const ModelProperties &,
                                         const ConstructionState<2> &);
  template void Model<2>::clear_initial_stress(const std::vector<bool> &,
                                               ConstructionState<2> &);
  template void Model<2>::change_properties(const ModelProperties &,
                                            State<2> &);

  template AlignedArray<double> Model<3>::packed_initial_stress() const;
  template void Model<3>::set_properties(const ModelProperties &,
                                         const ConstructionState<3> &);
  template void Model<3>::clear_initial_stress(const std::vector<bool> &,
                                               ConstructionState<3> &);
  template void Model<3>::change_properties(const ModelProperties &,
                                            State<3> &);
} // namespace quoin
