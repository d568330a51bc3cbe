// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_gmsh_text_h
#define quoin_mesh_gmsh_text_h

#include <quoin/mesh/gmsh_reader.h>

#include <string>

namespace quoin
{
  /**
   * read_any_gmsh() with the text @p geometry of a .geo file. @p maker: what
   * made it, for messages.
   */
  AnyMeshData mesh_any_gmsh_geometry(const std::string &geometry,
                                     const std::string &maker,
                                     const MPI_Comm &communicator,
                                     MeshDimension dimension,
                                     const CellOptions &cells = {});
} // namespace quoin

#endif
