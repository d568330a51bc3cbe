// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/motions/prescribed_motion.h>
#include <quoin/loads/traction_field.h>

#include <algorithm>

namespace quoin
{
  template <int dim>
  std::vector<unsigned int>
  nodes_of_faces(const NodeMap<dim> &node_map,
                 const std::vector<BoundaryFace<dim>> &faces)
  {
    std::vector<unsigned int> nodes;
    for (const BoundaryFace<dim> &face : faces)
      for (const unsigned int v : face.nodes)
        if (node_map.exchange().owns(v))
          nodes.push_back(node_map.exchange().local(v));
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  template <int dim>
  PrescribedMotion<dim>::PrescribedMotion(const LoadParameters &parameters,
                                          const NodeMap<dim> &node_map)
    : components(parameters.components)
  {
    this->load_name       = parameters.name;
    this->own_traits.kind = MotionKind::prescribed;
    for (unsigned int d = 0; d < dim; ++d)
      this->own_traits.holds[d] = components[d].quantity != LoadQuantity::free;
    const auto faces
        = faces_of_curves(node_map, parameters.boundaries, parameters.name);
    for (LoadComponent &component : components)
      if (component.field)
        component.value
            = mixture(*component.field, sample_places(faces), dim - 1);
    this->node_list = nodes_of_faces(node_map, faces);
  }

  template <int dim>
  void
  PrescribedMotion<dim>::correct(const StepContext &step,
                                 const std::vector<CapturedNode<dim>> &captured,
                                 State<dim> &state)
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      const LoadComponent &component = components[d];
      if (component.quantity == LoadQuantity::free)
        continue;
      const auto velocity_at = [&](const dealii::Point<3> &place)
      {
        return component.quantity == LoadQuantity::velocity
                   ? step.load_rate * component.at(place, step.middle)
                   : (component.at(place, step.end)
                      - component.at(place, step.begin))
                         / step.dt;
      };
      const double common = component.field ? 0. : velocity_at({});
      for (const unsigned int c : this->captured_positions)
      {
        const CapturedNode<dim> &before = captured[c];
        double velocity                 = common;
        if (component.field)
        {
          dealii::Point<3> place;
          for (unsigned int e = 0; e < dim; ++e)
            place[e] = state.nodes[before.node].X[e];
          velocity = velocity_at(place);
        }
        state.velocity[before.node][d] = velocity;
        state.nodes[before.node].u[d]
            = before.displacement[d] + step.dt * velocity;
      }
    }
  }

  template <int dim>
  void
  PrescribedMotion<dim>::account(const StepContext &step,
                                 const std::vector<CapturedNode<dim>> &captured,
                                 State<dim> &state)
  {
    this->last_resultant = {};
    double power_before = 0., power_after = 0.;
    for (const unsigned int c : this->captured_positions)
    {
      const CapturedNode<dim> &before = captured[c];
      dealii::Tensor<1, dim> reaction;
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (before.owner[d] != this)
          continue;
        const double after = state.velocity[before.node][d];
        reaction[d]
            = before.mass * (after - before.velocity[d]) / step.dt_velocity
              - before.force[d];
        power_before += reaction[d] * before.velocity[d];
        power_after += reaction[d] * after;
      }
      add_force(reaction, place_before(before, state.nodes[before.node]),
                this->last_resultant);
    }
    state.energy.external += 0.5 * step.dt_before * power_before;
    state.pending.external += 0.5 * step.dt * power_after;
  }

  template class PrescribedMotion<2>;
  template std::vector<unsigned int>
  nodes_of_faces(const NodeMap<2> &, const std::vector<BoundaryFace<2>> &);

  template class PrescribedMotion<3>;
  template std::vector<unsigned int>
  nodes_of_faces(const NodeMap<3> &, const std::vector<BoundaryFace<3>> &);
} // namespace quoin
