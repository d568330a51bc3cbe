// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/disjoint_sets.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/number_text.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/operators/archive.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace quoin
{
  namespace
  {
    /** Largest change of a pressure, by the largest pressure or that of water
        as high as a channel is long, at which an equilibrium is one [-]. */
    constexpr double pressure_tolerance    = 1e-6;
    constexpr unsigned int most_iterations = 60;

    /** Points from the lower to the upper side. */
    dealii::Tensor<1, 2> normal_of(const JointChannel &face)
    {
      const auto along = face.points[1] - face.points[0];
      return dealii::Point<2>(along[1], -along[0]) / along.norm();
    }
  } // namespace

  JointFlow::JointFlow(const WaterParameters &parameters,
                       const NodeMap<2> &nodes, const MatchedJoints &joints,
                       const std::vector<JointSetParameters> &sets,
                       const Thickness &thickness)
    : given(parameters), node_map(nodes), joints(joints),
      places(parameters, nodes, joints, sets, thickness),
      flow_network(places.network), is_wall(places.elevation.size(), 0),
      compliance(places.elevation.size(), 0.)
  {
    now.boundary_flow.assign(given.boundaries.size(), 0.);
    now.node_inflow.assign(places.elevation.size(), 0.);
    now.pressure.assign(places.elevation.size(), 0.);
    now.content.assign(places.elevation.size(), 0.);
    const std::size_t n = joints.segments().size();
    now.point_pressure.assign(2 * n, 0.);
    now.point_aperture.assign(2 * n, 0.);
    now.point_saturation.assign(2 * n, 0.);
    now.flow.assign(n, 0.);
    now.velocity.assign(n, 0.);
  }

  void JointFlow::prepare(State<2> &state) const
  {
    if (state.find<JointFlowState>())
      return;
    JointFlowState &water = state.add<JointFlowState>();
    water                 = now;
    water.acts            = false;
  }

  void JointFlow::find_open_channels(const State<2> &state)
  {
    placed_opening = state.get<JointHistory>().placed_opening;
    is_wall.assign(places.elevation.size(), 0);
    for (unsigned int c = 0; c < places.faces.size(); ++c)
    {
      FlowChannel &channel = flow_network.channels()[c];
      channel.is_open      = !state.is_absent(places.faces[c].blocks[0])
                        && !state.is_absent(places.faces[c].blocks[1]);
      if (!channel.is_open)
        for (const unsigned int node : channel.nodes)
          is_wall[node] = 1;
    }
    for (const JointChannels::DryFace &face : places.dry_faces)
      if (state.is_absent(face.blocks[0]) || state.is_absent(face.blocks[1]))
        is_wall[face.node] = 1;
  }

  void JointFlow::set_apertures(const NodeRecord<2> *nodes)
  {
    std::vector<double> openings(2 * places.faces.size(), 0.);
    for (unsigned int i = 0; i < places.of_segment.size(); ++i)
    {
      const JointSegment &segment = joints.segments()[i];
      // A joint between two ranks is told by that of its lower side.
      if (places.of_segment[i] == JointChannels::no_channel
          || !node_map.faces().joints[segment.face].is_own[0])
        continue;
      const auto gaps = joint_gaps(segment, nodes);
      for (unsigned int k = 0; k < 2; ++k)
        openings[2 * places.of_segment[i] + k]
            = gaps[k][0]
              - (placed_opening.empty() ? 0. : placed_opening[2 * i + k]);
    }
    dealii::Utilities::MPI::sum(openings, node_map.communicator(), openings);
    std::fill(compliance.begin(), compliance.end(), 0.);
    for (unsigned int c = 0; c < places.faces.size(); ++c)
      for (unsigned int k = 0; k < 2; ++k)
      {
        const HydraulicAperture &law
            = *places.aperture_of_set[places.faces[c].set];
        FlowChannel &channel = flow_network.channels()[c];
        channel.aperture[k]  = law.at(openings[2 * c + k]);
        if (channel.is_open && law.moves(openings[2 * c + k]))
          compliance[channel.nodes[k]]
              += 0.5 * channel.thickness * channel.length
                 * places.compliance_of_set[places.faces[c].set];
      }
  }

  FlowConditions JointFlow::conditions(const TimePoint &time) const
  {
    FlowConditions result(places.elevation.size());
    // With a free surface water does not enter from the air.
    const bool is_free = given.fluid.has_free_surface;
    (is_free ? result.is_outlet : result.is_given) = is_wall;
    for (unsigned int b = 0; b < places.boundary_nodes.size(); ++b)
    {
      const WaterBoundary &boundary = given.boundaries[b];
      const double value            = boundary.value(time);
      if (!std::isfinite(value))
        throw RunError("'Value' of section 'Water boundaries/" + boundary.name
                       + "' is no finite number at the time "
                       + number_text(time.stage)
                       + " s of the stage. Correct its function of time.");
      for (const unsigned int node : places.boundary_nodes[b])
      {
        if (boundary.quantity == WaterQuantity::flow)
        {
          result.source[node] = value / double(places.boundary_nodes[b].size());
          continue;
        }
        const double pressure
            = boundary.quantity == WaterQuantity::head
                  ? given.fluid.unit_weight * (value - places.elevation[node])
                  : value;
        const bool is_outlet
            = boundary.quantity == WaterQuantity::outlet
              || (is_free && boundary.quantity == WaterQuantity::head
                  && pressure <= 0.);
        result.is_outlet[node] = is_outlet;
        result.is_given[node]  = !is_outlet;
        if (!is_outlet)
          result.pressure[node] = pressure;
      }
    }
    return result;
  }

  FlowSolution JointFlow::solve(const TimePoint &time, const double dt,
                                const JointFlowState &before) const
  {
    const FlowConditions at = conditions(time);
    if (given.flow == FlowKind::transient)
      return flow_network.transient(at, dt, before.content, compliance,
                                    now.pressure);
    return solve_steady(at, before);
  }

  FlowSolution JointFlow::solve_steady(const FlowConditions &at,
                                       const JointFlowState &before) const
  {
    const auto unconnected = flow_network.unconnected_nodes(at);
    for (unsigned int b = 0; b < places.boundary_nodes.size(); ++b)
      for (const unsigned int node : places.boundary_nodes[b])
        if (unconnected[node] && at.source[node] != 0.)
          throw RunError("section 'Water boundaries/" + given.boundaries[b].name
                         + "': water flows into joints from which there is no "
                           "way to a place of given pressure or head, so there "
                           "is no steady flow. Give a pressure elsewhere, or "
                           "take 'Flow = transient'.");
    if (!given.fluid.has_free_surface)
      return flow_network.steady(at);
    // Before there is any the joints are full.
    return flow_network.steady(at, before.acts ? before.content
                                               : flow_network.volumes());
  }

  void JointFlow::take(const FlowSolution &solution, const double time,
                       const double dt, const JointFlowState &since)
  {
    now.acts     = true;
    now.time     = time;
    now.pressure = solution.pressure;
    now.content  = solution.content;
    now.inflow   = since.inflow;
    now.outflow  = since.outflow;
    now.stored   = since.stored;
    // Steady solutions have the volumes of a second.
    const bool is_steady = given.flow == FlowKind::steady;
    const double seconds = is_steady ? dt : 1.;
    now.residual         = since.residual + seconds * solution.residual;
    for (unsigned int i = 0; i < solution.inflow.size(); ++i)
    {
      (solution.inflow[i] > 0. ? now.inflow : now.outflow)
          += seconds * std::abs(solution.inflow[i]);
      if (!is_steady)
        now.stored += solution.content[i] - since.content[i];
    }
    if (is_steady || dt > 0.)
      for (unsigned int i = 0; i < solution.inflow.size(); ++i)
        now.node_inflow[i] = solution.inflow[i] / (is_steady ? 1. : dt);
    for (unsigned int b = 0; b < places.boundary_nodes.size(); ++b)
    {
      now.boundary_flow[b] = 0.;
      for (const unsigned int node : places.boundary_nodes[b])
        now.boundary_flow[b] += now.node_inflow[node];
    }
    for (unsigned int i = 0; i < places.of_segment.size(); ++i)
    {
      const unsigned int c = places.of_segment[i];
      if (c == JointChannels::no_channel || !flow_network.channels()[c].is_open)
      {
        now.flow[i] = now.velocity[i] = 0.;
        for (unsigned int k = 0; k < 2; ++k)
          now.point_pressure[2 * i + k]         = now.point_aperture[2 * i + k]
              = now.point_saturation[2 * i + k] = 0.;
        continue;
      }
      const FlowChannel &channel = flow_network.channels()[c];
      for (unsigned int k = 0; k < 2; ++k)
      {
        now.point_pressure[2 * i + k]   = now.pressure[channel.nodes[k]];
        now.point_aperture[2 * i + k]   = channel.aperture[k];
        now.point_saturation[2 * i + k] = solution.saturation[channel.nodes[k]];
      }
      now.flow[i]     = flow_network.flow(channel, solution);
      now.velocity[i] = now.flow[i] / channel.thickness
                        / (0.5 * (channel.aperture[0] + channel.aperture[1]));
    }
    find_forces();
  }

  void JointFlow::flow_on(const double time, JointFlowState &water) const
  {
    if (given.flow != FlowKind::steady || !water.acts || time <= water.time)
      return;
    for (const double inflow : water.node_inflow)
    {
      const double volume = (time - water.time) * inflow;
      (volume > 0. ? water.inflow : water.outflow) += std::abs(volume);
      water.residual += volume;
    }
    water.time = time;
  }

  FlowVolumes JointFlow::volumes(const State<2> &state, const double time) const
  {
    JointFlowState water = state.get<JointFlowState>();
    flow_on(time, water);
    return { water.inflow, water.outflow, water.stored, water.residual };
  }

  void JointFlow::add_forces_in(
      const unsigned int c, const JointFlowState &water,
      std::map<unsigned int, dealii::Tensor<1, 2>> &sum) const
  {
    const NodeExchange &exchange = node_map.exchange();
    const FlowChannel &channel   = flow_network.channels()[c];
    const JointChannel &face     = places.faces[c];
    double p[2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      p[k] = water.pressure[channel.nodes[k]];
      if (!given.has_suction)
        p[k] = std::max(p[k], 0.);
    }
    const dealii::Tensor<1, 2> normal = normal_of(face);
    for (unsigned int k = 0; k < 2; ++k)
    {
      // Linear faces have the integral of a linear pressure, halves of
      // quadratic faces the weights of Simpson's rule.
      const double size = node_map.cells().is_quadratic
                              ? face.areas[k] * p[k]
                              : channel.thickness * channel.length / 6.
                                    * (2. * p[k] + p[1 - k]);
      for (const auto &[node, sign] :
           { std::pair(face.lower[k], -1.), std::pair(face.upper[k], 1.) })
        if (exchange.owns(node))
          sum[exchange.local(node)] += sign * size * normal;
    }
  }

  void JointFlow::add_forces_between(const std::vector<unsigned int> &blocks,
                                     const std::vector<GrowingWater> &growing,
                                     const State<2> &state,
                                     dealii::Tensor<1, 2> *force) const
  {
    const JointFlowState &water = state.get<JointFlowState>();
    std::map<unsigned int, dealii::Tensor<1, 2>> sum;
    for (unsigned int c = 0; water.acts && c < places.faces.size(); ++c)
    {
      const auto &[lower, upper] = places.faces[c].blocks;
      if (!state.is_absent(lower) && !state.is_absent(upper)
          && std::count(blocks.begin(), blocks.end(), lower)
                 != std::count(blocks.begin(), blocks.end(), upper))
      {
        std::map<unsigned int, dealii::Tensor<1, 2>> whole;
        add_forces_in(c, water, whole);
        const std::size_t part = part_of(c, growing);
        const double grown     = part < growing.size()
                                     ? growing[part].growth.share(state.load_time)
                                     : 1.;
        for (const auto &[node, size] : whole)
          sum[node] += grown * size;
      }
    }
    for (const auto &[node, part] : sum)
      force[node] += part;
  }

  bool GrowingWater::has(const unsigned int block) const
  {
    return std::binary_search(blocks.begin(), blocks.end(), block);
  }

  std::size_t JointFlow::part_of(const unsigned int c,
                                 const std::vector<GrowingWater> &parts) const
  {
    const auto &[lower, upper] = places.faces[c].blocks;
    for (std::size_t i = parts.size(); i-- > 0;)
      if (parts[i].has(lower) || parts[i].has(upper))
        return i;
    return parts.size();
  }

  void JointFlow::Forces::set(
      const std::map<unsigned int, dealii::Tensor<1, 2>> &sum)
  {
    nodes.clear();
    values.clear();
    for (const auto &[node, force] : sum)
    {
      nodes.push_back(node);
      values.push_back(force);
    }
  }

  void JointFlow::find_forces()
  {
    const auto find = [&](const auto &is_wanted, Forces &result)
    {
      std::map<unsigned int, dealii::Tensor<1, 2>> sum;
      for (unsigned int c = 0; now.acts && c < places.faces.size(); ++c)
        if (flow_network.channels()[c].is_open && is_wanted(c))
          add_forces_in(c, now, sum);
      result.set(sum);
    };
    find([](unsigned int) { return true; }, forces);
    for (GrowingForces &part : growing)
      find([&](const unsigned int c) { return part.has[c] != 0; }, part.forces);
  }

  void JointFlow::let_grow(const std::vector<GrowingWater> &parts)
  {
    growing.clear();
    for (const GrowingWater &part : parts)
      growing.push_back(
          { part, std::vector<std::uint8_t>(places.faces.size(), 0), {} });
    for (unsigned int c = 0; c < places.faces.size(); ++c)
      if (const std::size_t part = part_of(c, parts); part < parts.size())
        growing[part].has[c] = 1;
    find_forces();
  }

  void JointFlow::begin_stage(const std::string &name, State<2> &state)
  {
    JointFlowState &water = state.get<JointFlowState>();
    const double total    = state.next_load_start();
    flow_on(total, water);
    now      = water;
    now.time = total;
    find_open_channels(state);
    const bool begins = !now.acts;
    now.acts          = given.acts_in(name);
    if (!now.acts)
    {
      for (auto *values :
           { &now.pressure, &now.content, &now.point_pressure,
             &now.point_aperture, &now.point_saturation, &now.flow,
             &now.velocity, &now.boundary_flow, &now.node_inflow })
        std::fill(values->begin(), values->end(), 0.);
      find_forces();
      water = now;
      return;
    }
    set_apertures(state.nodes.data());
    const TimePoint start{ 0., total };
    FlowSolution solution;
    if (given.flow == FlowKind::steady
        || (begins && given.initial == InitialWater::steady))
      try
      {
        solution = solve_steady(conditions(start), water);
      }
      catch (const RunError &error)
      {
        throw InputError(error.what());
      }
    else
    {
      solution.pressure = now.pressure;
      solution.content  = flow_network.contents(now.pressure);
      solution.saturation.assign(places.elevation.size(), 1.);
      if (given.fluid.has_free_surface)
        start_free_surface(begins, solution);
    }
    if (given.flow == FlowKind::transient)
      solution.inflow.assign(places.elevation.size(), 0.);
    before         = now;
    before.content = solution.content;
    take(solution, total, 0., before);
    water = now;
  }

  void JointFlow::start_free_surface(const bool begins,
                                     FlowSolution &solution) const
  {
    const std::vector<double> volumes = flow_network.volumes();
    for (unsigned int i = 0; i < places.elevation.size(); ++i)
    {
      if (begins && given.initial == InitialWater::dry)
        solution.content[i] = 0.;
      else if (!begins)
        solution.content[i] = volumes[i] > 0. ? now.content[i] : 0.;
      solution.saturation[i]
          = volumes[i] > 0. ? std::min(1., solution.content[i] / volumes[i])
                            : 0.;
    }
  }

  void JointFlow::resume_stage(const State<2> &state)
  {
    now = state.get<JointFlowState>();
    find_open_channels(state);
    set_apertures(state.nodes.data());
    find_forces();
  }

  void JointFlow::update(const StepContext &step, State<2> &state)
  {
    JointFlowState &water = state.get<JointFlowState>();
    const double dt       = step.begin.total - water.time;
    // The first step of a stage begins with what begin_stage() has found.
    const bool is_due = given.flow == FlowKind::transient
                            ? dt > 0.
                            : state.stage_step % given.interval == 0;
    if (!is_due)
    {
      // The state may be another one than in the last step.
      if (now.time != water.time)
      {
        now = water;
        find_forces();
      }
      return;
    }
    flow_on(step.begin.total, water);
    now    = water;
    before = water;
    set_apertures(state.nodes.data());
    // Explicit steps follow the stiffness of the water themselves.
    std::fill(compliance.begin(), compliance.end(), 0.);
    take(solve(step.begin, dt, before), step.begin.total,
         given.flow == FlowKind::steady ? 0. : dt, before);
    water = now;
  }

  void JointFlow::add_loads(const TimePoint &time,
                            dealii::Tensor<1, 2> *force) const
  {
    const auto add = [&](const Forces &part, const double share)
    {
      for (unsigned int i = 0; share != 0. && i < part.nodes.size(); ++i)
        force[part.nodes[i]] += share * part.values[i];
    };
    add(forces, 1.);
    for (const GrowingForces &part : growing)
      add(part.forces, part.given.growth.share(time.stage) - 1.);
  }

  double JointFlow::external_power(const TimePoint &time,
                                   const dealii::Tensor<1, 2> *velocity) const
  {
    const auto power = [&](const Forces &part)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < part.nodes.size(); ++i)
        sum += part.values[i] * velocity[part.nodes[i]];
      return sum;
    };
    double result = power(forces);
    for (const GrowingForces &part : growing)
      result += (part.given.growth.share(time.stage) - 1.) * power(part.forces);
    return result;
  }

  std::vector<NodeStiffness<2>> JointFlow::stiffness_bound() const
  {
    std::vector<NodeStiffness<2>> result(node_map.n_owned(),
                                         NodeStiffness<2>{});
    if (given.flow != FlowKind::transient)
      return result;
    // Water in a joint of the smallest aperture that moves is a spring between
    // its faces, of which each side has twice the stiffness.
    for (const JointChannel &face : places.faces)
    {
      const HydraulicAperture &law = *places.aperture_of_set[face.set];
      if (law.residual == law.largest)
        continue;
      const auto n = normal_of(face);
      for (unsigned int k = 0; k < 2; ++k)
        for (const unsigned int node : { face.lower[k], face.upper[k] })
          if (node_map.exchange().owns(node))
          {
            const double stiffness
                = 2. * given.fluid.bulk_modulus / law.residual * face.areas[k];
            auto &[xx, yy, xy] = result[node_map.exchange().local(node)];
            xx += stiffness * n[0] * n[0];
            yy += stiffness * n[1] * n[1];
            xy += stiffness * n[0] * n[1];
          }
    }
    return result;
  }

  void JointFlow::begin_step(const State<2> &state)
  {
    before = now = state.get<JointFlowState>();
    acceleration.clear();
    n_iterations = 0;
    find_forces();
  }

  JointFlow::Followed JointFlow::follow(const NodeRecord<2> *nodes,
                                        const TimePoint &end)
  {
    // Forces that are released take no time, in which no water flows.
    if (given.flow == FlowKind::transient && end.total <= before.time)
      return Followed::balanced;
    set_apertures(nodes);
    const double dt       = std::max(0., end.total - before.time);
    FlowSolution solution = solve(end, dt, before);
    double change = 0., largest = 0.;
    // Water that falls freely has no pressure but that of rounding.
    for (const FlowChannel &channel : flow_network.channels())
      largest = std::max(largest, given.fluid.unit_weight * channel.length);
    for (unsigned int i = 0; i < solution.pressure.size(); ++i)
    {
      change
          = std::max(change, std::abs(solution.pressure[i] - now.pressure[i]));
      largest = std::max(largest, std::abs(solution.pressure[i]));
    }
    const bool is_there = change <= pressure_tolerance * largest;
    if (!is_there && ++n_iterations > most_iterations)
      return Followed::lost;
    if (!is_there)
    {
      const auto next = acceleration.next(now.pressure, solution.pressure);
      take(solution, end.total, dt, before);
      now.pressure = next;
      find_forces();
      return Followed::changed;
    }
    // Forces stay those of the equilibrium.
    const Forces kept = forces;
    take(solution, end.total, dt, before);
    forces = kept;
    return Followed::balanced;
  }
} // namespace quoin
