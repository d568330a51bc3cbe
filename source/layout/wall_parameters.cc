// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/layout/element_limit.h>
#include <quoin/layout/wall_parameters.h>

#include <array>
#include <cmath>

#include "numbered_names.h"
#include "wall_sections.h"

namespace quoin
{
  namespace
  {
    /** More do not fit into the memory of a machine. */
    constexpr double most_units = 1e6;

    std::set<unsigned int> read_courses(const ParameterSection &section,
                                        const WallStorey &storey)
    {
      std::set<unsigned int> courses;
      for (const std::string &word : section.list("Header courses"))
      {
        const auto [first, last] = number_range(word);
        if (first < 1 || last < first || last > storey.n_courses)
          section.fail("Header courses",
                       "must be numbers of courses from 1 to 'Courses', or "
                       "FIRST-LAST of several, such as 6, 12-13.");
        for (unsigned int course = first; course <= last; ++course)
          courses.insert(course);
      }
      return courses;
    }

    constexpr const char *course_form
        = "must be pairs NAME:COURSE, or NAME:FIRST-LAST of several, with "
          "commas between them and 1 <= COURSE <= 'Courses', each course at "
          "most once, such as plinth:1-2, band:9.";

    void check_openings(const ParameterSection &section,
                        const WallStorey &storey, const WallParameters &wall)
    {
      const bool has_segments
          = !wall.segments.empty() && !wall.segments[0].name.empty();
      if (has_segments && !storey.openings.empty())
        section.fail("Openings", "does not go with section 'Wall segments', "
                                 "whose segments have openings of their own: "
                                 "leave it empty.");
      for (const WallOpening &opening : storey.openings)
        if (!has_segments && opening.right > wall.length)
          section.fail("Openings", "must have 0 <= left < right <= 'Length'.");
    }

    void enter_storey(ParameterEntries &entries, WallStorey &storey)
    {
      entries.integer("Courses", storey.n_courses, 0,
                      "Number of courses; in section 'Wall' it is 0 if there "
                      "are storeys, which have courses of their own [-]");
      entries.other("Openings", "",
                    "Openings as left [m], right [m], first course, last "
                    "course, with semicolons between openings. x is 0 at the "
                    "left end, and courses count from 1 at the bottom of the "
                    "wall or storey. Units are cut to fit.",
                    [&](const ParameterSection &section) {
                      storey.openings
                          = read_openings(section, storey.n_courses);
                    });
      std::vector<std::pair<std::string, std::string>> names;
      entries.pairs(
          "Named courses", names, course_form,
          "Courses with names of their own, such as plinth:1-2, band:9: their "
          "units are the physical surface 'unit_NAME', the joints below the "
          "course 'bed_NAME', its head joints 'head_NAME' and its potential "
          "cracks 'crack_NAME'. Other courses have the name of their storey.");
      entries.other(
          "Header courses", "",
          "Courses of headers in a bond that has others, such as 6, 12-13: "
          "half units, which go through the wall in three dimensions.",
          [&](const ParameterSection &section)
          { storey.header_courses = read_courses(section, storey); });
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (storey.n_courses > most_units)
        section->fail("Courses", "makes more than a million units.");
      storey.named_courses = numbered_names(*section, "Named courses", names,
                                            storey.n_courses, course_form);
    }

    void enter_upper_storey(ParameterEntries &entries, WallStorey &storey)
    {
      enter_storey(entries, storey);
      entries.nonnegative(
          "Slab thickness", storey.slab,
          "Thickness of the slab on this storey, a block over the whole wall "
          "that is the physical surface 'slab_NAME' with joints 'slab_joint'; "
          "0: no slab [m]");
      const ParameterSection *section = entries.read_section();
      if (section && storey.n_courses == 0)
        section->fail("Courses", "must be at least 1.");
    }

    void enter_random(ParameterEntries &entries, WallParameters &wall)
    {
      std::array<double, 2> lengths{};
      entries.numbers("Random lengths", lengths,
                      "Shortest and longest unit of a random bond, whose "
                      "lengths are uniformly distributed between them [m]");
      wall.random_shortest = lengths[0];
      wall.random_longest  = lengths[1];
      entries.nonnegative("Random overlap", wall.random_overlap,
                          "Smallest horizontal distance of head joints of a "
                          "random bond from those of neighbouring courses and "
                          "from the ends of openings and lintels there [m]");
      entries.integer("Random seed", wall.random_seed, 0,
                      "Seed of the random number generator of a random bond; "
                      "another seed gives another wall.");
    }

