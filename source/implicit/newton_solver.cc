// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/newton_solver.h>
#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    /** Ratio of unbalanced to drag force in a trial of the factor of safety. */
    constexpr double drag_share = 0.1;
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

  template <int dim>
  NewtonSolver<dim>::NewtonSolver(const Model<dim> &model, RunLoads<dim> &loads,
                                  const StageLoads<dim> &acting,
                                  const StageParameters &stage,
                                  const ImplicitParameters &parameters,
                                  const ImplicitSteps &steps,
                                  DofMap<dim> &dof_map,
                                  Equilibrium<dim> &equilibrium,
                                  PhaseClock &clock, ImplicitRecord &record)
    : model(model), loads(loads), acting(acting), stage(stage),
      parameters(parameters), steps(steps), dof_map(dof_map),
      equilibrium(equilibrium), clock(clock), record(record),
      communicator(model.nodes().communicator()), prediction(model, dof_map),
      // Multigrid gives no factor.
      linear_solver(acting.pattern ? LinearSolverType::direct
                                   : parameters.linear_solver,
                    model, dof_map),
      broken(model.joints().n_points(), 0),
      assembly_phase(clock.phase("assembly")),
      solver_phase(clock.phase("linear solver"))
  {
    residual.reinit(dof_map.owned(), communicator);
    slopes.by_advance = slopes.path_by_dof = correction = advanced = residual;
  }

  template <int dim>
  void NewtonSolver<dim>::find_forces(const State<dim> &state)
  {
    equilibrium.find_forces(state, configuration_of(dof_map.bodies(), state),
                            broken, balance);
  }

  template <int dim>
  bool NewtonSolver<dim>::predict(const State<dim> &state,
                                  const StepTarget &target,
                                  Configuration<dim> &configuration)
  {
    const ImplicitState &now = state.template get<ImplicitState>();
    if (now.moved_for <= 0. || target.path > 0. || now.released < 1.)
      return false;
    clock.measure(
        assembly_phase, [&]()
        { equilibrium.find_forces(state, configuration, broken, start); });
    const double went
        = now.jumps ? now.drag_step : target.load_time - state.load_time;
    Configuration<dim> ahead = configuration;
    prediction.move(now, went / now.moved_for, target.load_time, correction,
                    ahead);
    if (now.jumps)
    {
      // The motion may be coming to rest, or not have begun.
      clock.measure(assembly_phase, [&]()
                    { equilibrium.find_forces(state, ahead, broken, trial); });
      if (trial.unbalanced >= start.unbalanced)
        return false;
    }
    configuration = ahead;
    return true;
  }

  template <int dim>
  void
  NewtonSolver<dim>::remember_motion(const Configuration<dim> &configuration,
                                     State<dim> &state) const
  {
    ImplicitState &now = state.template get<ImplicitState>();
    now.moved_for      = 0.;
    // What broke does not break again.
    if (now.released < 1. || some_broke)
      return;
    const Configuration<dim> from = configuration_of(dof_map.bodies(), state);
    prediction.remember(from, configuration, start, balance,
                        now.jumps ? now.drag_step
                                  : configuration.load_time - from.load_time,
                        now);
  }

  template <int dim>
  double NewtonSolver<dim>::error_of_prediction(const State<dim> &state,
                                                const StepTarget &target) const
  {
    const ImplicitState &now = state.template get<ImplicitState>();
    if (!is_predicted || now.jumps || acting.pattern)
      return 0.;
    const double share = (target.load_time - state.load_time) / now.moved_for;
    return std::max(balance.ratio(),
                    prediction.error_of_reactions(now, share, start, balance));
  }

  template <int dim>
  bool
  NewtonSolver<dim>::find_correction(const StepTarget &target,
                                     const Configuration<dim> &configuration,
                                     const bool is_first, double &share)
  {
    residual = 0.;
    dof_map.add_forces(balance.force, residual);
    dof_map.add_forces(balance.drag, residual);
    add_body_forces(dof_map.bodies(), balance.drives, residual);
    add_body_forces(dof_map.bodies(), balance.held, residual);
    if (acting.pattern && dof_map.owned().is_element(dof_map.factor()))
      residual(dof_map.factor()) += balance.lacking;
    residual.compress(dealii::VectorOperation::add);
    bool is_solved = false;
    clock.measure(solver_phase,
                  [&]()
                  {
                    is_solved = linear_solver.prepare(equilibrium.stiffness(),
                                                      configuration)
                                && linear_solver.solve(residual, correction);
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
      clock.measure(
          solver_phase, [&]()
          { is_solved = linear_solver.solve(slopes.by_advance, advanced); });
      if (!is_solved)
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

  template <int dim>
  void NewtonSolver<dim>::correct(const State<dim> &state, const double share,
                                  Configuration<dim> &configuration)
  {
    const Configuration<dim> from = configuration;
    double factor                 = 0.; // its change
    if (acting.pattern && dof_map.owned().is_element(dof_map.factor()))
      factor = correction(dof_map.factor());
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
      dof_map.move(correction, eta, load_time, configuration);
    };
    last_share = 1.;
    if (!parameters.line_search || (iteration == 0 && !is_predicted))
      return go(1.);

    // Along a correction the relative unbalanced force falls with the slope -1,
    // until a joint changes its state: halve, or go to the minimum of the
    // parabola.
    const double base = balance.unbalanced;
    double best = std::numeric_limits<double>::infinity(), best_share = 1.;
    for (double eta = 1.; eta >= least_search_share;)
    {
      go(eta);
      clock.measure(
          assembly_phase, [&]()
          { equilibrium.find_forces(state, configuration, broken, trial); });
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

  template <int dim>
  double NewtonSolver<dim>::tolerance(const State<dim> &state,
                                      const StepTarget &target) const
  {
    const double given
        = loads.water && loads.water->acts()
                  && loads.water->parameters().flow == FlowKind::transient
              ? std::min(parameters.force_ratio, flow_force_ratio)
              : parameters.force_ratio;
    // Points of joints that close and open in turn with every iteration must
    // not hold up a trial that asks whether the model keeps moving.
    const bool is_trial = stage.safety
                          && state.template get<ImplicitState>().jumps
                          && target.path == 0.;
    return is_trial
               ? std::max(given, drag_share * balance.dragged / balance.applied)
               : given;
  }

  template <int dim>
  bool NewtonSolver<dim>::is_controlled(const State<dim> &state,
                                        const double load_time) const
  {
    if (!acting.pattern)
      return true;
    const double increment = acting.pattern->target(load_time)
                             - acting.pattern->target(state.load_time);
    return std::abs(balance.lacking)
           <= control_tolerance
                  * std::max(std::abs(increment),
                             1e-9 * model.nodes().table().diagonal());
  }

  template <int dim>
  bool NewtonSolver<dim>::iterate(const State<dim> &state,
                                  const StepTarget &target,
                                  Configuration<dim> &configuration)
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
      clock.measure(assembly_phase,
                    [&]()
                    {
                      equilibrium.linearise(state, configuration, broken,
                                            advance, balance, slopes);
                    });
      if (iteration == 0 && !is_predicted)
        start = balance;
      const double ratio = balance.ratio();
      record.iterations.push_back({ attempt.step, attempt.number, iteration,
                                    configuration.load_time, ratio, last_share,
                                    double(linear_solver.n_iterations()) });
      if (!std::isfinite(ratio))
      {
        acting.check_finite(stage, state, advance.load_time);
        return false;
      }
      ratios.push_back(ratio);
      if (iteration == 0)
      {
        error = error_of_prediction(state, target);
        if (steps.is_too_long(state.load_time, target, error))
          return false;
      }
      const bool there = target.path > 0.
                             ? std::abs(balance.path - target.path)
                                   <= path_tolerance * target.path
                             : configuration.load_time == target.load_time
                                   && configuration.released == target.released;
      if (iteration > 0 && there
          && is_controlled(state, configuration.load_time)
          && ratio <= tolerance(state, target))
        return true;
      if (i >= parameters.maximum_iterations
          || (i >= 10 && ratio > 0.5 * ratios[i - 6]))
        return false;

      double share = 0.;
      if (!find_correction(target, configuration,
                           iteration == 0 && !is_predicted, share))
        return false;
      correct(state, share, configuration);
      ++iteration;
      ++record.n_iterations;
    }
  }

  template <int dim>
  void NewtonSolver<dim>::try_iteration(const State<dim> &state)
  {
    const Configuration<dim> configuration
        = configuration_of(dof_map.bodies(), state);
    const StepTarget target
        = steps.target(state.template get<ImplicitState>(), state.load_time);
    double share      = 0.;
    advance.load_time = target.load_time;
    advance.released  = target.released;
    advance.on_path   = target.path > 0.;
    equilibrium.linearise(state, configuration, broken, advance, balance,
                          slopes);
    find_correction(target, configuration, true, share);
  }

  template <int dim>
  bool NewtonSolver<dim>::break_joints()
  {
    const auto &history = balance.state.template get<JointHistoryOf<dim>>();
    // A point loses more each time, or nothing: the residual strength may be
    // above the peak.
    const auto loss = [&](const unsigned int p)
    {
      return std::uint8_t(history.state[p] == JointState::intact
                              ? JointLoss::peak
                              : JointLoss::cohesion);
    };
    double largest = 0.;
    for (unsigned int p = 0; p < model.joints().n_points(); ++p)
      if (loss(p) > broken[p])
        largest = std::max(largest, excess(model.joints(), p, history));
    largest = dealii::Utilities::MPI::max(largest, communicator);
    if (largest <= 1e-9)
      return false;
    // The most overstressed point, and those that would follow at once.
    for (unsigned int p = 0; p < model.joints().n_points(); ++p)
      if (loss(p) > broken[p]
          && excess(model.joints(), p, history) >= 0.7 * largest)
        broken[p] = loss(p);
    some_broke = true;
    return true;
  }

  template <int dim>
  bool NewtonSolver<dim>::solve(const State<dim> &state,
                                const StepTarget &target,
                                const Attempt &new_attempt,
                                Configuration<dim> &configuration)
  {
    attempt       = new_attempt;
    configuration = configuration_of(dof_map.bodies(), state);
    broken.assign(model.joints().n_points(), 0);
    some_broke = false;
    iteration  = 0;
    last_share = 1.;
    if constexpr (dim == 2)
      if (loads.water && loads.water->acts())
        loads.water->begin_step(state);
    for (NodalLoad<dim> &load : loads.nodal)
      load.follow(state, target.released);
    is_predicted          = predict(state, target, configuration);
    unsigned int n_cracks = 0;
    // Brittle joints break one after the other, each at an equilibrium, and
    // water finds its pressures for the openings of one.
    JointFlow::Followed followed;
    unsigned int n_without_new_water = 0;
    do
    {
      do
        if (!iterate(state, target, configuration))
          return false;
      while (break_joints());
      if (n_without_new_water == 0)
        n_without_new_water = iteration;
      followed = JointFlow::Followed::balanced;
      if constexpr (dim == 2)
        if (loads.water && loads.water->acts())
          followed = loads.water->follow(
              configuration.nodes.data(),
              { configuration.load_time,
                state.load_start() + configuration.load_time });
      for (NodalLoad<dim> &load : loads.nodal)
        if (names_load(stage, load.name()) && !load.follow_crack(balance.state)
            && followed == JointFlow::Followed::balanced)
          followed = ++n_cracks > most_cracks ? JointFlow::Followed::lost
                                              : JointFlow::Followed::changed;
    } while (followed == JointFlow::Followed::changed);
    // The next step is as long as joints and blocks let it be.
    iteration = n_without_new_water;
    return followed != JointFlow::Followed::lost;
  }

  template class NewtonSolver<2>;
  template class NewtonSolver<3>;
} // namespace quoin
