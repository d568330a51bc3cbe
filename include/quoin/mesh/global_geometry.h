// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_global_geometry_h
#define quoin_mesh_global_geometry_h

#include <quoin/mesh/node_map.h>

#include <array>
#include <vector>

namespace quoin
{
  // Geometry of the whole mesh that no rank has alone. All of these functions
  // are collective: all ranks call them and get the same result.

  /** An OuterFace of any rank. */
  template <int dim>
  struct BoundaryFace
  {
    std::array<unsigned int, dim> nodes; /**< global */
    std::array<dealii::Point<dim>, dim> points;
    std::array<double, dim> shares; /**< face_share() of the nodes */
    unsigned int group;             /**< group of the adjacent cell */
    unsigned int across;            /**< that across the joint, or the same */
    unsigned int block;             /**< block of the adjacent cell */
    unsigned int name;              /**< index into BlockTable::face_names */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &points &shares &group &across &block &name;
    }
  };

  /** The outer faces of all ranks whose names @p wanted says, by ascending
      global nodes; @p with_joints: and both faces of the joints whose names it
      says, each with its block behind it. */
  template <int dim>
  std::vector<BoundaryFace<dim>> gather_faces(const NodeMap<dim> &nodes,
                                              const std::vector<bool> &wanted,
                                              bool with_joints = false);

  /** Lower and upper corner of the box around block @p number [m]. */
  template <int dim>
  std::array<dealii::Point<dim>, 2> box_of_block(const NodeMap<dim> &nodes,
                                                 unsigned int number);

  /** Position of the first node of block @p number [m]. */
  template <int dim>
  dealii::Point<dim> point_of_block(const NodeMap<dim> &nodes,
                                    unsigned int number);

  /**
   * Of the ranks that give a local @p node, position [m] and block of that with
   * the lowest global number; false if all give NodeMap::none.
   */
  template <int dim>
  bool first_point(const NodeMap<dim> &nodes, unsigned int node,
                   dealii::Point<dim> &position, unsigned int *block = nullptr);
} // namespace quoin

#endif
