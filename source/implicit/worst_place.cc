// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/point_text.h>
#include <quoin/implicit/worst_place.h>
#include <quoin/joint_elements/joint_changes.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** A joint is named unless a force inside a block is so much larger. */
    constexpr double joint_preference = 10.;

    template <int dim>
    std::string describe_node(const Model<dim> &model,
                              const std::vector<std::string> &set_names,
                              const unsigned int node)
    {
      const NodeMap<dim> &nodes = model.nodes();
      std::ostringstream text;
      text << "in block " << nodes.block_of_node(node) << " at "
           << point_text(nodes.point(node)) << " m";
      for (const auto &face : joint_faces(model.joints()))
        for (unsigned int k = 0; k < dim; ++k)
          if (face.lower[k] == node || face.upper[k] == node)
          {
            const auto &[a, b] = nodes.faces().joints[face.face].blocks;
            text << ", at a joint of the set '" << set_names[face.set]
                 << "' between the blocks " << a << " and " << b;
            return text.str();
          }
      return text.str();
    }
  } // namespace

  template <int dim>
  std::string worst_place(const Model<dim> &model, const DofMap<dim> &dof_map,
                          const Balance<dim> &balance,
                          const std::vector<std::string> &set_names)
  {
    const MPI_Comm communicator = model.nodes().communicator();
    // The largest unbalanced force, on a node or, if all bodies are rigid, on a
    // body; a joint if it has nearly as much.
    const unsigned int n_owned = model.nodes().n_owned();
    std::vector<bool> on_joint(model.nodes().n_local(), false);
    for (const auto &face : joint_faces(model.joints()))
      for (unsigned int k = 0; k < dim; ++k)
      {
        on_joint[face.lower[k]] = true;
        on_joint[face.upper[k]] = true;
      }
    double largest     = -1.;
    unsigned int worst = 0;
    const auto compare = [&](const unsigned int node, const double force)
    {
      const double counts = force * (on_joint[node] ? joint_preference : 1.);
      if (counts <= largest)
        return;
      largest = counts;
      worst   = node;
    };
    for (unsigned int i = 0; i < n_owned; ++i)
    {
      double square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        if (dof_map.is_free(i, d))
          square += balance.force[i][d] * balance.force[i][d];
      if (!dof_map.is_in_body(i))
        compare(i, std::sqrt(square));
    }
    const auto forces
        = body_forces(dof_map.bodies(), balance.force, communicator);
    for (unsigned int b = 0; b < forces.size(); ++b)
      for (unsigned int d = 0; d < dim; ++d)
        if (const RigidBody<dim> &body = dof_map.bodies()[b];
            !body.given[d] && !body.nodes.empty())
          compare(body.nodes.front(),
                  std::abs(forces[b][d] + balance.drives[b][d]
                           + balance.held[b][d]));

    const double most  = dealii::Utilities::MPI::max(largest, communicator);
    const bool is_here = largest >= 0. && largest == most;
    for (const std::string &text : dealii::Utilities::MPI::all_gather(
             communicator,
             is_here ? describe_node(model, set_names, worst) : std::string()))
      if (!text.empty())
        return text;
    return "nowhere";
  }

  template std::string worst_place(const Model<2> &, const DofMap<2> &,
                                   const Balance<2> &,
                                   const std::vector<std::string> &);
  template std::string worst_place(const Model<3> &, const DofMap<3> &,
                                   const Balance<3> &,
                                   const std::vector<std::string> &);
} // namespace quoin
