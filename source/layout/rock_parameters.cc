// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/named_sections.h>
#include <quoin/layout/rock_parameters.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "element_limit.h"

namespace quoin
{
  namespace
  {
    using Point = dealii::Point<2>;
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;

    /** "x, y; x, y; ..." */
    Polygon read_points(const ParameterSection &section,
                        const std::string &name, const std::size_t at_least)
    {
      Polygon points;
      for (const auto &row :
           section.rows(name, 2,
                        "must be points x, y [m], separated by semicolons, "
                        "such as '0, 0; 10, 0; 10, 5'."))
        points.emplace_back(row[0], row[1]);
      if (points.size() < at_least)
        section.fail(name, "needs at least " + std::to_string(at_least)
                               + " points x, y, separated by semicolons.");
      return points;
    }

    void check_polygon(const ParameterSection &section, const std::string &name,
                       const Polygon &polygon)
    {
      if (!is_simple(polygon) || signed_area(polygon) == 0.)
        section.fail(name, "must be the corners of a polygon with an area "
                           "whose sides do not cross or touch.");
    }

    Distribution read_distribution(const ParameterSection &section,
                                   const std::string &name)
    {
      try
      {
        return Distribution::parse(section.text(name));
      }
      catch (const std::invalid_argument &error)
      {
        section.fail(name, error.what());
      }
    }

    /** Of lengths, which are drawn again until they are positive. */
    Distribution read_length(const ParameterSection &section,
                             const std::string &name)
    {
      const Distribution distribution = read_distribution(section, name);
      if (distribution.kind == DistributionKind::von_mises)
        section.fail(name, "is a length: 'Fisher' is for angles. Take "
                           "'log-normal' or 'exponential'.");
      // Beyond, most values are nothing beside the mean, or below all numbers.
      if (distribution.kind == DistributionKind::log_normal
          && distribution.deviation > 1e3 * distribution.mean)
        section.fail(name, "must have a standard deviation of at most a "
                           "thousand times its mean.");
      if (distribution.share_below_zero() > 0.025)
        section.fail(name, "must be positive, and with this mean and deviation "
                           "one value in forty would not be. Take "
                           "'log-normal', or a smaller deviation.");
      return distribution;
    }

    const char *distribution_text
        = "A number, or one of 'uniform', 'normal', 'log-normal' with mean and "
          "standard deviation, or 'exponential' with the mean";
  } // namespace

