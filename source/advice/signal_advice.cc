// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/signal_advice.h>
#include <quoin/signals/signal_frequency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <variant>
#include <vector>

namespace quoin
{
  namespace
  {
    /** Acceleration that is a weight [m/s^2]. */
    constexpr double least_weight = 1.;
    /** Samples of a stage. */
    constexpr unsigned int n_samples = 2049;

    bool acts_on_all(const LoadParameters &load)
    {
      return load.type == LoadType::gravity && load.groups.empty()
             && !load.distribution;
    }

    /** The end of stage @p index or, if it ends at rest, a time at which ramps
        are over [s]. */
    TimePoint end_of(const Parameters &parameters, const unsigned int index)
    {
      constexpr double at_rest     = 1e3;
      const StageParameters &stage = parameters.stages[index];
      const double start           = start_of_stage(parameters.stages, index);
      const double end = stage.end == StageEnd::time ? stage.duration : at_rest;
      return { end, start + end };
    }

    /** Warns of gravity that begins anew as a stage begins. */
    void check_begun_anew(const Parameters &parameters,
                          const LoadParameters &load, const unsigned int index,
                          Checks &checks)
    {
      const StageParameters *before = previous_stage(parameters.stages, index);
      if (!before || !names_load(*before, load.name))
        return;
      const TimePoint last
          = end_of(parameters, before - parameters.stages.data());
      // T goes on where the stage before has ended, whenever that was.
      const TimePoint first{ 0., last.total };
      for (const auto &given : load.given_components())
      {
        if (given.component.field)
          continue;
        const double end   = given.component.value(last),
                     start = given.component.value(first);
        checks.warn_if(
            std::abs(end) > least_weight
                && std::abs(start) < 0.5 * std::abs(end),
            "the load ", load.name, " begins anew at ", start + 0.,
            " m/s^2, after ", end, " in stage ", before->name,
            ": its weight is lost at once, as t is the time in the stage. "
            "Write T, the time of the run, or name another load here.");
      }
    }

    /** Warns of all blocks weighing twice. */
    void check_twice(const Parameters &parameters, const unsigned int index,
                     Checks &checks)
    {
      const TimePoint end = end_of(parameters, index);
      std::map<std::string, std::pair<const LoadParameters *, double>> known;
      for (const LoadParameters &load : parameters.loads)
      {
        if (!acts_on_all(load)
            || !names_load(parameters.stages[index], load.name))
          continue;
        for (const auto &given : load.given_components())
        {
          const double value
              = given.component.field ? 0. : given.component.value(end);
          if (std::abs(value) < least_weight)
            continue;
          const auto [other, is_new]
              = known.try_emplace(given.name, &load, value);
          const auto &[first, first_value] = other->second;
          // What shakes or pushes beside weight has another value.
          checks.warn_if(
              !is_new && std::abs(first_value - value) < 0.02 * std::abs(value),
              "the loads ", first->name, " and ", load.name,
              " are the same gravity on all blocks, which weigh twice. Leave "
              "one of them out.");
        }
      }
    }

