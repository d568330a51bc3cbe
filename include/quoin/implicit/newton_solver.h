// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_newton_solver_h
#define quoin_implicit_newton_solver_h

#include <quoin/base/phase_clock.h>
#include <quoin/implicit/dof_map.h>
#include <quoin/implicit/equilibrium.h>
#include <quoin/implicit/implicit_parameters.h>
#include <quoin/implicit/implicit_record.h>
#include <quoin/implicit/implicit_steps.h>
#include <quoin/implicit/linear_solver.h>
#include <quoin/implicit/motion_prediction.h>
#include <quoin/loading/run_loads.h>
#include <quoin/loading/stage_loads.h>
#include <quoin/model/model.h>
#include <quoin/stages/stage_parameters.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /**
   * Finds the equilibria of a stage at the targets of its steps, by Newton's
   * method with consistent tangents and line search (@cite Crisfield1991).
   * Brittle joints break one after the other, each at an equilibrium; water in
   * joints and uplift below cracks follow the openings of one.
   */
  template <int dim>
  class NewtonSolver
  {
  public:
    /** Which attempt at which step it is, for the record. */
    struct Attempt
    {
      std::uint64_t step  = 0;
      unsigned int number = 0; /**< increased by one with each cut */
    };

    /** For the @p stage in which the loads @p acting act, of all @p loads;
        keeps references. Iterations are added to @p record. */
    NewtonSolver(const Model<dim> &model, RunLoads<dim> &loads,
                 const StageLoads<dim> &acting, const StageParameters &stage,
                 const ImplicitParameters &parameters,
                 const ImplicitSteps &steps, DofMap<dim> &dof_map,
                 Equilibrium<dim> &equilibrium, PhaseClock &clock,
                 ImplicitRecord &record);

    /** Finds the equilibrium @p configuration at @p target, from that of
        @p state on, with its current_balance(); false: it has not converged.
        Collective. */
    bool solve(const State<dim> &state, const StepTarget &target,
               const Attempt &attempt, Configuration<dim> &configuration);
    /** Finds the current_balance() of @p state as it is. Collective. */
    void find_forces(const State<dim> &state);
    /** Keeps in @p state the motion from it to @p configuration, the last
        solution, if the next step may go on like that. */
    void remember_motion(const Configuration<dim> &configuration,
                         State<dim> &state) const;
    /** Computes the matrix, its factors and the first correction of the next
        step, to measure their cost, and discards them. Collective. */
    void try_iteration(const State<dim> &state);

    /** Balance at the last equilibrium, where solve() began. */
    const Balance<dim> &start_balance() const
    {
      return start;
    }
    const Balance<dim> &current_balance() const
    {
      return balance;
    }
    /** Iterations of the last solve(), without those for new pressures of
        water. */
    unsigned int n_iterations() const
    {
      return iteration;
    }
    /** By how much of the applied forces the prediction of the load step was
        out of balance, or its reactions were others than expected [-]; 0: it
        was not predicted. */
    double prediction_error() const
    {
      return error;
    }
    /** Whether the linear solver is the direct one. */
    bool is_direct() const
    {
      return linear_solver.is_direct();
    }

  private:
    /** Iterates until forces are in balance; false: they do not come to be. */
    bool iterate(const State<dim> &state, const StepTarget &target,
                 Configuration<dim> &configuration);
    /** Moves @p configuration on as in the last load step or step of a jump,
        and finds the balance at its start; false: there is nothing to predict
        by, or it is no better. */
    bool predict(const State<dim> &state, const StepTarget &target,
                 Configuration<dim> &configuration);
    /** The prediction_error() of a load step to @p target. Collective. */
    double error_of_prediction(const State<dim> &state,
                               const StepTarget &target) const;
    /** Finds a correction and its share of the advance; false: none. */
    bool find_correction(const StepTarget &target,
                         const Configuration<dim> &configuration, bool is_first,
                         double &share);
    /** Largest ratio of unbalanced to applied forces in equilibrium. */
    double tolerance(const State<dim> &state, const StepTarget &target) const;
    /** Whether the displacement that a load pattern controls is reached. */
    bool is_controlled(const State<dim> &state, double load_time) const;
    void correct(const State<dim> &state, double share,
                 Configuration<dim> &configuration);
    bool break_joints();

    const Model<dim> &model;
    RunLoads<dim> &loads;
    const StageLoads<dim> &acting;
    const StageParameters &stage;
    const ImplicitParameters &parameters;
    const ImplicitSteps &steps;
    DofMap<dim> &dof_map;
    Equilibrium<dim> &equilibrium;
    PhaseClock &clock;
    ImplicitRecord &record;
    const MPI_Comm communicator;

    MotionPrediction<dim> prediction;
    LinearSolver<dim> linear_solver;

    Balance<dim> start;   /**< balance at the last equilibrium */
    Balance<dim> balance; /**< balance at the current configuration */
    Balance<dim> trial;   /**< balance of a trial of the line search */
    Advance advance;
    std::vector<std::uint8_t> broken; /**< joint points, in this step */
    bool some_broke = false;          /**< of any rank */
    Slopes slopes;
    DofVector residual, correction, advanced;

    Attempt attempt;
    unsigned int iteration = 0;
    bool is_predicted = false; /**< whether iterations began at a prediction */
    double error      = 0.;
    double last_share = 1.; /**< last fraction of the line search */
    const unsigned int assembly_phase, solver_phase;
  };
} // namespace quoin

#endif
