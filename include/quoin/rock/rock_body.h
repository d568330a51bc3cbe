// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_rock_body_h
#define quoin_rock_rock_body_h

#include <quoin/base/parameter_section.h>
#include <quoin/layout/polygon.h>
#include <quoin/rock/block_cutter.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * A prism in a box of rock, such as a tunnel with its rounds or the air above
   * a slope: a subsection of 'Rock bodies'. Its section lies in the plane
   * across the axis from #start to #end; x of the section is horizontal and to
   * the right for who looks along the axis, and y is upwards across it. Of a
   * vertical axis x is east, and y is north.
   */
  struct RockBody
  {
    std::string name;
    Polygon section; /**< counter-clockwise; may be concave [m] */
    dealii::Point<3> start, end;
    std::vector<double> rounds; /**< lengths along the axis from #start [m] */
    bool is_hole     = false;
    bool is_outlined = true; /**< its surface is a joint */
    bool has_joints  = true; /**< joints pass through it */
    double size      = 0.;   /**< of elements at its surface [m]; 0: no other */

    static void declare(dealii::ParameterHandler &prm);
    static RockBody read(const ParameterSection &section,
                         const std::string &name);

    /** Physical volume of round @p i, the last of which takes what is left. */
    std::string group(unsigned int i) const;
    /** Number of parts along the axis, each a group of its own. */
    unsigned int n_parts() const;
    double length() const; /**< [m] */
    /** A corner of the section in space, at @p along from #start [m]. */
    dealii::Point<3> place(const dealii::Point<2> &corner, double along) const;
  };

  /** The polygon as convex ones that do not overlap: itself, or triangles. */
  std::vector<Polygon> convex_parts(const Polygon &polygon);
} // namespace quoin

#endif
