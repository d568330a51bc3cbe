// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_box_grid_h
#define quoin_layout_box_grid_h

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Boxes on a grid whose planes are all of their faces and cuts. Every cell of
   * the grid is divided into bricks no longer than the element size, and each
   * brick into five tetrahedra, alternately, so that triangles match on all
   * faces of boxes, wherever these lie to each other.
   */
  class BoxGrid
  {
  public:
    using Cell = std::array<unsigned int, 3>; /**< its number in x, y and z */

    struct Box
    {
      dealii::Point<3> low, high; /**< [m] */
    };

    /** Face of the grid between a cell and the next one in a direction. */
    struct Face
    {
      unsigned int axis; /**< of its normal */
      Cell place;        /**< the upper cell; may lie beyond the grid */
      int below, above;  /**< boxes on both sides, -1: none */
    };

    /**
     * @p boxes, of which only those that are named alike may overlap, and
     * @p cuts through them: further planes by axis [m]. Planes closer than
     * @p exact are one [m].
     */
    BoxGrid(const std::vector<Box> &boxes,
            const std::array<std::vector<double>, 3> &cuts, double exact);

    /** Positions of the planes normal to @p axis, ascending [m]. */
    const std::vector<double> &planes(const unsigned int axis) const
    {
      return planes_of[axis];
    }

    /**
     * The tetrahedra as the text of a gmsh mesh (.msh 2.2), with physical
     * volumes as @p box_name says by box, and physical surfaces as @p face_name
     * says; empty: none.
     */
    std::string
    mesh(double element_size,
         const std::function<std::string(unsigned int)> &box_name,
         const std::function<std::string(const Face &)> &face_name) const;

  private:
    /** Number of the plane at @p x. */
    unsigned int plane(unsigned int axis, double x) const;
    /** The box that has @p cell, -1 for none or outside. */
    int box_at(const Cell &cell) const;

    std::array<std::vector<double>, 3> planes_of;
    std::vector<int> box_of; /**< by cell, x first */
    double exact;
  };
} // namespace quoin

#endif
