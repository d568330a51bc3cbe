// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_initial_stress_h
#define quoin_model_initial_stress_h

#include <quoin/base/node_record.h>
#include <quoin/blocks/block_cells.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  struct ModelParameters;
  struct ModelProperties;

  /** The stress that loads of type 'initial stress' give to cells and joints
      [Pa]; both are empty if there are none. */
  template <int dim>
  struct InitialStress
  {
    std::vector<CellStress<dim>> cells;
    std::vector<JointFaceStress<dim>> faces;

    /** The initial stress of deformable cells in the order of
        ConstructionState::initial_stress. */
    AlignedArray<double> packed(const NodeMap<dim> &nodes) const;
  };

  /**
   * The initial stress of cells and joints that are not in groups that are
   * @p absent. Throws an InputError about one of the other dimension, out of a
   * plane that is free, or that is not finite. Collective.
   */
  template <int dim>
  InitialStress<dim> find_initial_stress(const NodeMap<dim> &nodes,
                                         const ModelParameters &parameters,
                                         const ModelProperties &properties,
                                         const std::vector<bool> &absent);
} // namespace quoin

#endif
