// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_solver.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    /** Factors of the step after a failure and, at most, after success. */
    constexpr double cut         = 0.3;
    constexpr double most_growth = 1.5;
    /** Load step by the last one below which the path is followed. */
    constexpr double path_share = 0.1;
    /** Pseudo-time steps of a jump: drag is a typical stiffness over these. */
    constexpr double first_drag_step = 0.1, least_drag_step = 1e-9;
    constexpr double drag_growth = 2., drag_cut = 0.2;
    constexpr unsigned int most_drag_steps = 500;
    /** Path increment in a step of a jump, by the largest path step or, where a
        search for the factor of safety asks whether the model goes on moving,
        by the path of the jump so far. */
    constexpr double most_flow = 1., safety_flow = 0.2;
    /** Load step after a jump, by the last one. */
    constexpr double jump_share = 0.3;
    /** Steps of a jump between trials without drag. */
    constexpr unsigned int trial_interval = 4;
    /** Number of steps of a short jump. */
    constexpr unsigned int short_way = 3;
    /** Displacement in a jump, by the model's size, that is a collapse. */
    constexpr double collapse_share = 0.05;
    /** Ratio of drag to applied force below which a jump may have ended. */
    constexpr double jump_ends = 1e-4;
    /** Ratio of unbalanced to drag force in a trial of the factor of safety. */
    constexpr double drag_share = 0.1;
    /** Way to the equilibrium behind a jump, by that of the jump, below which a
        search for the factor of safety takes it. */
    constexpr double near_share = 0.25;
    /** Steps ahead on the path before return to load control. */
    constexpr unsigned int steps_ahead = 5;
    /** Tolerated relative error of the path's length [-]. */
    constexpr double path_tolerance = 1e-3;
    /** Tolerated error of a controlled displacement, by its increment [-]. */
    constexpr double control_tolerance = 1e-6;
    /** Share of a correction at which the line search gives up. */
    constexpr double least_search_share = 0.1;
    /** Largest ratio of unbalanced to applied forces with transient flow: the
        water that flows in a step is a small difference of openings. */
    constexpr double flow_force_ratio = 1e-8;
    /** Equilibria in a step until uplift and crack belong together. */
    constexpr unsigned int most_cracks = 50;
    /** Least reduction of the unbalanced force by share of a correction. */
    constexpr double least_gain = 0.1;
  } // namespace

  bool ImplicitSolver::find_correction(const Target &target,
                                       const Configuration &configuration,
                                       const bool is_first, double &share)
  {
    residual = 0.;
    dof_map->add_forces(balance.force, residual);
    dof_map->add_forces(balance.drag, residual);
    add_body_forces(dof_map->bodies(), balance.drives, residual);
    add_body_forces(dof_map->bodies(), balance.held, residual);
    if (acting.pattern && dof_map->owned().is_element(dof_map->factor()))
      residual(dof_map->factor()) += balance.lacking;
    residual.compress(dealii::VectorOperation::add);
    bool is_solved = false;
    time_shares.measure(solver_phase,
                        [&]()
                        {
                          is_solved
                              = linear_solver->prepare(equilibrium->stiffness(),
                                                       configuration)
                                && linear_solver->solve(residual, correction);
                        });
    if (!is_solved)
      return false;

    const bool on_path = target.path > 0.;
    share              = is_first ? 1.
                         : configuration.load_time != target.load_time
                    || configuration.released != target.released
                             ? 1.
                             : 0.;
    if (on_path || share != 0.)
    {
      if (!linear_solver->solve(slopes.by_advance, advanced))
        return false;
    }
    if (on_path && !is_first)
    {
      const double slope
          = slopes.path_by_dof * advanced + slopes.path_by_advance;
      // Until a joint yields there is no path to measure: loads advance.
      if (slope != 0.)
        share = (target.path - balance.path - slopes.path_by_dof * correction)
                / slope;
    }
    if (share != 0.)
      correction.add(share, advanced);
    return true;
  }

  void ImplicitSolver::correct(const State<2> &state, const double share,
                               Configuration &configuration)
  {
    const Configuration from = configuration;
    double factor            = 0.; // its change
    if (acting.pattern && dof_map->owned().is_element(dof_map->factor()))
      factor = correction(dof_map->factor());
    if (acting.pattern)
      factor = dealii::Utilities::MPI::sum(factor, communicator);
    const auto go = [&](const double eta)
    {
      configuration        = from;
      configuration.factor = from.factor + eta * factor;
      configuration.released
          += eta * share * (advance.released - from.released);
      const double load_time
          = share * eta == 1.
                ? advance.load_time
                : from.load_time
                      + eta * share * (advance.load_time - from.load_time);
      dof_map->move(correction, eta, load_time, configuration);
    };
    last_share = 1.;
    if (!parameters.line_search || iteration == 0)
      return go(1.);

    // Along a correction the relative unbalanced force falls with the slope -1,
    // until a joint changes its state: halve, or go to the minimum of the
    // parabola.
    const double base = balance.unbalanced;
    double best = std::numeric_limits<double>::infinity(), best_share = 1.;
    for (double eta = 1.; eta >= least_search_share;)
    {
      go(eta);
      time_shares.measure(
          assembly_phase, [&]()
          { equilibrium->find_forces(state, configuration, broken, trial); });
      if (trial.unbalanced < best)
      {
        best       = trial.unbalanced;
        best_share = eta;
      }
      if (trial.unbalanced <= (1. - least_gain * eta) * base)
        break;
      const double parabola
          = 0.5 * base * eta * eta / (trial.unbalanced - base + base * eta);
      eta = std::clamp(parabola, 0.1 * eta, 0.5 * eta);
    }
    last_share = best_share;
    go(best_share);
  }

  ImplicitSolver::Outcome ImplicitSolver::iterate(const State<2> &state,
                                                  const Target &target,
                                                  Configuration &configuration)
  {
    std::vector<double> ratios;
    for (unsigned int i = 0;; ++i)
    {
      advance.load_time = target.load_time;
      advance.released  = target.released;
      advance.on_path   = target.path > 0.;
      if (target.path > 0.) // the load time is an unknown
        advance.load_time
            = configuration.load_time + target.load_time - state.load_time;
      time_shares.measure(assembly_phase,
                          [&]()
                          {
                            equilibrium->linearise(state, configuration, broken,
                                                   advance, balance, slopes);
                          });
      if (iteration == 0)
        start = balance;
      const double ratio = balance.ratio();
      done.iterations.push_back({ current_step, attempt, iteration,
                                  configuration.load_time, ratio, last_share,
                                  double(linear_solver->n_iterations()) });
      if (!std::isfinite(ratio))
        return Outcome::failed;
      ratios.push_back(ratio);
      const bool there = target.path > 0.
                             ? std::abs(balance.path - target.path)
                                   <= path_tolerance * target.path
                             : configuration.load_time == target.load_time
                                   && configuration.released == target.released;
      // Points of joints that close and open in turn with every iteration must
      // not hold up a trial that asks whether the model keeps moving.
      const double given
          = all.water && all.water->acts()
                    && all.water->parameters().flow == FlowKind::transient
                ? std::min(parameters.force_ratio, flow_force_ratio)
                : parameters.force_ratio;
      const double tolerance
          = stage.safety && state.get<ImplicitState>().jumps
                    && target.path == 0.
                ? std::max(given,
                           drag_share * balance.dragged / balance.applied)
                : given;
      const bool is_controlled
          = !acting.pattern
            || std::abs(balance.lacking)
                   <= control_tolerance
                          * std::max(std::abs(acting.pattern->target(
                                                  configuration.load_time)
                                              - acting.pattern->target(
                                                  state.load_time)),
                                     1e-9 * model.nodes().table().diagonal());
      if (iteration > 0 && there && is_controlled && ratio <= tolerance)
        return Outcome::converged;
      if (i >= parameters.maximum_iterations
          || (i >= 10 && ratio > 0.5 * ratios[i - 6]))
        return Outcome::failed;

      double share = 0.;
      if (!find_correction(target, configuration, iteration == 0, share))
        return Outcome::failed;
      correct(state, share, configuration);
      ++iteration;
      ++done.n_iterations;
    }
  }

  void ImplicitSolver::try_iteration(const State<2> &state)
  {
    const Configuration configuration
        = configuration_of(dof_map->bodies(), state);
    const Target target = choose_target(state);
    double share        = 0.;
    advance.load_time   = target.load_time;
    advance.released    = target.released;
    advance.on_path     = target.path > 0.;
    equilibrium->linearise(state, configuration, broken, advance, balance,
                           slopes);
    find_correction(target, configuration, true, share);
  }

  bool ImplicitSolver::break_joints()
  {
    double largest = 0.;
    for (unsigned int p = 0; p < model.joints().n_points(); ++p)
      if (!broken[p])
        largest = std::max(largest, model.joints().excess(
                                        p, balance.state.get<JointHistory>()));
    largest = dealii::Utilities::MPI::max(largest, communicator);
    if (largest <= 1e-9)
      return false;
    // The most overstressed point, and those that would follow at once.
    for (unsigned int p = 0; p < model.joints().n_points(); ++p)
      if (!broken[p]
          && model.joints().excess(p, balance.state.get<JointHistory>())
                 >= 0.7 * largest)
        broken[p] = 1;
    return true;
  }

  ImplicitSolver::Outcome ImplicitSolver::solve(const State<2> &state,
                                                const Target &target,
                                                Configuration &configuration)
  {
    configuration = configuration_of(dof_map->bodies(), state);
    broken.assign(model.joints().n_points(), 0);
    iteration  = 0;
    last_share = 1.;
    if (all.water && all.water->acts())
      all.water->begin_step(state);
    for (NodalLoad<2> &load : all.nodal)
      load.find_crack(state);
    unsigned int n_cracks = 0;
    // Brittle joints break one after the other, each at an equilibrium, and
    // water finds its pressures for the openings of one.
    JointFlow::Followed followed;
    unsigned int n_without_new_water = 0;
    do
    {
      do
        if (iterate(state, target, configuration) == Outcome::failed)
          return Outcome::failed;
      while (break_joints());
      if (n_without_new_water == 0)
        n_without_new_water = iteration;
      followed = JointFlow::Followed::balanced;
      if (all.water && all.water->acts())
        followed = all.water->follow(
            configuration.nodes.data(),
            { configuration.load_time, stage_start + configuration.load_time });
      for (NodalLoad<2> &load : all.nodal)
        if (names_load(stage, load.name()) && !load.follow_crack(balance.state)
            && followed == JointFlow::Followed::balanced)
          followed = ++n_cracks > most_cracks ? JointFlow::Followed::lost
                                              : JointFlow::Followed::changed;
    } while (followed == JointFlow::Followed::changed);
    // The next step is as long as joints and blocks let it be.
    iteration = n_without_new_water;
    return followed == JointFlow::Followed::lost ? Outcome::failed
                                                 : Outcome::converged;
  }

  ImplicitSolver::Target
  ImplicitSolver::choose_target(const State<2> &state) const
  {
    const ImplicitState &now = state.get<ImplicitState>();
    if (now.jumps)
      return { now.jump_time, 1., 0. };
    if (now.released < 1.)
    {
      const double next = now.released + now.step;
      return { state.load_time, next > 1. - 1e-9 ? 1. : next, 0. };
    }
    double next = state.load_time + now.step * stage_duration;
    if (now.follows_path)
      return { next, 1., now.path_step };
    if (next > stage_duration * (1. - 1e-9))
      next = stage_duration;
    return { next, 1., 0. };
  }

  void ImplicitSolver::step(State<2> &state)
  {
    current_step = state.step;
    if (!state.get<ImplicitState>().jumps)
      last_equilibrium = state;
    Configuration configuration;
    for (attempt = 0;; ++attempt)
    {
      const Target target = choose_target(state);
      equilibrium->set_drag(state.get<ImplicitState>().jumps
                                ? 1. / state.get<ImplicitState>().drag_step
                                : 0.);
      Outcome outcome = solve(state, target, configuration);
      if (outcome == Outcome::converged && target.path > 0.
          && configuration.load_time > stage_duration)
      {
        // The end of the stage is near: load control to reach it exactly.
        state.get<ImplicitState>().follows_path = false;
        state.get<ImplicitState>().step
            = (stage_duration - state.load_time) / stage_duration;
        continue;
      }
      // Also in a jump joints must not yield too far in one step. A load step
      // may find an equilibrium far away, where blocks have slid until their
      // tilt holds them: it is none of the path that the loads follow.
      const double most
          = state.get<ImplicitState>().jumps
                ? most_jump_path(state.get<ImplicitState>())
                : collapse_share * model.nodes().table().diagonal();
      if (outcome == Outcome::converged && std::abs(balance.path) <= most)
        break;
      ++done.n_cuts;
      if (!cut_step(state))
        give_up(state);
    }
    const State<2> before = state;
    commit(configuration, state);
    if (state.get<ImplicitState>().jumps)
      go_on_jumping(before, state);
    else
      adapt_step(before, state);
  }

  void ImplicitSolver::go_on_jumping(const State<2> &before, State<2> &state)
  {
    ImplicitState &now = state.get<ImplicitState>();
    now.jump_loss += state.energy.damping - before.energy.damping;
    ++now.n_drag;
    now.drag_time += now.drag_step;
    now.drag_path += std::abs(balance.path);
    // A search for the factor of safety judges by itself how far it goes.
    if (now.n_drag >= most_drag_steps
        || (!stage.safety
            && largest_move(last_equilibrium.nodes, state.nodes)
                   > collapse_share * model.nodes().table().diagonal()))
      give_up(state);
    if (iteration <= parameters.wanted_iterations
        && std::abs(balance.path) < most_jump_path(now) / drag_growth)
      now.drag_step *= drag_growth;
    // Trials without drag cost as much as steps: at first, then at intervals.
    if (balance.dragged > jump_ends * balance.applied
        || (now.n_drag > short_way && now.n_drag % trial_interval != 0))
      return;
    // Near an equilibrium: test whether it is one without drag.
    equilibrium->set_drag(0.);
    Configuration configuration;
    const Target target{ now.jump_time, 1., 0. };
    if (solve(state, target, configuration) == Outcome::failed)
      return;
    // Whether the model would have come to an equilibrium that lies far ahead
    // is what a search for the factor of safety asks: it has to go there.
    if (stage.safety
        && largest_move(state.nodes, configuration.nodes)
               > near_share * largest_move(last_equilibrium.nodes, state.nodes))
      return;
    commit(configuration, state);
    now.jumps     = false;
    now.path_step = 0.;
    // After a short jump the equilibrium is the next one on the same path.
    const double next
        = now.last_step * (now.n_drag <= short_way ? most_growth : jump_share);
    now.last_step = std::clamp(next, 0.01 * parameters.first_step,
                               parameters.largest_step);
    now.step      = now.last_step;
    done.jumps.push_back(
        { now.jump_time, now.n_drag,
          dealii::Utilities::MPI::sum(now.jump_loss, communicator) });
  }

  double ImplicitSolver::most_jump_path(const ImplicitState &now) const
  {
    const double most = most_flow * parameters.largest_path_step;
    return stage.safety ? std::max(most, safety_flow * now.drag_path) : most;
  }

  double
  ImplicitSolver::largest_move(const AlignedArray<NodeRecord<2>> &from,
                               const AlignedArray<NodeRecord<2>> &to) const
  {
    double moved = 0.;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        moved = std::max(moved, std::abs(to[i].u[d] - from[i].u[d]));
    return dealii::Utilities::MPI::max(moved, communicator);
  }

  void ImplicitSolver::give_up(State<2> &state)
  {
    const double tried = std::abs(state.get<ImplicitState>().step);
    const bool jumped  = state.get<ImplicitState>().jumps;
    state              = last_equilibrium;
    fail(state, tried, jumped);
  }

  void ImplicitSolver::move_against_drag(State<2> &state)
  {
    last_equilibrium = state;
    begin_jump(state);
  }

  bool ImplicitSolver::begin_jump(State<2> &state) const
  {
    ImplicitState &now = state.get<ImplicitState>();
    // A search for the factor of safety asks whether the model keeps moving.
    if (!stage.safety && (!parameters.jumps || now.released < 1.))
      return false;
    now.follows_path = false;
    now.jumps        = true;
    now.n_drag       = 0;
    now.drag_time    = 0.;
    now.drag_path    = 0.;
    now.jump_loss    = 0.;
    now.drag_step    = first_drag_step;
    now.jump_time    = std::min(
           stage_duration, state.load_time
                               + std::max({ now.step, jump_share * now.last_step,
                                            2. * parameters.smallest_step })
                                     * stage_duration);
    return true;
  }

  bool ImplicitSolver::cut_step(State<2> &state) const
  {
    ImplicitState &now = state.get<ImplicitState>();
    if (now.jumps)
    {
      now.drag_step *= drag_cut;
      return now.drag_step > least_drag_step;
    }
    if (now.follows_path)
    {
      now.path_step *= cut;
      now.step *= cut;
      return now.path_step
                 > path_share * path_share * parameters.largest_path_step
             || begin_jump(state);
    }
    const double last_step
        = std::max(now.last_step, 0.1 * parameters.first_step);
    now.step *= cut;
    if (parameters.path != PathFollowing::never && now.released == 1.
        && equilibrium->measures_path() && now.step < path_share * last_step)
    {
      now.follows_path = true;
      now.ahead        = 0;
      now.step         = 0.5 * last_step;
      now.path_step    = now.path_step > 0.
                             ? 0.5 * now.path_step
                             : path_share * parameters.largest_path_step;
      return true;
    }
    if (now.step < path_share * last_step && begin_jump(state))
      return true;
    return now.step >= parameters.smallest_step;
  }

  void ImplicitSolver::adapt_step(const State<2> &before, State<2> &state) const
  {
    ImplicitState &now = state.get<ImplicitState>();
    const double went
        = before.get<ImplicitState>().released < 1.
              ? now.released - before.get<ImplicitState>().released
              : (state.load_time - before.load_time) / stage_duration;
    const double growth
        = std::min(most_growth, std::sqrt(double(parameters.wanted_iterations)
                                          / std::max(1U, iteration)));
    if (before.get<ImplicitState>().released < 1.)
    {
      now.step = std::min(growth * std::max(went, now.step),
                          parameters.largest_step);
      if (now.released == 1.)
        now.step = first_load_step();
      return;
    }
    now.path_length += balance.path;
    now.farthest = std::max(now.farthest, state.load_time);
    if (now.follows_path)
    {
      const double longer
          = std::min(growth, parameters.largest_path_step / now.path_step);
      now.path_step *= longer;
      // Loads advance first, so that joints yield; the path then decides.
      now.step
          = std::clamp(longer * std::abs(went), 0.01 * parameters.first_step,
                       parameters.largest_step);
      now.ahead
          = went > 0. && state.load_time >= now.farthest ? now.ahead + 1 : 0;
      if (now.ahead > steps_ahead && parameters.path != PathFollowing::always)
        now.follows_path = false;
    }
    else
    {
      now.path_step = std::min(balance.path, parameters.largest_path_step);
      now.last_step = went;
      now.step      = std::min(growth * std::max(went, now.step),
                               parameters.largest_step);
      if (parameters.path == PathFollowing::always
          && balance.path > 1e-3 * parameters.largest_path_step)
        now.follows_path = true;
    }
  }
} // namespace quoin
