// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/loading/stage_loads.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** The functions of rotations of a platen in three dimensions. */
    template <int dim>
    const std::array<LoadComponent, 3> *
    rotations_of(const MotionConstraint<dim> &constraint)
    {
      const RigidMotion<dim> *body = constraint.rigid_motion();
      return body ? body->rotations() : nullptr;
    }

    /** Values of the functions of time of @p constraint; 0 without them. */
    template <int dim>
    std::array<double, 6> values_of(const MotionConstraint<dim> &constraint,
                                    const TimePoint &time)
    {
      std::array<double, 6> result{};
      unsigned int i = 0;
      for (const auto *parts : { constraint.parts(), rotations_of(constraint) })
      {
        if (parts)
          for (const double value : component_values(*parts, time))
            result[i++] = value;
        i = 3;
      }
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<std::array<double, 5>>
  StageLoads<dim>::values(const double stage_start,
                          const double load_time) const
  {
    const TimePoint time{ load_time, stage_start + load_time };
    std::vector<std::array<double, 5>> result;
    for (const NodalLoad<dim> *load : nodal)
      result.push_back(load->amplitude(time));
    for (const MotionConstraint<dim> *constraint : constraints)
    {
      const auto own = values_of(*constraint, time);
      result.push_back({ own[0], own[1], own[2], 0., 0. });
      result.push_back({ own[3], own[4], own[5], 0., 0. });
    }
    if (beams)
      for (const double load : beams->loads(time))
        result.push_back({ load, 0., 0., 0., 0. });
    if (water)
      for (const WaterBoundary &boundary : water->parameters().boundaries)
        result.push_back({ boundary.value(time), 0., 0., 0., 0. });
    return result;
  }

  template <int dim>
  bool StageLoads<dim>::change(const State<dim> &state,
                               const std::uint64_t n_steps,
                               const double step) const
  {
    constexpr double earliest = 1e-9; // [s]
    const double duration
        = step * double(n_steps + (water ? water->parameters().lag() : 0));
    const double now    = state.load_time;
    const double before = std::max(0., now - duration);
    const auto present  = values(state.load_start(), now);
    if (present != values(state.load_start(), before))
      return true;
    if ((release.changes() && release.share(before) != release.share(now))
        || arrival.differ(before, now))
      return true;
    for (double t = late_time; t > std::max(now, earliest); t *= 0.9)
      if (present != values(state.load_start(), t))
        return true;
    return false;
  }

  template <int dim>
  double StageLoads<dim>::growth() const
  {
    double last
        = std::max(release.changes() ? release.duration() : 0., arrival.rest());
    for (const NodalLoad<dim> *load : nodal)
      last = std::max(last, load->growth().rest());
    return last;
  }

  template <int dim>
  void StageLoads<dim>::check_start(const State<dim> &state) const
  {
    constexpr std::array<const char *, 3> names
        = { "Horizontal", dim == 2 ? "Vertical" : "Lateral",
            dim == 2 ? "Rotation" : "Vertical" };
    const TimePoint time{ 0., state.load_start() };
    for (const MotionConstraint<dim> *constraint : constraints)
    {
      if (const auto *parts = constraint->parts())
        check_no_jump(*parts, names, time, constraint->name());
      if (const auto *turns = rotations_of(*constraint))
        check_no_jump(*turns, { "Rotation x", "Rotation y", "Rotation" }, time,
                      constraint->name());
    }
  }

  template <int dim>
  void StageLoads<dim>::refuse_endless_motion(const StageParameters &stage,
                                              const double stage_start) const
  {
    const auto goes_on = [&](const LoadComponent &part)
    {
      return part.quantity == LoadQuantity::velocity
             && part.value({ late_time, stage_start + late_time }) != 0.;
    };
    for (const MotionConstraint<dim> *constraint : constraints)
      for (const auto *parts :
           { constraint->parts(), rotations_of(*constraint) })
        // An incident velocity that stays is a constant traction.
        if (parts && constraint->traits().kind != MotionKind::absorbing
            && std::any_of(parts->begin(), parts->end(), goes_on))
          throw InputError(
              "section 'Loads/" + constraint->name()
              + "': a velocity that does not become zero prevents "
                "equilibrium in the stage '"
              + stage.name + "', whose 'End' is '"
              + (stage.safety ? "factor of safety" : "static ratio")
              + "'. Take 'End = time' and a 'Duration' there, or "
                "a motion that ends.");
  }

  template <int dim>
  void StageLoads<dim>::check_finite(const StageParameters &stage,
                                     const State<dim> &state,
                                     const double load_time) const
  {
    const TimePoint time{ load_time, state.load_start() + load_time };
    const auto check = [&](const auto &values, const std::string &name)
    {
      if (!std::all_of(values.begin(), values.end(),
                       [](const double value) { return std::isfinite(value); }))
        throw RunError("the load '" + name
                       + "' is no finite number at the time "
                       + number_text(time.stage) + " s of stage '" + stage.name
                       + "', T = " + number_text(time.total)
                       + " s. Correct its function of time in section 'Loads/"
                       + name + "', or end the stage earlier.");
    };
    for (const NodalLoad<dim> *load : nodal)
      check(load->amplitude(time), load->name());
    for (const MotionConstraint<dim> *constraint : constraints)
      check(values_of(*constraint, time), constraint->name());
  }

  template <int dim>
  std::vector<UnsupportedBody<dim>>
  StageLoads<dim>::unsupported_bodies(const Model<dim> &model,
                                      const StageParameters &stage,
                                      const State<dim> &state) const
  {
    constexpr unsigned int n_times = 32;
    const double duration
        = stage.end == StageEnd::time ? stage.duration : stage.minimum_duration;
    std::vector<TimePoint> times;
    for (unsigned int i = 0; i <= n_times; ++i)
    {
      const double t = duration * i / n_times;
      times.push_back({ t, state.load_start() + t });
    }
    return find_unsupported_bodies(model, constraints, nodal, times, state);
  }

  template struct StageLoads<2>;
  template struct StageLoads<3>;
} // namespace quoin
