// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/contact_advice.h>
#include <quoin/base/constants.h>
#include <quoin/contact/block_gaps.h>
#include <quoin/model/contact_bounds.h>
#include <quoin/parameters/plausibility.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    bool is_for_contacts(const JointSetParameters &set)
    {
      return set.all_new_contacts || !set.new_contacts.empty();
    }

    /** Two blocks of @p mass [kg] of @p material that meet at @p set. */
    template <int dim>
    TypicalImpact
    impact_of(const double mass, const MaterialParameters &material,
              const JointSetParameters &set, const double thickness)
    {
      TypicalImpact result;
      result.exists       = true;
      result.mass         = mass;
      result.density      = material.elastic.density;
      const double volume = mass / result.density;
      result.size
          = dim == 2 ? std::sqrt(volume / thickness) : std::cbrt(volume);
      const double kn    = stiffness_bound(set.law)[0];
      result.stiffness   = kn;
      const double omega = std::sqrt(kn * volume / result.size / (0.5 * mass));
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

    /** Overlap of typical blocks that meet at 1 m/s, undamped [s]. */
    double overlap_by_speed(const TypicalImpact &impact)
    {
      return 1. / (2. * constants::pi * impact.frequency);
    }

    /** Gaps between blocks, ascending [m]; wider ones than a share of the
        largest typical block do not count. Collective. */
    std::vector<double> gaps_of(const Model<2> &model, const State<2> &state,
                                const std::vector<TypicalImpact> &impacts)
    {
      constexpr double widest = 0.2;
      double size             = 0.;
      for (const TypicalImpact &impact : impacts)
        size = std::max(size, impact.size);
      if (size == 0. || !model.parameters().large_displacements)
        return {};
      return block_gaps(model.nodes(), state, widest * size);
    }

    /** How high all blocks reach above the lowest point [m]. Collective. */
    double height_of(const NodeMap<2> &nodes)
    {
      std::vector<double> ends(2, -std::numeric_limits<double>::infinity());
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        ends[0] = std::max(ends[0], nodes.point(i)[1]);
        ends[1] = std::max(ends[1], -nodes.point(i)[1]);
      }
      dealii::Utilities::MPI::max(ends, nodes.communicator(), ends);
      return ends[0] + ends[1];
    }

    /** Warns of contacts of @p set that close @p gap [m] softly. */
    void check_gap(const JointSetParameters &set, const TypicalImpact &impact,
                   const Agitation &loads, const double gap,
                   const double height, Checks &checks)
    {
      /** Overlap by the gap above which it is wider than drawn. */
      constexpr double wide = 0.1;
      // What falls or slides freely through the gap has this speed behind it.
      const double speed
          = std::max(loads.speed, std::sqrt(2. * loads.acceleration * gap));
      const double share = speed * overlap_by_speed(impact) / gap;
      checks.warn_if(
          share > wide, "the gaps between blocks are about ", gap,
          " m wide, and blocks of ", impact.size, " m that meet at ", speed,
          " m/s overlap by ", share * gap, " m at contacts of the set ",
          set.name, ", ", share,
          " times that: gaps act wider than they are. Raise their normal "
          "stiffness, ",
          std::pow(share / wide, 2), " times, unless it was measured.");
      const double pressed
          = impact.density * loads.acceleration * height / impact.stiffness;
      checks.warn_if(
          pressed > wide * gap, "the gaps between blocks are about ", gap,
          " m wide, and under a column as high as the model, ", height,
          " m, contacts of the set ", set.name, " close by ", pressed, " m, ",
          pressed / gap,
          " times that: blocks sink by as much as they may move. Raise their "
          "normal stiffness, ",
          pressed / (wide * gap), " times, unless it was measured.");
    }
  } // namespace

  template <int dim>
  std::vector<TypicalImpact> typical_impacts(const Model<dim> &model)
  {
    const ModelProperties &properties = model.properties();
    const BlockTable<dim> &table      = model.nodes().table();
    const auto masses         = block_masses(model.nodes(), model.mass());
    const auto acts           = sets_on_blocks(model);
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
      result[s] = impact_of<dim>(
          masses[*middle], properties.materials[material], properties.joints[s],
          model.thickness()[table.group[*middle]]);
    }
    return result;
  }

  template <int dim>
  std::vector<std::string> contact_lines(const Model<dim> &model,
                                         const State<dim> &state)
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
            overlap_by_speed(impacts[s]), " m undamped"));
    if constexpr (dim == 2)
      if (const auto gaps = gaps_of(model, state, impacts); !gaps.empty())
        lines.push_back(text_of(
            count_text(gaps.size(), "block"),
            gaps.size() == 1 ? " has" : " have", " a gap beside, ",
            range_text(gaps.front(), gaps.back()),
            " m wide, half of them below ", gaps[gaps.size() / 2], " m"));
    return lines;
  }

  template <int dim>
  void check_contacts(const Model<dim> &model, Advice &advice)
  {
    /** kn L/E of blocks above which they are no masses any more, and below
        which they are nothing else. */
    constexpr double soft_block = 0.1, rigid_block = 1e-3;
    const auto impacts = typical_impacts(model);
    const auto &sets   = model.properties().joints;
    for (unsigned int s = 0; s < sets.size(); ++s)
    {
      const double by_block = impacts[s].by_block;
      Checks checks(advice, "joints " + sets[s].name + ": ");
      checks.warn_if(
          sets[s].damping.normal > 0. && by_block > soft_block,
          "their normal stiffness is ", by_block,
          " times E/L of the blocks, so that waves in the blocks "
          "decide with which velocity they part, not the restitution ",
          impacts[s].restitution,
          " alone. For blocks that rebound with that take a tenth of "
          "E/L or less",
          dim == 2 ? ", or rigid blocks." : ".");
      checks.warn_if(
          sets[s].curves.empty() && by_block > 0. && by_block < rigid_block
              && impacts[s].stiffness >= softest_joint,
          "their normal stiffness ", impacts[s].stiffness, " Pa/m is ",
          by_block,
          " times E/L of the blocks that they are contacts of: blocks hardly "
          "deform. Check its unit, or make the blocks rigid, which takes far "
          "fewer steps.");
    }
  }

  void check_rigid_blocks(const Model<2> &model, const double gravity,
                          Advice &advice)
  {
    /** Closure by the size of blocks. */
    constexpr double deep = 0.02;
    const auto impacts    = typical_impacts(model);
    const auto &sets      = model.properties().joints;
    const double height   = height_of(model.nodes());
    for (unsigned int s = 0; s < sets.size(); ++s)
    {
      const TypicalImpact &impact = impacts[s];
      // Those in a wrong unit have been warned of.
      if (!impact.exists || impact.by_block > 0.
          || impact.stiffness < softest_joint)
        continue;
      const double closure
          = impact.density * gravity * height / impact.stiffness;
      Checks(advice, "joints " + sets[s].name + ": ")
          .warn_if(closure > deep * impact.size,
                   "under a column as high as "
                   "the model, ",
                   height, " m, rigid blocks of ", impact.size, " m sink by ",
                   closure, " m into each other, ",
                   100. * closure / impact.size,
                   " % of their size: the normal stiffness ", impact.stiffness,
                   " Pa/m is soft for their weight. Raise it ",
                   closure / (deep * impact.size),
                   " times, unless it was measured.");
    }
  }

  void check_soft_contacts(const Model<2> &model, const State<2> &state,
                           const Agitation &loads, Checks &checks)
  {
    const Shaking &shaking = loads.shaking;
    /** Contact time by the shortest period of a load. */
    constexpr double slow = 0.1;
    /** Overlap by the size of blocks. */
    constexpr double deep = 0.02;
    const auto impacts    = typical_impacts(model);
    const auto &sets      = model.properties().joints;
    const auto gaps       = gaps_of(model, state, impacts);
    const double height   = height_of(model.nodes());
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
      if (!gaps.empty())
        check_gap(sets[s], impact, loads, gaps[gaps.size() / 2], height,
                  checks);
      const double overlap = loads.speed * overlap_by_speed(impact);
      checks.warn_if(gaps.empty() && overlap > deep * impact.size, "blocks of ",
                     impact.size, " m that meet at ", loads.speed,
                     " m/s, the largest speed of its loads, overlap by ",
                     overlap, " m at contacts of the set ", sets[s].name,
                     ": gaps between blocks that are not much wider close "
                     "softly. Raise their normal stiffness.");
    }
  }

  template std::vector<TypicalImpact> typical_impacts(const Model<2> &);
  template std::vector<std::string> contact_lines(const Model<2> &,
                                                  const State<2> &);
  template void check_contacts(const Model<2> &, Advice &);
  template std::vector<TypicalImpact> typical_impacts(const Model<3> &);
  template std::vector<std::string> contact_lines(const Model<3> &,
                                                  const State<3> &);
  template void check_contacts(const Model<3> &, Advice &);
} // namespace quoin