    /** Warns of records of velocity that end in motion. */
    void check_end_of_record(const LoadParameters &load,
                             const StageParameters &stage, const double start,
                             Checks &checks)
    {
      if (load.type != LoadType::prescribed_motion
          && load.type != LoadType::platen)
        return;
      for (const auto &given : load.given_components())
      {
        if (given.component.quantity != LoadQuantity::velocity
            || given.component.field || given.name.rfind("rotation", 0) == 0)
          continue;
        const double duration = stage.duration;
        std::vector<double> values(n_samples);
        for (unsigned int i = 0; i < n_samples; ++i)
        {
          const double t = duration * i / (n_samples - 1);
          values[i]      = given.component.value({ t, start + t });
        }
        const auto [low, high]
            = std::minmax_element(values.begin(), values.end());
        const double last = values.back(), range = *high - *low;
        double jump = 0.;
        for (unsigned int i = 0; i + 1 < n_samples; ++i)
          jump = std::max(jump, std::abs(values[i + 1] - values[i]));
        // What moves one way alone, or is reversed at once as in cyclic
        // loading, is no record of shaking.
        if (range == 0. || *low > -0.05 * range || *high < 0.05 * range
            || std::abs(last) < 2e-3 * range || jump > 0.3 * range)
          continue;
        const auto held
            = std::find_if(values.rbegin(), values.rend(),
                           [&](const double v) { return v != last; });
        const std::ptrdiff_t n = held - values.rbegin();
        checks.warn_if(n > n_samples / 50, "the ", given.name, " of the load ",
                       load.name, " stays at ", last, " m/s from ",
                       duration * (1. - double(n - 1) / (n_samples - 1)),
                       " s on, so that what it holds moves on by ",
                       last * duration * double(n - 1) / (n_samples - 1),
                       " m. Let the record end at rest: correct its baseline, "
                       "or give it a "
                       "last line with a velocity of 0.");
      }
    }

    /** Whether @p load moves its nodes to both sides of where @p stage, which
        begins at @p start [s], finds them. */
    bool goes_to_and_fro(const LoadParameters &load,
                         const StageParameters &stage, const double start)
    {
      /** Shorter way by the longer one that makes a cycle [-]. */
      constexpr double least = 0.2;
      if (load.type != LoadType::prescribed_motion
          && load.type != LoadType::platen)
        return false;
      for (const auto &given : load.given_components())
      {
        if (given.component.quantity == LoadQuantity::force
            || given.component.field || given.name.rfind("rotation", 0) == 0)
          continue;
        const double step = stage.duration / (n_samples - 1);
        double low = 0., high = 0., way = 0.;
        for (unsigned int i = 0; i < n_samples; ++i)
        {
          const double value
              = given.component.value({ i * step, start + i * step });
          way  = given.component.quantity == LoadQuantity::velocity
                     ? way + value * step
                     : value;
          low  = std::min(low, way);
          high = std::max(high, way);
        }
        if (std::min(high, -low) > least * std::max(high, -low))
          return true;
      }
      return false;
    }

    /** Whether the model has joints, contacts or liners of @p set, whichever
        law they follow. */
    bool has_joints(const Parameters &parameters, const JointSetParameters &set)
    {
      const auto &beams = parameters.beams;
      return !set.curves.empty() || set.all_new_contacts
             || !set.new_contacts.empty()
             || std::any_of(beams.begin(), beams.end(),
                            [&](const BeamParameters &beam)
                            { return beam.interface == set.name; });
    }

    /** The first set whose cracks stay open that joints follow in the stage
        @p index, or null. */
    const JointSetParameters *mortar_in(const Parameters &parameters,
                                        const unsigned int index)
    {
      const auto &sets = parameters.model.joints;
      for (const JointSetParameters &set : sets)
      {
        if (!has_joints(parameters, set))
          continue;
        std::string followed = set.name;
        for (unsigned int i = 0; i <= index; ++i)
          for (const auto &[changed, other] :
               parameters.stages[i].joint_properties)
            if (changed == set.name)
              followed = other;
        const auto found = std::find_if(sets.begin(), sets.end(),
                                        [&](const JointSetParameters &each)
                                        { return each.name == followed; });
        if (found == sets.end())
          continue;
        if (const auto *law = std::get_if<CompositeLaw>(&found->law);
            law && !law->cracks_close)
          return &*found;
      }
      return nullptr;
    }

