// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/contact_advice.h>
#include <quoin/advice/joint_advice.h>
#include <quoin/advice/load_advice.h>
#include <quoin/advice/model_summary.h>
#include <quoin/advice/sequence_advice.h>
#include <quoin/advice/signal_advice.h>
#include <quoin/advice/support_advice.h>
#include <quoin/base/known_names.h>
#include <quoin/parameters/plausibility.h>
#include <quoin/signals/time_function.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** In whole percent. */
    double percent(const double share)
    {
      return std::round(100. * share);
    }

    template <int dim>
    void check_ranks(const MeshReport &report, const NodeMap<dim> &nodes,
                     Advice &advice)
    {
      namespace MPI = dealii::Utilities::MPI;
      Checks(advice, "")
          .warn_if(MPI::min(nodes.cells().size(), nodes.communicator()) == 0,
                   "the model has ", count_text(report.n_blocks, "block"),
                   " and the run ", MPI::n_mpi_processes(nodes.communicator()),
                   " MPI processes, of which some have no part of the model, "
                   "because a rigid block is never divided. Fewer processes "
                   "would be as fast, except for boundary elements, whose work "
                   "all processes share.");
    }

    /** Warns of cells so low that they alone make steps short; those of rigid
        blocks do not. */
    void check_slivers(const Parameters &parameters, const MeshReport &report,
                       Advice &advice)
    {
      const auto &materials  = parameters.model.materials;
      const std::string text = report.sliver_text();
      Checks(advice, "")
          .warn_if(!text.empty()
                       && std::any_of(materials.begin(), materials.end(),
                                      [](const MaterialParameters &material)
                                      { return !material.rigid; }),
                   text);
    }

    /** Whether @p component is a force that is not zero for ever. */
    bool acts(const LoadComponent &component)
    {
      return component.quantity == LoadQuantity::force
             && (component.field || !component.value.is_constant()
                 || component.value({ 0., 0. }) != 0.);
    }

    /** Whether @p load is a force across the thickness of @p block, of the
        group @p group. */
    template <int dim>
    bool bends(const LoadParameters &load, const SlenderBlock &block,
               const std::string &group)
    {
      /** Cosine to the thickness, below which a force is along the block. */
      constexpr double least = 0.1;
      const auto components  = load.along_axes<dim>().components;
      bool is_across         = false;
      for (unsigned int d = 0; d < dim; ++d)
        is_across = is_across
                    || (acts(components[d]) && std::abs(block.axis[d]) > least);
      if (load.type == LoadType::gravity)
        return is_across
               && (load.groups.empty() || is_among(group, load.groups));
      return load.type == LoadType::traction
             && (is_across || acts(load.pressure))
             && std::any_of(load.boundaries.begin(), load.boundaries.end(),
                            [&](const std::string &name)
                            { return block.outer.count(name) > 0; });
    }

    /** Whether joints or loads hold @p block, of the group @p group, along its
        faces. */
    bool is_bedded(const SlenderBlock &block, const std::string &group,
                   const std::vector<LoadParameters> &loads)
    {
      /** Part of the faces that is free, where the block is not bedded. */
      constexpr double most_free = 0.75;
      double free                = 0.;
      const auto holds
          = [&](const LoadParameters &load, const std::string &name)
      {
        return load.type != LoadType::traction && load.type != LoadType::gravity
               && load.type != LoadType::initial_stress
               && (is_among(name, load.boundaries)
                   || is_among(group, load.groups));
      };
      for (const auto &[name, size] : block.outer)
        if (std::none_of(loads.begin(), loads.end(),
                         [&, &name = name](const LoadParameters &load)
                         { return holds(load, name); }))
          free += size;
      return free < most_free * block.faces;
    }

    /** Warns of blocks that loads bend, with few cells across. */
    template <int dim>
    void check_bending(const Parameters &parameters, const MeshReport &report,
                       const Model<dim> &model, Advice &advice)
    {
      const auto &names         = model.nodes().table().group_names;
      const SlenderBlock *worst = nullptr;
      unsigned int n            = 0;
      for (const SlenderBlock *block : coarse_slender_blocks(
               parameters, report, model.properties().material_of_group))
      {
        const std::string &group = names[block->group];
        if (is_bedded(*block, group, parameters.loads)
            || std::none_of(parameters.loads.begin(), parameters.loads.end(),
                            [&](const LoadParameters &load)
                            { return bends<dim>(load, *block, group); }))
          continue;
        ++n;
        if (!worst || block->n_across < worst->n_across)
          worst = block;
      }
      if (!worst)
        return;
      const char *const cells = dim == 2 ? "triangles" : "tetrahedra";
      Checks(advice, "")
          .warn_if(true, count_text(n, "slender block"), ", of '",
                   names[worst->group], "' at ", report.position(worst->middle),
                   " m", n > 1 ? " and others" : "", ", ", worst->thickness,
                   " m thick and ", worst->length, " m long, ",
                   n == 1 ? "has" : "have", " about ",
                   0.1 * std::round(10. * worst->n_across), " linear ", cells,
                   " across, and loads bend it freely: it would bend up to ",
                   percent(worst->lost_deflection(dim)),
                   " % less than it should. Four across lose up to ",
                   dim == 2 ? "14" : "24", " %; or take ",
                   dim == 3 ? "'Tetrahedra = mixed'"
                   : parameters.is_implicit
                       ? "'Triangles = quadratic', which bend as they should"
                       : "'Triangles = crossed', which lose a third of that",
                   ".");
    }

    /** Warns of joints that the initial stress takes beyond their strength. */
    template <int dim>
    void check_initial_joints(const Parameters &parameters,
                              const Model<dim> &model, const State<dim> &state,
                              Advice &advice)
    {
      if (parameters.model.initial_stresses.empty())
        return;
      const NodeMap<dim> &nodes = model.nodes();
      const double n            = n_beyond_strength(
                     model.joints(), state.template get<JointHistoryOf<dim>>(),
                     nodes.communicator());
      Checks(advice, "")
          .warn_if(n > 0., n, " of ", dim * nodes.faces().n_global_joints,
                   " joint points begin with tractions beyond their strength: "
                   "they yield in the first stage. Check the initial stress "
                   "and the strength of these joints.");
    }

    /** Warns of edges that touch without a joint, in which the initial stress
        would have its traction. */
    void check_initial_contacts(const Parameters &parameters,
                                const MeshReport &report, Advice &advice)
    {
      Checks(advice, "")
          .warn_if(!parameters.model.initial_stresses.empty()
                       && report.unmatched_touch && report.unmatched_size > 0.,
                   "outer edges lie on each other over ", report.unmatched_size,
                   " m without matching nodes, the first near ",
                   report.position(report.unmatched_position),
                   " m: contacts there begin without traction, so that the "
                   "initial stress goes from the blocks beside them as they "
                   "close. Mesh both sides alike, and a joint that has the "
                   "stress from the start is made there.");
    }

    double largest(const YieldFunctions &value)
    {
      return std::max(value.shear, value.tension);
    }

    /** Warns of cells that the initial stress takes beyond their strength,
        unless the first stage raises that. */
    template <int dim>
    void check_initial_cells(const Parameters &parameters,
                             const Model<dim> &model, const State<dim> &state,
                             Advice &advice)
    {
      /** By the largest component, up to which a stress may be beyond. */
      constexpr double rounding = 1e-6;
      if (parameters.model.initial_stresses.empty())
        return;
      const BlockForcesData<dim> &cells = model.blocks().cell_data();
      std::vector<double> n             = { 0., 0. }; // beyond, of all
      for (unsigned int c = 0; c < cells.cells.size(); ++c)
      {
        const auto *law = cells.law_of(c);
        // Blocks that are placed later come free of stress.
        if (!law
            || state.is_absent(model.nodes().block_of_node(cells.cells[c][0])))
          continue;
        const auto stress = cells.initial_stress_of(c);
        double size       = 0.;
        for (const double part : stress)
          size = std::max(size, std::abs(part));
        n[0] += largest(law->yield_functions(stress)) > rounding * size;
        ++n[1];
      }
      dealii::Utilities::MPI::sum(n, model.nodes().communicator(), n);
      Checks(advice, "")
          .warn_if(n[0] > 0. && parameters.stages.front().strength_factor <= 1.,
                   n[0], " of ", n[1],
                   " cells of materials that yield begin with stresses beyond "
                   "their strength: they yield in the first step, and the "
                   "stress that was given is not that of the ground. Check the "
                   "initial stress and the strength of these materials.");
    }

    /** Largest acceleration of a load of gravity along an axis [m/s^2]; where
        its function of time is not constant, at the start and at the end of the
        run, or in the end if it comes to a limit. */
    double largest_gravity(const Parameters &parameters)
    {
      double end = 0.;
      for (const StageParameters &stage : parameters.stages)
        end += stage.end == StageEnd::time ? stage.duration : 0.;
      double largest = 0.;
      for (const LoadParameters &load : parameters.loads)
        if (load.type == LoadType::gravity)
          for (const auto &given : load.given_components())
          {
            const auto at = [&](const double t) {
              return std::abs(given.component.value({ t, t }));
            };
            largest = std::max({ largest, at(0.), at(end) });
            if (at(late_time) == at(0.5 * late_time))
              largest = std::max(largest, at(late_time));
          }
      return std::isfinite(largest) ? largest : 0.;
    }

    void check_laws(const Parameters &parameters, Advice &advice)
    {
      for (const JointSetParameters &set : parameters.model.joints)
      {
        const std::string warning = law_warning(set.law);
        Checks(advice, "section 'Joints/" + set.name + "': ")
            .warn_if(!warning.empty(), warning);
      }
    }

    /** Signs and units of the initial stress of deformable blocks. */
    template <int dim>
    void check_initial_stress(const Model<dim> &model, Advice &advice)
    {
      /** The largest normal stress below which MPa may have been meant [Pa]. */
      constexpr double few_pascals      = 1e3;
      const BlockForcesData<dim> &cells = model.blocks().cell_data();
      std::vector<double> largest       = { 0., 0. }; // tension, magnitude
      for (unsigned int c = 0; c < cells.cells.size(); ++c)
      {
        // Not that out of the plane.
        const auto stress = cells.initial_stress_of(c);
        for (unsigned int k = 0; k < dim; ++k)
          largest[0] = std::max(largest[0], stress[k]);
        for (unsigned int k = 0; k < dim * (dim + 1) / 2; ++k)
          largest[1] = std::max(largest[1], std::abs(stress[k]));
      }
      dealii::Utilities::MPI::max(largest, model.nodes().communicator(),
                                  largest);
      Checks checks(advice, "initial stress: ");
      checks.warn_if(largest[0] > 0.01 * largest[1],
                     "blocks are in tension of up to ", largest[0],
                     " Pa. Tension is positive: compressive stresses are "
                     "negative numbers.");
      checks.warn_if(largest[1] > 0. && largest[1] < few_pascals,
                     "it is nowhere larger than ", largest[1],
                     " Pa. Stresses are in Pa: -8e6, not -8, for 8 MPa of "
                     "compression.");
    }

    /** Warns of stages without gravity that follow one with it. */
    void check_weight(const Parameters &parameters, Advice &advice)
    {
      const auto has_weight = [&](const StageParameters &stage)
      {
        return std::any_of(parameters.loads.begin(), parameters.loads.end(),
                           [&](const LoadParameters &load) {
                             return load.type == LoadType::gravity
                                    && names_load(stage, load.name);
                           });
      };
      for (unsigned int i = 0; i < parameters.stages.size(); ++i)
      {
        const StageParameters &stage  = parameters.stages[i];
        const StageParameters *before = previous_stage(parameters.stages, i);
        if (before && has_weight(*before) && !has_weight(stage))
          Checks(advice, "stage " + stage.name + ": ")
              .warn_if(true, "its 'Loads' name no gravity, but stage ",
                       before->name,
                       " had some: the model becomes weightless at once. Name "
                       "the load here, too, if that is not meant.");
      }
    }

    /** Warns of platens that nothing drives, holds or loads. */
    void check_free_platens(const Parameters &parameters, Advice &advice)
    {
      for (const LoadParameters &load : parameters.loads)
        Checks(advice, "load " + load.name + ": ")
            .warn_if(load.type == LoadType::platen
                         && load.given_components().empty(),
                     "its platen is free in all directions, and no force acts "
                     "on it: it keeps its nodes on one rigid body and does "
                     "nothing else. Give a motion or a force, such as "
                     "'Vertical = force -1e5', if that is not meant.");
    }

    /** Whether @p component is a motion or a force that is not zero for ever.
     */
    bool drives(const LoadComponent &component)
    {
      return component.quantity != LoadQuantity::free
             && (component.field || !component.value.is_constant()
                 || component.value({ 0., 0. }) != 0.);
    }

    /** Warns of a model in which all is at rest for ever. */
    void check_driven(const Parameters &parameters, Advice &advice)
    {
      const auto load_drives = [&](const LoadParameters &load)
      {
        const auto given = load.given_components();
        return std::any_of(
                   parameters.stages.begin(), parameters.stages.end(),
                   [&](const StageParameters &stage)
                   {
                     return names_load(stage, load.name)
                            || (stage.pattern
                                && is_among(load.name, stage.pattern->loads));
                   })
               && std::any_of(given.begin(), given.end(),
                              [](const auto &each)
                              { return drives(each.component); });
      };
      const auto beam_drives = [](const BeamParameters &beam)
      {
        const auto is_force = [](const TimeFunction &part) {
          return !part.is_constant() || part({ 0., 0. }) != 0.;
        };
        return std::any_of(beam.distributed.begin(), beam.distributed.end(),
                           is_force)
               || std::any_of(
                   beam.forces.begin(), beam.forces.end(),
                   [&](const auto &end)
                   { return std::any_of(end.begin(), end.end(), is_force); });
      };
      const auto boundary_drives = [](const BoundaryCurveParameters &curve)
      {
        const auto is_given = [](const SpaceTimeFunction &value)
        {
          return value.depends_on_place() || value.depends_on_time()
                 || value(dealii::Point<2>(), 0.) != 0.;
        };
        return std::any_of(curve.value.begin(), curve.value.end(), is_given)
               || is_given(curve.pressure);
      };
      const auto &curves = parameters.boundary.boundaries;
      const auto &loads  = parameters.loads;
      const auto &beams  = parameters.beams;
      const auto &cables = parameters.model.cables;
      const auto &named  = parameters.named_blocks;
      const bool is_driven
          = !parameters.model.initial_stresses.empty()
            || parameters.initial_motion.is_given()
            || !parameters.boundary.waves.empty()
            || parameters.water.flow != FlowKind::none
            || std::any_of(curves.begin(), curves.end(), boundary_drives)
            || std::any_of(loads.begin(), loads.end(), load_drives)
            || std::any_of(beams.begin(), beams.end(), beam_drives)
            || std::any_of(cables.begin(), cables.end(),
                           [](const CableParameters &cable)
                           { return cable.pretension != 0.; })
            || std::any_of(named.begin(), named.end(),
                           [](const NamedBlock &block)
                           { return block.moves(); });
      Checks(advice, "")
          .warn_if(!is_driven,
                   "nothing moves this model: no stage names a load that is a "
                   "force or a motion, and there is no initial stress, motion, "
                   "wave or water. Name loads in 'Loads' of the stages.");
    }

    /** Whether a stage or what is beyond a boundary takes @p material. */
    bool is_for_later(const MaterialParameters &material,
                      const Parameters &parameters)
    {
      const auto is_given
          = [&](const auto &pair) { return pair.second == material.name; };
      return parameters.boundary.material == material.name
             || std::any_of(parameters.loads.begin(), parameters.loads.end(),
                            [&](const LoadParameters &load)
                            { return load.far_material == material.name; })
             || std::any_of(parameters.stages.begin(), parameters.stages.end(),
                            [&](const StageParameters &stage)
                            {
                              return std::any_of(stage.materials.begin(),
                                                 stage.materials.end(),
                                                 is_given);
                            });
    }

    /** Warns of support pressure of excavated blocks that is left in the end.
     */
    void check_release(const std::vector<StageParameters> &stages,
                       Advice &advice)
    {
      const StageParameters *last = nullptr;
      for (const StageParameters &stage : stages)
        if (!stage.safety)
          last = &stage;
      if (last)
        Checks(advice, "stage " + last->name + ": ")
            .warn_if(last->release < 1. && last->end_conditions.empty(),
                     100. * (1. - last->release),
                     " % of the forces of excavated blocks are never released, "
                     "as its 'Release = ",
                     last->release,
                     "' is the last one. Give 1 in the end, "
                     "unless a support that is not modelled bears the rest.");
    }

    /** Warns of searches whose trials cannot fail, as in mm they would. @p size
        of the model [m]. */
    void check_failure_displacement(const std::vector<StageParameters> &stages,
                                    const double size, Advice &advice)
    {
      for (const StageParameters &stage : stages)
        if (stage.safety)
          Checks(advice, "stage " + stage.name + ": ")
              .warn_if(stage.safety->failure_displacement > size,
                       "'Failure displacement = ",
                       stage.safety->failure_displacement,
                       "' m is farther than the model is long, ", size,
                       " m: blocks that fall come to rest or leave the model "
                       "before a trial fails. If it is in mm, give ",
                       1e-3 * stage.safety->failure_displacement, " m.");
    }

    template <int dim>
    void check_materials(const Parameters &parameters, const Model<dim> &model,
                         Advice &advice)
    {
      /** Poisson's ratio above which constant-strain triangles in plane strain
          and tetrahedra lock. */
      constexpr double locking_poisson = 0.45;
      const bool can_lock
          = parameters.cells.kind == TriangleKind::plain
            && !parameters.cells.mixed_tetrahedra
            && parameters.model.plane == PlaneAssumption::plane_strain;
      std::vector<unsigned int> is_used(parameters.model.materials.size(), 0);
      for (unsigned int c = 0; c < model.nodes().cells().size(); ++c)
        is_used[material_of_cell(model, c)] = 1;
      dealii::Utilities::MPI::max(is_used, model.nodes().communicator(),
                                  is_used);
      for (unsigned int m = 0; m < is_used.size(); ++m)
      {
        const MaterialParameters &material = parameters.model.materials[m];
        Checks checks(advice, "material " + material.name + ": ");
        checks.warn_if(!is_used[m] && !is_for_later(material, parameters),
                       "it is that of no block, and no stage gives it to one "
                       "by its 'Materials'. Name it there or in 'Groups', or "
                       "remove it from 'Names'.");
        checks.warn_if(can_lock && is_used[m] && !material.rigid
                           && material.elastic.poisson > locking_poisson,
                       "with Poisson's ratio ", material.elastic.poisson,
                       dim == 2
                           ? " plain triangles lock in plane strain, they "
                             "are too stiff. Take 'Triangles = crossed' in "
                             "section 'Mesh'."
                           : " plain tetrahedra lock, they are too stiff. "
                             "Take 'Tetrahedra = mixed' in section "
                             "'Mesh'.");
      }
    }

    void check_output(const Parameters &parameters, Advice &advice)
    {
      /** Number of output times above which a warning is given. */
      constexpr double many = 5000.;
      const double duration
          = start_of_stage(parameters.stages, parameters.stages.size());
      const double n = duration / parameters.field_interval;
      Checks(advice, "'Field interval = ")
          .warn_if(parameters.field_interval > 0. && n > many,
                   parameters.field_interval,
                   "' in section 'Output' writes fields ",
                   std::uint64_t(std::min(n, 1e18)),
                   " times. Some hundred make a film: take ", duration / 200.,
                   " s.");
    }
  } // namespace

  template <int dim>
  Advice model_advice(const Parameters &parameters, const MeshReport &report,
                      const Model<dim> &model, const State<dim> &state)
  {
    Advice advice = report.warnings();
    check_ranks(report, model.nodes(), advice);
    check_laws(parameters, advice);
    check_slivers(parameters, report, advice);
    check_bending(parameters, report, model, advice);
    if constexpr (dim == 2)
    {
      check_bars(model, advice);
      check_water(parameters, model.nodes(), advice);
    }
    check_initial_joints(parameters, model, state, advice);
    check_initial_contacts(parameters, report, advice);
    check_initial_cells(parameters, model, state, advice);
    check_initial_stress(model, advice);
    check_stress_at_rest(parameters, model, state, advice);
    check_forgotten_loads(parameters, advice);
    check_weight(parameters, advice);
    check_ended_loads(parameters, model.nodes(), advice);
    check_late_supports(parameters, advice);
    check_free_platens(parameters, advice);
    check_driven(parameters, advice);
    check_release(parameters.stages, advice);
    check_failure_displacement(parameters.stages,
                               model.nodes().table().diagonal(), advice);
    check_pressures(parameters, model.nodes(), advice);
    check_signals(parameters, dim, advice);
    check_materials(parameters, model, advice);
    check_joints(parameters, model, advice);
    if (!parameters.is_implicit)
      check_contacts(model, advice);
    if constexpr (dim == 2)
      check_rigid_blocks(model, largest_gravity(parameters), advice);
    check_output(parameters, advice);
    return advice;
  }

  template Advice model_advice(const Parameters &, const MeshReport &,
                               const Model<2> &, const State<2> &);
  template Advice model_advice(const Parameters &, const MeshReport &,
                               const Model<3> &, const State<3> &);
} // namespace quoin
