// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/layout/wall_layout.h>

#include <algorithm>
#include <array>
#include <limits>

#include "wall_sections.h"

namespace quoin
{
  namespace
  {
    constexpr const char *segments_name = "Wall segments";

    void enter_segment(ParameterEntries &entries, WallSegment &segment)
    {
      std::array<double, 2> start{};
      entries.numbers("Start", start,
                      "Corner x, y of the segment in plan that has the least "
                      "coordinates [m]");
      segment.start = { start[0], start[1] };
      entries.choice("Direction", segment.along, { { "x", 0 }, { "y", 1 } },
                     "Axis along which the segment runs from its start.");
      entries.nonnegative("Length", segment.length,
                          "Length of the segment, with the squares that it "
                          "shares with others [m]");
      entries.other(
          "Openings", "",
          "Openings as left [m], right [m], first course, last course, with "
          "semicolons between openings: distances from the start, and courses "
          "that count from 1 at the bottom through all storeys.",
          [&](const ParameterSection &section)
          {
            segment.openings = { read_openings(
                section, std::numeric_limits<unsigned int>::max()) };
          });
      if (const ParameterSection *section = entries.read_section())
        if (!(segment.length > 0.))
          section->fail("Length", "must be positive.");
    }

    bool is_space(const ParameterSection &top)
    {
      return ParameterSection(top, "Mesh").text("Dimension") == "3";
    }

    void refuse_space_entries(const ParameterSection &top,
                              const WallParameters &wall)
    {
      if (wall.thickness > 0.)
        ParameterSection(top, "Wall")
            .fail("Thickness",
                  "is for a wall in three dimensions: set 'Dimension = 3' in "
                  "section 'Mesh', or leave it at 0; the thickness of a plane "
                  "model is 'Thickness' before all sections.");
      const ParameterSection section(top, segments_name);
      if (!section.list("Names").empty())
        section.fail("Names", "is for a wall in three dimensions: set "
                              "'Dimension = 3' in section 'Mesh', or leave it "
                              "empty.");
    }

    /** Openings of a segment, with courses through all storeys, by storey. */
    std::vector<std::vector<WallOpening>>
    by_storey(const ParameterSection &section,
              const std::vector<WallStorey> &storeys,
              const std::vector<WallOpening> &openings)
    {
      std::vector<std::vector<WallOpening>> result(storeys.size());
      for (WallOpening opening : openings)
      {
        std::size_t s = 0;
        for (;
             s < storeys.size() && opening.first_course > storeys[s].n_courses;
             ++s)
        {
          opening.first_course -= storeys[s].n_courses;
          opening.last_course -= storeys[s].n_courses;
        }
        if (s == storeys.size() || opening.last_course > storeys[s].n_courses)
          section.fail("Openings", "must lie in courses of one storey, which "
                                   "count from 1 at the bottom of the wall "
                                   "through all storeys.");
        result[s].push_back(opening);
      }
      return result;
    }

    /** How the plans of two segments lie to each other. */
    struct Meeting
    {
      std::array<double, 2> low, high; /**< of what they share, if positive */

      double width(const unsigned int axis) const
      {
        return high[axis] - low[axis];
      }
    };

    Meeting meeting(const WallParameters &wall, const WallSegment &a,
                    const WallSegment &b)
    {
      const auto [low_a, high_a] = a.corners(wall.thickness);
      const auto [low_b, high_b] = b.corners(wall.thickness);
      Meeting result;
      for (unsigned int d = 0; d < 2; ++d)
      {
        result.low[d]  = std::max(low_a[d], low_b[d]);
        result.high[d] = std::min(high_a[d], high_b[d]);
      }
      return result;
    }

    std::string in_quotes(const WallSegment &segment)
    {
      return "'" + segment.name + "'";
    }

    /** Whether @p a and @p b touch or share a square; fails if they share
        another part of the plan. */
    bool meet(const ParameterSection &section, const WallParameters &wall,
              const WallSegment &a, const WallSegment &b)
    {
      const double exact    = 1e-9 * wall.unit_length;
      const Meeting between = meeting(wall, a, b);
      const double least    = std::min(between.width(0), between.width(1));
      const double most     = std::max(between.width(0), between.width(1));
      if (least < -exact)
        return false;
      if (least <= exact)
        return most > exact;
      if (a.along == b.along)
        section.fail("Names", "has " + in_quotes(a) + " and " + in_quotes(b)
                                  + ", which overlap: segments in the same "
                                    "direction may only touch.");
      if (least < wall.thickness - exact)
        section.fail("Names",
                     "has " + in_quotes(a) + " and " + in_quotes(b)
                         + ", which share a part of the plan that is only "
                         + number_text(least)
                         + " m wide: let each reach through the other, whose "
                           "thickness is "
                         + number_text(wall.thickness)
                         + " m, or end at its face.");
      return true;
    }

    /** Fails unless all segments hang together. */
    void check_plan(const ParameterSection &section, const WallParameters &wall)
    {
      const auto &segments = wall.segments;
      std::vector<bool> reached(segments.size(), false);
      std::vector<std::size_t> next = { 0 };
      reached[0]                    = true;
      while (!next.empty())
      {
        const std::size_t a = next.back();
        next.pop_back();
        for (std::size_t b = 0; b < segments.size(); ++b)
          if (a != b && meet(section, wall, segments[a], segments[b])
              && !reached[b])
          {
            reached[b] = true;
            next.push_back(b);
          }
      }
      for (std::size_t b = 0; b < segments.size(); ++b)
        if (!reached[b])
          section.fail("Names", "has " + in_quotes(segments[b])
                                    + ", which does not meet "
                                    + in_quotes(segments[0])
                                    + " or what hangs together with it: check "
                                      "'Start', 'Direction' and 'Length'.");
    }

