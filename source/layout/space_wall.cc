// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/layout/space_wall.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "wall_names.h"

namespace quoin
{
  namespace
  {
    /** The wall of one segment, as lay_wall() takes it. */
    WallParameters plane_wall(const WallParameters &wall,
                              const WallSegment &segment)
    {
      WallParameters plane = wall;
      plane.length         = segment.length;
      for (std::size_t s = 0; s < plane.storeys.size(); ++s)
        plane.storeys[s].openings = segment.openings[s];
      return plane;
    }

    /** Where other segments cross @p segment or end in it. */
    std::vector<std::array<double, 2>> junctions(const WallParameters &wall,
                                                 const WallSegment &segment)
    {
      const double exact     = 1e-9 * wall.unit_length;
      const auto [low, high] = segment.corners(wall.thickness);
      std::vector<std::array<double, 2>> result;
      for (const WallSegment &other : wall.segments)
      {
        const auto [begin, end] = other.corners(wall.thickness);
        const unsigned int a = segment.along, b = 1 - a;
        if (other.along != a && begin[a] < high[a] - exact
            && low[a] + exact < end[a] && begin[b] < high[b] - exact
            && low[b] + exact < end[b])
          result.push_back({ { begin[a] - low[a], end[a] - low[a] } });
      }
      std::sort(result.begin(), result.end());
      return result;
    }

    /** Distances of the ends of @p junctions from the next head joint of the
        bond, in a course that is @p shifted or not; their sum [m]. */
    double overlap(const WallParameters &wall, const WallSegment &segment,
                   const std::vector<std::array<double, 2>> &junctions,
                   const bool shifted)
    {
      WallParameters course = wall;
      course.length         = segment.length;
      course.begins_shifted = shifted;
      course.storeys.assign(1, WallStorey());
      course.storeys[0].n_courses = 1;
      course.bottom_platen        = 0.;
      const WallLayout layout     = lay_wall(course);
      double sum                  = 0.;
      for (const auto &junction : junctions)
        for (const double end : junction)
        {
          if (end <= 0. || end >= segment.length)
            continue;
          double least = wall.unit_length;
          for (const WallUnit &unit : layout.units)
            least = std::min(least, std::abs(unit.right - end));
          sum += least;
        }
      return sum;
    }

    /** Whether segments along @p axis give way to others in their shifted
        courses: their head joints in the other ones are the farther from the
        ends that they have there. */
    bool yields_shifted(const WallParameters &wall, const unsigned int axis)
    {
      double others = 0., shifted = 0.;
      for (const WallSegment &segment : wall.segments)
      {
        if (segment.along != axis)
          continue;
        const auto ends = junctions(wall, segment);
        others += overlap(wall, segment, ends, false);
        shifted += overlap(wall, segment, ends, true);
      }
      return shifted <= others + 1e-9 * wall.unit_length;
    }

    class Bricklayer
    {
    public:
      Bricklayer(const WallParameters &wall, SpaceWall &layout)
        : wall(wall), layout(layout), yields{ { yields_shifted(wall, 0),
                                                yields_shifted(wall, 1) } }
      {
      }

      /** Adds the units of segment number @p s. */
      void lay(unsigned int s);

    private:
      void add(const WallUnit &unit, unsigned int s, unsigned int first_wythe,
               unsigned int end_wythe, const std::vector<double> &levels);
      unsigned int body(const WallUnit &unit);

      const WallParameters &wall;
      SpaceWall &layout;
      /** By axis: whether segments give way in their shifted courses. */
      const std::array<bool, 2> yields;
      unsigned int n_bodies = 0;
      std::map<unsigned int, unsigned int> layers; /**< bodies by row */
    };

    unsigned int Bricklayer::body(const WallUnit &unit)
    {
      if (unit.kind == WallUnit::unit || unit.kind == WallUnit::lintel)
        return n_bodies++;
      const auto [place, is_new] = layers.emplace(unit.row, n_bodies);
      n_bodies += is_new;
      return place->second;
    }

