// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/dynamics/model.h>
#include <quoin/blocks/block_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  Model::Model(const NodeMap<2> &nodes, const ModelParameters &parameters)
    : node_map(nodes),
      parameters(parameters), now{ parameters.materials, {}, parameters.joints }
  {
    find_materials();
    absent_group = find_groups(parameters.absent_groups, "section 'Stages'");
    find_masses();
    find_initial_stress();
    pack_blocks({});
    matched_joints.prepare(nodes, now.joints, parameters.thickness);
    if (!table().is_quadratic)
      find_stable_step();
  }

  void Model::find_materials()
  {
    constexpr unsigned int none = -1;
    now.material_of_group.assign(table().group_names.size(), none);
    for (unsigned int m = 0; m < now.materials.size(); ++m)
    {
      const auto &material = now.materials[m];
      for (const auto &group : material.groups)
      {
        const auto found = std::find(table().group_names.begin(),
                                     table().group_names.end(), group);
        if (found == table().group_names.end())
          throw InputError("section 'Materials/" + material.name
                           + "': the mesh has no physical surface '" + group
                           + "'. It has: " + known_names(table().group_names)
                           + ". Correct 'Groups'.");
        unsigned int &owner
            = now.material_of_group[found - table().group_names.begin()];
        if (owner != none)
          throw InputError("section 'Materials/" + material.name
                           + "': physical surface '" + group + "' is made of '"
                           + now.materials[owner].name
                           + "' already. Name it once.");
        owner = m;
      }
    }
    for (unsigned int g = 0; g < now.material_of_group.size(); ++g)
    {
      if (now.material_of_group[g] == none)
        throw InputError("section 'Materials': physical surface '"
                         + table().group_names[g]
                         + "' has no material. Add it to the 'Groups' of "
                           "one.");
      group_impedance.push_back(impedance_of(
          now.materials[now.material_of_group[g]].elastic, parameters.plane));
    }
  }

  void Model::find_masses()
  {
    std::vector<double> density;
    for (const unsigned int material : now.material_of_group)
      density.push_back(now.materials[material].elastic.density);
    node_mass = lumped_masses(node_map, density, parameters.thickness);
    rigid.prepare(node_map, density, parameters.thickness);
  }

  void Model::pack_blocks(const ConstructionState &construction)
  {
    BlockForcesData<2> data;
    data.quadratic = table().is_quadratic;
    take_cells(node_map, data);
    data.thickness = parameters.thickness;
    for (const MaterialParameters &material : now.materials)
    {
      data.stiffness.push_back(
          plane_stiffness(material.elastic, parameters.plane));
      data.laws.emplace_back();
      if (material.strength)
        data.laws.back().emplace(material.elastic, *material.strength,
                                 parameters.plane);
    }
    for (unsigned int c = 0; c < n_deformable_cells(); ++c)
    {
      data.cell_stiffness.push_back(material_of_cell(c));
    }
    const AlignedArray<double> stress = construction.initial_stress.empty()
                                            ? packed_initial_stress()
                                            : construction.initial_stress;
    for (unsigned int c = 0; 4 * c < stress.size(); ++c)
      data.initial_stress.push_back(
          { { stress[4 * c], stress[4 * c + 1], stress[4 * c + 2],
              stress[4 * c + 3] } });
    block_forces.prepare(data);
  }

  void Model::find_stable_step()
  {
    std::vector<PlaneStiffness> stiffness;
    std::vector<double> density;
    for (const unsigned int m : now.material_of_group)
    {
      const LinearElastic &material = now.materials[m].elastic;
      stiffness.push_back(plane_stiffness(material, parameters.plane));
      density.push_back(material.density);
    }
    auto bound
        = cell_bounds(node_map, stiffness, density, parameters.thickness);
    if (parameters.large_displacements)
      add_contact_bound(bound);
    else
      add_joint_bound(bound);
    exchange().add_to_owners(bound.data());
    bound.resize(node_map.n_owned());
    std::vector<double> rigid_bound;
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      rigid_bound.push_back(rigid.largest_eigenvalue(b, bound));
    std::fill(bound.begin() + n_deformable_nodes(), bound.end(),
              std::array<double, 3>{ { 0., 0., 0. } });
    stable_step = std::make_unique<StableTimeStep<2>>(bound);
    stable_step->set_rigid_blocks(rigid_bound);
  }

  void Model::add_joint_bound(std::vector<std::array<double, 3>> &bound) const
  {
    const State<2> state = initial_state();
    const auto &is_rigid = table().is_rigid;
    if (std::find(is_rigid.begin(), is_rigid.end(), true) == is_rigid.end())
    {
      matched_joints.add_stiffness_bound(state.nodes.data(), node_mass, bound);
      return;
    }

    // What a body, node or rigid block, would have as omega^2 if the other
    // side of its joints were fixed. In the ratio of these the springs'
    // shares are best divided, because a rigid block may have any number of
    // them: no bound is above the sum of two bodies' own.
    std::vector<std::array<double, 3>> springs(node_map.n_local(),
                                               { { 0., 0., 0. } });
    matched_joints.add_stiffness_bound(
        state.nodes.data(), [](unsigned int, unsigned int) { return 0.; },
        springs);
    std::vector<double> own(node_map.n_local(), 0.);
    for (unsigned int i = 0; i < n_deformable_nodes(); ++i)
      own[i] = StableTimeStep<2>({ springs[i] })
                   .largest_eigenvalue({ node_mass[i] });
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      std::fill(own.begin() + rigid.block(b).begin,
                own.begin() + rigid.block(b).end,
                rigid.largest_eigenvalue(b, springs));
    exchange().update_ghosts(own.data());

    const auto is_rigid_node = [&](const unsigned int i)
    { return is_rigid[node_map.block_of_node(i)]; };
    matched_joints.add_stiffness_bound(
        state.nodes.data(),
        [&](const unsigned int a, const unsigned int b)
        {
          return is_rigid_node(a) || is_rigid_node(b)
                     ? own[b] / own[a]
                     : node_mass[a] / node_mass[b];
        },
        bound);
  }

  void Model::add_contact_bound(std::vector<std::array<double, 3>> &bound) const
  {
    // A spring k between nodes a and b has no more energy than 2 k at each.
    double stiffness = 0.;
    for (const JointSetParameters &set : now.joints)
      for (const double largest : stiffness_bound(set.law))
        stiffness = std::max(stiffness, largest);
    const auto add_edge = [&](const std::array<unsigned int, 2> &edge)
    {
      const double tributary
          = 0.5 * node_map.point(edge[0]).distance(node_map.point(edge[1]));
      for (const unsigned int node : edge)
        for (unsigned int c = 0; c < 2; ++c)
          bound[node][c] += 2. * stiffness * tributary * parameters.thickness;
    };
    for (const OuterFace<2> &face : node_map.outer_faces())
      add_edge(face.nodes);
    for (const JointNodes<2> &face : node_map.joint_faces())
    {
      if (face.is_own[0])
        add_edge(face.lower);
      if (face.is_own[1])
        add_edge(face.upper);
    }
  }

  std::vector<Impedance>
  Model::impedance_beyond(const LoadParameters &load) const
  {
    if (load.far_material.empty())
      return group_impedance;
    for (const MaterialParameters &material : now.materials)
      if (!material.rigid && material.name == load.far_material)
        return std::vector<Impedance>(
            group_impedance.size(),
            impedance_of(material.elastic, parameters.plane));
    const auto elastic = [](const MaterialParameters &material)
    { return material.rigid ? std::string() : material.name; };
    throw InputError("section 'Loads/" + load.name
                     + "': 'Far field material = " + load.far_material
                     + "' is no linear elastic material of section "
                       "'Materials'. There are: "
                     + known_names(now.materials, elastic) + ".");
  }

  double Model::slowest_shear_wave() const
  {
    double slowest = std::numeric_limits<double>::infinity();
    for (const unsigned int m : now.material_of_group)
    {
      const MaterialParameters &material = now.materials[m];
      if (material.rigid)
        continue;
      const double shear
          = 0.5 * material.elastic.young / (1. + material.elastic.poisson);
      slowest = std::min(slowest, std::sqrt(shear / material.elastic.density));
    }
    return slowest;
  }

  FreeFieldGround Model::free_field_ground() const
  {
    FreeFieldGround ground;
    for (const unsigned int m : now.material_of_group)
    {
      ground.materials.push_back(now.materials[m].elastic);
      ground.is_rigid.push_back(now.materials[m].rigid);
      ground.yields.push_back(now.materials[m].strength.has_value());
    }
    ground.plane     = parameters.plane;
    ground.thickness = parameters.thickness;
    return ground;
  }

  ContactModel Model::contact_model() const
  {
    ContactModel result;
    result.parameters = parameters.contact;
    result.sets       = now.joints;
    for (const MaterialParameters &material : now.materials)
      result.materials.push_back(material.name);
    result.material_of_group = now.material_of_group;
    result.thickness         = parameters.thickness;
    return result;
  }
} // namespace quoin
