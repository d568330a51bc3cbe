// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_block_cells_h
#define quoin_blocks_block_cells_h

#include <quoin/blocks/block_forces_3d.h>
#include <quoin/blocks/stable_time_step.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  // What operators take from the deformable cells of a NodeMap.

  /** Fills in cells and blocks of @p data. */
  template <int dim>
  void take_cells(const NodeMap<dim> &nodes, BlockForcesData<dim> &data);

  /**
   * Lumped masses of the local nodes, those of rigid blocks too [kg].
   * @p density: of each cell group; @p thickness: in two dimensions [m].
   * Collective.
   */
  template <int dim>
  std::vector<double> lumped_masses(const NodeMap<dim> &nodes,
                                    const std::vector<double> &density,
                                    double thickness = 1.);

  /** Elastic stiffness of a cell: in the plane or in space. */
  template <int dim>
  using CellStiffness
      = std::conditional_t<dim == 2, PlaneStiffness, SpaceStiffness>;

  /**
   * S_i of StableTimeStep of the local nodes by the cells of this rank [N/m];
   * to be added to those of owners. @p stiffness and @p density: of each cell
   * group.
   */
  template <int dim>
  std::vector<typename StableTimeStep<dim>::Bound>
  cell_bounds(const NodeMap<dim> &nodes,
              const std::vector<CellStiffness<dim>> &stiffness,
              const std::vector<double> &density, double thickness = 1.);
} // namespace quoin

#endif
