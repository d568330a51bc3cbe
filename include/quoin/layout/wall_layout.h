// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_wall_layout_h
#define quoin_layout_wall_layout_h

#include <quoin/layout/gmsh_geometry.h>
#include <quoin/layout/wall_parameters.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** A rectangle of one row: a unit, one course of a lintel, a slab or a
      platen. */
  struct WallUnit
  {
    enum Kind
    {
      unit,
      lintel,
      slab,
      bottom_platen,
      top_platen
    };
    Kind kind;
    unsigned int row;
    double left;  /**< [m] */
    double right; /**< [m] */
    bool cracks;  /**< whether the unit has a potential crack at mid-length */
    /** Name of the course of a unit, or of the storey of a lintel or slab; may
     * be empty. */
    std::string part;
    /** Whether the unit is a header, as long as the wall is thick. */
    bool through = false;

    double middle() const
    {
      return 0.5 * (left + right);
    }
  };

  /** Positions of all units of a wall. */
  struct WallLayout
  {
    /** y of the bed planes [m]; row i lies between i and i + 1. The lowest
     * course stands on y = 0. */
    std::vector<double> levels;
    /** Units by row, from left to right. */
    std::vector<WallUnit> units;
    double length          = 0.; /**< [m] */
    unsigned int n_lintels = 0;
    std::vector<std::string> storeys; /**< a line on each that has a name */
    /** Number of units that became longer because a cut piece was too short. */
    unsigned int n_joined = 0;
  };

  /** What another wall and another wythe change in the bond of one wythe. */
  struct WallRun
  {
    /** Left and right ends of the squares that the wall shares with others
        [m], which have them in every other course. */
    std::vector<std::array<double, 2>> junctions;
    bool yields_shifted = true; /**< whether these are its shifted courses */
    double shift = 0.; /**< of running and stack bond, of unit_length [-] */
  };

  /**
   * Lays the units of a wall. In every course the bond gives head joints; it
   * begins anew on each slab, and goes on through storeys without one. Openings
   * and lintels interrupt it, and joints that would leave a piece shorter than
   * WallParameters::shortest at an end are left out.
   *
   * Throws InputError: a random bond that finds no place for a joint, a lintel
   * that does not fit or reaches into another wall.
   */
  WallLayout lay_wall(const WallParameters &wall, const WallRun &run = {});

  /** Line with the numbers of units, lintels, slabs and cracks, and a line for
      each storey with a name. */
  std::string wall_report(const WallLayout &layout);

  /**
   * The layout as a gmsh geometry that makes the mesh of the wall: physical
   * surfaces `unit`, `lintel`, `slab`, `bottom_platen`, `top_platen`; physical
   * curves `bed` (below a course) and `head`, `crack`, `slab_joint` and
   * `platen_joint`; and, on the outside, `base`, `top`, `left`, `right`,
   * `opening`. A course or storey NAME has `unit_NAME`, `bed_NAME`, `head_NAME`
   * and `crack_NAME`, a storey also `lintel_NAME`, `slab_NAME` with the ends
   * `slab_NAME_left` and `slab_NAME_right`, and joints of lintels
   * `lintel_joint`. Names that a wall has no use for are left out.
   *
   * Throws InputError if a structured mesh would need columns narrower than a
   * fifth of the element size.
   */
  GmshGeometry wall_geometry(const WallParameters &wall,
                             const WallLayout &layout);
} // namespace quoin

#endif
