// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/mesh/kind_text.h>
#include <quoin/model/block_placement.h>
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
    if (dim == 3 && table.n_joint_faces > 0)
      throw InputError(
          "section 'Mesh': the mesh has " + std::to_string(table.n_joint_faces)
          + " joint faces between its blocks, but blocks in three "
            "dimensions have no joints. Make them one piece: leave "
            "'Joints along' and 'Joints between' empty, and let "
            "volumes that touch share their surface.");
    find_materials();
    find_thickness();
    absent_group
        = find_groups(table, parameters.absent_groups, "section 'Stages'");
    find_masses();
    if constexpr (dim == 2)
      find_initial_stress();
    pack_blocks({});
    if constexpr (dim == 2)
      matched_joints.prepare(nodes, now.joints, group_thickness);
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
  void Model<dim>::pack_blocks(const ConstructionState &construction)
  {
    BlockForcesData<dim> data;
    take_cells(node_map, data);
    for (const MaterialParameters &material : now.materials)
      data.stiffness.push_back(stiffness_of(material));
    for (unsigned int c = 0; c < node_map.cells().n_deformable; ++c)
      data.cell_stiffness.push_back(material_of_cell(c));
    if constexpr (dim == 2)
    {
      data.quadratic = node_map.table().is_quadratic;
      std::vector<double> thickness;
      for (const MaterialParameters &material : now.materials)
      {
        thickness.push_back(material.thickness);
        data.laws.emplace_back();
        if (material.strength)
          data.laws.back().emplace(material.elastic, *material.strength,
                                   given.plane);
      }
      data.thickness                    = Thickness(thickness);
      const AlignedArray<double> stress = construction.initial_stress.empty()
                                              ? packed_initial_stress()
                                              : construction.initial_stress;
      for (unsigned int c = 0; 4 * c < stress.size(); ++c)
        data.initial_stress.push_back(
            { { stress[4 * c], stress[4 * c + 1], stress[4 * c + 2],
                stress[4 * c + 3] } });
    }
    block_forces.prepare(data);
  }

  template <int dim>
  StableTimeStep<dim> Model<dim>::stability_at(const State<dim> &state) const
  {
    std::vector<NodeStiffness<dim>> bound(node_map.n_local(),
                                          NodeStiffness<dim>{});
    block_forces.add_stiffness_bound(state, {}, bound);
    if constexpr (dim == 2)
    {
      if (given.large_displacements)
        add_contact_bound(bound);
      else
        add_joint_bound(state, bound);
    }
    node_map.exchange().add_to_owners(bound.data());
    bound.resize(node_map.n_owned());
    std::vector<double> rigid_bound;
    if constexpr (dim == 2)
    {
      for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        rigid_bound.push_back(rigid.largest_eigenvalue(b, bound));
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
  void Model<2>::add_joint_bound(const State<2> &state,
                                 std::vector<NodeStiffness<2>> &bound) const
  {
    const auto &is_rigid = node_map.table().is_rigid;
    if (std::find(is_rigid.begin(), is_rigid.end(), true) == is_rigid.end())
    {
      matched_joints.add_stiffness_bound(
          state,
          [&](const unsigned int a, const unsigned int b)
          { return node_mass[a] / node_mass[b]; },
          bound);
      return;
    }

    // omega^2 of each body, node or rigid block, if the other side of its
    // joints were fixed. Springs are divided in the ratio of these, because a
    // rigid block may have any number of them: no bound then exceeds the sum of
    // those of two bodies.
    std::vector<NodeStiffness<2>> springs(node_map.n_local(),
                                          NodeStiffness<2>{});
    matched_joints.add_stiffness_bound(
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

    const auto is_rigid_node = [&](const unsigned int i)
    { return is_rigid[node_map.block_of_node(i)]; };
    matched_joints.add_stiffness_bound(
        state,
        [&](const unsigned int a, const unsigned int b)
        {
          return is_rigid_node(a) || is_rigid_node(b)
                     ? own[b] / own[a]
                     : node_mass[a] / node_mass[b];
        },
        bound);
  }

  template <int dim>
  State<dim> Model<dim>::initial_state() const
  {
    State<dim> state;
    state.template add<RigidBlockStates>().resize(rigid.n_blocks());
    state.template add<ConstructionState>();
    for (unsigned int i = 0; i < node_map.n_local(); ++i)
    {
      state.nodes.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        state.nodes[i].X[d] = node_map.point(i)[d];
    }
    state.velocity.assign(node_map.n_local(), NodeVector<dim>{});
    block_forces.prepare(state);
    if constexpr (dim == 2)
    {
      matched_joints.prepare(state);
      if (!face_stress.empty())
        initialise_joints(matched_joints, face_stress, state);
    }
    if (std::find(absent_group.begin(), absent_group.end(), true)
        == absent_group.end())
      return state;
    for (const unsigned int group : node_map.table().group)
      state.block_marks.push_back(absent_group[group] ? block_mark::absent
                                                      : block_mark::present);
    if constexpr (dim == 2)
      for (unsigned int i = 0; i < matched_joints.segments().size(); ++i)
        if (is_at_absent_block(*this, i, state))
          detach_joint(i, state.template get<JointHistory>());
    return state;
  }
  template class Model<2>;
  template class Model<3>;
} // namespace quoin
