// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/none.h>
#include <quoin/rock/rock_layout.h>

#include <algorithm>
#include <map>

namespace quoin
{
  namespace
  {
    using Point = dealii::Point<2>;
    class Layer
    {
    public:
      explicit Layer(const RockParameters &rock) : rock(rock)
      {
      }

      RockLayout lay()
      {
        layout.network = std::make_unique<JointNetwork>(rock.shortest_edge);
        add_borders();
        add_joints();
        layout.network->cut();
        drop_outside();
        treat_dead_ends();
        join_slivers();
        find_groups();
        if (layout.n_blocks() == 0)
          throw InputError("section 'Rock regions': holes leave nothing of the "
                           "rock. Make them smaller than the 'Outline'.");
        layout.changes.n_joined = layout.network->n_joined();
        return std::move(layout);
      }

    private:
      void add_borders();
      void add_joints();
      void drop_outside();
      void treat_dead_ends();
      void join_slivers();
      bool join_some_slivers();
      void find_groups();

      /** The region that prevails at @p p; none: plain rock. */
      unsigned int region_at(const Point &p) const;
      bool is_hole(const unsigned int region) const
      {
        return region != none && rock.regions[region].use == RockRegion::hole;
      }

      const RockParameters &rock;
      RockLayout layout;
    };

    unsigned int Layer::region_at(const Point &p) const
    {
      for (unsigned int r = rock.regions.size(); r-- > 0;)
        if (rock.regions[r].use != RockRegion::zone
            && contains(rock.regions[r].polygon, p))
          return r;
      return none;
    }

    void Layer::add_borders()
    {
      const auto add = [&](const Polygon &polygon, const unsigned int line)
      {
        for (std::size_t i = 0; i < polygon.size(); ++i)
          layout.network->add(
              { { polygon[i], polygon[(i + 1) % polygon.size()] } }, line,
              true);
      };
      layout.line_names.push_back("outline");
      add(rock.outline, 0);
      for (unsigned int r = 0; r < rock.regions.size(); ++r)
      {
        layout.line_names.push_back(rock.regions[r].name);
        if (rock.regions[r].use != RockRegion::zone)
          add(rock.regions[r].polygon, 1 + r);
      }
      layout.first_joint_line = layout.line_names.size();
    }

    /**
     * @p pieces without points that are no farther than @p shortest from the
     * one before on the same line: pieces that short are left out, and a finely
     * drawn line would go with them. Ends of lines stay.
     */
    std::vector<Piece> thinned(const std::vector<Piece> &pieces,
                               const double shortest)
    {
      std::vector<Piece> result;
      for (std::size_t i = 0; i < pieces.size();)
      {
        std::vector<Point> kept = { pieces[i][0] };
        Point end;
        do
        {
          end = pieces[i][1];
          if (end.distance(kept.back()) > shortest)
            kept.push_back(end);
          ++i;
        } while (i < pieces.size() && pieces[i][0] == end);
        while (kept.size() > 1 && kept.back().distance(end) <= shortest)
          kept.pop_back();
        kept.push_back(end);
        for (std::size_t k = 1; k < kept.size(); ++k)
          result.push_back({ { kept[k - 1], kept[k] } });
      }
      return result;
    }

    void Layer::add_joints()
    {
      for (unsigned int j = 0; j < rock.joints.size(); ++j)
      {
        const RockJoints &joints = rock.joints[j];
        layout.traces.push_back(make_joint_traces(rock, j));
        const bool is_drawn = joints.kind == RockJoints::polyline
                              || joints.kind == RockJoints::traces;
        const auto &pieces = layout.traces.back().pieces;
        for (const Piece &piece :
             is_drawn ? thinned(pieces, rock.shortest_edge) : pieces)
        {
          const double length = piece[0].distance(piece[1]);
          if (length > rock.shortest_edge)
          {
            layout.network->add(piece, layout.line_names.size(), false);
            continue;
          }
          ++layout.changes.n_short;
          layout.changes.short_length += length;
        }
        layout.line_names.push_back(joints.name);
      }
    }

    void Layer::drop_outside()
    {
      layout.network->remove(
          [&](const JointNetwork::Edge &edge)
          {
            if (edge.border != none)
              return false;
            const Point p = layout.network->middle(edge);
            if (!contains(rock.outline, p))
              return true;
            const unsigned int region = region_at(p);
            return is_hole(region)
                   || (region != none && !rock.regions[region].has_joints);
          });
    }

