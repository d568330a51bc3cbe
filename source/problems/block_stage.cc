// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/block_stage.h>

namespace quoin
{
  double BlockContext::energy_residual() const
  {
    const Energies &energies = system.solver->energies();
    const double scale       = energies.throughput();
    return scale > 0. ? energies.residual() / scale : 0.;
  }

  ProgressFigures BlockContext::progress_figures(const StageParameters &stage,
                                                 const double fraction) const
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
    figures.energy_residual  = energy_residual();
    return figures;
  }

  bool has_settled(const BlockContext &context, const StageParameters &stage)
  {
    constexpr auto interval = ExplicitSolver::balance_interval;
    const State<2> &state   = context.state;
    return state.time - state.stage_start >= stage.minimum_duration
           && state.stage_step > interval
           && state.unbalanced_ratio <= stage.static_ratio
           && !context.system.solver->loads_change(
               state,
               interval * context.system.explicit_solver->get_time_step());
  }
} // namespace quoin
