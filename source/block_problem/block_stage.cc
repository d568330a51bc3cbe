// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/state_checks.h>
#include <quoin/operators/archive.h>
#include <quoin/block_problem/block_stage.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/results/result_origin.h>
#include <quoin/structures/beam_fields.h>

#include <numeric>

namespace quoin
{
  namespace
  {
    double degrees(const double radians)
    {
      return radians * 180. / dealii::numbers::PI;
    }

    /** What follows blocks that go far; empty: nothing does. */
    template <int dim>
    std::string cure_of_small_displacements(const BlockSystem<dim> &system)
    {
      return dim == 3 ? ""
             : system.implicit_solver
                 ? "Take 'Solver = explicit' with 'Displacements = large' in "
                   "section 'Contact'"
                 : "Take 'Displacements = large' in section 'Contact'";
    }

    /** Number of points at which each beam is attached to blocks. */
    template <int dim>
    std::vector<unsigned int> attached_points(const BlockSystem<dim> &system,
                                              const State<dim> &state)
    {
      std::vector<unsigned int> result;
      if constexpr (dim == 2)
        if (const Beams *beams = system.solver->loads().beams.get())
          for (const auto &[line, interface] : beams->all())
          {
            const auto begin = state.template get<BeamState>().attached.begin()
                               + interface.first;
            result.push_back(
                std::accumulate(begin, begin + interface.points.size(), 0U));
          }
      return result;
    }
  } // namespace

  template <int dim>
  BlockContext<dim>::BlockContext(const Parameters &parameters,
                                  MeshData<dim> mesh, const RunContext &run)
    : run(run), system(parameters, std::move(mesh), run.communicator),
      steps(system, run.log), outputs(system, run),
      state(system.initial_state()), searches(parameters.stages.size()),
      outcomes(parameters.stages.size()), loads(parameters.stages.size()),
      damping_shares(parameters.stages.size())
  {
    state.template add<ResultOrigin<dim>>();
    for (const StageParameters &stage : parameters.stages)
      if (stage.pattern && stage.pattern->controlled != "mean")
        naming(parameters.file,
               [&]()
               {
                 system.solver->loads().controls[stage.name]
                     = outputs.histories().terms_of(stage.pattern->controlled,
                                                    "section 'Stages/"
                                                        + stage.name + "': ");
               });
  }

  template <int dim>
  double BlockContext<dim>::energy_residual() const
  {
    const Energies &energies = system.solver->energies();
    const double scale       = std::max(
              { energies.throughput(), outputs.largest().throughput, rounding });
    return scale > 0. ? energies.residual() / scale : 0.;
  }

  template <int dim>
  void BlockContext<dim>::note_rounding()
  {
    /** Motion of the whole model [m/s] and of the loads, by its size [-], of
        which at least energies are made: strains of elastic models are larger
        by some powers of ten. */
    constexpr double least_velocity = 1e-10, least_motion = 1e-12;
    const NodeMap<dim> &nodes = system.model->nodes();
    AlignedArray<dealii::Tensor<1, dim>> forces(state.nodes.size(),
                                                dealii::Tensor<1, dim>());
    for (const NodalLoad<dim> *load : system.solver->stage_loads().nodal)
      load->add_loads({ state.load_time, state.load_start() + state.load_time },
                      forces.data());
    nodes.exchange().add_to_owners(forces.data());
    double energy = 0.;
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      energy += system.model->mass()[i] * least_velocity * least_velocity
                + least_motion * system.nodes->table().diagonal()
                      * forces[i].norm();
    rounding = std::max(rounding,
                        dealii::Utilities::MPI::sum(energy, run.communicator));
  }

  template <int dim>
  BlockStage<dim>::BlockStage(BlockContext<dim> &context,
                              const unsigned int index)
    : context(context), system(context.system), outputs(context.outputs),
      log(context.run.log), index(index),
      stage(system.parameters.stages[index]), state(context.state),
      conditions(end_conditions(stage, system.parameters.histories))
  {
  }

  template <int dim>
  void BlockStage<dim>::begin_model()
  {
    const std::vector<unsigned int> points = attached_points(system, state);
    system.begin_stage(index, state);
    warn_of_cut_liners(points);
    outputs.begin_stage(stage.reset, state);
    context.note_rounding();
    for (const NodalLoad<dim> *load : system.solver->stage_loads().nodal)
      if (load->pressed_joints().have_bared_sides(state))
        log.warning("stage ", stage.name, ": the load ", load->name(),
                    " is a pressure in joints, and goes on to act on blocks "
                    "whose neighbour across the joint is excavated or not "
                    "there yet. If the water drains there, give these joints "
                    "a load of their own, and leave it out of the stage.");
  }

