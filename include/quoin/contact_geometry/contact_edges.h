// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_contact_edges_h
#define quoin_contact_geometry_contact_edges_h

#include <quoin/mesh/node_map.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace quoin
{
  /** An edge on the boundary of a block, which is on its left. */
  struct ContactEdge
  {
    std::array<unsigned int, 2> nodes; /**< global numbers */
    /** Positions of the nodes at rest [m]. */
    std::array<dealii::Point<2>, 2> points;
    unsigned int number; /**< number of the edge on all ranks */
    unsigned int block;
    unsigned int group;     /**< group of the adjacent cell */
    unsigned int previous;  /**< edge that ends where this one starts */
    unsigned int next;      /**< edge that starts where this one ends */
    unsigned int interface; /**< index into BlockTable::joined, or none */
    double length;          /**< length in the reference state [m] */
    double height; /**< height of the adjacent cell above the edge [m] */
    /** Weight of either node as a corner: 1 for a corner of the block, 0 where
       the boundary is straight, in between for turns of some degrees. */
    std::array<double, 2> corner;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &points &number &block &group &previous &next
          &interface &length &height &corner;
    }
  };

  /** Both sides of a joint face as edges. */
  struct JointEdges
  {
    std::array<unsigned int, 2> edges; /**< lower, upper */
    unsigned int interface;            /**< index into BlockTable::joined */
  };

  /**
   * The boundaries of blocks, joint or not, as edges between which contacts
   * are found. A rank has those of its own cells and knows of other ranks those
   * which lie across its joints, and which it has met or asked for: no rank has
   * all of them. Edges have numbers that are those of all ranks and do not
   * depend on how many there are: by block, within a block by their first
   * vertex. Where the side of a rigid block is straight, it is one edge,
   * whatever its mesh, unless it is part of a joint.
   */
  class ContactEdges
  {
  public:
    static constexpr unsigned int none = -1;

    /** Collective. */
    explicit ContactEdges(const NodeMap<2> &nodes);

    /** Edges of all ranks. */
    unsigned int n_global() const
    {
      return n_edges;
    }
    /** Edges of this rank's cells, ascending. */
    const std::vector<ContactEdge> &own() const
    {
      return own_edges;
    }
    /** Local nodes of each of own(), owned or shared. */
    const std::vector<std::array<unsigned int, 2>> &local_nodes() const
    {
      return own_nodes;
    }
    /** Owned nodes where an edge of any rank starts, local, ascending. */
    const std::vector<unsigned int> &boundary_nodes() const
    {
      return starts;
    }
    /** Edges of other ranks that this one has received, ascending. */
    const std::vector<ContactEdge> &foreign() const
    {
      return foreign_edges;
    }

    /** Edges of other ranks before or after own ones, with their ranks, where
        blocks are divided. These ranks have edges of this rank next to theirs.
     */
    const std::map<unsigned int, unsigned int> &ranks_beside() const
    {
      return rank_of_neighbour;
    }

    bool is_own(const unsigned int number) const
    {
      return has_all() || contains(own_edges, number);
    }
    /** Place in own() of an own edge. */
    unsigned int own_place(const unsigned int number) const
    {
      return has_all() ? number : place(own_edges, number);
    }
    bool is_known(const unsigned int number) const
    {
      return is_own(number) || contains(foreign_edges, number);
    }
    /** An edge that is known here. */
    const ContactEdge &operator[](const unsigned int number) const
    {
      return is_own(number) ? own_edges[own_place(number)]
                            : foreign_edges[place(foreign_edges, number)];
    }

    /** Makes edges of other ranks known here, which may be so already. */
    void add(const std::vector<ContactEdge> &edges);
    /** Asks their ranks for those of the edges @p numbers that are not known
        here. Collective. */
    void fetch(const std::vector<unsigned int> &numbers);
    /** Forgets edges of other ranks, but for @p numbers, ascending, and those
        across joints. */
    void keep(const std::vector<unsigned int> &numbers);

    /** The sides of LocalFaces::joints[face]. */
    const JointEdges &joint_edges(const unsigned int face) const
    {
      return edges_of_joints[face];
    }
    /** Whether a joint of @p interface ends inside a block, so that it cannot
        come apart. */
    bool has_tip(const unsigned int interface) const
    {
      return interface_has_tip[interface];
    }

  private:
    void link();
    void merge_straight_sides(const std::vector<bool> &is_rigid);
    void find_interfaces();
    void number_edges();
    void join_over_ranks();
    void find_joint_edges();
    void find_boundary_nodes();

    bool has_all() const
    {
      return own_edges.size() == n_edges;
    }
    static unsigned int place(const std::vector<ContactEdge> &edges,
                              const unsigned int number)
    {
      return std::lower_bound(edges.begin(), edges.end(), number,
                              [](const ContactEdge &edge, const unsigned int n)
                              { return edge.number < n; })
             - edges.begin();
    }
    static bool contains(const std::vector<ContactEdge> &edges,
                         const unsigned int number)
    {
      const unsigned int found = place(edges, number);
      return found < edges.size() && edges[found].number == number;
    }

    const NodeMap<2> &node_map;
    unsigned int n_edges = 0;
    std::vector<ContactEdge> own_edges, foreign_edges;
    std::vector<std::array<unsigned int, 2>> own_nodes;
    std::vector<unsigned int> starts; /**< see boundary_nodes() */
    std::vector<JointEdges> edges_of_joints;
    std::vector<unsigned int> across_joints; /**< foreign, ascending */
    std::map<unsigned int, unsigned int> rank_of_neighbour;
    std::vector<bool> interface_has_tip;
  };
} // namespace quoin

#endif
