// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/nodal_load.h>
#include <quoin/loads/prescribed_motion.h>
#include <quoin/loads/viscous_boundary.h>

#include <algorithm>

namespace quoin
{
  ViscousBoundary::ViscousBoundary(const LoadParameters &parameters,
                                   const unsigned int index,
                                   const BlockMesh<2> &mesh,
                                   const NodeExchange &exchange,
                                   const std::vector<Impedance> &impedance,
                                   const double thickness)
    : index(index), components(parameters.components)
  {
    load_name        = parameters.name;
    const auto faces = faces_of_curves(mesh, parameters.boundaries, load_name);
    node_list        = nodes_of_faces(mesh, exchange, faces);
    dashpots.resize(node_list.size());
    for (const unsigned int f : faces)
    {
      const BlockFace &face = mesh.boundary_faces[f];
      const auto edge
          = mesh.vertices[face.vertices[1]] - mesh.vertices[face.vertices[0]];
      const double half_area = 0.5 * edge.norm() * thickness;
      const auto t           = edge / edge.norm();
      const double n[2]      = { t[1], -t[0] }; // outward
      const Impedance &z     = impedance[mesh.cell_group[face.cell]];
      for (const unsigned int v : face.vertices)
      {
        if (!exchange.owns(v))
          continue;
        Dashpot &dashpot
            = dashpots[std::lower_bound(node_list.begin(), node_list.end(),
                                        exchange.local(v))
                       - node_list.begin()];
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

  void ViscousBoundary::begin_stage(State &state, const bool continues)
  {
    // Before the first stage nothing has been at rest.
    if (!continues)
      state.viscous_boundaries[index] = { state.step == 0, {} };
  }

  void ViscousBoundary::hold(const std::vector<CapturedNode> &captured,
                             ViscousBoundaryState &own) const
  {
    own.active = true;
    for (const unsigned int c : captured_positions)
      for (unsigned int d = 0; d < 2; ++d)
        own.held.push_back(captured[c].begun.v[d] - captured[c].force.v[d]);
  }

  void ViscousBoundary::correct(const StepContext &step,
                                const std::vector<CapturedNode> &captured,
                                State &state)
  {
    const double vn           = components[0].value(step.begin);
    const double vs           = components[1].value(step.begin);
    ViscousBoundaryState &own = state.viscous_boundaries[index];
    if (!own.active)
      hold(captured, own);
    const bool holds_forces = !own.held.empty();
    for (unsigned int i = 0; i < dashpots.size(); ++i)
    {
      const CapturedNode &before  = captured[captured_positions[i]];
      const Dashpot &dashpot      = dashpots[i];
      const auto &[cxx, cyy, cxy] = dashpot.damping;
      const double h = 0.5 * step.dt_velocity, m = before.mass;
      const double a  = h * step.mass_damping * m;
      const double vx = before.velocity.v[0], vy = before.velocity.v[1];
      const double fx
          = before.force.v[0] + (holds_forces ? own.held[2 * i] : 0.);
      const double fy
          = before.force.v[1] + (holds_forces ? own.held[2 * i + 1] : 0.);

      // (m + h c) v+ = (m - h c) v- + dt f, with c the 2x2 dashpot.
      const double bx
          = (m - a) * vx - h * (cxx * vx + cxy * vy)
            + 2. * h * (fx + vn * dashpot.normal[0] + vs * dashpot.shear[0]);
      const double by
          = (m - a) * vy - h * (cxy * vx + cyy * vy)
            + 2. * h * (fy + vn * dashpot.normal[1] + vs * dashpot.shear[1]);
      const double axx = m + a + h * cxx, ayy = m + a + h * cyy, axy = h * cxy;
      const double determinant = axx * ayy - axy * axy;

      NodeVector &after = state.velocity[before.node];
      after.v[0]        = (ayy * bx - axy * by) / determinant;
      after.v[1]        = (axx * by - axy * bx) / determinant;
      for (unsigned int d = 0; d < 2; ++d)
        state.nodes[before.node].u[d]
            = before.displacement.v[d] + step.dt * after.v[d];
    }
  }

  void ViscousBoundary::account(const StepContext &step,
                                const std::vector<CapturedNode> &captured,
                                State &state)
  {
    const double vn                 = components[0].value(step.begin);
    const double vs                 = components[1].value(step.begin);
    const std::vector<double> &held = state.viscous_boundaries[index].held;
    last_resultant                  = {};
    for (unsigned int i = 0; i < dashpots.size(); ++i)
    {
      const CapturedNode &before = captured[captured_positions[i]];
      const Dashpot &dashpot     = dashpots[i];
      const double *v0           = before.velocity.v;
      const double *v1           = state.velocity[before.node].v;
      const double mean[2] = { 0.5 * (v0[0] + v1[0]), 0.5 * (v0[1] + v1[1]) };
      const auto &[cxx, cyy, cxy] = dashpot.damping;
      const double drag[2]
          = { cxx * mean[0] + cxy * mean[1], cxy * mean[0] + cyy * mean[1] };
      for (unsigned int d = 0; d < 2; ++d)
      {
        if (before.owner[d] != this)
          continue;
        const double pushing = vn * dashpot.normal[d] + vs * dashpot.shear[d]
                               + (held.empty() ? 0. : held[2 * i + d]);
        const double w0 = 0.5 * step.dt_before * v0[d];
        const double w1 = 0.5 * step.dt * v1[d];
        state.energy.external += pushing * w0;
        state.pending.external += pushing * w1;
        state.energy.viscous += drag[d] * w0;
        state.pending.viscous += drag[d] * w1;
        const double rayleigh = step.mass_damping * before.mass * mean[d];
        state.energy.damping += rayleigh * w0;
        state.pending.damping += rayleigh * w1;
        last_resultant[d] += pushing - drag[d];
      }
    }
  }
} // namespace quoin
