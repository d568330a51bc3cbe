// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_mixed_tetrahedra_h
#define quoin_mesh_mixed_tetrahedra_h

#include <quoin/mesh/mesh_data.h>

namespace quoin
{
  /** Cells that a mixed tetrahedron is cut into. */
  constexpr unsigned int parts_of_mixed = 8;

  /**
   * Cuts each tetrahedron of @p mesh into the eight between its corners and
   * the middles of its edges, four at its corners and four around the shortest
   * diagonal of the octahedron that these leave, all of the same volume; and
   * each face with a name into four triangles. The parts of a tetrahedron
   * follow one another, with its group, and MeshData::mixed is set: they share
   * their change of volume. Cells must have positive volume.
   */
  void make_mixed(MeshData<3> &mesh);
} // namespace quoin

#endif
