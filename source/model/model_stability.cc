// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/model/contact_bounds.h>
#include <quoin/model/model_stability.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** The operators that bound the stable step. */
    template <int dim>
    std::vector<const ForceOperator<dim> *>
    stiff_operators(const Model<dim> &model)
    {
      std::vector<const ForceOperator<dim> *> operators = { &model.blocks() };
      if constexpr (dim == 2)
      {
        // Contacts stand for joints, too, which may become contacts.
        if (model.contacts())
          operators.push_back(model.contacts());
        else
          operators.push_back(&model.joints());
        if (!model.reinforcement().empty())
          operators.push_back(&model.reinforcement());
      }
      else
        operators.push_back(&model.joints());
      return operators;
    }

    // In what ratio springs are divided between nodes. Collective.
    NodeRatio spring_ratio(const Model<3> &model, const State<3> &)
    {
      const std::vector<double> &mass = model.mass();
      return [&mass](const unsigned int a, const unsigned int b)
      { return mass[a] / mass[b]; };
    }

    NodeRatio spring_ratio(const Model<2> &model, const State<2> &state)
    {
      const NodeMap<2> &nodes         = model.nodes();
      const RigidBlocks &rigid        = model.rigid_blocks();
      const std::vector<double> &mass = model.mass();
      const auto by_mass = [&mass](const unsigned int a, const unsigned int b)
      { return mass[a] / mass[b]; };
      const auto &is_rigid = nodes.table().is_rigid;
      if (std::find(is_rigid.begin(), is_rigid.end(), true) == is_rigid.end())
        return by_mass;

      // omega^2 of each body, node or rigid block, if the other side of its
      // joints were fixed. Springs are divided in the ratio of these, because a
      // rigid block may have any number of them: no bound then exceeds the sum
      // of those of two bodies.
      std::vector<NodeStiffness<2>> springs(nodes.n_local(),
                                            NodeStiffness<2>{});
      for (const ForceOperator<2> *each : stiff_operators(model))
        if (!each->is_internal())
          each->add_stiffness_bound(
              state, [](unsigned int, unsigned int) { return 0.; }, springs);
      std::vector<double> own(nodes.n_local(), 0.);
      for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
        own[i]
            = StableTimeStep<2>({ springs[i] }).largest_eigenvalue({ mass[i] });
      for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        std::fill(own.begin() + rigid.block(b).begin,
                  own.begin() + rigid.block(b).end,
                  rigid.largest_eigenvalue(b, springs));
      nodes.exchange().update_ghosts(own.data());
      return [&nodes, by_mass, own](const unsigned int a, const unsigned int b)
      {
        const auto &is_rigid = nodes.table().is_rigid;
        return is_rigid[nodes.block_of_node(a)]
                       || is_rigid[nodes.block_of_node(b)]
                   ? own[b] / own[a]
                   : by_mass(a, b);
      };
    }

    /** Adds to both bounds, of owned nodes [N/m] and of rigid blocks [1/s^2],
        what dashpots take of the step. Collective. */
    template <int dim>
    void add_dashpot_bound(const Model<dim> &model,
                           std::vector<NodeStiffness<dim>> &bound,
                           std::vector<double> &rigid_bound)
    {
      const NodeMap<dim> &nodes       = model.nodes();
      const std::vector<double> &mass = model.mass();
      const ModelProperties &now      = model.properties();
      if (std::none_of(now.joints.begin(), now.joints.end(),
                       [](const JointSetParameters &set)
                       { return set.damping.acts(); }))
        return;
      double impedance = 0.;
      for (const auto &[p, s] : group_impedances(now, model.parameters().plane))
        if (std::isfinite(p))
          impedance = std::max(impedance, p);
      DampingBound damping;
      damping.dashpot.assign(nodes.n_deformable_nodes(), 0.);
      damping.share.assign(nodes.table().n_blocks(), 0.);
      const auto masses = dashpot_masses(model);
      for (const ForceOperator<dim> *each : stiff_operators(model))
        each->add_damping_bound(masses, impedance, damping);
      /** omega^2 of undamped steps as short as those with dashpots of twice
          the @p rate, for several pairs of blocks at one node:
          h^2 omega^2 + 4 h rate = 4 there. */
      const auto damped = [](const double eigenvalue, const double rate)
      {
        const double omega = rate + std::sqrt(rate * rate + eigenvalue);
        return omega * omega;
      };
      for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      {
        const double own
            = StableTimeStep<dim>({ bound[i] }).largest_eigenvalue({ mass[i] });
        const double rate = damping.dashpot[i] / mass[i];
        for (unsigned int c = 0; c < dim; ++c)
          bound[i][c] += mass[i] * (damped(own, rate) - own);
      }
      const unsigned int first = nodes.blocks().n_deformable;
      for (unsigned int r = 0; r < rigid_bound.size(); ++r)
        // On springs of its own, between two others.
        rigid_bound[r]
            = damped(rigid_bound[r],
                     damping.share[nodes.blocks().parts[first + r].number]
                         * std::sqrt(8. * rigid_bound[r]));
    }
  } // namespace

  template <int dim>
  StableTimeStep<dim> stability_at(const Model<dim> &model,
                                   const State<dim> &state,
                                   const bool with_springs)
  {
    const NodeMap<dim> &nodes = model.nodes();
    std::vector<NodeStiffness<dim>> bound(nodes.n_local(),
                                          NodeStiffness<dim>{});
    const NodeRatio ratio = spring_ratio(model, state);
    for (const ForceOperator<dim> *each : stiff_operators(model))
      if (with_springs || each->is_internal())
        each->add_stiffness_bound(state, ratio, bound);
    nodes.exchange().add_to_owners(bound.data());
    bound.resize(nodes.n_owned());
    std::vector<double> rigid_bound;
    if constexpr (dim == 2)
    {
      const RigidBlocks &rigid = model.rigid_blocks();
      for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        rigid_bound.push_back(rigid.largest_eigenvalue(b, bound));
    }
    if (with_springs)
      add_dashpot_bound(model, bound, rigid_bound);
    std::fill(bound.begin() + nodes.n_deformable_nodes(), bound.end(),
              NodeStiffness<dim>{});
    StableTimeStep<dim> result(bound);
    result.set_rigid_blocks(rigid_bound);
    return result;
  }

  template StableTimeStep<2> stability_at(const Model<2> &, const State<2> &,
                                          bool);
  template StableTimeStep<3> stability_at(const Model<3> &, const State<3> &,
                                          bool);
} // namespace quoin
