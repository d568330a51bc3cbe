// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/global_geometry.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <limits>

namespace quoin
{
  template <int dim>
  std::vector<BoundaryFace<dim>> gather_faces(const NodeMap<dim> &nodes,
                                              const std::vector<bool> &wanted,
                                              const bool with_joints)
  {
    std::vector<BoundaryFace<dim>> own;
    const auto add = [&](const std::array<unsigned int, dim> &face_nodes,
                         const unsigned int cell, const unsigned int across,
                         const unsigned int name)
    {
      BoundaryFace<dim> result;
      for (unsigned int k = 0; k < dim; ++k)
      {
        result.nodes[k]  = nodes.exchange().global(face_nodes[k]);
        result.points[k] = nodes.point(face_nodes[k]);
        result.shares[k] = face_share(nodes, face_nodes[k]);
      }
      result.group  = nodes.cells().group[cell];
      result.across = across;
      result.block  = nodes.blocks().block_of_cell(cell);
      result.name   = name;
      own.push_back(result);
    };
    for (const OuterFace<dim> &face : nodes.faces().outer)
      if (wanted[face.name])
        add(face.nodes, face.cell, nodes.cells().group[face.cell], face.name);
    if (with_joints)
      for (const JointNodes<dim> &joint : nodes.faces().joints)
      {
        if (!wanted[joint.name])
          continue;
        if (joint.is_own[0])
          add(joint.lower, joint.cells[0], joint.groups[1], joint.name);
        if (joint.is_own[1])
        {
          // The normal points out of the lower side: the other way round.
          std::array<unsigned int, dim> upper = joint.upper;
          std::swap(upper[0], upper[1]);
          add(upper, joint.cells[1], joint.groups[0], joint.name);
        }
      }
    std::vector<BoundaryFace<dim>> all;
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(nodes.communicator(), own))
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(),
              [](const BoundaryFace<dim> &a, const BoundaryFace<dim> &b)
              { return a.nodes < b.nodes; });
    return all;
  }

  template <int dim>
  std::array<dealii::Point<dim>, 2> box_of_block(const NodeMap<dim> &nodes,
                                                 const unsigned int number)
  {
    // The upper corner with the other sign, so that one minimum finds both.
    std::vector<double> box(2 * dim, std::numeric_limits<double>::max());
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      if (nodes.block_of_node(i) == number)
        for (unsigned int d = 0; d < dim; ++d)
        {
          box[d]       = std::min(box[d], nodes.point(i)[d]);
          box[dim + d] = std::min(box[dim + d], -nodes.point(i)[d]);
        }
    dealii::Utilities::MPI::min(box, nodes.communicator(), box);
    std::array<dealii::Point<dim>, 2> result;
    for (unsigned int d = 0; d < dim; ++d)
    {
      result[0][d] = box[d];
      result[1][d] = -box[dim + d];
    }
    return result;
  }

  template <int dim>
  dealii::Point<dim> point_of_block(const NodeMap<dim> &nodes,
                                    const unsigned int number)
  {
    unsigned int node = 0;
    while (node < nodes.n_owned() && nodes.block_of_node(node) != number)
      ++node;
    dealii::Point<dim> result;
    first_point(nodes, node < nodes.n_owned() ? node : NodeMap<dim>::none,
                result);
    return result;
  }

  template <int dim>
  bool first_point(const NodeMap<dim> &nodes, const unsigned int node,
                   dealii::Point<dim> &position, unsigned int *block)
  {
    const unsigned int own = node == NodeMap<dim>::none
                                 ? NodeMap<dim>::none
                                 : nodes.exchange().global(node);
    const unsigned int first
        = dealii::Utilities::MPI::min(own, nodes.communicator());
    if (first == NodeMap<dim>::none)
      return false;
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(nodes.communicator());
    const unsigned int speaker = dealii::Utilities::MPI::min(
        own == first ? rank : NodeMap<dim>::none, nodes.communicator());
    std::pair<dealii::Point<dim>, unsigned int> found;
    if (rank == speaker)
      found = { nodes.point(node), nodes.block_of_node(node) };
    found    = dealii::Utilities::MPI::broadcast(nodes.communicator(), found,
                                                 speaker);
    position = found.first;
    if (block)
      *block = found.second;
    return true;
  }

  template std::vector<BoundaryFace<2>>
  gather_faces(const NodeMap<2> &, const std::vector<bool> &, bool);
  template std::array<dealii::Point<2>, 2> box_of_block(const NodeMap<2> &,
                                                        unsigned int);
  template dealii::Point<2> point_of_block(const NodeMap<2> &, unsigned int);
  template bool first_point(const NodeMap<2> &, unsigned int,
                            dealii::Point<2> &, unsigned int *);
  template std::vector<BoundaryFace<3>>
  gather_faces(const NodeMap<3> &, const std::vector<bool> &, bool);
  template std::array<dealii::Point<3>, 2> box_of_block(const NodeMap<3> &,
                                                        unsigned int);
  template dealii::Point<3> point_of_block(const NodeMap<3> &, unsigned int);
  template bool first_point(const NodeMap<3> &, unsigned int,
                            dealii::Point<3> &, unsigned int *);
} // namespace quoin
