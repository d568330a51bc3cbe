// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_region_shape_h
#define quoin_rock_region_shape_h

#include <quoin/base/parameter_entries.h>
#include <quoin/layout/polygon.h>

#include <cstddef>
#include <string>

namespace quoin
{
  /** Points of an entry "x, y; x, y; ..." [m]; fewer than @p at_least are
      refused. */
  Polygon read_points(const ParameterSection &section, const std::string &name,
                      std::size_t at_least);

  /** Refuses corners of no simple polygon. */
  void check_polygon(const ParameterSection &section, const std::string &name,
                     const Polygon &polygon);

  /** Enters the shape of a plane region, a polygon, circle or arch, and sets
      its corners, counter-clockwise [m]. */
  void enter_region_shape(ParameterEntries &entries, Polygon &polygon);
} // namespace quoin

#endif
