// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/entry_numbers.h>
#include <quoin/results/measurements.h>
#include <quoin/farfield/boundary_report.h>
#include <quoin/advice/contact_advice.h>
#include <quoin/dynamics/step_limit.h>
#include <quoin/dynamics/state_checks.h>
#include <quoin/block_problem/block_problem.h>
#include <quoin/block_problem/block_costs.h>
#include <quoin/loading/constraint_checks.h>
#include <quoin/reinforcement/bar_results.h>
#include <quoin/structures/beam_fields.h>
#include <quoin/advice/model_summary.h>
#include <quoin/operators/archive.h>

#include <boost/serialization/map.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace quoin
{
  namespace
  {
    /** Share of the time in energies from which it is worth a hint [-]. */
    constexpr double large_energy_share = 0.3;

    template <int dim>
    std::string step_text(const BlockContext<dim> &context,
                          const StageParameters &stage)
    {
      const ExplicitSolver<dim> &solver = *context.system.explicit_solver;
      const double dt                   = solver.get_time_step();
      const double critical             = solver.critical_step().length;
      std::string text = text_of("stage ", stage.name, ": time step ", dt,
                                 " s, ", 100. * dt / critical,
                                 " % of the critical ", critical, " s");
      if (stage.end == StageEnd::time)
        text += text_of(", ", context.steps.n_steps(),
                        stage.slows_loads() ? " steps or more" : " steps");
      if (const double times = StableTimeStep<dim>::shortened_by(
              critical, stage.stiffness_coefficient);
          times > 1.1)
        text += text_of(", stiffness-proportional damping makes it ", times,
                        " times shorter");
      return text;
    }

    template <int dim>
    std::string unknowns_text(const ImplicitSolver<dim> &solver,
                              const StageParameters &stage)
    {
      return text_of("stage ", stage.name, ": equilibrium up to the load time ",
                     solver.steps().duration(), " s, ", solver.n_unknowns(),
                     " degrees of freedom, ",
                     solver.is_direct() ? "LU factors"
                                        : "GMRES with multigrid");
    }
  } // namespace

  template <int dim>
  BlockProblem<dim>::BlockProblem(const Parameters &parameters,
                                  MeshData<dim> mesh, const RunContext &run)
    : Problem(parameters, run), context(parameters, std::move(mesh), run),
      system(context.system), state(context.state)
  {
  }

  template <int dim>
  const std::string &BlockProblem<dim>::fingerprint() const
  {
    return system.fingerprint;
  }

  template <int dim>
  unsigned int BlockProblem<dim>::n_stages() const
  {
    return parameters.stages.size();
  }

  namespace
  {
    /** "water: ..." with a line about each place where it is given. */
    std::vector<std::string> water_lines(const JointFlow &water)
    {
      const WaterParameters &given = water.parameters();
      const bool is_steady         = given.flow == FlowKind::steady;
      std::vector<std::string> lines{ text_of(
          "water: ", is_steady ? "steady" : "transient", " flow in ",
          water.channels().network.channels().size(), " joint faces between ",
          water.channels().network.n_nodes(), " places") };
      for (const HydraulicAperture &joint : given.joints)
        lines.push_back(text_of("water in joints ", joint.name, ": aperture ",
                                joint.initial, " m and opening, from ",
                                joint.residual, " to ", joint.largest, " m"));
      for (unsigned int b = 0; b < given.boundaries.size(); ++b)
      {
        const WaterBoundary &boundary = given.boundaries[b];
        lines.push_back(text_of(
            "water at ", boundary.name, ": ",
            boundary.quantity == WaterQuantity::pressure ? "pressure"
            : boundary.quantity == WaterQuantity::head   ? "head"
            : boundary.quantity == WaterQuantity::outlet ? "outlet"
                                                         : "flow",
            " at ", water.channels().boundary_nodes[b].size(), " of them"));
      }
      return lines;
    }
  } // namespace

  template <int dim>
  void BlockProblem<dim>::report_model()
  {
    if (!parameters.generated.report.empty())
      run.log.message(parameters.generated.report);
    run.log.message(system.mesh_report.to_text());
    if (const unsigned int n_rigid = system.n_rigid_blocks(); n_rigid > 0)
      run.log.message(n_rigid, " of the blocks ",
                      n_rigid == 1 ? "is rigid" : "are rigid");
    if (const StaticFarField *far = system.solver->loads().far.elastostatic)
      run.log.message("static boundary elements: the stiffness of the rock "
                      "beyond the blocks was made symmetric; it differed by ",
                      far->asymmetry(), " of its largest entry");
    if (const Beams *beams = system.solver->loads().beams.get())
      for (const auto &[line, interface] : beams->all())
        run.log.message(beam_text(line));
    if (run.options.check)
      for (const auto &lines :
           { material_lines(parameters, *system.nodes,
                            system.model->properties().material_of_group),
             bending_lines(parameters, system.mesh_report,
                           system.model->properties().material_of_group),
             joint_lines(parameters, system.mesh_report),
             load_lines(parameters, *system.nodes),
             boundary_lines(
                 parameters.boundary, system.boundary_geometry,
                 start_of_stage(parameters.stages, parameters.stages.size())) })
        run.log.messages(lines);
    if (run.options.check)
    {
      run.log.messages(contact_lines(*system.model, state));
      run.log.messages(face_lines(parameters, *system.nodes));
    }
    run.log.messages(rigid_face_lines(parameters, *system.nodes));
    if constexpr (dim == 2)
      if (run.options.check)
      {
        run.log.messages(named_block_lines(*system.model, system.named_blocks));
        if (system.water)
          run.log.messages(water_lines(*system.water));
        if (!system.model->reinforcement().empty())
          run.log.message(cable_text(system.model->reinforcement()));
      }
    run.log.warnings(
        model_advice(parameters, system.mesh_report, *system.model, state));
    report_stages();
  }

  template <int dim>
  void BlockProblem<dim>::report_stages()
  {
    // Stages are begun with a copy, to find errors in them.
    State<dim> begun   = state;
    bool time_is_known = true; // until a static stage, whose end is unknown
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      system.begin_stage(i, begun, time_is_known);
      if (const std::string lost = lost_motion_text(
              *system.model, system.solver->stage_loads().constraints);
          !lost.empty())
        run.log.warning("stage ", stage.name, ": ", lost);
      if constexpr (dim == 2)
        for (const std::string &text : absent_host_texts(
                 system.model->reinforcement(), begun, stage.name, i == 0))
          run.log.warning("stage ", stage.name, ": ", text);
      if (run.options.check)
        run.log.message(stage.text(parameters.is_implicit));
      if (const ImplicitSolver<dim> *solver = system.implicit_solver)
      {
        run.log.message(unknowns_text(*solver, stage));
        begun.load_time = solver->steps().duration();
        begun.time += begun.load_time;
        continue;
      }
      context.steps.choose(stage);
      run.log.message(step_text(context, stage));
      report_added_mass(i);
      if (i == 0)
        if (const StepLimit<dim> limit = find_step_limit(*system.model, state);
            limit.critical > 0.)
        {
          run.log.message(limit.text());
          if (limit.is_of_few() && !parameters.generated.cleaning.empty())
            run.log.message(parameters.generated.cleaning);
        }
      if (const double gain = system.explicit_solver->critical_step().gain;
          i == 0 && gain > 1.)
        run.log.message("by the stiffness of all blocks and joints together, "
                        "'Critical time step = assembled' in section 'Time "
                        "stepping', it is ",
                        gain, " times as long as this bound by each node");
      advise_about_stage(i, begun);
      time_is_known &= stage.duration_is_known();
      if (time_is_known)
      {
        begun.load_time = double(context.steps.n_steps())
                          * system.explicit_solver->get_time_step();
        begun.time += begun.load_time;
      }
    }
    if (system.construction)
      system.construction->restart();
    if (system.implicit_solver)
      run.log.message("static equilibria: inertia, damping and mass scaling "
                      "have no effect");
  }

  template <int dim>
  void BlockProblem<dim>::report_added_mass(const unsigned int index)
  {
    const StageParameters &stage = parameters.stages[index];
    const AddedMass &added = system.explicit_solver->critical_step().added;
    if (const double water = system.explicit_solver->added_water().total();
        water > 0.)
      run.log.message("stage ", stage.name, ": ", water,
                      " kg of water move with the faces below it");
    if (added.share == 0.)
      return;
    run.log.message("stage ", stage.name, ": ", added.text());
    if (stage.is_dynamic())
      if (const std::string warning
          = added.warning(fastest_load(parameters, index).frequency);
          !warning.empty())
        run.log.warning("stage ", stage.name, ": ", warning);
  }

  template <int dim>
  void BlockProblem<dim>::advise_about_stage(const unsigned int index,
                                             const State<dim> &begun) const
  {
    const StageParameters &stage = parameters.stages[index];
    if (stage.end == StageEnd::time
        && !system.model->parameters().large_displacements)
      if (const auto bodies = system.solver->stage_loads().unsupported_bodies(
              *system.model, stage, begun);
          !bodies.empty())
        run.log.warning("stage ", stage.name, ": ",
                        unsupported_body_text(bodies));
    run.log.warnings(stage_advice(parameters, index, *system.model, begun,
                                  system.explicit_solver->get_time_step()));
    if (system.solver->loads().far.elastodynamic_acts)
      run.log.warnings(boundary_advice(parameters.boundary,
                                       system.boundary_geometry, stage.duration,
                                       wants_hoop_stress(parameters)));
  }

  template <int dim>
  void BlockProblem<dim>::report_costs()
  {
    report_block_costs(context);
  }

  template <int dim>
  void BlockProblem<dim>::open_outputs()
  {
    context.outputs.open();
  }

  template <int dim>
  std::unique_ptr<Stage> BlockProblem<dim>::make_stage(const unsigned int index)
  {
    if (parameters.stages[index].safety)
      return make_safety_stage(context, index);
    if (system.implicit_solver)
      return make_implicit_stage(context, index);
    return make_explicit_stage(context, index);
  }

  template <int dim>
  void BlockProblem<dim>::restore(const unsigned int index)
  {
    context.system.restore(index, state);
  }

  template <int dim>
  void BlockProblem<dim>::complete_state()
  {
    system.solver->check_finite(state);
    check_cells(*system.model, state,
                parameters
                    .stages[std::min<std::size_t>(state.stage,
                                                  parameters.stages.size() - 1)]
                    .loads);
    system.solver->save(state);
  }

  template <int dim>
  template <typename Archive>
  void BlockProblem<dim>::archive_all(Archive &archive, State<dim> &archived)
  {
    archive &archived &context.outputs &context.iterations &context
        .cuts &context.searches &context.outcomes &context.loads &context
        .damping_shares &context.peaks &context.displaced &context.joint_motion;
    Energies energies = system.solver->energies();
    archive &energies;
    system.solver->set_energies(energies);
  }

  template <int dim>
  void BlockProblem<dim>::save(boost::archive::binary_oarchive &archive)
  {
    archive_all(archive, state);
    const EntryNumbers numbers
        = number_entries_of(state, *system.model, *system.solver);
    archive << numbers;
    // Only checkpoints need them.
    system.solver->discard_saved(state);
  }

  template <int dim>
  void BlockProblem<dim>::load(boost::archive::binary_iarchive &archive,
                               const ArchiveOrigin &origin)
  {
    if (origin.is_own)
      return archive_all(archive, state);
    if (!gathering)
      gathering = std::make_unique<StateGathering<dim>>(
          number_entries(*system.model, *system.solver),
          dealii::Utilities::MPI::this_mpi_process(run.communicator) == 0,
          state);
    State<dim> part = state; // with its slices
    EntryNumbers numbers;
    archive_all(archive, part);
    archive >> numbers;
    gathering->take(part, numbers);
    if (origin.rank > 0)
      return;
    gathering->finish();
    gathering.reset();
  }

  template <int dim>
  void BlockProblem<dim>::summarise(nlohmann::ordered_json &summary,
                                    const double seconds) const
  {
    const MeshReport &report = system.mesh_report;
    const Energies &energies = system.solver->energies();
    summary.update(
        { { "blocks", report.n_blocks },
          { "rigid blocks", system.n_rigid_blocks() },
          { "cells", report.n_cells },
          { "nodes", report.n_nodes },
          { "joint faces", report.n_joint_faces },
          { report.dimension == 2 ? "joint length [m]" : "joint area [m2]",
            report.total_joint_size },
          { "shortest edge [m]", report.shortest_edge },
          { "smallest angle [deg]", report.smallest_angle },
          { "time [s]", state.time },
          { "steps", state.step },
          { "unbalanced ratio", state.unbalanced_ratio },
          { "energy throughput [J]", energies.throughput() },
          { "energy residual [J]", energies.residual() },
          { "largest energy residual [J]", context.outputs.largest().residual },
          { "energy residual share", context.energy_residual() },
          { "solver", system.implicit_solver ? "implicit" : "explicit" } });
    if constexpr (dim == 2)
      if (system.water)
      {
        const FlowVolumes water = system.water->volumes(
            state, state.load_start() + state.load_time);
        summary.update({ { "water inflow [m3]", water.inflow },
                         { "water outflow [m3]", water.outflow },
                         { "stored water [m3]", water.stored },
                         { "water residual [m3]", water.residual } });
      }
    if (const ExplicitSolver<dim> *solver = system.explicit_solver)
      summary.update(
          { { "time step [s]", solver->get_time_step() },
            { "critical time step [s]", solver->critical_step().length },
            { "added mass share", solver->critical_step().added.share },
            { "element updates per second",
              seconds > 0.
                  ? double(report.n_cells) * double(context.n_done) / seconds
                  : 0. } });
    if (const ImplicitSolver<dim> *solver = system.implicit_solver)
      summary.update({ { "unknowns", solver->n_unknowns() },
                       { "iterations", context.iterations },
                       { "cut steps", context.cuts } });
    summarise_searches(summary);
    summarise_outcomes(summary);
    summarise_time(system.solver->time_spent(), seconds, summary);
    if (parameters.model.contact.has_box)
    {
      const auto &marks = state.block_marks;
      summary["blocks deleted"]
          = std::count(marks.begin(), marks.end(), block_mark::removed);
      summary["blocks outside the box"]
          = std::count(marks.begin(), marks.end(), block_mark::left_box);
    }
    if constexpr (dim == 2)
      if (system.model->contacts())
        summarise_contacts(summary, seconds);
    if (summary["finished"] && parameters.measure_bandwidth)
      summarise_bandwidth(summary, seconds);
  }

  template <int dim>
  void
  BlockProblem<dim>::summarise_searches(nlohmann::ordered_json &summary) const
  {
    for (unsigned int i = 0; i < context.searches.size(); ++i)
    {
      const FactorSearch &search = context.searches[i];
      if (search.trials().empty())
        continue;
      nlohmann::ordered_json &result
          = summary["factor of safety"][parameters.stages[i].name];
      result = { { "stable at", search.highest_stable() },
                 { "trials", search.trials().size() },
                 { "trial steps", search.n_steps() } };
      if (std::isfinite(search.lowest_failing()))
        result["failing at"] = search.lowest_failing();
      if (const auto open = search.undecided())
        result["undecided"] = *open;
    }
  }

  template <int dim>
  void
  BlockProblem<dim>::summarise_outcomes(nlohmann::ordered_json &summary) const
  {
    for (unsigned int i = 0; i < context.outcomes.size(); ++i)
    {
      const StageOutcome &ended = context.outcomes[i];
      if (ended.outcome.empty())
        continue;
      nlohmann::ordered_json &stage
          = summary["stages"][parameters.stages[i].name];
      stage = { { "outcome", ended.outcome },
                { "time [s]", ended.time },
                { "step", ended.step } };
      if (!ended.condition.empty())
        stage["condition"] = ended.condition;
      context.loads[i].summarise(stage);
      const LocalDampingShare &damping = context.damping_shares[i];
      if (damping.n > 0)
        stage["local damping share"] = damping.sum / double(damping.n);
    }
    if (context.failure.empty())
      return;
    nlohmann::ordered_json &stage
        = summary["stages"][parameters.stages[state.stage].name];
    stage = { { "outcome", "failed" },
              { "reason", context.failure },
              { "time [s]", state.time },
              { "step", state.step } };
    context.loads[state.stage].summarise(stage);
  }

  template <>
  void BlockProblem<2>::summarise_contacts(nlohmann::ordered_json &summary,
                                           const double seconds) const
  {
    const BlockContacts *contacts = system.model->contacts();
    const double sums[3]
        = { n_touching(contacts->near_pairs(), state.get<ContactState>()),
            double(contacts->work().updates), contacts->work().search_seconds };
    std::array<double, 3> all;
    MPI_Allreduce(sums, all.data(), 3, MPI_DOUBLE, MPI_SUM, run.communicator);
    // Ranks search together: the mean of their times counts.
    all[2] /= dealii::Utilities::MPI::n_mpi_processes(run.communicator);
    const auto rate
        = [&](const double n) { return seconds > 0. ? n / seconds : 0.; };
    summary["contacts"]                   = all[0];
    summary["contact updates per second"] = rate(all[1]);
    summary["contact searches"]     = state.get<ContactState>().n_searches;
    summary["contact search share"] = rate(all[2]);
  }

  template <int dim>
  void BlockProblem<dim>::summarise_bandwidth(nlohmann::ordered_json &summary,
                                              const double seconds) const
  {
    namespace MPI = dealii::Utilities::MPI;
    StepSize size{ double(system.mesh_report.n_nodes),
                   double(system.mesh_report.n_cells),
                   double(dim) * system.nodes->faces().n_global_joints, 0. };
    if (summary.contains("contacts"))
    {
      size.n_contacts     = summary["contacts"].get<double>();
      size.n_joint_points = 0.; // most are contacts
    }
    const double bytes    = step_bytes(dim, size);
    const double measured = MPI::sum(
        memory_bandwidth(bytes / MPI::n_mpi_processes(run.communicator)),
        run.communicator);
    const double moved
        = seconds > 0. ? bytes * double(context.n_done) / seconds : 0.;
    summary["bytes of a step [B]"]       = bytes;
    summary["they fit into"]             = smallest_store(bytes);
    summary["bytes moved [B/s]"]         = moved;
    summary["memory bandwidth [B/s]"]    = measured;
    summary["share of memory bandwidth"] = moved / measured;
  }

  template <int dim>
  std::string BlockProblem<dim>::residual_advice() const
  {
    /** Error beyond which results are wrong, whatever is asked of them. */
    constexpr double useless = 0.05;
    const std::string judged
        = std::abs(context.energy_residual()) > useless
              ? "Do not use the result: the energy balance error is too large. "
              : "Equilibria can be used; motion, peaks and energies only if "
                "they do not change with smaller steps. ";
    if (system.implicit_solver)
      return judged
             + "Halve 'First step' and 'Largest step' in section 'Implicit', "
               "which follows loads and joints more closely, and compare.";
    return judged + "Halve 'Share of critical time step' and compare"
           + (dim == 3 || system.model->parameters().large_displacements
                  ? "."
                  : "; blocks that turn or slide far need 'Displacements = "
                    "large' in section 'Contact'.");
  }

  template <int dim>
  Problem::ClosingLines
  BlockProblem<dim>::closing_lines(const nlohmann::ordered_json &summary) const
  {
    const auto millions = [&](const char *name)
    { return text_of(summary[name].get<double>() / 1e6, " million "); };
    /** Largest error by the energy throughput; user_guide.md, "Judge the
        result". */
    constexpr double largest = 1e-3;
    const double residual    = context.energy_residual();
    if (std::abs(residual) > largest)
      run.log.warning("the energy balance error is ", 100. * residual,
                      " % of the energy throughput, more than 0.1 %. ",
                      residual_advice());
    /** Largest energy that changing areas and normals of contacts may take or
        give, by what damping leaves of the energy throughput, as damping may
        take most of it before and after contacts, or by the largest kinetic
        energy, most of which impacts may take. */
    constexpr double largest_of_contacts = 0.05;
    const Energies &energies             = system.solver->energies();
    const double left        = energies.throughput() - energies.damping;
    const double kinetic     = context.outputs.largest().kinetic;
    const double of_contacts = energies.contact / std::max(left, kinetic);
    if (std::abs(of_contacts) > largest_of_contacts)
      run.log.warning(
          "general contacts ", of_contacts > 0. ? "took" : "gave", " ",
          100. * std::abs(of_contacts), " % of ",
          left > kinetic ? "the energy that damping left"
                         : "the largest kinetic energy",
          " as their areas and normals changed (column 'contact [J]' of "
          "energies.csv), more than 5 %: overlaps are "
          "deep for edges as long as these. Compare with a run with a higher "
          "'Normal stiffness'.");
    const std::uint64_t n_trial_steps = std::accumulate(
        context.searches.begin(), context.searches.end(), std::uint64_t(0),
        [](const std::uint64_t n, const FactorSearch &search)
        { return n + search.n_steps(); });
    ClosingLines words{ text_of(state.step, " steps",
                                n_trial_steps > 0 ? text_of(
                                    " and ", n_trial_steps, " of trials")
                                                  : ""),
                        text_of(system.implicit_solver
                                    ? text_of(context.iterations, " iterations")
                                    : millions("element updates per second")
                                          + "element updates a second",
                                ", energy balance error ", 100. * residual,
                                " % of the energy throughput") };
    words.figures += time_line(summary);
    if (const double energies = summary["time shares"].value("energies", 0.);
        energies > large_energy_share && parameters.history_interval == 0.)
      words.figures += "\nenergies are for rows of histories at each step: an "
                       "'Interval' in section 'Histories' saves most of it";
    if (system.model->contacts())
      words.figures += text_of(
          "\ncontacts: ", millions("contact updates per second"),
          "updates a second, ", state.template get<ContactState>().n_searches,
          " searches that took ",
          100. * summary["contact search share"].get<double>(),
          " % of the time");
    return words;
  }

  template class BlockProblem<2>;
  template class BlockProblem<3>;
} // namespace quoin
