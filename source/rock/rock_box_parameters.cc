// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/named_sections.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/layout/element_limit.h>
#include <quoin/rock/rock_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

namespace quoin
{
  namespace
  {
    using SpacePoint = dealii::Point<3>;

    Distribution read_spacing(const ParameterSection &section)
    {
      Distribution spacing;
      try
      {
        spacing = Distribution::parse(section.text("Spacing"));
      }
      catch (const std::invalid_argument &error)
      {
        section.fail("Spacing", error.what());
      }
      if (spacing.kind == DistributionKind::von_mises)
        section.fail("Spacing", "is a length: 'Fisher' is for angles. Take "
                                "'log-normal' or 'exponential'.");
      if (!(spacing.mean > 0.) || spacing.share_below_zero() > 0.025)
        section.fail("Spacing",
                     "must be positive, in at least 39 of 40 values of a "
                     "distribution: give the distance of the planes in "
                     "metres, such as 2 or 'log-normal 2, 0.5'.");
      return spacing;
    }

    void enter_set(ParameterEntries &entries, SpaceJointSet &set)
    {
      entries.within("Dip", set.dip, 0., 90.,
                     "Dip of the mean plane below the horizontal [deg]");
      entries.within("Dip direction", set.dip_direction, 0., 360.,
                     "Direction in which the mean plane dips, clockwise from "
                     "north, the y axis [deg]");
      entries.nonnegative(
          "Fisher concentration", set.concentration,
          "Concentration of Fisher's distribution of the normals of the "
          "planes about the mean one, larger for less scatter; 0: no scatter "
          "[-]");
      entries.other("Spacing", "0",
                    "Spacing of the planes along the mean normal: a number, or "
                    "one of 'uniform', 'normal', 'log-normal' with mean and "
                    "standard deviation, or 'exponential' with mean [m]",
                    [&](const ParameterSection &section)
                    { set.spacing = read_spacing(section); });
      entries.within("Persistence", set.persistence, 0., 1.,
                     "Probability that a plane cuts a block in its way [-]");
      std::array<double, 3> origin{};
      entries.numbers("Origin", origin,
                      "Point x, y, z on the first plane of the set [m]");
      set.origin = SpacePoint(origin[0], origin[1], origin[2]);
    }

    void check_box(const ParameterSection &section,
                   const RockBoxParameters &rock)
    {
      double volume = 1.;
      for (unsigned int d = 0; d < 3; ++d)
      {
        if (!(rock.high[d] > rock.low[d]))
          section.fail("Highest corner",
                       "must be larger than 'Lowest corner' in x, y and z.");
        volume *= (rock.high[d] - rock.low[d]) / rock.element_size;
      }
      limit_elements(section, 6. * volume);
      if (rock.sides.size() != 6)
        section.fail("Sides", "must be six names: of the sides of least and "
                              "largest x, y and z.");
    }

    void enter_box(ParameterEntries &entries, RockBoxParameters &rock)
    {
      std::array<double, 3> low{}, high{};
      entries.numbers("Lowest corner", low,
                      "Corner of least x, y, z of a box of rock that the "
                      "program cuts into blocks, instead of reading "
                      "'Mesh/File'; x is east, y north, z up [m]");
      entries.numbers("Highest corner", high,
                      "Corner of largest x, y, z of the box; the same as "
                      "'Lowest corner': no box is generated [m]");
      rock.low  = SpacePoint(low[0], low[1], low[2]);
      rock.high = SpacePoint(high[0], high[1], high[2]);
      if (!entries.reads_if(rock.is_there()))
        return;
      entries.list("Sides", rock.sides,
                   "Names of the sides of the box, each a physical surface: of "
                   "least and largest x, of least and largest y, of least and "
                   "largest z. Sides may share a name; "
                   "empty: left, right, front, back, bottom, top.");
      entries.text("Group", rock.group, "Physical volume of the blocks.");
      entries.integer("Random seed", rock.seed, 0,
                      "Seed of the random number generator of joints; another "
                      "seed gives another realisation of the same statistics.");
      entries.nonnegative(
          "Shortest edge", rock.shortest_edge,
          "Length of an edge below which a joint does not cut a block if that "
          "leaves a shorter one; 0: a hundredth of the element size [m]");
      entries.nonnegative(
          "Smallest block", rock.smallest_block,
          "Volume below which a joint does not cut a block if that leaves a "
          "smaller one; 0: the cube of the shortest edge [m^3]");
      entries.integer("Most blocks", rock.most_blocks, 1,
                      "Number of blocks at which the program stops instead of "
                      "cutting on [-]");
      entries.positive("Element size", rock.element_size,
                       "Longest edge of the elements of the rock mass [m]");
      if (const ParameterSection *section = entries.read_section())
      {
        if (rock.sides.empty())
          rock.sides = RockBoxParameters().sides;
        check_box(*section, rock);
        if (rock.shortest_edge == 0.)
          rock.shortest_edge = 0.01 * rock.element_size;
        if (rock.smallest_block == 0.)
          rock.smallest_block = std::pow(rock.shortest_edge, 3);
      }
    }

    /** Refuses names that bodies share with other parts of the rock. */
    void check_bodies(const ParameterSection &top,
                      const RockBoxParameters &rock)
    {
      const ParameterSection section(top, "Rock bodies");
      std::set<std::string> groups = { rock.group };
      std::set<std::string> names(rock.sides.begin(), rock.sides.end());
      for (const SpaceJointSet &set : rock.sets)
        names.insert(set.name);
      for (const RockBody &body : rock.bodies)
      {
        bool is_new = names.insert(body.name).second;
        for (unsigned int i = 0; i < body.n_parts(); ++i)
          is_new = groups.insert(body.group(i)).second && is_new;
        if (!is_new)
          section.fail("Names",
                       "has '" + body.name
                           + "', but it or one of its rounds has the name of "
                             "the 'Group' or a side of section 'Rock box', of "
                             "a joint set or of another body. Take another "
                             "name.");
        if (body.size > rock.element_size)
          ParameterSection(section, body.name)
              .fail("Element size", "must not exceed that of section 'Rock "
                                    "box', which it refines.");
      }
    }
  } // namespace

  void SpaceJointSet::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_set);
  }

  SpaceJointSet SpaceJointSet::read(const ParameterSection &section,
                                    const std::string &name)
  {
    SpaceJointSet set = read_entries(section, enter_set);
    set.name          = name;
    return set;
  }

  void RockBoxParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_box);
  }

  RockBoxParameters RockBoxParameters::read(const ParameterSection &top)
  {
    RockBoxParameters rock
        = read_entries(ParameterSection(top, "Rock box"), enter_box);
    if (!rock.is_there())
      return rock;
    rock.sets   = read_named<SpaceJointSet>(top, "Rock joint sets");
    rock.bodies = read_named<RockBody>(top, "Rock bodies");
    check_bodies(top, rock);
    const ParameterSection section(top, "Rock joint sets");
    for (const SpaceJointSet &set : rock.sets)
      if (std::count(rock.sides.begin(), rock.sides.end(), set.name) > 0)
        section.fail("Names", "has '" + set.name
                                  + "', which is a side of the box, too. Take "
                                    "another name.");
    return rock;
  }
} // namespace quoin
