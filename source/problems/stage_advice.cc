// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What input_advice.h says about stages.

#include <quoin/problems/input_advice.h>
#include <quoin/problems/model_summary.h>
#include <quoin/problems/shaking.h>
#include <quoin/problems/signal_frequency.h>
#include <quoin/base/number_text.h>
#include <quoin/dynamics/solver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    std::string of_stage(const StageParameters &stage)
    {
      return "stage " + stage.name + ": ";
    }

    /** Whether waves, not equilibria, are what a stage computes. */
    bool is_dynamic(const StageParameters &stage)
    {
      return stage.end == StageEnd::time && !stage.slows_loads()
             && stage.scaled_time_step == 0.
             && (stage.damping == DampingType::none
                 || stage.damping == DampingType::rayleigh);
    }

    bool brings_waves(const Parameters &parameters, const unsigned int index)
    {
      const StageParameters &stage = parameters.stages[index];
      const double start           = start_of_stage(parameters.stages, index);
      for (const std::string &name : stage.loads)
      {
        const LoadParameters *load = find_load(parameters, name);
        if (!load)
          continue;
        if (load->type == LoadType::boundary_elements
            && !parameters.boundary.waves.empty())
          return true;
        if (load->type == LoadType::viscous_boundary)
          for (const LoadComponent &component : load->components)
            if (component.quantity != LoadQuantity::free)
            {
              const auto values = sampled(
                  [&](const double t) {
                    return component.value({ t, start + t });
                  },
                  stage.duration, 1025);
              if (std::any_of(values.begin(), values.end(),
                              [](const double v) { return v != 0.; }))
                return true;
            }
      }
      return false;
    }

    void advise_about_damping(const Parameters &parameters,
                              const unsigned int index,
                              std::vector<std::string> &advice)
    {
      const StageParameters &stage = parameters.stages[index];
      if (stage.end == StageEnd::time
          && (stage.damping == DampingType::local
              || stage.damping == DampingType::adaptive)
          && brings_waves(parameters, index))
        advice.push_back(of_stage(stage)
                         + "waves come in, and "
                           "'Damping = local' or 'adaptive', which is meant "
                           "for equilibria, takes their energy. Take 'none' or "
                           "'Rayleigh'.");
    }

    void advise_about_mass_scaling(const StageParameters &stage,
                                   std::vector<std::string> &advice)
    {
      if (stage.scaled_time_step > 0. && stage.end == StageEnd::time
          && !stage.slows_loads()
          && (stage.damping == DampingType::none
              || stage.damping == DampingType::rayleigh))
        advice.push_back(of_stage(stage)
                         + "'Mass scaling' changes how the model moves, and "
                           "this stage follows its motion. Remove it: it is "
                           "for stages that seek an equilibrium, with 'Damping "
                           "= local' or 'adaptive'.");
    }

    /** Of dashpots under what is held: waves neither come in nor leave. */
    void advise_about_supports(const Parameters &parameters,
                               const StageParameters &stage,
                               std::vector<std::string> &advice)
    {
      for (const LoadParameters &held : parameters.loads)
        for (const LoadParameters &open : parameters.loads)
        {
          if (!names_load(stage, held.name) || !names_load(stage, open.name)
              || held.type != LoadType::prescribed_motion
              || (open.type != LoadType::viscous_boundary
                  && open.type != LoadType::free_field)
              || held.components[0].quantity == LoadQuantity::free
              || held.components[1].quantity == LoadQuantity::free)
            continue;
          for (const std::string &curve : open.boundaries)
            if (std::count(held.boundaries.begin(), held.boundaries.end(),
                           curve)
                > 0)
            {
              advice.push_back(of_stage(stage) + "the load " + held.name
                               + " prescribes the motion of the curve " + curve
                               + ", so the load " + open.name
                               + " there does nothing: no wave comes in or "
                                 "leaves. Take one of them out of 'Loads'.");
              break;
            }
        }
    }

    /**
     * Freedom @p d of all loads of @p stage that act where @p load does, in
     * the same way, at @p t of a stage that began at @p start [s].
     */
    double force_like(const Parameters &parameters,
                      const StageParameters &stage, const LoadParameters &load,
                      const unsigned int d, const double t, const double start)
    {
      double sum = 0.;
      for (const LoadParameters &other : parameters.loads)
        if (names_load(stage, other.name) && other.type == load.type
            && other.boundaries == load.boundaries
            && other.groups == load.groups
            && other.functions()[d].quantity == LoadQuantity::force)
          sum += other.functions()[d].value({ t, start + t });
      return sum;
    }

    /** Of a force; without height if there is none worth a word. */
    Jump jump_of(const Parameters &parameters, const unsigned int index,
                 const LoadParameters &load, const unsigned int d)
    {
      /** Share of the largest value that counts as a jump. */
      constexpr double smallest    = 0.2;
      const StageParameters &stage = parameters.stages[index];
      const double start           = start_of_stage(parameters.stages, index);
      const FunctionOfTime value   = [&](const double t)
      { return force_like(parameters, stage, load, d, t, start); };
      double largest = 0.;
      for (const double v : sampled(value, stage.duration, 1025))
        largest = std::max(largest, std::abs(v));
      Jump jump                     = largest_jump(value, stage.duration);
      const StageParameters *before = previous_stage(parameters.stages, index);
      double last                   = 0.;
      if (before && before->end == StageEnd::time)
        last = force_like(parameters, *before, load, d, before->duration,
                          start - before->duration);
      else if (before)
        last = force_like(parameters, *before, load, d, late_time, start);
      // At the start of the run it may be what the initial stress bears.
      const bool is_borne
          = index == 0 && !parameters.model.initial_stresses.empty();
      if (!is_borne && std::abs(value(0.) - last) > jump.height)
        jump = { 0., std::abs(value(0.) - last) };
      return jump.height > smallest * largest ? jump : Jump();
    }

    /** What moves with its weight alone is not shaken by it. */
    bool holds_anything(const Parameters &parameters,
                        const StageParameters &stage)
    {
      return std::any_of(stage.loads.begin(), stage.loads.end(),
                         [&](const std::string &name)
                         {
                           const LoadParameters *load
                               = find_load(parameters, name);
                           return load && load->type != LoadType::gravity
                                  && load->type != LoadType::traction
                                  && load->type != LoadType::initial_stress;
                         });
    }

    void advise_about_jumps(const Parameters &parameters,
                            const unsigned int index, const double rise,
                            std::vector<std::string> &advice)
    {
      const StageParameters &stage = parameters.stages[index];
      if (!is_dynamic(stage) || stage.stiffness_coefficient > 0.)
        return;
      for (const std::string &name : stage.loads)
      {
        const LoadParameters *load = find_load(parameters, name);
        if (!load
            || (load->type != LoadType::traction
                && load->type != LoadType::platen
                && !(load->type == LoadType::gravity
                     && holds_anything(parameters, stage))))
          continue;
        for (unsigned int d = 0; d < 3; ++d)
        {
          if (load->functions()[d].quantity != LoadQuantity::force)
            continue;
          const Jump jump = jump_of(parameters, index, *load, d);
          if (jump.height == 0.)
            continue;
          advice.push_back(
              of_stage(stage) + "the load " + name + " jumps by "
              + number_text(jump.height) + " at " + number_text(jump.time)
              + " s of an undamped stage: that excites frequencies which no "
                "mesh resolves. Let it rise over "
              + number_text(rise)
              + " s, what an S wave takes through ten edges, or more, or damp "
                "by 'Rayleigh' with a stiffness coefficient.");
          break;
        }
      }
    }

    /** Of the stage before, and not in this one. */
    void advise_about_lost_weight(const Parameters &parameters,
                                  const unsigned int index,
                                  std::vector<std::string> &advice)
    {
      const StageParameters &stage  = parameters.stages[index];
      const StageParameters *before = previous_stage(parameters.stages, index);
      const auto has_gravity        = [&](const StageParameters &any)
      {
        return std::any_of(parameters.loads.begin(), parameters.loads.end(),
                           [&](const LoadParameters &load) {
                             return load.type == LoadType::gravity
                                    && names_load(any, load.name);
                           });
      };
      if (before && has_gravity(*before) && !has_gravity(stage))
        advice.push_back(of_stage(stage)
                         + "its 'Loads' name no gravity, but stage "
                         + before->name
                         + " had some: the model becomes weightless at once. "
                           "Name the load here, too, if that is not meant.");
    }

    void advise_about_waves(const Parameters &parameters,
                            const unsigned int index,
                            const std::vector<CellSize> &sizes,
                            std::vector<std::string> &advice)
    {
      if (!is_dynamic(parameters.stages[index]))
        return;
      const Shaking shaking = fastest_load(parameters, index);
      // The material in which its waves have the fewest edges.
      unsigned int worst = 0;
      double fewest = std::numeric_limits<double>::infinity(), length = 0.;
      for (unsigned int m = 0; m < sizes.size(); ++m)
      {
        const double wave = wave_speeds(parameters.model.materials[m].elastic,
                                        parameters.model.plane)
                                .s
                            / shaking.frequency;
        if (sizes[m].edge > 0. && wave / sizes[m].edge < fewest)
        {
          worst  = m;
          fewest = wave / sizes[m].edge;
          length = wave;
        }
      }
      if (!(fewest < fewest_edges))
        return;
      const CellSize &size = sizes[worst];
      advice.push_back(
          of_stage(parameters.stages[index]) + shaking.name
          + " brings frequencies of up to " + number_text(shaking.frequency)
          + " Hz, whose S waves are " + number_text(length)
          + " m long in the material " + parameters.model.materials[worst].name
          + ". They need eight to ten edges, but edges are up to "
          + number_text(size.edge) + " m long, at ("
          + number_text(size.position[0]) + ", " + number_text(size.position[1])
          + ") m. Refine the mesh there to " + number_text(0.1 * length)
          + " m, or lower the frequency.");
    }
  } // namespace

  std::vector<CellSize> cell_sizes(const Model &model, const State<2> &state,
                                   const std::size_t n_materials)
  {
    const NodeMap<2> &nodes = model.nodes();
    std::vector<CellSize> sizes(n_materials);
    for (unsigned int c = 0; c < model.n_deformable_cells(); ++c)
    {
      if (state.is_absent(nodes.block_of_cell(c)))
        continue;
      const auto &[i, j, k] = nodes.cell(c);
      const auto &p = nodes.point(i), &q = nodes.point(j), &r = nodes.point(k);
      std::array<double, 3> edges{ { p.distance(q), q.distance(r),
                                     r.distance(p) } };
      std::sort(edges.begin(), edges.end());
      CellSize &size = sizes[model.material_of_cell(c)];
      if (edges[1] > size.edge)
        size = { edges[1], p };
    }
    // The largest of all ranks, of several the lowest rank's.
    for (CellSize &size : sizes)
      for (const CellSize &other :
           dealii::Utilities::MPI::all_gather(nodes.communicator(), size))
        if (other.edge > size.edge)
          size = other;
    return sizes;
  }

  std::vector<std::string> stage_advice(const Parameters &parameters,
                                        const unsigned int index,
                                        const Model &model,
                                        const State<2> &state,
                                        const double time_step)
  {
    std::vector<std::string> advice;
    const StageParameters &stage = parameters.stages[index];
    advise_about_damping(parameters, index, advice);
    advise_about_mass_scaling(stage, advice);
    advise_about_supports(parameters, stage, advice);
    advise_about_lost_weight(parameters, index, advice);
    const auto sizes
        = cell_sizes(model, state, parameters.model.materials.size());
    double rise = 0.;
    for (unsigned int m = 0; m < sizes.size(); ++m)
      if (sizes[m].edge > 0.)
        rise = std::max(rise,
                        10. * sizes[m].edge
                            / wave_speeds(parameters.model.materials[m].elastic,
                                          parameters.model.plane)
                                  .s);
    if (rise > 0.) // else nothing deforms
      advise_about_jumps(parameters, index, rise, advice);
    advise_about_waves(parameters, index, sizes, advice);
    if (index == 0 && parameters.history_interval > 0.
        && parameters.history_interval < time_step)
      advice.push_back(of_stage(stage) + "'Interval = "
                       + number_text(parameters.history_interval)
                       + "' in section 'Histories' is shorter than the time "
                         "step, "
                       + number_text(time_step)
                       + " s: rows come at every step. Take a longer one, or "
                         "0 if that is meant.");
    return advice;
  }
} // namespace quoin