    void Layer::treat_dead_ends()
    {
      RockChanges &changes  = layout.changes;
      JointNetwork &network = *layout.network;
      if (rock.dead_ends == RockParameters::extend)
      {
        // A joint that is lengthened may end another one's way.
        constexpr unsigned int most_rounds = 20;
        for (unsigned int round = 0; round < most_rounds; ++round)
        {
          const unsigned int n = network.extend_ends(changes.extended_length);
          changes.n_extended += n;
          if (n == 0)
            break;
          drop_outside();
        }
      }
      const BlockFaces faces(network);
      std::vector<bool> goes(network.edges().size(), false);
      const auto take
          = [&](const std::vector<unsigned int> &edges, const bool keep,
                unsigned int &number, double &length)
      {
        for (const unsigned int e : edges)
        {
          goes[e] = true;
          ++number;
          length += network.length(network.edges()[e]);
          if (keep)
            layout.cracks.push_back(network.edges()[e]);
        }
      };
      if (rock.dead_ends == RockParameters::keep)
        take(faces.dead_ends(), true, changes.n_cracks, changes.crack_length);
      else
        take(faces.dead_ends(), false, changes.n_dead_ends,
             changes.dead_length);
      take(faces.bridges(), true, changes.n_bridges, changes.bridge_length);
      std::size_t e = 0;
      network.remove([&](const JointNetwork::Edge &) { return goes[e++]; });
    }

    void Layer::join_slivers()
    {
      while (join_some_slivers())
      {
      }
    }

    /** Joins slivers that do not touch each other; false: none was left. */
    bool Layer::join_some_slivers()
    {
      JointNetwork &network         = *layout.network;
      layout.faces                  = std::make_unique<BlockFaces>(network);
      const BlockFaces &faces       = *layout.faces;
      layout.changes.n_kept_slivers = 0;

      std::vector<unsigned int> slivers;
      for (unsigned int f = 0; f < faces.faces().size(); ++f)
      {
        const auto &face = faces.faces()[f];
        if ((face.area < rock.smallest_block
             || face.width() < rock.narrowest_block)
            && !is_hole(region_at(faces.inner_point(f))))
          slivers.push_back(f);
      }
      std::sort(slivers.begin(), slivers.end(),
                [&](const unsigned int a, const unsigned int b)
                { return faces.faces()[a].area < faces.faces()[b].area; });

      std::vector<bool> is_settled(faces.faces().size(), false);
      std::vector<bool> goes(network.edges().size(), false);
      bool has_joined = false;
      for (const unsigned int f : slivers)
      {
        if (is_settled[f])
          continue;
        std::map<unsigned int, double> shared; // length by neighbour
        const auto each_joint = [&](const auto &act)
        {
          const auto &face = faces.faces()[f];
          const auto along = [&](const BlockFaces::Loop &loop)
          {
            for (const unsigned int h : loop)
              if (network.edges()[h / 2].border == none)
                act(h);
          };
          along(face.outer);
          for (const auto &loop : face.inner)
            along(loop);
        };
        each_joint(
            [&](const unsigned int h)
            {
              const unsigned int other = faces.face(h ^ 1);
              if (other != BlockFaces::outside && other != f)
                shared[other] += network.length(network.edges()[h / 2]);
            });
        const auto longest = std::max_element(shared.begin(), shared.end(),
                                              [](const auto &a, const auto &b)
                                              { return a.second < b.second; });
        if (longest == shared.end())
        {
          ++layout.changes.n_kept_slivers;
          continue;
        }
        const unsigned int other = longest->first;
        if (is_settled[other])
          continue;
        is_settled[f] = is_settled[other] = true;
        each_joint(
            [&](const unsigned int h)
            {
              if (faces.face(h ^ 1) == other)
                goes[h / 2] = true;
            });
        ++layout.changes.n_slivers;
        layout.changes.sliver_area += faces.faces()[f].area;
        has_joined = true;
      }
      if (!has_joined)
        return false;
      std::size_t e = 0;
      network.remove([&](const JointNetwork::Edge &) { return goes[e++]; });
      return true;
    }

    void Layer::find_groups()
    {
      for (unsigned int f = 0; f < layout.faces->faces().size(); ++f)
      {
        const unsigned int region = region_at(layout.faces->inner_point(f));
        layout.region.push_back(region);
        layout.group.push_back(is_hole(region)  ? none
                               : region == none ? 0
                                                : 1 + region);
      }
    }
  } // namespace

  unsigned int RockLayout::n_blocks() const
  {
    return group.size() - std::count(group.begin(), group.end(), none);
  }

  double RockLayout::block_area() const
  {
    double sum = 0.;
    for (unsigned int f = 0; f < group.size(); ++f)
      if (group[f] != none)
        sum += faces->faces()[f].area;
    return sum;
  }

  RockLayout lay_rock(const RockParameters &rock)
  {
    return Layer(rock).lay();
  }
} // namespace quoin
