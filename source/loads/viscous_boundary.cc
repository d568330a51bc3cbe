// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/prescribed_motion.h>
#include <quoin/loads/viscous_boundary.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  Impedance impedance_of(const LinearElastic &material,
                         const PlaneAssumption assumption)
  {
    const PlaneStiffness stiffness = plane_stiffness(material, assumption);
    return { std::sqrt(material.density * stiffness.c11),
             std::sqrt(material.density * stiffness.c33) };
  }

  void add_dashpots(const NodeMap<2> &node_map,
                    const std::vector<BoundaryFace<2>> &faces,
                    const std::vector<Impedance> &impedance,
                    const double thickness,
                    const std::vector<unsigned int> &nodes,
                    std::vector<Dashpot> &dashpots)
  {
    for (const BoundaryFace<2> &face : faces)
    {
      const auto edge        = face.points[1] - face.points[0];
      const double half_area = 0.5 * edge.norm() * thickness;
      const auto t           = edge / edge.norm();
      const double n[2]      = { t[1], -t[0] }; // outward
      const Impedance &z     = impedance[face.group];
      for (const unsigned int v : face.nodes)
      {
        if (!node_map.exchange().owns(v))
          continue;
        const auto found = std::lower_bound(nodes.begin(), nodes.end(),
                                            node_map.exchange().local(v));
        if (found == nodes.end() || *found != node_map.exchange().local(v))
          continue;
        Dashpot &dashpot = dashpots[found - nodes.begin()];
        const double zn = z.normal * half_area, zs = z.shear * half_area;
        dashpot.damping[0] += zn * n[0] * n[0] + zs * t[0] * t[0];
        dashpot.damping[1] += zn * n[1] * n[1] + zs * t[1] * t[1];
        dashpot.damping[2] += zn * n[0] * n[1] + zs * t[0] * t[1];
        for (unsigned int d = 0; d < 2; ++d)
        {
          dashpot.normal[d] -= 2. * zn * n[d];
          dashpot.shear[d] += 2. * zs * t[d];
        }
      }
    }
  }

  void move_with_dashpot(const StepContext &step, const CapturedNode<2> &before,
                         const std::array<double, 3> &damping,
                         const std::array<double, 2> &pull, State<2> &state)
  {
    const auto &[cxx, cyy, cxy] = damping;
    const double h = 0.5 * step.dt_velocity, m = before.mass;
    const double a  = h * step.mass_damping * m;
    const double vx = before.velocity.v[0], vy = before.velocity.v[1];
    const double bx = (m - a) * vx - h * (cxx * vx + cxy * vy)
                      + 2. * h * (before.force.v[0] + pull[0]);
    const double by = (m - a) * vy - h * (cxy * vx + cyy * vy)
                      + 2. * h * (before.force.v[1] + pull[1]);
    const double axx = m + a + h * cxx, ayy = m + a + h * cyy, axy = h * cxy;
    const double determinant = axx * ayy - axy * axy;

    NodeVector<2> &after = state.velocity[before.node];
    after.v[0]           = (ayy * bx - axy * by) / determinant;
    after.v[1]           = (axx * by - axy * bx) / determinant;
    for (unsigned int d = 0; d < 2; ++d)
      state.nodes[before.node].u[d]
          = before.displacement.v[d] + step.dt * after.v[d];
  }

  void account_for_dashpot(const StepContext &step,
                           const CapturedNode<2> &before,
                           const std::array<double, 3> &damping,
                           const std::array<double, 2> &pull,
                           const MotionConstraint<2> *owner,
                           std::array<double, 3> &resultant, State<2> &state)
  {
    const auto &[cxx, cyy, cxy] = damping;
    const double *v0            = before.velocity.v;
    const double *v1            = state.velocity[before.node].v;
    const double mean[2] = { 0.5 * (v0[0] + v1[0]), 0.5 * (v0[1] + v1[1]) };
    const double drag[2]
        = { cxx * mean[0] + cxy * mean[1], cxy * mean[0] + cyy * mean[1] };
    double reaction[2] = { 0., 0. };
    for (unsigned int d = 0; d < 2; ++d)
    {
      if (before.owner[d] != owner)
        continue;
      const double w0 = 0.5 * step.dt_before * v0[d];
      const double w1 = 0.5 * step.dt * v1[d];
      state.energy.external += pull[d] * w0;
      state.pending.external += pull[d] * w1;
      state.energy.viscous += drag[d] * w0;
      state.pending.viscous += drag[d] * w1;
      const double rayleigh = step.mass_damping * before.mass * mean[d];
      state.energy.damping += rayleigh * w0;
      state.pending.damping += rayleigh * w1;
      reaction[d] = pull[d] - drag[d];
      resultant[d] += reaction[d];
    }
    resultant[2] += moment_of(reaction, before, state.nodes[before.node]);
  }

  ViscousBoundary::ViscousBoundary(const LoadParameters &parameters,
                                   const NodeMap<2> &node_map,
                                   const std::vector<Impedance> &impedance,
                                   const double thickness)
    : components(parameters.components)
  {
    load_name = parameters.name;
    const auto faces
        = faces_of_curves(node_map, parameters.boundaries, load_name);
    node_list = nodes_of_faces(node_map, faces);
    dashpots.resize(node_list.size());
    add_dashpots(node_map, faces, impedance, thickness, node_list, dashpots);
  }

  void ViscousBoundary::prepare(State<2> &state) const
  {
    state.add<ViscousBoundaryState>(load_name);
  }

  void ViscousBoundary::begin_stage(State<2> &state, const bool continues)
  {
    // Before the first stage nothing has been at rest.
    if (!continues)
      state.get<ViscousBoundaryState>(load_name) = { state.step == 0, {} };
  }

  void ViscousBoundary::hold(const std::vector<CapturedNode<2>> &captured,
                             ViscousBoundaryState &own) const
  {
    own.active = true;
    for (const unsigned int c : captured_positions)
      for (unsigned int d = 0; d < 2; ++d)
        own.held.push_back(captured[c].begun.v[d] - captured[c].force.v[d]);
  }

  std::array<double, 2>
  ViscousBoundary::pull(const unsigned int i, const double vn, const double vs,
                        const ViscousBoundaryState &own) const
  {
    std::array<double, 2> result = dashpots[i].pull(vn, vs);
    if (!own.held.empty())
      for (unsigned int d = 0; d < 2; ++d)
        result[d] += own.held[2 * i + d];
    return result;
  }

  void ViscousBoundary::correct(const StepContext &step,
                                const std::vector<CapturedNode<2>> &captured,
                                State<2> &state)
  {
    const double vn           = components[0].value(step.begin);
    const double vs           = components[1].value(step.begin);
    ViscousBoundaryState &own = state.get<ViscousBoundaryState>(load_name);
    if (!own.active)
      hold(captured, own);
    for (unsigned int i = 0; i < dashpots.size(); ++i)
      move_with_dashpot(step, captured[captured_positions[i]],
                        dashpots[i].damping, pull(i, vn, vs, own), state);
  }

  void ViscousBoundary::account(const StepContext &step,
                                const std::vector<CapturedNode<2>> &captured,
                                State<2> &state)
  {
    const double vn = components[0].value(step.begin);
    const double vs = components[1].value(step.begin);
    const ViscousBoundaryState &own
        = state.get<ViscousBoundaryState>(load_name);
    last_resultant = {};
    for (unsigned int i = 0; i < dashpots.size(); ++i)
      account_for_dashpot(step, captured[captured_positions[i]],
                          dashpots[i].damping, pull(i, vn, vs, own), this,
                          last_resultant, state);
  }
} // namespace quoin
