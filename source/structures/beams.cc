// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/operators/archive.h>
#include <quoin/structures/beams.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iterator>

namespace quoin
{
  namespace
  {
    /** Nodes of the free beam of @p parameters. */
    LinedBoundary free_line(const BeamParameters &parameters)
    {
      const auto &corners = parameters.points;
      LinedBoundary result;
      for (unsigned int i = 1; i < corners.size(); ++i)
        for (unsigned int k = 0; k < parameters.n_segments; ++k)
        {
          const double s = double(k) / parameters.n_segments;
          result.places.emplace_back(
              (1. - s) * corners[i - 1][0] + s * corners[i][0],
              (1. - s) * corners[i - 1][1] + s * corners[i][1]);
        }
      result.is_closed = corners.front() == corners.back();
      if (!result.is_closed)
        result.places.emplace_back(corners.back()[0], corners.back()[1]);
      else if (result.places.size() < 3)
        throw InputError("section 'Beams/" + parameters.name
                         + "': 'Points' must be three points or more if the "
                           "beam is closed.");
      return result;
    }

    /** Refuses supports and forces of the ends of a closed beam. */
    void refuse_ends(const BeamParameters &beam)
    {
      const std::string names[] = { "Start", "End" };
      const auto refuse         = [&](const std::string &entry)
      {
        throw InputError("section 'Beams/" + beam.name + "': '" + entry
                         + "' is that of an end, but the beam is closed and "
                           "has none, so that it would do nothing. Leave it "
                           "out, or let the line end before it meets itself.");
      };
      for (const unsigned int end : { 0, 1 })
      {
        const BeamSupport &support = beam.supports[end];
        if (support.holds_x || support.holds_y || support.holds_rotation)
          refuse(names[end]);
        for (const unsigned int d : { 0, 1 })
          if (const TimeFunction &force = beam.forces[end][d];
              !force.is_constant() || force({ 0., 0. }) != 0.)
            refuse(names[end] + " force " + "xy"[d]);
      }
    }

    JointLaw law_of(const BeamParameters &liner,
                    const std::vector<JointSetParameters> &sets)
    {
      if (const auto *set = find_named(sets, liner.interface))
        return set->law;
      throw InputError(
          "section 'Beams/" + liner.name + "': 'Interface = "
          + liner.interface + "' is no set of joints. There are: "
          + known_names_like(liner.interface, sets, &JointSetParameters::name)
          + ".");
    }
  } // namespace

  Beams::Beams(const std::vector<BeamParameters> &parameters,
               const NodeMap<2> &nodes,
               const std::vector<JointSetParameters> &sets,
               const double thickness, const Thickness &group_thickness)
    : node_map(nodes),
      is_first_rank(
          dealii::Utilities::MPI::this_mpi_process(nodes.communicator()) == 0)
  {
    for (const BeamParameters &beam : parameters)
    {
      LinerInterface interface;
      if (beam.is_liner())
      {
        interface.law = law_of(beam, sets);
        n_internal_variables
            = std::max(n_internal_variables, n_internal(interface.law));
      }
      LinedBoundary nodes_of_beam
          = beam.is_liner() ? lined_boundary(beam, nodes, group_thickness)
                            : free_line(beam);
      if (nodes_of_beam.is_closed)
        refuse_ends(beam);
      interface.first  = n_points;
      interface.points = std::move(nodes_of_beam.points);
      beams.push_back(
          { BeamLine(beam,
                     beam.is_liner() ? nodes_of_beam.thickness : thickness,
                     n_nodes, nodes_of_beam.places, nodes_of_beam.is_closed),
            interface });
      n_nodes += nodes_of_beam.places.size();
      n_points += interface.points.size();
    }
  }

