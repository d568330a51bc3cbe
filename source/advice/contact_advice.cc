// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/contact_advice.h>
#include <quoin/base/constants.h>
#include <quoin/model/contact_bounds.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    bool is_for_contacts(const JointSetParameters &set)
    {
      return set.all_new_contacts || !set.new_contacts.empty();
    }

    /** Two blocks of @p mass [kg] of @p material that meet at @p set. */
    TypicalImpact impact_of(const double mass,
                            const MaterialParameters &material,
                            const JointSetParameters &set,
                            const double thickness)
    {
      TypicalImpact result;
      result.exists = true;
      result.mass   = mass;
      result.size   = std::sqrt(mass / (material.elastic.density * thickness));
      const double kn = stiffness_bound(set.law)[0];
      const double omega
          = std::sqrt(kn * result.size * thickness / (0.5 * mass));
      const double xi    = set.damping.normal;
      result.frequency   = omega / (2. * constants::pi);
      result.restitution = restitution_of_damping(xi);
      // They part at u = 0 if undamped, else when exp(-xi omega t) is e.
      result.duration = xi > 0. ? -std::log(result.restitution) / (xi * omega)
                                : constants::pi / omega;
      result.by_block
          = material.rigid ? 0. : kn * result.size / material.elastic.young;
      return result;
    }
  } // namespace

  std::vector<TypicalImpact> typical_impacts(const Model<2> &model)
  {
    const ModelProperties &properties = model.properties();
    const BlockTable<2> &table        = model.nodes().table();
    const auto masses = block_masses(model.nodes(), model.mass());
    const auto acts = sets_on_blocks(model.nodes(), model.joints(), properties,
                                     model.parameters().large_displacements);
    const unsigned int n_sets = properties.joints.size();
    std::vector<TypicalImpact> result(n_sets);
    for (unsigned int s = 0; s < n_sets; ++s)
    {
      std::vector<unsigned int> blocks;
      for (unsigned int b = 0; b < masses.size(); ++b)
        if (acts[b * n_sets + s])
          blocks.push_back(b);
      if (blocks.empty())
        continue;
      const auto middle = blocks.begin() + blocks.size() / 2;
      std::nth_element(blocks.begin(), middle, blocks.end(),
                       [&](const unsigned int a, const unsigned int b)
                       { return masses[a] < masses[b]; });
      const unsigned int material
          = properties.material_of_group[table.group[*middle]];
      result[s] = impact_of(masses[*middle], properties.materials[material],
                            properties.joints[s], model.parameters().thickness);
    }
    return result;
  }

  std::vector<std::string> contact_lines(const Model<2> &model)
  {
    std::vector<std::string> lines;
    const auto impacts = typical_impacts(model);
    const auto &sets   = model.properties().joints;
    for (unsigned int s = 0; s < sets.size(); ++s)
      if (impacts[s].exists
          && (sets[s].damping.acts() || is_for_contacts(sets[s])))
        lines.push_back(text_of(
            "impact at joints ", sets[s].name, " of two typical blocks, ",
            impacts[s].size, " m and ", impacts[s].mass,
            " kg: contact frequency ", impacts[s].frequency,
            " Hz, contact time ", impacts[s].duration, " s, restitution ",
            impacts[s].restitution, ", overlap at 1 m/s ",
            1. / (2. * constants::pi * impacts[s].frequency), " m undamped"));
    return lines;
  }

  void check_restitution(const Model<2> &model, Advice &advice)
  {
    /** kn L/E of blocks above which they are no masses any more. */
    constexpr double soft_block = 0.1;
    const auto impacts          = typical_impacts(model);
    const auto &sets            = model.properties().joints;
    for (unsigned int s = 0; s < sets.size(); ++s)
      Checks(advice, "joints " + sets[s].name + ": ")
          .warn_if(sets[s].damping.normal > 0.
                       && impacts[s].by_block > soft_block,
                   "their normal stiffness is ", impacts[s].by_block,
                   " times E/L of the blocks, so that waves in the blocks "
                   "decide with which velocity they part, not the restitution ",
                   impacts[s].restitution,
                   " alone. For blocks that rebound with that take a tenth of "
                   "E/L or less, or rigid blocks.");
  }

  void check_soft_contacts(const Model<2> &model, const Shaking &shaking,
                           const double speed, Checks &checks)
  {
    /** Contact time by the shortest period of a load. */
    constexpr double slow = 0.1;
    /** Overlap by the size of blocks. */
    constexpr double deep = 0.02;
    const auto impacts    = typical_impacts(model);
    const auto &sets      = model.properties().joints;
    for (unsigned int s = 0; s < sets.size(); ++s)
    {
      const TypicalImpact &impact = impacts[s];
      if (!impact.exists || !is_for_contacts(sets[s]))
        continue;
      checks.warn_if(
          impact.duration * shaking.frequency > slow, "contacts of the set ",
          sets[s].name, " last about ", impact.duration,
          " s between blocks of ", impact.size,
          " m, more than a tenth of the shortest period of ", shaking.name,
          ", ", 1. / shaking.frequency,
          " s: they are springs under it, not impacts. Raise their normal "
          "stiffness, ",
          std::pow(impact.duration * shaking.frequency / slow, 2),
          " times, unless it was measured.");
      const double overlap = speed / (2. * constants::pi * impact.frequency);
      checks.warn_if(overlap > deep * impact.size, "blocks of ", impact.size,
                     " m that meet at ", speed,
                     " m/s, the largest speed of its loads, overlap by ",
                     overlap, " m at contacts of the set ", sets[s].name,
                     ": gaps between blocks that are not much wider close "
                     "softly. Raise their normal stiffness.");
    }
  }
} // namespace quoin
