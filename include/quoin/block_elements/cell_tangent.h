// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_cell_tangent_h
#define quoin_block_elements_cell_tangent_h

#include <quoin/block_elements/block_forces_data.h>
#include <quoin/materials/plastic_history.h>

// Derivatives of the forces of cells, for implicit solvers.

namespace quoin
{
  /**
   * A cell's nodal forces and minus their derivative by the displacements of
   * its nodes: entry dim i + d is node i, component d.
   */
  struct CellLinearisation
  {
    unsigned int n_nodes = 3;
    std::array<unsigned int, 6> nodes;
    std::array<double, 12> force;                     /**< [N] */
    std::array<std::array<double, 12>, 12> stiffness; /**< [N/m] */
    /** Energy dissipated by the update of internal variables [J]. */
    double dissipated;
  };

  /**
   * What BlockForces::add_forces() does for one cell, with the derivative
   * consistent with the update of @p history if @p with_stiffness; otherwise
   * the stiffness is not set. Does nothing and returns false for a cell without
   * weight.
   */
  bool linearise_cell(const BlockForcesData<2> &data, unsigned int cell,
                      const NodeRecord<2> *nodes, PlasticHistory &history,
                      CellLinearisation &result, bool with_stiffness = true);
  /** Linearises a tetrahedron in the same way and returns true. Where @p
     history is empty no cell yields. */
  bool linearise_cell(const BlockForcesData<3> &data, unsigned int cell,
                      const NodeRecord<3> *nodes, PlasticHistory &history,
                      CellLinearisation &result, bool with_stiffness = true);

  /** CellLinearisation of the cells of a mixed tetrahedron together. */
  struct MixedLinearisation
  {
    unsigned int n_nodes = 10;
    std::array<unsigned int, 10> nodes;
    std::array<double, 30> force;                     /**< [N] */
    std::array<std::array<double, 30>, 30> stiffness; /**< [N/m] */
    double dissipated;                                /**< [J] */
  };

  /** linearise_cell() of the mixed tetrahedron of cells @p first to
      @p first + 7. */
  void linearise_mixed(const BlockForcesData<3> &data, unsigned int first,
                       const NodeRecord<3> *nodes, PlasticHistory &history,
                       MixedLinearisation &result, bool with_stiffness = true);
} // namespace quoin

#endif
