// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/stage_parameters.h>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;

    void declare_construction(dealii::ParameterHandler &prm)
    {
      prm.declare_entry("Excavate", "", Anything(),
                        "Physical surfaces whose blocks are taken away where "
                        "the stage begins.");
      prm.declare_entry("Fill", "", Anything(),
                        "Physical surfaces whose blocks are placed where the "
                        "stage begins, as the mesh has them and free of "
                        "stress. What is not excavated before is absent until "
                        "then.");
      prm.declare_entry("Release", "1", Double(),
                        "Share of what all excavated blocks exerted on those "
                        "that stay which is gone at the end of this stage [-]");
      prm.declare_entry("Release duration", "automatic", Anything(),
                        "How long that takes, by the loads' clock; automatic: "
                        "the stage's duration or, of an explicit stage with "
                        "'End = static ratio', twice the time of a shear wave "
                        "along the model's diagonal [s]");
      prm.declare_entry("Release ramp", "smooth", Selection("smooth|linear"),
                        "smooth: half a cosine.");
      prm.declare_entry("Materials", "", Anything(),
                        "Pairs group:material: what physical surfaces are "
                        "made of from this stage on; stresses stay.");
      prm.declare_entry("Joint properties", "", Anything(),
                        "Pairs set:other set: joint sets that follow the law "
                        "of another, which may be without curves, from this "
                        "stage on; tractions stay.");
    }

    void read_construction(const ParameterSection &section,
                           StageParameters &stage)
    {
      stage.excavate = section.list("Excavate");
      stage.fill     = section.list("Fill");
      stage.release  = section.within("Release", 0., 1.);
      if (section.text("Release duration") != "automatic")
      {
        stage.release_duration = section.numbers<1>("Release duration").front();
        if (stage.release_duration < 0.)
          section.fail("Release duration",
                       "must be 'automatic' or a time that is not negative.");
        if (stage.end == StageEnd::time
            && stage.release_duration > stage.duration)
          section.fail("Release duration", "is longer than the stage. Lower "
                                           "it, or raise 'Duration'.");
      }
      stage.releases_linearly = section.text("Release ramp") == "linear";
      stage.materials         = section.pairs(
                  "Materials",
                  "must be pairs such as lining:young_concrete, rock:grouted.");
      stage.joint_properties = section.pairs(
          "Joint properties", "must be pairs such as bed:weak_bed.");
    }
  } // namespace

  void StageParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Loads", "", Anything(),
                      "Names of the loads that act in this stage; initial "
                      "stresses act in all and are not among them.");
    prm.declare_entry("End", "time",
                      Selection("time|static ratio|factor of safety"),
                      "What ends the stage: its duration; or that the sum of "
                      "the unbalanced forces has fallen to a share of that of "
                      "the applied ones. Factor of safety: strengths are "
                      "divided by factors, each time from the state of the "
                      "stage before, until it is known which one the model "
                      "still bears; it then goes on as it was.");
    prm.declare_entry("Duration", "0", Double(), "For 'End = time' [s]");
    prm.declare_entry("Kinetic energy limit", "0", Double(),
                      "The clock of the loads slows down, at most ten "
                      "thousand times, so that kinetic energy stays below "
                      "this share of the energy that went through; the "
                      "duration is then one of that clock. For quasi-static "
                      "loading to collapse; 0: loads follow the time [-]");
    prm.declare_entry("Static ratio", "1e-6", Double(),
                      "Unbalanced to applied force at which a stage with "
                      "'End = static ratio' ends, and a factor of safety "
                      "is stable; below 1 [-]");
    prm.declare_entry("Minimum duration", "0", Double(),
                      "For 'End = static ratio': the stage lasts at least so "
                      "long, and in any case until its loads have come to "
                      "rest [s]");
    prm.declare_entry("Start time", "previous end", Anything(),
                      "'previous end', or the time at which the stage is "
                      "meant to begin, as a check [s]");
    prm.declare_entry("Maximum steps", "10000000", Integer(1),
                      "A static stage that has not settled by then ends "
                      "the run as failed, a factor of safety counts as "
                      "failing [-]");
    prm.declare_entry("Damping", "none",
                      Selection("none|local|adaptive|Rayleigh"),
                      "local: a share of the unbalanced force, against the "
                      "velocity; adaptive: mass-proportional with a "
                      "coefficient that keeps the damping power at half the "
                      "rate of kinetic energy; Rayleigh: alpha and beta. "
                      "Explicit stages that settle need one, or a viscous or "
                      "free-field boundary.");
    prm.declare_entry("Local damping coefficient", "0.8", Double(),
                      "Share of the unbalanced force [-]");
    prm.declare_entry("Rayleigh mass coefficient", "0", Double(),
                      "alpha [1/s]");
    prm.declare_entry("Rayleigh stiffness coefficient", "0", Double(),
                      "beta; it lowers the critical time step [s]");
    prm.declare_entry("Mass scaling", "no", Selection("yes|no|true|false"),
                      "Add mass where needed for 'Scaled time step' to be "
                      "stable; for static work only.");
    prm.declare_entry("Scaled time step", "0", Double(),
                      "Time step to which 'Mass scaling' raises the critical "
                      "one, before the share of it that is used [s]");
    declare_construction(prm);
    SafetyParameters::declare(prm);
  }

  StageParameters StageParameters::read(const ParameterSection &section,
                                        const std::string &name)
  {
    StageParameters stage;
    stage.name  = name;
    stage.loads = section.list("Loads");
    stage.end   = section.choice<StageEnd>(
        "End", { { "time", StageEnd::time },
                   { "static ratio", StageEnd::static_ratio },
                   { "factor of safety", StageEnd::static_ratio } });
    if (stage.end == StageEnd::time)
      stage.duration = section.positive("Duration");
    else
    {
      stage.static_ratio = section.positive("Static ratio");
      if (stage.static_ratio >= 1.)
        section.fail("Static ratio", "must be below 1, where all that is "
                                     "applied is unbalanced: give 1e-3 to "
                                     "1e-9.");
      stage.minimum_duration = section.nonnegative("Minimum duration");
    }
    stage.maximum_steps = section.integer("Maximum steps");
    stage.kinetic_limit = section.within("Kinetic energy limit", 0., 1.);
    if (stage.slows_loads() && stage.end != StageEnd::time)
      section.fail("Kinetic energy limit",
                   "needs 'End = time': a stage that settles has loads that "
                   "rest in the end.");
    if (section.text("Start time") != "previous end")
    {
      stage.start_time = section.numbers<1>("Start time").front();
      if (stage.start_time < 0.)
        section.fail("Start time",
                     "must be 'previous end' or a time of zero or more.");
    }
    stage.damping = section.choice<DampingType>(
        "Damping", { { "none", DampingType::none },
                     { "local", DampingType::local },
                     { "adaptive", DampingType::adaptive },
                     { "Rayleigh", DampingType::rayleigh } });
    if (stage.damping == DampingType::local)
      stage.local_coefficient
          = section.within("Local damping coefficient", 0., 0.999);
    if (stage.damping == DampingType::rayleigh)
    {
      stage.mass_coefficient = section.nonnegative("Rayleigh mass coefficient");
      stage.stiffness_coefficient
          = section.nonnegative("Rayleigh stiffness coefficient");
    }
    if (section.flag("Mass scaling"))
      stage.scaled_time_step = section.positive("Scaled time step");
    read_construction(section, stage);
    if (section.text("End") == "factor of safety")
    {
      stage.safety = SafetyParameters::read(section);
      for (const char *name :
           { "Excavate", "Fill", "Materials", "Joint properties" })
        if (!section.text(name).empty())
          section.fail(name, "does not go with 'End = factor of safety', which "
                             "leaves the model as it was. Use a stage of its "
                             "own before it.");
    }
    return stage;
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
} // namespace quoin
