// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/water/joint_channels.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace quoin
{
  namespace
  {
    /** Distance of a point to the joints, by the diagonal of the model, beyond
        which it is no point of theirs [-]. */
    constexpr double most_distance = 0.1;
  } // namespace

  JointChannels::JointChannels(const WaterParameters &given,
                               const NodeMap<2> &nodes,
                               const MatchedJoints &joints,
                               const std::vector<JointSetParameters> &sets,
                               const Thickness &thickness)
    : node_map(nodes)
  {
    make_network(given, joints, sets, thickness);
    find_boundaries(given.boundaries);
  }

  void JointChannels::make_network(const WaterParameters &given,
                                   const MatchedJoints &joints,
                                   const std::vector<JointSetParameters> &sets,
                                   const Thickness &thickness)
  {
    aperture_of_set.assign(sets.size(), nullptr);
    for (const HydraulicAperture &aperture : given.joints)
    {
      const auto set = std::find_if(sets.begin(), sets.end(),
                                    [&](const JointSetParameters &candidate) {
                                      return candidate.name == aperture.name;
                                    });
      if (set == sets.end())
        throw InputError(
            "section 'Water joints': 'Names' has '" + aperture.name
            + "', which is no set of section 'Joints'. Sets are: "
            + known_names_like(aperture.name, sets, &JointSetParameters::name)
            + ".");
      aperture_of_set[set - sets.begin()] = &aperture;
    }
    for (const JointLaw &law : joints.laws())
      compliance_of_set.push_back(1. / stiffness_bound(law)[0]);

    std::vector<JointChannel> own;
    for (const JointSegment &segment : joints.segments())
    {
      const JointNodes<2> &joint = node_map.faces().joints[segment.face];
      if (!joint.is_own[0])
        continue;
      JointChannel face;
      for (unsigned int k = 0; k < 2; ++k)
      {
        face.lower[k]  = node_map.exchange().global(segment.lower[k]);
        face.upper[k]  = node_map.exchange().global(segment.upper[k]);
        face.points[k] = node_map.point(segment.lower[k]);
      }
      face.blocks    = joint.blocks;
      face.areas     = segment.area;
      face.number    = joint.number;
      face.set       = segment.set;
      face.thickness = thickness.common(joint.groups[0], joint.groups[1]);
      own.push_back(face);
    }
    std::vector<JointChannel> all;
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(node_map.communicator(), own))
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(),
              [](const JointChannel &a, const JointChannel &b)
              { return a.number < b.number; });

    // Nodes of the mesh that lie on each other are one node of the network,
    // also across joints without water.
    DisjointSets together(node_map.exchange().n_global());
    for (const JointChannel &face : all)
      for (unsigned int k = 0; k < 2; ++k)
        together.unite(face.lower[k], face.upper[k]);
    std::map<unsigned int, unsigned int> number; // by representatives
    std::vector<FlowChannel> channels;
    std::map<unsigned int, unsigned int> channel_of_joint;
    for (const JointChannel &face : all)
    {
      if (!aperture_of_set[face.set])
        continue;
      FlowChannel channel{};
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto [place, is_new]
            = number.emplace(together.find(face.lower[k]), number.size());
        if (is_new)
          elevation.push_back(face.points[k][1]);
        channel.nodes[k]    = place->second;
        channel.aperture[k] = aperture_of_set[face.set]->at(0.);
      }
      channel.length    = std::hypot(face.points[1][0] - face.points[0][0],
                                     face.points[1][1] - face.points[0][1]);
      channel.thickness = face.thickness;
      channel_of_joint[face.number] = channels.size();
      channels.push_back(channel);
      faces.push_back(face);
    }
    if (channels.empty())
      throw InputError("section 'Water joints': no joint of the mesh is of a "
                       "set of 'Names', so no water can flow. Name a set of "
                       "section 'Joints' that has joints.");
    for (const JointChannel &face : all)
      for (unsigned int k = 0; k < 2; ++k)
        for (const unsigned int node : { face.lower[k], face.upper[k] })
          if (const auto found = number.find(together.find(node));
              found != number.end())
          {
            node_of_mesh.emplace_back(node, found->second);
            if (!aperture_of_set[face.set] && node == face.lower[k])
              dry_faces.push_back({ face.blocks, found->second });
          }
    std::sort(node_of_mesh.begin(), node_of_mesh.end());
    node_of_mesh.erase(std::unique(node_of_mesh.begin(), node_of_mesh.end()),
                       node_of_mesh.end());
    for (const JointSegment &segment : joints.segments())
    {
      const auto found
          = channel_of_joint.find(node_map.faces().joints[segment.face].number);
      of_segment.push_back(found == channel_of_joint.end() ? no_channel
                                                           : found->second);
    }
    network = FlowNetwork(given.fluid, elevation, channels);
  }

  std::vector<unsigned int>
  JointChannels::nodes_on(const std::vector<std::string> &curves,
                          const std::string &where,
                          const std::string &entry) const
  {
    const auto &names = node_map.table().face_names;
    std::vector<bool> wanted(names.size(), false);
    for (const std::string &curve : curves)
    {
      const auto line = std::find(names.begin(), names.end(), curve);
      if (line == names.end())
        throw InputError(where + "'" + entry + "' names '" + curve
                         + "', but the mesh has no curve of that name. It "
                           "has: "
                         + known_names_like(curve, names) + ".");
      wanted[line - names.begin()] = true;
    }
    std::vector<unsigned int> nodes;
    for (const BoundaryFace<2> &face : gather_faces(node_map, wanted, true))
      for (const unsigned int node : face.nodes)
      {
        const auto found = std::lower_bound(
            node_of_mesh.begin(), node_of_mesh.end(), std::make_pair(node, 0U));
        if (found != node_of_mesh.end() && found->first == node)
          nodes.push_back(found->second);
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (nodes.empty())
      throw InputError(where
                       + "no joint of section 'Water joints' ends on the "
                         "curves of '"
                       + entry + "'. Name one where joints end"
                       + (entry == "Boundary" ? ", or give a 'Point'." : "."));
    return nodes;
  }

  void
  JointChannels::find_boundaries(const std::vector<WaterBoundary> &boundaries)
  {
    std::vector<dealii::Point<2>> place(elevation.size());
    for (unsigned int c = 0; c < faces.size(); ++c)
      for (unsigned int k = 0; k < 2; ++k)
        place[network.channels()[c].nodes[k]] = faces[c].points[k];

    constexpr unsigned int no_boundary = -1;
    std::vector<unsigned int> owner(elevation.size(), no_boundary);
    for (unsigned int b = 0; b < boundaries.size(); ++b)
    {
      const WaterBoundary &boundary = boundaries[b];
      const std::string where
          = "section 'Water boundaries/" + boundary.name + "': ";
      std::vector<unsigned int> nodes;
      if (boundary.point)
      {
        double nearest = std::numeric_limits<double>::max();
        for (unsigned int i = 0; i < place.size(); ++i)
        {
          const double distance
              = std::hypot(place[i][0] - (*boundary.point)[0],
                           place[i][1] - (*boundary.point)[1]);
          // Rounding must not decide between equal distances.
          if (distance < nearest * (1. - 1e-9))
          {
            nearest = distance;
            nodes   = { i };
          }
        }
        if (nearest > most_distance * node_map.table().diagonal())
          throw InputError(text_of(
              where, "'Point = ", (*boundary.point)[0], ", ",
              (*boundary.point)[1], "' is ", nearest,
              " m away from the nearest end or crossing of joints with water, "
              "at ",
              point_text(place[nodes[0]]),
              " m. Give the coordinates of the place that is meant."));
      }
      else
        nodes = nodes_on(boundary.curves, where, "Boundary");
      for (const unsigned int node : nodes)
      {
        if (owner[node] != no_boundary)
          throw InputError(
              where + "the end of a joint at (" + number_text(place[node][0])
              + ", " + number_text(place[node][1]) + ") m has a value of '"
              + boundaries[owner[node]].name
              + "' already. Give one value at each place.");
        owner[node] = b;
      }
      boundary_nodes.push_back(nodes);
    }
  }
} // namespace quoin
