// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What possible contacts and the dashpots of joints mean for the time
// step of a Model<2>.

#include <quoin/contact/contact_sets.h>
#include <quoin/model/contact_bounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  std::vector<double> block_masses(const NodeMap<2> &nodes,
                                   const std::vector<double> &node_mass)
  {
    std::vector<double> masses(nodes.table().n_blocks(), 0.);
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      masses[nodes.block_of_node(i)] += node_mass[i];
    dealii::Utilities::MPI::sum(masses, nodes.communicator(), masses);
    return masses;
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

  DashpotBlocks dashpot_blocks(const Model<2> &model,
                               std::vector<std::uint8_t> is_held)
  {
    const NodeMap<2> &nodes = model.nodes();
    DashpotBlocks result;
    result.communicator = nodes.communicator();
    MPI_Allreduce(MPI_IN_PLACE, is_held.data(), is_held.size(), MPI_UINT8_T,
                  MPI_MAX, result.communicator);
    const auto masses = block_masses(nodes, model.mass());
    std::vector<unsigned int> n_ranks(masses.size(), 0);
    for (const BlockPart &part : nodes.blocks().parts)
      ++n_ranks[part.number];
    dealii::Utilities::MPI::sum(n_ranks, result.communicator, n_ranks);
    for (unsigned int b = 0; b < masses.size(); ++b)
    {
      result.inverse_mass.push_back(is_held[b] ? 0. : 1. / masses[b]);
      result.is_divided.push_back(n_ranks[b] > 1);
    }
    result.impedance
        = group_impedances(model.properties(), model.parameters().plane);
    return result;
  }

  std::vector<std::uint8_t> sets_on_blocks(const NodeMap<2> &nodes,
                                           const MatchedJoints &joints,
                                           const ModelProperties &properties,
                                           const bool may_meet)
  {
    const unsigned int n_sets = properties.joints.size();
    const unsigned int n      = properties.materials.size();
    std::vector<std::uint8_t> acts(nodes.table().n_blocks() * n_sets, 0);
    for (const JointSegment &segment : joints.segments())
      for (const unsigned int b : nodes.faces().joints[segment.face].blocks)
        acts[b * n_sets + segment.set] = 1;

    if (may_meet)
    {
      std::vector<std::string> names;
      for (const MaterialParameters &material : properties.materials)
        names.push_back(material.name);
      const auto set_of   = sets_of_new_contacts(properties.joints, names);
      const auto material = [&](const unsigned int cell)
      { return properties.material_of_group[nodes.cells().group[cell]]; };
      std::vector<std::uint8_t> is_there(n, 0);
      for (unsigned int c = 0; c < nodes.cells().size(); ++c)
        is_there[material(c)] = 1;
      MPI_Allreduce(MPI_IN_PLACE, is_there.data(), n, MPI_UINT8_T, MPI_MAX,
                    nodes.communicator());
      for (unsigned int c = 0; c < nodes.cells().size(); ++c)
        for (unsigned int m = 0; m < n; ++m)
          if (const unsigned int set = set_of[material(c) * n + m];
              is_there[m] && set != no_contact_set)
            acts[nodes.blocks().block_of_cell(c) * n_sets + set] = 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, acts.data(), acts.size(), MPI_UINT8_T, MPI_MAX,
                  nodes.communicator());
    return acts;
  }

  namespace
  {
    /** Calls @p use (nodes, half of the area [m^2]) for the edges of own blocks
        on their boundaries. */
    template <typename Use>
    void for_each_boundary_edge(const NodeMap<2> &nodes,
                                const Thickness &thickness, const Use &use)
    {
      const auto take =
          [&](const std::array<unsigned int, 2> &edge, const unsigned int group)
      {
        use(edge, 0.5 * nodes.point(edge[0]).distance(nodes.point(edge[1]))
                      * thickness[group]);
      };
      for (const OuterFace<2> &face : nodes.faces().outer)
        take(face.nodes, nodes.cells().group[face.cell]);
      for (const JointNodes<2> &face : nodes.faces().joints)
      {
        if (face.is_own[0])
          take(face.lower, face.groups[0]);
        if (face.is_own[1])
          take(face.upper, face.groups[1]);
      }
    }
  } // namespace

  template <>
  void Model<2>::add_contact_bound(std::vector<NodeStiffness<2>> &bound) const
  {
    // A spring k between nodes a and b has no more energy than 2 k at each.
    const auto acts = sets_on_blocks(node_map, matched_joints, now, true);
    const unsigned int n_sets = now.joints.size();
    std::vector<double> stiffness(node_map.table().n_blocks(), 0.);
    for (unsigned int b = 0; b < stiffness.size(); ++b)
      for (unsigned int s = 0; s < n_sets; ++s)
        if (acts[b * n_sets + s])
          for (const double largest : stiffness_bound(now.joints[s].law))
            stiffness[b] = std::max(stiffness[b], largest);
    for_each_boundary_edge(
        node_map, group_thickness,
        [&](const std::array<unsigned int, 2> &edge, const double tributary)
        {
          for (const unsigned int node : edge)
            for (unsigned int c = 0; c < 2; ++c)
              bound[node][c]
                  += 2. * stiffness[node_map.block_of_node(node)] * tributary;
        });
  }

  template <>
  void Model<2>::add_dashpot_bound(std::vector<NodeStiffness<2>> &bound,
                                   std::vector<double> &rigid_bound) const
  {
    if (std::none_of(now.joints.begin(), now.joints.end(),
                     [](const JointSetParameters &set)
                     { return set.damping.acts(); }))
      return;
    /** omega^2 of undamped steps as short as those with dashpots of the rate
        c/m: h^2 omega^2 + 2 h rate = 4 there. */
    const auto damped = [](const double eigenvalue, const double rate)
    {
      const double omega = rate + std::sqrt(rate * rate + eigenvalue);
      return omega * omega;
    };
    const auto acts           = sets_on_blocks(node_map, matched_joints, now,
                                               given.large_displacements);
    const auto masses         = block_masses(node_map, node_mass);
    const unsigned int n_sets = now.joints.size();

    std::vector<NodeVector<1>> area(node_map.n_local(),
                                    NodeVector<1>{ { 0. } });
    for_each_boundary_edge(
        node_map, group_thickness,
        [&](const std::array<unsigned int, 2> &edge, const double tributary)
        {
          for (const unsigned int node : edge)
            area[node].v[0] += tributary;
        });
    node_map.exchange().add_to_owners(area.data());
    double impedance = 0.;
    for (const auto &[p, s] : group_impedances(now, given.plane))
      if (std::isfinite(p))
        impedance = std::max(impedance, p);
    for (unsigned int i = 0; i < node_map.n_deformable_nodes(); ++i)
    {
      const unsigned int b = node_map.block_of_node(i);
      double dashpot       = 0.;
      for (unsigned int s = 0; s < n_sets; ++s)
        if (const JointDamping &damping = now.joints[s].damping;
            acts[b * n_sets + s])
        {
          const auto [kn, ks] = stiffness_bound(now.joints[s].law);
          const double root   = std::max(damping.normal * std::sqrt(kn),
                                         damping.shear * std::sqrt(ks));
          dashpot             = std::max(dashpot,
                                         2. * root * std::sqrt(masses[b] * area[i].v[0]));
        }
      // As a spring, between two nodes it counts twice at each.
      dashpot          = 2. * std::min(dashpot, impedance * area[i].v[0]);
      const double own = StableTimeStep<2>({ bound[i] })
                             .largest_eigenvalue({ node_mass[i] });
      for (unsigned int c = 0; c < 2; ++c)
        bound[i][c]
            += node_mass[i] * (damped(own, dashpot / node_mass[i]) - own);
    }
    const unsigned int first = node_map.blocks().n_deformable;
    for (unsigned int r = 0; r < rigid_bound.size(); ++r)
    {
      const unsigned int b = node_map.blocks().parts[first + r].number;
      double share         = 0.;
      for (unsigned int s = 0; s < n_sets; ++s)
        if (const JointDamping &damping = now.joints[s].damping;
            acts[b * n_sets + s])
          share = std::max({ share, damping.normal, damping.shear });
      // On springs of its own, between two others.
      rigid_bound[r]
          = damped(rigid_bound[r], share * std::sqrt(8. * rigid_bound[r]));
    }
  }
} // namespace quoin
