// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/stages/stage_parameters.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cctype>

namespace quoin
{
  namespace
  {
    void check_release(const ParameterSection &section,
                       const StageParameters &stage)
    {
      if (section.text("Release duration") == "automatic")
        return;
      if (stage.release_duration < 0.)
        section.fail("Release duration",
                     "must be 'automatic' or a time that is not negative.");
      if (stage.end == StageEnd::time
          && stage.release_duration > stage.duration)
        section.fail("Release duration", "is longer than the stage. Lower "
                                         "it, or raise 'Duration'.");
    }

    void enter_construction(ParameterEntries &entries, StageParameters &stage)
    {
      entries.list("Excavate", stage.excavate,
                   "Physical surfaces, in three dimensions volumes, whose "
                   "blocks are excavated at the start "
                   "of the stage.");
      entries.list(
          "Fill", stage.fill,
          "Physical surfaces, in three dimensions volumes, whose blocks are "
          "placed at the start of the "
          "stage, with the geometry of the mesh and free of stress. Blocks "
          "that no earlier stage excavates are absent until then.");
      entries.within(
          "Release", stage.release, 0., 1.,
          "Stress relaxation at the end of this stage: the released fraction "
          "of the forces of all excavated blocks on those that remain [-]");
      entries.number_or(
          "automatic", -1., "Release duration", stage.release_duration,
          "Load time over which the forces of excavated blocks are released; "
          "automatic: the duration of the stage or, in an explicit stage with "
          "'End = static ratio', twice the travel time of a shear wave along "
          "the model's diagonal, and five times that where a material yields "
          "[s]");
      entries.choice(
          "Release ramp", stage.releases_linearly,
          { { "automatic", std::nullopt },
            { "smooth", false },
            { "linear", true } },
          "Variation in time of the released forces of excavated blocks. "
          "smooth: by half a cosine; linear: at a constant rate; automatic: "
          "smooth by the explicit solver, linear by the implicit one, in "
          "which nothing is shaken.");
      entries.pairs(
          "Materials", stage.materials,
          "must be pairs such as lining:young_concrete, rock:grouted.",
          "Pairs group:material of physical surfaces whose material changes at "
          "the start of this stage; stresses do not change.");
      entries.pairs("Joint properties", stage.joint_properties,
                    "must be pairs such as bed:weak_bed.",
                    "Pairs set:other set of joint sets that follow the law of "
                    "another set, which needs no curves, from this stage on; "
                    "tractions do not change.");
      entries.positive(
          "Strength factor", stage.strength_factor,
          "Factor on cohesion, tensile strength and tangent of the friction "
          "angle of all joints and blocks in this stage, such as 3 for a slope "
          "that must reach equilibrium before a factor of safety below 1 is "
          "searched; tractions and stresses do not change [-]");
      if (const ParameterSection *section = entries.read_section())
        check_release(*section, stage);
    }

    /** The damping of a stage for which none is given. */
    DampingType automatic_damping(const ParameterSection &section,
                                  const StageParameters &stage)
    {
      // Local damping needs no search for its strength, and does not show in
      // an equilibrium, but carries a part of the weight of steady motion.
      if (stage.slows_loads() || section.text("End") == "factor of safety")
        return DampingType::adaptive;
      // A load pattern asks what the model bears at rest.
      return stage.end == StageEnd::static_ratio
                     || !section.text("Load pattern").empty()
                 ? DampingType::local
                 : DampingType::none;
    }

    void enter_damping(ParameterEntries &entries, StageParameters &stage)
    {
      std::optional<DampingType> damping;
      entries.choice(
          "Damping", damping,
          { { "automatic", std::nullopt },
            { "none", DampingType::none },
            { "local", DampingType::local },
            { "adaptive", DampingType::adaptive },
            { "Rayleigh", DampingType::rayleigh } },
          "Damping of the stage. local: a fraction of the unbalanced force "
          "opposes the velocity; adaptive: mass-proportional with a "
          "coefficient that keeps the damping power at half the rate of "
          "kinetic energy; Rayleigh: alpha and beta; automatic: adaptive with "
          "'Kinetic energy limit' or 'End = factor of safety', local with 'End "
          "= static ratio' or a 'Load pattern', otherwise none. Explicit "
          "stages that end at equilibrium need damping, or a viscous or "
          "free-field boundary.");
      if (const ParameterSection *section = entries.read_section())
        stage.damping = damping ? *damping : automatic_damping(*section, stage);
      double local_coefficient = default_local_damping;
      if (entries.reads_if(stage.damping == DampingType::local))
      {
        entries.within("Local damping coefficient", local_coefficient, 0.,
                       0.999,
                       "Fraction of the unbalanced force with which local "
                       "damping opposes the velocity [-]");
        stage.local_coefficient = local_coefficient;
      }
      if (entries.reads_if(stage.damping == DampingType::rayleigh))
      {
        entries.nonnegative(
            "Rayleigh mass coefficient", stage.mass_coefficient,
            "Mass-proportional coefficient alpha of Rayleigh damping [1/s]");
        entries.nonnegative(
            "Rayleigh stiffness coefficient", stage.stiffness_coefficient,
            "Stiffness-proportional coefficient beta of Rayleigh damping, "
            "which lowers the critical time step [s]");
      }
      bool scales_mass = false;
      entries.flag("Mass scaling", scales_mass,
                   "Whether mass is added where 'Scaled time step' would "
                   "otherwise be unstable: in stages that seek an equilibrium "
                   "as much as they bear, in others where few small elements "
                   "limit the time step; the log says which frequencies it "
                   "lowers.");
      if (entries.reads_if(scales_mass))
        entries.positive("Scaled time step", stage.scaled_time_step,
                         "Critical time step that 'Mass scaling' provides, "
                         "before the safety factor on the time step [s]");
    }