  template <int dim>
  void BlockStage<dim>::warn_of_cut_liners(
      const std::vector<unsigned int> &before) const
  {
    const std::vector<unsigned int> now = attached_points(system, state);
    if constexpr (dim == 2)
      for (std::size_t b = 0; b < before.size(); ++b)
        if (now[b] < before[b])
          log.warning(
              "stage ", stage.name, ": the liner ",
              system.solver->loads().beams->all()[b].line.given.name,
              " is attached to blocks that 'Excavate' takes away. Its "
              "interface to them is cut at once, whatever 'Release' says: what "
              "it bore there shakes it, or goes to its other blocks. Excavate "
              "before the stage that places the liner, or line only what "
              "stays.");
  }

  template <int dim>
  void BlockStage<dim>::end()
  {
    finish();
    system.solver->check_finite(state);
    check_cells(*system.model, state, stage.loads);
    follow_joint_motion();
    warn_of_joint_motion();
    warn_of_unstable_beams();
    warn_of_beam_forces();
    warn_of_lost_bond();
    if (const std::string what = context.loads[index].warning(); !what.empty())
      log.warning("stage ", stage.name, ": ", what);
    context.note_rounding();
    warn_of_damping();
    warn_of_control();
    keep_unreleased_forces();
    note_outcome();
    outputs.end_stage(state);
    ++state.stage;
    outputs.write_fields(state);
  }

  template <int dim>
  void BlockStage<dim>::warn_of_lost_bond() const
  {
    /** Share of the points with a bond that may lose it without a word. */
    constexpr double most = 0.01;
    // Later stages may excavate or load on purpose what fails, as the first one
    // under initial stress.
    if (!system.explicit_solver || index > 0
        || stage.end != StageEnd::static_ratio
        || !system.model->parameters().initial_stresses.empty())
      return;
    const auto [lost, all] = n_without_bond(
        system.model->joints(), state.template get<JointHistoryOf<dim>>(),
        context.run.communicator);
    if (lost > most * all)
      log.warning(
          "stage ", stage.name, ": ", lost, " of ", all,
          " points of joints with cohesion have lost it, although they "
          "would bear the tractions at the end of the stage with it: "
          "they opened or slipped while the loads came on. Cohesion "
          "without 'Tensile strength' is lost as soon as a joint opens. "
          "Give them a small one, begin with a load of the type "
          "'initial stress', or take 'Solver = implicit', and compare.");
  }

  template <int dim>
  void BlockStage<dim>::warn_of_control() const
  {
    /** Largest distance from the control function at the end of a stage, by its
        largest value. */
    constexpr double largest    = 0.05;
    const auto &pattern         = system.solver->stage_loads().pattern;
    const LoadPatternState &own = state.template get<LoadPatternState>();
    if (!pattern || !system.explicit_solver)
      return;
    const double moved = pattern->displacement(state.nodes) - own.start;
    const double lag   = pattern->target(state.load_time) - moved;
    if (std::abs(lag) > largest * pattern->largest_target())
      log.warning(
          "stage ", stage.name, ": the displacement '",
          stage.pattern->controlled, "' is ", moved, " m at the end, ", lag,
          " m away from the 'Control function'. The load factor belongs to the "
          "actual motion; to follow the function closely take a longer "
          "'Duration', more damping, or 'Controlled displacement = mean'.");
  }

  template <int dim>
  void BlockStage<dim>::before_row()
  {
    outputs.before_row(state);
    load_time = state.load_time;
    is_first  = state.stage_step == 0;
    if (const auto &pattern = system.solver->stage_loads().pattern)
      controlled = pattern->displacement(state.nodes)
                   - state.template get<LoadPatternState>().start;
  }

