// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/joints/rock_laws.h>

namespace quoin
{
  namespace
  {
    using constants::degree;

    /** Where 'Largest normal stiffness = 0' puts the end of the hyperbola. */
    constexpr double stiffening = 25.;

    double residual_angle(const ParameterSection &section)
    {
      if (section.text("Residual friction angle") == "same")
        section.fail("Residual friction angle",
                     "must be given for this law: the angle that is left when "
                     "the joint is smooth, in degrees.");
      const double angle
          = section.numbers<1>("Residual friction angle").front();
      if (!(angle > 0. && angle < 70.))
        section.fail("Residual friction angle",
                     "must lie between 0 and 70 degrees for this law.");
      return angle * degree;
    }

    void refuse_bond(const ParameterSection &section)
    {
      for (const char *name :
           { "Cohesion", "Tensile strength", "Residual cohesion",
             "Residual tensile strength", "Dilation angle" })
        if (section.nonnegative(name) > 0.)
          section.fail(name, "must be 0 for this law, whose strength is "
                             "friction and whose dilation follows from it. "
                             "Use 'Coulomb' for a joint that is bonded.");
    }

    BartonBandisLaw read_barton_bandis(const ParameterSection &section)
    {
      const double first   = section.positive("Normal stiffness");
      const double closure = section.positive("Largest closure");
      double largest       = section.nonnegative("Largest normal stiffness");
      if (largest == 0.)
        largest = stiffening * first;
      if (largest < first)
        section.fail("Largest normal stiffness",
                     "must not be less than 'Normal stiffness', with which "
                     "the joint begins; 0 takes 25 times that.");
      BartonBandisLaw law{ HyperbolicClosure(first, closure, largest) };
      law.stiffness        = section.positive("Shear stiffness");
      law.residual_angle   = residual_angle(section);
      double roughness     = section.within("Joint roughness", 0., 30.);
      law.wall_strength    = section.positive("Joint wall strength");
      const double length  = section.nonnegative("Joint length");
      const double samples = section.nonnegative("Laboratory length");
      if (samples > 0.)
      {
        if (length < samples)
          section.fail("Joint length",
                       "must be given, and not be less than 'Laboratory "
                       "length', if roughness and wall strength are to be "
                       "corrected for it.");
        const double ratio = length / samples;
        law.wall_strength *= std::pow(ratio, -0.03 * roughness);
        roughness *= std::pow(ratio, -0.02 * roughness);
      }
      law.roughness = roughness * degree;
      law.peak_slip = section.nonnegative("Peak slip");
      if (law.peak_slip == 0.)
      {
        if (length == 0. || roughness == 0.)
          section.fail("Peak slip", "must be given, or 'Joint length' and "
                                    "'Joint roughness', from which it "
                                    "follows.");
        law.peak_slip = length / 500. * std::pow(roughness / length, 0.33);
      }
      return law;
    }

    ContinuouslyYieldingLaw
    read_continuously_yielding(const ParameterSection &section)
    {
      PowerStiffness normal;
      normal.reference_traction = section.positive("Reference stress");
      normal.lowest             = section.positive("Lowest stress");
      normal.highest            = section.positive("Highest stress");
      if (normal.highest < normal.lowest)
        section.fail("Highest stress", "must not be less than 'Lowest "
                                       "stress', below which stiffnesses are "
                                       "constant too.");
      PowerStiffness shear = normal;
      normal.reference     = section.positive("Normal stiffness");
      normal.exponent      = section.within("Normal exponent", 0., 1.);
      shear.reference      = section.positive("Shear stiffness");
      shear.exponent       = section.within("Shear exponent", 0., 1.);

      ContinuouslyYieldingLaw law{ PowerClosure(normal), shear };
      law.residual_angle = residual_angle(section);
      law.initial_angle  = section.within("Friction angle", 0., 89.) * degree;
      if (law.initial_angle < law.residual_angle)
        section.fail("Friction angle",
                     "must not be less than 'Residual friction angle': it is "
                     "that of the joint before it is worn.");
      law.roughness = section.positive("Roughness");
      return law;
    }
  } // namespace

  void declare_rock_laws(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    prm.declare_entry("Largest closure", "0", Double(),
                      "Of 'Barton-Bandis': Vm, which the closure of the joint "
                      "comes near to under high pressure [m]");
    prm.declare_entry("Largest normal stiffness", "0", Double(),
                      "Of 'Barton-Bandis': where the slope of the closure has "
                      "come to this it stays so; the time step allows for it. "
                      "0: 25 times 'Normal stiffness' [Pa/m]");
    prm.declare_entry("Joint roughness", "0", Double(),
                      "Of 'Barton-Bandis': roughness coefficient JRC, 0 "
                      "(smooth) to 20, at most 30 [-]");
    prm.declare_entry("Joint wall strength", "0", Double(),
                      "Of 'Barton-Bandis': compressive strength JCS of the "
                      "rock beside the joint [Pa]");
    prm.declare_entry("Peak slip", "0", Double(),
                      "Of 'Barton-Bandis': slip at the peak of the shear "
                      "strength; 0: (L/500)(JRC/L)^0.33 with 'Joint length' "
                      "L in m [m]");
    prm.declare_entry("Joint length", "0", Double(),
                      "Of 'Barton-Bandis': length of the joint between "
                      "others that cross it [m]");
    prm.declare_entry("Laboratory length", "0", Double(),
                      "Of 'Barton-Bandis': length of the samples that JRC and "
                      "JCS are from, to be corrected for 'Joint length'; 0: "
                      "no correction [m]");
    prm.declare_entry("Roughness", "0", Double(),
                      "Of 'continuously yielding': R, the inelastic slip over "
                      "which the friction angle comes from 'Friction angle' "
                      "near 'Residual friction angle' [m]");
    prm.declare_entry("Normal exponent", "0", Double(),
                      "Of 'continuously yielding': power of the pressure with "
                      "which the normal stiffness grows, 0 to 1 [-]");
    prm.declare_entry("Shear exponent", "0", Double(),
                      "Of 'continuously yielding': the same of the shear "
                      "stiffness [-]");
    prm.declare_entry("Reference stress", "1e6", Double(),
                      "Of 'continuously yielding': pressure at which the "
                      "stiffnesses are 'Normal stiffness' and 'Shear "
                      "stiffness' [Pa]");
    prm.declare_entry("Lowest stress", "1e4", Double(),
                      "Of 'continuously yielding': pressure below which the "
                      "stiffnesses are constant [Pa]");
    prm.declare_entry("Highest stress", "1e8", Double(),
                      "Of 'continuously yielding': pressure above which they "
                      "are constant; the time step allows for this one [Pa]");
  }

  JointLaw read_rock_law(const ParameterSection &section)
  {
    refuse_bond(section);
    if (section.text("Law") == "Barton-Bandis")
      return read_barton_bandis(section);
    return read_continuously_yielding(section);
  }
} // namespace quoin
