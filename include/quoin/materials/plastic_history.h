// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_plastic_history_h
#define quoin_materials_plastic_history_h

#include <quoin/base/node_record.h>

#include <cstddef>
#include <cstdint>

namespace quoin
{
  /**
   * A cell of a material that yields, PlasticPoint's components xx, yy, xy (the
   * tensor's) and zz. One cache line.
   */
  struct alignas(64) PlasticCell
  {
    double inverse_stretch[4]{}; /**< inverse plastic stretch less 1 [-] */
    double stress[4]{}; /**< last computed stress, tension positive [Pa] */
  };

  /** Internal variables of a tetrahedron as those of PlasticCell; symmetric
      tensors have the components 11, 22, 33, 12, 13, 23. */
  struct alignas(32) SpacePlasticCell
  {
    double inverse_stretch[6]{};
    double stress[6]{};
  };

  /**
   * Histories of the deformable cells of this rank; empty unless one of them
   * yields. See MohrCoulomb.
   */
  struct PlasticHistory
  {
    static constexpr const char *slice_name = "plastic cells";

    AlignedArray<PlasticCell> cells;
    /** In place of them in three dimensions. */
    AlignedArray<SpacePlasticCell> space_cells;
    AlignedArray<double> shear;          /**< accumulated plastic shear [-] */
    AlignedArray<std::uint8_t> yielding; /**< bits of namespace yielding */

    template <int dim>
    void resize(const std::size_t n)
    {
      if constexpr (dim == 2)
        cells.resize(n);
      else
        space_cells.resize(n);
      shear.resize(n, 0.);
      yielding.resize(n, 0);
    }

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.cells(cells);
      visitor.cells(space_cells);
      visitor.cells(shear);
      visitor.cells(yielding);
    }
  };
} // namespace quoin

#endif
