// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/named_sections.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/water/water_parameters.h>

namespace quoin
{
  namespace
  {
    void enter_aperture(ParameterEntries &entries, HydraulicAperture &joint)
    {
      entries.number("Initial aperture", joint.initial,
                     "Hydraulic aperture of the joints of the set where their "
                     "mechanical opening is 0, between the residual and the "
                     "largest one; the opening adds to it [m]");
      entries.positive("Residual aperture", joint.residual,
                       "Smallest hydraulic aperture, of closed joints [m]");
      entries.positive("Largest aperture", joint.largest,
                       "Largest hydraulic aperture, of wide open joints [m]");
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (joint.largest < joint.residual)
        section->fail("Largest aperture", "must not be less than 'Residual "
                                          "aperture'.");
      // Otherwise openings would do nothing before they are beyond the
      // difference, and the joint would not have the aperture that is given.
      if (joint.largest < joint.initial)
        section->fail("Largest aperture",
                      "must not be less than 'Initial aperture = "
                          + section->text("Initial aperture")
                          + "', which joints have where their opening is 0.");
      if (joint.initial < joint.residual)
        section->fail("Residual aperture",
                      "must not be more than 'Initial aperture = "
                          + section->text("Initial aperture")
                          + "', which joints have where their opening is 0.");
    }

    void enter_boundary(ParameterEntries &entries, WaterBoundary &boundary)
    {
      entries.list("Boundary", boundary.curves,
                   "Physical curves on which joints end, or along which joints "
                   "run, where the value is given; empty: at 'Point'.");
      entries.other(
          "Point", "",
          "Point x, y whose nearest end or crossing of joints has the value; "
          "empty: on 'Boundary' [m]",
          [&](const ParameterSection &section)
          {
            if (!section.text("Point").empty())
              boundary.point = section.numbers<2>("Point");
          });
      entries.choice("Quantity", boundary.quantity,
                     { { "pressure", WaterQuantity::pressure },
                       { "head", WaterQuantity::head },
                       { "flow", WaterQuantity::flow },
                       { "outlet", WaterQuantity::outlet } },
                     "Given quantity. pressure [Pa]; head: height y to which "
                     "water would rise [m]; flow: volume that enters the "
                     "joints, in equal shares at all their ends on 'Boundary', "
                     "negative where it is taken out [m^3/s]; outlet: with "
                     "'Free surface' of section 'Water', a face at which water "
                     "comes out at pressure 0 and none enters, without "
                     "'Value'. With a free surface, places above a given head "
                     "are outlets.");
      entries.other("Value", "0",
                    "Value of 'Quantity', a number or a function of the time t "
                    "in the stage and T in the run, a table or a signal.",
                    [&](const ParameterSection &section)
                    {
                      boundary.value = section.made("Value",
                                                    [&]() {
                                                      return TimeFunction(
                                                          section.text("Value"),
                                                          section.folder());
                                                    });
                    });
      if (const ParameterSection *section = entries.read_section();
          section && boundary.curves.empty() == !boundary.point)
        section->fail("Boundary", "and 'Point': give one of them.");
    }

    void enter_water(ParameterEntries &entries, WaterParameters &water)
    {
      entries.choice(
          "Flow", water.flow,
          { { "none", FlowKind::none },
            { "steady", FlowKind::steady },
            { "transient", FlowKind::transient } },
          "Flow of water along the joints of 'Water joints'. none: no flow; "
          "steady: the flow in equilibrium with the present apertures at any "
          "time; transient: with storage of water in the joints.");
      entries.positive("Viscosity", water.fluid.viscosity,
                       "Dynamic viscosity of the water [Pa s]");
      entries.nonnegative("Unit weight", water.fluid.unit_weight,
                          "Weight of the water, which acts against y; 0: no "
                          "gravity in the flow [N/m^3]");
      entries.positive("Bulk modulus", water.fluid.bulk_modulus,
                       "Bulk modulus of the water, in transient flow [Pa]");
      entries.flag("Free surface", water.fluid.has_free_surface,
                   "Whether joints can be filled in part, at pressure 0, so "
                   "that water has a free surface; otherwise they are full, "
                   "and pressures may be negative.");
      entries.choice("Initial state", water.initial,
                     { { "dry", InitialWater::dry },
                       { "full", InitialWater::full },
                       { "steady", InitialWater::steady } },
                     "State at the start of transient flow. dry: pressure 0, "
                     "with a free surface no water; full: pressure 0, joints "
                     "filled; steady: that of steady flow with the values "
                     "given at boundaries then.");
      entries.flag("Suction", water.has_suction,
                   "Whether negative pressures pull the faces of joints "
                   "together; otherwise they count as 0 on the faces.");
      if (const ParameterSection *section = entries.read_section();
          section && water.has_suction && water.fluid.has_free_surface)
        section->fail("Suction", "does not go with 'Free surface = yes', with "
                                 "which no pressure is negative. Leave one "
                                 "of them out.");
      entries.integer("Steps between solutions", water.interval, 1,
                      "Number of steps of the explicit solver from one "
                      "solution of steady flow to the next [-]");
      entries.list("Stages", water.stages,
                   "Stages in which water is in the joints; empty: all.");
    }
  } // namespace

  void HydraulicAperture::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_aperture);
  }

  HydraulicAperture HydraulicAperture::read(const ParameterSection &section,
                                            const std::string &name)
  {
    HydraulicAperture joint = read_entries(section, enter_aperture);
    joint.name              = name;
    return joint;
  }

  void WaterBoundary::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_boundary);
  }

  WaterBoundary WaterBoundary::read(const ParameterSection &section,
                                    const std::string &name)
  {
    WaterBoundary boundary = read_entries(section, enter_boundary);
    boundary.name          = name;
    return boundary;
  }

  void WaterParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_water);
  }

  WaterParameters WaterParameters::read(const ParameterSection &top)
  {
    WaterParameters water
        = read_entries(ParameterSection(top, "Water"), enter_water);
    water.joints     = read_named<HydraulicAperture>(top, "Water joints");
    water.boundaries = read_named<WaterBoundary>(top, "Water boundaries");
    for (const WaterBoundary &boundary : water.boundaries)
      if (boundary.quantity == WaterQuantity::outlet
          && !water.fluid.has_free_surface)
        ParameterSection(ParameterSection(top, "Water boundaries"),
                         boundary.name)
            .fail("Quantity", "is only for 'Free surface = yes' of section "
                              "'Water'. Set that, or give 'pressure'.");
    return water;
  }

  bool WaterParameters::changes(const double start, const double duration) const
  {
    if (flow == FlowKind::transient)
      return true;
    constexpr unsigned int n_samples = 100;
    for (const WaterBoundary &boundary : boundaries)
      for (unsigned int i = 1; i <= n_samples; ++i)
      {
        const double t = duration * i / n_samples;
        if (boundary.value({ t, start + t }) != boundary.value({ 0., start }))
          return true;
      }
    return false;
  }
} // namespace quoin
