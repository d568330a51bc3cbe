// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_rock_layout_h
#define quoin_rock_rock_layout_h

#include <quoin/rock/block_faces.h>
#include <quoin/layout/gmsh_geometry.h>
#include <quoin/rock/joint_traces.h>

#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /** All that was changed on the way from traces to blocks. */
  struct RockChanges
  {
    unsigned int n_joined = 0; /**< ends moved by less than 'Shortest edge' */
    unsigned int n_dead_ends = 0;  /**< edges cut off */
    double dead_length       = 0.; /**< [m] */
    unsigned int n_extended  = 0;  /**< joints lengthened */
    double extended_length   = 0.; /**< [m] */
    unsigned int n_cracks    = 0;  /**< edges kept as cracks */
    double crack_length      = 0.; /**< [m] */
    unsigned int n_bridges   = 0;  /**< edges with one block on both sides */
    double bridge_length     = 0.; /**< [m] */
    /** Pieces of joints below 'Shortest edge', left out. */
    unsigned int n_short   = 0;
    double short_length    = 0.; /**< [m] */
    unsigned int n_slivers = 0;  /**< blocks joined to a neighbour */
    double sliver_area     = 0.; /**< [m^2] */
    /** Number of slivers without a neighbour to merge with. */
    unsigned int n_kept_slivers = 0;
  };

  /** Blocks of rock, before they are meshed. */
  struct RockLayout
  {
    /**
     * Numbers of lines in the network: 0: outline, 1 + r: region r, then
     * joints.
     */
    std::vector<std::string> line_names;
    unsigned int first_joint_line = 1;
    std::unique_ptr<JointNetwork> network; /**< without cracks */
    std::unique_ptr<BlockFaces> faces;
    /** Material of each face: 0: rock, 1 + r: region r; none: a hole. */
    std::vector<unsigned int> group;
    /** Region that prevails in each face, or none: plain rock. */
    std::vector<unsigned int> region;
    std::vector<JointNetwork::Edge> cracks; /**< inside of blocks */

    /** Traces of each kind of joints, as generated. */
    std::vector<JointTraces> traces;
    RockChanges changes;

    unsigned int n_blocks() const;
    double block_area() const; /**< area of all blocks [m^2] */
  };

  /**
   * Makes the joints, cuts them at each other and at the borders, treats dead
   * ends and slivers as RockParameters says.
   *
   * 1. Borders and joints form a network, see JointNetwork.
   * 2. What is outside, in holes and in regions without joints is dropped.
   * 3. Dead ends are cut, lengthened or set aside as cracks. Bridges, such as
   *    the only joint between a tunnel and the outline, are cracks in any case.
   * 4. Blocks that are smaller or narrower than they may be are joined to the
   *    neighbour with which they share the longest joint, the smallest first,
   *    until there are none or none that has such a neighbour.
   *
   * Throws InputError: borders that cross, files that cannot be read.
   */
  RockLayout lay_rock(const RockParameters &rock);

  /** Lines on the generated joints and blocks and on what was changed. */
  std::string rock_report(const RockParameters &rock, const RockLayout &layout);

  /**
   * A table (CSV) of what was asked, drawn and made, of each joint set: dip
   * [deg], spacing [m], trace length [m], gap [m] and length per area [1/m];
   * and of the areas of the blocks [m^2]. Spacings as made are those between
   * neighbours along 200 lines across the mean dip.
   */
  std::string rock_statistics(const RockParameters &rock,
                              const RockLayout &layout);

  /** The layout as a gmsh geometry that makes the mesh of the rock. */
  GmshGeometry rock_geometry(const RockParameters &rock,
                             const RockLayout &layout);
} // namespace quoin

#endif
