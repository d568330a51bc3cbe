// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/loads/load_components.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/traction_entries.h>

#include <deal.II/base/utilities.h>

#include <memory>
#include <string>

namespace quoin
{
  namespace
  {
    void read_shape(const ParameterSection &section, MovingShape shape,
                    LoadParameters &load)
    {
      const std::string centres = section.text("Moving centre");
      if (shape.kind == MovingShape::Kind::none)
      {
        if (!centres.empty() || shape.width != 0.)
          section.fail(centres.empty() ? "Moving width" : "Moving centre",
                       "has no effect with 'Moving shape = none'. Give the "
                       "shape of the load that moves.");
        return;
      }
      if (centres.empty())
        section.fail("Moving centre",
                     "must be the place of the load as a function of time, "
                     "such as 2 + 10*t, or those of several with semicolons "
                     "between them [m].");
      if (shape.width == 0.)
        section.fail("Moving width", "must be positive: give the length over "
                                     "which the load is spread [m].");
      for (const std::string &text :
           dealii::Utilities::split_string_list(centres, ';'))
        shape.centres.push_back(time_function(section, "Moving centre", text));
      load.shape = std::make_shared<MovingShape>(shape);
    }

    void enter_shape(ParameterEntries &entries, LoadParameters &load)
    {
      using Kind = MovingShape::Kind;
      MovingShape shape;
      entries.choice("Moving shape", shape.kind,
                     { { "none", Kind::none },
                       { "uniform", Kind::uniform },
                       { "triangular", Kind::triangular },
                       { "cosine", Kind::cosine } },
                     "Shape of a moving traction: a factor with the mean 1 "
                     "over its width and 0 outside, so that the force is "
                     "traction times width times thickness for every shape.");
      std::string centres;
      entries.text("Moving centre", centres,
                   "Coordinate of the centre of a moving traction, a function "
                   "of time as 'Horizontal'; for several axles, functions with "
                   "semicolons between them [m]");
      entries.nonnegative("Moving width", shape.width,
                          "Width of a moving traction along its axis [m]");
      entries.choice("Moving axis", shape.axis,
                     { { "x", 0U }, { "y", 1U }, { "z", 2U } },
                     "Axis along which a traction moves.");
      if (const ParameterSection *section = entries.read_section())
        read_shape(*section, shape, load);
    }

