// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/worst_place.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** A joint is named unless a force inside a block is so much larger. */
    constexpr double joint_preference = 10.;

    std::string describe_node(const Model<2> &model,
                              const std::vector<std::string> &set_names,
                              const unsigned int node)
    {
      const NodeMap<2> &nodes = model.nodes();
      std::ostringstream text;
      text << "in block " << nodes.block_of_node(node) << " at ("
           << nodes.point(node)[0] << ", " << nodes.point(node)[1] << ") m";
      for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
      {
        const auto &segment = model.joints().segments()[i];
        for (unsigned int k = 0; k < 2; ++k)
          if (segment.lower[k] == node || segment.upper[k] == node)
          {
            const auto &[a, b] = nodes.faces().joints[segment.face].blocks;
            text << ", at a joint of the set '" << set_names[segment.set]
                 << "' between the blocks " << a << " and " << b;
            return text.str();
          }
      }
      return text.str();
    }
  } // namespace

  std::string worst_place(const Model<2> &model, const DofMap &dof_map,
                          const Balance &balance,
                          const std::vector<std::string> &set_names)
  {
    const MPI_Comm communicator = model.nodes().communicator();
    // The largest unbalanced force, on a node or, if all bodies are rigid, on a
    // body; a joint if it has nearly as much.
    const unsigned int n_owned = model.nodes().n_owned();
    std::vector<bool> on_joint(model.nodes().n_local(), false);
    for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
      for (unsigned int k = 0; k < 2; ++k)
      {
        on_joint[model.joints().segments()[i].lower[k]] = true;
        on_joint[model.joints().segments()[i].upper[k]] = true;
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
      for (const unsigned int d : { 0, 1 })
        if (dof_map.is_free(i, d))
          square += balance.force[i][d] * balance.force[i][d];
      if (!dof_map.is_in_body(i))
        compare(i, std::sqrt(square));
    }
    const auto forces
        = body_forces(dof_map.bodies(), balance.force, communicator);
    for (unsigned int b = 0; b < forces.size(); ++b)
      for (const unsigned int d : { 0, 1 })
        if (const RigidBody &body = dof_map.bodies()[b];
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
} // namespace quoin
