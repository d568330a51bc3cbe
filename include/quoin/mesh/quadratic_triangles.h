// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_quadratic_triangles_h
#define quoin_mesh_quadratic_triangles_h

#include <quoin/mesh/mesh_data.h>

namespace quoin
{
  /**
   * Makes six-node triangles of the triangles of @p mesh: each edge gets a
   * vertex in its middle, which the triangles on both sides share, and each
   * triangle (v0, v1, v2) becomes the four
   *
   *   (v0, m01, m20), (v1, m12, m01), (v2, m20, m12), (m01, m12, m20),
   *
   * consecutive and in this order, so that the six nodes of triangle i are
   * found in 4 i to 4 i + 3. Edges are straight. Lines of named curves are cut
   * in two; one that is no edge of a triangle stays as it is. The triangles
   * must be oriented.
   */
  void cut_into_quadratic_triangles(MeshData &mesh);
} // namespace quoin

#endif
