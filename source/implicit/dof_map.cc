// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/constants.h>
#include <quoin/implicit/dof_map.h>
#include <quoin/motions/prescribed_motion.h>
#include <quoin/motions/space_platen.h>
#include <quoin/model/block_placement.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <type_traits>

namespace quoin
{
  namespace
  {
    /** Halves [a, b] up to @p depth times where the function has a kink. */
    double integral(const std::function<double(double)> &function,
                    const double a, const double b, const unsigned int depth)
    {
      using boost::math::quadrature::gauss_kronrod;
      double error = 0.;
      const double whole
          = gauss_kronrod<double, 15>::integrate(function, a, b, 0, 0., &error);
      error *= 0.5 * std::abs(b - a); // which is that on [-1, 1]
      if (depth == 0 || error <= 1e-10 * std::abs(whole))
        return whole;
      const double middle = 0.5 * (a + b);
      return integral(function, a, middle, depth - 1)
             + integral(function, middle, b, depth - 1);
    }

    /** Largest component of the @p arms [m]. */
    template <int dim>
    double largest_component(const std::vector<dealii::Tensor<1, dim>> &arms)
    {
      double largest = 0.;
      for (const dealii::Tensor<1, dim> &arm : arms)
        for (unsigned int d = 0; d < dim; ++d)
          largest = std::max(largest, std::abs(arm[d]));
      return largest;
    }
  } // namespace

  template <int dim>
  double given_change(const LoadComponent &component, const double from,
                      const double to, const double stage_start,
                      const dealii::Point<dim> &place)
  {
    dealii::Point<3> at;
    for (unsigned int d = 0; d < dim; ++d)
      at[d] = place[d];
    const auto value = [&](const double t) {
      return component.at(at, { t, stage_start + t });
    };
    if (component.quantity == LoadQuantity::displacement)
      return value(to) - value(from);
    if (component.quantity != LoadQuantity::velocity || from == to)
      return 0.;
    // The integral is taken in pieces, so that short pulses are not missed.
    constexpr unsigned int n = 16;
    double change            = 0.;
    for (unsigned int i = 0; i < n; ++i)
      change += integral(value, from + (to - from) * i / n,
                         from + (to - from) * (i + 1) / n, 15);
    return change;
  }

