// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/plane_geometry.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/reinforcement/bar_placement.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace quoin
{
  namespace
  {
    /** Distance by which parts of a bar in two blocks may be apart or overlap
        at a joint, and its ends outside of blocks, by its length [-]. */
    constexpr double touch_tolerance = 1e-6, end_tolerance = 1e-3;

    using Vector = dealii::Tensor<1, 2>;

    /** Part of a bar in one block, as shares of its length. */
    struct Run
    {
      unsigned int block;
      double begin, end;
    };

    std::vector<Run> runs_of(const std::vector<CrossedCell> &cells,
                             const std::string &where)
    {
      std::vector<Run> runs;
      for (const CrossedCell &cell : cells)
        if (!runs.empty() && runs.back().block == cell.block)
          runs.back().end = std::max(runs.back().end, cell.end);
        else
        {
          if (!runs.empty() && cell.begin < runs.back().end - touch_tolerance)
            throw InputError(where
                             + " runs along a joint: the two blocks beside it "
                               "would share it. Move it into one of them.");
          runs.push_back({ cell.block, cell.begin, cell.end });
        }
      return runs;
    }

    /** A node of a bar, and whether the element before it is bonded. */
    struct BarNode
    {
      double at; /**< share of the length */
      unsigned int block;
      bool bonded;
    };

    /** @p longest_gap: on one side of a joint, as a share of the length, for
        which all parts with a bond have room. */
    std::vector<BarNode> place_nodes(const std::vector<Run> &runs,
                                     const CableParameters &cable,
                                     const double length, double &longest_gap)
    {
      std::vector<BarNode> nodes{ { runs.front().begin, runs.front().block,
                                    false } };
      const double free = cable.free_length / length;
      if (cable.law.bond_stiffness == 0. || free >= 1. - touch_tolerance)
      {
        nodes.push_back({ runs.back().end, runs.back().block, false });
        return nodes;
      }
      const double gap = 0.5 * cable.law.active_length / length;
      for (unsigned int r = 0; r < runs.size(); ++r)
      {
        if (runs[r].end <= free + touch_tolerance)
          continue;
        double begin       = std::max(runs[r].begin, free);
        double end         = runs[r].end;
        const double third = (end - begin) / 3.;
        // Where a free length ends at the joint the bond begins there.
        const bool has_gap_before
            = r > 0 && runs[r].begin > free + touch_tolerance;
        const bool has_gap_after = r + 1 < runs.size();
        if (has_gap_before || has_gap_after)
          longest_gap = std::min(longest_gap, third);
        if (has_gap_before)
          begin += std::min(gap, third);
        if (has_gap_after)
          end -= std::min(gap, third);
        if (begin > nodes.front().at + touch_tolerance)
          nodes.push_back({ begin, runs[r].block, false });
        const auto n = std::max(
            1.,
            std::ceil((end - begin) * length / cable.element_length - 1e-9));
        for (unsigned int i = 1; i <= n; ++i)
          nodes.push_back(
              { begin + (end - begin) * i / n, runs[r].block, true });
      }
      return nodes;
    }

    const CrossedCell &cell_at(const std::vector<CrossedCell> &cells,
                               const double at, const unsigned int block)
    {
      const CrossedCell *best = nullptr;
      double least            = 0.;
      for (const CrossedCell &cell : cells)
        if (cell.block == block)
        {
          const double outside = std::max(cell.begin - at, at - cell.end);
          if (!best || outside < least)
          {
            best  = &cell;
            least = outside;
          }
        }
      return *best;
    }

    BarHost make_host(const dealii::Point<2> &point, const CrossedCell &cell,
                      const NodeMap<2> &nodes)
    {
      BarHost host;
      host.X     = point;
      host.block = cell.block;
      const double whole
          = twice_area(cell.corners[0], cell.corners[1], cell.corners[2]);
      for (unsigned int k = 0; k < 3; ++k)
      {
        host.nodes[k]   = nodes.exchange().local(cell.nodes[k]);
        host.weights[k] = twice_area(point, cell.corners[(k + 1) % 3],
                                     cell.corners[(k + 2) % 3])
                          / whole;
      }
      const auto &numbers = nodes.cells().number;
      const auto end      = numbers.begin() + nodes.cells().n_deformable;
      const auto found    = std::find(numbers.begin(), end, cell.number);
      host.cell = found == end ? NodeMap<2>::none : found - numbers.begin();
      return host;
    }
  } // namespace

  /** Displacement of a point of a cell [m]. */
  dealii::Tensor<1, 2> displacement_of(const BarHost &host,
                                       const NodeRecord<2> *nodes)
  {
    Vector u;
    for (unsigned int k = 0; k < 3; ++k)
      u += host.weights[k] * nodes[host.nodes[k]].u;
    return u;
  }

  PlacedBar place_bar(const CableParameters &given, const BarEnds &ends,
                      const std::vector<CrossedCell> &crossed,
                      const NodeMap<2> &nodes, const Thickness &thickness)
  {
    const auto text = [](const Vector &p)
    { return "(" + number_text(p[0]) + ", " + number_text(p[1]) + ")"; };
    const std::string where = "section 'Reinforcement/" + given.name
                              + "': the bar from " + text(ends[0]) + " to "
                              + text(ends[1]) + " m";
    const auto runs = runs_of(crossed, where);
    if (runs.empty() || runs.front().begin > end_tolerance
        || runs.back().end < 1. - end_tolerance)
      throw InputError(where
                       + (!runs.empty() && runs.front().begin <= end_tolerance
                              ? " ends"
                              : " begins")
                       + " outside of all blocks. Move that end into a block.");

    PlacedBar bar;
    const Vector line   = ends[1] - ends[0];
    const double length = line.norm();
    bar.direction       = line / length;
    const auto point    = [&](const double at)
    { return dealii::Point<2>(ends[0] + at * line); };
    for (const CrossedCell &cell : crossed)
      if (thickness[cell.group] != thickness[crossed.front().group])
        throw InputError(where
                         + " lies in blocks of different 'Thickness'. Let it "
                           "end where the thickness changes.");
    bar.number = thickness[crossed.front().group] / given.spacing;
    bar.law    = given.law;
    for (double BarLaw::*value :
         { &BarLaw::stiffness, &BarLaw::yield, &BarLaw::bond_stiffness,
           &BarLaw::bond_strength, &BarLaw::bond_friction,
           &BarLaw::plate_stiffness, &BarLaw::plate_strength,
           &BarLaw::anchor_stiffness, &BarLaw::anchor_strength,
           &BarLaw::dowel_stiffness, &BarLaw::dowel_strength,
           &BarLaw::dowel_axial_stiffness, &BarLaw::dowel_axial_strength })
      if (bar.law.*value != BarLaw::unlimited)
        bar.law.*value *= bar.number;

    double longest_gap        = std::numeric_limits<double>::infinity();
    const auto places         = place_nodes(runs, given, length, longest_gap);
    bar.longest_active_length = 2. * longest_gap * length;
    bar.chain.bond.resize(places.size(), 0.);
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      bar.hosts.push_back(
          make_host(point(places[i].at),
                    cell_at(crossed, places[i].at, places[i].block), nodes));
      if (i == 0)
        continue;
      const double part = (places[i].at - places[i - 1].at) * length;
      bar.chain.length.push_back(part);
      if (places[i].bonded)
        for (const unsigned int k : { i - 1, i })
          bar.chain.bond[k] += 0.5 * part;
    }
    for (unsigned int r = 0; r + 1 < runs.size(); ++r)
    {
      const double at = 0.5 * (runs[r].end + runs[r + 1].begin);
      bar.crossings.push_back(point(at));
      if (runs[r + 1].begin - runs[r].end > touch_tolerance
          || at * length < given.free_length
          || (given.law.dowel_stiffness == 0.
              && given.law.dowel_axial_stiffness == 0.))
        continue;
      unsigned int element = 0;
      while (element + 2 < places.size() && places[element + 1].at < at)
        ++element;
      bar.dowels.push_back(
          { make_host(point(at), cell_at(crossed, at, runs[r].block), nodes),
            make_host(point(at), cell_at(crossed, at, runs[r + 1].block),
                      nodes),
            element });
    }
    const auto list = [&](BarHost &host)
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto found
            = std::find(bar.nodes.begin(), bar.nodes.end(), host.nodes[k]);
        host.places[k] = found - bar.nodes.begin();
        if (found == bar.nodes.end())
          bar.nodes.push_back(host.nodes[k]);
      }
    };
    std::for_each(bar.hosts.rbegin(), bar.hosts.rend(), list);
    for (BarDowel &dowel : bar.dowels)
    {
      list(dowel.near);
      list(dowel.far);
    }
    return bar;
  }
} // namespace quoin
