// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_mesh_data_h
#define quoin_mesh_mesh_data_h

#include <deal.II/base/point.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * A triangle mesh as a mesh file gives it: nothing is split yet.
   * Serializable, so that one rank reads and the others receive.
   */
  struct MeshData
  {
    std::vector<dealii::Point<2>> vertices; /**< [m] */

    std::vector<std::array<unsigned int, 3>>
        triangles;                            /**< counter-clockwise */
    std::vector<unsigned int> triangle_group; /**< into group_names */

    std::vector<std::array<unsigned int, 2>> lines; /**< of named curves */
    std::vector<unsigned int> line_name;            /**< into line_names */

    std::vector<std::string> group_names;         /**< of physical surfaces */
    std::vector<std::string> line_names = { "" }; /**< [0] is "", unnamed */

    /** Whether triangles are to have nodes in the middle of their edges. */
    bool quadratic = false;

    unsigned int n_reoriented = 0;      /**< triangles that were clockwise */
    std::string source        = "mesh"; /**< the file, for messages */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &vertices &triangles &triangle_group &lines &line_name
          &group_names &line_names &quadratic &n_reoriented &source;
    }
  };

  /**
   * Turn clockwise triangles over, and count them in MeshData::n_reoriented.
   * Throws InputError, with the position, for a triangle without area (less
   * than 1e-12 of its longest edge squared).
   */
  void orient_triangles(MeshData &mesh);

  /** The named curves of @p mesh with the vertices on them, and its names. */
  MeshData curves_of(const MeshData &mesh);
} // namespace quoin

#endif
