// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/layout/wall_parameters.h>

#include <array>
#include <cmath>

#include "element_limit.h"

namespace quoin
{
  namespace
  {
    std::vector<WallOpening> read_openings(const ParameterSection &section,
                                           const WallParameters &wall)
    {
      std::vector<WallOpening> openings;
      for (const auto &v :
           section.rows("Openings", 4,
                        "must be four numbers for each opening: left, right, "
                        "first course, last course; openings are separated by "
                        "semicolons."))
      {
        if (!(0. <= v[0] && v[0] < v[1] && v[1] <= wall.length))
          section.fail("Openings", "must have 0 <= left < right <= 'Length'.");
        const double first = v[2], last = v[3];
        if (first != std::floor(first) || last != std::floor(last)
            || !(1. <= first && first <= last && last <= wall.n_courses))
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

    /** More do not fit into the memory of a machine. */
    constexpr double most_units = 1e6;

    void check_number_of_units(const ParameterSection &section,
                               const WallParameters &wall)
    {
      const double in_course = 1. + wall.length / wall.unit_length;
      if (!(in_course <= most_units))
        section.fail("Length", "is that of more than a million units. Check "
                               "that it and 'Unit length' are in metres.");
      if (!(in_course * wall.n_courses <= most_units))
        section.fail("Courses", "makes more than a million units.");
    }

    void check_random(const ParameterSection &section,
                      const WallParameters &wall)
    {
      if (!(0. < wall.random_shortest
            && wall.random_shortest <= wall.random_longest))
        section.fail("Random lengths",
                     "must be shortest and longest unit with 0 < shortest <= "
                     "longest.");
      if (!((1. + wall.length / wall.random_shortest) * wall.n_courses
            <= most_units))
        section.fail("Random lengths", "make more than a million units. Check "
                                       "that they are in metres.");
      if (wall.random_overlap > 0.5 * wall.random_shortest)
        section.fail("Random overlap",
                     "must not exceed half of the shortest unit.");
    }

    void enter_random(ParameterEntries &entries, WallParameters &wall)
    {
      std::array<double, 2> lengths{};
      entries.numbers("Random lengths", lengths,
                      "Shortest and longest unit of a random bond, between "
                      "which lengths are uniformly distributed [m]");
      wall.random_shortest = lengths[0];
      wall.random_longest  = lengths[1];
      entries.nonnegative("Random overlap", wall.random_overlap,
                          "Smallest distance between head joints of "
                          "neighbouring courses of a random bond [m]");
      entries.integer("Random seed", wall.random_seed, 0,
                      "Seed of the random bond: another seed, another wall.");
      const ParameterSection *section = entries.read_section();
      if (section && wall.bond == WallBond::random)
        check_random(*section, wall);
    }

    /** Lengths of units in the parameters are those without mortar. */
    void enter_units(ParameterEntries &entries, WallParameters &wall)
    {
      entries.positive("Length", wall.length,
                       "Length of the wall, from its left to its right end "
                       "[m]");
      entries.integer("Courses", wall.n_courses, 0,
                      "Number of courses of the wall [-]");
      entries.positive("Unit length", wall.unit_length,
                       "Length of a whole unit, without mortar [m]");
      entries.positive("Unit height", wall.unit_height,
                       "Height of a unit, without mortar [m]");
      std::array<double, 2> joint{};
      entries.numbers("Joint thickness", joint,
                      "Thickness of head and of bed joints. Joints of the "
                      "model have none: units grow by it [m]");
      wall.unit_length += joint[0];
      wall.unit_height += joint[1];
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (!(joint[0] >= 0. && joint[1] >= 0.))
        section->fail("Joint thickness", "must not be negative.");
      if (wall.n_courses == 0)
        section->fail("Courses", "must be at least 1.");
      check_number_of_units(*section, wall);
    }

    void check_elements(const ParameterSection &section, WallParameters &wall)
    {
      if (wall.element_size == 0.)
        wall.element_size = 0.5 * wall.unit_height;
      const double height = wall.n_courses * wall.unit_height
                            + wall.bottom_platen + wall.top_platen;
      limit_elements(section, 2. * wall.length / wall.element_size * height
                                  / wall.element_size);
      if (wall.structured && wall.bond == WallBond::random)
        section.fail("Elements", "must be 'free' with 'Bond = random', whose "
                                 "joints lie at any distance.");
    }

    void enter(ParameterEntries &entries, WallParameters &wall)
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
          "How units are laid in a wall that the program makes itself, instead "
          "of reading 'Mesh/File'; none: no such wall. A header is half a "
          "unit; header courses begin with a header and a quarter.");
      if (!entries.reads_if(wall.bond != WallBond::none))
        return;
      enter_units(entries, wall);
      entries.within("Offset", wall.offset, 0., 1.,
                     "Shift of every other course of a running bond, as a "
                     "share of a unit with its joint [-]");
      entries.choice("First course", wall.begins_shifted,
                     { { "whole", false }, { "shifted", true } },
                     "Whether the lowest course begins with a whole unit "
                     "(a stretcher), or as the one above would otherwise.");
      entries.within("Shortest piece", wall.shortest, 0., 0.5,
                     "Share of a whole unit below which units that are cut at "
                     "ends and openings are joined to their neighbour [-]");
      enter_random(entries, wall);
      entries.other("Openings", "",
                    "Openings of the wall: left [m], right [m], first course, "
                    "last course; further openings after a semicolon. x is 0 "
                    "at the left end, courses count from 1 at the bottom. "
                    "Units are cut to fit.",
                    [&](const ParameterSection &section)
                    { wall.openings = read_openings(section, wall); });
      entries.nonnegative("Lintel bearing", wall.lintel_bearing,
                          "Length by which a lintel of one course above each "
                          "opening reaches beyond each side of it; 0: no "
                          "lintel, units of the bond bridge the opening [m]");
      entries.nonnegative("Bottom platen", wall.bottom_platen,
                          "Height of a block below the whole wall; 0: none "
                          "[m]");
      entries.nonnegative("Top platen", wall.top_platen,
                          "Height of a block above the whole wall; 0: none "
                          "[m]");
      entries.choice("Potential cracks", wall.cracks,
                     { { "none", false }, { "mid-unit", true } },
                     "Joints at mid-length of all units longer than three "
                     "quarters of a whole one: the curve 'crack'.");
      entries.nonnegative("Element size", wall.element_size,
                          "Longest edge of elements; 0: half the height of a "
                          "course [m]");
      entries.choice("Elements", wall.structured,
                     { { "structured", true }, { "free", false } },
                     "structured: rectangles between all head joints and "
                     "cracks of the wall, halved alternately; free: gmsh's "
                     "unstructured mesh of each unit.");
      if (const ParameterSection *section = entries.read_section())
        check_elements(*section, wall);
    }
  } // namespace

  void WallParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  WallParameters WallParameters::read(const ParameterSection &section)
  {
    return read_entries(section, enter);
  }
} // namespace quoin