    /** Reads "outcome: expression; expression". */
    std::vector<EndCondition> end_conditions(const ParameterSection &section)
    {
      // An expression has a colon only after a question mark.
      const auto is_outcome = [](const std::string &text)
      {
        const auto fits = [](const unsigned char c)
        { return std::isalnum(c) != 0 || c == '_' || c == ' ' || c == '-'; };
        return !text.empty() && std::isalpha(text.front()) != 0
               && std::all_of(text.begin(), text.end(), fits);
      };
      const std::string entry = "End conditions";
      std::vector<EndCondition> result;
      for (const std::string &part :
           dealii::Utilities::split_string_list(section.text(entry), ';'))
      {
        EndCondition condition{ "condition met", part };
        const auto colon = part.find(':');
        if (colon != std::string::npos && is_outcome(part.substr(0, colon)))
          condition = { dealii::Utilities::trim(part.substr(0, colon)),
                        dealii::Utilities::trim(part.substr(colon + 1)) };
        if (condition.expression.empty())
          section.fail(entry, "has an empty condition. Give comparisons such "
                              "as abs(displacement) > 0.02, with a ';' between "
                              "two of them.");
        result.push_back(condition);
      }
      return result;
    }

    void enter_end(ParameterEntries &entries, StageParameters &stage)
    {
      entries.choice(
          "End", stage.end,
          { { "time", StageEnd::time },
            { "static ratio", StageEnd::static_ratio },
            { "factor of safety", StageEnd::static_ratio } },
          "End of the stage. time: after 'Duration'; static ratio: when the "
          "ratio of unbalanced to applied forces, each summed over nodes, "
          "falls below 'Static ratio'; factor of safety: strengths are divided "
          "by trial factors, each from the state at the end of the previous "
          "stage, until the factor of safety is bracketed, and the run then "
          "continues from that state.");
      const bool by_time = stage.end == StageEnd::time;
      if (const ParameterSection *section = entries.read_section();
          section && by_time && section->number("Duration") == 0.)
        section->fail(
            "Duration",
            "must be positive with 'End = time', which holds where no 'End' is "
            "given. Give a duration above zero, or 'End = static ratio' for a "
            "stage that ends at equilibrium, to which 'Static ratio' belongs.");
      if (entries.reads_if(by_time))
        entries.positive("Duration", stage.duration,
                         "Duration of a stage with 'End = time' [s]");
      entries.within(
          "Kinetic energy limit", stage.kinetic_limit, 0., 1.,
          "Kinetic energy limit of quasi-static loading, as a fraction of the "
          "energy throughput: the loading rate is reduced, at most ten "
          "thousand times, so that kinetic energy stays below it; 'Duration' "
          "is then one of load time, of which loads are functions and which is "
          "slower than time; 0: load time is the time since the start of the "
          "stage [-]");
      if (entries.reads_if(!by_time))
      {
        entries.positive("Static ratio", stage.static_ratio,
                         "Ratio of unbalanced to applied force, below 1, at "
                         "which a stage with 'End = static ratio' ends and a "
                         "trial of a factor of safety is stable; in explicit "
                         "stages at least a thousandth of the largest applied "
                         "force of the stage counts, as where all loads are "
                         "taken away [-]");
        entries.nonnegative(
            "Minimum duration", stage.minimum_duration,
            "Minimum duration of a stage with 'End = static ratio', which "
            "lasts in any case until its loads and what 'Water boundaries' "
            "give are constant [s]");
      }
      entries.other(
          "End conditions", "",
          "Comparisons of histories, separated by ';', each with an optional "
          "name of its outcome before a colon, such as 'collapsed: "
          "abs(displacement) > 0.02; softened: force < 0.8*peak_force'. The "
          "first one that is met when a row of histories.csv is written ends "
          "the stage, and the next stage begins; empty: none. Names are those "
          "of 'Histories', with _ for characters other than letters and "
          "digits, 'time' [s], and 'peak_' before a name for the largest "
          "magnitude of that history so far in the stage.",
          [&](const ParameterSection &from)
          { stage.end_conditions = end_conditions(from); });
      entries.number_or("previous end", -1., "Start time", stage.start_time,
                        "Expected start time of the stage, as a check, or "
                        "'previous end' [s]");
      stage.maximum_steps = 10000000;
      entries.integer("Maximum steps", stage.maximum_steps, 1,
                      "Maximum number of steps, after which a stage that has "
                      "not reached equilibrium ends the run as failed, and a "
                      "trial of a factor of safety is undecided [-]");
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (!by_time && stage.static_ratio >= 1.)
        section->fail("Static ratio", "must be below 1, where all that is "
                                      "applied is unbalanced: give 1e-3 to "
                                      "1e-9.");
      if (stage.slows_loads() && !by_time)
        section->fail("Kinetic energy limit",
                      "needs 'End = time': the loads of a stage that ends at "
                      "equilibrium must become constant.");
      if (section->text("Start time") != "previous end"
          && stage.start_time < 0.)
        section->fail("Start time",
                      "must be 'previous end' or a time of zero or more.");
    }

