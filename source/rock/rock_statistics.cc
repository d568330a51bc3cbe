// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/disjoint_sets.h>
#include <quoin/base/number_text.h>
#include <quoin/rock/rock_layout.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Point  = dealii::Point<2>;
    using Vector = dealii::Tensor<1, 2>;

    constexpr unsigned int n_scan_lines = 200;

    struct Summary
    {
      std::size_t number = 0;
      double mean = 0., deviation = 0.;
    };

    Summary summarise(const std::vector<double> &values)
    {
      Summary result{ values.size(), 0., 0. };
      if (values.empty())
        return result;
      for (const double v : values)
        result.mean += v / values.size();
      for (const double v : values)
        result.deviation += std::pow(v - result.mean, 2);
      result.deviation = values.size() > 1
                             ? std::sqrt(result.deviation / (values.size() - 1))
                             : 0.;
      return result;
    }

    std::string cells(const Summary &summary)
    {
      std::ostringstream text;
      text.precision(10);
      text << summary.number << ",";
      if (summary.number > 0)
        text << summary.mean << "," << summary.deviation;
      else
        text << ",";
      return text.str();
    }

    /** Joints of one kind as they are in the blocks. */
    struct MadeJoints
    {
      std::vector<double> dip;    /**< dip of edges, weighted by length [deg] */
      std::vector<double> length; /**< length of straight runs [m] */
      std::vector<double> spacing; /**< along lines across [m] */
      double total = 0.;           /**< [m] */
    };

    std::vector<Piece> pieces_of(const RockLayout &layout,
                                 const unsigned int line)
    {
      std::vector<Piece> pieces;
      const JointNetwork &network = *layout.network;
      for (const auto *edges : { &network.edges(), &layout.cracks })
        for (const JointNetwork::Edge &edge : *edges)
          if (edge.line == line)
            pieces.push_back(
                { { network.point(edge.from), network.point(edge.to) } });
      return pieces;
    }

    /** Distances between neighbouring crossings with lines across @p dip. */
    std::vector<double> scan(const std::vector<Piece> &pieces, const double dip)
    {
      const double angle = dip * constants::degree;
      Vector along, across;
      along[0]  = std::cos(angle);
      along[1]  = std::sin(angle);
      across[0] = -along[1];
      across[1] = along[0];
      const Point origin;
      double low = std::numeric_limits<double>::max(), high = -low;
      for (const Piece &piece : pieces)
        for (const Point &p : piece)
        {
          low  = std::min(low, (p - origin) * along);
          high = std::max(high, (p - origin) * along);
        }
      std::vector<std::vector<double>> crossings(n_scan_lines);
      const double step = (high - low) / n_scan_lines;
      if (!(step > 0.))
        return {};
      for (const Piece &piece : pieces)
      {
        Vector a = piece[0] - origin, b = piece[1] - origin;
        if (a * along > b * along)
          std::swap(a, b);
        const double s0 = a * along, s1 = b * along;
        const auto first
            = static_cast<long>(std::ceil((s0 - low) / step - 0.5));
        for (long i = std::max(0L, first);
             i < n_scan_lines && low + (i + 0.5) * step < s1; ++i)
        {
          const double share = (low + (i + 0.5) * step - s0) / (s1 - s0);
          crossings[i].push_back((a + share * (b - a)) * across);
        }
      }
      std::vector<double> distances;
      for (auto &line : crossings)
      {
        std::sort(line.begin(), line.end());
        for (std::size_t i = 1; i < line.size(); ++i)
          distances.push_back(line[i] - line[i - 1]);
      }
      return distances;
    }

    /** Lengths of the runs of edges that hang together, nearly straight. */
    std::vector<double> run_lengths(const RockLayout &layout,
                                    const unsigned int line)
    {
      constexpr double straight   = 0.9; // cosine of what still is one trace
      const JointNetwork &network = *layout.network;
      std::vector<JointNetwork::Edge> edges;
      for (const auto *some : { &network.edges(), &layout.cracks })
        for (const JointNetwork::Edge &edge : *some)
          if (edge.line == line)
            edges.push_back(edge);
      std::map<unsigned int, std::vector<unsigned int>> at;
      for (unsigned int e = 0; e < edges.size(); ++e)
      {
        at[edges[e].from].push_back(e);
        at[edges[e].to].push_back(e);
      }
      DisjointSets runs(edges.size());
      const auto way_from = [&](const unsigned int e, const unsigned int v)
      {
        const unsigned int w = edges[e].from == v ? edges[e].to : edges[e].from;
        const Vector way     = network.point(w) - network.point(v);
        return Vector(way / way.norm());
      };
      for (const auto &[vertex, star] : at)
      {
        // Each edge goes on in the one that is straightest opposite to it.
        std::vector<bool> taken(star.size(), false);
        for (std::size_t i = 0; i < star.size(); ++i)
        {
          std::size_t best   = star.size();
          double best_cosine = -straight;
          for (std::size_t j = i + 1; j < star.size(); ++j)
          {
            const double cosine
                = way_from(star[i], vertex) * way_from(star[j], vertex);
            if (!taken[j] && cosine < best_cosine)
            {
              best_cosine = cosine;
              best        = j;
            }
          }
          if (taken[i] || best == star.size())
            continue;
          taken[i] = taken[best] = true;
          runs.unite(star[i], star[best]);
        }
      }
      std::map<unsigned int, double> length;
      for (unsigned int e = 0; e < edges.size(); ++e)
        length[runs.find(e)] += network.length(edges[e]);
      std::vector<double> result;
      for (const auto &[first, sum] : length)
        result.push_back(sum);
      return result;
    }

    double dip_of(const Piece &piece, const double mean)
    {
      const Vector way = piece[1] - piece[0];
      double dip       = std::atan2(way[1], way[0]) / constants::degree;
      while (dip > mean + 90.)
        dip -= 180.;
      while (dip < mean - 90.)
        dip += 180.;
      return dip;
    }

    Summary weighted_dip(const std::vector<Piece> &pieces, const double mean)
    {
      Summary result{ pieces.size(), 0., 0. };
      double weight = 0.;
      for (const Piece &piece : pieces)
      {
        const double length = piece[0].distance(piece[1]);
        result.mean += length * dip_of(piece, mean);
        weight += length;
      }
      if (weight == 0.)
        return result;
      result.mean /= weight;
      for (const Piece &piece : pieces)
        result.deviation += piece[0].distance(piece[1])
                            * std::pow(dip_of(piece, mean) - result.mean, 2);
      result.deviation = std::sqrt(result.deviation / weight);
      return result;
    }

    double total_length(const std::vector<Piece> &pieces)
    {
      double sum = 0.;
      for (const Piece &piece : pieces)
        sum += piece[0].distance(piece[1]);
      return sum;
    }

    std::vector<double> block_areas(const RockLayout &layout)
    {
      std::vector<double> areas;
      for (unsigned int f = 0; f < layout.group.size(); ++f)
        if (layout.group[f] != static_cast<unsigned int>(-1))
          areas.push_back(layout.faces->faces()[f].area);
      return areas;
    }

    std::string count(const std::size_t n, const std::string &one,
                      const std::string &many)
    {
      return std::to_string(n) + " " + (n == 1 ? one : many);
    }
  } // namespace

  std::string rock_statistics(const RockParameters &rock,
                              const RockLayout &layout)
  {
    std::ostringstream text;
    text.precision(10);
    text << "joints,quantity,unit,asked mean,asked deviation,drawn number,"
            "drawn mean,drawn deviation,made number,made mean,made "
            "deviation\n";
    const double area = layout.block_area();
    for (unsigned int j = 0; j < rock.joints.size(); ++j)
    {
      const RockJoints &joints = rock.joints[j];
      const auto made          = pieces_of(layout, layout.first_joint_line + j);
      const auto row
          = [&](const std::string &what, const std::string &unit,
                const Distribution *asked, const std::vector<double> &drawn,
                const Summary &in_blocks)
      {
        text << joints.name << "," << what << "," << unit << ",";
        if (asked != nullptr)
          text << asked->mean << "," << asked->deviation;
        else
          text << ",";
        text << "," << cells(summarise(drawn)) << "," << cells(in_blocks)
             << "\n";
      };
      const bool is_set        = joints.kind == RockJoints::set;
      const DrawnValues &drawn = layout.traces[j].drawn;
      const double mean        = is_set ? joints.dip.mean : 0.;
      if (is_set)
      {
        row("dip", "deg", &joints.dip, drawn.dip, weighted_dip(made, mean));
        row("spacing", "m", &joints.spacing, drawn.spacing,
            summarise(scan(made, mean)));
      }
      row("trace length", "m",
          is_set && !joints.is_persistent ? &joints.length : nullptr,
          drawn.length,
          summarise(run_lengths(layout, layout.first_joint_line + j)));
      if (is_set && !joints.is_persistent)
        row("gap", "m", &joints.gap, drawn.gap, {});

      // The value asked for is that of infinitely many lines with these means.
      text << joints.name << ",length per area,1/m,";
      if (is_set)
        text << (joints.is_persistent
                     ? 1.
                     : joints.length.mean
                           / (joints.length.mean + joints.gap.mean))
                    / joints.spacing.mean;
      text << ",," << layout.traces[j].n_traces << ","
           << total_length(layout.traces[j].pieces) / area << ",,"
           << made.size() << "," << total_length(made) / area << ",\n";
    }
    text << "blocks,area,m^2,,,,,," << cells(summarise(block_areas(layout)))
         << "\n";
    return text.str();
  }

  std::string rock_report(const RockParameters &rock, const RockLayout &layout)
  {
    const RockChanges &changes = layout.changes;
    const auto areas           = block_areas(layout);
    const Summary blocks       = summarise(areas);
    std::ostringstream text;
    text << "rock of " << count(layout.n_blocks(), "block", "blocks")
         << ", areas from "
         << number_text(*std::min_element(areas.begin(), areas.end())) << " to "
         << number_text(*std::max_element(areas.begin(), areas.end()))
         << " m^2, mean " << number_text(blocks.mean);
    for (unsigned int j = 0; j < rock.joints.size(); ++j)
    {
      const double length
          = total_length(pieces_of(layout, layout.first_joint_line + j));
      const std::size_t n_clipped = layout.traces[j].n_clipped;
      const std::size_t n_redrawn = layout.traces[j].drawn.n_redrawn;
      text << "\njoints '" << rock.joints[j].name
           << "': " << count(layout.traces[j].n_traces, "trace", "traces")
           << ", " << number_text(total_length(layout.traces[j].pieces))
           << " m in the rock, of which " << number_text(length)
           << " m are joints or cracks of the model";
      if (n_clipped > 0)
        text << "; " << count(n_clipped, "trace was", "traces were")
             << " cut off at the outline or the edge of their region";
      if (n_redrawn > 0)
        text << "; "
             << count(n_redrawn, "random value was", "random values were")
             << " not positive and drawn again";
    }
    if (changes.n_joined > 0)
      text << "\n"
           << count(changes.n_joined, "joint end was", "joint ends were")
           << " moved by less than 'Shortest edge', "
           << number_text(rock.shortest_edge)
           << " m, to meet another joint or a corner";
    const std::string dead_ends
        = "\ndead ends, joints that end in intact rock and part no blocks: ";
    if (changes.n_extended > 0)
      text << dead_ends << count(changes.n_extended, "end was", "ends were")
           << " lengthened to the next joint or border, by "
           << number_text(changes.extended_length) << " m in all";
    if (changes.n_dead_ends > 0)
      text << dead_ends << count(changes.n_dead_ends, "piece", "pieces") << ", "
           << number_text(changes.dead_length)
           << " m in all, cut back to the last joint that they meet";
    if (changes.n_cracks > 0)
      text << dead_ends << count(changes.n_cracks, "piece", "pieces") << ", "
           << number_text(changes.crack_length)
           << " m in all, kept as cracks inside blocks";
    if (changes.n_bridges > 0)
      text << "\n"
           << count(changes.n_bridges, "piece of a joint has",
                    "pieces of joints have")
           << " the same block on both sides, "
           << number_text(changes.bridge_length)
           << " m in all: cracks inside it";
    if (changes.n_short > 0)
      text << "\n"
           << count(changes.n_short, "piece of a joint", "pieces of joints")
           << " shorter than 'Shortest edge', "
           << number_text(rock.shortest_edge) << " m, left out, "
           << number_text(changes.short_length) << " m in all";
    if (changes.n_slivers > 0)
      text << "\nslivers, smaller than 'Smallest block', "
           << number_text(rock.smallest_block)
           << " m^2, or narrower than 'Narrowest block', "
           << number_text(rock.narrowest_block)
           << " m: " << count(changes.n_slivers, "block", "blocks") << ", "
           << number_text(changes.sliver_area)
           << " m^2 in all, joined to a neighbour";
    if (changes.n_kept_slivers > 0)
      text << "\nslivers that stayed, having no joint that could be taken out: "
           << count(changes.n_kept_slivers, "block", "blocks");
    return text.str();
  }
} // namespace quoin