  template <int dim>
  void BlockStage<dim>::record_loads(const double time)
  {
    // The forces of an explicit stage's first step are an impact if a load
    // jumps there.
    if (is_first && system.explicit_solver)
      return;
    LoadRecord &record           = context.loads[index];
    const StageLoads<dim> &loads = system.solver->stage_loads();
    for (const MotionConstraint<dim> *platen : loads.constraints)
      if (const RigidMotion<dim> *body = platen->rigid_motion();
          body && body->bears())
      {
        std::vector<dealii::Point<dim>> places;
        for (const unsigned int node : platen->nodes())
          places.push_back(state.nodes[node].position());
        record.add_bearing(platen->name(),
                           platen_bearing(body->normals(state),
                                          system.solver->node_forces(*platen),
                                          places, context.run.communicator),
                           time);
      }
    if (loads.pattern)
    {
      const double factor = state.template get<LoadPatternState>().factor;
      record.add_factor(factor, controlled, time);
      if (system.explicit_solver)
        record.add_work(factor, loads.pattern->unit_work(state.nodes),
                        system.solver->energies().damping,
                        system.solver->energies().kinetic);
    }
    // In equilibrium supports take all. While loads of a stage that ends at
    // rest grow they are none that the model has to bear.
    if (stage.is_dynamic() || !system.explicit_solver
        || loads.constraints.empty()
        || (stage.end == StageEnd::static_ratio && load_time < loads.growth()))
      return;
    record.add_forces(force_balance(system, state, load_time), time,
                      stage.end == StageEnd::time);
  }

  template <int dim>
  void BlockStage<dim>::write_row()
  {
    std::vector<double> row = outputs.write_row(state);
    record_loads(row.front());
    if (stage.damping == DampingType::local && !stage.slows_loads()
        && system.explicit_solver)
    {
      const Energies &energies = system.solver->energies();
      context.damping_shares[index].add_row(energies.kinetic
                                            / energies.throughput());
    }
    if (conditions.empty() || is_to_end())
      return;
    // One rank decides for all, whatever their sums are rounded to.
    MPI_Bcast(row.data(), int(row.size()), MPI_DOUBLE, 0,
              context.run.communicator);
    const std::size_t met = conditions.find_met(row, context.peaks);
    if (met == stage.end_conditions.size())
      return;
    const EndCondition &condition = stage.end_conditions[met];
    context.outcomes[index]
        = { condition.outcome, condition.expression, row.front(), state.step };
  }

  template <int dim>
  void BlockStage<dim>::fail(const std::string &why)
  {
    context.failure = why;
    outputs.write_fields(state);
    throw FailedStep("stage '" + stage.name + "': " + why);
  }

  template <int dim>
  void BlockStage<dim>::keep_unreleased_forces()
  {
    if (context.outcomes[index].condition.empty())
      return;
    const double share
        = system.solver->stage_loads().release.share(state.load_time);
    for (HeldForces<dim> &item :
         state.template get<ConstructionState<dim>>().held)
      item.left_at_end += (1. - share) * (item.left - item.left_at_end);
  }

  template <int dim>
  void BlockStage<dim>::note_outcome()
  {
    context.peaks.clear();
    context.joint_motion = {};
    StageOutcome &ended  = context.outcomes[index];
    if (ended.outcome.empty())
      ended = { stage.safety                  ? "factor of safety"
                : stage.end == StageEnd::time ? "time over"
                                              : "at rest",
                "", state.time, state.step };
    log.message("stage ", stage.name, ": ", ended.outcome,
                ended.condition.empty()
                    ? ""
                    : ", condition '" + ended.condition + "' met",
                " at time ", ended.time, " s, step ", ended.step);
  }

  template <int dim>
  void BlockStage<dim>::follow_joint_motion()
  {
    /** Turn of blocks at which small displacements tell nothing [rad]. */
    constexpr double absurd = dealii::numbers::PI / 4.;
    if (system.model->parameters().large_displacements)
      return;
    const JointMotion now = joint_motion(*system.model, state);
    context.joint_motion.take_larger(now);
    const double diagonal = system.nodes->table().diagonal();
    if (now.turn <= absurd && now.distance <= diagonal)
      return;
    const std::string cure = cure_of_small_displacements(system);
    fail(text_of(
        now.turn > absurd
            ? text_of("blocks that share a joint have turned by ",
                      degrees(now.turn), " degrees against each other")
            : text_of("joints have moved apart by ", now.distance,
                      " m, more than the diagonal of the model, ", diagonal,
                      " m"),
        ", found at time ", state.time, " s, step ", state.step,
        ": small displacements leave blocks where they are, so that nothing "
        "after the first degrees means anything. ",
        cure.empty() ? "End " : cure + ", or end ",
        "the stage before by 'End conditions'."));
  }

