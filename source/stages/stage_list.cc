// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Checks of the stages of a run against each other and the loads.

#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/named_sections.h>
#include <quoin/base/number_text.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/stages/stage_parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    /** Whether something damps the motion of an explicit stage. */
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

    /** Refuses parameters of a stage that cannot have an effect. */
    void check_stage(const ParameterSection &section,
                     const StageParameters &stage, const bool comes_to_rest,
                     const bool has_excavated)
    {
      if (stage.end == StageEnd::static_ratio && !comes_to_rest)
        section.fail("Damping", "dissipates no energy, so that the model never "
                                "reaches the equilibrium that 'End = "
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
      if (stage.releases_linearly == true)
        section.fail("Release ramp", why);
    }

    /** Refuses a release of less than stages before have released already. Of
        one that a condition may end before that is not known. */
    void check_releases(const ParameterSection &section,
                        const std::vector<StageParameters> &stages)
    {
      double released = 0.; // since the last excavation
      std::string by;
      for (const StageParameters &stage : stages)
      {
        if (stage.safety)
          continue;
        if (!stage.excavate.empty())
          released = 0.;
        if (stage.release < released)
          ParameterSection(section, stage.name)
              .fail("Release",
                    text_of("is less than ", released,
                            ", the share that stage '", by,
                            "' has released: support pressure that has been "
                            "released does not come back. Give ",
                            released, " or more, or place blocks by 'Fill'."));
        if (stage.end_conditions.empty() && stage.release > released)
        {
          released = stage.release;
          by       = stage.name;
        }
      }
    }

    /** Checks the order and the times of stages. */
    void check_order(const ParameterSection &section,
                     const std::vector<StageParameters> &stages)
    {
      if (stages.front().safety)
        ParameterSection(section, stages.front().name)
            .fail("End",
                  "needs a stage before it that ends at equilibrium: the "
                  "search for the factor of safety starts from its state.");
      if (stages.front().reset.any())
        ParameterSection(section, stages.front().name)
            .fail("Reset", "has no effect in the first stage, from whose start "
                           "all results count. Give it to the stage whose "
                           "motion is to be seen, or remove it.");
      double end = 0.; // of the previous stage; NaN: known only as it runs
      for (const StageParameters &stage : stages)
      {
        const ParameterSection subsection(section, stage.name);
        if (stage.start_time >= 0.)
        {
          if (std::isnan(end))
            subsection.fail(
                "Start time",
                "cannot be kept, because the stage before ends at equilibrium "
                "or when a condition is met. Use 'previous end'.");
          if (std::abs(stage.start_time - end) > 1e-9 * (1. + end))
            subsection.fail(
                "Start time",
                text_of("but the stage before ends at ", end, " s: stages ",
                        stage.start_time < end ? "overlap" : "leave a gap",
                        ". Use 'previous end' or change the durations."));
        }
        end = stage.end == StageEnd::time && stage.end_conditions.empty()
                  ? end + stage.duration
                  : std::numeric_limits<double>::quiet_NaN();
      }
    }

    /** Checks the loads that @p stage scales by a factor. */
    void check_pattern(const std::string &file, const StageParameters &stage,
                       const std::vector<LoadParameters> &loads)
    {
      const std::string where
          = file + ", section 'Stages/" + stage.name + "': ";
      for (const std::string &name : stage.pattern->loads)
      {
        const std::string what     = where + "'Load pattern' names '" + name;
        const LoadParameters *load = find_named(loads, name);
        if (!load)
          throw InputError(
              what + "', which is no load. Loads are: "
              + known_names_like(name, loads, &LoadParameters::name) + ".");
        if (load->type != LoadType::traction && load->type != LoadType::gravity)
          throw InputError(what + "', of type '" + load->type_text()
                           + "', but a factor scales loads of type 'traction' "
                             "and 'gravity' alone.");
        if (names_load(stage, name))
          throw InputError(what
                           + "', which 'Loads' names, too. Leave it out "
                             "there, or give the part that does not grow "
                             "a load of its own.");
        if (std::count(stage.pattern->loads.begin(), stage.pattern->loads.end(),
                       name)
            > 1)
          throw InputError(what
                           + "' twice, but it acts once. Remove one, or "
                             "give the load another value.");
      }
    }

    void check_loads(const std::string &file,
                     const std::vector<StageParameters> &stages,
                     const std::vector<LoadParameters> &loads)
    {
      for (const StageParameters &stage : stages)
      {
        if (stage.pattern)
          check_pattern(file, stage, loads);
        for (const std::string &name : stage.loads)
        {
          const std::string what = file + ", section 'Stages/" + stage.name
                                   + "': 'Loads' names '" + name;
          const LoadParameters *load = find_named(loads, name);
          if (!load)
            throw InputError(
                what + "', which is no load. Loads are: "
                + known_names_like(name, loads, &LoadParameters::name) + ".");
          if (std::count(stage.loads.begin(), stage.loads.end(), name) > 1)
            throw InputError(what
                             + "' twice, but it acts once. Remove one, or give "
                               "the load another value.");
          if (load->type == LoadType::initial_stress)
            throw InputError(what
                             + "', an initial stress, which acts from the "
                               "start and does not end. Leave it out there.");
        }
      }
    }

    /** Checks that the history of the waves has no gap. */
    void check_far_field(const std::string &file,
                         const std::vector<StageParameters> &stages,
                         const std::string &load)
    {
      bool has_acted = false, has_stopped = false;
      for (const StageParameters &stage : stages)
      {
        const bool acts
            = stage.end == StageEnd::time && names_load(stage, load);
        if (acts && has_stopped)
          throw InputError(file + ", section 'Stages/" + stage.name
                           + "': the boundary elements of load '" + load
                           + "' have acted in an earlier stage with 'End = "
                             "time' and not in the stage before this one: "
                             "their history would have a gap. Let such stages "
                             "follow each other.");
        has_acted   = has_acted || acts;
        has_stopped = has_acted && !acts;
      }
    }
  } // namespace

  std::vector<StageParameters>
  read_stages(const ParameterSection &top,
              const std::vector<LoadParameters> &loads, const bool is_implicit)
  {
    const auto stages = read_named<StageParameters>(top, "Stages");
    const ParameterSection section(top, "Stages");
    if (stages.empty())
      section.fail("Names", "must list at least one stage.");
    check_order(section, stages);
    bool has_excavated = false;
    for (const StageParameters &stage : stages)
    {
      has_excavated = has_excavated || !stage.excavate.empty();
      check_stage(ParameterSection(section, stage.name), stage,
                  is_implicit || comes_to_rest(stage, loads), has_excavated);
    }
    check_releases(section, stages);
    check_loads(top.file(), stages, loads);
    for (const LoadParameters &load : loads)
      if (load.type == LoadType::boundary_elements)
        check_far_field(top.file(), stages, load.name);
    return stages;
  }
} // namespace quoin
