// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/contact_edges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

namespace quoin
{
  namespace
  {
    /** Turns between edges of less than the first go straight on, of more
        than the second are corners [rad]. */
    constexpr double straight = 0.1, corner = 0.3;
    /** Sine of the turn below which sides of rigid blocks are straight. */
    constexpr double collinear = 1e-6;

    /** An edge on the boundary of a block, as its rank knows it. */
    struct Side
    {
      std::array<unsigned int, 2> nodes; /**< global */
      std::array<dealii::Point<2>, 2> points;
      unsigned int block, group;
      double twice_the_area; /**< of the cell behind it [m^2] */
      unsigned int joint;    /**< JointNodes::number, or none */
      unsigned int side;     /**< of the joint: 0 lower, 1 upper */

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &nodes &points &block &group &twice_the_area &joint &side;
      }
    };

    std::unordered_map<unsigned int, unsigned int>
    edges_by_first_node(const std::vector<ContactEdge> &edges)
    {
      std::unordered_map<unsigned int, unsigned int> result;
      result.reserve(edges.size());
      for (unsigned int e = 0; e < edges.size(); ++e)
        result.emplace(edges[e].nodes[0], e);
      return result;
    }
  } // namespace

  ContactEdges::ContactEdges(const NodeMap<2> &nodes)
  {
    // Each rank has the sides of its own cells.
    std::vector<Side> own;
    const auto add = [&](const unsigned int a, const unsigned int b,
                         const unsigned int cell, const unsigned int joint,
                         const unsigned int side)
    {
      const auto &c = nodes.cell(cell);
      const auto e1 = nodes.point(c[1]) - nodes.point(c[0]);
      const auto e2 = nodes.point(c[2]) - nodes.point(c[0]);
      own.push_back(
          { { nodes.exchange().global(a), nodes.exchange().global(b) },
            { nodes.point(a), nodes.point(b) },
            nodes.block_of_cell(cell),
            nodes.group_of_cell(cell),
            e1[0] * e2[1] - e1[1] * e2[0],
            joint,
            side });
    };
    for (const JointNodes<2> &face : nodes.joint_faces())
    {
      if (face.is_own[0])
        add(face.lower[0], face.lower[1], face.cells[0], face.number, 0);
      if (face.is_own[1])
        add(face.upper[1], face.upper[0], face.cells[1], face.number, 1);
    }
    for (const OuterFace<2> &face : nodes.outer_faces())
      add(face.nodes[0], face.nodes[1], face.cell, none, 0);
    std::vector<Side> sides;
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(nodes.communicator(), own))
      sides.insert(sides.end(), part.begin(), part.end());

    // Interfaces are numbered by their first joint.
    std::vector<std::array<const Side *, 2>> joints(nodes.n_joint_faces());
    for (const Side &side : sides)
      if (side.joint != none)
        joints[side.joint][side.side] = &side;
    std::map<std::array<unsigned int, 2>, unsigned int> interface_of_blocks;
    for (const auto &[lower, upper] : joints)
    {
      std::array<unsigned int, 2> blocks = { lower->block, upper->block };
      std::sort(blocks.begin(), blocks.end());
      const auto [entry, is_new]
          = interface_of_blocks.emplace(blocks, joint_interfaces.size());
      if (is_new)
        joint_interfaces.push_back({ blocks, false });
      JointInterface &interface = joint_interfaces[entry->second];
      // The upper side runs the other way.
      interface.has_tip = interface.has_tip
                          || lower->nodes[0] == upper->nodes[1]
                          || lower->nodes[1] == upper->nodes[0];
      face_interface.push_back(entry->second);
    }

    for (const Side &side : sides)
    {
      ContactEdge edge;
      edge.nodes     = side.nodes;
      edge.points    = side.points;
      edge.block     = side.block;
      edge.group     = side.group;
      edge.previous  = none;
      edge.next      = none;
      edge.interface = side.joint == none ? none : face_interface[side.joint];
      edge.length    = side.points[0].distance(side.points[1]);
      edge.height    = side.twice_the_area / edge.length;
      edges.push_back(edge);
    }
    std::sort(edges.begin(), edges.end(),
              [](const ContactEdge &a, const ContactEdge &b) {
                return std::tie(a.block, a.nodes[0])
                       < std::tie(b.block, b.nodes[0]);
              });
    link();
    merge_straight_sides(nodes.table().is_rigid);
    find_corners();

    for (unsigned int b = 0; b <= nodes.table().n_blocks(); ++b)
      block_first_edge.push_back(
          std::partition_point(edges.begin(), edges.end(),
                               [b](const ContactEdge &edge)
                               { return edge.block < b; })
          - edges.begin());

    const auto edge_from = edges_by_first_node(edges);
    for (const auto &[lower, upper] : joints)
      face_edges.push_back(
          { edge_from.at(lower->nodes[0]), edge_from.at(upper->nodes[0]) });
  }

  void ContactEdges::link()
  {
    const auto edge_from = edges_by_first_node(edges);
    for (unsigned int e = 0; e < edges.size(); ++e)
    {
      const auto next = edge_from.find(edges[e].nodes[1]);
      edges[e].next   = next == edge_from.end() ? none : next->second;
      if (edges[e].next != none)
        edges[edges[e].next].previous = e;
    }
  }

  void ContactEdges::merge_straight_sides(const std::vector<bool> &is_rigid)
  {
    const auto direction = [](const ContactEdge &edge)
    { return (edge.points[1] - edge.points[0]) / edge.length; };
    const auto goes_on = [&](const ContactEdge &edge)
    {
      if (edge.previous == none || edge.interface != none
          || !is_rigid[edge.block])
        return false;
      const ContactEdge &before = edges[edge.previous];
      const auto t = direction(before), s = direction(edge);
      return before.interface == none && before.group == edge.group
             && std::abs(t[0] * s[1] - t[1] * s[0]) < collinear && t * s > 0.;
    };
    std::vector<ContactEdge> merged;
    for (const ContactEdge &start : edges)
    {
      if (goes_on(start))
        continue;
      ContactEdge side = start;
      while (side.next != none && goes_on(edges[side.next]))
      {
        const ContactEdge &part = edges[side.next];
        side.length += part.length;
        side.height    = std::min(side.height, part.height);
        side.nodes[1]  = part.nodes[1];
        side.points[1] = part.points[1];
        side.next      = part.next;
      }
      merged.push_back(side);
    }
    edges = std::move(merged);
    link();
  }

  void ContactEdges::find_corners()
  {
    for (ContactEdge &edge : edges)
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int other = k == 0 ? edge.previous : edge.next;
        edge.corner[k]           = 1.;
        if (other == none)
          continue;
        const auto t = edge.points[1] - edge.points[0];
        const auto s = edges[other].points[1] - edges[other].points[0];
        const double turn
            = std::abs(std::atan2(t[0] * s[1] - t[1] * s[0], t * s));
        edge.corner[k]
            = std::clamp((turn - straight) / (corner - straight), 0., 1.);
      }
  }
} // namespace quoin