  template <int dim>
  void BlockStage<dim>::warn_of_joint_motion() const
  {
    /** Slip by face length at which half of the edges still overlap [-]. */
    constexpr double most_slip = 0.5;
    /** Turn of blocks, five degrees, which changes lever arms by a tenth of
        those of a column ten times as high as wide [rad]. */
    constexpr double most_turn = 5. * dealii::numbers::PI / 180.;
    const JointMotion &motion  = context.joint_motion;
    std::string cure           = cure_of_small_displacements(system);
    if (cure.empty())
      cure = "End the stage before by 'End conditions'";
    if (motion.slip > most_slip)
      log.warning(
          "stage ", stage.name, ": joints have slipped by up to ",
          100. * motion.slip,
          " % of the edges that touch, but small displacements leave "
          "blocks where they are: areas and neighbours no longer hold. ",
          cure, ".");
    if (motion.turn > most_turn)
      log.warning("stage ", stage.name,
                  ": blocks that share a joint have "
                  "turned by up to ",
                  degrees(motion.turn),
                  " degrees against each other, but small displacements leave "
                  "blocks where they are: lever arms and contacts no longer "
                  "hold. ",
                  cure, ".");
  }

  template <int dim>
  void BlockStage<dim>::warn_of_unstable_beams() const
  {
    if constexpr (dim == 2)
      if (const Beams *beams = system.solver->loads().beams.get();
          beams && (system.implicit_solver || stage.end != StageEnd::time))
        for (const std::string &name : beams->unstable(state))
          log.warning("stage ", stage.name, ": the beam '", name,
                      "' is at the end of the stage in an equilibrium that is "
                      "unstable: it will buckle once anything disturbs it. "
                      "Give it an imperfection, 'Points' that are bent by some "
                      "thousandths of its length or a small 'Line load', to "
                      "see how much it bears.");
  }

  template <int dim>
  void BlockStage<dim>::warn_of_beam_forces() const
  {
    if constexpr (dim == 2)
      if (const Beams *beams = system.solver->loads().beams.get())
        for (std::size_t b = 0; b < beams->all().size(); ++b)
        {
          const Beam &beam = beams->all()[b];
          if (!state.template get<BeamState>().placed[b])
            continue;
          const BeamFields fields = beam_fields(beam, state);
          for (const std::string &what : { overstress_text(beam.line, fields),
                                           chord_text(beam.line, fields) })
            if (!what.empty())
              log.warning("stage ", stage.name, ": ", what);
        }
  }

  template <int dim>
  void BlockStage<dim>::warn_of_damping() const
  {
    const LocalDampingShare &share = context.damping_shares[index];
    if (stage.end == StageEnd::time && share.is_large())
      log.warning("stage ", stage.name, ": local damping opposed ",
                  100. * share.sum / double(share.n),
                  " % of the applied forces on average, and more than ",
                  100. * LocalDampingShare::large, " % during ",
                  100. * double(share.n_large) / double(share.n),
                  " % of the stage. It resists steady motion: reactions may be "
                  "wrong by several times that fraction, and a collapse may "
                  "come too early or too late. Take 'Damping = adaptive', or "
                  "'Rayleigh' with a stiffness coefficient.");
    else if (stage.end == StageEnd::time && share.is_of_motion())
      log.warning("stage ", stage.name, ": more than ",
                  100. * LocalDampingShare::moving,
                  " % of the energy throughput was kinetic in ",
                  100. * double(share.n_moving) / double(share.n_rows),
                  " % of the rows of histories: blocks that fall, fly or rock "
                  "do so with ",
                  1. - stage.local_coefficient,
                  " of their acceleration under local damping. Take 'Damping = "
                  "none' with a 'Restitution' of joints, or 'Rayleigh' with a "
                  "stiffness coefficient.");
  }

  template <int dim>
  ProgressFigures BlockStage<dim>::figures_at(const double fraction) const
  {
    ProgressFigures figures;
    figures.stage    = stage.name;
    figures.time     = state.time;
    figures.step     = state.step;
    figures.fraction = fraction;
    if (const ExplicitSolver<dim> *solver = system.explicit_solver)
      figures.share_of_critical
          = solver->get_time_step() / solver->critical_step().length;
    figures.unbalanced_ratio = state.unbalanced_ratio;
    figures.energy_residual  = context.energy_residual();
    return figures;
  }

  template <int dim>
  double BlockStage<dim>::load_share() const
  {
    return state.template get<ImplicitState>().released < 1.
               ? 0.
               : state.load_time / system.implicit_solver->steps().duration();
  }

  template <int dim>
  bool BlockStage<dim>::has_settled() const
  {
    constexpr auto interval = ExplicitSolver<dim>::balance_interval;
    return state.time - state.stage_start >= stage.minimum_duration
           && state.stage_step > interval
           && state.unbalanced_ratio <= stage.static_ratio
           && !system.solver->stage_loads().change(
               state, interval, system.explicit_solver->get_time_step());
  }

  template struct BlockContext<2>;
  template struct BlockContext<3>;
  template class BlockStage<2>;
  template class BlockStage<3>;
} // namespace quoin
