// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/structures/beam_motion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 2>;

    /** Mass of a node without that of a scaled step [kg]. */
    double own_mass(const BeamLine &line, const unsigned int node)
    {
      return line.share * line.given.density * line.given.area
             * line.at_rest(node).length;
    }

    double largest_of(const NodeStiffness<2> &bound)
    {
      return 0.5 * (bound[0] + bound[1])
             + std::hypot(0.5 * (bound[0] - bound[1]), bound[2]);
    }

    void add(NodeStiffness<2> &bound, const double k, const Vector &direction)
    {
      bound[0] += k * direction[0] * direction[0];
      bound[1] += k * direction[1] * direction[1];
      bound[2] += k * direction[0] * direction[1];
    }

    /** Adds the stiffness bound of @p line to that of the nodes of all beams
        [N/m]. */
    void add_bound(const BeamLine &line, const BeamState &now,
                   std::vector<NodeStiffness<2>> &bound)
    {
      std::vector<BeamLine::Segment> all;
      for (unsigned int k = 0; k < line.n_segments(); ++k)
      {
        const unsigned int i = line.begin + k;
        all.push_back(line.segment(i, now));
        const double stiffness = 2. * line.axial_stiffness / all.back().rest;
        add(bound[i], stiffness, all.back().direction);
        add(bound[line.next(i)], stiffness, all.back().direction);
      }
      // A hinge stores k (b . u)^2 / 2 with a vector b_j of each of its nodes,
      // and (b . u)^2 <= sum_j |b_j| sum_j (b_j . u_j)^2 / |b_j|.
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        double angle;
        if (!line.turning(i, now, angle))
          continue;
        std::map<unsigned int, Vector> b;
        for (const unsigned int first : line.segments_at(i))
        {
          const BeamLine::Segment &s = all[first - line.begin];
          const double sign          = first == i ? 1. : -1.;
          const dealii::Point<2> n(-s.direction[1] / s.length,
                                   s.direction[0] / s.length);
          const Vector slope
              = sign * n - 0.5 * line.at_rest(i).curvature * s.direction;
          b[line.next(first)] += slope;
          b[first] -= slope;
        }
        double sum = 0.;
        for (const auto &[node, direction] : b)
          sum += std::hypot(direction[0], direction[1]);
        for (const auto &[node, direction] : b)
          if (const double size = std::hypot(direction[0], direction[1]);
              size > 0.)
            add(bound[node],
                line.bending_stiffness / line.at_rest(i).length * sum / size,
                direction);
      }
    }
  } // namespace

  BeamMotion::BeamMotion(const Beams &beams, const NodeMap<2> &nodes)
    : beams(beams), node_map(nodes),
      is_first_rank(
          dealii::Utilities::MPI::this_mpi_process(nodes.communicator()) == 0)
  {
    const unsigned int n
        = beams.all().empty() ? 0 : beams.all().back().line.end;
    mass.assign(n, 0.);
    inverse_mass.assign(n, 0.);
    viscous.assign(n, dealii::Tensor<1, 2>());
  }

  void BeamMotion::find_masses(const double scaled_step, const State<2> &state)
  {
    const auto bound = stiffness_bound(state);
    for (const auto &[line, interface] : beams.all())
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        mass[i] = std::max(own_mass(line, i), 0.25 * scaled_step * scaled_step
                                                  * largest_of(bound[i]));
        inverse_mass[i] = 1. / mass[i];
      }
  }

  BeamMasses BeamMotion::masses(const State<2> &state) const
  {
    BeamMasses result;
    for (unsigned int b = 0; b < beams.all().size(); ++b)
      if (state.get<BeamState>().placed[b])
      {
        const BeamLine &line = beams.all()[b].line;
        result.emplace_back();
        for (unsigned int i = line.begin; i < line.end; ++i)
          result.back().push_back({ own_mass(line, i), mass[i] });
      }
    return result;
  }

  std::vector<double> BeamMotion::interface_bound(const State<2> &state) const
  {
    const BeamState &now = state.get<BeamState>();
    std::vector<double> result;
    for (const auto &[line, interface] : beams.all())
      for (unsigned int k = 0; k < interface.points.size(); ++k)
        if (const unsigned int node = interface.points[k].node;
            now.attached[interface.first + k] && node != NodeMap<2>::none)
        {
          result.resize(node_map.n_local(), 0.);
          result[node] += interface.stiffness_bound(k);
        }
    return result;
  }

  std::vector<NodeStiffness<2>>
  BeamMotion::stiffness_bound(const State<2> &state) const
  {
    constexpr unsigned int dim = 2;
    // The bound is that of the shape at rest, so that a resumed run has the
    // time step of the whole run.
    BeamState now = state.get<BeamState>();
    for (NodeRecord<dim> &node : now.nodes)
      node.u = dealii::Tensor<1, dim>();
    std::vector<NodeStiffness<dim>> result(mass.size(), NodeStiffness<dim>{});
    for (unsigned int b = 0; b < beams.all().size(); ++b)
    {
      const auto &[line, interface] = beams.all()[b];
      if (!now.placed[b])
        continue;
      add_bound(line, now, result);
      for (unsigned int k = 0; k < interface.points.size(); ++k)
        if (now.attached[interface.first + k])
          for (unsigned int d = 0; d < dim; ++d)
            result[line.begin + interface.points[k].at][d]
                += interface.stiffness_bound(k);
    }
    return result;
  }

  double BeamMotion::largest_eigenvalue(const State<2> &state) const
  {
    const auto bound = stiffness_bound(state);
    double largest   = 0.;
    for (unsigned int i = 0; i < mass.size(); ++i)
      largest = std::max(largest, largest_of(bound[i]) / mass[i]);
    return largest;
  }

  BeamMotion::Work BeamMotion::advance(const StepContext &step,
                                       const bool damped, const bool adaptive,
                                       State<2> &state)
  {
    BeamState &now  = state.get<BeamState>();
    velocity_before = now.velocity;
    force           = beams.node_forces();
    Work work;
    double given_before = 0., given_after = 0.;
    for (unsigned int b = 0; b < beams.all().size(); ++b)
    {
      const BeamLine &line = beams.all()[b].line;
      if (!now.placed[b])
        continue;
      const auto loads = beams.node_loads(b, step.begin);
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        const Vector &load = loads[i - line.begin];
        work.applied += std::hypot(load[0], load[1]);
        for (unsigned int d = 0; d < load.dimension; ++d)
        {
          given_before += load[d] * now.velocity[i][d];
          if (!line.held(i, d))
            continue;
          work.applied += std::abs(force[i][d]);
          force[i][d] = 0.;
        }
        work.unbalanced += std::hypot(force[i][0], force[i][1]);
      }
      if (!damped)
        advance_nodes(line.begin, line.end, now.nodes.data(),
                      now.velocity.data(), force.data(), inverse_mass.data(),
                      step.dt_velocity, step.dt);
      else
      {
        const DampingFactors factors{ step.local_damping, step.mass_damping,
                                      step.dt_before, step.dt_velocity };
        const auto move = adaptive ? advance_nodes_damped<true, 2>
                                   : advance_nodes_damped<false, 2>;
        work.damping
            += move(line.begin, line.end, now.nodes.data(), now.velocity.data(),
                    force.data(), viscous.data(), mass.data(),
                    inverse_mass.data(), factors, step.dt);
      }
      for (unsigned int i = line.begin; i < line.end; ++i)
        given_after += loads[i - line.begin] * now.velocity[i];
    }
    if (!is_first_rank)
      return Work();
    state.energy.external += 0.5 * step.dt_before * given_before;
    state.pending.external += 0.5 * step.dt * given_after;
    return work;
  }

  double BeamMotion::kinetic_energy(const State<2> &state,
                                    const double share) const
  {
    const BeamState &now = state.get<BeamState>();
    double energy        = 0.;
    if (is_first_rank)
      for (unsigned int i = 0; i < mass.size(); ++i)
      {
        const Vector &v = velocity_before[i];
        energy += 0.5 * mass[i] * (v * (v + share * (now.velocity[i] - v)));
      }
    return energy;
  }

  double BeamMotion::kinetic_energy(const State<2> &state) const
  {
    const BeamState &now = state.get<BeamState>();
    double energy        = 0.;
    if (is_first_rank)
      for (unsigned int i = 0; i < mass.size(); ++i)
        energy += 0.5 * mass[i] * now.velocity[i].norm_square();
    return energy;
  }

  double BeamMotion::squared_change(const State<2> &state) const
  {
    const BeamState &now = state.get<BeamState>();
    double sum           = 0.;
    if (is_first_rank)
      for (unsigned int i = 0; i < mass.size(); ++i)
        sum += mass[i] * (now.velocity[i] - velocity_before[i]).norm_square();
    return sum;
  }

  void BeamMotion::check_finite(const State<2> &state) const
  {
    const BeamState &now = state.get<BeamState>();
    for (const auto &[line, interface] : beams.all())
      for (unsigned int i = line.begin; i < line.end; ++i)
        if (!(now.nodes[i].u.norm() < 1e100)) // false with NaN, too
          throw RunError(text_of(
              "the motion of the beam '", line.given.name,
              "' is no longer finite, found at time ", state.time,
              " s. Look at its loads, or reduce 'Share of critical time "
              "step'. The last checkpoint is kept."));
  }
} // namespace quoin