  void Beams::prepare(State<2> &state) const
  {
    if (state.find<BeamState>())
      return;
    BeamState &now = state.add<BeamState>();
    now.placed.resize(beams.size(), 0);
    for (const auto &[line, interface] : beams)
      for (const dealii::Point<2> &p : line.places)
        now.nodes.push_back({ p, {} });
    now.velocity.resize(n_nodes, dealii::Tensor<1, 2>());
    now.plastic.resize(n_nodes, 0.);
    now.moment.resize(n_nodes, 0.);
    now.attached.resize(n_points, 0);
    now.offset.resize(n_points, dealii::Tensor<1, 2>());
    now.interface.resize(n_points, n_internal_variables);
    now.block_motion.resize(2 * n_points, 0.);
    now.load.resize(n_nodes, dealii::Tensor<1, 2>());
  }

  void Beams::begin_stage(const std::string &name, State<2> &state)
  {
    BeamState &now = state.get<BeamState>();
    for (unsigned int b = 0; b < beams.size(); ++b)
    {
      auto &[line, interface]  = beams[b];
      const std::string &stage = line.given.stage;
      if (!now.placed[b] && (stage.empty() || stage == name))
      {
        find_block_motion(state, now);
        interface.attach(line, state);
        now.placed[b] = 1;
      }
    }
    resume_stage(state);
  }

  void Beams::resume_stage(const State<2> &state)
  {
    for (auto &[line, interface] : beams)
      line.find_rest(state.get<BeamState>());
  }

  bool Beams::cut(const std::vector<unsigned int> &blocks,
                  State<2> &state) const
  {
    BeamState &now  = state.get<BeamState>();
    BeamState going = now; // with what is cut alone
    bool any        = false;
    for (const auto &[line, interface] : beams)
      for (unsigned int k = 0; k < interface.points.size(); ++k)
      {
        const unsigned int p = interface.first + k;
        const bool goes      = interface.acts(k, state, now)
                          && std::find(blocks.begin(), blocks.end(),
                                       interface.points[k].block)
                                 != blocks.end();
        going.attached[p] = goes;
        any               = any || goes;
        if (goes)
          now.attached[p] = 0;
      }
    if (!any)
      return false;
    AlignedArray<dealii::Tensor<1, 2>> lost(n_nodes, dealii::Tensor<1, 2>()),
        by_point(n_points, dealii::Tensor<1, 2>());
    EnergyAccounts unused;
    going.stored_joint = 0.;
    find_block_motion(state, going);
    for (const auto &[line, interface] : beams)
      interface.add_forces(line, state, going, unused, lost.data(),
                           by_point.data());
    // The present energy includes the work of these forces over the last half
    // step.
    double power = 0.;
    for (const auto &[line, interface] : beams)
      for (unsigned int k = 0; k < interface.points.size(); ++k)
        if (const unsigned int node = interface.points[k].node;
            node != NodeMap<2>::none)
          power -= by_point[interface.first + k] * state.velocity[node];
    for (unsigned int i = 0; i < n_nodes; ++i)
    {
      if (is_first_rank)
        power += lost[i] * now.velocity[i];
      now.load[i] += lost[i];
    }
    now.stored_joint -= going.stored_joint;
    state.energy.external -= 0.5 * state.previous_time_step * power;
    if (is_first_rank)
      state.energy.external -= going.stored_joint;
    return true;
  }

  void Beams::set_gravity(const std::vector<const NodalLoad<2> *> &loads)
  {
    gravity_loads.clear();
    std::copy_if(loads.begin(), loads.end(), std::back_inserter(gravity_loads),
                 [](const NodalLoad<2> *load)
                 { return load->traits().is_everywhere; });
  }

  dealii::Tensor<1, 2> Beams::gravity(const TimePoint &time) const
  {
    dealii::Tensor<1, 2> acceleration;
    for (const NodalLoad<2> *load : gravity_loads)
    {
      const auto amplitude = load->amplitude(time);
      acceleration += vector_at(amplitude, 0);
    }
    return acceleration;
  }

  std::vector<double> Beams::loads(const TimePoint &time) const
  {
    std::vector<double> result;
    for (unsigned int b = 0; b < beams.size(); ++b)
    {
      const BeamParameters &given = beams[b].line.given;
      for (const auto *parts :
           { &given.forces[0], &given.forces[1], &given.distributed })
        for (const TimeFunction &part : *parts)
          result.push_back(grown(b, time) * part(time));
    }
    return result;
  }

