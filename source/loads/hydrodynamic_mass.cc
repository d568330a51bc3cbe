// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/none.h>
#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/loads/hydrodynamic_mass.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace quoin
{
  namespace
  {
    constexpr double density = 1000.; // [kg/m^3]
    /** Share of the vertical in the normal of a face above which it is no
        upstream face but a floor: 60 degrees off the vertical. */
    const double most_flat = std::sqrt(0.75);
  } // namespace

  HydrodynamicMass::HydrodynamicMass(const LoadParameters &load,
                                     const NodeMap<2> &nodes,
                                     const Thickness &thickness)
    : load_name(load.name), level(*load.pressure.field->level())
  {
    double lowest = std::numeric_limits<double>::max();
    for (const BoundaryFace<2> &given :
         faces_of_curves(nodes, load.boundaries, load.name))
    {
      const auto outward = outward_area(given.points);
      const auto middle  = dealii::Point<2>(
          0.5 * (dealii::Tensor<1, 2>(given.points[0]) + given.points[1]));
      const std::string at = "section 'Loads/" + load.name
                             + "': 'Added mass = Westergaard', but the face at "
                             + point_text(middle) + " m ";
      if (std::abs(outward[1]) > most_flat * outward.norm())
        throw InputError(at
                         + "is within 30 degrees of the horizontal, a floor "
                           "for which it does not hold. Give floors a load of "
                           "their own, without added mass.");
      if (nodes.table().is_rigid[given.block])
        throw InputError(at
                         + "belongs to a rigid block, which has one mass in "
                           "all directions. Make the block deformable, stiff "
                           "if need be.");
      Face face;
      bool is_here = false;
      for (unsigned int k = 0; k < 2; ++k)
      {
        lowest         = std::min(lowest, given.points[k][1]);
        face.points[k] = given.points[k];
        face.shares[k] = given.shares[k];
        face.nodes[k]  = none;
        if (!nodes.exchange().owns(given.nodes[k]))
          continue;
        is_here       = true;
        face.nodes[k] = nodes.exchange().local(given.nodes[k]);
      }
      face.outward = thickness[given.group] * outward;
      if (is_here)
        faces.push_back(face);
    }
    floor = load.reservoir_floor.value_or(lowest);
    if (floor > lowest)
      throw InputError(text_of("section 'Loads/", load.name,
                               "': 'Reservoir floor = ", floor,
                               "' is above the lowest point of 'Boundary', at "
                               "y = ",
                               lowest,
                               " m. Give the height of the ground below the "
                               "water, or 'automatic'."));
  }

  bool HydrodynamicMass::changes(const double start,
                                 const double duration) const
  {
    constexpr unsigned int n_samples = 100;
    const double height              = level({ 0., start }) - floor;
    for (unsigned int i = 1; i <= n_samples; ++i)
    {
      const double t = duration * i / n_samples;
      if (std::abs(level({ t, start + t }) - floor - height)
          > 1e-9 * std::abs(height))
        return true;
    }
    return false;
  }

  std::vector<NodeMass<2>> HydrodynamicMass::masses(const double start) const
  {
    const double height = level({ 0., start }) - floor;
    // In r = sqrt(z), in which the integrand is a polynomial of degree 4, rules
    // of three points are exact.
    const double gauss[]       = { -std::sqrt(0.6), 0., std::sqrt(0.6) };
    constexpr double weights[] = { 5. / 18., 8. / 18., 5. / 18. };
    std::map<unsigned int, NodeMass<2>> found;
    for (const Face &face : faces)
    {
      const double area = face.outward.norm();
      const double z0   = floor + height - face.points[0][1];
      const double z1   = floor + height - face.points[1][1];
      const double r0   = std::sqrt(std::max(0., z0)),
                   r1   = std::sqrt(std::max(0., z1));
      for (unsigned int q = 0; q < 3 && r0 != r1; ++q)
      {
        const double r  = 0.5 * (r0 + r1) + 0.5 * (r1 - r0) * gauss[q];
        const double at = (r * r - z0) / (z1 - z0);
        // dz = 2 r dr
        const double mass = 0.875 * density * std::sqrt(height) * r * area
                            * weights[q] * 2. * r * (r1 - r0) / (z1 - z0);
        for (unsigned int k = 0; k < 2; ++k)
        {
          if (face.nodes[k] == none)
            continue;
          const double phi  = (k == 0 ? 1. - at : at) + face.shares[k] - 0.5;
          NodeMass<2> &node = found[face.nodes[k]];
          node.node         = face.nodes[k];
          node.mass += phi * mass / (area * area)
                       * outer_product(face.outward, face.outward);
        }
      }
    }
    std::vector<NodeMass<2>> result;
    for (const auto &[number, node] : found)
      result.push_back(node);
    return result;
  }

  std::vector<NodeMass<2>> merged(const std::vector<NodeMass<2>> &a,
                                  const std::vector<NodeMass<2>> &b)
  {
    std::map<unsigned int, NodeMass<2>> found;
    for (const auto *const list : { &a, &b })
      for (const NodeMass<2> &each : *list)
      {
        NodeMass<2> &node = found[each.node];
        node.node         = each.node;
        node.mass += each.mass;
      }
    std::vector<NodeMass<2>> result;
    for (const auto &[number, node] : found)
      result.push_back(node);
    return result;
  }
} // namespace quoin
