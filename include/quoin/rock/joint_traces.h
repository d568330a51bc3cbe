// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_joint_traces_h
#define quoin_rock_joint_traces_h

#include <quoin/rock/rock_parameters.h>

namespace quoin
{
  /** Random values of a joint set before joints are cut. */
  struct DrawnValues
  {
    std::vector<double> dip;     /**< [deg] */
    std::vector<double> spacing; /**< [m] */
    std::vector<double> length;  /**< [m] */
    std::vector<double> gap;     /**< [m] */
    unsigned int n_redrawn = 0;  /**< because they were not positive */
  };

  /** The joints of one kind, as straight pieces inside the outline. */
  struct JointTraces
  {
    std::vector<Piece> pieces;
    std::vector<unsigned int> trace; /**< number of the trace of each piece */
    unsigned int n_traces = 0;
    DrawnValues drawn;          /**< drawn values of a set */
    unsigned int n_clipped = 0; /**< traces that end at the outline */
  };

  /**
   * Joints number @p number of @p rock, cut at the outline and at the region
   * that they are limited to.
   *
   * Line 0 of a set goes through the origin, lines 1, 2, ... are above it (in
   * the direction of the dip turned anticlockwise by 90 degrees), lines -1, -2,
   * ... below. On each, traces and gaps follow each other from a random place
   * on; a trace has its own dip and is turned about its middle. Spacings are
   * measured across the mean dip.
   *
   * Throws InputError: a file of traces that cannot be read, or far too many
   * traces.
   */
  JointTraces make_joint_traces(const RockParameters &rock,
                                unsigned int number);

  /**
   * Borders of Voronoi polygons over the box @p box (xmin, ymin, xmax, ymax)
   * and somewhat beyond: sites are placed at random, one for each square of
   * side @p block_size, and moved to the middle of their polygons
   * @p relaxation times.
   */
  std::vector<Piece> voronoi_borders(const std::array<double, 4> &box,
                                     double block_size, unsigned int relaxation,
                                     RandomStream random);
} // namespace quoin

#endif
