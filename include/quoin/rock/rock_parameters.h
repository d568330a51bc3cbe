// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_rock_parameters_h
#define quoin_rock_rock_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/rock/distribution.h>
#include <quoin/layout/polygon.h>

#include <cstdint>
#include <string>
#include <vector>

namespace quoin
{
  /** A part of the rock: a subsection of 'Rock regions'. */
  struct RockRegion
  {
    enum Use
    {
      body, /**< a physical surface of its own */
      hole, /**< nothing is there */
      zone  /**< limits joints, and has no other effect */
    };
    std::string name;
    Polygon polygon; /**< counter-clockwise */
    Use use           = body;
    bool is_outlined  = true; /**< whether the outline is a joint */
    bool has_joints   = true; /**< joints go through it */
    bool refines_mesh = false;

    static void declare(dealii::ParameterHandler &prm);
    static RockRegion read(const ParameterSection &section,
                           const std::string &name);
  };

  /** Joints of one kind: a subsection of 'Rock joints'. */
  struct RockJoints
  {
    enum Kind
    {
      set,      /**< parallel lines of traces and gaps */
      polyline, /**< through given points */
      traces,   /**< traces of a file */
      voronoi   /**< borders of Voronoi polygons */
    };
    std::string name;
    Kind kind = set;

    /** Statistics of a set; dips are anticlockwise from the x axis [deg]. */
    Distribution dip, spacing, length, gap;
    bool is_persistent = false; /**< traces without end */
    dealii::Point<2> origin;    /**< point on the first line of the set [m] */

    std::vector<dealii::Point<2>> points; /**< points of a polyline [m] */
    std::string file;                     /**< file of traces */
    double block_size       = 0.;         /**< size of Voronoi polygons [m] */
    unsigned int relaxation = 0;          /**< steps towards regular ones */

    std::string region; /**< region of the joints; empty: everywhere */

    static void declare(dealii::ParameterHandler &prm);
    static RockJoints read(const ParameterSection &section,
                           const std::string &name);
  };

  /** The sections 'Rock', 'Rock regions' and 'Rock joints'. */
  struct RockParameters
  {
    /** Treatment of joints that end inside a block. */
    enum DeadEnds
    {
      cut,    /**< back to the last joint that they met */
      extend, /**< straight on to the next joint */
      keep    /**< they are cracks */
    };

    Polygon outline; /**< counter-clockwise; empty: no rock is generated */
    std::vector<std::string> sides; /**< name of the side after each corner */
    std::string group  = "rock";    /**< physical surface */
    std::uint64_t seed = 1;
    std::vector<RockRegion> regions; /**< the later prevails */
    std::vector<RockJoints> joints;  /**< the earlier names a common edge */

    DeadEnds dead_ends     = cut;
    double shortest_edge   = 0.; /**< [m] */
    double smallest_block  = 0.; /**< [m^2] */
    double narrowest_block = 0.; /**< twice area by perimeter [m] */

    double element_size = 0.; /**< [m] */
    /** Element size at regions that refine the mesh [m]. */
    double finest_size = 0.;
    /** Growth of the element size per distance from them [-]. */
    double size_growth = 0.;

    /** The section 'Rock' alone. */
    static void declare(dealii::ParameterHandler &prm);
    /** Without regions and joints if there is no outline. */
    static RockParameters read(const ParameterSection &top);
  };
} // namespace quoin

#endif
