// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/dynamics/model.h>
#include <quoin/blocks/triangle.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    NodeRecord<2> at_rest(const dealii::Point<2> &p)
    {
      return { { p[0], p[1] }, { 0., 0. } };
    }

    Triangle triangle(const BlockMesh<2> &mesh,
                      const std::array<unsigned int, 3> &cell)
    {
      return { at_rest(mesh.vertices[cell[0]]), at_rest(mesh.vertices[cell[1]]),
               at_rest(mesh.vertices[cell[2]]) };
    }
  } // namespace

  Model::Model(const BlockMesh<2> &mesh,
               const std::vector<unsigned int> &rank_of_block,
               const ModelParameters &parameters, const MPI_Comm communicator)
    : block_mesh(mesh),
      parameters(parameters), now{ parameters.materials, {}, parameters.joints }
  {
    find_materials();
    absent_group = find_groups(parameters.absent_groups, "section 'Stages'");
    rigid_block  = find_rigid_blocks(mesh, parameters.materials);
    find_blocks(rank_of_block, communicator);
    find_masses();
    find_initial_stress();
    pack_blocks({});
    matched_joints.prepare(mesh, *nodes, now.joints, parameters.thickness);
    if (!mesh.quadratic)
      find_stable_step();
  }

  void Model::find_materials()
  {
    constexpr unsigned int none = -1;
    now.material_of_group.assign(block_mesh.group_names.size(), none);
    for (unsigned int m = 0; m < now.materials.size(); ++m)
    {
      const auto &material = now.materials[m];
      for (const auto &group : material.groups)
      {
        const auto found = std::find(block_mesh.group_names.begin(),
                                     block_mesh.group_names.end(), group);
        if (found == block_mesh.group_names.end())
          throw InputError("section 'Materials/" + material.name
                           + "': the mesh has no physical surface '" + group
                           + "'. It has: " + known_names(block_mesh.group_names)
                           + ". Correct 'Groups'.");
        unsigned int &owner
            = now.material_of_group[found - block_mesh.group_names.begin()];
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
                         + block_mesh.group_names[g]
                         + "' has no material. Add it to the 'Groups' of "
                           "one.");
      group_impedance.push_back(impedance_of(
          now.materials[now.material_of_group[g]].elastic, parameters.plane));
    }
  }

  void Model::find_blocks(const std::vector<unsigned int> &rank_of_block,
                          const MPI_Comm communicator)
  {
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator);
    const auto range
        = std::equal_range(rank_of_block.begin(), rank_of_block.end(), rank);
    block_begin = range.first - rank_of_block.begin();
    block_end   = range.second - rank_of_block.begin();
    rigid_begin = std::find(rigid_block.begin() + block_begin,
                            rigid_block.begin() + block_end, true)
                  - rigid_block.begin();
    AssertThrow(std::find(rigid_block.begin() + rigid_begin,
                          rigid_block.begin() + block_end, false)
                    == rigid_block.begin() + block_end,
                dealii::ExcMessage("Rigid blocks must come last."));

    const unsigned int first = block_mesh.block_first_vertex[block_begin];
    const unsigned int last  = block_mesh.block_first_vertex[block_end];
    const auto owned
        = [&](const unsigned int v) { return v >= first && v < last; };

    std::vector<unsigned int> ghosts;
    for (const JointFace &face : block_mesh.joint_faces)
      if (owned(face.lower[0]) != owned(face.upper[0]))
        for (unsigned int k = 0; k < 2; ++k)
          ghosts.push_back(owned(face.lower[k]) ? face.upper[k]
                                                : face.lower[k]);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    nodes = std::make_unique<NodeExchange>(first, last, block_mesh.n_vertices(),
                                           ghosts, communicator);

    for (unsigned int c = block_mesh.block_first_cell[block_begin];
         c < block_mesh.block_first_cell[block_end]; ++c)
    {
      local_cells.push_back(block_mesh.cells[c]);
      for (unsigned int &v : local_cells.back())
        v -= first;
    }
  }

  void Model::find_masses()
  {
    node_mass.clear();
    std::vector<double> mass(block_mesh.n_vertices(), 0.);
    for (unsigned int c = 0; c < block_mesh.n_cells(); ++c)
    {
      const double third = triangle(block_mesh, block_mesh.cells[c]).area()
                           * parameters.thickness
                           * now.materials[material_of_cell(c)].elastic.density
                           / 3.;
      for (const unsigned int v : block_mesh.mass_vertices(c))
        mass[v] += third;
    }
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
      node_mass.push_back(mass[nodes->global(i)]);

    std::vector<double> density;
    for (const unsigned int material : now.material_of_group)
      density.push_back(now.materials[material].elastic.density);
    rigid.prepare(block_mesh, rigid_begin, block_end, n_deformable_nodes(),
                  density, parameters.thickness);
  }

  void Model::pack_blocks(const ConstructionState &construction)
  {
    BlockForcesData<2> data;
    data.quadratic = block_mesh.quadratic;
    data.cells.assign(local_cells.begin(),
                      local_cells.begin() + n_deformable_cells());
    data.thickness            = parameters.thickness;
    const unsigned int cell_0 = first_cell();
    const unsigned int node_0 = block_mesh.block_first_vertex[block_begin];
    for (unsigned int b = block_begin; b <= rigid_begin; ++b)
    {
      data.block_first_cell.push_back(block_mesh.block_first_cell[b] - cell_0);
      data.block_first_node.push_back(block_mesh.block_first_vertex[b]
                                      - node_0);
    }
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
      data.cell_stiffness.push_back(material_of_cell(cell_0 + c));
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
    std::vector<std::array<double, 3>> bound(nodes->n_local(),
                                             { { 0., 0., 0. } });
    for (unsigned int c = 0; c < n_deformable_cells(); ++c)
    {
      const unsigned int cell = first_cell() + c;
      const LinearElastic &material
          = now.materials[material_of_cell(cell)].elastic;
      const Triangle element = triangle(block_mesh, block_mesh.cells[cell]);
      const double share
          = largest_eigenvalue_squared_frequency(
                element, plane_stiffness(material, parameters.plane),
                material.density)
            * material.density * element.area() * parameters.thickness / 3.;
      for (const unsigned int v : local_cells[c])
      {
        bound[v][0] += share;
        bound[v][1] += share;
      }
    }
    if (parameters.large_displacements)
      add_contact_bound(bound);
    else
      add_joint_bound(bound);
    bound.resize(nodes->n_owned());
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
    const auto none = std::find(rigid_block.begin(), rigid_block.end(), true);
    if (none == rigid_block.end())
    {
      matched_joints.add_stiffness_bound(state.nodes.data(), node_mass, bound);
      return;
    }

    // What a body, node or rigid block, would have as omega^2 if the other
    // side of its joints were fixed. In the ratio of these the springs'
    // shares are best divided, because a rigid block may have any number of
    // them: no bound is above the sum of two bodies' own.
    std::vector<std::array<double, 3>> springs(nodes->n_local(),
                                               { { 0., 0., 0. } });
    matched_joints.add_stiffness_bound(
        state.nodes.data(), [](unsigned int, unsigned int) { return 0.; },
        springs);
    std::vector<double> own(nodes->n_local(), 0.);
    for (unsigned int i = 0; i < n_deformable_nodes(); ++i)
      own[i] = StableTimeStep<2>({ springs[i] })
                   .largest_eigenvalue({ node_mass[i] });
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      std::fill(own.begin() + rigid.block(b).begin,
                own.begin() + rigid.block(b).end,
                rigid.largest_eigenvalue(b, springs));
    nodes->update_ghosts(own.data());

    const auto is_rigid_node = [&](const unsigned int i)
    { return rigid_block[block_mesh.block_of_vertex(nodes->global(i))]; };
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
      const double tributary = 0.5
                               * block_mesh.vertices[edge[0]].distance(
                                   block_mesh.vertices[edge[1]]);
      for (const unsigned int v : edge)
        if (nodes->owns(v))
          for (unsigned int c = 0; c < 2; ++c)
            bound[nodes->local(v)][c]
                += 2. * stiffness * tributary * parameters.thickness;
    };
    for (const BlockFace &face : block_mesh.boundary_faces)
      add_edge(face.vertices);
    for (const JointFace &face : block_mesh.joint_faces)
    {
      add_edge(face.lower);
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
    result.is_rigid          = rigid_block;
    result.thickness         = parameters.thickness;
    return result;
  }
} // namespace quoin
