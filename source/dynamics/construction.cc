// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/stored_energy.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/dynamics/construction.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/model_changes.h>

#include <algorithm>
#include <set>

namespace quoin
{
  namespace
  {
    /** Index of the item @p name; the size of @p items: none. */
    template <typename T>
    unsigned int position(const std::vector<T> &items, const std::string &name)
    {
      return std::find_if(items.begin(), items.end(),
                          [&](const T &item) { return item.name == name; })
             - items.begin();
    }
  } // namespace

  template <int dim>
  Construction<dim>::Construction(Model<dim> &model,
                                  const std::vector<StageParameters> &stages)
    : model(model), at_start(model.properties()),
      absent_at_start(find_groups(model.nodes().table(),
                                  model.parameters().absent_groups,
                                  "section 'Stages'"))
  {
    const BlockTable<dim> &table = model.nodes().table();
    for (unsigned int i = 0; i < stages.size(); ++i)
    {
      const StageParameters &stage = stages[i];
      Step step;
      step.where = "section 'Stages/" + stage.name + "'";
      step.excavate
          = find_groups(table, stage.excavate, step.where + ", 'Excavate'");
      step.fill   = find_groups(table, stage.fill, step.where + ", 'Fill'");
      step.takes  = !stage.excavate.empty();
      step.places = !stage.fill.empty();
      // A search for the factor of safety leaves the model as it was, and what
      // supports it.
      step.release = stage.safety ? 0. : stage.release;
      step.changes = stage.changes_properties();
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

  template <int dim>
  void Construction<dim>::restart()
  {
    restore(0, ConstructionState<dim>());
  }

  template <int dim>
  void Construction<dim>::restore(const unsigned int n,
                                  const ConstructionState<dim> &state)
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

  template <int dim>
  ModelProperties
  Construction<dim>::properties_after(const unsigned int n) const
  {
    if (n == 0)
      return at_start;
    const Step &last = steps[n - 1];
    return last.strength == 1. ? last.properties
                               : reduced(last.properties, 1. / last.strength);
  }

  template <int dim>
  void Construction<dim>::resume_stage(const unsigned int stage,
                                       const State<dim> &state)
  {
    restore(stage + 1, state.template get<ConstructionState<dim>>());
  }

  template <int dim>
  void Construction<dim>::begin_stage(const unsigned int stage,
                                      Solver<dim> &solver, State<dim> &state)
  {
    const Step &step = steps[stage];
    restore(stage, state.template get<ConstructionState<dim>>());
    auto &held = state.template get<ConstructionState<dim>>().held;
    for (HeldForces<dim> &item : held)
      item.left = item.left_at_end;
    held.erase(std::remove_if(held.begin(), held.end(),
                              [](const HeldForces<dim> &item)
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
        change_properties(model, properties_after(stage + 1), state);
      state.energy.external += stored_energy(state) - before;
    }
    if (!step.changes
        && step.strength != (stage == 0 ? 1. : steps[stage - 1].strength))
      model.set_properties(properties_after(stage + 1),
                           state.template get<ConstructionState<dim>>());
    for (HeldForces<dim> &item : held)
      item.left_at_end = std::min(item.left, 1. - step.release);
    n_begun = stage + 1;
  }

  template <int dim>
  void
  Construction<dim>::hold(const unsigned int stage,
                          const AlignedArray<dealii::Tensor<1, dim>> &force,
                          State<dim> &state) const
  {
    if (!steps[stage].takes)
      return;
    std::vector<double> &held
        = state.template get<ConstructionState<dim>>().held.back().force;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        held[dim * i + d] += force[i][d];
  }

  template <int dim>
  double Construction<dim>::stored_energy(const State<dim> &state) const
  {
    return quoin::stored_energy(state, model.blocks(), model.joints());
  }

  template <int dim>
  std::vector<unsigned int>
  Construction<dim>::blocks_in(const std::vector<bool> &groups) const
  {
    std::vector<unsigned int> result;
    for (unsigned int b = 0; b < model.nodes().table().n_blocks(); ++b)
      if (is_in(b, groups))
        result.push_back(b);
    return result;
  }

  template <int dim>
  bool Construction<dim>::is_in(const unsigned int block,
                                const std::vector<bool> &groups) const
  {
    return groups[model.nodes().table().group[block]];
  }

  template <int dim>
  void Construction<dim>::take_away(const Step &step, Solver<dim> &solver,
                                    State<dim> &state) const
  {
    const auto &joints = model.joints();
    const auto blocks  = blocks_in(step.excavate);
    solver.cut_liners(blocks, state);
    AlignedArray<dealii::Tensor<1, dim>> held(state.nodes.size(),
                                              dealii::Tensor<1, dim>());
    AlignedArray<dealii::Tensor<1, dim>> lost = held; // of excavated joints
    for (unsigned int i = 0; i < joint_faces(joints).size(); ++i)
    {
      if (is_at_absent_block(model, i, state))
        continue;
      const JointNodes<dim> &face
          = model.nodes().faces().joints[joint_faces(joints)[i].face];
      const bool lower = step.excavate[face.groups[0]];
      const bool upper = step.excavate[face.groups[1]];
      if (!lower && !upper)
        continue;
      add_traction_forces(joints, i, state,
                          lower != upper ? held.data() : lost.data());
      detach_joint(i, state.template get<JointHistoryOf<dim>>());
    }
    for (auto *forces : { &held, &lost })
      model.nodes().exchange().add_to_owners(forces->data());
    // The present energy includes the work of these forces over the last half
    // step. The held forces on blocks that stay book it again; that on
    // excavated blocks is part of the kinetic energy that is removed.
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        state.energy.external -= 0.5 * state.previous_time_step
                                 * (held[i][d] + lost[i][d])
                                 * state.velocity[i][d];
    // The water that leaves is a load, whose work over that half step is not
    // booked yet.
    solver.add_water_between(blocks, state, held.data());

    state.block_marks.resize(model.nodes().table().n_blocks(),
                             block_mark::present);
    for (const unsigned int block : blocks)
      state.block_marks[block] = block_mark::absent;
    state.energy.external -= solver.stop_blocks(blocks, state);
    bring_to_rest(model, blocks, state);
    model.nodes().exchange().update_ghosts(state.nodes.data());

    HeldForces<dim> item;
    const auto absent = absent_nodes(model, state);
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        item.force.push_back(absent[i] ? 0. : held[i][d]);
    for (HeldForces<dim> &earlier :
         state.template get<ConstructionState<dim>>().held)
      for (std::size_t i = 0; i < earlier.force.size(); ++i)
        if (absent[i / dim])
          earlier.force[i] = 0.;
    state.template get<ConstructionState<dim>>().held.push_back(
        std::move(item));
  }

  template <int dim>
  void Construction<dim>::place(const Step &step, State<dim> &state) const
  {
    const auto &joints = model.joints();
    const auto blocks  = blocks_in(step.fill);
    for (const unsigned int block : blocks)
      state.block_marks[block] = block_mark::present;
    clear_initial_stress(model, step.fill,
                         state.template get<ConstructionState<dim>>());
    model.set_properties(model.properties(),
                         state.template get<ConstructionState<dim>>());
    place_blocks(model, blocks, state);
    model.nodes().exchange().update_ghosts(state.nodes.data());
    count_from_placing(joints, state.template get<JointHistoryOf<dim>>());
    for (unsigned int i = 0; i < joint_faces(joints).size(); ++i)
    {
      const JointNodes<dim> &face
          = model.nodes().faces().joints[joint_faces(joints)[i].face];
      if ((step.fill[face.groups[0]] || step.fill[face.groups[1]])
          && !is_at_absent_block(model, i, state))
        begin_joint_anew(joints, i, state);
    }
  }

  // -- checks of the stages
  // ----------------------------------------------------

  std::vector<std::string>
  groups_placed_later(const std::vector<StageParameters> &stages)
  {
    std::set<std::string> excavated, placed;
    for (const StageParameters &stage : stages)
    {
      for (const std::string &group : stage.fill)
        if (excavated.count(group) == 0)
          placed.insert(group);
      excavated.insert(stage.excavate.begin(), stage.excavate.end());
    }
    return { placed.begin(), placed.end() };
  }

  template <int dim>
  void Construction<dim>::check_borders(const Step &step,
                                        const std::vector<bool> &groups,
                                        const std::string &parameter) const
  {
    // The first cell of all ranks whose group differs from its block's.
    const NodeMap<dim> &nodes       = model.nodes();
    const BlockTable<dim> &table    = model.nodes().table();
    const unsigned int n_groups     = table.group_names.size();
    std::array<unsigned int, 2> met = { { n_groups, n_groups } };
    const LocalCells<dim> &cells    = nodes.cells();
    for (unsigned int c = 0; c < cells.size() && met[0] == n_groups; ++c)
    {
      const unsigned int one   = table.group[nodes.blocks().block_of_cell(c)];
      const unsigned int other = cells.group[c];
      if (groups[one] != groups[other])
        met = { { groups[one] ? one : other, groups[one] ? other : one } };
    }
    met[0] = dealii::Utilities::MPI::min(met[0], nodes.communicator());
    met[1] = dealii::Utilities::MPI::min(met[1], nodes.communicator());
    if (met[0] == n_groups)
      return;
    const std::string &taken = table.group_names[met[0]];
    const std::string &stays = table.group_names[met[1]];
    throw InputError(step.where + ": '" + parameter + "' names '" + taken
                     + "', which has no joint to '" + stays
                     + "' beside it: only whole blocks can come and go. "
                       "Add "
                     + taken + ":" + stays
                     + " to 'Joints between' in section 'Mesh', and their "
                       "joint to a set of section 'Joints'.");
  }

  template <int dim>
  void Construction<dim>::check_presence()
  {
    const auto &group_names   = model.nodes().table().group_names;
    std::vector<bool> present = absent_at_start;
    present.flip();
    for (Step &step : steps)
    {
      for (unsigned int g = 0; g < group_names.size(); ++g)
      {
        const std::string group = " '" + group_names[g] + "'";
        if (step.excavate[g] && step.fill[g])
          throw InputError(step.where + ": 'Excavate' and 'Fill' both name"
                           + group
                           + ". Excavate it in one stage and fill it in a "
                             "later one.");
        if (step.excavate[g] && !present[g])
          throw InputError(step.where + ": 'Excavate' names" + group
                           + ", which is not there: it was excavated before, "
                             "or is placed later. Name it once.");
        if (step.fill[g] && present[g])
          throw InputError(step.where + ": 'Fill' names" + group
                           + ", which is there already: it was placed before. "
                             "Name it once, or excavate it in between.");
        if (step.excavate[g] || step.fill[g])
          present[g] = step.fill[g];
      }
      if (step.takes
          && std::find(present.begin(), present.end(), true) == present.end())
        throw InputError(
            step.where
            + ": 'Excavate' takes all blocks that are there. Name "
              "only those that are excavated: physical surfaces of "
              "the mesh, of which others must remain.");
      if ((step.takes || step.places || step.changes)
          && model.parameters().large_displacements)
        throw InputError(step.where
                         + ": 'Excavate', 'Fill', 'Materials' and 'Joint "
                           "properties' are for small displacements. Set "
                           "'Displacements = small' in section 'Contact', or "
                           "remove them.");
      step.bears_load = present;
      for (unsigned int g = 0; g < group_names.size(); ++g)
        if (step.fill[g])
          step.bears_load[g] = false;
    }
  }

  template <int dim>
  std::vector<double> Construction<dim>::absence() const
  {
    std::vector<bool> absent = absent_at_start;
    std::vector<double> result(absent.size(), 0.);
    for (const Step &step : steps)
      for (unsigned int g = 0; g < absent.size(); ++g)
      {
        if (step.excavate[g] || step.fill[g])
          absent[g] = step.excavate[g];
        result[g] += absent[g] ? 1. / steps.size() : 0.;
      }
    for (unsigned int g = 0; g < absent.size(); ++g)
      result[g] += absent[g] ? 2. : 0.;
    return result;
  }

  template <int dim>
  void Construction<dim>::find_properties(const unsigned int stage,
                                          const StageParameters &parameters)
  {
    Step &step      = steps[stage];
    step.properties = stage == 0 ? at_start : steps[stage - 1].properties;
    for (const auto &[group, material] : parameters.materials)
      change_material(group, material, step);
    for (const auto &[set, other] : parameters.joint_properties)
      change_joints(set, other, step);
  }

  template <int dim>
  void Construction<dim>::change_material(const std::string &group,
                                          const std::string &material,
                                          Step &step) const
  {
    const auto &materials = step.properties.materials;
    const unsigned int m  = position(materials, material);
    const std::string where
        = step.where + ": 'Materials' has " + group + ":" + material;
    if (m == materials.size())
      throw InputError(
          where + ", but '" + material + "' is no material. There are: "
          + known_names_like(material, materials, &MaterialParameters::name)
          + ". Name one of these.");
    const auto groups = find_groups(model.nodes().table(), { group }, where);
    const unsigned int g
        = std::find(groups.begin(), groups.end(), true) - groups.begin();
    unsigned int &now = step.properties.material_of_group[g];
    if (materials[m].rigid != materials[now].rigid)
      throw InputError(where + ", but of these two '"
                       + materials[materials[m].rigid ? m : now].name
                       + "' is rigid: blocks cannot become rigid or "
                         "deformable. Take a material of the same kind as '"
                       + materials[now].name + "'.");
    if (materials[m].elastic.density != materials[now].elastic.density
        && step.bears_load[g])
      throw InputError(where + ", but the densities of '" + materials[now].name
                       + "' and '" + material
                       + "' differ: blocks that are there keep their mass. "
                         "Give both the same 'Density', or change the material "
                         "in the stage that places the blocks by 'Fill'.");
    if (materials[m].thickness != materials[now].thickness)
      throw InputError(where + ", but the thicknesses of '"
                       + materials[now].name + "' and '" + material
                       + "' differ: blocks, joints and boundaries keep theirs. "
                         "Give both the same 'Thickness'.");
    now = m;
  }

  template <int dim>
  void Construction<dim>::change_joints(const std::string &set,
                                        const std::string &other,
                                        Step &step) const
  {
    const std::string where
        = step.where + ": 'Joint properties' has " + set + ":" + other;
    for (const std::string &name : { set, other })
      if (position(at_start.joints, name) == at_start.joints.size())
        throw InputError(
            where + ", but '" + name + "' is no joint set. There are: "
            + known_names_like(name, at_start.joints, &JointSetParameters::name)
            + ". Name one of these.");
    JointSetParameters &now
        = step.properties.joints[position(at_start.joints, set)];
    // The other set's law as given, not one that it has taken over since.
    const JointSetParameters &wanted
        = at_start.joints[position(at_start.joints, other)];
    if (kind_of_law(now.law) != kind_of_law(wanted.law))
      throw InputError(where + ", but '" + set + "' has " + kind_of_law(now.law)
                       + " and '" + other + "' " + kind_of_law(wanted.law)
                       + ": a joint cannot change the kind of its law. Give "
                         "both sets laws of one kind.");
    now.law     = wanted.law;
    now.damping = wanted.damping;
  }

  template class Construction<2>;
  template class Construction<3>;
} // namespace quoin
