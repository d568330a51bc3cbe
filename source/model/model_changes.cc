// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/cell_states.h>
#include <quoin/model/model_changes.h>

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

    /** The stress at zero strain of cells in the order of
        ConstructionState::initial_stress [Pa]. */
    template <int dim>
    AlignedArray<double> initial_stress_of_cells(const Model<dim> &model)
    {
      AlignedArray<double> result;
      for (const CellStress<dim> &stress :
           model.blocks().cell_data().initial_stress)
        result.insert(result.end(), stress.begin(), stress.end());
      return result;
    }
  } // namespace

  template <int dim>
  void clear_initial_stress(const Model<dim> &model,
                            const std::vector<bool> &groups,
                            ConstructionState<dim> &construction)
  {
    if (construction.initial_stress.empty())
      construction.initial_stress = initial_stress_of_cells(model);
    auto &stress             = construction.initial_stress;
    constexpr unsigned int n = ConstructionState<dim>::n_stresses;
    for (unsigned int c = 0; n * c < stress.size(); ++c)
      if (groups[model.nodes().cells().group[c]])
        std::fill_n(&stress[n * c], n, 0.);
  }

  template <int dim>
  void change_properties(Model<dim> &model, const ModelProperties &properties,
                         State<dim> &state)
  {
    const BlockForces<dim> &blocks = model.blocks();
    const LocalCells<dim> &local   = model.nodes().cells();
    const PlaneAssumption plane    = model.parameters().plane;
    std::vector<CellStiffness<dim>> stiffness;
    for (const MaterialParameters &material : properties.materials)
      stiffness.push_back(stiffness_of<dim>(material, plane));
    const auto laws          = laws_of<dim>(properties.materials, plane);
    constexpr unsigned int n = ConstructionState<dim>::n_stresses;
    auto &initial = state.template get<ConstructionState<dim>>().initial_stress;
    PlasticHistory &plastic      = state.template get<PlasticHistory>();
    const PlasticHistory present = plastic, never_yielded;
    for (unsigned int c = 0; c < local.n_deformable; ++c)
    {
      const unsigned int m     = properties.material_of_group[local.group[c]];
      const YieldLaw<dim> *law = laws[m] ? &*laws[m] : nullptr;
      const BlockForcesData<dim> &cells = blocks.cell_data();
      const auto *nodes                 = state.nodes.data();
      const auto before
          = stress_of_strain(blocks, nodes, present, c, cells.stiffness_of(c));
      const auto after = stress_of_strain(
          blocks, nodes, law ? present : never_yielded, c, stiffness[m]);
      const bool has_yielded = cells.law_of(c) && plastic.yielding[c] != 0;
      if (has_yielded && law)
      {
        // Its stress has nothing of the initial one any more, but others of a
        // mixed tetrahedron may have.
        if (!(cells.stiffness_of(c) == stiffness[m]))
          take_over_stress(blocks, nodes, c, *law, present, plastic);
        if (!model.nodes().table().is_mixed)
          continue;
      }
      CellStress<dim> bears = cells.initial_stress_of(c);
      for (unsigned int k = 0; k < n; ++k)
        bears[k] += before[k];
      if (has_yielded && !law)
      {
        bears = turning_stress(blocks, nodes, present, c);
        forget_history(blocks, c, plastic);
      }
      else
      {
        if (law && !has_yielded)
          set_stress(bears, c, plastic);
        if (before == after)
          continue;
      }
      if (initial.empty())
        initial = initial_stress_of_cells(model);
      initial.resize(n * local.n_deformable, 0.);
      for (unsigned int k = 0; k < n; ++k)
        initial[n * c + k] = bears[k] - after[k];
    }
    model.set_properties(properties,
                         state.template get<ConstructionState<dim>>());
    keep_joint_tractions(model.joints(), state);
  }

  template void clear_initial_stress(const Model<2> &,
                                     const std::vector<bool> &,
                                     ConstructionState<2> &);
  template void clear_initial_stress(const Model<3> &,
                                     const std::vector<bool> &,
                                     ConstructionState<3> &);
  template void change_properties(Model<2> &, const ModelProperties &,
                                  State<2> &);
  template void change_properties(Model<3> &, const ModelProperties &,
                                  State<3> &);
} // namespace quoin
