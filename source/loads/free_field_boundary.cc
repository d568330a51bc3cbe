// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/loads/free_field_boundary.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/prescribed_motion.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Relative distance below which points coincide [-]. */
    constexpr double same_share = 1e-6;

    std::string at(const double x, const double y)
    {
      std::ostringstream text;
      text << "(" << x << ", " << y << ") m";
      return text.str();
    }
  } // namespace

  FreeFieldBoundary::FreeFieldBoundary(const LoadParameters &parameters,
                                       const NodeMap<2> &node_map,
                                       const FreeFieldGround &ground,
                                       const FreeFieldBase &given)
  {
    load_name            = parameters.name;
    own_traits.companion = given.load.name;
    const auto faces
        = faces_of_curves(node_map, parameters.boundaries, load_name);
    node_list = nodes_of_faces(node_map, faces);
    make_column(faces, ground);
    make_shares(node_map, faces);
    const auto base_faces = make_foot(node_map, given);

    std::vector<Impedance> impedance;
    for (const LinearElastic &material : ground.materials)
      impedance.push_back(impedance_of(material, ground.plane));
    side_dashpots.resize(node_list.size());
    base_dashpots.resize(node_list.size());
    add_dashpots(node_map, faces, impedance, ground.thickness, node_list,
                 side_dashpots);
    if (!base.is_prescribed)
      add_dashpots(node_map, base_faces, given.impedance, ground.thickness,
                   node_list, base_dashpots);
    damping.resize(node_list.size());
    pull.resize(node_list.size());
    for (unsigned int i = 0; i < node_list.size(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        damping[i][k]
            = side_dashpots[i].damping[k] + base_dashpots[i].damping[k];
    traction.resize(layers.size());
    force.resize(2 * node_height.size());
    mean_velocity.resize(2 * node_height.size());
  }

  void FreeFieldBoundary::fail(const std::string &setting,
                               const std::string &why) const
  {
    throw InputError("section 'Loads/" + load_name + "': '" + setting + "' "
                     + why);
  }

  // -- what is constant ------------------------------------------------------

  void FreeFieldBoundary::make_column(const std::vector<BoundaryFace<2>> &faces,
                                      const FreeFieldGround &ground)
  {
    // Edges point up where the cells are on the left of the side.
    struct Edge
    {
      double bottom, top;
      unsigned int group;
    };
    std::vector<Edge> edges;
    for (const BoundaryFace<2> &face : faces)
    {
      const auto &a  = face.points[0];
      const auto &b  = face.points[1];
      const double n = b[1] > a[1] ? 1. : -1.;
      if (edges.empty())
      {
        x       = a[0];
        outward = n;
      }
      const double near = same_share * a.distance(b);
      if (std::abs(b[0] - a[0]) > near || std::abs(a[0] - x) > near
          || n != outward)
        fail(
            "Boundary",
            "must be one vertical side of the model, but has an edge from "
                + at(a[0], a[1]) + " to " + at(b[0], b[1])
                + " that is not vertical, not in line with the first one or on "
                  "the other side of its block. Give each side a load of its "
                  "own.");
      const unsigned int group = face.group;
      if (ground.is_rigid[group])
        fail("Boundary", "meets a rigid block at " + at(a[0], a[1])
                             + ", in which no waves run: make it deformable.");
      if (ground.yields[group])
        fail("Boundary", "meets ground of the law 'Mohr-Coulomb' at "
                             + at(a[0], a[1])
                             + ", but the column beside it is elastic: give "
                               "the ground along the sides a material of its "
                               "own with 'Law = linear elastic'.");
      edges.push_back({ std::min(a[1], b[1]), std::max(a[1], b[1]), group });
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge &a, const Edge &b) { return a.bottom < b.bottom; });

    node_height.push_back(edges.front().bottom);
    node_mass.assign(edges.size() + 1, 0.);
    for (const Edge &edge : edges)
    {
      const double height = edge.top - node_height.back();
      if (std::abs(edge.bottom - node_height.back()) > same_share * height)
        fail("Boundary", "has a gap between " + at(x, node_height.back())
                             + " and " + at(x, edge.bottom)
                             + ": the column needs all of the side.");
      const LinearElastic &material = ground.materials[edge.group];
      const double thickness        = ground.thickness[edge.group];
      const double half = 0.5 * material.density * height * thickness;
      node_mass[layers.size()] += half;
      node_mass[layers.size() + 1] += half;
      layers.push_back({ height, thickness, material.density,
                         plane_stiffness(material, ground.plane) });
      node_height.push_back(edge.top);
    }
  }

  unsigned int FreeFieldBoundary::node_at(const double height) const
  {
    // The nearer of the nodes below and above.
    const unsigned int above
        = std::lower_bound(node_height.begin(), node_height.end() - 1, height)
          - node_height.begin();
    return above > 0
                   && height - node_height[above - 1]
                          < node_height[above] - height
               ? above - 1
               : above;
  }

  void FreeFieldBoundary::make_shares(const NodeMap<2> &node_map,
                                      const std::vector<BoundaryFace<2>> &faces)
  {
    column_node.resize(node_list.size());
    for (const BoundaryFace<2> &face : faces)
    {
      const double bottom      = std::min(face.points[0][1], face.points[1][1]);
      const unsigned int layer = node_at(bottom);
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int v = face.nodes[k];
        if (!node_map.exchange().owns(v))
          continue;
        const unsigned int node
            = std::lower_bound(node_list.begin(), node_list.end(),
                               node_map.exchange().local(v))
              - node_list.begin();
        column_node[node] = node_at(face.points[k][1]);
        shares.push_back(
            { node, layer,
              0.5 * outward * layers[layer].height * layers[layer].thickness });
      }
    }
  }

  std::vector<BoundaryFace<2>>
  FreeFieldBoundary::make_foot(const NodeMap<2> &node_map,
                               const FreeFieldBase &given)
  {
    base.name          = given.load.name;
    base.is_prescribed = given.load.type == LoadType::prescribed_motion;
    base.components    = given.load.components;
    const auto faces
        = faces_of_curves(node_map, given.load.boundaries, given.load.name);
    const double foot = node_height.front();
    const double near = same_share * layers.front().height;
    for (const BoundaryFace<2> &face : faces)
    {
      const auto &a = face.points[0];
      const auto &b = face.points[1];
      for (const auto &p : { a, b })
      {
        if (std::abs(p[0] - x) > near || std::abs(p[1] - foot) > near)
          continue;
        if (std::abs(a[1] - b[1]) > near)
          fail("Base", "is '" + base.name + "', which is not horizontal at "
                           + at(x, foot)
                           + ": waves would not propagate vertically from it.");
        const Impedance &z = given.impedance[face.group];
        const double width = layers.front().thickness;
        base.impedance = dealii::Point<2>(width * z.shear, width * z.normal);
        return faces;
      }
    }
    fail("Base", "is '" + base.name
                     + "', which does not meet the foot of the "
                       "side at "
                     + at(x, foot)
                     + ": it must be the load on the boundary below.");
  }

  double FreeFieldBoundary::largest_eigenvalue() const
  {
    // omega^2 of one layer with half of its mass at either end.
    double largest = 0.;
    for (const Layer &layer : layers)
      largest = std::max(largest,
                         4. * layer.stiffness.c11
                             / (layer.density * layer.height * layer.height));
    return largest;
  }

  // -- a step ----------------------------------------------------------------

  void FreeFieldBoundary::prepare(State<2> &state) const
  {
    state.add<FreeFieldState>(load_name);
  }

  void FreeFieldBoundary::begin_stage(State<2> &state, const bool continues)
  {
    if (!continues)
      state.get<FreeFieldState>(load_name) = FreeFieldState();
  }

  void FreeFieldBoundary::start(const std::vector<CapturedNode<2>> &captured,
                                FreeFieldState &column)
  {
    column.active = true;
    column.displacement.assign(2 * node_height.size(), 0.);
    column.velocity = column.displacement;
    for (const unsigned int c : captured_positions)
      append_vector(column.held, captured[c].begun - captured[c].force);
  }

  void FreeFieldBoundary::move_foot(const StepContext &step,
                                    const double *unbalanced,
                                    FreeFieldState &column) const
  {
    const double h = 0.5 * step.dt_velocity, m = node_mass.front();
    for (unsigned int d = 0; d < base.impedance.dimension; ++d)
    {
      const LoadComponent &given = base.components[d];
      double &v                  = column.velocity[d];
      if (base.is_prescribed && given.quantity != LoadQuantity::free)
      {
        v = given.quantity == LoadQuantity::velocity
                ? given.value(step.middle)
                : (given.value(step.end) - given.value(step.begin)) / step.dt;
        continue;
      }
      // At the foot shear is along x, normal along y.
      const double z = base.is_prescribed ? 0. : base.impedance[d];
      const double incident
          = base.is_prescribed ? 0. : base.components[1 - d].value(step.begin);
      const double drag = h * (z + step.mass_damping * m);
      v = ((m - drag) * v + 2. * h * (unbalanced[d] + 2. * z * incident))
          / (m + drag);
    }
  }

  void FreeFieldBoundary::advance(const StepContext &step,
                                  FreeFieldState &column)
  {
    const auto &u = column.displacement;
    auto &v       = column.velocity;
    std::fill(force.begin(), force.end(), 0.);
    for (unsigned int e = 0; e < layers.size(); ++e)
    {
      const Layer &layer = layers[e];
      // Shear and vertical strain.
      const dealii::Tensor<1, 2> strain
          = (vector_at(u, e + 1) - vector_at(u, e)
             + step.stiffness_damping * (vector_at(v, e + 1) - vector_at(v, e)))
            / layer.height;
      const dealii::Point<2> stress(layer.stiffness.c33 * strain[0],
                                    layer.stiffness.c11 * strain[1]);
      traction[e]
          = dealii::Point<2>(layer.stiffness.c12 * strain[1], stress[0]);
      add_to_vector(force, e, layer.thickness * stress);
      add_to_vector(force, e + 1, -layer.thickness * stress);
    }

    mean_velocity  = v;
    const double a = 0.5 * step.dt_velocity * step.mass_damping;
    for (unsigned int i = 2; i < v.size(); ++i)
      v[i] = ((1. - a) * v[i] + step.dt_velocity * force[i] / node_mass[i / 2])
             / (1. + a);
    move_foot(step, force.data(), column);
    for (unsigned int i = 0; i < v.size(); ++i)
    {
      mean_velocity[i] = 0.5 * (mean_velocity[i] + v[i]);
      column.displacement[i] += step.dt * v[i];
    }
  }

  void FreeFieldBoundary::correct(const StepContext &step,
                                  const std::vector<CapturedNode<2>> &captured,
                                  State<2> &state)
  {
    FreeFieldState &column = state.get<FreeFieldState>(load_name);
    if (!column.active)
      start(captured, column);
    advance(step, column);

    const double vn
        = base.is_prescribed ? 0. : base.components[0].value(step.begin);
    const double vs
        = base.is_prescribed ? 0. : base.components[1].value(step.begin);
    for (unsigned int i = 0; i < pull.size(); ++i)
    {
      const auto v = vector_at(mean_velocity, column_node[i]);
      pull[i]      = base_dashpots[i].pull(vn, vs) + vector_at(column.held, i);
      for (unsigned int d = 0; d < v.dimension; ++d)
        pull[i][d] += side_dashpots[i].damping[d] * v[d];
    }
    for (const Share &share : shares)
      pull[share.node] += share.area * traction[share.layer];
    for (unsigned int i = 0; i < pull.size(); ++i)
      move_with_dashpot(step, captured[captured_positions[i]], damping[i],
                        pull[i], state);
  }

  void FreeFieldBoundary::account(const StepContext &step,
                                  const std::vector<CapturedNode<2>> &captured,
                                  State<2> &state)
  {
    last_resultant = {};
    for (unsigned int i = 0; i < pull.size(); ++i)
      account_for_dashpot(step, captured[captured_positions[i]], damping[i],
                          pull[i], this, last_resultant, state);
  }
} // namespace quoin
