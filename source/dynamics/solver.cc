// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/point_text.h>
#include <quoin/operators/archive.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/free_bodies.h>
#include <quoin/model/material_waves.h>
#include <quoin/dynamics/solver.h>
#include <quoin/loads/free_field_boundary.h>
#include <quoin/loads/joint_crack.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/prescribed_motion.h>
#include <quoin/loads/viscous_boundary.h>
#include <quoin/water/joint_flow.h>
#include <quoin/mesh/global_geometry.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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
    : model(model), communicator(model.nodes().communicator())
  {
    const auto &nodes = model.nodes();
    for (const LoadParameters &load : loads)
    {
      known_loads.push_back(load.name);
      if (load.has_added_mass)
        loads_of_water.push_back(load.name);
      switch (load.type)
      {
      case LoadType::viscous_boundary:
        all_constraints.push_back(std::make_unique<ViscousBoundary<dim>>(
            load, nodes, impedance_beyond(model, load), model.thickness()));
        break;
      case LoadType::prescribed_motion:
        all_constraints.push_back(
            std::make_unique<PrescribedMotion<dim>>(load, nodes));
        break;
      case LoadType::traction:
      case LoadType::gravity:
        all_loads.emplace_back(load, nodes, model.mass(), model.thickness());
        if (load.pressure.field && load.pressure.field->uplift())
          add_uplift(load);
        break;
      case LoadType::platen:
        if constexpr (dim == 2)
          all_constraints.push_back(std::make_unique<Platen>(load, nodes));
        break;
      case LoadType::boundary_elements:
        if constexpr (dim == 2)
          add_far_fields(std::move(far_field), std::move(static_field));
        break;
      case LoadType::initial_stress:
      case LoadType::free_field:
        break;
      }
    }
    if constexpr (dim == 2)
      make_free_fields(loads);

    const State<dim> rest = model.initial_state();
    model.blocks().add_stored_energy(rest, stored_at_start);
    model.joints().add_stored_energy(rest, stored_at_start);
    sum_accounts(stored_at_start);
  }

  template <>
  void Solver<2>::add_far_fields(std::unique_ptr<FarField> far_field,
                                 std::unique_ptr<StaticFarField> static_field)
  {
    far.elastodynamic = far_field.get();
    if (far_field)
      all_constraints.push_back(std::move(far_field));
    far.elastostatic = static_field.get();
    if (static_field)
      all_constraints.push_back(std::move(static_field));
  }

  template <>
  void Solver<2>::add_uplift(const LoadParameters &load)
  {
    const UpliftDiagram &diagram = *load.pressure.field->uplift();
    if (!diagram.enters_cracks)
      return;
    const std::string section
        = "section 'Loads/" + load.name + "': 'In cracks = full head' ";
    if (model.parameters().large_displacements)
      throw InputError(section
                       + "needs joints of the mesh, but with 'Displacements = "
                         "large' they become contacts. Take 'small' in section "
                         "'Contact', or 'given'.");
    all_loads.back().set_crack(std::make_shared<JointCrack>(
        diagram, load.boundaries, load.name, model.nodes(), model.joints()));
  }

  template <>
  void Solver<3>::add_uplift(const LoadParameters &load)
  {
    throw InputError("section 'Loads/" + load.name
                     + "': 'Pressure = uplift' is known in two dimensions "
                       "alone. Give the pressure as a function of the place.");
  }

  template <>
  void Solver<2>::make_free_fields(const std::vector<LoadParameters> &loads)
  {
    for (const LoadParameters &load : loads)
    {
      if (load.type != LoadType::free_field)
        continue;
      const auto base = std::find_if(loads.begin(), loads.end(),
                                     [&](const LoadParameters &other)
                                     { return other.name == load.base; });
      if (base == loads.end()
          || (base->type != LoadType::viscous_boundary
              && base->type != LoadType::prescribed_motion))
        throw InputError("section 'Loads/" + load.name
                         + "': 'Base = " + load.base
                         + "' must name the load that drives the base of the "
                           "model, of type 'viscous boundary' or 'prescribed "
                           "motion'.");
      if (base->differs_by_place())
        throw InputError("section 'Loads/" + load.name
                         + "': 'Base = " + load.base
                         + "' is a motion that differs from place to place, "
                           "but waves in the column beside the model are those "
                           "of one motion. Give the base a function of time "
                           "alone.");
      all_constraints.push_back(std::make_unique<FreeFieldBoundary>(
          load, model.nodes(), free_field_ground(model),
          FreeFieldBase{ *base, impedance_beyond(model, *base) }));
    }
  }

  template <int dim>
  void Solver<dim>::activate(const StageParameters &new_stage,
                             const State<dim> &state)
  {
    stage = new_stage;
    if constexpr (dim == 2)
    {
      far.elastodynamic_acts
          = far.elastodynamic && acts_in(*far.elastodynamic, stage);
      far.elastostatic_acts
          = far.elastostatic && acts_in(*far.elastostatic, stage);
    }
    for (const std::string &name : stage.loads)
      if (std::find(known_loads.begin(), known_loads.end(), name)
          == known_loads.end())
        throw InputError("section 'Stages/" + stage.name + "': 'Loads' names '"
                         + name + "', which is no load. Loads are: "
                         + known_names_like(name, known_loads) + ".");

    for (const auto &constraint : all_constraints)
      if (names_load(stage, constraint->name())
          && !constraint->traits().companion.empty()
          && !names_load(stage, constraint->traits().companion))
        throw InputError(
            "section 'Stages/" + stage.name + "': 'Loads' names '"
            + constraint->name() + "', whose columns stand on the base '"
            + constraint->traits().companion + "', but not that. Add it.");

    if (stage.slows_loads())
      for (const auto &constraint : all_constraints)
        if (constraint->traits().kind == MotionKind::absorbing
            && acts_in(*constraint, stage))
          throw InputError("section 'Stages/" + stage.name
                           + "': 'Kinetic energy limit' slows loads down, "
                             "which waves through the boundary of the load '"
                           + constraint->name()
                           + "' cannot follow. Set it to 0, or use that load "
                             "in another stage.");

    acting.constraints.clear();
    for (const auto &constraint : all_constraints)
      if (acts_in(*constraint, stage))
        acting.constraints.push_back(constraint.get());
    std::stable_sort(acting.constraints.begin(), acting.constraints.end(),
                     [](const auto *a, const auto *b)
                     { return a->traits().kind < b->traits().kind; });
    refuse_absent_nodes(state);
    acting.nodal.clear();
    for (NodalLoad<dim> &load : all_loads)
    {
      load.set_mass(model.mass());
      load.begin_stage(false, 0.);
      load.find_crack(state);
    }
    for (const NodalLoad<dim> &load : all_loads)
      if (names_load(stage, load.name()))
        acting.nodal.push_back(&load);

    if constexpr (dim == 2)
      if (all_beams)
        all_beams->set_gravity(acting.nodal);
    acting.beams = all_beams.get();
    acting.pattern.reset();
    if (stage.pattern)
    {
      const auto found = controls.find(stage.name);
      acting.pattern   = std::make_shared<LoadPattern<dim>>(
          model, stage, all_loads, acting.constraints,
          found == controls.end() ? nullptr : &found->second, state);
    }

    // With large displacements blocks may rest on others without a joint.
    if (stage.end == StageEnd::static_ratio
        && !model.parameters().large_displacements)
      check_no_free_bodies(model, acting.constraints, stage.name, state);
  }

  template <int dim>
  void Solver<dim>::ramp_gravity(const StageParameters *previous,
                                 const double automatic)
  {
    const auto begins = [&](const NodalLoad<dim> &load)
    {
      return names_load(stage, load.name())
             && !(previous && names_load(*previous, load.name()));
    };
    double ramp = 0.;
    for (NodalLoad<dim> &load : all_loads)
      if (load.is_weight())
      {
        load.begin_stage(begins(load), automatic);
        ramp = std::max(ramp, load.ramp());
      }
    // Pressure that is in joints before the weight which closes them throws
    // blocks up.
    for (NodalLoad<dim> &load : all_loads)
      if (load.is_in_joints())
        load.begin_stage(begins(load), ramp);
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
  bool Solver<dim>::acts_in(const MotionConstraint<dim> &constraint,
                            const StageParameters &any) const
  {
    if constexpr (dim == 2)
    {
      const bool is_static = any.end == StageEnd::static_ratio;
      if ((&constraint == far.elastodynamic && is_static)
          || (&constraint == far.elastostatic && far.elastodynamic
              && !is_static))
        return false;
    }
    return names_load(any, constraint.name());
  }

  template <int dim>
  void Solver<dim>::prepare(State<dim> &state) const
  {
    for (const auto &constraint : all_constraints)
      constraint->prepare(state);
    if constexpr (dim == 2)
      if (all_beams)
        all_beams->prepare(state);
    state.template add<LoadPatternState>();
    if constexpr (dim == 2)
      if (water)
        water->prepare(state);
  }

  template <int dim>
  void Solver<dim>::refuse_absent_nodes(const State<dim> &state) const
  {
    const auto absent = absent_nodes(model, state);
    for (const MotionConstraint<dim> *constraint : acting.constraints)
    {
      if (constraint->traits().kind == MotionKind::prescribed)
        continue;
      unsigned int first = NodeMap<dim>::none;
      for (const unsigned int node : constraint->nodes())
        if (absent[node])
          first = std::min(first, node);
      dealii::Point<dim> p;
      if (!first_point(model.nodes(), first, p))
        continue;
      throw InputError(
          "section 'Stages/" + stage.name + "': the load '" + constraint->name()
          + "' moves the node at " + point_text(p)
          + " m, but the block there is excavated or not placed yet. Of loads "
            "that move nodes only prescribed motions leave such blocks alone: "
            "take the load out of this stage, or let it end where the blocks "
            "do.");
    }
  }

  template <>
  std::vector<bool> Solver<2>::find_held_blocks() const
  {
    constexpr unsigned int none = NodeMap<2>::none;
    const RigidBlocks &rigid    = model.rigid_blocks();
    std::vector<bool> held(rigid.n_blocks(), false);
    for (const MotionConstraint<2> *constraint : acting.constraints)
    {
      const auto &nodes  = constraint->nodes();
      unsigned int wrong = none;
      for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      {
        const RigidBlocks::Block &block = rigid.block(b);
        const auto first
            = std::lower_bound(nodes.begin(), nodes.end(), block.begin);
        const auto last = std::lower_bound(first, nodes.end(), block.end);
        if (first == last)
          continue;
        if (constraint->traits().is_rigid_body()
            && last - first == block.end - block.begin)
          held[b] = true;
        else if (wrong == none)
          wrong = *first;
      }
      dealii::Point<2> p;
      if (!first_point(model.nodes(), wrong, p))
        continue;
      throw InputError(
          "section 'Stages/" + stage.name + "': the load '" + constraint->name()
          + "' moves the node at " + point_text(p)
          + " m by itself, but its block is rigid. Hold or drive rigid blocks "
            "as a whole, by a load with 'Type = platen' and their 'Group', or "
            "make the block deformable.");
    }
    return held;
  }

  template <int dim>
  void Solver<dim>::refuse_shared_platens() const
  {
    for (const MotionConstraint<dim> *a : acting.constraints)
      for (const MotionConstraint<dim> *b : acting.constraints)
      {
        if (a == b || !a->traits().is_rigid_body()
            || !b->traits().is_rigid_body())
          continue;
        std::vector<unsigned int> shared;
        std::set_intersection(a->nodes().begin(), a->nodes().end(),
                              b->nodes().begin(), b->nodes().end(),
                              std::back_inserter(shared));
        dealii::Point<dim> p;
        if (!first_point(model.nodes(),
                         shared.empty() ? NodeMap<dim>::none : shared.front(),
                         p))
          continue;
        throw InputError("section 'Stages/" + stage.name + "': the platens '"
                         + a->name() + "' and '" + b->name()
                         + "' share the node at " + point_text(p)
                         + " m. A node can belong to one rigid platen: use one "
                           "of them, or leave a gap.");
      }
  }

  template <int dim>
  void Solver<dim>::save(State<dim> &state) const
  {
    if constexpr (dim == 2)
      if (far.elastodynamic)
        far.elastodynamic->save(state);
  }

  template <int dim>
  void Solver<dim>::discard_saved(State<dim> &state) const
  {
    if (far.elastodynamic)
      state.template get<FarFieldState>().history = {};
  }

  template <int dim>
  void Solver<dim>::check_finite(const State<dim> &state) const
  {
    unsigned int bad     = NodeMap<dim>::none;
    const unsigned int n = model.nodes().n_owned();
    for (unsigned int i = 0; i < n && bad == NodeMap<dim>::none; ++i)
      for (const double u : state.nodes[i].u)
        if (!(std::abs(u) < 1e100)) // a comparison with NaN is false
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
    for (const auto &constraint : all_constraints)
      constraint->add_stored_energy(state, stored);
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
  std::array<double, 3> Solver<dim>::resultant(const std::string &load) const
  {
    const MotionConstraint<dim> *idle = nullptr; // of two with one name
    if constexpr (dim == 2)
    {
      if (far.elastostatic_acts)
        idle = far.elastodynamic;
      else
        idle = far.elastostatic;
    }
    for (const auto &constraint : all_constraints)
      if (constraint->name() == load && constraint.get() != idle)
      {
        auto values = constraint->resultant();
        if (!constraint->traits().is_rigid_body())
          MPI_Allreduce(MPI_IN_PLACE, values.data(), 3, MPI_DOUBLE, MPI_SUM,
                        communicator);
        return values;
      }
    throw InputError("'" + load
                     + "' is no prescribed motion, platen, viscous or "
                       "free-field boundary, so it has no reaction.");
  }

  template class Solver<2>;
  template class Solver<3>;
} // namespace quoin
