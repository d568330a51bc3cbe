// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_vtu_writer_h
#define quoin_results_vtu_writer_h

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace quoin
{
  /** The cell types that are used, with VTK's numbers. */
  enum class VtuCellType : std::uint8_t
  {
    line     = 3,
    triangle = 5
  };

  /**
   * A named array of a grid, @p n_components values for each point or cell,
   * one after the other. Two components are a vector in the plane and are
   * written with a third one, z = 0, because viewers know no other vectors.
   */
  struct VtuField
  {
    std::string name;
    unsigned int n_components;
    std::variant<std::vector<double>, std::vector<std::int32_t>,
                 std::vector<std::uint8_t>>
        values;
    std::vector<std::string> component_names = {};
  };

  /** An unstructured grid in the plane. */
  struct VtuGrid
  {
    double time = 0.; /**< [s] */
    VtuCellType cell_type;
    std::vector<std::array<double, 2>> points; /**< [m]; z = 0 is added */
    std::vector<std::int32_t> cells;           /**< 2 or 3 points each */
    std::vector<VtuField> point_data = {};
    std::vector<VtuField> cell_data  = {};

    std::size_t n_cells() const
    {
      return cells.size() / (cell_type == VtuCellType::line ? 2 : 3);
    }
  };

  /**
   * Writes a grid as VTK XML with appended raw data (little endian, 64-bit
   * block sizes, double precision); the time goes into the field data
   * TimeValue. The file appears complete or not at all.
   *
   * @throws RunError if the file cannot be written (full disk)
   */
  void write_vtu(const std::string &path, VtuGrid grid);
} // namespace quoin

#endif
