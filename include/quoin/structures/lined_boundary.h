// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_lined_boundary_h
#define quoin_structures_lined_boundary_h

#include <quoin/base/thickness.h>
#include <quoin/mesh/node_map.h>
#include <quoin/structures/beam_parameters.h>

#include <vector>

namespace quoin
{
  /** A node of blocks at a node of a liner. */
  struct InterfacePoint
  {
    unsigned int node;  /**< local and owned, or NodeMap::none */
    unsigned int block; /**< in the whole mesh */
    unsigned int at;    /**< node of the liner, its first one is 0 */
    double side;        /**< 1: the block is on the left of the liner */
    double area;        /**< [m^2] */
  };

  /** Nodes of a liner along its curve: anticlockwise if it is closed, or else
      from the left, from the lower end if both are one above the other. */
  struct LinedBoundary
  {
    std::vector<dealii::Point<2>> places;
    bool is_closed   = false;
    double thickness = 1.; /**< of its blocks out of the plane [m] */
    /** In the order of the nodes and of the blocks there. */
    std::vector<InterfacePoint> points;
  };

  /** The boundary that @p liner lines; @p thickness of each cell group [m].
      Throws an InputError if there is none, if it is not one line, or if it is
      that of a rigid block or of blocks that differ in thickness. Collective.
   */
  LinedBoundary lined_boundary(const BeamParameters &liner,
                               const NodeMap<2> &nodes,
                               const Thickness &thickness);
} // namespace quoin

#endif
