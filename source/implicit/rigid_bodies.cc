// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/plane_geometry.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/loading/load_pattern.h>
#include <quoin/implicit/rigid_bodies.h>
#include <quoin/motions/space_platen.h>
#include <quoin/blocks/rigid_blocks.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  template <int dim>
  const LoadComponent &body_component(const MotionConstraint<dim> &platen,
                                      const unsigned int d)
  {
    return d < 3 ? (*platen.parts())[d]
                 : (*platen.rigid_motion()->rotations())[d - 3];
  }

  template <int dim>
  Configuration<dim> configuration_of(const RigidBodies<dim> &bodies,
                                      const State<dim> &state)
  {
    Configuration<dim> result;
    result.nodes     = state.nodes;
    result.load_time = state.load_time;
    result.released  = state.template get<ImplicitState>().released;
    result.factor    = state.template get<LoadPatternState>().factor;
    for (const RigidBody<dim> &body : bodies)
    {
      auto &motion = result.bodies.emplace_back();
      if (body.platen)
      {
        const double *d = body.platen->rigid_motion()->displacement(state);
        std::copy(d, d + motion.size(), motion.begin());
        if constexpr (dim == 3)
          result.turned.push_back(rotation_of(
              state.template get<SpacePlatenState>(body.platen->name())));
        continue;
      }
      const RigidBlockState &block
          = state.template get<RigidBlockStates>()[body.rigid_block];
      motion[0] = block.displacement[0];
      motion[1] = block.displacement[1];
      motion[2] = block.rotation;
    }
    return result;
  }

  template <int dim>
  void write_configuration(const RigidBodies<dim> &bodies,
                           const Configuration<dim> &configuration,
                           State<dim> &state)
  {
    state.nodes                                   = configuration.nodes;
    state.load_time                               = configuration.load_time;
    state.template get<ImplicitState>().released  = configuration.released;
    state.template get<LoadPatternState>().factor = configuration.factor;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const auto &d = configuration.bodies[b];
      if constexpr (dim == 3)
      {
        auto &platen
            = state.template get<SpacePlatenState>(bodies[b].platen->name());
        // Iterations turned it one after the other: of a free turn the rates
        // are those of the one turn of the step.
        const dealii::Tensor<1, 3> turn
            = turn_of(configuration.turned[b] * transpose(rotation_of(platen)));
        const auto before   = platen.displacement;
        platen.displacement = d;
        if (std::none_of(bodies[b].given.begin() + 3, bodies[b].given.end(),
                         [](const bool given) { return given; }))
          for (unsigned int k = 0; k < 3; ++k)
            platen.displacement[3 + k] = before[3 + k] + turn[k];
        set_rotation(configuration.turned[b], platen);
      }
      else if (bodies[b].platen)
        std::copy(d.begin(), d.end(),
                  state.template get<PlatenState>(bodies[b].platen->name())
                      .displacement);
      else
      {
        RigidBlockState &block
            = state.template get<RigidBlockStates>()[bodies[b].rigid_block];
        block.displacement = vector_at(d, 0);
        block.rotation     = d[2];
      }
    }
  }

  template <int dim>
  void place_nodes(const RigidBodies<dim> &bodies,
                   Configuration<dim> &configuration)
  {
    if constexpr (dim == 2)
      for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const RigidBody<dim> &body = bodies[b];
        const auto &d              = configuration.bodies[b];
        const double c = std::cos(d[2]), s = std::sin(d[2]);
        for (unsigned int i = 0; i < body.nodes.size(); ++i)
        {
          NodeRecord<dim> &node = configuration.nodes[body.nodes[i]];
          const double x = body.arms[i][0], y = body.arms[i][1];
          // Terms that nearly cancel are summed first, to keep digits.
          node.u[0]
              = body.centre[0] + x - node.X[0] + d[0] + (c - 1.) * x - s * y;
          node.u[1]
              = body.centre[1] + y - node.X[1] + d[1] + s * x + (c - 1.) * y;
        }
      }
    else
      for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const RigidBody<dim> &body = bodies[b];
        const auto change
            = configuration.turned[b]
              - dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
        for (unsigned int i = 0; i < body.nodes.size(); ++i)
        {
          NodeRecord<dim> &node = configuration.nodes[body.nodes[i]];
          node.u                = body.centre + body.arms[i] - node.X
                   + vector_at<dim>(configuration.bodies[b], 0)
                   + change * body.arms[i];
        }
      }
  }

  template <int dim>
  void sum_of_platens(const RigidBodies<dim> &bodies, BodyValues<dim> &values,
                      const MPI_Comm communicator)
  {
    const unsigned int n = std::count_if(bodies.begin(), bodies.end(),
                                         [](const RigidBody<dim> &body)
                                         { return body.platen != nullptr; });
    if (n > 0)
      MPI_Allreduce(MPI_IN_PLACE, values.data(), n_body_motions<dim> * n,
                    MPI_DOUBLE, MPI_SUM, communicator);
  }

  template <int dim>
  BodyValues<dim> body_forces(const RigidBodies<dim> &bodies,
                              const AlignedArray<dealii::Tensor<1, dim>> &force,
                              const MPI_Comm communicator)
  {
    BodyValues<dim> result(bodies.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (unsigned int i = 0; i < bodies[b].nodes.size(); ++i)
      {
        const dealii::Tensor<1, dim> &f = force[bodies[b].nodes[i]];
        add_to_vector(result[b], 0, f);
        if constexpr (dim == 2)
          result[b][2] += cross(bodies[b].present_arms[i], f);
        else
          add_to_vector<dim>(
              result[b], 1,
              dealii::cross_product_3d(bodies[b].present_arms[i], f));
      }
    sum_of_platens(bodies, result, communicator);
    return result;
  }

  template <int dim>
  BodyValues<dim> body_loads(const RigidBodies<dim> &bodies,
                             const TimePoint &time)
  {
    BodyValues<dim> result(bodies.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const MotionConstraint<dim> *platen = bodies[b].platen;
      if (!platen)
        continue;
      const double share = platen->rigid_motion()->force_share(time.stage);
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        if (!bodies[b].given[d])
          result[b][d] = share * body_component(*platen, d).value(time);
    }
    return result;
  }

  template <int dim>
  std::array<double, n_body_motions<dim>>
  kept_values(const RigidBodies<dim> &bodies, const unsigned int b,
              const std::vector<double> &platens,
              const std::vector<double> &blocks)
  {
    const auto first
        = bodies[b].platen
              ? platens.begin() + n_body_motions<dim> * std::ptrdiff_t(b)
              : blocks.begin() + 3 * std::ptrdiff_t(bodies[b].rigid_block);
    std::array<double, n_body_motions<dim>> result;
    std::copy_n(first, result.size(), result.begin());
    return result;
  }

  template <int dim>
  void keep_values(const RigidBodies<dim> &bodies,
                   const BodyValues<dim> &values, const unsigned int n_blocks,
                   std::vector<double> &platens, std::vector<double> &blocks)
  {
    platens.clear();
    blocks.assign(3 * std::size_t(n_blocks), 0.);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].platen)
        platens.insert(platens.end(), values[b].begin(), values[b].end());
      else
        std::copy(values[b].begin(), values[b].end(),
                  blocks.begin() + 3 * std::ptrdiff_t(bodies[b].rigid_block));
  }

  template <int dim>
  void add_body_forces(const RigidBodies<dim> &bodies,
                       const BodyValues<dim> &force,
                       dealii::TrilinosWrappers::MPI::Vector &right_hand_side)
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        if (bodies[b].counts && !bodies[b].given[d])
          right_hand_side(bodies[b].first + d) += force[b][d];
  }

  template Configuration<2> configuration_of(const RigidBodies<2> &,
                                             const State<2> &);
  template void write_configuration(const RigidBodies<2> &,
                                    const Configuration<2> &, State<2> &);
  template void place_nodes(const RigidBodies<2> &, Configuration<2> &);
  template void sum_of_platens(const RigidBodies<2> &, BodyValues<2> &,
                               MPI_Comm);
  template BodyValues<2> body_forces(const RigidBodies<2> &,
                                     const AlignedArray<dealii::Tensor<1, 2>> &,
                                     MPI_Comm);
  template BodyValues<2> body_loads(const RigidBodies<2> &, const TimePoint &);
  template std::array<double, 3> kept_values(const RigidBodies<2> &,
                                             unsigned int,
                                             const std::vector<double> &,
                                             const std::vector<double> &);
  template void keep_values(const RigidBodies<2> &, const BodyValues<2> &,
                            unsigned int, std::vector<double> &,
                            std::vector<double> &);
  template void add_body_forces(const RigidBodies<2> &, const BodyValues<2> &,
                                dealii::TrilinosWrappers::MPI::Vector &);

  template const LoadComponent &body_component(const MotionConstraint<2> &,
                                               unsigned int);
  template Configuration<3> configuration_of(const RigidBodies<3> &,
                                             const State<3> &);
  template void write_configuration(const RigidBodies<3> &,
                                    const Configuration<3> &, State<3> &);
  template void place_nodes(const RigidBodies<3> &, Configuration<3> &);
  template void sum_of_platens(const RigidBodies<3> &, BodyValues<3> &,
                               MPI_Comm);
  template BodyValues<3> body_forces(const RigidBodies<3> &,
                                     const AlignedArray<dealii::Tensor<1, 3>> &,
                                     MPI_Comm);
  template BodyValues<3> body_loads(const RigidBodies<3> &, const TimePoint &);
  template std::array<double, 6> kept_values(const RigidBodies<3> &,
                                             unsigned int,
                                             const std::vector<double> &,
                                             const std::vector<double> &);
  template void keep_values(const RigidBodies<3> &, const BodyValues<3> &,
                            unsigned int, std::vector<double> &,
                            std::vector<double> &);
  template void add_body_forces(const RigidBodies<3> &, const BodyValues<3> &,
                                dealii::TrilinosWrappers::MPI::Vector &);
  template const LoadComponent &body_component(const MotionConstraint<3> &,
                                               unsigned int);
} // namespace quoin
