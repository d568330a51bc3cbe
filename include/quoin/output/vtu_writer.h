// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_vtu_writer_h
#define quoin_output_vtu_writer_h

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace quoin
{
  /** The cell types that are used, with VTK's numbers. */
  enum class VtuCellType : std::uint8_t
  {
    line        = 3,
    triangle    = 5,
    tetrahedron = 10
  };

  /**
   * A named array of a grid, @p n_components values for each point or cell, one
   * after the other. Two components are a vector in the plane and are written
   * with a third one, z = 0, as viewers require.
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

  /** Number of points of a cell. */
  constexpr unsigned int n_points(const VtuCellType type)
  {
    return type == VtuCellType::line       ? 2
           : type == VtuCellType::triangle ? 3
                                           : 4;
  }

  /** An unstructured grid in the plane or in space. */
  struct VtuGrid
  {
    double time = 0.; /**< [s] */
    VtuCellType cell_type;
    /** Coordinates, one point after the other [m]; z = 0 is added in the
        plane. */
    std::vector<double> points;
    std::vector<std::int32_t> cells; /**< n_points() each */
    std::vector<VtuField> point_data = {};
    std::vector<VtuField> cell_data  = {};
    unsigned int dimension           = 2; /**< coordinates of a point */

    std::size_t n_cells() const
    {
      return cells.size() / n_points(cell_type);
    }
  };

  /** Adds z = 0 to points and vectors of a grid in the plane. Throws a
      std::logic_error if a field does not fit. */
  void complete(VtuGrid &grid);

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
