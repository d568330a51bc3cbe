// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_block_surfaces_h
#define quoin_layout_block_surfaces_h

#include <quoin/layout/gmsh_geometry.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace quoin
{
  /** Polyhedral blocks as other programs write them: each a closed surface of
      its own. */
  struct BlockSurfaces
  {
    /** Vertices in order around it; with a hole, several such loops. */
    using Loop = std::vector<unsigned int>;
    struct Face
    {
      std::vector<Loop> loops; /**< the first one is the outer one */
    };
    struct Block
    {
      std::string group; /**< physical volume */
      std::vector<Face> faces;
      double volume = 0.; /**< [m^3] */
    };

    std::vector<dealii::Point<3>> points; /**< [m] */
    std::vector<Block> blocks;
    unsigned int n_ignored = 0; /**< lines of kinds that are not read */
  };

  /** Whether @p file ends in .obj, .stl or .3dgrid. */
  bool is_surface_file(const std::string &file);

  /**
   * Reads the blocks of @p file:
   *
   * - Wavefront OBJ (.obj): v, f, o, g and usemtl. Materials are groups.
   * - STL (.stl), text or binary; all blocks are of the group 'block'.
   * - the grid of 3DEC (.3dgrid, text): G, F, Z and B lines. Of blocks with
   *   zones the surface is taken. The numbers of their regions, as 'region 1',
   *   are groups.
   *
   * Faces that share edges in one object, solid or block are one surface.
   * Points closer than 1e-6 of the extent become one, triangles in one plane
   * one face. Throws InputError with the file and the line, the block or the
   * place: what is not of the format, a face of less than three points, a
   * point that is not there, a surface that is not closed.
   */
  BlockSurfaces read_block_surfaces(const std::string &file);

  /** Names of the sides of a box around the blocks: of the surfaces in x, y
      and z, first low, then high. */
  constexpr const char *block_sides[]
      = { "left", "right", "front", "back", "bottom", "top" };

  /**
   * The geometry of @p blocks in gmsh's OpenCASCADE kernel, where faces of
   * blocks that touch are cut so that they match: physical volumes are the
   * groups, the physical surface 'joint' is all where two blocks touch, and
   * block_sides are those at the box around all of them. The mesh has edges of
   * @p element_size [m]. gmsh reports an error if blocks overlap or
   * have a cavity.
   */
  GmshGeometry block_geometry(const BlockSurfaces &blocks, double element_size);

  /** Description for --check. */
  std::string block_report(const BlockSurfaces &blocks);
} // namespace quoin

#endif
