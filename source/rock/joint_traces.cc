// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_table.h>
#include <quoin/rock/joint_traces.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Point  = dealii::Point<2>;
    using Vector = dealii::Tensor<1, 2>;

    /** Lines and traces of a set, or Voronoi polygons; more take hours. */
    constexpr std::size_t most_traces = 1000000;

    [[noreturn]] void refuse_number(const RockJoints &joints,
                                    const std::string &what)
    {
      throw InputError("section 'Rock joints/" + joints.name + "': there are "
                       + "more than " + std::to_string(most_traces) + " "
                       + what);
    }

    double draw_positive(const Distribution &distribution, RandomStream &random,
                         unsigned int &n_redrawn)
    {
      for (;;)
      {
        const double value = distribution.draw(random);
        if (value > 0.)
          return value;
        ++n_redrawn;
      }
    }

    Vector direction(const double dip)
    {
      const double angle = dip * constants::degree;
      Vector result;
      result[0] = std::cos(angle);
      result[1] = std::sin(angle);
      return result;
    }

    /** Lines of traces and gaps that cover a circle. */
    class SetMaker
    {
    public:
      SetMaker(const RockParameters &rock, const RockJoints &joints,
               JointTraces &result)
        : rock(rock), joints(joints), result(result),
          along(direction(joints.dip.mean))
      {
        across[0]       = -along[1];
        across[1]       = along[0];
        const auto box  = bounding_box(rock.outline);
        const Point low = { box[0], box[1] }, high = { box[2], box[3] };
        const Point mid  = low + 0.5 * (high - low);
        const Vector way = mid - joints.origin;
        radius           = 0.5 * low.distance(high);
        middle_along     = way * along;
        middle_across    = way * across;
      }

      /** Traces, not yet cut. */
      void make()
      {
        lay_line(0, 0.);
        lay_side(1);
        lay_side(-1);
      }

      std::vector<Piece> traces;

    private:
      void lay_side(const int sign)
      {
        // Traces that are turned reach into the circle from beyond it.
        const double reach = radius + turned_reach();
        double offset      = 0.;
        for (int line = sign;; line += sign)
        {
          RandomStream random(rock.seed, joints.name + " spacing", line);
          const double spacing
              = draw_positive(joints.spacing, random, result.drawn.n_redrawn);
          offset += sign * spacing;
          if (sign * (offset - middle_across) > reach)
            return;
          if (result.drawn.spacing.size() == most_traces)
            refuse_number(joints, "lines from 'Origin' to the far side of the "
                                  "rock. Raise 'Spacing', or move 'Origin' "
                                  "nearer to the rock.");
          result.drawn.spacing.push_back(spacing);
          if (std::abs(offset - middle_across) <= reach)
            lay_line(line, offset);
        }
      }

      double turned_reach() const
      {
        const double turn
            = std::min(90., 3. * joints.dip.deviation) * constants::degree;
        const double half
            = joints.is_persistent
                  ? 2. * radius
                  : 0.5 * joints.length.mean + 1.5 * joints.length.deviation;
        return half * std::sin(turn);
      }

      void lay_line(const int line, const double offset)
      {
        RandomStream random(rock.seed, joints.name, line);
        const Point foot = joints.origin + offset * across;
        if (joints.is_persistent)
        {
          // Turned about the point nearest to the model's middle.
          const Point centre = foot + middle_along * along;
          add_trace(centre, 4. * radius, random);
          return;
        }
        const double end = middle_along + radius;
        // Some traces ahead, so that it is forgotten where the first one began.
        const double pitch = joints.length.mean + joints.gap.mean;
        double place = middle_along - radius - (5. + random.uniform()) * pitch;
        while (place < end)
        {
          const double length
              = draw_positive(joints.length, random, result.drawn.n_redrawn);
          if (result.drawn.length.size() == most_traces)
            refuse_number(joints, "traces. Raise 'Trace length', 'Gap' or "
                                  "'Spacing'.");
          result.drawn.length.push_back(length);
          add_trace(foot + (place + 0.5 * length) * along, length, random);
          place += length;
          if (joints.gap.mean > 0.)
          {
            const double gap
                = draw_positive(joints.gap, random, result.drawn.n_redrawn);
            result.drawn.gap.push_back(gap);
            place += gap;
          }
        }
      }

      void add_trace(const Point &centre, const double length,
                     RandomStream &random)
      {
        const double dip = joints.dip.draw(random);
        result.drawn.dip.push_back(dip);
        const Vector half = 0.5 * length * direction(dip);
        traces.push_back({ { centre - half, centre + half } });
      }

      const RockParameters &rock;
      const RockJoints &joints;
      JointTraces &result;
      const Vector along;
      Vector across;
      double radius, middle_along, middle_across;
    };

    std::vector<Piece> polyline_pieces(const RockJoints &joints)
    {
      std::vector<Piece> pieces;
      for (std::size_t i = 1; i < joints.points.size(); ++i)
        pieces.push_back({ { joints.points[i - 1], joints.points[i] } });
      return pieces;
    }

    std::vector<Piece> read_traces(const RockJoints &joints)
    {
      std::vector<Piece> pieces;
      try
      {
        for (const TableRow &row :
             read_number_table(joints.file, 4, "x1, y1, x2, y2 [m] of a trace"))
        {
          const auto &v = row.values;
          pieces.push_back({ { Point(v[0], v[1]), Point(v[2], v[3]) } });
        }
      }
      catch (const InputError &error)
      {
        throw InputError("section 'Rock joints/" + joints.name
                         + "', 'File': " + error.what());
      }
      return pieces;
    }

    const RockRegion *find_region(const RockParameters &rock,
                                  const std::string &name)
    {
      for (const RockRegion &region : rock.regions)
        if (region.name == name)
          return &region;
      return nullptr;
    }
  } // namespace

  JointTraces make_joint_traces(const RockParameters &rock,
                                const unsigned int number)
  {
    const RockJoints &joints = rock.joints[number];
    JointTraces result;
    std::vector<Piece> whole;
    switch (joints.kind)
    {
    case RockJoints::set:
    {
      SetMaker maker(rock, joints, result);
      maker.make();
      whole = std::move(maker.traces);
      break;
    }
    case RockJoints::polyline:
      whole = polyline_pieces(joints);
      break;
    case RockJoints::traces:
      whole = read_traces(joints);
      break;
    case RockJoints::voronoi:
    {
      const auto box = bounding_box(rock.outline);
      if (!((box[2] - box[0]) / joints.block_size * (box[3] - box[1])
                / joints.block_size
            <= most_traces))
        refuse_number(joints, "polygons in the rock. Raise 'Block size'.");
      whole = voronoi_borders(box, joints.block_size, joints.relaxation,
                              RandomStream(rock.seed, joints.name, 0));
      break;
    }
    }

    const RockRegion *region = find_region(rock, joints.region);
    for (const Piece &trace : whole)
    {
      std::vector<Piece> inside = clip(trace, rock.outline);
      if (region != nullptr)
      {
        std::vector<Piece> in_region;
        for (const Piece &piece : inside)
          for (const Piece &part : clip(piece, region->polygon))
            in_region.push_back(part);
        inside = in_region;
      }
      if (inside.empty())
        continue;
      result.n_clipped += inside.size() > 1 || inside[0] != trace;
      for (const Piece &piece : inside)
      {
        result.pieces.push_back(piece);
        result.trace.push_back(result.n_traces);
      }
      ++result.n_traces;
    }
    return result;
  }
} // namespace quoin
