// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/layout/wall_parameters.h>

#include <cmath>

#include "element_limit.h"

namespace quoin
{
  void WallParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;
    prm.declare_entry(
        "Bond", "none",
        Selection("none|running|stack|header|English|Flemish|random"),
        "How units are laid in a wall that the program makes itself, instead "
        "of reading 'Mesh/File'; none: no such wall. A header is half a unit; "
        "header courses begin with a header and a quarter.");
    prm.declare_entry("Length", "0", Double(), "From left to right end [m]");
    prm.declare_entry("Courses", "0", Integer(0), "Their number");
    prm.declare_entry("Unit length", "0", Double(),
                      "Of a whole unit, without mortar [m]");
    prm.declare_entry("Unit height", "0", Double(),
                      "Of a unit, without mortar [m]");
    prm.declare_entry("Joint thickness", "0, 0", Anything(),
                      "Head and bed joints. Joints of the model have none: "
                      "units grow by it [m]");
    prm.declare_entry("Offset", "0.5", Double(),
                      "Running bond: shift of every other course, as a share "
                      "of a unit with its joint [-]");
    prm.declare_entry("First course", "whole", Selection("whole|shifted"),
                      "Whether the lowest course begins with a whole unit "
                      "(a stretcher), or as the one above would otherwise.");
    prm.declare_entry("Shortest piece", "0.2", Double(),
                      "Units cut shorter than this share of a whole one, at "
                      "ends and openings, are joined to their neighbour [-]");
    prm.declare_entry("Random lengths", "0, 0", Anything(),
                      "Random bond: shortest and longest unit, between which "
                      "lengths are uniformly distributed [m]");
    prm.declare_entry("Random overlap", "0", Double(),
                      "Random bond: head joints of neighbouring courses keep "
                      "this distance at least [m]");
    prm.declare_entry("Random seed", "1", Integer(0),
                      "Random bond: another seed, another wall.");
    prm.declare_entry("Openings", "", Anything(),
                      "left [m], right [m], first course, last course; further "
                      "openings after a semicolon. x is 0 at the left end, "
                      "courses count from 1 at the bottom. Units are cut to "
                      "fit.");
    prm.declare_entry("Lintel bearing", "0", Double(),
                      "A lintel of one course above each opening reaches so "
                      "far to each side of it; 0: none, units of the bond "
                      "bridge the opening [m]");
    prm.declare_entry("Bottom platen", "0", Double(),
                      "Height of a block below the whole wall; 0: none [m]");
    prm.declare_entry("Top platen", "0", Double(),
                      "Height of a block above the whole wall; 0: none [m]");
    prm.declare_entry("Potential cracks", "none", Selection("none|mid-unit"),
                      "Joints at mid-length of all units longer than three "
                      "quarters of a whole one: the curve 'crack'.");
    prm.declare_entry("Element size", "0", Double(),
                      "Edges of elements are no longer; 0: half the height of "
                      "a course [m]");
    prm.declare_entry("Elements", "structured", Selection("structured|free"),
                      "structured: rectangles between all head joints and "
                      "cracks of the wall, halved alternately; free: gmsh's "
                      "unstructured mesh of each unit.");
  }

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

    void read_random(const ParameterSection &section, WallParameters &wall)
    {
      const auto lengths   = section.numbers<2>("Random lengths");
      wall.random_shortest = lengths[0];
      wall.random_longest  = lengths[1];
      wall.random_overlap  = section.nonnegative("Random overlap");
      wall.random_seed     = section.integer("Random seed");
      if (wall.bond != WallBond::random)
        return;
      if (!(0. < lengths[0] && lengths[0] <= lengths[1]))
        section.fail("Random lengths",
                     "must be shortest and longest unit with 0 < shortest <= "
                     "longest.");
      if (!((1. + wall.length / lengths[0]) * wall.n_courses <= most_units))
        section.fail("Random lengths", "make more than a million units. Check "
                                       "that they are in metres.");
      if (wall.random_overlap > 0.5 * lengths[0])
        section.fail("Random overlap",
                     "must not exceed half of the shortest unit.");
    }
  } // namespace

  WallParameters WallParameters::read(const ParameterSection &section)
  {
    WallParameters wall;
    wall.bond
        = section.choice<WallBond>("Bond", { { "none", WallBond::none },
                                             { "running", WallBond::running },
                                             { "stack", WallBond::stack },
                                             { "header", WallBond::header },
                                             { "English", WallBond::english },
                                             { "Flemish", WallBond::flemish },
                                             { "random", WallBond::random } });
    if (wall.bond == WallBond::none)
      return wall;
    wall.length      = section.positive("Length");
    wall.n_courses   = section.integer("Courses");
    const auto joint = section.numbers<2>("Joint thickness");
    if (!(joint[0] >= 0. && joint[1] >= 0.))
      section.fail("Joint thickness", "must not be negative.");
    if (wall.n_courses == 0)
      section.fail("Courses", "must be at least 1.");
    wall.unit_length = section.positive("Unit length") + joint[0];
    wall.unit_height = section.positive("Unit height") + joint[1];
    check_number_of_units(section, wall);
    wall.offset         = section.within("Offset", 0., 1.);
    wall.begins_shifted = section.text("First course") == "shifted";
    wall.shortest       = section.within("Shortest piece", 0., 0.5);
    read_random(section, wall);
    wall.openings       = read_openings(section, wall);
    wall.lintel_bearing = section.nonnegative("Lintel bearing");
    wall.bottom_platen  = section.nonnegative("Bottom platen");
    wall.top_platen     = section.nonnegative("Top platen");
    wall.cracks         = section.text("Potential cracks") == "mid-unit";
    wall.element_size   = section.nonnegative("Element size");
    if (wall.element_size == 0.)
      wall.element_size = 0.5 * wall.unit_height;
    const double height = wall.n_courses * wall.unit_height + wall.bottom_platen
                          + wall.top_platen;
    limit_elements(section, 2. * wall.length / wall.element_size * height
                                / wall.element_size);
    wall.structured = section.text("Elements") == "structured";
    if (wall.structured && wall.bond == WallBond::random)
      section.fail("Elements", "must be 'free' with 'Bond = random', whose "
                               "joints lie at any distance.");
    return wall;
  }
} // namespace quoin