    /** Makes the pressure of "uplift" from what is given of it beside. */
    void enter_uplift(ParameterEntries &entries, LoadParameters &load)
    {
      UpliftDiagram uplift;
      const auto level
          = [&](const ParameterSection &section, const std::string &name)
      {
        return section.text(name).empty()
                   ? TimeFunction()
                   : time_function(section, name, section.text(name));
      };
      const auto point
          = [&](const ParameterSection &section, const std::string &name)
      {
        if (section.text(name).empty())
          return dealii::Point<2>();
        const auto row = section.numbers<2>(name);
        return dealii::Point<2>(row[0], row[1]);
      };
      entries.other(
          "Headwater", "",
          "Level of the water at the heel of a joint with 'Pressure = uplift', "
          "a function of time [m]",
          [&](const ParameterSection &section)
          { uplift.headwater = level(section, "Headwater"); });
      entries.other("Tailwater", "",
                    "Level of the water at the toe of a joint with 'Pressure = "
                    "uplift', a function of time; without water there it is "
                    "the level of the toe itself [m]",
                    [&](const ParameterSection &section)
                    { uplift.tailwater = level(section, "Tailwater"); });
      entries.other("Heel", "",
                    "Point x, y where a joint with 'Pressure = uplift' begins, "
                    "at the side of the headwater [m]",
                    [&](const ParameterSection &section)
                    { uplift.heel = point(section, "Heel"); });
      entries.other("Toe", "",
                    "Point x, y where a joint with 'Pressure = uplift' ends, "
                    "at the side of the tailwater [m]",
                    [&](const ParameterSection &section)
                    { uplift.toe = point(section, "Toe"); });
      entries.nonnegative("Drain distance", uplift.drain,
                          "Distance of a line of drains below a dam from the "
                          "heel; 0: there are no drains [m]");
      entries.within("Drain efficiency", uplift.efficiency, 0., 1.,
                     "Fraction by which drains lower the water level at their "
                     "line; with 1 it is 'Drain level' [-]");
      entries.other("Drain level", "tailwater",
                    "Height of the outlets of drains, such as that of a "
                    "gallery; 'tailwater': the level 'Tailwater' [m]",
                    [&](const ParameterSection &section)
                    {
                      if (section.text("Drain level") != "tailwater")
                        uplift.drain_level = section.number("Drain level");
                    });
      entries.choice("In cracks", uplift.enters_cracks,
                     { { "given", false }, { "full head", true } },
                     "Uplift in the part of the joint that has opened from the "
                     "heel on. given: the same as in a closed joint; full "
                     "head: the headwater, from the "
                     "end of the crack on linear to the toe, or to the drains "
                     "if they are beyond it.");
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (section->text("Pressure") != "uplift")
      {
        for (const std::string name :
             { "Headwater", "Tailwater", "Heel", "Toe", "Drain distance",
               "Drain efficiency", "Drain level", "In cracks" })
          if (const std::string &text = section->text(name);
              !(text.empty() || text == "0" || text == "tailwater"
                || text == "given"))
            section->fail(name, "goes with 'Pressure = uplift' alone. Remove "
                                "it, or give that pressure.");
        return;
      }
      for (const std::string name : { "Headwater", "Tailwater", "Heel", "Toe" })
        if (section->text(name).empty())
          section->fail(name, "is missing: 'Pressure = uplift' needs "
                              "'Headwater' and 'Tailwater', levels, and 'Heel' "
                              "and 'Toe', points x, y [m].");
      if (uplift.length() == 0.)
        section->fail("Toe", "is where 'Heel' is. Give the other end of the "
                             "joint.");
      if (uplift.drain >= uplift.length())
        section->fail("Drain distance",
                      text_of("must be less than the length ", uplift.length(),
                              " m from 'Heel' to 'Toe'."));
      if (uplift.drain == 0. && (uplift.efficiency > 0. || uplift.drain_level))
        section->fail("Drain distance", "is 0, so that there are no drains. "
                                        "Give their distance from the heel.");
      if (uplift.drain > 0. && uplift.efficiency == 0.)
        section->fail("Drain efficiency", "is 0, so that the drains do "
                                          "nothing. Give it, or leave out "
                                          "'Drain distance'.");
      load.pressure.field = std::make_shared<LoadField>(
          std::make_shared<const UpliftDiagram>(uplift));
    }

    void enter_added_mass(ParameterEntries &entries, LoadParameters &load)
    {
      entries.choice(
          "Added mass", load.has_added_mass,
          { { "none", false }, { "Westergaard", true } },
          "Water that moves with the face in an earthquake, beside its "
          "'Pressure = water LEVEL'. Westergaard: a mass of 7/8 rho sqrt(H z) "
          "by the area at the depth z in a reservoir of the depth H, along the "
          "normal, in explicit stages with 'End = time' that are not damped or "
          "have Rayleigh damping.");
      entries.other(
          "Reservoir floor", "automatic",
          "Height of the ground below the water, up from which the depth H of "
          "the reservoir counts; automatic: the lowest point of 'Boundary' [m]",
          [&](const ParameterSection &section)
          {
            if (section.text("Reservoir floor") != "automatic")
              load.reservoir_floor = section.number("Reservoir floor");
          });
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (!load.has_added_mass)
      {
        if (load.reservoir_floor)
          section->fail("Reservoir floor", "has no effect with 'Added mass = "
                                           "none'. Remove it, or add the mass "
                                           "of the water.");
        return;
      }
      if (!load.pressure.field || !load.pressure.field->level())
        section->fail("Added mass", "needs the level of the water: give "
                                    "'Pressure = water LEVEL', such as "
                                    "'water 12'.");
      if (load.distribution || load.shape)
        section->fail("Added mass",
                      "does not go with 'Distribution' or 'Moving shape', "
                      "which the mass of the water does not have. Remove "
                      "these.");
    }
  } // namespace

  void enter_traction(ParameterEntries &entries, LoadParameters &load)
  {
    enter_shape(entries, load);
    enter_uplift(entries, load);
    enter_added_mass(entries, load);
  }
} // namespace quoin
