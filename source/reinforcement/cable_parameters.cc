// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/base/unread_parameters.h>
#include <quoin/reinforcement/cable_parameters.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    enum class Pattern
    {
      single,
      row,
      radial
    };

    struct Places
    {
      Pattern pattern = Pattern::single;
      std::array<double, 2> from{}, to{}, step{}, centre{};
      double radius = 0., length = 0.;
      std::array<double, 2> angles{ { 0., 360. } }; /**< [deg] */
      unsigned int number = 1;
    };

    void enter_places(ParameterEntries &entries, Places &places)
    {
      entries.choice(
          "Pattern", places.pattern,
          { { "single", Pattern::single },
            { "row", Pattern::row },
            { "radial", Pattern::radial } },
          "Pattern of the bars. single: one bar between two points; row: "
          "'Number' parallel bars, each by 'Step' from the last one; radial: "
          "'Number' bars around 'Centre', that begin at 'Radius' and point "
          "outwards.");
      if (entries.reads_if(places.pattern != Pattern::radial))
      {
        entries.numbers("From", places.from,
                        "Head of the bar, or of the first one of a row, x and "
                        "y: where the face plate is and the free length begins "
                        "[m]");
        entries.numbers(
            "To", places.to,
            "Far end of the bar, or of the first one of a row, x and y [m]");
      }
      if (entries.reads_if(places.pattern == Pattern::row))
        entries.numbers(
            "Step", places.step,
            "Distance from one bar of a row to the next, x and y [m]");
      if (entries.reads_if(places.pattern != Pattern::single))
        entries.integer("Number", places.number, 1,
                        "Number of bars of a row or of a radial pattern [-]");
      if (entries.reads_if(places.pattern == Pattern::radial))
      {
        entries.numbers("Centre", places.centre,
                        "Centre of a radial pattern, x and y [m]");
        entries.nonnegative(
            "Radius", places.radius,
            "Distance of the heads of a radial pattern from its centre [m]");
        entries.nonnegative("Length", places.length,
                            "Length of each bar of a radial pattern [m]");
        entries.numbers(
            "Angles", places.angles,
            "Directions of the first and the last bar of a radial pattern, "
            "anticlockwise from x; a full turn, such as 0, 360, "
            "does not repeat the first one [deg]");
      }
      if (const ParameterSection *section = entries.read_section())
        refuse_unread(*section, "Pattern",
                      { { "From", "0, 0", { "single", "row" } },
                        { "To", "0, 0", { "single", "row" } },
                        { "Step", "0, 0", { "row" } },
                        { "Number", "1", { "row", "radial" } },
                        { "Centre", "0, 0", { "radial" } },
                        { "Radius", "0", { "radial" } },
                        { "Length", "0", { "radial" } },
                        { "Angles", "0, 360", { "radial" } } });
    }

    /** A strength, or 'unlimited'. */
    void enter_limit(ParameterEntries &entries, const std::string &name,
                     double &value, const std::string &sentence)
    {
      constexpr double none = -1.;
      value                 = none;
      entries.number_or("unlimited", none, name, value, sentence);
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (section->text(name) == "unlimited")
        value = BarLaw::unlimited;
      else if (!(value > 0.))
        section->fail(name, "must be positive, or 'unlimited'.");
    }

    /** What is read of one section, before it is put together. */
    struct Entries : CableParameters
    {
      double diameter = 0.025, modulus = 200e9, friction = 0.;
    };

    void enter(ParameterEntries &entries, Entries &cable)
    {
      BarLaw &law = cable.law;
      entries.text("Stage", cable.stage,
                   "Stage at whose start the bars are installed, without "
                   "stress but for their pretension; empty: the first one.");
      entries.positive("Spacing", cable.spacing,
                       "Distance of the bars out of the plane: stiffnesses and "
                       "strengths, which are those of one bar, act times the "
                       "thickness of the blocks divided by it [m]");
      entries.positive("Diameter", cable.diameter, "Diameter of the bar [m]");
      entries.positive("Young's modulus", cable.modulus,
                       "Young's modulus of the bar [Pa]");
      enter_limit(entries, "Yield force", law.yield,
                  "Axial force at which a bar yields, without hardening, in "
                  "tension and compression, or 'unlimited' [N]");
      enter_limit(entries, "Rupture strain", law.rupture_strain,
                  "Axial strain, elastic and plastic, at which an element of a "
                  "bar breaks in tension, or 'unlimited' [-]");
      entries.nonnegative("Bond stiffness", law.bond_stiffness,
                          "Shear stiffness of the grout around a bar, force by "
                          "slip and length; 0: no grout [N/m^2]");
      enter_limit(entries, "Bond strength", law.bond_strength,
                  "Largest force that the grout transfers by length where the "
                  "rock does not press on it, or 'unlimited' [N/m]");
      entries.within("Bond friction angle", cable.friction, 0., 80.,
                     "Friction angle by which the bond gains strength from the "
                     "mean pressure of the rock across the bar, on the "
                     "circumference of 'Diameter' [deg]",
                     constants::degree);
      entries.nonnegative("Free length", cable.free_length,
                          "Length from the head on that has no bond [m]");
      entries.nonnegative("Plate stiffness", law.plate_stiffness,
                          "Stiffness of the face plate at the head against the "
                          "rock, in compression; 0: no plate [N/m]");
      enter_limit(entries, "Plate strength", law.plate_strength,
                  "Force at which the face plate yields, or 'unlimited' [N]");
      entries.nonnegative("Anchor stiffness", law.anchor_stiffness,
                          "Stiffness of an anchor at the far end, such as an "
                          "expansion shell; 0: no anchor [N/m]");
      enter_limit(entries, "Anchor strength", law.anchor_strength,
                  "Force at which the anchor slips, or 'unlimited' [N]");
      entries.nonnegative(
          "Pretension", cable.pretension,
          "Force to which a bar is tensioned against its plate when it is "
          "installed; an anchor bears it before the grout sets, without one "
          "the grout does [N]");
      entries.nonnegative("Dowel stiffness", law.dowel_stiffness,
                          "Shear stiffness of a bar at each joint that it "
                          "crosses outside of its free length; 0: none [N/m]");
      enter_limit(entries, "Dowel strength", law.dowel_strength,
                  "Shear force at which a bar yields at a joint that it "
                  "crosses, or 'unlimited' [N]");
      entries.nonnegative("Dowel axial stiffness", law.dowel_axial_stiffness,
                          "Axial stiffness of local reinforcement at each "
                          "joint, beside that of bar and bond; 0: none [N/m]");
      enter_limit(entries, "Dowel axial strength", law.dowel_axial_strength,
                  "Axial force at which the local reinforcement at a joint "
                  "yields, or 'unlimited' [N]");
      law.active_length = 0.1;
      entries.positive("Active length", law.active_length,
                       "Length of the bar across a joint that has no bond and "
                       "turns with the motion of the joint; at most two thirds "
                       "of the bonded length on either side of it, and cut to "
                       "that if it is longer, with a warning [m]");
      constexpr double automatic = 0.;
      entries.number_or(
          "automatic", automatic, "Element length", cable.element_length,
          "Largest length of the elements of a bonded bar, or 'automatic': a "
          "quarter of the length sqrt(E A / k_b) over which the bond takes the "
          "force of the bar over, with which it is pulled out within 0.8 % of "
          "the exact stiffness; no less than a thousandth of the bar [m]");
      if (const ParameterSection *section = entries.read_section();
          section && section->text("Element length") != "automatic"
          && !(cable.element_length > 0.))
        section->fail("Element length", "must be positive, or 'automatic'.");
    }

    std::vector<BarEnds> bars_of(const Places &places,
                                 const ParameterSection &section)
    {
      const bool is_radial = places.pattern == Pattern::radial;
      if (!is_radial && places.from == places.to)
        section.fail("To", "must be another point than 'From'.");
      if (is_radial && places.length == 0.)
        section.fail("Length", "must be positive in a radial pattern.");
      if (places.pattern == Pattern::row && places.number > 1
          && places.step == std::array<double, 2>{})
        section.fail("Step", "must not be 0, 0: all bars of the row would be "
                             "one.");
      std::vector<BarEnds> result;
      const double turn    = places.angles[1] - places.angles[0];
      const bool is_closed = std::abs(std::abs(turn) - 360.) < 1e-9;
      for (unsigned int i = 0; i < places.number; ++i)
        if (is_radial)
        {
          const unsigned int n_gaps
              = std::max(1U, places.number - (is_closed ? 0 : 1));
          const double angle
              = (places.angles[0] + turn * i / n_gaps) * constants::degree;
          const dealii::Point<2> t(std::cos(angle), std::sin(angle));
          const dealii::Point<2> head
              = dealii::Point<2>(places.centre[0], places.centre[1])
                + places.radius * t;
          result.push_back({ { head, head + places.length * t } });
        }
        else
        {
          const dealii::Point<2> step(i * places.step[0], i * places.step[1]);
          result.push_back(
              { { dealii::Point<2>(places.from[0], places.from[1]) + step,
                  dealii::Point<2>(places.to[0], places.to[1]) + step } });
        }
      return result;
    }

    /** The most elements of a bar by the length of those with bond: each of a
        bar's steps solves for all of them, and their derivatives are a full
        matrix. */
    constexpr double most_elements = 1000.;

    /** Length of elements that make the pull-out too stiff by h^2 k_b/8 E A =
        0.8 %; of bars with more bond than most_elements of these, longer. */
    double automatic_length(const CableParameters &cable)
    {
      constexpr double share = 0.25;
      const BarLaw &law      = cable.law;
      const auto &[a, b]     = cable.bars[0];
      const double whole     = a.distance(b);
      if (law.bond_stiffness == 0.)
        return whole;
      return std::max(share * std::sqrt(law.stiffness / law.bond_stiffness),
                      whole / most_elements);
    }

    /** Refuses strengths of what a bar does not have. */
    void refuse_idle_strengths(const BarLaw &law, const double friction,
                               const ParameterSection &section)
    {
      const auto refuse = [&](const std::string &name, const double stiffness,
                              const std::string &needs)
      {
        if (stiffness == 0. && section.text(name) != "unlimited")
          section.fail(name, "has no effect without '" + needs
                                 + "': there is nothing that could yield. Give "
                                   "that, or leave this one 'unlimited'.");
      };
      refuse("Bond strength", law.bond_stiffness, "Bond stiffness");
      refuse("Plate strength", law.plate_stiffness, "Plate stiffness");
      refuse("Anchor strength", law.anchor_stiffness, "Anchor stiffness");
      refuse("Dowel strength", law.dowel_stiffness, "Dowel stiffness");
      refuse("Dowel axial strength", law.dowel_axial_stiffness,
             "Dowel axial stiffness");
      if (friction > 0.
          && (law.bond_stiffness == 0.
              || law.bond_strength == BarLaw::unlimited))
        section.fail("Bond friction angle",
                     "has no effect: it adds to a 'Bond strength', which is "
                     "unlimited here. Give that of the bond without pressure, "
                     "or remove this.");
    }

    void check(const CableParameters &cable, const ParameterSection &section)
    {
      const BarLaw &law   = cable.law;
      const double length = cable.bars[0][0].distance(cable.bars[0][1]);
      if (law.bond_stiffness > 0.
          && length > (1. + 1e-9) * most_elements * cable.element_length)
        section.fail("Element length",
                     text_of("divides a bar of ", length, " m into more than ",
                             most_elements, " elements. Take ",
                             length / most_elements,
                             " m or more, or 'automatic'."));
      if (cable.free_length >= length
          && !(cable.free_length == length && law.anchor_stiffness > 0.))
        section.fail("Free length", "must be less than the length of the bar, "
                                    "or equal to it with an anchor at its "
                                    "end.");
      const bool has_bond
          = law.bond_stiffness > 0. && cable.free_length < length;
      const bool is_held
          = has_bond || (law.plate_stiffness > 0. && law.anchor_stiffness > 0.);
      if (!is_held && law.dowel_stiffness == 0.
          && law.dowel_axial_stiffness == 0.)
        section.fail("Bond stiffness",
                     "leaves a bar that nothing holds in the rock: give a "
                     "bond, a plate and an anchor, or a dowel.");
      if (cable.pretension == 0.)
        return;
      if (law.plate_stiffness == 0.)
        section.fail("Pretension", "needs a face plate to act against: give "
                                   "'Plate stiffness'.");
      for (const auto &[strength, name] :
           { std::make_pair(law.yield, "Yield force"),
             std::make_pair(law.plate_strength, "Plate strength"),
             std::make_pair(law.anchor_stiffness > 0. ? law.anchor_strength
                                                      : BarLaw::unlimited,
                            "Anchor strength") })
        if (cable.pretension > strength)
          section.fail("Pretension",
                       "is more than '" + std::string(name) + "'. Lower it.");
      if (law.anchor_stiffness == 0. && !has_bond)
        section.fail("Pretension", "needs an anchor or a bond beyond the free "
                                   "length, which bears it.");
    }
  } // namespace

  void CableParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_places);
    declare_entries(prm, enter);
  }

  CableParameters CableParameters::read(const ParameterSection &section,
                                        const std::string &name)
  {
    const Entries entries = read_entries(section, enter);
    CableParameters cable = entries;
    cable.name            = name;
    cable.bars          = bars_of(read_entries(section, enter_places), section);
    cable.law.stiffness = entries.modulus * constants::pi * entries.diameter
                          * entries.diameter / 4.;
    cable.law.bond_friction
        = std::tan(entries.friction) * constants::pi * entries.diameter;
    if (cable.element_length == 0.)
      cable.element_length = automatic_length(cable);
    // The length follows from coordinates, with their rounding.
    if (const double length = cable.bars[0][0].distance(cable.bars[0][1]);
        std::abs(cable.free_length - length) <= 1e-9 * length)
      cable.free_length = length;
    check(cable, section);
    refuse_idle_strengths(cable.law, entries.friction, section);
    return cable;
  }

  std::vector<BarEnds> all_bars(const std::vector<CableParameters> &cables)
  {
    std::vector<BarEnds> result;
    for (const CableParameters &cable : cables)
      result.insert(result.end(), cable.bars.begin(), cable.bars.end());
    return result;
  }
} // namespace quoin
