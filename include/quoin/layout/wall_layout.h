// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_wall_layout_h
#define quoin_layout_wall_layout_h

#include <quoin/layout/gmsh_geometry.h>
#include <quoin/layout/wall_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /** A rectangle of one row: a unit, a lintel or a platen. */
  struct WallUnit
  {
    enum Kind
    {
      unit,
      lintel,
      bottom_platen,
      top_platen
    };
    Kind kind;
    unsigned int row;
    double left;  /**< [m] */
    double right; /**< [m] */
    bool cracks;  /**< has a potential crack at mid-length */

    double middle() const
    {
      return 0.5 * (left + right);
    }
  };

  /** Where every unit of a wall is. */
  struct WallLayout
  {
    /** y of the bed planes [m]; row i lies between i and i + 1. The lowest
     * course stands on y = 0. */
    std::vector<double> levels;
    /** Units by row, from left to right. */
    std::vector<WallUnit> units;
    double length = 0.; /**< [m] */
    /** Number of units that became longer because a cut piece was too short. */
    unsigned int n_joined = 0;
  };

  /**
   * Lays the units of a wall. In every course the bond gives head joints;
   * openings and lintels interrupt it, and joints that would leave a piece
   * shorter than WallParameters::shortest at an end are left out.
   *
   * Throws InputError: a random bond that finds no place for a joint, a lintel
   * that does not fit.
   */
  WallLayout lay_wall(const WallParameters &wall);

  /** How many units, lintels and cracks there are, in a line. */
  std::string wall_report(const WallLayout &layout);

  /**
   * The layout as a gmsh geometry that makes the mesh of the wall: physical
   * surfaces `unit`, `lintel`, `bottom_platen`, `top_platen`; physical curves
   * `bed` and `head` (joints between units), `platen_joint`, `crack`; and, on
   * the outside, `base`, `top`, `left`, `right`, `opening`. Names that a wall
   * has no use for are left out.
   *
   * Throws InputError if a structured mesh would need columns narrower than a
   * fifth of the element size.
   */
  GmshGeometry wall_geometry(const WallParameters &wall,
                             const WallLayout &layout);
} // namespace quoin

#endif
