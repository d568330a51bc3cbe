// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What ExplicitSolver does where a stage begins; explicit_solver.cc has its
// steps.

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/free_bodies.h>
#include <quoin/dynamics/loading_rate.h>
#include <quoin/loads/free_field_boundary.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace quoin
{
  namespace
  {
    bool contains(const std::vector<std::string> &names,
                  const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }
  } // namespace

  void ExplicitSolver::activate(const StageParameters &new_stage)
  {
    stage = new_stage;
    for (const std::string &name : stage.loads)
      if (!contains(known_loads, name))
      {
        std::string known;
        for (const auto &load : known_loads)
          known += (known.empty() ? "" : ", ") + load;
        throw InputError("section 'Stages/" + stage.name + "': 'Loads' names '"
                         + name + "', which is no load. Loads are: " + known
                         + ".");
      }

    for (const auto &constraint : all_constraints)
      if (contains(stage.loads, constraint->name())
          && !constraint->companion().empty()
          && !contains(stage.loads, constraint->companion()))
        throw InputError(
            "section 'Stages/" + stage.name + "': 'Loads' names '"
            + constraint->name() + "', whose columns stand on the base '"
            + constraint->companion() + "', but not that. Add it.");

    if (stage.slows_loads())
      for (const auto &constraint : all_constraints)
        if (constraint->moves_all() && !constraint->is_global()
            && acts_in(*constraint, stage))
          throw InputError("section 'Stages/" + stage.name
                           + "': 'Kinetic energy limit' slows loads down, "
                             "which waves through the boundary of the load '"
                           + constraint->name()
                           + "' cannot follow. Set it to 0, or use that load "
                             "in another stage.");

    // Viscous boundaries act first, so that what is prescribed prevails;
    // platens last, because they move all of their nodes.
    constraints_on.clear();
    for (const int rank : { 0, 1, 2 })
      for (const auto &constraint : all_constraints)
        if (acts_in(*constraint, stage)
            && rank
                   == (dynamic_cast<Platen *>(constraint.get()) ? 2
                       : constraint->moves_all()                ? 0
                                                                : 1))
          constraints_on.push_back(constraint.get());
    loads_on.clear();
    for (const NodalLoad &load : all_loads)
      if (contains(stage.loads, load.name()))
        loads_on.push_back(&load);

    // With large displacements blocks may rest on others without a joint.
    if (stage.end == StageEnd::static_ratio && !model.large_displacements())
      check_no_free_bodies(model, constraints_on, stage.name);
  }

  bool ExplicitSolver::acts_in(const NodeConstraint &constraint,
                               const StageParameters &any) const
  {
    const bool is_static = any.end == StageEnd::static_ratio;
    return contains(any.loads, constraint.name())
           && !(&constraint == far && is_static)
           && !(&constraint == static_far && !is_static);
  }

  void ExplicitSolver::scale_masses(const StageParameters &stage, State &state)
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    rigid_stage.mass_factor.resize(rigid.n_blocks(), 1.);
    const auto kinetic = [&]()
    {
      double energy = rigid.kinetic_energy(rigid_stage, state.rigid_blocks,
                                           state.rigid_blocks, 1.);
      for (unsigned int i = 0; i < model.n_deformable_nodes(); ++i)
        energy += 0.5 * mass[i]
                  * (state.velocity[i].v[0] * state.velocity[i].v[0]
                     + state.velocity[i].v[1] * state.velocity[i].v[1]);
      return energy;
    };

    const double before = kinetic();
    double own = 0., scaled = 0.;
    mass = model.mass();
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
    {
      double &factor = rigid_stage.mass_factor[b];
      factor         = stage.scaled_time_step > 0.
                           ? model.stability().rigid_factor(b, stage.scaled_time_step)
                           : 1.;
      for (unsigned int i = rigid.block(b).begin; i < rigid.block(b).end; ++i)
      {
        own += mass[i];
        mass[i] *= factor;
        scaled += mass[i];
      }
    }
    for (unsigned int i = 0; i < model.n_deformable_nodes(); ++i)
    {
      own += mass[i];
      if (stage.scaled_time_step > 0.)
        mass[i] = std::max(
            mass[i], model.stability().mass_for(i, stage.scaled_time_step));
      scaled += mass[i];
    }
    added_mass = sum(scaled) / sum(own) - 1.;
    // Giving moving nodes another mass is work done from outside.
    state.energy.external += kinetic() - before;

    double eigenvalue
        = model.stability().largest_eigenvalue(mass, rigid_stage.mass_factor);
    for (const NodeConstraint *constraint : constraints_on)
      eigenvalue = std::max(eigenvalue, constraint->largest_eigenvalue());
    critical_step = StableTimeStep::critical(
        dealii::Utilities::MPI::max(eigenvalue, communicator),
        stage.stiffness_coefficient);
    for (NodeConstraint *constraint : constraints_on)
      if (auto *platen = dynamic_cast<Platen *>(constraint))
      {
        double inertia = 0., spin = 0.;
        for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        {
          const RigidBlocks::Block &block = rigid.block(b);
          if (!std::binary_search(platen->nodes().begin(),
                                  platen->nodes().end(), block.begin))
            continue;
          const double factor = rigid_stage.mass_factor[b];
          const double omega  = state.rigid_blocks[b].velocity[2];
          inertia += factor * (block.inertia - block.lumped_inertia);
          // Velocities of nodes are those of the mean arm of the last step.
          const double mean
              = 0.5 * (1. + std::cos(omega * state.previous_time_step));
          spin
              += factor * (block.inertia - mean * block.lumped_inertia) * omega;
        }
        platen->set_mass(mass, inertia, spin);
      }
  }

  void ExplicitSolver::collect_constrained_nodes(const State &state)
  {
    std::vector<unsigned int> nodes;
    for (const NodeConstraint *constraint : constraints_on)
      nodes.insert(nodes.end(), constraint->nodes().begin(),
                   constraint->nodes().end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());

    captured.assign(nodes.size(), CapturedNode{});
    for (unsigned int c = 0; c < nodes.size(); ++c)
    {
      captured[c].node     = nodes[c];
      captured[c].mass     = mass[nodes[c]];
      captured[c].owner[0] = captured[c].owner[1] = nullptr;
    }
    for (NodeConstraint *constraint : constraints_on)
    {
      std::vector<unsigned int> positions;
      for (const unsigned int node : constraint->nodes())
      {
        positions.push_back(std::lower_bound(nodes.begin(), nodes.end(), node)
                            - nodes.begin());
        for (unsigned int d = 0; d < 2; ++d)
          if (constraint->moves_all() || constraint->holds()[d])
            captured[positions.back()].owner[d] = constraint;
      }
      constraint->bind(std::move(positions));
    }

    refuse_shared_platens();
    find_held_blocks();

    captured_begin.clear();
    for (unsigned int tile = 0; tile < model.blocks().n_tiles(); ++tile)
      captured_begin.push_back(
          std::lower_bound(nodes.begin(), nodes.end(),
                           model.blocks().tile_nodes(tile).begin)
          - nodes.begin());
    captured_begin.push_back(
        std::lower_bound(nodes.begin(), nodes.end(), model.n_deformable_nodes())
        - nodes.begin());

    moving_mass = mass;
    inverse_mass.resize(mass.size());
    for (unsigned int i = 0; i < mass.size(); ++i)
      inverse_mass[i] = 1. / mass[i];
    for (const unsigned int node : nodes)
      moving_mass[node] = inverse_mass[node] = 0.;
    find_moved_blocks(state);
    hold_removed_blocks(state);
  }

  void ExplicitSolver::find_held_blocks()
  {
    constexpr unsigned int none = -1;
    const RigidBlocks &rigid    = model.rigid_blocks();
    rigid_stage.held.assign(rigid.n_blocks(), false);
    for (const NodeConstraint *constraint : constraints_on)
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
        if (constraint->is_global() && last - first == block.end - block.begin)
          rigid_stage.held[b] = true;
        else if (wrong == none)
          wrong = model.exchange().global(*first);
      }
      wrong = dealii::Utilities::MPI::min(wrong, communicator);
      if (wrong == none)
        continue;
      const auto &p = model.mesh().vertices[wrong];
      std::ostringstream message;
      message << "section 'Stages/" << stage.name << "': the load '"
              << constraint->name() << "' moves the node at (" << p[0] << ", "
              << p[1]
              << ") m by itself, but its block is rigid. Hold or drive rigid "
                 "blocks as a whole, by a load with 'Type = platen' and their "
                 "'Group', or make the block deformable.";
      throw InputError(message.str());
    }
  }

  void ExplicitSolver::refuse_shared_platens() const
  {
    constexpr unsigned int none = -1;
    for (const NodeConstraint *a : constraints_on)
      for (const NodeConstraint *b : constraints_on)
      {
        if (a == b || !a->is_global() || !b->is_global())
          continue;
        std::vector<unsigned int> shared;
        std::set_intersection(a->nodes().begin(), a->nodes().end(),
                              b->nodes().begin(), b->nodes().end(),
                              std::back_inserter(shared));
        const unsigned int first = dealii::Utilities::MPI::min(
            shared.empty() ? none : model.exchange().global(shared.front()),
            communicator);
        if (first == none)
          continue;
        const auto &p = model.mesh().vertices[first];
        std::ostringstream message;
        message << "section 'Stages/" << stage.name << "': the platens '"
                << a->name() << "' and '" << b->name()
                << "' share the node at (" << p[0] << ", " << p[1]
                << ") m. A node can belong to one rigid platen: use one of "
                   "them, or leave a gap.";
        throw InputError(message.str());
      }
  }

  void ExplicitSolver::begin_stage(const StageParameters &new_stage,
                                   const StageParameters *previous,
                                   State &state)
  {
    activate(new_stage);
    scale_masses(stage, state);
    unsigned int n_platens = 0, n_viscous = 0, n_free_fields = 0;
    for (const auto &constraint : all_constraints)
    {
      n_platens += dynamic_cast<const Platen *>(constraint.get()) != nullptr;
      n_viscous
          += dynamic_cast<const ViscousBoundary *>(constraint.get()) != nullptr;
      n_free_fields += dynamic_cast<const FreeFieldBoundary *>(constraint.get())
                       != nullptr;
    }
    state.platens.resize(n_platens);
    state.viscous_boundaries.resize(n_viscous);
    state.free_fields.resize(n_free_fields);
    loads_begun.clear();
    for (const NodalLoad *load : loads_on)
      if (previous && !contains(previous->loads, load->name()))
        loads_begun.push_back(load);
    for (const auto &constraint : all_constraints)
      if (!acts_in(*constraint, stage))
      {
        constraint->rest();
        if (const auto *platen = dynamic_cast<const Platen *>(constraint.get()))
          state.platens[platen->index()].active = false;
      }
    for (NodeConstraint *constraint : constraints_on)
      constraint->begin_stage(state,
                              previous && acts_in(*constraint, *previous));
    collect_constrained_nodes(state);
    state.stage_start      = state.time;
    state.stage_step       = 0;
    state.load_time        = 0.;
    state.load_rate        = stage.slows_loads() ? loading_rate::start : 1.;
    state.load_rate_growth = 1.;
    state.adaptive_damping = 0.;
    state.unbalanced_ratio = 1.;
  }

  void ExplicitSolver::resume_stage(const StageParameters &resumed,
                                    State &state)
  {
    activate(resumed);
    const State saved = state;
    scale_masses(stage, state);
    for (NodeConstraint *constraint : constraints_on)
      constraint->resume_stage(state);
    state = saved;
    collect_constrained_nodes(state);
  }

  bool ExplicitSolver::far_field_acts() const
  {
    return far && acts_in(*far, stage);
  }

  bool ExplicitSolver::static_far_field_acts() const
  {
    return static_far && acts_in(*static_far, stage);
  }

  void ExplicitSolver::save(State &state) const
  {
    for (const auto &constraint : all_constraints)
      constraint->save(state);
  }

  void ExplicitSolver::check_start(const State &state) const
  {
    for (const NodeConstraint *constraint : constraints_on)
      constraint->check_start({ 0., state.time });
  }

  bool ExplicitSolver::loads_have_changed(const State &state,
                                          const double duration) const
  {
    const double now        = state.load_time;
    const double before     = std::max(0., now - duration);
    const TimePoint times[] = { { before, state.stage_start + before },
                                { now, state.stage_start + now } };
    for (const NodalLoad *load : loads_on)
      if (load->amplitude(times[0]) != load->amplitude(times[1]))
        return true;
    for (const NodeConstraint *constraint : constraints_on)
      if (constraint->values(times[0]) != constraint->values(times[1]))
        return true;
    return false;
  }
} // namespace quoin