    TimeFunction control_function(const ParameterSection &section)
    {
      const std::string name = "Control function";
      if (section.text(name).empty())
        section.fail(name, "must say how far the loads of 'Load pattern' move "
                           "the model, an expression of t such as 1e-3 * t.");
      const auto result = section.made(
          name,
          [&]() { return TimeFunction(section.text(name), section.folder()); });
      if (result({ 0., 0. }) != 0.)
        section.fail(name, "is not 0 where the stage begins, but a "
                           "displacement counts from there: let it rise from "
                           "0.");
      return result;
    }

    void enter_pattern(ParameterEntries &entries, StageParameters &stage)
    {
      PatternParameters pattern;
      entries.list(
          "Load pattern", pattern.loads,
          "Names of tractions and gravities that act in addition to 'Loads', "
          "multiplied by a load factor for which the controlled displacement "
          "follows 'Control function', also beyond the peak load. Their values "
          "are constant in time and belong to the load factor 1; empty: none.");
      if (entries.reads_if(!pattern.loads.empty()))
      {
        entries.text(
            "Controlled displacement", pattern.controlled,
            "Displacement that controls the load pattern: 'mean', the "
            "displacement of the blocks in the direction of its loads, "
            "weighted by the loads; or the name of a history of a displacement "
            "or relative displacement, which the explicit solver follows by "
            "changing the rate of the mean.");
        entries.other(
            "Control function", "",
            "Controlled displacement of the load pattern from the start of the "
            "stage on, a function of t as those of loads [m]",
            [&](const ParameterSection &from)
            { pattern.control = control_function(from); });
      }
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (pattern.loads.empty())
      {
        for (const auto &[name, preset] :
             { std::pair("Controlled displacement", "mean"),
               std::pair("Control function", "") })
          if (section->text(name) != preset)
            section->fail(name, "has no effect without a 'Load pattern'. Name "
                                "the loads that are to be scaled, or remove "
                                "this.");
        return;
      }
      if (stage.end != StageEnd::time)
        section->fail("Load pattern",
                      "needs 'End = time', a 'Duration' and a 'Control "
                      "function' of that time. 'End conditions' may end the "
                      "stage before.");
      stage.pattern = pattern;
    }

    void enter_reset(ParameterEntries &entries, ResultReset &reset)
    {
      std::vector<std::string> words;
      entries.list(
          "Reset", words,
          "Results that are reset to zero at the start of this stage: "
          "displacements, slips, joint states, any of the three. Forces, "
          "stresses, strengths and energies are not reset; empty: no reset.");
      for (const std::string &word : words)
      {
        if (word == "displacements")
          reset.displacements = true;
        else if (word == "slips")
          reset.slips = true;
        else if (word == "joint states")
          reset.joint_states = true;
        else
          entries.read_section()->fail(
              "Reset", "names '" + word
                           + "', which cannot be counted from the start of a "
                             "stage. Give some of displacements, slips, joint "
                             "states.");
      }
    }