    void Bricklayer::add(const WallUnit &unit, const unsigned int s,
                         const unsigned int first_wythe,
                         const unsigned int end_wythe,
                         const std::vector<double> &levels)
    {
      const WallSegment &segment = wall.segments[s];
      const unsigned int a = segment.along, b = 1 - a;
      WallBox box;
      box.unit        = unit;
      box.segment     = s;
      box.body        = body(unit);
      auto &low       = box.box.low;
      auto &high      = box.box.high;
      low[a]          = segment.start[a] + unit.left;
      high[a]         = segment.start[a] + unit.right;
      const auto face = [&](const unsigned int wythe)
      { return segment.start[b] + wall.thickness * wythe / wall.n_wythes; };
      low[b]  = face(first_wythe);
      high[b] = face(end_wythe);
      low[2]  = levels[unit.row];
      high[2] = levels[unit.row + 1];
      if (wall.cracks && unit.through && wall.n_wythes > 1)
        box.crack = b;
      else if (unit.cracks)
        box.crack = a;
      layout.boxes.push_back(box);
    }

    void Bricklayer::lay(const unsigned int s)
    {
      const WallSegment &segment = wall.segments[s];
      WallParameters plane       = plane_wall(wall, segment);
      // Segments along y run through where those along x do not.
      if (segment.along == 1 && yields[0] == yields[1])
        plane.begins_shifted = !plane.begins_shifted;
      WallRun run = { junctions(wall, segment), yields[segment.along], 0. };
      for (unsigned int wythe = 0; wythe < wall.n_wythes; ++wythe)
      {
        run.shift               = wythe % 2 == 0 ? 0. : wall.wythe_offset;
        const WallLayout wythes = lay_wall(plane, run);
        for (const WallUnit &unit : wythes.units)
        {
          const bool is_whole = unit.kind != WallUnit::unit || unit.through;
          if (!is_whole)
            add(unit, s, wythe, wythe + 1, wythes.levels);
          else if (wythe == 0)
            add(unit, s, 0, wall.n_wythes, wythes.levels);
        }
        layout.counts.n_joined += wythes.n_joined;
        if (wythe == 0)
          layout.counts.n_lintels += wythes.n_lintels;
        layout.counts.storeys = wythes.storeys;
      }
    }

    /** Names of the faces of a wall. */
    class FaceNames
    {
    public:
      FaceNames(const WallParameters &wall, const SpaceWall &layout,
                const BoxGrid &grid)
        : wall(wall), layout(layout), grid(grid), exact(1e-9 * wall.unit_length)
      {
      }

      /** Name of @p face; a joint is added to the set of joints. */
      std::string operator()(const BoxGrid::Face &face)
      {
        if (face.below < 0 || face.above < 0)
          return outer(face);
        const std::string name = joint(face);
        if (!name.empty())
          joints.insert(name);
        return name;
      }

      std::set<std::string> joints;

    private:
      std::string joint(const BoxGrid::Face &face) const;
      std::string outer(const BoxGrid::Face &face) const;
      std::string outer_side(const BoxGrid::Face &face) const;

      const WallParameters &wall;
      const SpaceWall &layout;
      const BoxGrid &grid;
      const double exact;
    };

    std::string FaceNames::joint(const BoxGrid::Face &face) const
    {
      const WallBox &below = layout.boxes[face.below];
      const WallBox &above = layout.boxes[face.above];
      if (below.body == above.body)
      {
        const auto &[low, high] = below.box;
        const unsigned int a    = face.axis;
        const bool cracks       = face.below == face.above && below.crack == a
                            && std::abs(grid.planes(a)[face.place[a]]
                                        - 0.5 * (low[a] + high[a]))
                                   < exact;
        return cracks ? with_name("crack", below.unit.part) : "";
      }
      const bool is_collar = below.segment == above.segment
                             && face.axis != wall.segments[below.segment].along;
      return joint_name(below.unit, above.unit,
                        face.axis == 2 ? "bed"
                        : is_collar    ? "collar"
                                       : "head");
    }

