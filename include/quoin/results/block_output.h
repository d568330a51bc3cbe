// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_block_output_h
#define quoin_results_block_output_h

#include <quoin/results/vtu_series.h>

#include <array>
#include <cstdint>
#include <vector>

namespace quoin
{
  /**
   * The blocks of this rank at one moment, numbered locally: one entry for
   * each vertex or for each cell. Stress and strain are those in the fixed
   * axes x and y; tension is positive.
   */
  struct BlockFields
  {
    std::vector<std::array<double, 2>> position;     /**< reference [m] */
    std::vector<std::array<double, 2>> displacement; /**< [m] */
    std::vector<std::array<double, 2>> velocity;     /**< [m/s] */
    std::vector<std::array<std::int32_t, 3>> cells;  /**< vertices */
    std::vector<std::array<double, 4>> stress;       /**< xx, yy, xy, zz [Pa] */
    std::vector<std::array<double, 3>> strain; /**< xx, yy, xy (tensor) [-] */
    /** Bits: 1 shear now, 2 tension now, 4 shear past, 8 tension past. */
    std::vector<std::int32_t> yielding; /**< empty if no cell can yield */
    std::vector<double> plastic_shear;  /**< accumulated [-]; or empty */
    std::vector<std::int32_t> block;
    std::vector<std::int32_t> material;
  };

  /** Principal stresses in the plane and the unit direction of each. */
  struct PrincipalStress
  {
    double s1; /**< the larger (more tensile) one [Pa] */
    double s2; /**< the smaller one [Pa] */
    std::array<double, 2> direction1;
    std::array<double, 2> direction2; /**< direction1 turned left by 90 deg */
  };

  PrincipalStress principal_stress(const double xx, const double yy,
                                   const double xy);

  /**
   * The series blocks.pvd: the blocks in their reference position with the
   * displacement as point data (ParaView: Warp By Vector), one file for each
   * rank and time.
   */
  class BlockOutput : public VtuSeries
  {
  public:
    BlockOutput(const std::string &output_directory,
                const MPI_Comm communicator);

    /** Collective. Writes the fields of the time @p time [s]. */
    void write(const double time, const BlockFields &fields);
  };
} // namespace quoin

#endif
