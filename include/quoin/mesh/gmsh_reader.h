// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_gmsh_reader_h
#define quoin_mesh_gmsh_reader_h

#include <quoin/mesh/mesh_data.h>

#include <mpi.h>

#include <string>
#include <variant>

namespace quoin
{
  /** The triangles of a plane mesh. */
  enum class TriangleKind
  {
    plain,    /**< triangles, as they are */
    crossed,  /**< quadrangles, each cut by its diagonals */
    quadratic /**< triangles with nodes in the middle of their edges */
  };

  /** Treatment of the cells of a mesh file. */
  struct CellOptions
  {
    /** Implicit conversion from a kind of triangles is intended. */
    CellOptions(const TriangleKind kind        = TriangleKind::plain,
                const unsigned int refinements = 0)
      : kind(kind), refinements(refinements)
    {
    }

    TriangleKind kind;
    /** Number of times that edges are halved, before quadrangles or
        tetrahedra are cut. */
    unsigned int refinements;
    /** Whether tetrahedra are cut by make_mixed(). */
    bool mixed_tetrahedra = false;
  };

  /** The dimension that a mesh is to have. */
  enum class MeshDimension
  {
    from_mesh = 0, /**< three if it has tetrahedra, two if not */
    two       = 2,
    three     = 3
  };

  /** A mesh whose dimension the file says. */
  using AnyMeshData = std::variant<MeshData<2>, MeshData<3>>;

  /**
   * Read a gmsh mesh (.msh 2.2 or 4.1, ascii or binary) or mesh a gmsh geometry
   * (.geo): triangles in the x-y plane or tetrahedra. Every cell must belong to
   * exactly one named physical surface or volume; elements of named physical
   * curves or, in three dimensions, surfaces are kept as named faces, others
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
   * A refinement halves all edges: triangles and quadrangles become four,
   * tetrahedra eight. New nodes on a curve of a geometry lie on the curve,
   * those of a mesh without geometry in the middle of the edge.
   *
   * Throws InputError with the file, the entity and the cure: no such file, an
   * error of gmsh, no cells of dimension @p dim, quadrangles (unless they are
   * to be crossed, and then if there are none), hexahedra, prisms and pyramids,
   * curved elements, a surface (volume) in no, several or unnamed physical
   * groups, a curve (surface) in several, nodes of a plane mesh off the plane
   * z = 0, cells without volume, another kind than plain in three
   * dimensions, mixed tetrahedra in two.
   */
  template <int dim = 2>
  MeshData<dim> read_gmsh(const std::string &filename,
                          const CellOptions &cells = {});

  /**
   * Reads @p filename on the first rank, as the function above; the others have
   * an empty mesh. An InputError is thrown on all of them. Collective.
   */
  template <int dim = 2>
  MeshData<dim> read_gmsh(const std::string &filename,
                          const MPI_Comm &communicator,
                          const CellOptions &cells = {});

  /**
   * Reads a mesh of @p dimension, as read_gmsh(); all ranks know whether it has
   * two or three dimensions afterwards. A
   * .msh file has three if it has tetrahedra, a .geo file if it has volumes.
   * Collective.
   */
  AnyMeshData read_any_gmsh(const std::string &filename,
                            const MPI_Comm &communicator,
                            MeshDimension dimension  = MeshDimension::from_mesh,
                            const CellOptions &cells = {});

  /**
   * read_any_gmsh() with the text @p geometry of a .geo file. @p maker: what
   * made it, for messages.
   */
  AnyMeshData mesh_any_gmsh_geometry(const std::string &geometry,
                                     const std::string &maker,
                                     const MPI_Comm &communicator,
                                     MeshDimension dimension,
                                     const CellOptions &cells = {});

  /**
   * read_gmsh() with the text @p geometry of a .geo file. @p maker: what made
   * it, for messages.
   */
  MeshData<2> mesh_gmsh_geometry(const std::string &geometry,
                                 const std::string &maker,
                                 const MPI_Comm &communicator,
                                 const CellOptions &cells = {});

  /**
   * Mesh the geometry @p geo_file and write the mesh to @p msh_file (.msh), for
   * users to look at and change. Throws RunError if it cannot be written.
   */
  void write_gmsh_mesh(const std::string &geo_file, const std::string &msh_file,
                       const CellOptions &cells = {});
} // namespace quoin

#endif
