// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/structures/beam_parameters.h>

#include <cmath>
#include <tuple>

namespace quoin
{
  namespace
  {
    const std::vector<std::pair<std::string, BeamSupport>> support_words
        = { { "free", {} },
            { "pinned", { true, true, false } },
            { "fixed", { true, true, true } },
            { "roller x", { false, true, false } },
            { "roller y", { true, false, false } } };

    void enter_line(ParameterEntries &entries, BeamParameters &beam)
    {
      entries.other("Points", "",
                    "Corners x, y of a free beam, in order from its start to "
                    "its end, such as '0, 0; 4, 0'; empty: it lines 'Boundary' "
                    "[m]",
                    [&](const ParameterSection &section)
                    {
                      for (const auto &row :
                           number_rows(section, "Points", 2,
                                       "must be points such as '0, 0; 4, 0'."))
                        beam.points.push_back({ { row[0], row[1] } });
                    });
      entries.integer("Segments", beam.n_segments, 1,
                      "Number of segments of each side of a free beam; a liner "
                      "has those of the mesh [-]");
      entries.text("Boundary", beam.boundary,
                   "Physical curve that is lined, instead of 'Points': a "
                   "boundary of blocks, or that of an excavation. A later "
                   "stage that excavates blocks of it cuts the liner from "
                   "them at once.");
      entries.text("Interface", beam.interface,
                   "Set of joints whose law acts between a liner and the "
                   "blocks, at the nodes of the blocks.");
      entries.text("Stage", beam.stage,
                   "Stage at whose start the beam is placed, without stress in "
                   "the present positions; empty: the first stage.");
    }

    void enter_section(ParameterEntries &entries, BeamParameters &beam)
    {
      entries.positive("Young's modulus", beam.modulus,
                       "Young's modulus of the beam [Pa]");
      double poisson = 0., thickness = 0.;
      entries.within("Poisson's ratio", poisson, 0., 0.5,
                     "Poisson's ratio nu of a liner that is continuous out of "
                     "the plane: E / (1 - nu^2) takes the place of E; 0: bars "
                     "side by side [-]");
      entries.nonnegative("Thickness", thickness,
                          "Thickness t of a liner, whose area and second "
                          "moment are t and t^3/12 by 1 m out of the plane; 0: "
                          "'Area' and 'Second moment' are given [m]");
      entries.nonnegative("Area", beam.area, "Area of the section [m^2]");
      entries.nonnegative("Second moment", beam.second_moment,
                          "Second moment of area of the section [m^4]");
      entries.positive("Density", beam.density,
                       "Density, which must be given: gravity that acts on "
                       "all blocks acts on the beam as well [kg/m^3]");
      entries.nonnegative("Depth", beam.depth,
                          "Depth of the section from one outer fibre to the "
                          "other, symmetric; 0: that of a rectangle with its "
                          "area and second moment [m]");
      for (const auto &[name, value, word] :
           { std::make_tuple("Compressive strength", &beam.compressive_strength,
                             "compressive"),
             std::make_tuple("Tensile strength", &beam.tensile_strength,
                             "tensile") })
        entries.number_or("unlimited", BeamParameters::unlimited, name, *value,
                          std::string("Strength of the section by which the "
                                      "largest ")
                              + word
                              + " stress of its outer fibres, N/A and M by the "
                                "section modulus, is divided in results, or "
                                "'unlimited' [Pa]");
      entries.other(
          "Hinge moment", "unlimited",
          "Moment at which a plastic hinge forms, or 'unlimited', or "
          "'section': "
          "that of a rectangle which bears both strengths, at the axial force "
          "at the node [N m]",
          [&](const ParameterSection &section)
          {
            const std::string text = section.text("Hinge moment");
            beam.hinge_moment = text == "section" ? BeamParameters::by_section
                                : text == "unlimited"
                                    ? BeamParameters::unlimited
                                    : section.numbers<1>("Hinge moment")[0];
            if (text != "section" && !(beam.hinge_moment > 0.))
              section.fail("Hinge moment",
                           "must be positive, 'section' or 'unlimited'.");
          });
      entries.positive("Spacing", beam.spacing,
                       "Distance of beams out of the plane, for the section of "
                       "one beam [m]");
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (thickness > 0. && (beam.area > 0. || beam.second_moment > 0.))
        section->fail("Thickness", "and 'Area' or 'Second moment' are both "
                                   "given. Give one of the two.");
      if (thickness > 0.)
      {
        beam.area          = thickness;
        beam.second_moment = thickness * thickness * thickness / 12.;
      }
      if (!(beam.area > 0. && beam.second_moment > 0.))
        section->fail(beam.area > 0. ? "Second moment" : "Area",
                      "must be positive, or 'Thickness' be given.");
      for (const auto &[name, value] :
           { std::make_pair("Compressive strength", beam.compressive_strength),
             std::make_pair("Tensile strength", beam.tensile_strength) })
      {
        if (!(value > 0.))
          section->fail(name, "must be positive or 'unlimited'.");
        if (beam.hinge_moment == BeamParameters::by_section
            && value == BeamParameters::unlimited)
          section->fail(name, "must be given for 'Hinge moment = section'.");
      }
      if (beam.hinge_moment == BeamParameters::by_section && beam.depth > 0.)
        section->fail("Depth", "is not that of a rectangle, for which alone "
                               "'Hinge moment = section' is. Leave it out, or "
                               "give the moment.");
      if (beam.depth == 0.)
        beam.depth = std::sqrt(12. * beam.second_moment / beam.area);
      beam.modulus /= 1. - poisson * poisson;
    }

