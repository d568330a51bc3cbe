// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_state.h>
#include <quoin/implicit/reactions.h>

#include <algorithm>

namespace quoin
{
  template <int dim>
  void book_work(const Model<dim> &model, DofMap<dim> &dof_map,
                 const StaticFarField *far_field, const State<dim> &state,
                 const Balance<dim> &start,
                 const Configuration<dim> &configuration,
                 const Balance<dim> &balance, EnergyAccounts &energy)
  {
    const MPI_Comm communicator = model.nodes().communicator();
    // Work by the trapezoidal rule, of loads and of reactions of prescribed
    // motions; that of released forces counts as damping.
    const auto &held    = state.template get<ImplicitState>().held;
    const double left_0 = 1. - state.template get<ImplicitState>().released;
    const double left_1 = 1. - configuration.released;
    const double mean   = 0.5 * (left_0 + left_1);
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double u = configuration.nodes[i].u[d] - state.nodes[i].u[d];
        double force   = 0.5 * (start.external[i][d] + balance.external[i][d]);
        const double out_of_balance
            = 0.5 * (start.force[i][d] + balance.force[i][d]);
        if (dof_map.is_free(i, d))
          energy.damping += out_of_balance * u;
        else if (!dof_map.is_in_body(i))
          force -= out_of_balance;
        energy.external += force * u;
        if (!held.empty())
          energy.damping -= mean * held[dim * i + d] * u;
      }
    if (far_field)
      for (unsigned int k = 0; k < far_field->nodes().size(); ++k)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int node = far_field->nodes()[k];
          energy.external
              += state.template get<StaticFarFieldState>().held[dim * k + d]
                 * (configuration.nodes[node].u[d] - state.nodes[node].u[d]);
        }
    // Moments are in balance about the arms of their own configuration.
    const Configuration<dim> before = configuration_of(dof_map.bodies(), state);
    dof_map.update_arms(before);
    const auto forces_0
        = body_forces(dof_map.bodies(), start.force, communicator);
    dof_map.update_arms(configuration);
    const auto forces_1
        = body_forces(dof_map.bodies(), balance.force, communicator);
    for (unsigned int b = 0; b < before.bodies.size(); ++b)
    {
      const RigidBody<dim> &body = dof_map.bodies()[b];
      if (!body.counts)
        continue;
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
      {
        const double u      = configuration.bodies[b][d] - before.bodies[b][d];
        const double forces = 0.5 * (forces_0[b][d] + forces_1[b][d]);
        const double drives = 0.5 * (start.drives[b][d] + balance.drives[b][d]);
        energy.external += u * (body.given[d] ? -forces : drives);
        if (!body.given[d])
          energy.damping += u * (forces + drives);
      }
    }
  }

  template <int dim>
  Resultant<dim>
  platen_drive(const Model<dim> &model, const DofMap<dim> &dof_map,
               const Balance<dim> &balance, const MotionConstraint<dim> &platen)
  {
    Resultant<dim> result{};
    const auto forces = body_forces(dof_map.bodies(), balance.force,
                                    model.nodes().communicator());
    for (unsigned int b = 0; b < forces.size(); ++b)
      if (dof_map.bodies()[b].platen == &platen)
        for (unsigned int d = 0; d < result.size(); ++d)
          result[d] = dof_map.bodies()[b].given[d] ? -forces[b][d]
                                                   : balance.drives[b][d];
    return result;
  }

  template <int dim>
  Resultant<dim> reaction(const Model<dim> &model, const DofMap<dim> &dof_map,
                          const StaticFarField *far_field,
                          const Balance<dim> &balance,
                          const MotionConstraint<dim> &constraint)
  {
    const MPI_Comm communicator = model.nodes().communicator();
    if (constraint.traits().is_rigid_body())
      return platen_drive(model, dof_map, balance, constraint);
    Resultant<dim> result{};
    if constexpr (dim == 2)
      if (&constraint == far_field)
        result = balance.far_field_force;
    if (constraint.traits().kind == MotionKind::prescribed)
      for (const typename DofMap<dim>::Prescribed &given : dof_map.prescribed())
      {
        if (given.part != &(*constraint.parts())[given.component])
          continue;
        dealii::Tensor<1, dim> force;
        force[given.component] = -balance.force[given.node][given.component];
        add_force<dim>(force, model.nodes().point(given.node), result);
      }
    MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE,
                  MPI_SUM, communicator);
    return result;
  }

  template void book_work(const Model<2> &, DofMap<2> &, const StaticFarField *,
                          const State<2> &, const Balance<2> &,
                          const Configuration<2> &, const Balance<2> &,
                          EnergyAccounts &);
  template Resultant<2> platen_drive(const Model<2> &, const DofMap<2> &,
                                     const Balance<2> &,
                                     const MotionConstraint<2> &);
  template Resultant<2> reaction(const Model<2> &, const DofMap<2> &,
                                 const StaticFarField *, const Balance<2> &,
                                 const MotionConstraint<2> &);
  template void book_work(const Model<3> &, DofMap<3> &, const StaticFarField *,
                          const State<3> &, const Balance<3> &,
                          const Configuration<3> &, const Balance<3> &,
                          EnergyAccounts &);
  template Resultant<3> platen_drive(const Model<3> &, const DofMap<3> &,
                                     const Balance<3> &,
                                     const MotionConstraint<3> &);
  template Resultant<3> reaction(const Model<3> &, const DofMap<3> &,
                                 const StaticFarField *, const Balance<3> &,
                                 const MotionConstraint<3> &);
} // namespace quoin