    /** Lengths of units in the parameters are those without mortar. */
    void enter_units(ParameterEntries &entries, WallParameters &wall)
    {
      entries.nonnegative(
          "Length", wall.length,
          "Length of the wall from its left to its right end; 0 if there are "
          "segments, which have lengths of their own [m]");
      wall.storeys.resize(1);
      enter_storey(entries, wall.storeys[0]);
      entries.positive(
          "Unit length", wall.unit_length,
          "Length of a whole unit, without mortar; with 'Bond = "
          "random' a typical one, by which pieces are too short or "
          "cracks go through units [m]");
      entries.positive("Unit height", wall.unit_height,
                       "Height of a unit, without mortar [m]");
      std::array<double, 2> joint{};
      entries.numbers(
          "Joint thickness", joint,
          "Thickness of head joints and of bed joints in the real wall; joints "
          "of the model have no thickness, and units are enlarged by it [m]");
      wall.unit_length += joint[0];
      wall.unit_height += joint[1];
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (!(joint[0] >= 0. && joint[1] >= 0.))
        section->fail("Joint thickness", "must not be negative.");
    }

    void enter_thickness(ParameterEntries &entries, WallParameters &wall)
    {
      entries.nonnegative(
          "Thickness", wall.thickness,
          "Thickness of the wall, with its collar joints, in three dimensions, "
          "which 'Dimension = 3' in section 'Mesh' makes; 0: the wall is plane "
          "[m]");
      entries.integer("Wythes", wall.n_wythes, 1,
                      "Number of wythes of equal thickness, between which "
                      "there are joints 'collar' [-]");
      entries.within("Wythe offset", wall.wythe_offset, 0., 1.,
                     "Offset of the head joints of every other wythe of a "
                     "running or stack bond, as a fraction of the length of a "
                     "unit with its joint [-]");
    }

    void enter_wall(ParameterEntries &entries, WallParameters &wall)
    {
      entries.choice(
          "Bond", wall.bond,
          { { "none", WallBond::none },
            { "running", WallBond::running },
            { "stack", WallBond::stack },
            { "header", WallBond::header },
            { "English", WallBond::english },
            { "Flemish", WallBond::flemish },
            { "random", WallBond::random } },
          "Masonry bond of a wall that the program generates instead of "
          "reading 'Mesh/File'; none: no wall is generated. A header is half a "
          "unit; header courses begin with a header and a quarter.");
      if (!entries.reads_if(wall.bond != WallBond::none))
        return;
      enter_units(entries, wall);
      entries.within("Offset", wall.offset, 0., 1.,
                     "Offset of every other course of a running bond, as a "
                     "fraction of the length of a unit with its joint [-]");
      entries.choice("First course", wall.begins_shifted,
                     { { "whole", false }, { "shifted", true } },
                     "Start of the lowest course. whole: it begins with a "
                     "whole unit (a stretcher); shifted: it begins as the "
                     "second course otherwise would.");
      entries.within(
          "Shortest piece", wall.shortest, 0., 0.5,
          "Fraction of the length of a whole unit below which units cut at "
          "ends and openings are joined to their neighbour [-]");
      enter_random(entries, wall);
      entries.nonnegative(
          "Lintel bearing", wall.lintel_bearing,
          "Bearing length of lintels on each side of an opening; 0: no "
          "lintels, and units of the bond bridge the openings [m]");
      entries.integer("Lintel courses", wall.lintel_courses, 1,
                      "Depth of lintels in courses [-]");
      entries.nonnegative(
          "Bottom platen", wall.bottom_platen,
          "Height of a block below the whole wall; 0: no such block [m]");
      entries.nonnegative(
          "Top platen", wall.top_platen,
          "Height of a block above the whole wall; 0: no such block [m]");
      entries.choice(
          "Potential cracks", wall.cracks,
          { { "none", false }, { "mid-unit", true } },
          "Potential cracks through units. mid-unit: all units longer than "
          "three quarters of a whole one, and headers in three dimensions, "
          "have a joint at mid-length, 'crack'; none: units have no such "
          "joint.");
      enter_thickness(entries, wall);
      entries.nonnegative("Element size", wall.element_size,
                          "Longest edge of the elements of the wall, or of the "
                          "bricks that are cut into tetrahedra; 0: half the "
                          "height of a course [m]");
      entries.choice("Elements", wall.structured,
                     { { "structured", true }, { "free", false } },
                     "Mesh of the wall. structured: rectangles or, in three "
                     "dimensions, boxes between all joints and cracks of the "
                     "wall, divided alternately; "
                     "free: gmsh's unstructured mesh of each unit of a plane "
                     "wall.");
    }

    /** The storeys of section 'Wall storeys' take the place of the one that
        section 'Wall' itself gives. */
    void read_storeys(const ParameterSection &top, WallParameters &wall)
    {
      std::vector<WallStorey> storeys;
      const ParameterSection section(top, "Wall storeys");
      for (const std::string &name : section.list("Names"))
      {
        const ParameterSection part(section, name);
        WallStorey storey = read_entries(part, enter_upper_storey);
        check_openings(part, storey, wall);
        storey.name = name;
        storeys.push_back(storey);
      }
      if (!storeys.empty())
        wall.storeys = storeys;
    }

