// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_block_output_h
#define quoin_results_block_output_h

#include <quoin/output/field_series.h>

#include <array>
#include <cstdint>
#include <vector>

namespace quoin
{
  /**
   * The blocks of this rank at an output time, numbered locally: one entry for
   * each vertex or for each cell. Stress and strain are in the fixed axes;
   * tension is positive.
   */
  template <int dim>
  struct BlockFields
  {
    using Vector = dealii::Tensor<1, dim>;

    std::vector<dealii::Point<dim>> position; /**< reference [m] */
    std::vector<Vector> displacement;         /**< [m] */
    /** Displacement before the last reset; may be empty [m]. */
    std::vector<Vector> earlier_displacement;
    std::vector<Vector> velocity;                         /**< [m/s] */
    std::vector<std::array<std::int32_t, dim + 1>> cells; /**< vertices */
    /** xx, yy, xy, zz or xx, yy, zz, xy, xz, yz [Pa] */
    std::vector<std::array<double, dim == 2 ? 4 : 6>> stress;
    /** xx, yy, xy or xx, yy, zz, xy, xz, yz (tensor) [-] */
    std::vector<std::array<double, dim == 2 ? 3 : 6>> strain;
    /** Bits: 1 shear now, 2 tension now, 4 shear past, 8 tension past. */
    std::vector<std::int32_t> yielding; /**< empty if no cell can yield */
    std::vector<double> plastic_shear;  /**< accumulated [-]; or empty */
    std::vector<std::int32_t> block;
    std::vector<std::int32_t> material;
  };

  /** Principal stresses and the unit direction of each. */
  template <int dim>
  struct PrincipalStress
  {
    std::array<double, dim> value; /**< descending: tension first [Pa] */
    /** Principal directions; in the plane the second is the first rotated by 90
        degrees, anticlockwise. */
    std::array<dealii::Tensor<1, dim>, dim> direction;
  };

  /** Principal stresses in the plane, of the stress xx, yy, xy, zz. */
  PrincipalStress<2> principal_stress(const std::array<double, 4> &stress);
  /** Principal stresses of the stress xx, yy, zz, xy, xz, yz. */
  PrincipalStress<3> principal_stress(const std::array<double, 6> &stress);

  /**
   * The series blocks.pvd: the blocks in their reference position, that of the
   * mesh or where displacements were reset, with the displacement from there as
   * point data (ParaView: Warp By Vector), one file for each rank and time.
   */
  class BlockOutput : public FieldSeries
  {
  public:
    BlockOutput(const std::string &output_directory,
                const MPI_Comm communicator,
                const FieldFormat format = FieldFormat::vtu);

    /** Collective. Writes the fields of the time @p time [s]. */
    template <int dim>
    void write(const double time, const BlockFields<dim> &fields);
  };
} // namespace quoin

#endif
