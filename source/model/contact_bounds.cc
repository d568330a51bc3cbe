// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/dashpot_bounds.h>
#include <quoin/model/contact_bounds.h>

#include <algorithm>
#include <limits>

namespace quoin
{
  template <int dim>
  std::vector<double> block_masses(const NodeMap<dim> &nodes,
                                   const std::vector<double> &node_mass)
  {
    std::vector<double> masses(nodes.table().n_blocks(), 0.);
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      masses[nodes.block_of_node(i)] += node_mass[i];
    dealii::Utilities::MPI::sum(masses, nodes.communicator(), masses);
    return masses;
  }

  template <int dim>
  std::vector<double> dashpot_masses(const Model<dim> &model)
  {
    const NodeMap<dim> &nodes = model.nodes();
    const auto masses         = block_masses(nodes, model.mass());
    const auto acts           = sets_on_blocks(model);
    const unsigned int n_sets = model.properties().joints.size();
    std::vector<double> result(acts.size(), 0.);
    const auto meet = [&](const unsigned int set, const unsigned int block,
                          const double other)
    {
      double &mass = result[block * n_sets + set];
      mass         = std::max(mass, other);
    };
    for (unsigned int b = 0; b < masses.size(); ++b)
      for (unsigned int s = 0; s < n_sets; ++s)
        if (acts[b * n_sets + s] && !model.is_held(b))
          meet(s, b, masses[b]);
    // What is held has those of what is not; two that are held have the lighter
    // one's.
    if (dim == 2 && model.parameters().large_displacements)
      for (unsigned int s = 0; s < n_sets; ++s)
      {
        double heaviest = 0., heaviest_held = 0.;
        for (unsigned int b = 0; b < masses.size(); ++b)
          if (acts[b * n_sets + s] && model.is_held(b))
          {
            heaviest = std::max(heaviest, std::min(heaviest_held, masses[b]));
            heaviest_held = std::max(heaviest_held, masses[b]);
          }
        for (unsigned int b = 0; b < masses.size(); ++b)
          heaviest = std::max(heaviest, result[b * n_sets + s]);
        for (unsigned int b = 0; b < masses.size(); ++b)
          if (acts[b * n_sets + s] && model.is_held(b))
            meet(s, b, heaviest);
      }
    else
      for (const auto &face : joint_faces(model.joints()))
      {
        const auto &[a, b] = nodes.faces().joints[face.face].blocks;
        if (model.is_held(a) && !model.is_held(b))
          meet(face.set, a, masses[b]);
        if (model.is_held(b) && !model.is_held(a))
          meet(face.set, b, masses[a]);
        if (model.is_held(a) && model.is_held(b))
          for (const unsigned int held : { a, b })
            meet(face.set, held, std::min(masses[a], masses[b]));
      }
    dealii::Utilities::MPI::max(result, nodes.communicator(), result);
    return result;
  }

  std::vector<std::array<double, 2>>
  group_impedances(const ModelProperties &properties,
                   const PlaneAssumption plane)
  {
    std::vector<std::array<double, 2>> result;
    for (const unsigned int m : properties.material_of_group)
    {
      const MaterialParameters &material = properties.materials[m];
      result.emplace_back();
      result.back().fill(std::numeric_limits<double>::infinity());
      if (material.rigid)
        continue;
      const auto [p, s]    = wave_speeds(material.elastic, plane);
      const double density = material.elastic.density;
      result.back()        = { { density * p, density * s } };
    }
    return result;
  }

  template <int dim>
  DashpotBlocks dashpot_blocks(const Model<dim> &model)
  {
    const NodeMap<dim> &nodes = model.nodes();
    DashpotBlocks result;
    result.communicator = nodes.communicator();
    const auto masses   = block_masses(nodes, model.mass());
    std::vector<unsigned int> n_ranks(masses.size(), 0);
    for (const BlockPart &part : nodes.blocks().parts)
      ++n_ranks[part.number];
    dealii::Utilities::MPI::sum(n_ranks, result.communicator, n_ranks);
    for (unsigned int b = 0; b < masses.size(); ++b)
    {
      result.own_inverse_mass.push_back(1. / masses[b]);
      result.inverse_mass.push_back(model.is_held(b) ? 0. : 1. / masses[b]);
      result.is_divided.push_back(n_ranks[b] > 1);
    }
    result.impedance
        = group_impedances(model.properties(), model.parameters().plane);
    return result;
  }

  template <int dim>
  std::vector<std::uint8_t> sets_on_blocks(const Model<dim> &model)
  {
    if constexpr (dim == 2)
      if (const BlockContacts *contacts = model.contacts())
        return contacts->laws().sets_on_blocks(model.joints(), model.nodes());
    return sets_on_blocks<dim>(model.joints(), model.nodes());
  }

  template std::vector<double> block_masses(const NodeMap<2> &,
                                            const std::vector<double> &);
  template std::vector<double> dashpot_masses(const Model<2> &);
  template DashpotBlocks dashpot_blocks(const Model<2> &);
  template std::vector<std::uint8_t> sets_on_blocks(const Model<2> &);
  template std::vector<double> block_masses(const NodeMap<3> &,
                                            const std::vector<double> &);
  template std::vector<double> dashpot_masses(const Model<3> &);
  template DashpotBlocks dashpot_blocks(const Model<3> &);
  template std::vector<std::uint8_t> sets_on_blocks(const Model<3> &);
} // namespace quoin