    void check_openings(const ParameterSection &section,
                        const WallParameters &wall, const WallSegment &segment,
                        const std::vector<WallOpening> &openings)
    {
      for (const WallOpening &opening : openings)
      {
        if (opening.right > segment.length + 1e-9 * wall.unit_length)
          section.fail("Openings", "must have 0 <= left < right <= 'Length'.");
        for (const WallSegment &other : wall.segments)
        {
          if (other.along == segment.along)
            continue;
          const Meeting square = meeting(wall, segment, other);
          const double start   = segment.start[segment.along];
          const double exact   = 1e-9 * wall.unit_length;
          if (std::min(square.width(0), square.width(1)) > exact
              && opening.left < square.high[segment.along] - start - exact
              && square.low[segment.along] - start < opening.right - exact)
            section.fail(
                "Openings",
                "must not reach into the square that the segment "
                "shares with "
                    + in_quotes(other) + ", from "
                    + number_text(square.low[segment.along] - start) + " to "
                    + number_text(square.high[segment.along] - start) + " m.");
        }
      }
    }

    void check_bond(const ParameterSection &section, const WallParameters &wall)
    {
      if (!(wall.thickness > 0.))
        section.fail("Thickness", "must be positive for a wall in three "
                                  "dimensions, 'Dimension = 3' in section "
                                  "'Mesh'.");
      if (wall.bond == WallBond::random)
        section.fail("Bond", "must not be 'random' in three dimensions, where "
                             "joints lie at regular distances. Take another "
                             "bond.");
      if (!wall.structured)
        section.fail("Elements", "must be 'structured' in three dimensions.");
      const bool has_headers = wall.bond == WallBond::header
                               || wall.bond == WallBond::english
                               || wall.bond == WallBond::flemish;
      constexpr const char *one_wythe
          = "has headers, which go through the wall, and 'Wythes = 1' leaves "
            "nothing to bind: set 'Wythes' to 2 or more, or take 'running' or "
            "'stack' bond without 'Header courses'.";
      if (has_headers && wall.n_wythes == 1)
        section.fail("Bond", one_wythe);
      for (const WallStorey &storey : wall.storeys)
        if (!storey.header_courses.empty() && wall.n_wythes == 1)
          section.fail("Wythes",
                       std::string("does not go with 'Header courses'")
                           + (storey.name.empty()
                                  ? ""
                                  : " of storey '" + storey.name + "'")
                           + ": the wall " + one_wythe);
      if (wall.wythe_offset > 0. && wall.bond != WallBond::running
          && wall.bond != WallBond::stack)
        section.fail("Wythe offset", "is for 'running' and 'stack' bond: leave "
                                     "it at 0.");
    }
  } // namespace

  void WallSegment::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_segment);
  }

  std::array<dealii::Point<2>, 2>
  WallSegment::corners(const double thickness) const
  {
    dealii::Point<2> high = start;
    high[along] += length;
    high[1 - along] += thickness;
    return { { start, high } };
  }

  void read_segments(const ParameterSection &top, WallParameters &wall)
  {
    if (!is_space(top))
    {
      refuse_space_entries(top, wall);
      return;
    }
    {
      const ParameterSection section(top, segments_name);
      for (const std::string &name : section.list("Names"))
      {
        WallSegment segment
            = read_entries(ParameterSection(section, name), enter_segment);
        segment.name = name;
        wall.segments.push_back(segment);
      }
    }
    if (wall.segments.empty())
    {
      wall.segments.resize(1);
      wall.segments[0].length = wall.length;
      return;
    }
    if (wall.length > 0.)
      ParameterSection(top, "Wall")
          .fail("Length", "does not go with section 'Wall segments', whose "
                          "segments have lengths of their own: leave it at 0.");
    for (const WallSegment &segment : wall.segments)
      wall.length += segment.length;
  }

  void check_segments(const ParameterSection &top, WallParameters &wall)
  {
    if (wall.segments.empty())
      return;
    double unit = 0.;
    {
      const ParameterSection section(top, "Wall");
      check_bond(section, wall);
      unit = section.number("Unit length");
      if (wall.segments[0].name.empty())
      {
        if (unit > wall.length)
          section.fail("Unit length", "is longer than the wall, of "
                                          + number_text(wall.length) + " m.");
        for (const WallStorey &storey : wall.storeys)
          wall.segments[0].openings.push_back(storey.openings);
        return;
      }
    }
    const ParameterSection section(top, segments_name);
    check_plan(section, wall);
    for (WallSegment &segment : wall.segments)
    {
      const ParameterSection part(section, segment.name);
      if (unit > segment.length)
        part.fail("Length",
                  "is less than that of a unit, " + number_text(unit) + " m.");
      const auto openings = segment.openings[0];
      check_openings(part, wall, segment, openings);
      segment.openings = by_storey(part, wall.storeys, openings);
    }
  }
} // namespace quoin
