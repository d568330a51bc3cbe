// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_contact_edges_h
#define quoin_contact_contact_edges_h

#include <quoin/mesh/node_map.h>

#include <array>
#include <vector>

namespace quoin
{
  /** An edge on the boundary of a block, which is on its left. */
  struct ContactEdge
  {
    std::array<unsigned int, 2> nodes;      /**< global numbers */
    std::array<dealii::Point<2>, 2> points; /**< where they are at rest [m] */
    unsigned int block;
    unsigned int group;     /**< of the cell behind it */
    unsigned int previous;  /**< edge that ends where this one starts */
    unsigned int next;      /**< edge that starts where this one ends */
    unsigned int interface; /**< of joints that it is part of, or none */
    double length;          /**< in the reference state [m] */
    double height;          /**< of the cell behind it, above it [m] */
    /** At either node 1 for a corner of the block, 0 where it goes straight
        on, in between for turns of some degrees. */
    std::array<double, 2> corner;
  };

  /** The matched joints between two blocks, or in a crack of one. */
  struct JointInterface
  {
    std::array<unsigned int, 2> blocks; /**< ascending */
    /** A joint that ends inside a block cannot come apart. */
    bool has_tip = false;
  };

  /**
   * The boundaries of all blocks of the mesh, joint or not, as edges between
   * which contacts are found, on all ranks. Edges are numbered by their block,
   * then by their first node. Where the side
   * of a rigid block is straight, it is one edge, whatever its mesh, unless it
   * is part of a joint.
   */
  class ContactEdges
  {
  public:
    static constexpr unsigned int none = -1;

    /** Collective. */
    explicit ContactEdges(const NodeMap<2> &nodes);

    unsigned int size() const
    {
      return edges.size();
    }
    const ContactEdge &operator[](const unsigned int edge) const
    {
      return edges[edge];
    }
    /** First edge of block @p block; of n_blocks: the end. */
    unsigned int first_edge(const unsigned int block) const
    {
      return block_first_edge[block];
    }
    const std::vector<JointInterface> &interfaces() const
    {
      return joint_interfaces;
    }
    /** Interface of the joint face that has the number @p face. */
    unsigned int interface_of_face(const unsigned int face) const
    {
      return face_interface[face];
    }
    /** The lower and the upper side of each joint face. */
    const std::array<unsigned int, 2> &
    edges_of_face(const unsigned int face) const
    {
      return face_edges[face];
    }

  private:
    void link();
    void find_corners();
    void merge_straight_sides(const std::vector<bool> &is_rigid);

    std::vector<ContactEdge> edges;
    std::vector<unsigned int> block_first_edge;
    std::vector<JointInterface> joint_interfaces;
    std::vector<unsigned int> face_interface;
    std::vector<std::array<unsigned int, 2>> face_edges;
  };
} // namespace quoin

#endif
