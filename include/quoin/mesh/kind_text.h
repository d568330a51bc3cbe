// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_kind_text_h
#define quoin_mesh_kind_text_h

namespace quoin
{
  /** Name in gmsh of a group of cells, for messages. */
  template <int dim>
  inline constexpr const char *group_kind
      = dim == 2 ? "physical surface" : "physical volume";

  /** Name in gmsh of a named part of the boundary, for messages. */
  template <int dim>
  inline constexpr const char *boundary_kind
      = dim == 2 ? "physical curve" : "physical surface";
} // namespace quoin

#endif
