// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_wall_parameters_h
#define quoin_layout_wall_parameters_h

#include <quoin/base/parameter_section.h>

#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace quoin
{
  /** Masonry bond of a wall. */
  enum class WallBond
  {
    none,    /**< no wall is generated */
    running, /**< every other course is shifted by a share of a unit */
    stack,   /**< head joints above each other */
    header,  /**< half units (headers), shifted by half of one */
    english, /**< courses of stretchers and of headers in turn */
    flemish, /**< stretcher and header in turn in every course */
    random   /**< units of random lengths */
  };

  /** An opening of whole courses; the units around it are cut to fit. */
  struct WallOpening
  {
    double left;  /**< [m] */
    double right; /**< [m] */
    /** First course in the storey, from 1 at its bottom. */
    unsigned int first_course;
    unsigned int last_course;
  };

  /**
   * Courses and the floor above them: a subsection of 'Wall storeys', or, with
   * an empty name, what section 'Wall' itself gives.
   */
  struct WallStorey
  {
    std::string name;
    unsigned int n_courses = 0;
    std::vector<WallOpening> openings;
    double slab = 0.; /**< thickness of the slab above; 0: none [m] */
    /** Names of courses, counted from 1. */
    std::map<unsigned int, std::string> named_courses;
    /** Courses of headers in another bond, counted from 1. */
    std::set<unsigned int> header_courses = {};

    /** Name of course @p number, which is that of the storey if it has none. */
    const std::string &course_name(const unsigned int number) const
    {
      const auto found = named_courses.find(number);
      return found == named_courses.end() ? name : found->second;
    }

    static void declare(dealii::ParameterHandler &prm);
  };

  /**
   * A straight part of a wall in three dimensions: a subsection of 'Wall
   * segments', or, with an empty name, the whole wall of section 'Wall'.
   * Segments that cross or end in each other share a square of the plan.
   */
  struct WallSegment
  {
    std::string name;
    dealii::Point<2> start;  /**< corner of least x and y in plan [m] */
    unsigned int along = 0;  /**< axis of its length: 0: x, 1: y */
    double length      = 0.; /**< [m] */
    /** Openings by storey, with courses counted in the storey. */
    std::vector<std::vector<WallOpening>> openings;

    static void declare(dealii::ParameterHandler &prm);
    /** Corners of least and of largest x and y in plan [m]. */
    std::array<dealii::Point<2>, 2> corners(double thickness) const;
  };

  /** The sections 'Wall', 'Wall storeys' and 'Wall segments'. */
  struct WallParameters
  {
    WallBond bond = WallBond::none;
    double length = 0.; /**< of all segments together [m] */
    /** Storeys from bottom to top, at least one. */
    std::vector<WallStorey> storeys;

    /** A unit with half a joint on each side: the joints have no thickness. */
    double unit_length = 0.; /**< [m] */
    double unit_height = 0.; /**< [m] */

    /** Shift of every other course of a running bond, of unit_length [-]. */
    double offset = 0.5;
    /** Whether the first course is one of those that begin with a cut unit. */
    bool begins_shifted = false;
    /** Shorter pieces join their neighbour; a share of unit_length [-]. */
    double shortest = 0.2;

    double random_shortest    = 0.; /**< [m] */
    double random_longest     = 0.; /**< [m] */
    double random_overlap     = 0.; /**< least, of joints of two courses [m] */
    std::uint64_t random_seed = 1;

    /** Bearing on each side of an opening; 0: none [m]. */
    double lintel_bearing       = 0.;
    unsigned int lintel_courses = 1; /**< depth of a lintel */

    double bottom_platen = 0.; /**< height [m]; 0: none */
    double top_platen    = 0.; /**< height [m]; 0: none */

    bool cracks = false; /**< potential cracks at mid-length of the units */

    double element_size = 0.; /**< longest edge, about [m] */
    bool structured     = true;

    /** Straight parts in plan; none: the wall is plane. */
    std::vector<WallSegment> segments;
    double thickness      = 0.; /**< in three dimensions [m] */
    unsigned int n_wythes = 1;
    double wythe_offset   = 0.; /**< of every other wythe, of unit_length [-] */

    static void declare(dealii::ParameterHandler &prm);
    /** Wall of the parameter file; storeys are read only if there is a wall,
        segments only if 'Mesh/Dimension' is 3. */
    static WallParameters read(const ParameterSection &top);

    double height() const; /**< height with slabs and platens [m] */
  };
} // namespace quoin

#endif
