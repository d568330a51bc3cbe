// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/problems/bandwidth.h>
#include <quoin/problems/block_problem.h>
#include <quoin/problems/block_report.h>
#include <quoin/problems/explicit_stage.h>
#include <quoin/problems/implicit_stage.h>
#include <quoin/problems/safety_stage.h>
#include <quoin/operators/archive.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Smaller shares of the time are not worth a word. */
    constexpr double least_share = 1e-3;
  } // namespace

  BlockProblem::BlockProblem(const Parameters &parameters,
                             const RunContext &run)
    : parameters(parameters), run(run), system(parameters, run.communicator),
      steps(system, run.log), outputs(system, run),
      state(system.initial_state()), context{ run, system, steps, outputs,
                                              state },
      searches(parameters.stages.size())
  {
  }

  std::string BlockProblem::fingerprint() const
  {
    return system.fingerprint;
  }

  unsigned int BlockProblem::n_stages() const
  {
    return parameters.stages.size();
  }

  void BlockProblem::report()
  {
    report_model(context);
    report_stages(context);
    // Nobody would read it.
    if (run.options.check && !run.options.quiet)
      report_costs(context);
  }

  void BlockProblem::open_outputs()
  {
    outputs.open();
  }

  void BlockProblem::make_stage(const unsigned int index)
  {
    if (parameters.stages[index].safety)
      stage = std::make_unique<SafetyStage>(context, index, searches[index]);
    else if (system.implicit_solver)
      stage = std::make_unique<ImplicitStage>(context, index);
    else
      stage = std::make_unique<ExplicitStage>(context, index);
  }

  void BlockProblem::resume(const unsigned int index, const bool has_begun)
  {
    if (!has_begun)
      return system.restore(index, state);
    make_stage(index);
    stage->resume();
  }

  void BlockProblem::begin_stage(const unsigned int index)
  {
    make_stage(index);
    stage->begin();
  }

  bool BlockProblem::stage_is_over() const
  {
    return stage->is_over();
  }

  Problem::Checkpoint BlockProblem::take_step()
  {
    return stage->take_step();
  }

  ProgressFigures BlockProblem::progress_figures() const
  {
    return stage->figures();
  }

  void BlockProblem::end_stage()
  {
    stage->end();
    system.solver->check_finite(state);
    system.solver->check_cells(state);
    warn_of_slip();
    ++state.stage;
    outputs.write_fields(state);
  }

  void BlockProblem::warn_of_slip() const
  {
    /** Half of the blocks' edges is left on each other. */
    constexpr double most = 0.5;
    if (system.model->large_displacements())
      return;
    const double share = system.solver->largest_slip_share(state);
    if (share > most)
      run.log.warning(
          "stage " + parameters.stages[state.stage].name
          + ": joints have slipped by up to " + number_text(100. * share)
          + " % of the edges that touch, but small displacements leave "
            "blocks where they are: areas and neighbours no longer "
            "hold. Take 'Displacements = large' in section 'Contact'.");
  }

  void BlockProblem::complete_state()
  {
    system.solver->check_finite(state);
    system.solver->check_cells(state);
    system.solver->save(state);
  }

  template <typename Archive>
  void BlockProblem::archive_all(Archive &archive)
  {
    archive &state &outputs &context.iterations &context.cuts &searches;
  }

  void BlockProblem::save(boost::archive::binary_oarchive &archive)
  {
    archive_all(archive);
    // Only checkpoints need them.
    system.solver->discard_saved(state);
  }

  void BlockProblem::load(boost::archive::binary_iarchive &archive)
  {
    archive_all(archive);
  }

  void BlockProblem::summarise(nlohmann::json &summary,
                               const double seconds) const
  {
    const MeshReport &report = system.mesh_report;
    const Energies &energies = system.solver->energies();
    const auto rate
        = [&](const double n) { return seconds > 0. ? n / seconds : 0.; };
    summary.update(
        { { "blocks", report.n_blocks },
          { "rigid blocks", system.n_rigid_blocks() },
          { "cells", report.n_cells },
          { "nodes", report.n_nodes },
          { "joint faces", report.n_joint_faces },
          { "joint length [m]", report.total_joint_length },
          { "shortest edge [m]", report.shortest_edge },
          { "smallest angle [deg]", report.smallest_angle },
          { "time [s]", state.time },
          { "steps", state.step },
          { "unbalanced ratio", state.unbalanced_ratio },
          { "energy throughput [J]", energies.throughput() },
          { "energy residual [J]", energies.residual() },
          { "largest energy residual [J]", outputs.largest_residual() },
          { "energy residual share", context.energy_residual() },
          { "solver", system.implicit_solver ? "implicit" : "explicit" } });
    if (const ExplicitSolver *solver = system.explicit_solver)
      summary.update(
          { { "time step [s]", solver->get_time_step() },
            { "critical time step [s]", solver->critical_time_step() },
            { "added mass share", solver->added_mass_share() },
            { "element updates per second",
              rate(double(report.n_cells) * double(context.n_done)) } });
    if (const ImplicitSolver *solver = system.implicit_solver)
      summary.update({ { "unknowns", solver->n_unknowns() },
                       { "iterations", context.iterations },
                       { "cut steps", context.cuts } });
    summarise_searches(summary);
    summarise_time(summary, seconds);
    if (parameters.model.contact.has_box)
    {
      const auto &marks = state.block_marks;
      summary["blocks deleted"]
          = std::count(marks.begin(), marks.end(), block_mark::removed);
      summary["blocks outside the box"]
          = std::count(marks.begin(), marks.end(), block_mark::left_box);
    }
    if (system.solver->contacts())
      summarise_contacts(summary, seconds);
    if (summary["finished"] && parameters.measure_bandwidth)
    {
      const double bytes    = step_bytes(report.n_nodes, report.n_cells);
      const double measured = dealii::Utilities::MPI::sum(
          memory_bandwidth(
              bytes
              / dealii::Utilities::MPI::n_mpi_processes(run.communicator)),
          run.communicator);
      const double used                 = rate(bytes * double(context.n_done));
      summary["memory bandwidth [B/s]"] = measured;
      summary["share of memory bandwidth"] = used / measured;
    }
  }

  void BlockProblem::summarise_time(nlohmann::json &summary,
                                    const double seconds) const
  {
    const PhaseClock &clock = system.solver->time_spent();
    std::vector<double> times;
    for (unsigned int i = 0; i < clock.phases().size(); ++i)
      times.push_back(clock.time(i));
    // Processes step together: the mean of their times counts. They have the
    // same phases, because they have the same operators.
    dealii::Utilities::MPI::sum(times, run.communicator, times);
    const double all
        = seconds * dealii::Utilities::MPI::n_mpi_processes(run.communicator);
    double other = 1.;
    for (unsigned int i = 0; i < times.size() && all > 0.; ++i)
    {
      const double share = times[i] / all;
      other -= share;
      if (share >= least_share)
        summary["time shares"][clock.phases()[i]] = share;
    }
    summary["time shares"]["other"] = std::max(other, 0.);
  }

  void BlockProblem::summarise_searches(nlohmann::json &summary) const
  {
    for (unsigned int i = 0; i < searches.size(); ++i)
      if (std::isfinite(searches[i].lowest_failing()))
        summary["factor of safety"][parameters.stages[i].name]
            = { { "stable at", searches[i].highest_stable() },
                { "failing at", searches[i].lowest_failing() },
                { "trials", searches[i].trials().size() } };
  }

  void BlockProblem::summarise_contacts(nlohmann::json &summary,
                                        const double seconds) const
  {
    const BlockContacts *contacts = system.solver->contacts();
    const double sums[3]
        = { contacts->n_touching(state.get<ContactState>()),
            double(contacts->n_updates()), contacts->search_seconds() };
    std::array<double, 3> all;
    MPI_Allreduce(sums, all.data(), 3, MPI_DOUBLE, MPI_SUM, run.communicator);
    summary["contacts"] = all[0];
    summary["contact updates per second"]
        = seconds > 0. ? all[1] / seconds : 0.;
    summary["contact searches"] = state.get<ContactState>().n_searches;
    // Ranks search together: the mean of their times counts.
    summary["contact search share"]
        = seconds > 0.
              ? all[2]
                    / dealii::Utilities::MPI::n_mpi_processes(run.communicator)
                    / seconds
              : 0.;
  }

  void BlockProblem::warn_of_residual() const
  {
    /** By the energy throughput; user_guide.md, "Judge the result". */
    constexpr double largest = 1e-3;
    const double residual    = context.energy_residual();
    if (std::abs(residual) > largest)
      run.log.warning(
          "the energy residual is " + number_text(100. * residual)
          + " % of what went through, more than 0.1 %: energy came or "
            "went that no account knows of. Compare with a run with "
            "half the 'Share of critical time step'"
          + (system.model->large_displacements()
                 ? "."
                 : "; blocks that turn or slide far need "
                   "'Displacements = large' in section 'Contact'."));
  }

  void BlockProblem::report_end(const nlohmann::json &summary)
  {
    const auto millions = [&](const char *name)
    { return number_text(summary[name].get<double>() / 1e6) + " million "; };
    warn_of_residual();
    run.log.message(
        "finished: " + std::to_string(state.step) + " steps in "
        + duration_text(summary["wall time [s]"].get<double>()) + ", "
        + (system.implicit_solver
               ? std::to_string(context.iterations) + " iterations"
               : millions("element updates per second")
                     + "element updates a second")
        + ", energy residual " + number_text(context.energy_residual())
        + " of what went through");
    std::string shares;
    for (const auto &[phase, share] : summary["time shares"].items())
      if (share.get<double>() >= least_share)
        shares += (shares.empty() ? "" : ", ") + phase + " "
                  + number_text(std::round(1e3 * share.get<double>()) / 10.)
                  + " %";
    run.log.message("time: " + shares);
    if (system.solver->contacts())
      run.log.message(
          "contacts: " + millions("contact updates per second")
          + "updates a second, "
          + std::to_string(state.get<ContactState>().n_searches)
          + " searches that took "
          + number_text(100. * summary["contact search share"].get<double>())
          + " % of the time");
  }
} // namespace quoin
