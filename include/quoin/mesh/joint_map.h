// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_joint_map_h
#define quoin_mesh_joint_map_h

#include <boost/serialization/array.hpp>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * Two faces of cells that lie on each other across a joint. Cells have their
   * numbers in the whole mesh, which are the ids of deal.II's coarse cells;
   * vertices and faces those of the reference simplex. See JointFace for which
   * side is the lower one.
   */
  template <int dim>
  struct JointPair
  {
    std::array<unsigned int, 2> cells; /**< lower, upper */
    std::array<unsigned int, 2> faces; /**< local face numbers in the cells */
    /** Vertex of the upper face on which vertex k of the lower one lies. */
    std::array<unsigned int, dim> match;
    unsigned int number;                /**< number in the whole mesh */
    unsigned int name;                  /**< boundary id of the name */
    std::array<unsigned int, 2> groups; /**< material ids of the cells */
    std::array<unsigned int, 2> ranks;  /**< ranks that own the cells */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &cells &faces &match &number &name &groups &ranks;
    }
  };

  /**
   * The joints of a BlockTriangulation, which are not part of deal.II's mesh:
   * blocks share no vertices. Each rank has the pairs of which it owns a side,
   * by ascending number.
   */
  template <int dim>
  using JointMap = std::vector<JointPair<dim>>;
} // namespace quoin

#endif
