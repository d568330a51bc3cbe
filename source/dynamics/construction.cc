// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/construction.h>
#include <quoin/model/block_placement.h>

#include <algorithm>

namespace quoin
{
  Construction::Construction(Model<2> &model,
                             const std::vector<StageParameters> &stages)
    : model(model), at_start(model.properties()),
      absent_at_start(find_groups(model.nodes().table(),
                                  model.parameters().absent_groups,
                                  "section 'Stages'"))
  {
    const BlockTable<2> &table = model.nodes().table();
    for (unsigned int i = 0; i < stages.size(); ++i)
    {
      const StageParameters &stage = stages[i];
      Step step;
      step.where = "section 'Stages/" + stage.name + "'";
      step.excavate
          = find_groups(table, stage.excavate, step.where + ", 'Excavate'");
      step.fill    = find_groups(table, stage.fill, step.where + ", 'Fill'");
      step.takes   = !stage.excavate.empty();
      step.places  = !stage.fill.empty();
      step.release = stage.release;
      step.changes = stage.changes_properties();
      // A search for the factor of safety leaves the model as it was.
      const StageParameters *strong
          = stage.safety ? previous_stage(stages, i) : &stage;
      step.strength = strong ? strong->strength_factor : 1.;
      check_borders(step, step.excavate, "Excavate");
      check_borders(step, step.fill, "Fill");
      steps.push_back(step);
    }
    check_presence();
    for (unsigned int i = 0; i < stages.size(); ++i)
      find_properties(i, stages[i]);
  }

  void Construction::restart()
  {
    restore(0, ConstructionState());
  }

  void Construction::restore(const unsigned int n,
                             const ConstructionState &state)
  {
    const auto changed = [&](const unsigned int last)
    {
      return std::any_of(steps.begin(), steps.begin() + last,
                         [](const Step &step) {
                           return step.changes || step.places
                                  || step.strength != 1.;
                         });
    };
    if (n != n_begun && (changed(n) || changed(n_begun)))
      model.set_properties(properties_after(n), state);
    n_begun = n;
  }

  ModelProperties Construction::properties_after(const unsigned int n) const
  {
    if (n == 0)
      return at_start;
    const Step &last = steps[n - 1];
    return last.strength == 1. ? last.properties
                               : reduced(last.properties, 1. / last.strength);
  }

  void Construction::resume_stage(const unsigned int stage,
                                  const State<2> &state)
  {
    restore(stage + 1, state.get<ConstructionState>());
  }

  void Construction::begin_stage(const unsigned int stage, Solver<2> &solver,
                                 State<2> &state)
  {
    const Step &step = steps[stage];
    restore(stage, state.get<ConstructionState>());
    auto &held = state.get<ConstructionState>().held;
    for (HeldForces &item : held)
      item.left = item.left_at_end;
    held.erase(std::remove_if(held.begin(), held.end(),
                              [](const HeldForces &item)
                              { return item.left == 0.; }),
               held.end());
    if (step.takes || step.places || step.changes)
    {
      solver.update_histories(state);
      const double before = stored_energy(state);
      if (step.takes)
        take_away(step, solver, state);
      if (step.places)
        place(step, state);
      if (step.changes)
        model.change_properties(properties_after(stage + 1), state);
      state.energy.external += stored_energy(state) - before;
    }
    if (!step.changes
        && step.strength != (stage == 0 ? 1. : steps[stage - 1].strength))
      model.set_properties(properties_after(stage + 1),
                           state.get<ConstructionState>());
    for (HeldForces &item : held)
      item.left_at_end = std::min(item.left, 1. - step.release);
    n_begun = stage + 1;
  }

  double Construction::stored_energy(const State<2> &state) const
  {
    return model.blocks().stored_energy(state)
           + model.joints().stored_energy(state);
  }

  std::vector<unsigned int>
  Construction::blocks_in(const std::vector<bool> &groups) const
  {
    std::vector<unsigned int> result;
    for (unsigned int b = 0; b < model.nodes().table().n_blocks(); ++b)
      if (is_in(b, groups))
        result.push_back(b);
    return result;
  }

  bool Construction::is_in(const unsigned int block,
                           const std::vector<bool> &groups) const
  {
    return groups[model.nodes().table().group[block]];
  }

  void Construction::take_away(const Step &step, Solver<2> &solver,
                               State<2> &state) const
  {
    const MatchedJoints &joints = model.joints();
    AlignedArray<NodeVector<2>> held(state.nodes.size(),
                                     NodeVector<2>{ { 0., 0. } });
    AlignedArray<NodeVector<2>> lost = held; // of excavated joints
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      if (is_at_absent_block(model, i, state))
        continue;
      const JointNodes<2> &face
          = model.nodes().faces().joints[joints.segments()[i].face];
      const bool lower = step.excavate[face.groups[0]];
      const bool upper = step.excavate[face.groups[1]];
      if (!lower && !upper)
        continue;
      add_traction_forces(joints, i, state,
                          lower != upper ? held.data() : lost.data());
      detach_joint(i, state.get<JointHistory>());
    }
    for (auto *forces : { &held, &lost })
      model.nodes().exchange().add_to_owners(forces->data());
    // The present energy includes the work of these forces over the last half
    // step. The held forces on blocks that stay book it again; that on
    // excavated blocks is part of the kinetic energy that is removed.
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        state.energy.external -= 0.5 * state.previous_time_step
                                 * (held[i].v[d] + lost[i].v[d])
                                 * state.velocity[i].v[d];

    state.block_marks.resize(model.nodes().table().n_blocks(),
                             block_mark::present);
    const auto blocks = blocks_in(step.excavate);
    for (const unsigned int block : blocks)
      state.block_marks[block] = block_mark::absent;
    state.energy.external -= solver.stop_blocks(blocks, state);
    bring_to_rest(model, blocks, state);
    model.nodes().exchange().update_ghosts(state.nodes.data());

    HeldForces item;
    const auto absent = absent_nodes(model, state);
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        item.force.push_back(absent[i] ? 0. : held[i].v[d]);
    for (HeldForces &earlier : state.get<ConstructionState>().held)
      for (std::size_t i = 0; i < earlier.force.size(); ++i)
        if (absent[i / 2])
          earlier.force[i] = 0.;
    state.get<ConstructionState>().held.push_back(std::move(item));
  }

  void Construction::place(const Step &step, State<2> &state) const
  {
    const MatchedJoints &joints = model.joints();
    const auto blocks           = blocks_in(step.fill);
    for (const unsigned int block : blocks)
      state.block_marks[block] = block_mark::present;
    model.clear_initial_stress(step.fill, state.get<ConstructionState>());
    model.set_properties(model.properties(), state.get<ConstructionState>());
    place_blocks(model, blocks, state);
    model.nodes().exchange().update_ghosts(state.nodes.data());
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointNodes<2> &face
          = model.nodes().faces().joints[joints.segments()[i].face];
      if ((step.fill[face.groups[0]] || step.fill[face.groups[1]])
          && !is_at_absent_block(model, i, state))
        begin_joint_anew(joints, i, state);
    }
  }
} // namespace quoin
