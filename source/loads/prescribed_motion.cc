// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/nodal_load.h>
#include <quoin/loads/prescribed_motion.h>

#include <algorithm>

namespace quoin
{
  std::vector<unsigned int>
  nodes_of_faces(const NodeMap<2> &node_map,
                 const std::vector<BoundaryFace<2>> &faces)
  {
    std::vector<unsigned int> nodes;
    for (const BoundaryFace<2> &face : faces)
      for (const unsigned int v : face.nodes)
        if (node_map.exchange().owns(v))
          nodes.push_back(node_map.exchange().local(v));
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  PrescribedMotion::PrescribedMotion(const LoadParameters &parameters,
                                     const NodeMap<2> &node_map)
    : components(parameters.components)
  {
    load_name = parameters.name;
    node_list = nodes_of_faces(
        node_map,
        faces_of_curves(node_map, parameters.boundaries, parameters.name));
  }

  void PrescribedMotion::correct(const StepContext &step,
                                 const std::vector<CapturedNode<2>> &captured,
                                 State<2> &state)
  {
    for (unsigned int d = 0; d < 2; ++d)
    {
      const LoadComponent &component = components[d];
      if (component.quantity == LoadQuantity::free)
        continue;
      const double velocity
          = component.quantity == LoadQuantity::velocity
                ? step.load_rate * component.value(step.middle)
                : (component.value(step.end) - component.value(step.begin))
                      / step.dt;
      for (const unsigned int c : captured_positions)
      {
        const CapturedNode<2> &before    = captured[c];
        state.velocity[before.node].v[d] = velocity;
        state.nodes[before.node].u[d]
            = before.displacement.v[d] + step.dt * velocity;
      }
    }
  }

  void PrescribedMotion::account(const StepContext &step,
                                 const std::vector<CapturedNode<2>> &captured,
                                 State<2> &state)
  {
    last_resultant = {};
    for (const unsigned int c : captured_positions)
    {
      const CapturedNode<2> &before = captured[c];
      double reaction[2]            = { 0., 0. };
      for (unsigned int d = 0; d < 2; ++d)
      {
        if (before.owner[d] != this)
          continue;
        const double after = state.velocity[before.node].v[d];
        reaction[d]
            = before.mass * (after - before.velocity.v[d]) / step.dt_velocity
              - before.force.v[d];
        state.energy.external
            += 0.5 * step.dt_before * reaction[d] * before.velocity.v[d];
        state.pending.external += 0.5 * step.dt * reaction[d] * after;
        last_resultant[d] += reaction[d];
      }
      last_resultant[2]
          += moment_of(reaction, before, state.nodes[before.node]);
    }
  }

  std::array<bool, 3> PrescribedMotion::holds() const
  {
    return { { components[0].quantity != LoadQuantity::free,
               components[1].quantity != LoadQuantity::free, false } };
  }
} // namespace quoin