    void enter_ends(ParameterEntries &entries, BeamParameters &beam)
    {
      const auto function = [&](const std::string &name, TimeFunction &value,
                                const std::string &sentence)
      {
        entries.other(name, "0", sentence,
                      [&](const ParameterSection &section)
                      {
                        value = section.made(name,
                                             [&]() {
                                               return TimeFunction(
                                                   section.text(name),
                                                   section.folder());
                                             });
                      });
      };
      for (const unsigned int end : { 0, 1 })
      {
        const std::string word = end == 0 ? "Start" : "End";
        entries.choice(word, beam.supports[end], support_words,
                       "Support of the " + std::string(end ? "end" : "start")
                           + " of the beam. pinned: no displacement; fixed: no "
                             "displacement and no rotation; roller x and "
                             "roller y: displacement along that axis alone.");
        for (const unsigned int d : { 0, 1 })
          function(word + " force " + "xy"[d], beam.forces[end][d],
                   "Force at the " + std::string(end ? "end" : "start")
                       + " of the beam along " + std::string(1, "xy"[d])
                       + ", in stages from that which places the beam on: a "
                         "function of t (time in the stage) and T (total time) "
                         "[N]");
      }
      for (const unsigned int d : { 0, 1 })
        function(std::string("Line load ") + "xy"[d], beam.distributed[d],
                 "Force on the beam by length along " + std::string(1, "xy"[d])
                     + ", beside its weight, in stages from that which places "
                       "the beam on: a function of t (time in the stage) and T "
                       "(total time) [N/m]");
    }

    void enter(ParameterEntries &entries, BeamParameters &beam)
    {
      enter_line(entries, beam);
      enter_section(entries, beam);
      enter_ends(entries, beam);
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (beam.points.empty() == !beam.is_liner())
        section->fail("Points", "or 'Boundary' must say where the beam is, and "
                                "not both.");
      if (beam.points.size() == 1)
        section->fail("Points", "must be two points or more.");
      for (unsigned int i = 1; i < beam.points.size(); ++i)
        if (beam.points[i] == beam.points[i - 1])
          section->fail("Points", "has the same point twice in a row. Remove "
                                  "one of them.");
      if (beam.is_liner() && beam.interface.empty())
        section->fail("Interface", "must name the set of joints whose law acts "
                                   "between the liner and the blocks.");
      if (!beam.is_liner() && !beam.interface.empty())
        section->fail("Interface", "belongs to liners: give 'Boundary' instead "
                                   "of 'Points', or leave it empty.");
    }
  } // namespace

  void BeamParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  BeamParameters BeamParameters::read(const ParameterSection &section,
                                      const std::string &name)
  {
    BeamParameters beam = read_entries(section, enter);
    beam.name           = name;
    return beam;
  }
} // namespace quoin
