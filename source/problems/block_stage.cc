// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/block_stage.h>

namespace quoin
{
  BlockContext::BlockContext(const Parameters &parameters,
                             const RunContext &run)
    : run(run), system(parameters, run.communicator), steps(system, run.log),
      outputs(system, run), state(system.initial_state()),
      searches(parameters.stages.size())
  {
  }

  double BlockContext::energy_residual() const
  {
    const Energies &energies = system.solver->energies();
    const double scale       = energies.throughput();
    return scale > 0. ? energies.residual() / scale : 0.;
  }

  BlockStage::BlockStage(BlockContext &context, const unsigned int index)
    : context(context), system(context.system), outputs(context.outputs),
      log(context.run.log), index(index),
      stage(system.parameters.stages[index]), state(context.state)
  {
  }

  void BlockStage::end()
  {
    finish();
    system.solver->check_finite(state);
    system.solver->check_cells(state);
    warn_of_slip();
    ++state.stage;
    outputs.write_fields(state);
  }

  void BlockStage::warn_of_slip() const
  {
    /** Half of the blocks' edges is left on each other. */
    constexpr double most = 0.5;
    if (system.model->large_displacements())
      return;
    const double share = system.solver->largest_slip_share(state);
    if (share > most)
      log.warning("stage ", stage.name, ": joints have slipped by up to ",
                  100. * share,
                  " % of the edges that touch, but small displacements leave "
                  "blocks where they are: areas and neighbours no longer hold. "
                  "Take 'Displacements = large' in section 'Contact'.");
  }

  ProgressFigures BlockStage::figures_at(const double fraction) const
  {
    ProgressFigures figures;
    figures.stage    = stage.name;
    figures.time     = state.time;
    figures.step     = state.step;
    figures.fraction = fraction;
    if (const ExplicitSolver *solver = system.explicit_solver)
      figures.share_of_critical
          = solver->get_time_step() / solver->critical_time_step();
    figures.unbalanced_ratio = state.unbalanced_ratio;
    figures.energy_residual  = context.energy_residual();
    return figures;
  }

  double BlockStage::load_share() const
  {
    return state.get<ImplicitState>().released < 1.
               ? 0.
               : state.load_time / system.implicit_solver->duration();
  }

  bool BlockStage::has_settled() const
  {
    constexpr auto interval = ExplicitSolver::balance_interval;
    return state.time - state.stage_start >= stage.minimum_duration
           && state.stage_step > interval
           && state.unbalanced_ratio <= stage.static_ratio
           && !system.solver->loads_change(
               state, interval * system.explicit_solver->get_time_step());
  }
} // namespace quoin
