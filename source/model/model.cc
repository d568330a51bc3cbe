// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/mesh/kind_text.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/contact_bounds.h>
#include <quoin/operators/archive.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  template <int dim>
  Model<dim>::Model(const NodeMap<dim> &nodes,
                    const ModelParameters &parameters)
    : node_map(nodes),
      given(parameters), now{ parameters.materials, {}, parameters.joints }
  {
    const BlockTable<dim> &table = nodes.table();
    find_materials();
    find_thickness();
    absent_group
        = find_groups(table, parameters.absent_groups, "section 'Stages'");
    find_masses();
    find_initial_stress();
    pack_blocks({});
    if constexpr (dim == 2)
    {
      matched_joints.prepare(nodes, now.joints, group_thickness);
      bars.prepare(nodes, given.cables, group_thickness, block_forces);
      make_contacts();
    }
    else
      matched_joints.prepare(nodes, now.joints);
    if (!table.is_quadratic)
      find_stable_step();
  }

  template <int dim>
  void Model<dim>::find_materials()
  {
    constexpr unsigned int none           = -1;
    const std::vector<std::string> &names = node_map.table().group_names;
    now.material_of_group.assign(names.size(), none);
    for (unsigned int m = 0; m < now.materials.size(); ++m)
    {
      const auto &material = now.materials[m];
      for (const auto &group : material.groups)
      {
        const auto found = std::find(names.begin(), names.end(), group);
        if (found == names.end())
          throw InputError(
              "section 'Materials/" + material.name + "': the mesh has no "
              + group_kind<dim> + " '" + group + "'. It has: "
              + known_names_like(group, names) + ". Correct 'Groups'.");
        unsigned int &owner = now.material_of_group[found - names.begin()];
        if (owner != none)
          throw InputError("section 'Materials/" + material.name
                           + "': " + group_kind<dim> + " '" + group
                           + "' is made of '" + now.materials[owner].name
                           + "' already. Name it once.");
        owner = m;
      }
    }
    for (unsigned int g = 0; g < now.material_of_group.size(); ++g)
    {
      if (now.material_of_group[g] == none)
        throw InputError(std::string("section 'Materials': ")
                         + group_kind<dim> + " '" + names[g]
                         + "' has no material. Add it to the 'Groups' of "
                           "one.");
    }
  }

  template <int dim>
  void Model<dim>::find_thickness()
  {
    for (MaterialParameters &material : now.materials)
      if (material.thickness == 0.)
        material.thickness = given.thickness;
    std::vector<double> of_groups;
    for (const unsigned int material : now.material_of_group)
      of_groups.push_back(now.materials[material].thickness);
    group_thickness = Thickness(of_groups);
  }

  template <int dim>
  void Model<dim>::find_masses()
  {
    std::vector<double> density;
    for (const unsigned int material : now.material_of_group)
      density.push_back(now.materials[material].elastic.density);
    node_mass = lumped_masses(node_map, density, group_thickness);
    if constexpr (dim == 2)
      rigid.prepare(node_map, density, group_thickness);
  }

  template <int dim>
  CellStiffness<dim>
  Model<dim>::stiffness_of(const MaterialParameters &material) const
  {
    if constexpr (dim == 2)
      return plane_stiffness(material.elastic, given.plane);
    else
      return space_stiffness(material.elastic);
  }

  template <int dim>
  std::vector<std::optional<YieldLaw<dim>>>
  Model<dim>::laws_of(const std::vector<MaterialParameters> &materials) const
  {
    std::vector<std::optional<YieldLaw<dim>>> laws(materials.size());
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (materials[m].strength)
      {
        if constexpr (dim == 2)
          laws[m].emplace(materials[m].elastic, *materials[m].strength,
                          given.plane);
        else
          laws[m].emplace(materials[m].elastic, *materials[m].strength);
      }
    return laws;
  }

  template <int dim>
  void Model<dim>::pack_blocks(const ConstructionState<dim> &construction)
  {
    BlockForcesData<dim> data;
    take_cells(node_map, data);
    for (const MaterialParameters &material : now.materials)
      data.stiffness.push_back(stiffness_of(material));
    for (unsigned int c = 0; c < node_map.cells().n_deformable; ++c)
      data.cell_stiffness.push_back(material_of_cell(c));
    data.laws                         = laws_of(now.materials);
    const AlignedArray<double> stress = construction.initial_stress.empty()
                                            ? packed_initial_stress()
                                            : construction.initial_stress;
    constexpr unsigned int n          = ConstructionState<dim>::n_stresses;
    data.initial_stress.resize(stress.size() / n);
    for (unsigned int c = 0; c < data.initial_stress.size(); ++c)
      std::copy_n(&stress[n * c], n, data.initial_stress[c].begin());
    if constexpr (dim == 2)
    {
      data.quadratic = node_map.table().is_quadratic;
      std::vector<double> thickness;
      for (const MaterialParameters &material : now.materials)
        thickness.push_back(material.thickness);
      data.thickness = Thickness(thickness);
    }
    block_forces.prepare(data);
  }

  template <>
  void Model<2>::make_contacts()
  {
    if (!given.large_displacements || node_map.table().is_quadratic)
      return;
    ContactModel contacts;
    contacts.parameters = given.contact;
    contacts.sets       = now.joints;
    for (const MaterialParameters &material : now.materials)
      contacts.materials.push_back(material.name);
    contacts.material_of_group = now.material_of_group;
    contacts.thickness         = group_thickness;
    block_contacts
        = std::make_unique<BlockContacts>(node_map, matched_joints, contacts);
  }

  // -- the stable step -------------------------------------------------------

  template <int dim>
  std::vector<const ForceOperator<dim> *> Model<dim>::stiff_operators() const
  {
    std::vector<const ForceOperator<dim> *> operators = { &block_forces };
    if constexpr (dim == 2)
    {
      // Contacts stand for joints, too, which may become contacts.
      if (block_contacts)
        operators.push_back(block_contacts.get());
      else
        operators.push_back(&matched_joints);
      if (!bars.empty())
        operators.push_back(&bars);
    }
    else
      operators.push_back(&matched_joints);
    return operators;
  }

  template <int dim>
  StableTimeStep<dim> Model<dim>::stability_at(const State<dim> &state,
                                               const bool with_springs) const
  {
    std::vector<NodeStiffness<dim>> bound(node_map.n_local(),
                                          NodeStiffness<dim>{});
    const NodeRatio ratio = spring_ratio(state);
    for (const ForceOperator<dim> *each : stiff_operators())
      if (with_springs || each->is_internal())
        each->add_stiffness_bound(state, ratio, bound);
    node_map.exchange().add_to_owners(bound.data());
    bound.resize(node_map.n_owned());
    std::vector<double> rigid_bound;
    if constexpr (dim == 2)
    {
      for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        rigid_bound.push_back(rigid.largest_eigenvalue(b, bound));
      if (with_springs)
        add_dashpot_bound(bound, rigid_bound);
    }
    std::fill(bound.begin() + node_map.n_deformable_nodes(), bound.end(),
              NodeStiffness<dim>{});
    StableTimeStep<dim> result(bound);
    result.set_rigid_blocks(rigid_bound);
    return result;
  }

  template <int dim>
  void Model<dim>::find_stable_step()
  {
    stable_step
        = std::make_unique<StableTimeStep<dim>>(stability_at(initial_state()));
  }

  template <>
  NodeRatio Model<3>::spring_ratio(const State<3> &) const
  {
    return [this](const unsigned int a, const unsigned int b)
    { return node_mass[a] / node_mass[b]; };
  }

  template <>
  NodeRatio Model<2>::spring_ratio(const State<2> &state) const
  {
    const auto by_mass = [this](const unsigned int a, const unsigned int b)
    { return node_mass[a] / node_mass[b]; };
    const auto &is_rigid = node_map.table().is_rigid;
    if (std::find(is_rigid.begin(), is_rigid.end(), true) == is_rigid.end())
      return by_mass;

    // omega^2 of each body, node or rigid block, if the other side of its
    // joints were fixed. Springs are divided in the ratio of these, because a
    // rigid block may have any number of them: no bound then exceeds the sum of
    // those of two bodies.
    std::vector<NodeStiffness<2>> springs(node_map.n_local(),
                                          NodeStiffness<2>{});
    for (const ForceOperator<2> *each : stiff_operators())
      if (!each->is_internal())
        each->add_stiffness_bound(
            state, [](unsigned int, unsigned int) { return 0.; }, springs);
    std::vector<double> own(node_map.n_local(), 0.);
    for (unsigned int i = 0; i < node_map.n_deformable_nodes(); ++i)
      own[i] = StableTimeStep<2>({ springs[i] })
                   .largest_eigenvalue({ node_mass[i] });
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      std::fill(own.begin() + rigid.block(b).begin,
                own.begin() + rigid.block(b).end,
                rigid.largest_eigenvalue(b, springs));
    node_map.exchange().update_ghosts(own.data());
    return [this, by_mass, own](const unsigned int a, const unsigned int b)
    {
      const auto &is_rigid = node_map.table().is_rigid;
      return is_rigid[node_map.block_of_node(a)]
                     || is_rigid[node_map.block_of_node(b)]
                 ? own[b] / own[a]
                 : by_mass(a, b);
    };
  }

  template <>
  void Model<2>::add_dashpot_bound(std::vector<NodeStiffness<2>> &bound,
                                   std::vector<double> &rigid_bound) const
  {
    if (std::none_of(now.joints.begin(), now.joints.end(),
                     [](const JointSetParameters &set)
                     { return set.damping.acts(); }))
      return;
    double impedance = 0.;
    for (const auto &[p, s] : group_impedances(now, given.plane))
      if (std::isfinite(p))
        impedance = std::max(impedance, p);
    DampingBound damping;
    damping.dashpot.assign(node_map.n_deformable_nodes(), 0.);
    damping.share.assign(node_map.table().n_blocks(), 0.);
    for (const ForceOperator<2> *each : stiff_operators())
      each->add_damping_bound(block_masses(node_map, node_mass), impedance,
                              damping);
    /** omega^2 of undamped steps as short as those with dashpots of the rate
        c/m: h^2 omega^2 + 2 h rate = 4 there. */
    const auto damped = [](const double eigenvalue, const double rate)
    {
      const double omega = rate + std::sqrt(rate * rate + eigenvalue);
      return omega * omega;
    };
    for (unsigned int i = 0; i < node_map.n_deformable_nodes(); ++i)
    {
      const double own = StableTimeStep<2>({ bound[i] })
                             .largest_eigenvalue({ node_mass[i] });
      const double rate = damping.dashpot[i] / node_mass[i];
      for (unsigned int c = 0; c < 2; ++c)
        bound[i][c] += node_mass[i] * (damped(own, rate) - own);
    }
    const unsigned int first = node_map.blocks().n_deformable;
    for (unsigned int r = 0; r < rigid_bound.size(); ++r)
      // On springs of its own, between two others.
      rigid_bound[r]
          = damped(rigid_bound[r],
                   damping.share[node_map.blocks().parts[first + r].number]
                       * std::sqrt(8. * rigid_bound[r]));
  }

  template <int dim>
  State<dim> Model<dim>::initial_state() const
  {
    State<dim> state;
    state.template add<RigidBlockStates>().resize(rigid.n_blocks());
    state.template add<ConstructionState<dim>>();
    for (unsigned int i = 0; i < node_map.n_local(); ++i)
    {
      state.nodes.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        state.nodes[i].X[d] = node_map.point(i)[d];
    }
    state.velocity.assign(node_map.n_local(), dealii::Tensor<1, dim>());
    block_forces.prepare(state);
    matched_joints.prepare(state);
    if constexpr (dim == 2)
      bars.prepare(state);
    if (!face_stress.empty())
      initialise_joints(matched_joints, face_stress, state);
    if (std::find(absent_group.begin(), absent_group.end(), true)
        == absent_group.end())
      return state;
    for (const unsigned int group : node_map.table().group)
      state.block_marks.push_back(absent_group[group] ? block_mark::absent
                                                      : block_mark::present);
    for (unsigned int i = 0; i < joint_faces(matched_joints).size(); ++i)
      if (is_at_absent_block(*this, i, state))
        detach_joint(i, state.template get<JointHistoryOf<dim>>());
    return state;
  }
  template class Model<2>;
  template class Model<3>;
} // namespace quoin
