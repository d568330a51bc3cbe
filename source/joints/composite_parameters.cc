// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/base/unread_parameters.h>
#include <quoin/joints/composite_parameters.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** A positive number, or infinity for the word 'none'. */
    double positive_or_none(const ParameterSection &section,
                            const std::string &name)
    {
      if (section.text(name) == "none")
        return CompositeLaw::infinity;
      const double value = section.numbers<1>(name).front();
      if (!(value > 0. && std::isfinite(value)))
        section.fail(name, "must be positive, or 'none'.");
      return value;
    }
  } // namespace

  void declare_composite_law(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    prm.declare_entry("Tensile fracture energy", "none", Anything(),
                      "Mode I fracture energy GfI, or 'none': tension does "
                      "not soften [J/m^2]");
    prm.declare_entry("Shear fracture energy", "none", Anything(),
                      "Mode II fracture energy GfII, or 'none': cohesion does "
                      "not soften [J/m^2]");
    prm.declare_entry("Cracks", "stay open",
                      dealii::Patterns::Selection("stay open|close"),
                      "What unloading does to a crack that tension opened. "
                      "stay open: unloading is elastic, compression comes back "
                      "before the crack is closed, as published; close: it "
                      "closes without resistance first, for cyclic loading.");
    prm.declare_entry("Dilation pressure", "none", Anything(),
                      "Pressure under which the joint dilates no more, or "
                      "'none': any [Pa]");
    prm.declare_entry("Dilation decay", "0", Double(),
                      "How fast dilation wears off with slip, delta; not read "
                      "without 'Cohesion' and 'Shear fracture energy' [1/m]");
    prm.declare_entry("Compressive strength", "none", Anything(),
                      "fm of the masonry, or 'none': no crushing [Pa]");
    prm.declare_entry("Compressive fracture energy", "0", Double(),
                      "Gfc [J/m^2]");
    prm.declare_entry("Peak crushing", "0", Double(),
                      "Plastic closing at fm, kappa_p [m]");
    prm.declare_entry("Cap shear", "9", Double(),
                      "Weight Css of the shear traction in the cap [-]");
    prm.declare_entry("Cap normal", "1", Double(),
                      "Weight Cnn of the normal traction in the cap [-]");
    prm.declare_entry("Cap offset", "0", Double(),
                      "Cn of the cap, whose centre is at -Cn/(2 Cnn) [Pa]");
  }

  CompositeLaw read_composite_law(const ParameterSection &section)
  {
    CompositeLaw law;
    law.normal_stiffness = section.positive("Normal stiffness");
    law.shear_stiffness  = section.positive("Shear stiffness");
    law.tension          = section.nonnegative("Tensile strength");
    law.tension_energy   = positive_or_none(section, "Tensile fracture energy");
    law.cohesion         = section.nonnegative("Cohesion");
    law.shear_energy     = positive_or_none(section, "Shear fracture energy");

    const double angle = section.within("Friction angle", 0., 89.);
    double residual    = angle;
    if (section.text("Residual friction angle") != "same")
      residual = section.numbers<1>("Residual friction angle").front();
    if (!(residual >= 0. && residual <= 89.))
      section.fail("Residual friction angle",
                   "must lie between 0 and 89 degrees, or be 'same'.");
    law.friction          = tangent_of_degrees(angle);
    law.residual_friction = tangent_of_degrees(residual);
    if (law.tension * std::max(law.friction, law.residual_friction)
        > law.cohesion)
      section.fail(
          "Tensile strength",
          "must not exceed 'Cohesion' over the tangent of the friction "
          "angle, where shear strength ends.");

    law.dilation = tangent_of_degrees(
        section.within("Dilation angle", 0., std::min(angle, residual)));
    law.dilation_pressure = positive_or_none(section, "Dilation pressure");
    law.dilation_decay    = section.nonnegative("Dilation decay");

    law.cracks_close = section.text("Cracks") == "close";

    law.compression = positive_or_none(section, "Compressive strength");
    if (std::isinf(law.compression))
    {
      refuse_unread(section, "Compressive strength",
                    { { "Compressive fracture energy", "0", { "a number" } },
                      { "Peak crushing", "0", { "a number" } } });
      return law;
    }
    law.compression_energy = section.positive("Compressive fracture energy");
    law.peak_crushing      = section.positive("Peak crushing");
    law.cap_shear          = section.positive("Cap shear");
    law.cap_normal         = section.positive("Cap normal");
    law.cap_offset         = section.nonnegative("Cap offset");
    return law;
  }

  std::string snap_back_warning(const CompositeLaw &law)
  {
    if (law.softens_gently())
      return "";
    return "the joint drops by itself at failure and does not dissipate its "
           "fracture energies. 'Normal stiffness' should be above ft^2 / GfI = "
           + number_text(law.tension * law.tension / law.tension_energy)
           + " Pa/m and above the slope of the cap, 'Shear stiffness' above "
             "c^2 / GfII = "
           + number_text(law.cohesion * law.cohesion / law.shear_energy)
           + " Pa/m.";
  }
} // namespace quoin