  double Beams::grown(const unsigned int b, const TimePoint &time) const
  {
    return load_growth.empty() ? 1. : load_growth[b].share(time.stage);
  }

  std::vector<dealii::Tensor<1, 2>>
  Beams::node_loads(const unsigned int b, const TimePoint &time) const
  {
    return beams[b].line.loads(time, grown(b, time), gravity(time));
  }

  void Beams::add_forces(const StepContext &step, State<2> &state,
                         const NodeForces<2> &forces)
  {
    BeamState &now = state.get<BeamState>();
    force.assign(n_nodes, dealii::Tensor<1, 2>());
    AlignedArray<dealii::Tensor<1, 2>> by_point(n_points,
                                                dealii::Tensor<1, 2>());
    now.stored_strain = now.stored_joint = 0.;
    find_block_motion(state, now);
    EnergyAccounts lost;
    for (unsigned int b = 0; b < beams.size(); ++b)
      if (now.placed[b])
      {
        const auto &[line, interface] = beams[b];
        line.add_forces(now, lost, force.data());
        interface.add_forces(line, state, now, lost, force.data(),
                             by_point.data());
        const auto loads = node_loads(b, step.begin);
        for (unsigned int i = line.begin; i < line.end; ++i)
          force[i] += loads[i - line.begin];
      }
    add_block_forces(by_point, forces.force);
    if (is_first_rank)
      state.energy += lost;
  }

  void Beams::add_stored_energy(const State<2> &state,
                                EnergyAccounts &energies) const
  {
    if (!is_first_rank)
      return;
    energies.strain += state.get<BeamState>().stored_strain;
    energies.joint += state.get<BeamState>().stored_joint;
  }

  std::string Beams::settle(const TimePoint &time, const State<2> &committed,
                            State<2> &state, dealii::Tensor<1, 2> *block_force,
                            std::vector<Eigen::MatrixXd> *stiffness) const
  {
    BeamState &now = state.get<BeamState>();
    find_block_motion(state, now);
    now.stored_strain = now.stored_joint = 0.;
    AlignedArray<dealii::Tensor<1, 2>> by_point(n_points,
                                                dealii::Tensor<1, 2>());
    EnergyAccounts energy;
    if (stiffness)
      stiffness->assign(beams.size(), Eigen::MatrixXd());
    for (unsigned int b = 0; b < beams.size(); ++b)
      if (now.placed[b]
          && !find_equilibrium(
              beams[b], node_loads(b, time), node_map.table().diagonal(),
              committed, now, energy,
              { by_point.data(), stiffness ? &(*stiffness)[b] : nullptr }))
        return beams[b].line.given.name;
    add_block_forces(by_point, block_force);
    if (is_first_rank)
      state.energy += energy;
    return {};
  }

  std::vector<std::string> Beams::unstable(const State<2> &state) const
  {
    const BeamState &now = state.get<BeamState>();
    std::vector<std::string> result;
    for (unsigned int b = 0; b < beams.size(); ++b)
      if (now.placed[b] && is_unstable(beams[b], state, now))
        result.push_back(beams[b].line.given.name);
    return result;
  }

  void Beams::find_block_motion(const State<2> &state, BeamState &now) const
  {
    if (n_points == 0)
      return;
    auto &result = now.block_motion;
    result.assign(2 * n_points, 0.);
    for (const auto &[line, interface] : beams)
      for (unsigned int k = 0; k < interface.points.size(); ++k)
        if (const unsigned int node = interface.points[k].node;
            node != NodeMap<2>::none)
          set_vector<2>(result, interface.first + k, state.nodes[node].u);
    MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE,
                  MPI_SUM, node_map.communicator());
  }

  void
  Beams::add_block_forces(const AlignedArray<dealii::Tensor<1, 2>> &by_point,
                          dealii::Tensor<1, 2> *block_force) const
  {
    for (const auto &[line, interface] : beams)
      for (unsigned int k = 0; k < interface.points.size(); ++k)
        if (const unsigned int node = interface.points[k].node;
            node != NodeMap<2>::none)
          block_force[node] -= by_point[interface.first + k];
  }
} // namespace quoin