    void enter(ParameterEntries &entries, StageParameters &stage)
    {
      entries.list("Loads", stage.loads,
                   "Names of the loads that act in this stage; initial "
                   "stresses act in all stages and are not listed.");
      enter_end(entries, stage);
      enter_pattern(entries, stage);
      enter_damping(entries, stage);
      enter_construction(entries, stage);
      enter_reset(entries, stage.reset);
      const ParameterSection *section = entries.read_section();
      if (entries.reads_if(section
                           && section->text("End") == "factor of safety"))
        stage.safety.emplace().enter(entries);
      if (!section || !stage.safety)
        return;
      for (const char *name :
           { "Excavate", "Fill", "Materials", "Joint properties" })
        if (!section->text(name).empty())
          section->fail(name, "does not go with 'End = factor of safety', "
                              "which leaves the model as it was. Use a stage "
                              "of its own before it.");
      for (const auto &[name, preset] :
           { std::pair("Release", stage.release == 1.),
             std::pair("Release duration", stage.release_duration < 0.),
             std::pair("Release ramp", !stage.releases_linearly) })
        if (!preset)
          section->fail(name, "does not go with 'End = factor of safety', "
                              "whose trials keep the support pressure of "
                              "excavated blocks that the stage before has "
                              "left. Release it in a stage of its own before, "
                              "or remove this.");
      if (stage.strength_factor != 1.)
        section->fail("Strength factor",
                      "does not go with 'End = factor of safety', whose trials "
                      "divide the strengths of the parameters. Give it to the "
                      "stage before, or leave it at 1.");
      if (!stage.end_conditions.empty())
        section->fail("End conditions",
                      "does not go with 'End = factor of safety', whose trials "
                      "write no histories. Give 'Failure displacement', or "
                      "leave this empty.");
      if (stage.reset.any())
        section->fail("Reset",
                      "does not go with 'End = factor of safety', whose "
                      "mechanism counts from the start of the stage in any "
                      "case. Leave it empty.");
    }
  } // namespace

  namespace
  {
    std::string damping_text(const StageParameters &stage)
    {
      switch (stage.damping)
      {
      case DampingType::local:
        return text_of("local damping ", stage.local_coefficient);
      case DampingType::adaptive:
        return "adaptive damping";
      case DampingType::rayleigh:
        return text_of("Rayleigh damping, alpha ", stage.mass_coefficient,
                       " 1/s, beta ", stage.stiffness_coefficient, " s");
      default:
        return "no damping";
      }
    }

    std::string end_text(const StageParameters &stage, const bool is_implicit)
    {
      if (stage.safety)
        return "searches for the factor of safety";
      if (stage.end == StageEnd::time)
        return text_of("lasts ", stage.duration, " s",
                       stage.slows_loads() ? " of load time" : "");
      return is_implicit ? "until the loads rest"
                         : text_of("until unbalanced forces are ",
                                   stage.static_ratio, " of the applied ones");
    }
  } // namespace

  std::string StageParameters::text(const bool is_implicit) const
  {
    using boost::algorithm::join;
    std::string text
        = "stage " + name + ": "
          + (loads.empty() ? "no loads" : "loads " + join(loads, ", ")) + "; "
          + end_text(*this, is_implicit);
    if (!is_implicit)
      text += "; " + damping_text(*this);
    if (pattern)
      text
          += "; a factor of " + join(pattern->loads, ", ") + " makes "
             + (pattern->controlled == "mean" ? "their mean displacement"
                                              : "'" + pattern->controlled + "'")
             + " follow its function";
    for (const EndCondition &condition : end_conditions)
      text += "; ends as '" + condition.outcome + "' where "
              + condition.expression;
    if (!excavate.empty())
      text += "; excavates " + join(excavate, ", ");
    if (!fill.empty())
      text += "; fills " + join(fill, ", ");
    if (strength_factor != 1.)
      text += text_of("; strengths times ", strength_factor);
    std::vector<std::string> counted;
    if (reset.displacements)
      counted.push_back("displacements");
    if (reset.slips)
      counted.push_back("slips");
    if (reset.joint_states)
      counted.push_back("joint states");
    if (!counted.empty())
      text += "; results count " + join(counted, ", ") + " from its start";
    for (const auto &[group, material] : materials)
      text += "; " + group + " becomes " + material;
    for (const auto &[set, other] : joint_properties)
      text += "; joints " + set + " become " + other;
    return text;
  }

  void StageParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  StageParameters StageParameters::read(const ParameterSection &section,
                                        const std::string &name)
  {
    StageParameters stage = read_entries(section, enter);
    stage.name            = name;
    return stage;
  }

  bool names_load(const StageParameters &stage, const std::string &name)
  {
    return std::find(stage.loads.begin(), stage.loads.end(), name)
           != stage.loads.end();
  }

  const StageParameters *
  previous_stage(const std::vector<StageParameters> &stages,
                 const unsigned int index)
  {
    for (unsigned int i = index; i-- > 0;)
      if (!stages[i].safety)
        return &stages[i];
    return nullptr;
  }

  double start_of_stage(const std::vector<StageParameters> &stages,
                        const unsigned int index)
  {
    double start = 0.;
    for (unsigned int i = 0; i < index; ++i)
      if (stages[i].end == StageEnd::time)
        start += stages[i].duration;
    return start;
  }
} // namespace quoin
