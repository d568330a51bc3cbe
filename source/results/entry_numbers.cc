// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/entry_numbers.h>

namespace quoin
{
  namespace
  {
    using List = EntryNumbers::List;

    template <int dim>
    List nodes_of(const MotionConstraint<dim> &constraint,
                  const NodeMap<dim> &nodes)
    {
      List result;
      for (const unsigned int node : constraint.nodes())
        result.push_back(nodes.number_of_node(node));
      return result;
    }

    /** Numbers of entries that exist in two dimensions only. */
    void number_plane_entries(const Model<2> &model, const Solver<2> &solver,
                              EntryNumbers &result)
    {
      const NodeMap<2> &nodes = model.nodes();
      if (const FarField *far = solver.loads().far.elastodynamic)
        result.own[FarFieldState::slice_name] = nodes_of(*far, nodes);
      if (const StaticFarField *far = solver.loads().far.elastostatic)
        result.own[StaticFarFieldState::slice_name] = nodes_of(*far, nodes);

      if (const BlockContacts *contacts = model.contacts())
      {
        const std::string name = ContactState::slice_name;
        List &watched          = result.own[name];
        for (const unsigned int node :
             contacts->contact_edges().boundary_nodes())
          watched.push_back(nodes.number_of_node(node));
        List &edges = result.own[EntryNumbers::edges_of(name)];
        for (const ContactEdge &edge : contacts->contact_edges().own())
          edges.push_back(edge.number);
      }
    }

    /** Numbers of the faces @p joints of this rank, in their order. */
    template <int dim, typename Joints>
    List numbers_of(const NodeMap<dim> &nodes, const Joints &joints)
    {
      List result;
      for (const auto &joint : joints)
        result.push_back(nodes.faces().joints[joint.face].number);
      return result;
    }
  } // namespace

  template <int dim>
  EntryNumbers number_entries(const Model<dim> &model,
                              const Solver<dim> &solver)
  {
    const NodeMap<dim> &nodes = model.nodes();
    EntryNumbers result;
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      result.nodes.push_back(nodes.number_of_node(i));
    result.n_owned_nodes = nodes.n_owned();
    const auto &cells    = nodes.cells().number;
    result.cells.assign(cells.begin(),
                        cells.begin() + nodes.cells().n_deformable);

    for (const auto &constraint : solver.loads().constraints)
      result.own[constraint->name()] = nodes_of(*constraint, nodes);
    List &blocks = result.own[RigidBlockStates::slice_name];
    for (unsigned int part = nodes.blocks().n_deformable;
         part < nodes.blocks().parts.size(); ++part)
      blocks.push_back(nodes.blocks().parts[part].number);
    if constexpr (dim == 2)
    {
      number_plane_entries(model, solver, result);
      result.own[JointHistory::slice_name]
          = numbers_of(nodes, model.joints().segments());
    }
    else
      result.own[SpaceJointHistory::slice_name]
          = numbers_of(nodes, model.joints().faces());
    return result;
  }

  template <int dim>
  EntryNumbers number_entries_of(const State<dim> &state,
                                 const Model<dim> &model,
                                 const Solver<dim> &solver)
  {
    EntryNumbers result = number_entries(model, solver);
    if (state.template get<PlasticHistory>().yielding.empty()
        && state.template get<ConstructionState<dim>>().initial_stress.empty())
      result.cells.clear();
    return result;
  }

  template EntryNumbers number_entries(const Model<2> &, const Solver<2> &);
  template EntryNumbers number_entries_of(const State<2> &, const Model<2> &,
                                          const Solver<2> &);
  template EntryNumbers number_entries(const Model<3> &, const Solver<3> &);
  template EntryNumbers number_entries_of(const State<3> &, const Model<3> &,
                                          const Solver<3> &);
} // namespace quoin
