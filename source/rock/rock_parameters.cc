// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/named_sections.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/rock/region_shape.h>
#include <quoin/rock/rock_parameters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <quoin/layout/element_limit.h>

namespace quoin
{
  namespace
  {
    using Point = dealii::Point<2>;

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

    /** Distribution of lengths, which are drawn again until they are positive.
     */
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

    /** Sides are those of a counter-clockwise outline from here on. */
    void complete_sides(const ParameterSection &section, RockParameters &rock)
    {
      const std::size_t n = rock.outline.size();
      if (rock.sides.empty())
        rock.sides.assign(n, "outline");
      if (rock.sides.size() != n)
        section.fail("Sides", "must be as many names as 'Outline' has "
                              "corners, that is "
                                  + std::to_string(n) + ".");
      if (signed_area(rock.outline) < 0.)
      {
        // The side after a corner is then the one before it.
        std::reverse(rock.outline.begin(), rock.outline.end());
        std::reverse(rock.sides.begin(), rock.sides.end());
        std::rotate(rock.sides.begin(), rock.sides.begin() + 1,
                    rock.sides.end());
      }
    }

    void complete_sizes(const ParameterSection &section, RockParameters &rock)
    {
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

    const std::string distribution_text
        = "a number, or one of 'uniform', 'normal', 'log-normal' with mean and "
          "standard deviation, or 'exponential' with the mean";

    void enter_region(ParameterEntries &entries, RockRegion &region)
    {
      enter_region_shape(entries, region.polygon);
      entries.choice(
          "Use", region.use,
          { { "body", RockRegion::body },
            { "hole", RockRegion::hole },
            { "zone", RockRegion::zone } },
          "Use of the region. body: a physical surface with the region's name, "
          "for a material of its own or for excavation; hole: a void; zone: a "
          "region for joints that name it, without effect on anything else. "
          "Where regions overlap, the later one prevails.");
      entries.flag("Outline is a joint", region.is_outlined,
                   "Whether the outline of a body, the physical curve with the "
                   "region's name, is a joint.");
      entries.flag("Joints inside", region.has_joints,
                   "Whether joints pass through a body.");
      entries.flag("Refine mesh", region.refines_mesh,
                   "Whether elements along the region's outline have the "
                   "'Finest element size' of section 'Rock'.");
      const ParameterSection *section = entries.read_section();
      if (section && region.refines_mesh && region.use == RockRegion::zone)
        section->fail("Refine mesh", "needs the outline of a body or a hole: a "
                                     "zone has none in the mesh.");
    }

    Distribution read_dip(const ParameterSection &section)
    {
      const Distribution dip = read_distribution(section, "Dip");
      if (!(std::abs(dip.mean) <= 360.))
        section.fail("Dip", "must have a mean between -360 and 360 degrees.");
      if (dip.kind == DistributionKind::log_normal
          || dip.kind == DistributionKind::exponential)
        section.fail("Dip", "is an angle: take 'Fisher', 'normal' or "
                            "'uniform'.");
      return dip;
    }

    void enter_set(ParameterEntries &entries, RockJoints &joints)
    {
      using Section = ParameterSection;
      entries.other("Dip", "0",
                    "Dip of a set, anticlockwise from the x axis: a number, or "
                    "one of 'uniform', 'normal', 'Fisher' with mean and "
                    "standard deviation, such as 'Fisher 30, 5' [deg]",
                    [&](const Section &section)
                    { joints.dip = read_dip(section); });
      entries.other("Spacing", "0",
                    "Spacing of the lines of a set, normal to the mean dip: "
                        + distribution_text + " [m]",
                    [&](const Section &section)
                    { joints.spacing = read_length(section, "Spacing"); });
      entries.other(
          "Trace length", "persistent",
          "Length of the traces of a set: a number or distribution as for "
          "'Spacing', or 'persistent' for traces from border to border [m]",
          [&](const Section &section)
          {
            joints.is_persistent = section.text("Trace length") == "persistent";
            if (!joints.is_persistent)
              joints.length = read_length(section, "Trace length");
          });
      entries.other(
          "Gap", "0",
          "Gap between traces on a line of a set: a number or distribution as "
          "for 'Spacing', or 0 for none [m]",
          [&](const Section &section)
          {
            if (joints.is_persistent)
              return;
            const Distribution gap = read_distribution(section, "Gap");
            if (gap.kind != DistributionKind::constant || gap.mean != 0.)
              joints.gap = read_length(section, "Gap");
          });
      std::array<double, 2> origin{};
      entries.numbers("Origin", origin,
                      "Point x, y on the first line of a set [m]");
      joints.origin = Point(origin[0], origin[1]);
    }

    void check_file(const ParameterSection &section, std::string &file)
    {
      if (file.empty())
        section.fail("File", "must name a table of traces.");
      if (file.front() != '/')
        file = section.folder() + file;
      std::error_code error; // a name may be too long for any file
      if (!std::filesystem::is_regular_file(file, error))
        section.fail("File", "does not exist: there is no file '" + file
                                 + "'. Give the path from the folder of the "
                                   "parameter file.");
    }

    void enter_joints(ParameterEntries &entries, RockJoints &joints)
    {
      entries.choice(
          "Kind", joints.kind,
          { { "set", RockJoints::set },
            { "polyline", RockJoints::polyline },
            { "traces", RockJoints::traces },
            { "Voronoi", RockJoints::voronoi } },
          "Kind of joints. set: traces and gaps that alternate on parallel "
          "lines; polyline: one joint through given points; traces: straight "
          "joints from a file; Voronoi: the borders of random polygons.");
      if (entries.reads_if(joints.kind == RockJoints::set))
        enter_set(entries, joints);
      if (entries.reads_if(joints.kind == RockJoints::polyline))
        entries.other("Points", "",
                      "Points of a polyline as x, y; x, y; ... [m]",
                      [&](const ParameterSection &section)
                      { joints.points = read_points(section, "Points", 2); });
      if (entries.reads_if(joints.kind == RockJoints::traces))
      {
        entries.text("File", joints.file,
                     "Table of traces with x1, y1, x2, y2 [m] in each row, "
                     "relative to the folder of this file.");
        if (const ParameterSection *section = entries.read_section())
          check_file(*section, joints.file);
      }
      if (entries.reads_if(joints.kind == RockJoints::voronoi))
      {
        entries.positive(
            "Block size", joints.block_size,
            "Square root of the mean area of Voronoi polygons [m]");
        entries.integer("Relaxation", joints.relaxation, 0,
                        "Number of relaxation steps that move the sites of "
                        "Voronoi polygons to the centroids of their polygons, "
                        "which become more regular; 5 are many [-]",
                        1000);
      }
      entries.text("Region", joints.region,
                   "Region of section 'Rock regions' to which these joints are "
                   "confined; empty: no restriction.");
    }

    void enter_sizes(ParameterEntries &entries, RockParameters &rock)
    {
      entries.nonnegative(
          "Shortest edge", rock.shortest_edge,
          "Distance below which joint ends are merged with each other or moved "
          "onto another joint; 0: a tenth of the element size [m]");
      entries.nonnegative(
          "Smallest block", rock.smallest_block,
          "Area below which a block is merged with the neighbour that shares "
          "its longest joint; 0: the square of twice the shortest edge [m^2]");
      entries.nonnegative(
          "Narrowest block", rock.narrowest_block,
          "Width, twice the area divided by the perimeter, below which a block "
          "is merged with the neighbour that shares its longest joint; 0: the "
          "shortest edge [m]");
      entries.positive("Element size", rock.element_size,
                       "Longest edge of the elements of the rock mass [m]");
      entries.nonnegative(
          "Finest element size", rock.finest_size,
          "Longest edge of the elements along outlines of regions with 'Refine "
          "mesh = yes'; 0: the element size [m]");
      rock.size_growth = 0.2;
      entries.positive("Size growth", rock.size_growth,
                       "Growth of the element size per distance from outlines "
                       "that refine the mesh [m/m]");
    }

    void enter_rock(ParameterEntries &entries, RockParameters &rock)
    {
      entries.other("Outline", "",
                    "Corners x, y; x, y; ... of a rock mass that the program "
                    "cuts into blocks, instead of reading 'Mesh/File'; empty: "
                    "no rock mass is generated [m]",
                    [&](const ParameterSection &section)
                    {
                      if (section.text("Outline").empty())
                        return;
                      rock.outline = read_points(section, "Outline", 3);
                      check_polygon(section, "Outline", rock.outline);
                    });
      if (!entries.reads_if(!rock.outline.empty()))
        return;
      entries.list(
          "Sides", rock.sides,
          "Names of the sides of the outline, each a physical curve, in order "
          "from the side between the first and the second corner. Sides may "
          "share a name; empty: all have the name 'outline'.");
      entries.text("Group", rock.group,
                   "Physical surface of the blocks outside all regions.");
      entries.integer("Random seed", rock.seed, 0,
                      "Seed of the random number generator of joints; another "
                      "seed gives another realisation of the same statistics.");
      entries.choice(
          "Dead ends", rock.dead_ends,
          { { "cut", RockParameters::cut },
            { "extend", RockParameters::extend },
            { "keep", RockParameters::keep } },
          "Treatment of joint ends in intact rock, which separate no blocks. "
          "cut: the joint is cut back to the last joint that it crosses; "
          "extend: the joint is extended to the next joint or border; keep: "
          "the end remains as a crack inside a block.");
      enter_sizes(entries, rock);
      if (const ParameterSection *section = entries.read_section())
      {
        complete_sides(*section, rock);
        complete_sizes(*section, rock);
      }
    }
  } // namespace

  void RockRegion::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_region);
  }

  RockRegion RockRegion::read(const ParameterSection &section,
                              const std::string &name)
  {
    RockRegion region = read_entries(section, enter_region);
    region.name       = name;
    return region;
  }

  void RockJoints::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_joints);
  }

  RockJoints RockJoints::read(const ParameterSection &section,
                              const std::string &name)
  {
    RockJoints joints = read_entries(section, enter_joints);
    joints.name       = name;
    return joints;
  }

  void RockParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_rock);
  }

  namespace
  {
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
  } // namespace

  RockParameters RockParameters::read(const ParameterSection &top)
  {
    RockParameters rock
        = read_entries(ParameterSection(top, "Rock"), enter_rock);
    if (rock.outline.empty())
      return rock;
    rock.regions = read_named<RockRegion>(top, "Rock regions");
    rock.joints  = read_named<RockJoints>(top, "Rock joints");
    check_names(top, rock);
    check_regions(top, rock);
    return rock;
  }
} // namespace quoin