    /** Warns of the first stage with cycles on mortar whose cracks do not
        close. */
    void check_cycles(const Parameters &parameters, Advice &advice)
    {
      for (unsigned int i = 0; i < parameters.stages.size(); ++i)
        for (const LoadParameters &load : parameters.loads)
        {
          const JointSetParameters *set = mortar_in(parameters, i);
          if (!set)
            continue;
          const StageParameters &stage = parameters.stages[i];
          if (stage.end != StageEnd::time || !names_load(stage, load.name)
              || !goes_to_and_fro(load, stage,
                                  start_of_stage(parameters.stages, i)))
            continue;
          Checks(advice, "stage " + stage.name + ": ")
              .warn_if(true, "the load ", load.name,
                       " goes to and fro, but cracks of the joints ", set->name,
                       " stay open: they bear compression before they are "
                       "closed, and what opens on one side lifts the other "
                       "one. Give 'Cracks = close', which cycles need.");
          return;
        }
    }

    /** Warns of @p velocity [m/s] of a wave that no rock survives. */
    void check_velocity(const double velocity, const std::string &of,
                        Advice &advice)
    {
      constexpr double most = 20.;
      Checks(advice, of)
          .warn_if(velocity > most, "its particle velocity comes to ", velocity,
                   " m/s, far more than blasts and earthquakes bring. In mm/s "
                   "it would "
                   "be ",
                   1e-3 * velocity, " m/s. Check the unit.");
    }

    void check_waves(const Parameters &parameters, Advice &advice)
    {
      const double end
          = start_of_stage(parameters.stages, parameters.stages.size());
      if (!(end > 0.))
        return;
      const auto largest = [&](const auto &value)
      {
        const auto [low, high] = extremes(value, end);
        return std::max(-low, high);
      };
      for (const IncidentWaveParameters &wave : parameters.boundary.waves)
        if (wave.n_integrations == 1 && wave.signal.value
            && wave.type != IncidentWaveType::line_source)
          check_velocity(std::abs(wave.amplitude) * largest(wave.signal.value),
                         "incident wave " + wave.name + ": ", advice);
      for (const LoadParameters &load : parameters.loads)
        if (load.type == LoadType::viscous_boundary)
          for (const auto &given : load.given_components())
            if (given.component.quantity == LoadQuantity::velocity
                && !given.component.field)
              check_velocity(largest(
                                 [&](const double t) {
                                   return given.component.value({ t, t });
                                 }),
                             "load " + load.name + ": ", advice);
    }
  } // namespace

  void check_signals(const Parameters &parameters, const unsigned int dim,
                     Advice &advice)
  {
    bool all_by_time = !parameters.stages.empty();
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage = parameters.stages[i];
      const double start           = start_of_stage(parameters.stages, i);
      Checks checks(advice, "stage " + stage.name + ": ");
      for (const LoadParameters &load : parameters.loads)
      {
        if (!names_load(stage, load.name))
          continue;
        if (load.type == LoadType::gravity)
          check_begun_anew(parameters, load, i, checks);
        if (stage.end == StageEnd::time)
          check_end_of_record(load, stage, start, checks);
      }
      check_twice(parameters, i, checks);
      all_by_time = all_by_time && stage.end == StageEnd::time;
    }
    check_waves(parameters, advice);
    check_cycles(parameters, advice);
    const double end
        = start_of_stage(parameters.stages, parameters.stages.size());
    Checks(advice, "'Interval = ")
        .warn_if(all_by_time && !parameters.is_implicit
                     && !parameters.histories.empty()
                     && parameters.history_interval > end,
                 parameters.history_interval,
                 "' in section 'Histories' is longer than the run, ", end,
                 " s: histories.csv has its first and last rows alone.");
    if (dim == 3)
      for (const LoadParameters &load : parameters.loads)
      {
        if (load.type != LoadType::gravity)
          continue;
        for (const auto &given : load.given_components())
          Checks(advice, "load " + load.name + ": ")
              .warn_if(
                  given.name == "lateral"
                      && std::abs(given.component.value({ 0., 0. }) + 9.81)
                             < 0.05,
                  "gravity acts along y. In three dimensions z is upwards: "
                  "give 'Vertical' instead of 'Lateral', unless that is "
                  "meant.");
      }
  }
} // namespace quoin