    std::string FaceNames::outer(const BoxGrid::Face &face) const
    {
      if (face.axis == 2)
        return face.place[2] == 0                           ? "base"
               : face.place[2] + 1 == grid.planes(2).size() ? "top"
                                                            : "opening";
      const WallUnit &unit
          = layout.boxes[std::max(face.below, face.above)].unit;
      return unit.kind == WallUnit::slab
                 ? surface_name(unit) + "_" + outer_side(face)
                 : outer_side(face);
    }

    std::string FaceNames::outer_side(const BoxGrid::Face &face) const
    {
      const unsigned int a = face.axis, b = 1 - a;
      const double x     = grid.planes(a)[face.place[a]];
      const auto &planes = grid.planes(b);
      const double middle
          = 0.5 * (planes[face.place[b]] + planes[face.place[b] + 1]);
      const bool is_low = face.below < 0;
      std::string end;
      for (const WallSegment &segment : wall.segments)
      {
        const auto [low, high] = segment.corners(wall.thickness);
        if (middle < low[b] || middle > high[b]
            || std::abs(x - (is_low ? low[a] : high[a])) > exact)
          continue;
        if (segment.along != a)
          return with_name(is_low ? "front" : "back", segment.name);
        end = with_name(is_low ? "left" : "right", segment.name);
      }
      return end.empty() ? "opening" : end;
    }

    void check_widths(const WallParameters &wall, const BoxGrid &grid)
    {
      for (unsigned int d = 0; d < 3; ++d)
      {
        const auto &x = grid.planes(d);
        for (std::size_t i = 1; i < x.size(); ++i)
          if (x[i] - x[i - 1] < 0.2 * wall.element_size)
            throw InputError(
                std::string("section 'Wall': the mesh would need a layer of "
                            "elements from ")
                + "xyz"[d] + " = " + number_text(x[i - 1]) + " to "
                + number_text(x[i])
                + " m, much narrower than the element size of "
                + number_text(wall.element_size)
                + " m. Take a smaller 'Element size', or dimensions that fit "
                  "the bond.");
      }
    }
  } // namespace

  SpaceWall lay_space_wall(const WallParameters &wall)
  {
    SpaceWall layout;
    Bricklayer layer(wall, layout);
    for (unsigned int s = 0; s < wall.segments.size(); ++s)
      layer.lay(s);
    return layout;
  }

  std::string space_wall_report(const WallParameters &wall,
                                const SpaceWall &layout)
  {
    unsigned int n_headers = 0;
    WallLayout counted     = layout.counts;
    std::set<unsigned int> slabs;
    for (const WallBox &box : layout.boxes)
    {
      n_headers += box.unit.through;
      if (box.unit.kind == WallUnit::slab && !slabs.insert(box.body).second)
        continue;
      counted.units.push_back(box.unit);
      counted.units.back().cracks = box.crack < 3;
    }
    std::string text = wall_report(counted);
    const auto end   = std::min(text.find('\n'), text.size());
    std::string more;
    if (wall.n_wythes > 1)
      more += ", " + std::to_string(n_headers) + " of the units headers";
    if (wall.segments.size() > 1)
      more += ", in " + std::to_string(wall.segments.size()) + " segments";
    return text.insert(end, more);
  }

  GmshGeometry space_wall_mesh(const WallParameters &wall,
                               const SpaceWall &layout)
  {
    std::vector<BoxGrid::Box> boxes;
    std::array<std::vector<double>, 3> cuts;
    for (const WallBox &box : layout.boxes)
    {
      boxes.push_back(box.box);
      if (box.crack < 3)
        cuts[box.crack].push_back(
            0.5 * (box.box.low[box.crack] + box.box.high[box.crack]));
    }
    const BoxGrid grid(boxes, cuts, 1e-9 * wall.unit_length);
    check_widths(wall, grid);
    FaceNames names(wall, layout, grid);
    GmshGeometry made;
    made.text = grid.mesh(
        wall.element_size,
        [&](const unsigned int b)
        { return surface_name(layout.boxes[b].unit); },
        [&](const BoxGrid::Face &face) { return names(face); });
    made.joint_curves = { names.joints.begin(), names.joints.end() };
    return made;
  }
} // namespace quoin