  template <int dim>
  DofMap<dim>::DofMap(const Model<dim> &model,
                      const std::vector<MotionConstraint<dim> *> &constraints,
                      const std::vector<bool> &held, const State<dim> &state,
                      const bool has_factor)
    : model(model), communicator(model.nodes().communicator()),
      stage_start(state.load_start()), absent(absent_nodes(model, state)),
      ties(model.nodes().n_local(),
           { dealii::numbers::invalid_dof_index, {}, {} })
  {
    add_platens(constraints, state);
    if constexpr (dim == 2)
      add_rigid_blocks(held);
    number(has_factor);

    // The last constraint that acts on a node prevails.
    const unsigned int n = model.nodes().n_owned();
    std::vector<std::array<const LoadComponent *, dim>> owner(n);
    for (const MotionConstraint<dim> *constraint : constraints)
      if (constraint->traits().kind == MotionKind::prescribed)
        for (const unsigned int node : constraint->nodes())
          for (unsigned int d = 0; d < dim; ++d)
            if (constraint->traits().holds[d])
              owner[node][d] = &(*constraint->parts())[d];
    for (unsigned int node = 0; node < n; ++node)
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (owner[node][d] && !is_in_body(node) && !absent[node])
          prescribed_list.push_back({ node, d, owner[node][d] });
        ties[node].given[d] = owner[node][d] || absent[node];
      }
    update_constraints(configuration_of(body_list, state), state.load_time);
  }

  template <int dim>
  void DofMap<dim>::add_platens(
      const std::vector<MotionConstraint<dim> *> &constraints,
      const State<dim> &state)
  {
    using PlatenStateOf
        = std::conditional_t<dim == 2, PlatenState, SpacePlatenState>;
    for (const MotionConstraint<dim> *platen : constraints)
    {
      if (!platen->traits().is_rigid_body())
        continue;
      const auto &now = state.template get<PlatenStateOf>(platen->name());
      RigidBody<dim> body;
      body.platen      = platen;
      body.rigid_block = -1;
      body.nodes       = platen->nodes();
      for (unsigned int d = 0; d < body.given.size(); ++d)
      {
        const LoadQuantity quantity = body_component(*platen, d).quantity;
        body.given[d]               = quantity == LoadQuantity::velocity
                        || quantity == LoadQuantity::displacement;
      }
      body.counts = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      body.centre = now.centre;
      for (unsigned int i = 0; i < body.nodes.size(); ++i)
        body.arms.push_back(vector_at<dim>(now.arms, i));
      // The rank that counts a platen may have none of its nodes.
      body.reach = dealii::Utilities::MPI::max(largest_component(body.arms),
                                               communicator);
      body_list.push_back(body);
    }
    n_platens = body_list.size();
  }

  template <>
  void DofMap<2>::add_rigid_blocks(const std::vector<bool> &held)
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
    {
      if (held[b])
        continue;
      const RigidBlocks::Block &block = rigid.block(b);
      RigidBody<2> body;
      body.platen      = nullptr;
      body.rigid_block = b;
      body.given       = { { false, false, false } };
      body.counts      = true;
      body.centre      = block.centre;
      for (unsigned int i = block.begin; i < block.end; ++i)
      {
        const auto &X = model.nodes().point(i);
        body.nodes.push_back(i);
        body.arms.push_back(X - block.centre);
      }
      body.reach = largest_component(body.arms);
      body_list.push_back(body);
    }
  }

  template <int dim>
  void DofMap<dim>::number(const bool has_factor)
  {
    const NodeExchange &exchange = model.nodes().exchange();
    const DofIndex first_body    = dim * DofIndex(exchange.n_global());
    const DofIndex first_rigid   = first_body + dofs_per_body * n_platens;
    const dealii::IndexSet rigid
        = dealii::Utilities::MPI::create_ascending_partitioning(
            communicator,
            dofs_per_body * DofIndex(body_list.size() - n_platens))
            [dealii::Utilities::MPI::this_mpi_process(communicator)];

    owned_dofs
        = dealii::IndexSet(first_rigid + rigid.size() + (has_factor ? 1 : 0));
    if (has_factor)
      factor_dof = first_rigid + rigid.size();
    if (exchange.n_owned() > 0)
    {
      const DofIndex first = dim * DofIndex(exchange.global(0));
      owned_dofs.add_range(first, first + dim * exchange.n_owned());
    }
    owned_dofs.add_indices(rigid, first_rigid);
    if (has_factor
        && dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      owned_dofs.add_index(factor_dof);
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      RigidBody<dim> &body = body_list[b];
      body.first
          = b < n_platens
                ? first_body + dofs_per_body * b
                : first_rigid
                      + rigid.nth_index_in_set(dofs_per_body * (b - n_platens));
      if (body.counts)
        owned_dofs.add_range(body.first, body.first + dofs_per_body);
      for (const unsigned int node : body.nodes)
        ties[node].body = body.first;
    }
    owned_dofs.compress();

    exchange.update_ghosts(ties.data());
    relevant_dofs = owned_dofs;
    if (has_factor)
      relevant_dofs.add_index(factor_dof);
    has_bodies = !body_list.empty();
    for (unsigned int b = 0; b < n_platens; ++b)
      relevant_dofs.add_range(body_list[b].first,
                              body_list[b].first + dofs_per_body);
    for (unsigned int i = 0; i < exchange.n_local(); ++i)
    {
      const DofIndex first = dim * DofIndex(exchange.global(i));
      for (unsigned int d = 0; d < dim; ++d)
        node_dofs.push_back(first + d);
      if (i < exchange.n_owned())
        continue;
      relevant_dofs.add_range(first, first + dim);
      if (!is_in_body(i))
        continue;
      relevant_dofs.add_range(ties[i].body, ties[i].body + dofs_per_body);
      has_bodies = true;
    }
    relevant_dofs.compress();
  }

  template <int dim>
  void DofMap<dim>::update_arms(const Configuration<dim> &configuration)
  {
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      RigidBody<dim> &body = body_list[b];
      body.present_arms.resize(body.arms.size());
      if constexpr (dim == 2)
      {
        const double c = std::cos(configuration.bodies[b][2]),
                     s = std::sin(configuration.bodies[b][2]);
        for (unsigned int i = 0; i < body.arms.size(); ++i)
        {
          const double x = body.arms[i][0], y = body.arms[i][1];
          body.present_arms[i]
              = dealii::Point<dim>(c * x - s * y, s * x + c * y);
        }
      }
      else
        for (unsigned int i = 0; i < body.arms.size(); ++i)
          body.present_arms[i] = configuration.turned[b] * body.arms[i];
    }
  }

  template <int dim>
  void DofMap<dim>::update_constraints(const Configuration<dim> &configuration,
                                       const double load_time)
  {
    update_arms(configuration);
    const double before = configuration.load_time;
    for (const Prescribed &p : prescribed_list)
      ties[p.node].motion[p.component] = given_change(
          *p.part, before, load_time, stage_start, model.nodes().point(p.node));
    for (const RigidBody<dim> &body : body_list)
      for (unsigned int i = 0; i < body.nodes.size(); ++i)
        ties[body.nodes[i]].motion = body.present_arms[i];
    model.nodes().exchange().update_ghosts(ties.data());

    // Without bodies only the inhomogeneities change.
    const bool are_new = has_bodies || affine.n_constraints() == 0;
    if (are_new)
      affine.reinit(relevant_dofs);
    for (unsigned int i = 0; i < ties.size(); ++i)
    {
      const Tie &tie = ties[i];
      if (is_in_body(i))
        add_tie(i);
      else
        for (unsigned int d = 0; d < dim; ++d)
          if (tie.given[d])
          {
            if (are_new)
              affine.add_line(dof(i, d));
            affine.set_inhomogeneity(dof(i, d), tie.motion[d]);
          }
    }
    for (const RigidBody<dim> &body : body_list)
    {
      if (dim == 2)
        affine.add_line(body.first + 3);
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        if (body.given[d])
        {
          affine.add_line(body.first + d);
          affine.set_inhomogeneity(body.first + d,
                                   given_motion(body, d, before, load_time));
        }
    }
    affine.close();
  }

  template <int dim>
  void DofMap<dim>::add_tie(const unsigned int node)
  {
    const Tie &tie = ties[node];
    for (unsigned int d = 0; d < dim; ++d)
    {
      affine.add_line(dof(node, d));
      affine.add_entry(dof(node, d), tie.body + d, 1.);
      if (dim == 2)
        affine.add_entry(dof(node, d), tie.body + 2,
                         d == 0 ? -tie.motion[1] : tie.motion[0]);
      else // dtheta x r
      {
        const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
        affine.add_entry(dof(node, d), tie.body + dim + e, tie.motion[f]);
        affine.add_entry(dof(node, d), tie.body + dim + f, -tie.motion[e]);
      }
    }
  }

  template <int dim>
  double DofMap<dim>::given_motion(const RigidBody<dim> &body,
                                   const unsigned int d, const double from,
                                   const double to) const
  {
    return given_change<dim>(body_component(*body.platen, d), from, to,
                             stage_start)
           * (d >= dim ? constants::degree : 1.);
  }

  template <int dim>
  void DofMap<dim>::move(const DofVector &increment, const double share,
                         const double load_time,
                         Configuration<dim> &configuration) const
  {
    const double before     = configuration.load_time;
    configuration.load_time = load_time;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (is_free(i, d))
          configuration.nodes[i].u[d] += share * increment(dof(i, d));
    for (const Prescribed &p : prescribed_list)
      configuration.nodes[p.node].u[p.component] += given_change(
          *p.part, before, load_time, stage_start, model.nodes().point(p.node));

    // All ranks have the platens; the first one solves for their motion.
    BodyValues<dim> changes(body_list.size());
    for (unsigned int b = 0; b < body_list.size(); ++b)
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        if (body_list[b].counts && !body_list[b].given[d])
          changes[b][d] = share * increment(body_list[b].first + d);
    sum_of_platens(body_list, changes, communicator);
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
      {
        if (body_list[b].given[d])
          changes[b][d] = given_motion(body_list[b], d, before, load_time);
        configuration.bodies[b][d] += changes[b][d];
      }
      if constexpr (dim == 3)
        configuration.turned[b] = rotation_by(vector_at<dim>(changes[b], 1))
                                  * configuration.turned[b];
    }
    place_nodes(body_list, configuration);
    model.nodes().exchange().update_ghosts(configuration.nodes.data());
  }

  template <int dim>
  void
  DofMap<dim>::add_forces(const AlignedArray<dealii::Tensor<1, dim>> &force,
                          DofVector &right_hand_side) const
  {
    const auto *values = reinterpret_cast<const double *>(force.data());
    affine.distribute_local_to_global(values,
                                      values + dim * model.nodes().n_owned(),
                                      node_dofs.begin(), right_hand_side);
  }

  template double given_change(const LoadComponent &, double, double, double,
                               const dealii::Point<2> &);
  template double given_change(const LoadComponent &, double, double, double,
                               const dealii::Point<3> &);
  template class DofMap<2>;
  template class DofMap<3>;
} // namespace quoin
