// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/sequence_advice.h>
#include <quoin/base/known_names.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace quoin
{
  namespace
  {
    using NamedComponent = LoadParameters::NamedComponent;

    bool acts_in(const LoadParameters &load, const StageParameters &stage)
    {
      return names_load(stage, load.name)
             || (stage.pattern && is_among(load.name, stage.pattern->loads));
    }

    /** Time in @p stage at its end or, if it ends at rest, long after its loads
        have grown [s]. */
    double end_of_loads(const StageParameters &stage)
    {
      return stage.end == StageEnd::time ? stage.duration : late_time;
    }

    /** Start, middle and end of @p stage, which began at @p start [s]. */
    std::array<TimePoint, 3> times_of(const StageParameters &stage,
                                      const double start)
    {
      const double end = end_of_loads(stage);
      return { { { 0., start },
                 { 0.5 * end, start + 0.5 * end },
                 { end, start + end } } };
    }

    /** Where @p load acts: boundary elements along their interfaces. */
    std::vector<std::string> boundaries_of(const LoadParameters &load,
                                           const Parameters &parameters)
    {
      if (load.type != LoadType::boundary_elements)
        return load.boundaries;
      std::vector<std::string> result;
      for (const BoundaryCurveParameters &curve :
           parameters.boundary.boundaries)
        if (curve.shape == BoundaryShape::interface)
          result.insert(result.end(), curve.curves.begin(), curve.curves.end());
      return result;
    }

    /** Whether @p load determines how its nodes move, or what waves pass. */
    bool is_support(const LoadParameters &load)
    {
      return load.type == LoadType::prescribed_motion
             || load.type == LoadType::platen
             || load.type == LoadType::viscous_boundary
             || load.type == LoadType::free_field
             || load.type == LoadType::boundary_elements;
    }

    /** Whether @p load holds ground in @p stage where it is. */
    bool holds_still(const LoadParameters &load, const StageParameters &stage,
                     const double start)
    {
      if (load.type == LoadType::boundary_elements)
        return true;
      const auto given = load.given_components();
      const auto times = times_of(stage, start);
      return load.type == LoadType::prescribed_motion
             && std::all_of(
                 given.begin(), given.end(),
                 [&](const NamedComponent &each)
                 {
                   return !each.component.field
                          && std::all_of(
                              times.begin(), times.end(),
                              [&](const TimePoint &time)
                              { return each.component.value(time) == 0.; });
                 });
    }

    /** Names of physical surfaces whose blocks are not there in stage @p index.
     */
    std::set<std::string> absent_groups(const Parameters &parameters,
                                        const unsigned int index)
    {
      std::set<std::string> result(parameters.model.absent_groups.begin(),
                                   parameters.model.absent_groups.end());
      for (unsigned int i = 0; i <= index; ++i)
      {
        for (const std::string &group : parameters.stages[i].fill)
          result.erase(group);
        result.insert(parameters.stages[i].excavate.begin(),
                      parameters.stages[i].excavate.end());
      }
      return result;
    }

    /** Whether the curve @p name of @p load is that of a block outside of the
        groups @p absent and, where @p is_outside, reaches the sides or the
        bottom of the model. Collective. */
    template <int dim>
    bool has_blocks(const std::string &name, const LoadParameters &load,
                    const std::set<std::string> &absent, const bool is_outside,
                    const NodeMap<dim> &nodes)
    {
      const auto &table  = nodes.table();
      const double close = 1e-6 * table.diagonal();
      const auto reaches = [&](const BoundaryFace<dim> &face)
      {
        const auto all_points = [&](const auto &is_there) {
          return std::all_of(face.points.begin(), face.points.end(), is_there);
        };
        for (unsigned int d = 0; d < dim; ++d)
          if (all_points([&](const dealii::Point<dim> &point)
                         { return point[d] < table.box[0][d] + close; })
              || (d + 1 < dim
                  && all_points(
                      [&](const dealii::Point<dim> &point)
                      { return point[d] > table.box[1][d] - close; })))
            return true;
        return false;
      };
      const auto faces
          = faces_of_curves(nodes, { name }, load.name, !is_outside);
      return std::any_of(faces.begin(), faces.end(),
                         [&](const BoundaryFace<dim> &face)
                         {
                           return !absent.count(table.group_names[face.group])
                                  && (!is_outside || reaches(face));
                         });
    }

    std::string list_text(const std::vector<std::string> &names)
    {
      std::string result;
      for (const std::string &name : names)
        result += (result.empty() ? "" : ", ") + name;
      return result;
    }

    /** The loads of @p stage but @p load that act on @p boundary, or on a group
        of @p load. */
    std::vector<const LoadParameters *> others_at(const std::string &boundary,
                                                  const LoadParameters &load,
                                                  const StageParameters &stage,
                                                  const Parameters &parameters)
    {
      std::vector<const LoadParameters *> result;
      for (const LoadParameters &other : parameters.loads)
        if (other.name != load.name && acts_in(other, stage)
            && (boundary.empty()
                    ? std::any_of(load.groups.begin(), load.groups.end(),
                                  [&](const std::string &group)
                                  { return is_among(group, other.groups); })
                    : is_among(boundary, boundaries_of(other, parameters))))
          result.push_back(&other);
      return result;
    }

    /** Whether one of @p others gives what the component @p name of a force is:
        a force or a motion along it, or all of the motion. */
    bool is_replaced(const std::string &name,
                     const std::vector<const LoadParameters *> &others)
    {
      return std::any_of(
          others.begin(), others.end(),
          [&](const LoadParameters *other)
          {
            if (is_support(*other) && other->type != LoadType::platen
                && other->type != LoadType::prescribed_motion)
              return true;
            const auto given = other->given_components();
            return std::any_of(given.begin(), given.end(),
                               [&](const NamedComponent &each) {
                                 return each.name == name || name == "pressure"
                                        || each.name == "pressure";
                               });
          });
    }

    /** Whether one of @p others moves its nodes. */
    bool is_driven(const std::vector<const LoadParameters *> &others)
    {
      return std::any_of(others.begin(), others.end(),
                         [](const LoadParameters *other)
                         {
                           return other->type == LoadType::platen
                                  || other->type == LoadType::prescribed_motion;
                         });
    }

    /** The stage @p index and what is there before it. */
    struct Change
    {
      const Parameters &parameters;
      const StageParameters &stage, &before;
      double start_before; /**< start of the stage before [s] */
      std::set<std::string> absent;
    };

    /** Warns of a support of ground that ends. Collective. */
    template <int dim>
    void check_support(const LoadParameters &load, const Change &change,
                       const NodeMap<dim> &nodes, Checks &checks)
    {
      std::vector<std::string> open;
      for (const std::string &name : boundaries_of(load, change.parameters))
      {
        const auto others
            = others_at(name, load, change.stage, change.parameters);
        if (std::none_of(others.begin(), others.end(),
                         [](const LoadParameters *other) {
                           return is_support(*other)
                                  || other->type == LoadType::traction;
                         })
            && has_blocks(name, load, change.absent, true, nodes))
          open.push_back(name);
      }
      checks.warn_if(!open.empty(), "its 'Loads' hold nothing at ",
                     list_text(open), ", where the load ", load.name,
                     " of stage ", change.before.name,
                     " held blocks with initial stress: the pressure of the "
                     "ground beyond ends there at once. Name that load here, "
                     "too, or another one in its place, if that is not meant.");
    }

    /** Whether @p force is zero at the end of the stage before, but for
        rounding. */
    bool is_over(const TimeFunction &force, const Change &change)
    {
      constexpr unsigned int n = 32;
      const double end         = end_of_loads(change.before);
      const auto value         = [&](const double t) {
        return std::abs(force({ t, change.start_before + t }));
      };
      double largest = 0.;
      for (unsigned int i = 0; i <= n; ++i)
        largest = std::max(largest, value(end * i / n));
      return value(end) <= 1e-6 * largest;
    }

    /** Warns of a force that ends. Collective. */
    template <int dim>
    void check_force(const LoadParameters &load, const Change &change,
                     const NodeMap<dim> &nodes, Checks &checks)
    {
      for (const NamedComponent &each : load.given_components())
      {
        if (each.component.quantity != LoadQuantity::force
            || (each.component.field
                    ? each.component.field->is_function_of_time()
                    : is_over(each.component.value, change)))
          continue;
        std::vector<std::string> places;
        for (const std::string &name : load.boundaries)
        {
          const auto others
              = others_at(name, load, change.stage, change.parameters);
          // Tractions that nothing follows may be meant to end.
          if ((load.type == LoadType::platen || is_driven(others))
              && !is_replaced(each.name, others)
              && has_blocks(name, load, change.absent, false, nodes))
            places.push_back(name);
        }
        for (const std::string &group : load.groups)
          if (!change.absent.count(group)
              && !is_replaced(each.name, others_at("", load, change.stage,
                                                   change.parameters)))
            places.push_back(group);
        if (places.empty())
          continue;
        checks.warn_if(true, "its 'Loads' do not name the load ", load.name,
                       ", ", load.type_text(), ", of stage ",
                       change.before.name,
                       ", and no other one gives its component ", each.name,
                       " at ", list_text(places),
                       ": it ends at once. Name it here, too, or give that "
                       "component in the "
                       "load that takes its place, if that is not meant.");
        return;
      }
    }

    /** Whether @p load stays what it is in @p stage. */
    bool is_steady(const LoadParameters &load, const StageParameters &stage,
                   const double start)
    {
      if (load.type == LoadType::boundary_elements)
        return stage.end != StageEnd::time;
      if (load.type == LoadType::platen
          || load.type == LoadType::prescribed_motion)
      {
        // Forces of platens may be constant.
        for (const NamedComponent &each : load.given_components())
          for (const TimePoint &time : times_of(stage, start))
            if (each.component.quantity != LoadQuantity::force
                && (each.component.field || each.component.value(time) != 0.))
              return false;
      }
      const auto given = load.given_components();
      return !load.shape
             && std::all_of(given.begin(), given.end(),
                            [](const NamedComponent &each)
                            {
                              const auto &field = each.component.field;
                              return each.component.value.is_constant()
                                     && !(field
                                          && field->is_function_of_time());
                            });
    }

    /** Whether equilibrium comes before stage @p first, and nothing changes
        from there on. */
    bool is_idle_from(const Parameters &parameters, const unsigned int first)
    {
      const StageParameters *before = previous_stage(parameters.stages, first);
      if (!before || before->release < 1. || !before->end_conditions.empty()
          || before->slows_loads() || before->pattern
          || (before->end == StageEnd::time && !parameters.is_implicit)
          || parameters.water.flow == FlowKind::transient)
        return false;
      for (unsigned int i = first; i < parameters.stages.size(); ++i)
      {
        const StageParameters &stage = parameters.stages[i];
        if (stage.safety || stage.pattern || !stage.excavate.empty()
            || !stage.fill.empty() || stage.changes_properties()
            || stage.strength_factor != before->strength_factor
            || parameters.water.acts_in(stage.name)
                   != parameters.water.acts_in(before->name))
          return false;
        const double start = start_of_stage(parameters.stages, i);
        for (const LoadParameters &load : parameters.loads)
          if (names_load(stage, load.name) != names_load(*before, load.name)
              || (names_load(stage, load.name)
                  && !is_steady(load, stage, start)))
            return false;
      }
      const auto &boundaries = parameters.water.boundaries;
      return parameters.water.flow == FlowKind::none
             || std::all_of(boundaries.begin(), boundaries.end(),
                            [](const WaterBoundary &boundary)
                            { return boundary.value.is_constant(); });
    }

    /** Warns of what the stage named @p name places, if it is for nothing. */
    void check_placed(const std::string &about, const std::string &name,
                      const std::string &bears, const Parameters &parameters,
                      Advice &advice)
    {
      for (unsigned int i = 0; i < parameters.stages.size(); ++i)
        if (parameters.stages[i].name == name)
          Checks(advice, about)
              .warn_if(is_idle_from(parameters, i), "stage ", name,
                       " places it in equilibrium, and nothing changes from "
                       "there on: no block comes or goes, forces of excavated "
                       "ones have been released before, and loads stay what "
                       "they were. It bears ",
                       bears,
                       ". Let it come earlier, or keep back a share of these "
                       "forces by 'Release' until it is there.");
    }
  } // namespace

  template <int dim>
  void check_ended_loads(const Parameters &parameters,
                         const NodeMap<dim> &nodes, Advice &advice)
  {
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage  = parameters.stages[i];
      const StageParameters *before = previous_stage(parameters.stages, i);
      // Other warnings speak of what searches for the factor of safety forget.
      if (!before || stage.safety)
        continue;
      const Change change = { parameters, stage, *before,
                              start_of_stage(parameters.stages,
                                             before - parameters.stages.data()),
                              absent_groups(parameters, i) };
      Checks checks(advice, "stage " + stage.name + ": ");
      for (const LoadParameters &load : parameters.loads)
      {
        if (!names_load(*before, load.name) || acts_in(load, stage))
          continue;
        if (load.type == LoadType::platen || load.type == LoadType::traction)
          check_force(load, change, nodes, checks);
        else if (!parameters.model.initial_stresses.empty()
                 && holds_still(load, *before, change.start_before))
          check_support(load, change, nodes, checks);
      }
    }
  }

  void check_late_supports(const Parameters &parameters, Advice &advice)
  {
    for (const CableParameters &cable : parameters.model.cables)
      if (cable.pretension == 0.)
        check_placed("reinforcement " + cable.name + ": ", cable.stage,
                     "nothing", parameters, advice);
    for (const BeamParameters &beam : parameters.beams)
    {
      const auto &loads = beam.distributed;
      const bool is_loaded
          = std::any_of(beam.forces.begin(), beam.forces.end(),
                        [](const std::array<TimeFunction, 2> &force)
                        {
                          return !force[0].is_constant()
                                 || !force[1].is_constant()
                                 || force[0]({ 0., 0. }) != 0.
                                 || force[1]({ 0., 0. }) != 0.;
                        })
            || std::any_of(
                loads.begin(), loads.end(),
                [](const TimeFunction &load) {
                  return !load.is_constant() || load({ 0., 0. }) != 0.;
                });
      if (!is_loaded)
        check_placed("beam " + beam.name + ": ", beam.stage,
                     "nothing but its own weight", parameters, advice);
    }
  }

  template void check_ended_loads(const Parameters &, const NodeMap<2> &,
                                  Advice &);
  template void check_ended_loads(const Parameters &, const NodeMap<3> &,
                                  Advice &);
} // namespace quoin
