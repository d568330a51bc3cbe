// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_gmsh_geometry_h
#define quoin_layout_gmsh_geometry_h

#include <map>
#include <string>
#include <vector>

namespace quoin
{
  /** A gmsh geometry of blocks and which of its physical curves are joints. */
  struct GmshGeometry
  {
    std::string text; /**< text of a .geo file */
    std::vector<std::string> joint_curves;
  };

  /** Numbers of curves or surfaces; of loops with the sign of direction. */
  using GmshNumbers = std::vector<int>;

  /** {1, 2, 3}, in lines of at most 80 characters. */
  std::string braces(const GmshNumbers &numbers);

  /** @p kind or kind_NAME. */
  inline std::string with_name(const std::string &kind, const std::string &name)
  {
    return name.empty() ? kind : kind + "_" + name;
  }

  /** The lines that name the physical surfaces and curves. */
  std::string physical_names(const std::map<std::string, GmshNumbers> &surfaces,
                             const std::map<std::string, GmshNumbers> &curves);
} // namespace quoin

#endif
