// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_block_elements_cell_linearisation_h
#define quoin_source_block_elements_cell_linearisation_h

#include <quoin/block_elements/cell_strain.h>
#include <quoin/block_elements/cell_tangent.h>

// What the derivatives of single tetrahedra and of mixed ones share.

namespace quoin
{
  /** Change of the displacement gradient in a difference [-]: small beside
      the strains at which materials yield, large beside rounding. */
  constexpr double gradient_difference = 1e-8;

  using SpaceMatrix = std::array<std::array<double, 3>, 3>;

  /** Gradients of the shape functions of a tetrahedron [1/m]. */
  std::array<std::array<double, 3>, 4>
  shape_gradients(const Tetrahedron<OneLane> &geometry);

  /** Forces of @p stress on the nodes of a tetrahedron [N]. */
  std::array<double, 12> nodal_forces(const Tetrahedron<OneLane> &geometry,
                                      const SpaceMatrix &stress);

  /** Stresses of an elastic cell in the rotating frame. */
  struct ElasticCellStress
  {
    SpaceTensor initial; /**< turns with the cell [Pa] */
    SpaceTensor elastic; /**< by its strain [Pa] */
    SpaceStiffness rate; /**< moduli of the rate of the latter [Pa] */
  };

  /** linearise_cell() of an elastic cell, except for its nodes. */
  void linearise_elastic(const CellMotion &motion, const SpaceStrain &strain,
                         const ElasticCellStress &stress,
                         CellLinearisation &result, bool with_stiffness);
} // namespace quoin

#endif
