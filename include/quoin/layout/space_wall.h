// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_space_wall_h
#define quoin_layout_space_wall_h

#include <quoin/layout/box_grid.h>
#include <quoin/layout/gmsh_geometry.h>
#include <quoin/layout/wall_layout.h>

#include <string>
#include <vector>

namespace quoin
{
  /** A box of a wall in three dimensions: a unit of one wythe, a header, one
      course of a lintel, or what a slab or platen has in a segment. */
  struct WallBox
  {
    WallUnit unit; /**< left and right along the segment */
    BoxGrid::Box box;
    unsigned int segment;
    /** Boxes of one slab or platen have the same number. */
    unsigned int body;
    /** Axis of the normal of the potential crack through the middle; 3: none.
     */
    unsigned int crack = 3;
  };

  /** Positions of all units of a wall in three dimensions: x and y in plan, z
      up; the lowest course stands on z = 0. */
  struct SpaceWall
  {
    std::vector<WallBox> boxes;
    WallLayout counts; /**< storeys, lintels and joined pieces, no units */
  };

  /**
   * Lays the units of all segments and wythes by lay_wall(). Where segments
   * share a square of the plan, those along x have it in every other course,
   * those along y in the others. These are shifted ones or not, by which the
   * head joints of one course are farther from the ends that segments have in
   * the next one. Throws InputError as lay_wall().
   */
  SpaceWall lay_space_wall(const WallParameters &wall);

  /** Line with the numbers of units, headers, lintels, slabs and cracks, and a
      line for each storey with a name. */
  std::string space_wall_report(const WallParameters &wall,
                                const SpaceWall &layout);

  /**
   * The wall as a gmsh mesh (.msh) of tetrahedra, with the physical volumes and
   * surfaces that wall_geometry() names in the plane, and `collar` between
   * wythes. Outside there are `front` and `back`, the sides of least and
   * largest y of segments along x and of least and largest x of those along y,
   * and `left` and `right`, their ends; those of a segment NAME have the name
   * `front_NAME` and so on. Where segments meet sides go before ends.
   *
   * Throws InputError if elements would be narrower than a fifth of the element
   * size.
   */
  GmshGeometry space_wall_mesh(const WallParameters &wall,
                               const SpaceWall &layout);
} // namespace quoin

#endif
