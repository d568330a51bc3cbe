// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Checks of the stages by Construction.

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/dynamics/construction.h>

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
  std::vector<bool> Construction<dim>::absent_in_the_end() const
  {
    std::vector<bool> absent = absent_at_start;
    for (const Step &step : steps)
      for (unsigned int g = 0; g < absent.size(); ++g)
        if (step.excavate[g] || step.fill[g])
          absent[g] = step.excavate[g];
    return absent;
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

  template void Construction<2>::check_borders(const Step &,
                                               const std::vector<bool> &,
                                               const std::string &) const;
  template void Construction<2>::check_presence();
  template std::vector<bool> Construction<2>::absent_in_the_end() const;
  template void Construction<2>::find_properties(unsigned int,
                                                 const StageParameters &);
  template void Construction<3>::check_borders(const Step &,
                                               const std::vector<bool> &,
                                               const std::string &) const;
  template void Construction<3>::check_presence();
  template std::vector<bool> Construction<3>::absent_in_the_end() const;
  template void Construction<3>::find_properties(unsigned int,
                                                 const StageParameters &);
} // namespace quoin
