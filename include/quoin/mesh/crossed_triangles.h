// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_crossed_triangles_h
#define quoin_mesh_crossed_triangles_h

#include <quoin/mesh/mesh_data.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Quadrangles of a mesh, before they are triangles. */
  struct Quadrangles
  {
    /** Vertices around each quadrangle. */
    std::vector<std::array<unsigned int, 4>> nodes;
    std::vector<unsigned int> group; /**< indices into group_names */
  };

  /**
   * Appends to @p mesh the four triangles into which the diagonals cut each
   * quadrangle, with a vertex where they meet. Of the four conditions of
   * constant area one follows from the others in such a quadrangle, so that
   * constant-strain triangles pass flow without change of volume instead of
   * locking (@cite NagtegaalParksRice1974). A quadrangle that is not convex
   * becomes the two triangles of its inner diagonal.
   */
  void add_crossed_triangles(const Quadrangles &quadrangles, MeshData<2> &mesh);
} // namespace quoin

#endif
