// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <map>

namespace quoin
{
  namespace
  {
    unsigned int position(const std::vector<std::string> &names,
                          const std::string &name, const std::string &load,
                          const std::string &parameter, const std::string &kind)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (name.empty() || found == names.end())
        throw InputError("section 'Loads/" + load + "': '" + parameter + " = "
                         + name + "', but the mesh has no " + kind
                         + " of that name. It has: " + known_names(names)
                         + ".");
      return found - names.begin();
    }
  } // namespace

  std::vector<BoundaryFace<2>>
  faces_of_curves(const NodeMap<2> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load)
  {
    const auto &face_names = node_map.table().face_names;
    std::vector<BoundaryFace<2>> faces;
    for (const auto &name : names)
    {
      if (std::count(names.begin(), names.end(), name) > 1)
        throw InputError("section 'Loads/" + load + "': 'Boundary' names '"
                         + name
                         + "' twice, and the load would act on it twice. Name "
                           "it once.");
      const unsigned int line
          = position(face_names, name, load, "Boundary", "physical curve");
      std::vector<bool> wanted(face_names.size(), false);
      wanted[line]     = true;
      const auto found = node_map.gather_faces(wanted);
      faces.insert(faces.end(), found.begin(), found.end());
      if (found.empty())
        throw InputError("section 'Loads/" + load + "': 'Boundary = " + name
                         + "' has no edge on the outer boundary of a block. "
                           "Name a boundary curve.");
    }
    return faces;
  }

  std::vector<unsigned int>
  groups_of_names(const NodeMap<2> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load)
  {
    std::vector<unsigned int> groups;
    for (const auto &name : names)
      groups.push_back(position(node_map.table().group_names, name, load,
                                "Group", "physical surface"));
    return groups;
  }

  NodalLoad::NodalLoad(const LoadParameters &parameters,
                       const NodeMap<2> &node_map,
                       const std::vector<double> &mass, const double thickness)
    : load_name(parameters.name),
      is_gravity(parameters.type == LoadType::gravity),
      components(parameters.components)
  {
    if (is_gravity)
    {
      for (unsigned int i = 0; i < node_map.n_owned(); ++i)
        nodes.push_back(i);
      weights.resize(nodes.size());
      set_mass(mass);
      return;
    }
    std::map<unsigned int, double> area;
    std::map<unsigned int, NodeVector<2>> inward_area;
    for (const BoundaryFace<2> &face :
         faces_of_curves(node_map, parameters.boundaries, parameters.name))
    {
      // The block is on the left of an edge.
      const auto edge = face.points[1] - face.points[0];
      for (unsigned int k = 0; k < 2; ++k)
        if (node_map.exchange().owns(face.nodes[k]))
        {
          const unsigned int node = node_map.exchange().local(face.nodes[k]);
          const double share      = face.shares[k];
          area[node] += share * edge.norm() * thickness;
          inward_area[node].v[0] -= share * edge[1] * thickness;
          inward_area[node].v[1] += share * edge[0] * thickness;
        }
    }
    for (const auto &[node, weight] : area)
    {
      nodes.push_back(node);
      weights.push_back(weight);
      if (components[2].quantity != LoadQuantity::free)
        inward.push_back(inward_area[node]);
    }
  }

  void NodalLoad::set_mass(const std::vector<double> &mass)
  {
    if (is_gravity)
      std::copy_n(mass.begin(), weights.size(), weights.begin());
  }

  std::array<double, 3> NodalLoad::amplitude(const TimePoint &time) const
  {
    return component_values(components, time);
  }

  void NodalLoad::add_forces(const TimePoint &time, NodeVector<2> *force) const
  {
    const auto [x, y, pressure] = amplitude(time);
    for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      force[nodes[i]].v[0] += x * weights[i];
      force[nodes[i]].v[1] += y * weights[i];
    }
    for (unsigned int i = 0; i < inward.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        force[nodes[i]].v[d] += pressure * inward[i].v[d];
  }

  double NodalLoad::external_power(const TimePoint &time,
                                   const NodeVector<2> *velocity) const
  {
    double sum[2] = { 0., 0. }, inflow = 0.;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        sum[d] += weights[i] * velocity[nodes[i]].v[d];
    for (unsigned int i = 0; i < inward.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        inflow += inward[i].v[d] * velocity[nodes[i]].v[d];
    const auto [x, y, pressure] = amplitude(time);
    return x * sum[0] + y * sum[1] + pressure * inflow;
  }
} // namespace quoin
