// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/contact_edges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace quoin
{
  namespace
  {
    /** Turns between edges of less than the first go straight on, of more
        than the second are corners [rad]. */
    constexpr double straight = 0.1, corner = 0.3;
    /** Sine of the turn below which sides of rigid blocks are straight. */
    constexpr double collinear = 1e-6;
  } // namespace

  ContactEdges::ContactEdges(const BlockMesh<2> &mesh,
                             const std::vector<bool> &is_rigid)
  {
    const auto add = [&](const unsigned int v0, const unsigned int v1,
                         const unsigned int cell, const unsigned int interface)
    {
      ContactEdge edge;
      edge.nodes     = { v0, v1 };
      edge.block     = mesh.block_of_cell(cell);
      edge.group     = mesh.cell_group[cell];
      edge.previous  = none;
      edge.next      = none;
      edge.interface = interface;
      edge.length    = mesh.vertices[v0].distance(mesh.vertices[v1]);
      const auto &c  = mesh.cells[cell];
      const auto e1  = mesh.vertices[c[1]] - mesh.vertices[c[0]];
      const auto e2  = mesh.vertices[c[2]] - mesh.vertices[c[0]];
      edge.height    = (e1[0] * e2[1] - e1[1] * e2[0]) / edge.length;
      edges.push_back(edge);
    };

    std::map<std::array<unsigned int, 2>, unsigned int> interface_of_blocks;
    for (const JointFace &face : mesh.joint_faces)
    {
      std::array<unsigned int, 2> blocks
          = { mesh.block_of_cell(face.cells[0]),
              mesh.block_of_cell(face.cells[1]) };
      std::sort(blocks.begin(), blocks.end());
      const auto [entry, is_new]
          = interface_of_blocks.emplace(blocks, joint_interfaces.size());
      if (is_new)
        joint_interfaces.push_back({ blocks, false });
      JointInterface &interface = joint_interfaces[entry->second];
      for (unsigned int k = 0; k < 2; ++k)
        interface.has_tip = interface.has_tip || face.lower[k] == face.upper[k];
      face_interface.push_back(entry->second);
      add(face.lower[0], face.lower[1], face.cells[0], entry->second);
      add(face.upper[1], face.upper[0], face.cells[1], entry->second);
    }
    for (const BlockFace &face : mesh.boundary_faces)
      add(face.vertices[0], face.vertices[1], face.cell, none);

    std::sort(edges.begin(), edges.end(),
              [](const ContactEdge &a, const ContactEdge &b)
              { return a.nodes[0] < b.nodes[0]; });
    link(mesh.n_vertices());
    if (!is_rigid.empty())
      merge_straight_sides(mesh, is_rigid);
    find_corners(mesh);

    for (unsigned int b = 0; b <= mesh.n_blocks(); ++b)
      block_first_edge.push_back(
          std::partition_point(edges.begin(), edges.end(),
                               [b](const ContactEdge &edge)
                               { return edge.block < b; })
          - edges.begin());

    std::vector<unsigned int> edge_from(mesh.n_vertices(), none);
    for (unsigned int e = 0; e < edges.size(); ++e)
      edge_from[edges[e].nodes[0]] = e;
    for (const JointFace &face : mesh.joint_faces)
      face_edges.push_back(
          { edge_from[face.lower[0]], edge_from[face.upper[1]] });
  }

  void ContactEdges::link(const unsigned int n_vertices)
  {
    std::vector<unsigned int> edge_from(n_vertices, none);
    for (unsigned int e = 0; e < edges.size(); ++e)
      edge_from[edges[e].nodes[0]] = e;
    for (unsigned int e = 0; e < edges.size(); ++e)
    {
      edges[e].next = edge_from[edges[e].nodes[1]];
      if (edges[e].next != none)
        edges[edges[e].next].previous = e;
    }
  }

  void ContactEdges::merge_straight_sides(const BlockMesh<2> &mesh,
                                          const std::vector<bool> &is_rigid)
  {
    const auto direction = [&](const ContactEdge &edge)
    {
      return (mesh.vertices[edge.nodes[1]] - mesh.vertices[edge.nodes[0]])
             / edge.length;
    };
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
        side.height   = std::min(side.height, part.height);
        side.nodes[1] = part.nodes[1];
        side.next     = part.next;
      }
      merged.push_back(side);
    }
    edges = std::move(merged);
    link(mesh.n_vertices());
  }

  void ContactEdges::find_corners(const BlockMesh<2> &mesh)
  {
    for (ContactEdge &edge : edges)
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int other = k == 0 ? edge.previous : edge.next;
        edge.corner[k]           = 1.;
        if (other == none)
          continue;
        const auto t
            = mesh.vertices[edge.nodes[1]] - mesh.vertices[edge.nodes[0]];
        const auto s = mesh.vertices[edges[other].nodes[1]]
                       - mesh.vertices[edges[other].nodes[0]];
        const double turn
            = std::abs(std::atan2(t[0] * s[1] - t[1] * s[0], t * s));
        edge.corner[k]
            = std::clamp((turn - straight) / (corner - straight), 0., 1.);
      }
  }
} // namespace quoin
