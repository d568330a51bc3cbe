// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/operators/archive.h>
#include <quoin/reinforcement/reinforcement.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    constexpr unsigned int dim = 2;
    using Vector               = dealii::Tensor<1, dim>;

    /** @p a turned by a right angle, anticlockwise. */
    Vector turned(const Vector &a)
    {
      return dealii::Point<2>(-a[1], a[0]);
    }

    Vector relative(const BarHost &near, const BarHost &far,
                    const NodeRecord<2> *nodes)
    {
      return displacement_of(far, nodes) - displacement_of(near, nodes);
    }

    /** Takes a bar out of blocks that are absent: all of it where its far end
        is. Returns whether it loses anything that it still had. */
    bool lose_absent(const PlacedBar &bar, const State<2> &state, BarState &now)
    {
      const std::size_t last = bar.hosts.size() - 1;
      const bool is_gone     = state.is_absent(bar.hosts[last].block);
      const auto lost        = now.lost;
      const auto dowels      = now.dowel_broken;
      for (std::size_t i = 0; i <= last; ++i)
        if (is_gone || state.is_absent(bar.hosts[i].block))
        {
          now.lost[i] = 1;
          if (i > 0)
            now.broken[i - 1] = 1;
          if (i < last)
            now.broken[i] = 1;
        }
      for (std::size_t d = 0; d < bar.dowels.size(); ++d)
        if (is_gone || state.is_absent(bar.dowels[d].near.block)
            || state.is_absent(bar.dowels[d].far.block))
          now.dowel_broken[d] = 1;
      return now.lost != lost || now.dowel_broken != dowels;
    }

    /** Refuses the pretension of @p bar of the set @p cable in @p stage. */
    [[noreturn]] void refuse_pretension(const std::string &cable,
                                        const std::string &stage,
                                        const PlacedBar &bar,
                                        const State<2> &state)
    {
      const std::string where = "section 'Reinforcement/" + cable + "': ";
      const auto lost         = std::find_if(bar.hosts.begin(), bar.hosts.end(),
                                             [&](const BarHost &host)
                                             { return state.is_absent(host.block); });
      if (lost == bar.hosts.end())
        throw InputError(where
                         + "'Pretension' is more than the bond of a bar can "
                           "bear. Lower it, or lengthen the bond.");
      throw InputError(
          where + "'Pretension' has nothing to hold it in the stage '" + stage
          + "', because the block at " + point_text(lost->X)
          + " m, in which a bar lies, is excavated or not there "
            "yet. Let the bar lie in blocks that are there, or "
            "name a stage in which they are as its 'Stage'.");
    }
  } // namespace

  void Reinforcement::prepare(const NodeMap<2> &nodes,
                              const std::vector<CableParameters> &parameters,
                              const Thickness &thickness,
                              const BlockForces<2> &blocks)
  {
    node_map = &nodes;
    cells    = &blocks;
    cables   = parameters;
    is_first
        = dealii::Utilities::MPI::this_mpi_process(nodes.communicator()) == 0;
    std::vector<std::vector<CrossedCell>> crossed(all_bars(cables).size());
    for (const CrossedCell &cell : nodes.crossed_cells())
      if (cell.segment < crossed.size())
        crossed[cell.segment].push_back(cell);
    unsigned int segment = 0;
    for (unsigned int c = 0; c < cables.size(); ++c)
    {
      has_friction = has_friction || cables[c].law.bond_friction > 0.;
      for (const BarEnds &ends : cables[c].bars)
      {
        bars.push_back(
            place_bar(cables[c], ends, crossed[segment++], nodes, thickness));
        bars.back().cable = c;
      }
    }
  }

  void Reinforcement::prepare(State<2> &state) const
  {
    auto &slice = state.add<ReinforcementState>();
    if (slice.bars.size() == bars.size())
      return;
    slice.bars.resize(bars.size());
    for (unsigned int b = 0; b < bars.size(); ++b)
      slice.bars[b].resize(bars[b].chain, bars[b].dowels.size());
  }

  double Reinforcement::end_stage(State<2> &state) const
  {
    if (bars.empty() || !state.find<ReinforcementState>())
      return 0.;
    auto &states = state.get<ReinforcementState>().bars;
    for (unsigned int b = 0; b < bars.size(); ++b)
      book(update_bar(bars[b], state.nodes.data(), states[b], false, false),
           state);
    return power(state);
  }

  void Reinforcement::begin_stage(const std::string &name, const bool first,
                                  const double power_before, State<2> &state,
                                  dealii::Tensor<1, 2> *released,
                                  const NodeRecord<2> *nodes_before) const
  {
    if (bars.empty())
      return;
    prepare(state);
    auto &states = state.get<ReinforcementState>().bars;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const PlacedBar &bar   = bars[b];
      BarState &now          = states[b];
      const auto &given      = cables[bar.cable];
      const std::size_t last = bar.hosts.size() - 1;
      const bool is_new
          = !now.installed
            && (given.stage.empty() ? first : given.stage == name);
      const BarState before = now;
      if ((is_new || now.installed) && lose_absent(bar, state, now) && released
          && now.installed)
      {
        const NodeRecord<2> *const nodes = state.nodes.data();
        add_forces_on_present(bar, before, nodes_before ? nodes_before : nodes,
                              state, 1., released);
        add_forces_on_present(bar, now, nodes, state, -1., released);
      }
      if (!is_new)
        continue;
      now.installed = 1;
      for (unsigned int e = 0; e < last; ++e)
        set_vector(
            now.start, e,
            relative(bar.hosts[e], bar.hosts[e + 1], state.nodes.data()));
      for (unsigned int d = 0; d < bar.dowels.size(); ++d)
        set_vector(now.dowel_start, d,
                   relative(bar.dowels[d].near, bar.dowels[d].far,
                            state.nodes.data()));
    }
    if (has_friction)
      update_pressure(state);
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const PlacedBar &bar = bars[b];
      const auto &given    = cables[bar.cable];
      if (!states[b].installed || given.pretension == 0.
          || !(given.stage.empty() ? first : given.stage == name)
          || states[b].plate_offset != 0.)
        continue;
      if (!pretension(bar.law, bar.chain, given.pretension * bar.number,
                      states[b]))
        refuse_pretension(given.name, name, bar, state);
      if (is_first)
        state.energy.external
            += quoin::stored_energy(bar.law, bar.chain, states[b]);
    }
    // The forces of now belong to the half step before, too.
    state.energy.external
        += 0.5 * state.previous_time_step * (power(state) - power_before);
  }

  void Reinforcement::add_forces_on_present(const PlacedBar &bar, BarState now,
                                            const NodeRecord<2> *nodes,
                                            const State<2> &state,
                                            const double factor,
                                            dealii::Tensor<1, 2> *force) const
  {
    update_bar(bar, nodes, now, false, false);
    for (unsigned int i = 0; i < bar.nodes.size(); ++i)
      if (const unsigned int node = bar.nodes[i];
          node < node_map->n_owned()
          && !state.is_absent(node_map->block_of_node(node)))
        force[node] += factor * vector_at(work.force, i);
  }

  double Reinforcement::power(const State<2> &state) const
  {
    if (state.previous_time_step == 0.)
      return 0.;
    auto states   = state.get<ReinforcementState>().bars;
    double result = 0.;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      update_bar(bars[b], state.nodes.data(), states[b], false, false);
      for (unsigned int i = 0; i < bars[b].nodes.size(); ++i)
        if (const unsigned int node = bars[b].nodes[i];
            node < node_map->n_owned())
          result += vector_at(work.force, i) * state.velocity[node];
    }
    return result;
  }

  void Reinforcement::update_pressure(State<2> &state) const
  {
    auto &states = state.get<ReinforcementState>().bars;
    std::vector<double> pressure;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const Vector n = turned(bars[b].direction);
      for (const BarHost &host : bars[b].hosts)
      {
        pressure.push_back(0.);
        if (host.cell == NodeMap<2>::none || bars[b].law.bond_friction == 0.
            || !states[b].installed)
          continue;
        const auto s = cell_stress(*cells, state.nodes.data(),
                                   state.get<PlasticHistory>(), host.cell);
        const double across
            = s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + 2. * s[2] * n[0] * n[1];
        pressure.back() = std::max(0., -0.5 * (across + s[3]));
      }
    }
    dealii::Utilities::MPI::sum(pressure, node_map->communicator(), pressure);
    auto next = pressure.begin();
    for (BarState &bar : states)
      for (double &p : bar.pressure)
        p = *next++;
  }

  void Reinforcement::add_pair_force(const BarHost &near, const BarHost &far,
                                     const Vector &force) const
  {
    for (unsigned int k = 0; k < 3; ++k)
    {
      add_to_vector(work.force, near.places[k], near.weights[k] * force);
      add_to_vector(work.force, far.places[k], -far.weights[k] * force);
    }
  }

  void Reinforcement::add_spring(const PlacedBar &bar, const BarHost &near,
                                 const BarHost &far, const Vector &axis,
                                 const double k) const
  {
    const std::size_t n = 2 * bar.nodes.size();
    std::array<std::pair<unsigned int, double>, 6> terms;
    for (unsigned int i = 0; i < 3; ++i)
    {
      terms[i]     = { 2 * near.places[i], -near.weights[i] };
      terms[3 + i] = { 2 * far.places[i], far.weights[i] };
    }
    for (const auto &[row, v] : terms)
      for (const auto &[column, w] : terms)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int c = 0; c < dim; ++c)
            work.stiffness[(row + d) * n + column + c]
                += k * v * w * axis[d] * axis[c];
  }

  BarDissipation Reinforcement::update_bar(const PlacedBar &bar,
                                           const NodeRecord<2> *nodes,
                                           BarState &state,
                                           const bool is_static,
                                           const bool with_stiffness) const
  {
    const std::size_t n = 2 * bar.nodes.size(), m = bar.chain.n_elements();
    work.force.assign(n, 0.);
    work.stiffness.assign(with_stiffness ? n * n : 0, 0.);
    if (!state.installed)
      return {};
    work.stretch.resize(m);
    work.axis.resize(m);
    work.span.resize(m);
    for (unsigned int e = 0; e < m; ++e)
    {
      const BarHost &near = bar.hosts[e], &far = bar.hosts[e + 1];
      const Vector start    = vector_at(state.start, e);
      const Vector at_start = far.X - near.X + start;
      const Vector moved    = relative(near, far, nodes) - start;
      const Vector now      = at_start + moved;
      work.span[e]          = now.norm();
      // Of squares, so that a small elongation keeps its digits.
      work.stretch[e] = (2. * (at_start * moved) + moved * moved)
                        / (work.span[e] + at_start.norm());
      work.axis[e] = now / work.span[e];
    }
    BarDissipation lost
        = quoin::update(bar.law, bar.chain, work.stretch, state,
                        with_stiffness ? &work.tangent : nullptr, is_static);
    for (unsigned int e = 0; e < m; ++e)
      add_pair_force(bar.hosts[e], bar.hosts[e + 1],
                     state.force[e] * work.axis[e]);
    if (with_stiffness)
    {
      using Matrix    = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic,
                                   Eigen::RowMajor>;
      Matrix gradient = Matrix::Zero(m, n);
      for (unsigned int e = 0; e < m; ++e)
      {
        const BarHost &near = bar.hosts[e], &far = bar.hosts[e + 1];
        auto row = gradient.row(e);
        for (unsigned int k = 0; k < 3; ++k)
        {
          add_to_vector(row, near.places[k], -near.weights[k] * work.axis[e]);
          add_to_vector(row, far.places[k], far.weights[k] * work.axis[e]);
        }
      }
      Eigen::Map<Matrix>(work.stiffness.data(), n, n).noalias()
          += gradient.transpose()
             * (Eigen::Map<const Matrix>(work.tangent.data(), m, m) * gradient);
      for (unsigned int e = 0; e < m; ++e)
        add_spring(bar, bar.hosts[e], bar.hosts[e + 1], turned(work.axis[e]),
                   state.force[e] / work.span[e]);
    }
    add_dowels(bar, nodes, state, with_stiffness, lost);
    return lost;
  }

  void Reinforcement::add_dowels(const PlacedBar &bar,
                                 const NodeRecord<2> *nodes, BarState &state,
                                 const bool with_stiffness,
                                 BarDissipation &lost) const
  {
    const BarLaw &law = bar.law;
    const Vector &t = bar.direction, across = turned(t);
    for (unsigned int i = 0; i < bar.dowels.size(); ++i)
    {
      const BarHost &near = bar.dowels[i].near, &far = bar.dowels[i].far;
      const Vector u
          = relative(near, far, nodes) - vector_at(state.dowel_start, i);
      double *force   = &state.dowel_force[2 * i],
             *plastic = &state.dowel_plastic[2 * i],
             *motion  = &state.dowel_motion[2 * i];
      motion[0]       = u * t;
      motion[1]       = u * across;
      if (state.dowel_broken[i] || state.broken[bar.dowels[i].element])
      {
        state.dowel_broken[i] = 1;
        for (unsigned int c = 0; c < 2; ++c)
          if (force[c] != 0.)
            lost.fracture
                += 0.5 * force[c] * force[c]
                   / (c == 0 ? law.dowel_axial_stiffness : law.dowel_stiffness);
        force[0] = force[1] = 0.;
        continue;
      }
      const auto pull
          = [&](const unsigned int c, const double k, const double strength,
                const double elongation, const Vector &axis)
      {
        const SpringForce now
            = spring_force(k, elongation, plastic[c], -strength, strength);
        lost.plastic
            += 0.5 * (force[c] + now.force) * (now.plastic - plastic[c]);
        force[c]   = now.force;
        plastic[c] = now.plastic;
        add_pair_force(near, far, now.force * axis);
        if (with_stiffness)
          add_spring(bar, near, far, axis, now.tangent);
      };
      if (law.dowel_stiffness > 0.)
        pull(1, law.dowel_stiffness, law.dowel_strength, motion[1], across);
      if (law.dowel_axial_stiffness > 0.)
      {
        const double length = law.active_length,
                     span   = std::hypot(length + motion[0], motion[1]);
        const Vector axis
            = ((length + motion[0]) * t + motion[1] * across) / span;
        pull(0, law.dowel_axial_stiffness, law.dowel_axial_strength,
             (2. * length * motion[0] + motion[0] * motion[0]
              + motion[1] * motion[1])
                 / (span + length),
             axis);
        if (with_stiffness)
          add_spring(bar, near, far, turned(axis), force[0] / span);
      }
    }
  }

  void Reinforcement::book(const BarDissipation &lost, State<2> &state) const
  {
    if (!is_first)
      return;
    state.energy.plastic += lost.plastic;
    state.energy.friction += lost.friction;
    state.energy.fracture += lost.fracture;
  }

  void Reinforcement::add_forces(const StepContext &, State<2> &state,
                                 const NodeForces<2> &forces)
  {
    auto &states = state.get<ReinforcementState>().bars;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const auto &nodes = bars[b].nodes;
      // Blocks may have been deleted outside of the box.
      if (!state.block_marks.empty() && states[b].installed)
        lose_absent(bars[b], state, states[b]);
      book(update_bar(bars[b], state.nodes.data(), states[b], false, false),
           state);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (nodes[i] < node_map->n_owned())
          forces.force[nodes[i]] += vector_at(work.force, i);
    }
    if (has_friction)
      update_pressure(state);
  }

  void Reinforcement::linearise(State<2> &state, const bool with_stiffness,
                                const TakeElement<2> &take) const
  {
    auto &states = state.get<ReinforcementState>().bars;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const auto &nodes = bars[b].nodes;
      book(update_bar(bars[b], state.nodes.data(), states[b], true,
                      with_stiffness),
           state);
      // Each rank adds the forces on its own nodes.
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (nodes[i] >= node_map->n_owned())
          work.force[2 * i] = work.force[2 * i + 1] = 0.;
      ElementLinearisation<2> element{};
      element.nodes      = nodes.data();
      element.n_nodes    = nodes.size();
      element.force      = work.force.data();
      element.stiffness  = with_stiffness ? work.stiffness.data() : nullptr;
      element.row_length = 2 * nodes.size();
      element.share      = is_first ? 1. : 0.;
      take(element);
    }
    if (has_friction)
      update_pressure(state);
  }

  void Reinforcement::add_stiffness_bound(
      const State<2> &, const NodeRatio &,
      std::vector<NodeStiffness<2>> &stiffness) const
  {
    const auto add
        = [&](const BarHost &host, const double k, const Vector &axis)
    {
      for (unsigned int i = 0; i < 3; ++i)
        if (host.nodes[i] < node_map->n_owned())
        {
          auto &sum      = stiffness[host.nodes[i]];
          const double s = k * host.weights[i];
          sum[0] += s * axis[0] * axis[0];
          sum[1] += s * axis[1] * axis[1];
          sum[2] += s * axis[0] * axis[1];
        }
    };
    for (const PlacedBar &bar : bars)
    {
      const BarLaw &law = bar.law;
      const Vector &t = bar.direction, across = turned(t);
      // Along the bar it is softer than bond, plate and anchor alone, and
      // than its elements; a tension in it turns elements back.
      for (unsigned int i = 0; i < bar.hosts.size(); ++i)
      {
        double springs = law.bond_stiffness * bar.chain.bond[i];
        if (i == 0)
          springs += law.plate_stiffness;
        if (i + 1 == bar.hosts.size())
          springs += law.anchor_stiffness;
        double elements = 0., turning = 0.;
        for (const unsigned int e : { i - 1, i })
          if (e < bar.chain.n_elements())
          {
            elements += 2. * law.stiffness / bar.chain.length[e];
            turning += 2. * std::min(law.yield, 0.01 * law.stiffness)
                       / bar.chain.length[e];
          }
        add(bar.hosts[i], std::min(springs, elements), t);
        add(bar.hosts[i], turning, t);
        add(bar.hosts[i], turning, across);
      }
      for (const BarDowel &dowel : bar.dowels)
        for (const BarHost *host : { &dowel.near, &dowel.far })
        {
          add(*host, 2. * law.dowel_stiffness, across);
          add(*host, 2. * law.dowel_axial_stiffness, t);
          add(*host, 2. * law.dowel_axial_stiffness, across);
        }
    }
  }

  void Reinforcement::add_stored_energy(const State<2> &state,
                                        EnergyAccounts &energies) const
  {
    if (!is_first)
      return;
    const auto &states = state.get<ReinforcementState>().bars;
    for (unsigned int b = 0; b < bars.size(); ++b)
      energies.reinforcement
          += quoin::stored_energy(bars[b].law, bars[b].chain, states[b]);
  }

} // namespace quoin
