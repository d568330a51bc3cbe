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
  // Data of the deformable cells of a NodeMap for operators.

  /** Fills in cells and blocks of @p data. */
  template <int dim>
  void take_cells(const NodeMap<dim> &nodes, BlockForcesData<dim> &data);

  /**
   * Lumped masses of the local nodes, rigid blocks included [kg]. @p density:
   * of each cell group [kg/m^3]; @p thickness: the same. Collective.
   */
  template <int dim>
  std::vector<double> lumped_masses(const NodeMap<dim> &nodes,
                                    const std::vector<double> &density,
                                    const Thickness &thickness = {});

  /** Elastic stiffness of a cell: in the plane or in space. */
  template <int dim>
  using CellStiffness
      = std::conditional_t<dim == 2, PlaneStiffness, SpaceStiffness>;

  /** Stress of a cell: xx, yy, xy, zz in the plane, a SpaceTensor in space. */
  template <int dim>
  using CellStress
      = std::conditional_t<dim == 2, std::array<double, 4>, SpaceTensor>;

  /** Yield law of a cell. */
  template <int dim>
  using YieldLaw = std::conditional_t<dim == 2, MohrCoulomb, SpaceMohrCoulomb>;
} // namespace quoin

#endif
