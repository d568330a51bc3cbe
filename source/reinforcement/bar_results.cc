// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/reinforcement/bar_results.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 2>;
  }

  double cable_value(const Reinforcement &reinforcement, const State<2> &state,
                     const std::string &cable, const CableQuantity quantity,
                     const std::array<double, 3> &point)
  {
    const auto &bars   = reinforcement.all();
    const auto &states = state.get<ReinforcementState>().bars;
    double nearest = std::numeric_limits<double>::max(), result = 0.;
    double bonded = 0., slipped = 0.; // [m]
    const auto consider
        = [&](const double x, const double y, const double value)
    {
      const double distance = std::hypot(x - point[0], y - point[1]);
      if (distance < nearest)
      {
        nearest = distance;
        result  = value;
      }
    };
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const PlacedBar &bar = bars[b];
      const BarState &now  = states[b];
      if (reinforcement.sections()[bar.cable].name != cable)
        continue;
      for (unsigned int e = 0; e < now.force.size(); ++e)
      {
        const Vector &p = bar.hosts[e].X, &q = bar.hosts[e + 1].X;
        const double force = now.force[e] / bar.number;
        if (quantity == CableQuantity::axial_force)
          consider(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), force);
        else if (quantity == CableQuantity::largest_force)
          result = std::abs(force) > std::abs(result) ? force : result;
        else if (quantity == CableQuantity::largest_tension)
          result = std::max(result, force);
        else if (quantity == CableQuantity::largest_compression)
          result = std::max(result, -force);
        else if (quantity == CableQuantity::n_broken)
          result += now.broken[e];
        else if (quantity == CableQuantity::n_yielded)
          result += now.broken[e] || now.plastic[e] != 0.;
        else if (quantity == CableQuantity::head_force && e == 0)
          consider(p[0], p[1], now.plate_force / bar.number);
      }
      if (quantity == CableQuantity::bond_slip)
        for (unsigned int i = 0; i < now.slip.size(); ++i)
          consider(bar.hosts[i].X[0], bar.hosts[i].X[1], now.slip[i]);
      for (unsigned int i = 0; i < now.bond.size(); ++i)
        if (now.installed && !now.lost[i])
        {
          bonded += bar.chain.bond[i];
          if (now.bond[i] != bond_state::elastic)
            slipped += bar.chain.bond[i];
        }
      for (unsigned int d = 0; d < bar.dowels.size(); ++d)
      {
        const Vector &p = bar.dowels[d].near.X;
        if (quantity == CableQuantity::shear_force)
          consider(p[0], p[1], now.dowel_force[2 * d + 1] / bar.number);
        else if (quantity == CableQuantity::shear_motion)
          consider(p[0], p[1], now.dowel_motion[2 * d + 1]);
      }
    }
    if (quantity == CableQuantity::slipped_length)
      return slipped;
    if (quantity == CableQuantity::slipped_share)
      return bonded > 0. ? slipped / bonded : 0.;
    return result;
  }

  CableFields cable_fields(const Reinforcement &reinforcement,
                           const State<2> &state)
  {
    CableFields fields;
    const auto &bars   = reinforcement.all();
    const auto &states = state.get<ReinforcementState>().bars;
    for (unsigned int b = 0; b < bars.size(); ++b)
    {
      const PlacedBar &bar = bars[b];
      const BarState &now  = states[b];
      if (!now.installed)
        continue;
      for (unsigned int e = 0; e < now.force.size(); ++e)
      {
        if (now.lost[e] || now.lost[e + 1])
          continue;
        for (const unsigned int i : { e, e + 1 })
        {
          fields.position.push_back(bar.hosts[i].X);
          fields.displacement.push_back(
              displacement_of(bar.hosts[i], state.nodes.data()));
          fields.slip.push_back(now.slip[i]);
          fields.bond_force.push_back(
              bar.chain.bond[i] > 0.
                  ? now.bond_force[i] / (bar.chain.bond[i] * bar.number)
                  : 0.);
          fields.bond.push_back(bar.chain.bond[i] > 0. ? now.bond[i] : 3);
        }
        fields.axial_force.push_back(now.force[e] / bar.number);
        fields.axial_strain.push_back(now.force[e] / bar.law.stiffness
                                      + now.plastic[e] / bar.chain.length[e]);
        double shear = 0.;
        for (unsigned int d = 0; d < bar.dowels.size(); ++d)
          if (const double force = now.dowel_force[2 * d + 1] / bar.number;
              bar.dowels[d].element == e && std::abs(force) > std::abs(shear))
            shear = force;
        fields.shear_force.push_back(shear);
        fields.state.push_back(now.broken[e]          ? 2
                               : now.plastic[e] != 0. ? 1
                                                      : 0);
        fields.cable.push_back(bar.cable);
      }
    }
    return fields;
  }

  double mobilising_motion(const Reinforcement &reinforcement,
                           const State<2> &state, const double most)
  {
    const auto &states = state.get<ReinforcementState>().bars;
    double largest     = 0.;
    for (unsigned int b = 0; b < states.size(); ++b)
    {
      if (!states[b].installed)
        continue;
      const PlacedBar &bar  = reinforcement.all()[b];
      const BarLaw &law     = bar.law;
      const BarChain &chain = bar.chain;
      const std::size_t n   = chain.n_elements();
      BarState unloaded;
      unloaded.resize(chain, 0);
      std::vector<double> tangent;
      update(law, chain, std::vector<double>(n, 0.), unloaded, &tangent);
      // What holds the bar on either side of the joint, without the pressure
      // that friction of the bond follows.
      const bool bond_is_limited
          = law.bond_friction == 0. && law.bond_strength != BarLaw::unlimited;
      double near = law.plate_stiffness > 0. ? law.plate_strength : 0.;
      double far  = law.anchor_stiffness > 0. ? law.anchor_strength : 0.;
      for (const double length : chain.bond)
        far += length * law.bond_strength;
      for (std::size_t e = 0; e < n; ++e)
      {
        near += chain.bond[e] * law.bond_strength;
        far -= chain.bond[e] * law.bond_strength;
        const double stiffness = tangent[e * n + e];
        if (bar.hosts[e].block == bar.hosts[e + 1].block || stiffness <= 0.)
          continue;
        double strength = std::min(law.yield, most);
        if (bond_is_limited)
          strength = std::min({ strength, near, far });
        largest
            = std::max(largest, (strength - states[b].force[e]) / stiffness);
      }
      if (bar.dowels.empty())
        continue;
      for (const auto &[stiffness, strength] :
           { std::pair(law.dowel_stiffness, law.dowel_strength),
             std::pair(law.dowel_axial_stiffness, law.dowel_axial_strength) })
        if (stiffness > 0.)
          largest = std::max(largest, std::min(strength, most) / stiffness);
    }
    return largest;
  }

  std::vector<std::string> absent_host_texts(const Reinforcement &reinforcement,
                                             const State<2> &state,
                                             const std::string &stage,
                                             const bool is_first)
  {
    std::vector<std::string> texts;
    const auto &cables = reinforcement.sections();
    for (unsigned int c = 0; c < cables.size(); ++c)
    {
      if (cables[c].stage.empty() ? !is_first : cables[c].stage != stage)
        continue;
      std::size_t n_bars = 0, n_lost = 0;
      std::string place;
      for (const PlacedBar &bar : reinforcement.all())
      {
        if (bar.cable != c)
          continue;
        ++n_bars;
        const auto first = std::find_if(
            bar.hosts.begin(), bar.hosts.end(),
            [&](const BarHost &host) { return state.is_absent(host.block); });
        if (first != bar.hosts.end() && n_lost++ == 0)
          place = point_text(first->X);
      }
      if (n_lost > 0)
        texts.push_back(text_of(
            "reinforcement ", cables[c].name, ": of ", n_lost, " of ",
            count_text(n_bars, "bar"), " a part lies, such as at ", place,
            " m, in a block that is excavated or not there yet. That part "
            "bears nothing, neither now nor after a later 'Fill', and a bar "
            "whose far end lies there bears nothing at all. Name the stage "
            "that places the block as its 'Stage', or let the bar lie in "
            "blocks that are there."));
    }
    return texts;
  }

  std::string cable_text(const Reinforcement &reinforcement)
  {
    const auto &cables = reinforcement.sections();
    std::ostringstream lines;
    for (unsigned int c = 0; c < cables.size(); ++c)
    {
      std::size_t n_bars = 0, n_elements = 0, n_dowels = 0;
      for (const PlacedBar &bar : reinforcement.all())
        if (bar.cable == c)
        {
          ++n_bars;
          n_elements += bar.chain.n_elements();
          n_dowels += bar.dowels.size();
        }
      lines << (c > 0 ? "\n" : "") << "reinforcement " << cables[c].name << ": "
            << count_text(n_bars, "bar") << ", "
            << count_text(n_elements, "element")
            << (cables[c].law.bond_stiffness > 0.
                    ? " of at most " + number_text(cables[c].element_length)
                          + " m"
                    : "")
            << ", " << count_text(n_dowels, "dowel")
            << (cables[c].stage.empty() ? ""
                                        : ", from stage " + cables[c].stage);
    }
    return lines.str();
  }
} // namespace quoin
