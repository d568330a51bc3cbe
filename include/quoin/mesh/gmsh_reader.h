// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_gmsh_reader_h
#define quoin_mesh_gmsh_reader_h

#include <quoin/mesh/mesh_data.h>

#include <mpi.h>

#include <string>

namespace quoin
{
  /** What becomes of the cells of a mesh file. */
  enum class TriangleKind
  {
    plain,    /**< triangles, as they are */
    crossed,  /**< quadrangles, each cut by its diagonals */
    quadratic /**< triangles with nodes in the middle of their edges */
  };

  /**
   * Read a gmsh mesh (.msh 2.2 or 4.1, ascii or binary) or mesh a gmsh geometry
   * (.geo) in the x-y plane. Every triangle must belong to exactly one named
   * physical surface; line elements of named physical curves are kept, others
   * dropped. Nodes are kept as they are: coincident ones are not merged, so
   * blocks that are apart in the file stay apart.
   *
   * The user's own gmsh configuration is not read, so that a geometry gives
   * the same mesh everywhere.
   *
   * With TriangleKind::crossed a geometry is meshed with quadrangles, and a
   * mesh must have some; add_crossed_triangles() cuts them. Triangles that are
   * left among them, because gmsh found no partner, stay as they are.
   *
   * With TriangleKind::quadratic the triangles are those of
   * TriangleKind::plain; NodeMap gives them their midside nodes.
   *
   * Throws InputError with the file, the entity and the cure: no such file, an
   * error of gmsh, no triangles, quadrangles (unless they are to be crossed,
   * and then if there are none), curved elements, a surface in
   * no, several or unnamed physical groups, a curve in several, nodes off the
   * plane z = 0, triangles without area.
   */
  MeshData read_gmsh(const std::string &filename,
                     TriangleKind kind = TriangleKind::plain);

  /**
   * The same by the first rank; the others have an empty mesh. An InputError is
   * thrown on all of them. Collective.
   */
  MeshData read_gmsh(const std::string &filename, const MPI_Comm &communicator,
                     TriangleKind kind = TriangleKind::plain);

  /**
   * The same with the text @p geometry of a .geo file. @p maker: what made it,
   * for messages.
   */
  MeshData mesh_gmsh_geometry(const std::string &geometry,
                              const std::string &maker,
                              const MPI_Comm &communicator,
                              TriangleKind kind = TriangleKind::plain);

  /**
   * Mesh the geometry @p geo_file and write the mesh to @p msh_file (.msh), for
   * users to look at and change. Throws RunError if it cannot be written.
   */
  void write_gmsh_mesh(const std::string &geo_file, const std::string &msh_file,
                       TriangleKind kind = TriangleKind::plain);
} // namespace quoin

#endif
