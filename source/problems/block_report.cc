// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/problems/block_report.h>
#include <quoin/problems/input_advice.h>
#include <quoin/problems/model_summary.h>
#include <quoin/problems/shaking.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    void advise(Log &log, const std::vector<std::string> &advice)
    {
      for (const std::string &text : advice)
        log.warning(text);
    }

    void warn_of_mesh(const MeshReport &report, Log &log)
    {
      if (report.unmatched_length > 0.)
        log.warning("outer edges lie on each other over "
                    + number_text(report.unmatched_length)
                    + " m without matching nodes, the first near ("
                    + number_text(report.unmatched_position[0]) + ", "
                    + number_text(report.unmatched_position[1])
                    + ") m: no joint is made there. Mesh both sides alike.");

      // A double has 16 digits.
      double farthest = 0.;
      for (unsigned int d = 0; d < 2; ++d)
        farthest = std::max({ farthest, std::abs(report.lower_left[d]),
                              std::abs(report.upper_right[d]) });
      if (report.shortest_edge < 1e-8 * farthest)
        log.warning("coordinates of up to " + number_text(farthest)
                    + " m leave few digits to edges of "
                    + number_text(report.shortest_edge)
                    + " m. Move the model nearer to the origin.");
      if (report.overlaps)
        log.warning(
            "blocks overlap near (" + number_text(report.overlap_position[0])
            + ", " + number_text(report.overlap_position[1])
            + ") m, where both then have their mass and stiffness. Take "
              "the surface out that is there twice, or cut it out of "
              "the other.");
    }

    void report_mesh(BlockContext &context)
    {
      BlockSystem &system          = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      // What touches without matching is in contact if displacements are large.
      if (parameters.model.contact.large_displacements)
        system.mesh_report.unmatched_length = 0.;
      if (!parameters.generated.report.empty())
        log.message(parameters.generated.report);
      log.message(system.mesh_report.to_text());
      const unsigned int n_rigid = system.n_rigid_blocks();
      if (n_rigid > 0)
        log.message(std::to_string(n_rigid) + " of the blocks "
                    + (n_rigid == 1 ? "is rigid" : "are rigid"));
      const unsigned int n_ranks
          = dealii::Utilities::MPI::n_mpi_processes(system.communicator);
      if (dealii::Utilities::MPI::min(system.nodes->n_cells(),
                                      system.communicator)
          == 0)
        log.warning("the model has "
                    + std::to_string(system.mesh_report.n_blocks)
                    + (system.mesh_report.n_blocks == 1 ? " block" : " blocks")
                    + " and the run " + std::to_string(n_ranks)
                    + " MPI ranks, of which some have no cells: blocks stay "
                      "whole where displacements are large, in equilibrium, "
                      "and where stages excavate or fill. Fewer ranks would be "
                      "as fast, but for boundary elements, which all share.");
      warn_of_mesh(system.mesh_report, log);
    }

    void report_initial_joints(BlockContext &context)
    {
      BlockSystem &system          = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      if (parameters.model.initial_stresses.empty())
        return;
      const double n = system.model->joints().n_beyond_strength(
          context.state.get<JointHistory>(), system.communicator);
      if (n > 0.)
        log.warning(
            number_text(n) + " of "
            + std::to_string(2 * system.nodes->n_joint_faces())
            + " joint points begin with tractions beyond their strength: "
              "they yield in the first stage. Check the initial stress "
              "and the strength of these joints.");
    }

    void report_parts(const BlockContext &context)
    {
      const BlockSystem &system    = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      for (const auto &lines :
           { material_lines(parameters, *system.nodes,
                            system.model->properties().material_of_group),
             joint_lines(parameters, system.mesh_report),
             load_lines(parameters, *system.nodes),
             boundary_lines(
                 parameters.boundary, system.boundary_geometry,
                 start_of_stage(parameters.stages, parameters.stages.size())) })
        for (const std::string &line : lines)
          log.message(line);
    }

    /** Of what is likely a mistake, once stage @p index has begun with @p
     * state. */
    void advise_about_stage(const BlockContext &context,
                            const unsigned int index, const State<2> &state)
    {
      const BlockSystem &system    = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      const StageParameters &stage = parameters.stages[index];
      if (stage.end == StageEnd::time && !system.model->large_displacements())
        advise(log, free_body_advice(stage.name,
                                     system.solver->pushed_bodies(state)));
      advise(log, stage_advice(parameters, index, *system.model, state,
                               system.explicit_solver->get_time_step()));
      if (!system.solver->far_field_acts())
        return;
      const FarFieldDomain &domain = system.solver->far_field()->domain();
      advise(log, element_advice(fastest_boundary_value(
                                     parameters.boundary,
                                     system.boundary_geometry, stage.duration),
                                 domain.medium.c2,
                                 domain.boundary.lengths().maxCoeff()));
    }

    std::string step_text(const BlockContext &context,
                          const StageParameters &stage)
    {
      const ExplicitSolver &solver = *context.system.explicit_solver;
      return "stage " + stage.name + ": time step "
             + number_text(solver.get_time_step()) + " s, "
             + number_text(100. * solver.get_time_step()
                           / solver.critical_time_step())
             + " % of the critical " + number_text(solver.critical_time_step())
             + " s"
             + (stage.end == StageEnd::time
                    ? ", " + std::to_string(context.steps.n_steps())
                          + (stage.slows_loads() ? " steps or more" : " steps")
                    : "")
             + (solver.added_mass_share() > 0.
                    ? ", mass scaling adds "
                          + number_text(100. * solver.added_mass_share())
                          + " % of mass"
                    : "");
    }

    void report_implicit_stages(BlockContext &context)
    {
      BlockSystem &system          = context.system;
      const Parameters &parameters = system.parameters;
      Log &log                     = context.run.log;
      // Stages are begun with a copy, to find what is wrong with them.
      State<2> state = context.state;
      for (unsigned int i = 0; i < parameters.stages.size(); ++i)
      {
        system.begin_stage(i, state);
        if (context.run.options.check)
          log.message(stage_line(parameters.stages[i], true));
        log.message("stage " + parameters.stages[i].name
                    + ": equilibrium up to the load time "
                    + number_text(system.implicit_solver->duration()) + " s, "
                    + std::to_string(system.implicit_solver->n_unknowns())
                    + " unknowns, "
                    + (system.implicit_solver->is_direct()
                           ? "LU factors"
                           : "GMRES with multigrid"));
        state.time += system.implicit_solver->duration();
      }
      system.construction->restart();
      log.message("inertia, damping and mass scaling are left out");
    }

  } // namespace

  void report_model(BlockContext &context)
  {
    BlockSystem &system          = context.system;
    const Parameters &parameters = system.parameters;
    Log &log                     = context.run.log;
    log.message(parameters.title.empty() ? parameters.file : parameters.title);
    report_mesh(context);
    if (const StaticFarField *far = system.solver->static_far_field())
      log.message("static boundary elements: their forces' matrix was "
                  "symmetric to "
                  + number_text(far->asymmetry()) + " of its largest entry");

    for (const JointSetParameters &set : parameters.model.joints)
    {
      const std::string warning = law_warning(set.law);
      if (!warning.empty())
        log.warning("section 'Joints/" + set.name + "': " + warning);
    }
    report_initial_joints(context);
    if (context.run.options.check)
      report_parts(context);
    advise(log, model_advice(parameters, *system.model));
  }

  void report_stages(BlockContext &context)
  {
    BlockSystem &system          = context.system;
    const Parameters &parameters = system.parameters;
    Log &log                     = context.run.log;
    if (system.implicit_solver)
      return report_implicit_stages(context);

    // Each stage's step is found without starting it.
    State<2> state     = context.state;
    bool time_is_known = true; // until a stage ends when it has settled
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      system.begin_stage(i, state, time_is_known);
      context.steps.choose(stage);
      if (context.run.options.check)
        log.message(stage_line(stage, false));
      log.message(step_text(context, stage));
      advise_about_stage(context, i, state);
      time_is_known &= stage.end == StageEnd::time && !stage.slows_loads();
      if (time_is_known)
        state.time += double(context.steps.n_steps())
                      * system.explicit_solver->get_time_step();
    }
    system.construction->restart();
  }
} // namespace quoin
