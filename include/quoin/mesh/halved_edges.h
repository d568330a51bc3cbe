// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_halved_edges_h
#define quoin_mesh_halved_edges_h

#include <quoin/mesh/crossed_triangles.h>
#include <quoin/mesh/mesh_data.h>

namespace quoin
{
  /**
   * Halves all edges of a plane mesh: a triangle becomes four, a quadrangle
   * four with its middle, a line two. New nodes are in the middle of straight
   * edges; those on curved boundaries only gmsh can place.
   */
  void halve_edges(MeshData<2> &mesh, Quadrangles &quadrangles);
} // namespace quoin

#endif