  void RockRegion::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Shape", "polygon", Selection("polygon|circle|arch"),
                      "arch: the section of a tunnel with floor, walls and a "
                      "roof that is an arc of a circle.");
    prm.declare_entry("Points", "", Anything(),
                      "Polygon: x, y; x, y; ... of its corners [m]");
    prm.declare_entry("Centre", "0, 0", Anything(),
                      "x, y of the circle's centre, or of the middle of the "
                      "arch's floor [m]");
    prm.declare_entry("Radius", "0", Double(), "Of the circle [m]");
    prm.declare_entry("Width", "0", Double(), "Of the arch [m]");
    prm.declare_entry("Wall height", "0", Double(),
                      "Of the arch, up to its roof [m]");
    prm.declare_entry("Rise", "0", Double(),
                      "Of the arch's roof above its walls, at most half of "
                      "its width [m]");
    prm.declare_entry("Corners", "24", Integer(3, 10000),
                      "Of the polygon instead of the circle, or chords of the "
                      "arch's roof");
    prm.declare_entry("Use", "body", Selection("body|hole|zone"),
                      "body: a physical surface with the region's name, for a "
                      "material of its own or to be excavated; hole: nothing "
                      "is there; zone: only joints that name it know it. Of "
                      "regions that overlap, the later one prevails.");
    prm.declare_entry("Outline is a joint", "yes",
                      Selection("yes|no|true|false"),
                      "Of a body: the physical curve with the region's name "
                      "is a joint.");
    prm.declare_entry("Joints inside", "yes", Selection("yes|no|true|false"),
                      "Of a body: whether joints go through it.");
    prm.declare_entry("Refine mesh", "no", Selection("yes|no|true|false"),
                      "Whether elements are as fine as 'Finest element size' "
                      "of section 'Rock' says along its outline.");
  }

  RockRegion RockRegion::read(const ParameterSection &section,
                              const std::string &name)
  {
    RockRegion region;
    region.name             = name;
    const std::string shape = section.text("Shape");
    const auto centre       = section.numbers<2>("Centre");
    const Point middle(centre[0], centre[1]);
    const unsigned int n = section.integer("Corners");
    if (shape == "circle")
      region.polygon = circle_polygon(middle, section.positive("Radius"), n);
    else if (shape == "arch")
    {
      const double width  = section.positive("Width");
      const double height = section.nonnegative("Wall height");
      const double rise   = section.within("Rise", 0., 0.5 * width);
      if (height + rise == 0.)
        section.fail("Wall height", "and 'Rise' must not both be zero.");
      region.polygon = arch_polygon(middle, width, height, rise, n);
    }
    else
    {
      region.polygon = read_points(section, "Points", 3);
      check_polygon(section, "Points", region.polygon);
    }
    if (signed_area(region.polygon) < 0.)
      std::reverse(region.polygon.begin(), region.polygon.end());
    region.use = section.choice<Use>(
        "Use", { { "body", body }, { "hole", hole }, { "zone", zone } });
    region.is_outlined  = section.flag("Outline is a joint");
    region.has_joints   = section.flag("Joints inside");
    region.refines_mesh = section.flag("Refine mesh");
    if (region.refines_mesh && region.use == zone)
      section.fail("Refine mesh", "needs the outline of a body or a hole: a "
                                  "zone has none in the mesh.");
    return region;
  }

  void RockJoints::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Kind", "set", Selection("set|polyline|traces|Voronoi"),
                      "set: parallel lines on which traces and gaps follow "
                      "each other; polyline: one joint through given points; "
                      "traces: straight joints from a file; Voronoi: the "
                      "borders of random polygons.");
    prm.declare_entry("Dip", "0", Anything(),
                      "Set: anticlockwise from the x axis. A number, or one of "
                      "'uniform', 'normal', 'Fisher' with mean and standard "
                      "deviation, such as 'Fisher 30, 5' [deg]");
    prm.declare_entry("Spacing", "0", Anything(),
                      std::string("Set: from line to line, across the mean "
                                  "dip. ")
                          + distribution_text + " [m]");
    prm.declare_entry("Trace length", "persistent", Anything(),
                      "Set: as 'Spacing', or 'persistent': from border to "
                      "border [m]");
    prm.declare_entry("Gap", "0", Anything(),
                      "Set: between traces on a line; as 'Spacing', or 0 [m]");
    prm.declare_entry("Origin", "0, 0", Anything(),
                      "Set: x, y of a point on the first line [m]");
    prm.declare_entry("Points", "", Anything(),
                      "Polyline: x, y; x, y; ... [m]");
    prm.declare_entry("File", "", Anything(),
                      "Traces: a table with x1, y1, x2, y2 in each row [m], "
                      "relative to the folder of this file");
    prm.declare_entry("Block size", "0", Double(),
                      "Voronoi: root of the mean area of polygons [m]");
    prm.declare_entry("Relaxation", "0", Integer(0, 1000),
                      "Voronoi: how often sites are moved to the middle of "
                      "their polygons, which become more regular; 5 are many");
    prm.declare_entry("Region", "", Anything(),
                      "In which alone they are, of section 'Rock regions'; "
                      "empty: everywhere.");
  }

  namespace
  {
    void read_set(const ParameterSection &section, RockJoints &joints)
    {
      joints.dip = read_distribution(section, "Dip");
      if (!(std::abs(joints.dip.mean) <= 360.))
        section.fail("Dip", "must have a mean between -360 and 360 degrees.");
      if (joints.dip.kind == DistributionKind::log_normal
          || joints.dip.kind == DistributionKind::exponential)
        section.fail("Dip", "is an angle: take 'Fisher', 'normal' or "
                            "'uniform'.");
      joints.spacing       = read_length(section, "Spacing");
      joints.is_persistent = section.text("Trace length") == "persistent";
      if (!joints.is_persistent)
      {
        joints.length          = read_length(section, "Trace length");
        const Distribution gap = read_distribution(section, "Gap");
        if (gap.kind != DistributionKind::constant || gap.mean != 0.)
          joints.gap = read_length(section, "Gap");
      }
      const auto origin = section.numbers<2>("Origin");
      joints.origin     = Point(origin[0], origin[1]);
    }
  } // namespace

  RockJoints RockJoints::read(const ParameterSection &section,
                              const std::string &name)
  {
    RockJoints joints;
    joints.name   = name;
    joints.kind   = section.choice<Kind>("Kind", { { "set", set },
                                                   { "polyline", polyline },
                                                   { "traces", traces },
                                                   { "Voronoi", voronoi } });
    joints.region = section.text("Region");
    switch (joints.kind)
    {
    case set:
      read_set(section, joints);
      break;
    case polyline:
      joints.points = read_points(section, "Points", 2);
      break;
    case traces:
    {
      const std::string file = section.text("File");
      if (file.empty())
        section.fail("File", "must name a table of traces.");
      joints.file = file.front() == '/' ? file : section.folder() + file;
      std::error_code error; // a name may be too long for any file
      if (!std::filesystem::is_regular_file(joints.file, error))
        section.fail("File", "does not exist: there is no file '" + joints.file
                                 + "'. Give the path from the folder of the "
                                   "parameter file.");
      break;
    }
    case voronoi:
      joints.block_size = section.positive("Block size");
      joints.relaxation = section.integer("Relaxation");
      break;
    }
    return joints;
  }

  void RockParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(
        "Outline", "", Anything(),
        "x, y; x, y; ... of the corners of rock that the program "
        "cuts into blocks itself, instead of reading 'Mesh/File'; "
        "empty: no such rock [m]");
    prm.declare_entry("Sides", "", Anything(),
                      "Names of the sides, the first one from the first to the "
                      "second corner: physical curves. Sides may share one; "
                      "empty: all are 'outline'.");
    prm.declare_entry("Group", "rock", Anything(),
                      "Physical surface of the blocks that are in no region");
    prm.declare_entry("Random seed", "1", Integer(0),
                      "Another seed, other joints.");
    prm.declare_entry("Dead ends", "cut", Selection("cut|extend|keep"),
                      "Joints that end inside a block. cut: they go back to "
                      "the last joint that they met; extend: they go straight "
                      "on to the next joint or border; keep: they are cracks.");
    prm.declare_entry("Shortest edge", "0", Double(),
                      "Ends of joints that are nearer to each other or to "
                      "another joint are moved together; 0: a tenth of the "
                      "element size [m]");
    prm.declare_entry("Smallest block", "0", Double(),
                      "Smaller ones are joined to the neighbour with which "
                      "they share the longest joint; 0: the square of twice "
                      "the shortest edge [m^2]");
    prm.declare_entry("Narrowest block", "0", Double(),
                      "Likewise narrower ones, by twice their area over their "
                      "perimeter, which is the width of a strip; 0: the "
                      "shortest edge [m]");
    prm.declare_entry("Element size", "0", Double(),
                      "Edges of elements are no longer [m]");
    prm.declare_entry("Finest element size", "0", Double(),
                      "Along outlines of regions that refine the mesh; 0: the "
                      "element size [m]");
    prm.declare_entry("Size growth", "0.2", Double(),
                      "Of elements with the distance from those outlines "
                      "[m/m]");
  }

  namespace
  {
    std::vector<std::string> read_sides(const ParameterSection &section,
                                        const std::size_t n)
    {
      auto sides = section.list("Sides");
      if (sides.empty())
        sides.assign(n, "outline");
      if (sides.size() != n)
        section.fail("Sides", "must be as many names as 'Outline' has "
                              "corners, that is "
                                  + std::to_string(n) + ".");
      return sides;
    }

    /** Joints name regions that exist, and have names of their own. */
    void check_names(const ParameterSection &top, const RockParameters &rock)
    {
      const ParameterSection section(top, "Rock joints");
      for (const RockJoints &joints : rock.joints)
      {
        const auto has_name = [](const std::string &name)
        { return [&name](const auto &other) { return other.name == name; }; };
        if (!joints.region.empty()
            && std::none_of(rock.regions.begin(), rock.regions.end(),
                            has_name(joints.region)))
          ParameterSection(section, joints.name)
              .fail("Region", "is no region: name one of section 'Rock "
                              "regions', or leave it empty.");
        if (std::any_of(rock.regions.begin(), rock.regions.end(),
                        has_name(joints.name))
            || std::find(rock.sides.begin(), rock.sides.end(), joints.name)
                   != rock.sides.end())
          section.fail("Names", "has '" + joints.name
                                    + "', which is a region or a side of the "
                                      "outline, too. Take another name.");
      }
    }

    void check_regions(const ParameterSection &top, const RockParameters &rock)
    {
      const ParameterSection section(top, "Rock regions");
      for (const RockRegion &region : rock.regions)
      {
        if (region.use != RockRegion::zone
            && (region.name == rock.group
                || std::find(rock.sides.begin(), rock.sides.end(), region.name)
                       != rock.sides.end()))
          section.fail("Names", "has '" + region.name
                                    + "', which is the 'Group' of section "
                                      "'Rock' or a side of the outline, too. "
                                      "Take another name.");
        const bool is_inside = std::all_of(
            region.polygon.begin(), region.polygon.end(),
            [&](const Point &p)
            {
              return contains(rock.outline, p)
                     || distance(rock.outline, p) < 1e-6 * rock.shortest_edge;
            });
        if (region.use != RockRegion::zone && !is_inside)
          ParameterSection(section, region.name)
              .fail("Shape", "has corners outside of the rock's outline: move "
                             "the region or the 'Outline'.");
      }
    }

    void read_sizes(const ParameterSection &section, RockParameters &rock)
    {
      rock.element_size    = section.positive("Element size");
      rock.finest_size     = section.nonnegative("Finest element size");
      rock.size_growth     = section.positive("Size growth");
      rock.shortest_edge   = section.nonnegative("Shortest edge");
      rock.smallest_block  = section.nonnegative("Smallest block");
      rock.narrowest_block = section.nonnegative("Narrowest block");
      if (rock.finest_size == 0.)
        rock.finest_size = rock.element_size;
      if (rock.finest_size > rock.element_size)
        section.fail("Finest element size",
                     "must not exceed 'Element size', which it refines.");
      limit_elements(section, 2. * std::abs(signed_area(rock.outline))
                                  / rock.element_size / rock.element_size);
      if (rock.shortest_edge == 0.)
        rock.shortest_edge = 0.1 * rock.element_size;
      if (rock.smallest_block == 0.)
        rock.smallest_block = 4. * rock.shortest_edge * rock.shortest_edge;
      if (rock.narrowest_block == 0.)
        rock.narrowest_block = rock.shortest_edge;
    }
  } // namespace

  RockParameters RockParameters::read(const ParameterSection &top)
  {
    RockParameters rock;
    {
      const ParameterSection section(top, "Rock");
      if (section.text("Outline").empty())
        return rock;
      rock.outline = read_points(section, "Outline", 3);
      check_polygon(section, "Outline", rock.outline);
      rock.sides = read_sides(section, rock.outline.size());
      if (signed_area(rock.outline) < 0.)
      {
        // The side after a corner is then the one before it.
        std::reverse(rock.outline.begin(), rock.outline.end());
        std::reverse(rock.sides.begin(), rock.sides.end());
        std::rotate(rock.sides.begin(), rock.sides.begin() + 1,
                    rock.sides.end());
      }
      rock.group     = section.text("Group");
      rock.seed      = section.integer("Random seed");
      rock.dead_ends = section.choice<DeadEnds>(
          "Dead ends",
          { { "cut", cut }, { "extend", extend }, { "keep", keep } });
      read_sizes(section, rock);
    }
    rock.regions = read_named<RockRegion>(top, "Rock regions");
    rock.joints  = read_named<RockJoints>(top, "Rock joints");
    check_names(top, rock);
    check_regions(top, rock);
    return rock;
  }
} // namespace quoin
