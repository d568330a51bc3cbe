// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/point_text.h>
#include <quoin/operators/archive.h>
#include <quoin/model/free_bodies.h>
#include <quoin/dynamics/solver.h>
#include <quoin/loading/constraint_checks.h>
#include <quoin/loading/load_growth.h>
#include <quoin/water/joint_flow.h>
#include <quoin/mesh/global_geometry.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  double Energies::throughput() const
  {
    /** Share of what is stored at the start that may be rounding. */
    constexpr double rounding = 1e-10;
    return std::max({ std::abs(sum(EnergyKind::given)), sum(EnergyKind::stored),
                      sum(EnergyKind::dissipated), rounding * at_start });
  }

  template <int dim>
  Solver<dim>::Solver(Model<dim> &model,
                      const std::vector<LoadParameters> &loads,
                      std::unique_ptr<FarField> far_field,
                      std::unique_ptr<StaticFarField> static_field)
    : model(model), communicator(model.nodes().communicator()),
      all(model, loads, std::move(far_field), std::move(static_field))
  {
    const State<dim> rest = model.initial_state();
    model.blocks().add_stored_energy(rest, stored_at_start);
    model.joints().add_stored_energy(rest, stored_at_start);
    sum_accounts(stored_at_start);
  }

  template <int dim>
  void Solver<dim>::activate(const StageParameters &new_stage,
                             const StageParameters *previous,
                             const State<dim> &state)
  {
    stage = new_stage;
    if constexpr (dim == 2)
    {
      all.far.elastodynamic_acts
          = all.far.elastodynamic && all.acts_in(*all.far.elastodynamic, stage);
      all.far.elastostatic_acts
          = all.far.elastostatic && all.acts_in(*all.far.elastostatic, stage);
    }
    all.check(stage);
    all.follow_materials(model, stage, previous);
    acting.constraints.clear();
    for (const auto &constraint : all.constraints)
      if (all.acts_in(*constraint, stage))
        acting.constraints.push_back(constraint.get());
    std::stable_sort(acting.constraints.begin(), acting.constraints.end(),
                     [](const auto *a, const auto *b)
                     { return a->traits().kind < b->traits().kind; });
    refuse_absent_nodes(model, acting.constraints, stage, state);
    acting.nodal.clear();
    for (NodalLoad<dim> &load : all.nodal)
    {
      load.set_mass(model.mass());
      load.begin_stage(false, {});
      load.follow(state);
      // The loads of a pattern are constant, in a resumed stage, too.
      if (stage.pattern && is_among(load.name(), stage.pattern->loads))
        load.return_to_mesh();
    }
    for (const NodalLoad<dim> &load : all.nodal)
      if (names_load(stage, load.name()))
      {
        load.pressed_joints().refuse_bared_sides(load.name(), stage.name,
                                                 state);
        acting.nodal.push_back(&load);
      }

    if constexpr (dim == 2)
      if (all.beams)
        all.beams->set_gravity(acting.nodal);
    acting.beams = all.beams.get();
    acting.water = all.water && all.water->parameters().acts_in(stage.name)
                       ? all.water
                       : nullptr;
    acting.pattern.reset();
    if (stage.pattern)
    {
      const auto found = all.controls.find(stage.name);
      acting.pattern   = std::make_shared<LoadPattern<dim>>(
          model, stage, all.nodal, acting.constraints,
          found == all.controls.end() ? nullptr : &found->second, state);
    }

    if (stage.end == StageEnd::static_ratio)
      acting.refuse_endless_motion(stage, state.time);
    // With large displacements blocks may rest on others without a joint.
    if (stage.end == StageEnd::static_ratio
        && !model.parameters().large_displacements)
      check_no_free_bodies(model, acting.constraints, stage.name, state);
  }

  template <int dim>
  bool Solver<dim>::begins(const std::string &load,
                           const StageParameters *previous) const
  {
    return names_load(stage, load)
           && !(previous && names_load(*previous, load));
  }

  template <int dim>
  void Solver<dim>::begin_growth(const StageParameters *previous,
                                 const double automatic, State<dim> &state)
  {
    LoadGrowth &growth = state.template get<LoadGrowth>();
    growth.nodal.resize(all.nodal.size());
    growth.constraints.resize(all.constraints.size());
    // What was left at the end of the stage before.
    const auto rest = [&](const std::string &load, const Growth &before) {
      return names_load(stage, load) ? before.after(state.load_time) : Growth();
    };
    const auto begin_load = [&](const std::size_t i, const double duration)
    {
      NodalLoad<dim> &load   = all.nodal[i];
      const bool begins_here = begins(load.name(), previous);
      growth.nodal[i]        = begins_here
                                   ? Growth{ load.ramp_where_begun(duration), 0. }
                                   : rest(load.name(), growth.nodal[i]);
      load.begin_stage(begins_here, growth.nodal[i]);
    };
    double ramp = 0.;
    for (std::size_t i = 0; i < all.nodal.size(); ++i)
      if (all.nodal[i].traits().is_gravity)
      {
        begin_load(i, automatic);
        ramp = std::max(ramp, growth.nodal[i].rest());
      }
    // Pressure that is in joints before the weight which closes them throws
    // blocks up, and a thrust makes them slip.
    const double with_it
        = stage.end == StageEnd::static_ratio
                  && model.parameters().initial_stresses.empty()
              ? ramp
              : 0.;
    for (std::size_t i = 0; i < all.nodal.size(); ++i)
      if (!all.nodal[i].traits().is_gravity)
        begin_load(i, all.nodal[i].pressed_joints().exist() ? ramp : with_it);
    for (std::size_t i = 0; i < all.constraints.size(); ++i)
    {
      const std::string &load = all.constraints[i]->name();
      growth.constraints[i]   = begins(load, previous)
                                    ? Growth{ with_it, 0. }
                                    : rest(load, growth.constraints[i]);
      all.constraints[i]->grow_forces(growth.constraints[i]);
    }
    if constexpr (dim == 2)
      if (all.beams)
      {
        growth.beams.resize(all.beams->all().size());
        for (unsigned int b = 0; b < growth.beams.size(); ++b)
          growth.beams[b] = all.beams->is_placed_by(b, stage.name, !previous)
                                ? Growth{ with_it, 0. }
                                : growth.beams[b].after(state.load_time);
        all.beams->grow_loads(growth.beams);
      }
  }

  template <int dim>
  void Solver<dim>::resume_growth(const StageParameters *previous,
                                  const State<dim> &state)
  {
    const LoadGrowth &growth = state.template get<LoadGrowth>();
    for (std::size_t i = 0; i < all.nodal.size(); ++i)
      all.nodal[i].begin_stage(begins(all.nodal[i].name(), previous),
                               growth.nodal[i]);
    for (std::size_t i = 0; i < all.constraints.size(); ++i)
      all.constraints[i]->grow_forces(growth.constraints[i]);
    if constexpr (dim == 2)
      if (all.beams)
        all.beams->grow_loads(growth.beams);
  }

  template <int dim>
  void Solver<dim>::begin_pattern(const StageParameters *previous,
                                  State<dim> &state) const
  {
    LoadPatternState &own = state.template get<LoadPatternState>();
    const bool goes_on    = stage.pattern && previous && previous->pattern
                         && previous->pattern->loads == stage.pattern->loads;
    own = acting.pattern
              ? acting.pattern->begin(goes_on ? own.factor : 0., state.nodes)
              : LoadPatternState();
  }

  template <int dim>
  void Solver<dim>::prepare(State<dim> &state) const
  {
    for (const auto &constraint : all.constraints)
      constraint->prepare(state);
    if constexpr (dim == 2)
      if (all.beams)
        all.beams->prepare(state);
    state.template add<LoadPatternState>();
    state.template add<LoadGrowth>();
    if constexpr (dim == 2)
      if (all.water)
        all.water->prepare(state);
  }

  template <int dim>
  void Solver<dim>::cut_liners(const std::vector<unsigned int> &blocks,
                               State<dim> &state)
  {
    if constexpr (dim == 2)
      if (all.beams)
        all.beams->cut(blocks, state);
  }

  template <int dim>
  void Solver<dim>::add_water_between(const std::vector<unsigned int> &blocks,
                                      const State<dim> &state,
                                      dealii::Tensor<1, dim> *force) const
  {
    if constexpr (dim == 2)
      if (all.water)
        all.water->add_forces_between(blocks, growing_water(state), state,
                                      force);
  }

  template <int dim>
  std::vector<GrowingWater>
  Solver<dim>::growing_water(const State<dim> &state) const
  {
    std::vector<GrowingWater> result;
    for (const PlacedGrowth &each : state.template get<LoadGrowth>().placed)
      result.push_back({ each.blocks, each.growth });
    return result;
  }

  template <int dim>
  void Solver<dim>::save(State<dim> &state) const
  {
    if constexpr (dim == 2)
      if (all.far.elastodynamic)
        all.far.elastodynamic->save(state);
  }

  template <int dim>
  void Solver<dim>::discard_saved(State<dim> &state) const
  {
    if (all.far.elastodynamic)
      state.template get<FarFieldState>().history = {};
  }

  template <int dim>
  void Solver<dim>::check_finite(const State<dim> &state) const
  {
    unsigned int bad     = NodeMap<dim>::none;
    const unsigned int n = model.nodes().n_owned();
    for (unsigned int i = 0; i < n && bad == NodeMap<dim>::none; ++i)
      if (!(state.nodes[i].u.norm() < 1e100)) // a comparison with NaN is false
        bad = i;
    dealii::Point<dim> p;
    unsigned int block = 0;
    if (!first_point(model.nodes(), bad, p, &block))
      return;
    acting.check_finite(stage, state, state.load_time);
    std::ostringstream message;
    message << "the motion is no longer finite in block " << block << " at "
            << point_text(p) << " m, found at time " << state.time
            << " s, step " << state.step
            << ". The usual causes are a load that grows "
            << "without bound, a value that is not a number in a function of "
            << "time, or a collapse: look at the last fields, reduce 'Share "
            << "of critical time step' or end the stage earlier. The last "
            << "checkpoint is kept.";
    throw RunError(message.str());
  }

  template <int dim>
  double Solver<dim>::sum(const double value) const
  {
    return dealii::Utilities::MPI::sum(value, communicator);
  }

  template <int dim>
  void Solver<dim>::sum_accounts(EnergyAccounts &energies) const
  {
    std::vector<double> values;
    for (const EnergyAccount &account : energy_accounts)
      values.push_back(energies.*account.value);
    dealii::Utilities::MPI::sum(values, communicator, values);
    unsigned int i = 0;
    for (const EnergyAccount &account : energy_accounts)
      energies.*account.value = values[i++];
  }

  template <int dim>
  void Solver<dim>::find_energies(const State<dim> &state,
                                  EnergyAccounts stored)
  {
    if constexpr (dim == 2)
      if (all.far.elastostatic)
        all.far.elastostatic->add_stored_energy(state, stored);
    stored += state.energy;
    sum_accounts(stored);
    last_energies.at_start = 0.;
    for (const EnergyAccount &account : energy_accounts)
    {
      const double at_start        = stored_at_start.*account.value;
      last_energies.*account.value = stored.*account.value - at_start;
      last_energies.at_start += std::abs(at_start);
    }
  }

  template <int dim>
  Resultant<dim> Solver<dim>::resultant(const std::string &load) const
  {
    return all.resultant(load, communicator);
  }

  template class Solver<2>;
  template class Solver<3>;
} // namespace quoin
