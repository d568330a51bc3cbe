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
   * A mesh of triangles or, in three dimensions, of tetrahedra as a mesh file
   * gives it: nothing is split yet. Groups are physical surfaces or volumes,
   * named faces the elements of physical curves or surfaces. Serializable, so
   * that one rank reads and the others receive.
   */
  template <int dim>
  struct MeshData
  {
    std::vector<dealii::Point<dim>> vertices; /**< [m] */

    std::vector<std::array<unsigned int, dim + 1>> cells; /**< positive volume,
                                                see orient_cells() */
    std::vector<unsigned int> cell_group; /**< indices into group_names */

    std::vector<std::array<unsigned int, dim>> faces; /**< faces with a name */
    std::vector<unsigned int> face_name; /**< indices into face_names */

    std::vector<std::string> group_names;
    std::vector<std::string> face_names = { "" }; /**< [0] is "", unnamed */

    /** Whether triangles are to have nodes in the middle of their edges. */
    bool quadratic = false;

    /** Whether each eight cells are one mixed tetrahedron, see make_mixed().
     */
    bool mixed = false;

    unsigned int n_reoriented = 0;      /**< cells that were the other way */
    std::string source        = "mesh"; /**< the file, for messages */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &vertices &cells &cell_group &faces &face_name &group_names
          &face_names &quadratic &mixed &n_reoriented &source;
    }
  };

  /**
   * Turn cells of negative volume over, and count them in
   * MeshData::n_reoriented. Afterwards triangles are counter-clockwise, and of
   * a tetrahedron the last vertex lies on the side of the first three from
   * which they are counter-clockwise. Throws InputError, with the position,
   * for a cell without volume (less than 1e-12 of its longest edge to the
   * power of dim).
   */
  template <int dim>
  void orient_cells(MeshData<dim> &mesh);

  /** The named curves of @p mesh with the vertices on them, and its names. */
  MeshData<2> curves_of(const MeshData<2> &mesh);
} // namespace quoin

#endif