    void check_wall(const ParameterSection &section, const WallParameters &wall,
                    const unsigned int n_courses)
    {
      const bool has_storeys = !wall.storeys[0].name.empty();
      if (has_storeys && n_courses > 0)
        section.fail("Courses", "does not go with section 'Wall storeys', "
                                "whose storeys have courses of their own: "
                                "leave it at 0.");
      if (!(wall.length > 0.))
        section.fail("Length", "must be positive.");
      if (!has_storeys)
      {
        if (n_courses == 0)
          section.fail("Courses", "must be at least 1, or section 'Wall "
                                  "storeys' must name storeys.");
        check_openings(section, wall.storeys[0], wall);
      }
    }

    void check_numbers_of_units(const ParameterSection &section,
                                const WallParameters &wall)
    {
      const double in_course = 1. + wall.length / wall.unit_length;
      if (!(in_course <= most_units))
        section.fail("Length", "is that of more than a million units. Check "
                               "that it and 'Unit length' are in metres.");
      double n_courses = 0.;
      for (const WallStorey &storey : wall.storeys)
        n_courses += storey.n_courses;
      if (!(in_course * n_courses <= most_units))
        section.fail("Courses", "or those of the storeys make more than a "
                                "million units.");
      if (wall.bond != WallBond::random)
        return;
      if (!(0. < wall.random_shortest
            && wall.random_shortest <= wall.random_longest))
        section.fail("Random lengths",
                     "must be shortest and longest unit with 0 < shortest <= "
                     "longest.");
      if (!((1. + wall.length / wall.random_shortest) * n_courses
            <= most_units))
        section.fail("Random lengths", "make more than a million units. Check "
                                       "that they are in metres.");
      if (wall.random_overlap > 0.5 * wall.random_shortest)
        section.fail("Random overlap",
                     "must not exceed half of the shortest unit.");
    }

    void check_elements(const ParameterSection &section, WallParameters &wall)
    {
      if (wall.element_size == 0.)
        wall.element_size = 0.5 * wall.unit_height;
      const double n
          = wall.length / wall.element_size * wall.height() / wall.element_size;
      limit_elements(section, wall.segments.empty() ? 2. * n
                                                    : 5. * n * wall.thickness
                                                          / wall.element_size);
      if (wall.structured && wall.bond == WallBond::random)
        section.fail("Elements", "must be 'free' with 'Bond = random', whose "
                                 "joints lie at any distance, in two "
                                 "dimensions alone.");
    }
  } // namespace

  std::vector<WallOpening> read_openings(const ParameterSection &section,
                                         const unsigned int n_courses)
  {
    std::vector<WallOpening> openings;
    for (const auto &v :
         number_rows(section, "Openings", 4,
                     "must be four numbers for each opening: left, right, "
                     "first course, last course; openings are separated by "
                     "semicolons."))
    {
      if (!(0. <= v[0] && v[0] < v[1]))
        section.fail("Openings", "must have 0 <= left < right <= 'Length'.");
      const double first = v[2], last = v[3];
      if (first != std::floor(first) || last != std::floor(last)
          || !(1. <= first && first <= last && last <= n_courses))
        section.fail("Openings", "must name whole courses with 1 <= first "
                                 "<= last <= 'Courses'.");
      openings.push_back({ v[0], v[1], static_cast<unsigned int>(first),
                           static_cast<unsigned int>(last) });
    }
    for (std::size_t i = 0; i < openings.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (openings[i].left <= openings[j].right
            && openings[j].left <= openings[i].right
            && openings[i].first_course <= openings[j].last_course
            && openings[j].first_course <= openings[i].last_course)
          section.fail("Openings", "must not touch each other.");
    return openings;
  }

  void WallStorey::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_upper_storey);
  }

  void WallParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_wall);
  }

  WallParameters WallParameters::read(const ParameterSection &top)
  {
    WallParameters wall
        = read_entries(ParameterSection(top, "Wall"), enter_wall);
    if (wall.bond == WallBond::none)
      return wall;
    const unsigned int n_courses = wall.storeys[0].n_courses;
    read_segments(top, wall);
    read_storeys(top, wall);
    {
      const ParameterSection section(top, "Wall");
      check_wall(section, wall, n_courses);
      check_numbers_of_units(section, wall);
      check_elements(section, wall);
    }
    check_segments(top, wall);
    return wall;
  }

  double WallParameters::height() const
  {
    double sum = bottom_platen + top_platen;
    for (const WallStorey &storey : storeys)
      sum += storey.n_courses * unit_height + storey.slab;
    return sum;
  }
} // namespace quoin
