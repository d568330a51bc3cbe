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
  ModelProperties reduced(ModelProperties properties, const double factor,
                          const bool joints, const bool blocks)
  {
    if (joints)
      for (JointSetParameters &set : properties.joints)
        set.law = reduced(set.law, factor);
    if (blocks)
      for (MaterialParameters &material : properties.materials)
        material = reduced(material, factor);
    return properties;
  }

  template <int dim>
  CellStiffness<dim> stiffness_of(const MaterialParameters &material,
                                  const PlaneAssumption plane)
  {
    if constexpr (dim == 2)
      return plane_stiffness(material.elastic, plane);
    else
      return space_stiffness(material.elastic);
  }

  template <int dim>
  std::vector<std::optional<YieldLaw<dim>>>
  laws_of(const std::vector<MaterialParameters> &materials,
          const PlaneAssumption plane)
  {
    std::vector<std::optional<YieldLaw<dim>>> laws(materials.size());
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (materials[m].strength)
      {
        if constexpr (dim == 2)
          laws[m].emplace(materials[m].elastic, *materials[m].strength, plane);
        else
          laws[m].emplace(materials[m].elastic, *materials[m].strength);
      }
    return laws;
  }

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
    start_stress = find_initial_stress(nodes, given, now, absent_group);
    pack_blocks({});
    if constexpr (dim == 2)
    {
      matched_joints.prepare(nodes, now.joints, group_thickness);
      bars.prepare(nodes, given.cables, group_thickness, block_forces);
      make_contacts();
    }
    else
      matched_joints.prepare(nodes, now.joints);
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
  void Model<dim>::pack_blocks(const ConstructionState<dim> &construction)
  {
    BlockForcesData<dim> data;
    take_cells(node_map, data);
    for (const MaterialParameters &material : now.materials)
      data.stiffness.push_back(stiffness_of<dim>(material, given.plane));
    for (unsigned int c = 0; c < node_map.cells().n_deformable; ++c)
      data.cell_stiffness.push_back(material_of_cell(*this, c));
    data.laws = laws_of<dim>(now.materials, given.plane);
    const AlignedArray<double> stress = construction.initial_stress.empty()
                                            ? start_stress.packed(node_map)
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
    else
      data.mixed = node_map.table().is_mixed;
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

  template <int dim>
  void Model<dim>::set_properties(const ModelProperties &properties,
                                  const ConstructionState<dim> &construction)
  {
    now = properties;
    find_masses();
    pack_blocks(construction);
    matched_joints.set_laws(now.joints);
    if (block_contacts)
      block_contacts->set_properties(now.joints, now.material_of_group);
  }

  template <int dim>
  void Model<dim>::set_held_blocks(const std::vector<std::uint8_t> &is_held)
  {
    held_blocks = is_held;
    MPI_Allreduce(MPI_IN_PLACE, held_blocks.data(), held_blocks.size(),
                  MPI_UINT8_T, MPI_MAX, node_map.communicator());
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
    if (!start_stress.faces.empty())
      initialise_joints(matched_joints, start_stress.faces, state);
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
  template CellStiffness<2> stiffness_of<2>(const MaterialParameters &,
                                            PlaneAssumption);
  template CellStiffness<3> stiffness_of<3>(const MaterialParameters &,
                                            PlaneAssumption);
  template std::vector<std::optional<YieldLaw<2>>>
  laws_of<2>(const std::vector<MaterialParameters> &, PlaneAssumption);
  template std::vector<std::optional<YieldLaw<3>>>
  laws_of<3>(const std::vector<MaterialParameters> &, PlaneAssumption);
} // namespace quoin
