// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_wall_names_h
#define quoin_layout_wall_names_h

#include <quoin/layout/gmsh_geometry.h>
#include <quoin/layout/wall_layout.h>

#include <string>

namespace quoin
{
  /** The physical surface or volume of @p unit. */
  inline std::string surface_name(const WallUnit &unit)
  {
    switch (unit.kind)
    {
    case WallUnit::lintel:
      return with_name("lintel", unit.part);
    case WallUnit::slab:
      return with_name("slab", unit.part);
    case WallUnit::bottom_platen:
      return "bottom_platen";
    case WallUnit::top_platen:
      return "top_platen";
    case WallUnit::unit:
      break;
    }
    return with_name("unit", unit.part);
  }

  inline bool is_platen(const WallUnit &unit)
  {
    return unit.kind == WallUnit::bottom_platen
           || unit.kind == WallUnit::top_platen;
  }

  /** Joint between a unit and the one above or beside it; @p kind: that of
      two units of the bond, which has the name of the @p second one, and of
      lintels of a storey without a name. Empty between the courses of a
      lintel. */
  inline std::string joint_name(const WallUnit &first, const WallUnit &second,
                                const std::string &kind)
  {
    if (is_platen(first) || is_platen(second))
      return "platen_joint";
    if (first.kind == WallUnit::slab || second.kind == WallUnit::slab)
      return "slab_joint";
    const bool second_is = second.kind == WallUnit::lintel;
    const bool first_is  = first.kind == WallUnit::lintel;
    if (first_is && second_is && first.left == second.left
        && first.right == second.right)
      return "";
    if ((first_is && !first.part.empty())
        || (second_is && !second.part.empty()))
      return "lintel_joint";
    return with_name(kind, second.part);
  }
} // namespace quoin

#endif
