// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/model_parameters.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/named_sections.h>
#include <quoin/dynamics/construction.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Whether something takes the motion away that an explicit stage has. */
    bool comes_to_rest(const StageParameters &stage,
                       const std::vector<LoadParameters> &loads)
    {
      if (stage.damping == DampingType::rayleigh)
        return stage.mass_coefficient + stage.stiffness_coefficient > 0.;
      return stage.damping != DampingType::none
             || std::any_of(loads.begin(), loads.end(),
                            [&](const LoadParameters &load)
                            {
                              return (load.type == LoadType::viscous_boundary
                                      || load.type == LoadType::free_field)
                                     && names_load(stage, load.name);
                            });
    }

    /** What one stage says that cannot have an effect. */
    void check_stage(const ParameterSection &section,
                     const StageParameters &stage, const Parameters &parameters,
                     const bool has_excavated)
    {
      if (stage.end == StageEnd::static_ratio && !parameters.is_implicit
          && !comes_to_rest(stage, parameters.loads))
        section.fail("Damping", "leaves all motion in the model, which so "
                                "never comes to the rest that 'End = "
                                    + section.text("End")
                                    + "' waits for. Take 'local' or "
                                      "'adaptive'.");
      if (has_excavated)
        return;
      const std::string why
          = "has no effect: neither this stage nor one before it has an "
            "'Excavate'. Name what is excavated, or remove this.";
      if (stage.release != 1.)
        section.fail("Release", why);
      if (stage.release_duration >= 0.)
        section.fail("Release duration", why);
      if (stage.releases_linearly)
        section.fail("Release ramp", why);
    }

    void read_stages(const ParameterSection &top, Parameters &parameters)
    {
      parameters.stages = read_named<StageParameters>(top, "Stages");
      const ParameterSection section(top, "Stages");
      if (parameters.stages.empty())
        section.fail("Names", "must list at least one stage.");
      if (parameters.stages.front().safety)
        ParameterSection(section, parameters.stages.front().name)
            .fail("End", "needs a stage before it that brings the model to "
                         "rest: a factor of safety begins with its state.");
      double end = 0.; // of the stage before; NaN: known only as it runs
      bool has_excavated = false;
      for (const StageParameters &stage : parameters.stages)
      {
        const ParameterSection subsection(section, stage.name);
        has_excavated = has_excavated || !stage.excavate.empty();
        check_stage(subsection, stage, parameters, has_excavated);
        if (stage.start_time >= 0.)
        {
          std::ostringstream why;
          if (std::isnan(end))
            subsection.fail("Start time",
                            "cannot be kept, because the stage before "
                            "ends when it has settled. Use 'previous "
                            "end'.");
          why << "but the stage before ends at " << end << " s: stages "
              << (stage.start_time < end ? "overlap" : "leave a gap")
              << ". Use 'previous end' or change the durations.";
          if (std::abs(stage.start_time - end) > 1e-9 * (1. + end))
            subsection.fail("Start time", why.str());
        }
        end = stage.end == StageEnd::time
                  ? end + stage.duration
                  : std::numeric_limits<double>::quiet_NaN();
      }
    }

    void check_loads(const Parameters &parameters)
    {
      std::set<std::string> names, used;
      for (const LoadParameters &load : parameters.loads)
        names.insert(load.name);
      for (const StageParameters &stage : parameters.stages)
        for (const std::string &load : stage.loads)
        {
          if (names.count(load) == 0)
            throw InputError(parameters.file + ", section 'Stages/" + stage.name
                             + "': 'Loads' names '" + load
                             + "', which is no load. Loads are: "
                             + known_names(names) + ".");
          used.insert(load);
          if (std::count(stage.loads.begin(), stage.loads.end(), load) > 1)
            throw InputError(parameters.file + ", section 'Stages/" + stage.name
                             + "': 'Loads' names '" + load
                             + "' twice, but it acts once. Remove one, or "
                               "give the load another value.");
        }
      for (const LoadParameters &load : parameters.loads)
        for (const StageParameters &stage : parameters.stages)
          if (load.type == LoadType::initial_stress
              && names_load(stage, load.name))
            throw InputError(parameters.file + ", section 'Stages/" + stage.name
                             + "': 'Loads' names '" + load.name
                             + "', an initial stress, which acts from the "
                               "start and does not end. Leave it out there.");
      for (const LoadParameters &load : parameters.loads)
        if (load.type != LoadType::initial_stress && used.count(load.name) == 0)
          throw InputError(parameters.file + ", section 'Loads/" + load.name
                           + "': no stage uses this load. Name it in the "
                             "'Loads' of a stage or remove it.");
    }

    /** Boundary elements beyond the blocks. */
    void read_far_field(const ParameterSection &top, Parameters &parameters)
    {
      std::vector<const LoadParameters *> loads;
      for (const LoadParameters &load : parameters.loads)
        if (load.type == LoadType::boundary_elements)
          loads.push_back(&load);
      if (loads.empty())
      {
        for (const std::string name : { "Boundary elements", "Incident waves" })
          if (!ParameterSection(top, name).list("Names").empty())
            ParameterSection(top, name).fail(
                "Names", "has no meaning without a load of 'Type = "
                         "boundary elements', or 'Model = boundary "
                         "elements': add one, or remove the names.");
        return;
      }
      if (loads.size() > 1)
        ParameterSection(ParameterSection(top, "Loads"), loads[1]->name)
            .fail("Type", "is 'boundary elements', as that of '"
                              + loads[0]->name
                              + "' is: there can be one such load, with all "
                                "interfaces among the boundaries of section "
                                "'Boundary elements'.");
      if (parameters.model.plane != PlaneAssumption::plane_strain)
        top.fail("Plane assumption", "does not go with boundary elements: "
                                     "their kernels are those of plane "
                                     "strain.");
      read_boundary_elements(top, parameters, true);
      const auto &boundaries = parameters.boundary.boundaries;
      if (std::none_of(boundaries.begin(), boundaries.end(),
                       [](const BoundaryCurveParameters &curve)
                       { return curve.shape == BoundaryShape::interface; }))
        ParameterSection(top, "Boundary elements")
            .fail("Names", "has no boundary with 'Shape = interface': nothing "
                           "is coupled to the blocks.");
      if (parameters.boundary.sampled_field.has_box)
        ParameterSection(top, "Sampled field")
            .fail("Box", "needs 'Model = boundary elements': leave it empty.");
    }

    /** Histories of boundary elements: where they march beside blocks. */
    void check_coupled_histories(const ParameterSection &top,
                                 const Parameters &parameters)
    {
      const auto acts = [&](const LoadParameters &load)
      {
        return load.type == LoadType::boundary_elements
               && std::any_of(parameters.stages.begin(),
                              parameters.stages.end(),
                              [&](const StageParameters &stage) {
                                return stage.end == StageEnd::time
                                       && names_load(stage, load.name);
                              });
      };
      const ParameterSection section(top, "Histories");
      for (const HistoryParameters &history : parameters.histories)
      {
        if (!history.is_of_boundary())
          continue;
        const ParameterSection subsection(section, history.name);
        if (parameters.boundary.boundaries.empty())
          subsection.fail("Quantity",
                          "needs 'Model = boundary elements' or a load of "
                          "'Type = boundary elements'.");
        if (parameters.is_implicit
            || std::none_of(parameters.loads.begin(), parameters.loads.end(),
                            acts))
          subsection.fail("Quantity",
                          "is one of boundary elements in motion, but here "
                          "they are at rest: 'Solver' is implicit, or no "
                          "stage with 'End = time' names their load. Take "
                          "'displacement x', 'displacement y' or 'reaction' "
                          "of that load.");
      }
    }
  } // namespace

  void read_block_model(const ParameterSection &top, Parameters &parameters)
  {
    parameters.model.joints = read_named<JointSetParameters>(top, "Joints");
    parameters.model.contact
        = ContactParameters::read(ParameterSection(top, "Contact"));
    parameters.model.large_displacements
        = parameters.model.contact.large_displacements;
    for (const JointSetParameters &set : parameters.model.joints)
      if (const std::string why = no_contacts(set.law);
          !why.empty() && parameters.model.large_displacements)
        ParameterSection(ParameterSection(top, "Joints"), set.name)
            .fail("Law", "is for small displacements: contacts that go on "
                         "elsewhere "
                             + why
                             + ". Take 'Coulomb', or 'Displacements = small' "
                               "in section 'Contact'.");
    parameters.loads = read_named<LoadParameters>(top, "Loads");
    for (const LoadParameters &load : parameters.loads)
      if (load.type == LoadType::initial_stress)
        parameters.model.initial_stresses.push_back(load);
    read_far_field(top, parameters);
    parameters.initial_motion
        = InitialMotion::read(ParameterSection(top, "Initial motion"));
    read_stages(top, parameters);
    parameters.model.absent_groups = groups_placed_later(parameters.stages);
    check_loads(parameters);
    check_coupled_histories(top, parameters);
    parameters.implicit
        = ImplicitParameters::read(ParameterSection(top, "Implicit"));
    if (parameters.is_implicit && !parameters.boundary.waves.empty())
      ParameterSection(top, "Incident waves")
          .fail("Names", "needs motion, which 'Solver = implicit' leaves "
                         "out: remove the waves, or take 'explicit'.");
    if (parameters.is_implicit && parameters.initial_motion.is_given)
      top.fail("Solver", "leaves out inertia, but section 'Initial motion' "
                         "gives one: remove that, or take 'explicit'.");
  }
} // namespace quoin
