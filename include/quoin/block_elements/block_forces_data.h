// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_block_forces_data_h
#define quoin_block_elements_block_forces_data_h

#include <quoin/base/node_record.h>
#include <quoin/base/thickness.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/materials/mohr_coulomb.h>
#include <quoin/materials/space_mohr_coulomb.h>
#include <quoin/mesh/mixed_tetrahedra.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace quoin
{
  /** Mesh data of the block kernel. */
  template <int dim>
  struct BlockForcesData;

  /** Mesh data of the block kernel: triangles. */
  template <>
  struct BlockForcesData<2>
  {
    /** Nodes of each cell, block-major. */
    std::vector<std::array<unsigned int, 3>> cells;
    std::vector<unsigned int> block_first_cell; /**< n_blocks + 1 entries */
    std::vector<unsigned int> block_first_node; /**< n_blocks + 1 entries */

    std::vector<PlaneStiffness> stiffness; /**< the different ones */

    /** Index into stiffness of each cell; empty if there is only one. */
    std::vector<unsigned int> cell_stiffness;

    /** Yield law of cells of each stiffness, if any; empty: no cell yields. */
    std::vector<std::optional<MohrCoulomb>> laws;

    /**
     * Stress xx, yy, xy, zz of each cell at zero strain [Pa]; it turns with
     * the cell. zz is 0 in plane stress. Empty: none.
     */
    AlignedArray<std::array<double, 4>> initial_stress;

    Thickness thickness; /**< out-of-plane thickness for each stiffness */

    /**
     * Whether each four cells are one six-node triangle, cut as by NodeMap.
     * Functions of one cell (strains, stresses, linearise()) are then those of
     * that triangle at the centroids of the cells; add_forces() and others in
     * lanes are not.
     */
    bool quadratic = false;

    const PlaneStiffness &stiffness_of(const unsigned int cell) const
    {
      return stiffness[cell_stiffness.empty() ? 0 : cell_stiffness[cell]];
    }

    double thickness_of(const unsigned int cell) const
    {
      return thickness[cell_stiffness.empty() ? 0 : cell_stiffness[cell]];
    }

    /** Stress xx, yy, xy, zz of a cell without strain [Pa]. */
    std::array<double, 4> initial_stress_of(const unsigned int cell) const
    {
      return initial_stress.empty() ? std::array<double, 4>{}
                                    : initial_stress[cell];
    }

    /** Whether any cell has a yield law. */
    bool is_plastic() const
    {
      return std::any_of(laws.begin(), laws.end(),
                         [](const auto &law) { return law.has_value(); });
    }

    /** Yield law of cells of one stiffness; null: elastic. */
    const MohrCoulomb *law(const unsigned int s) const
    {
      return laws.empty() || !laws[s] ? nullptr : &*laws[s];
    }
    const MohrCoulomb *law_of(const unsigned int cell) const
    {
      return law(cell_stiffness.empty() ? 0 : cell_stiffness[cell]);
    }
  };

  /** Mesh data of the block kernel: tetrahedra. */
  template <>
  struct BlockForcesData<3>
  {
    /** Nodes of each cell, block-major; det of Tetrahedron is positive. */
    std::vector<std::array<unsigned int, 4>> cells;
    std::vector<unsigned int> block_first_cell; /**< n_blocks + 1 entries */

    /** First node of each block, n_blocks + 1 entries, without the nodes that
        several blocks or tiles share. */
    std::vector<unsigned int> block_first_node;

    std::vector<SpaceStiffness> stiffness; /**< the different ones */

    /** Index into stiffness of each cell; empty if there is only one. */
    std::vector<unsigned int> cell_stiffness;

    /** Yield law of cells of each stiffness, if any; empty: no cell yields. */
    std::vector<std::optional<SpaceMohrCoulomb>> laws;

    /** Stress of each cell at zero strain [Pa]; it turns with the cell.
        Empty: none. */
    AlignedArray<SpaceTensor> initial_stress;

    /** Whether each eight cells are one mixed tetrahedron, whose mean stress,
        less the own initial one, is the same in all of them; of equal
        stiffness and law. */
    bool mixed = false;

    /** Consecutive cells that are computed together. */
    unsigned int n_joined_cells() const
    {
      return mixed ? parts_of_mixed : 1;
    }

    const SpaceStiffness &stiffness_of(const unsigned int cell) const
    {
      return stiffness[cell_stiffness.empty() ? 0 : cell_stiffness[cell]];
    }

    /** Stress of a cell without strain [Pa]. */
    SpaceTensor initial_stress_of(const unsigned int cell) const
    {
      return initial_stress.empty() ? SpaceTensor{} : initial_stress[cell];
    }

    /** Whether any cell has a yield law. */
    bool is_plastic() const
    {
      return std::any_of(laws.begin(), laws.end(),
                         [](const auto &law) { return law.has_value(); });
    }

    /** Yield law of cells of one stiffness; null: elastic. */
    const SpaceMohrCoulomb *law(const unsigned int s) const
    {
      return laws.empty() || !laws[s] ? nullptr : &*laws[s];
    }
    const SpaceMohrCoulomb *law_of(const unsigned int cell) const
    {
      return law(cell_stiffness.empty() ? 0 : cell_stiffness[cell]);
    }
  };
} // namespace quoin

#endif
