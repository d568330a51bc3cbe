// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/materials/material_parameters.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    MohrCoulombStrength read_strength(const ParameterSection &section)
    {
      using constants::degree;
      MohrCoulombStrength strength;
      const double phi        = section.within("Friction angle", 0., 80.);
      strength.friction_angle = phi * degree;
      strength.dilation_angle
          = section.within("Dilation angle", 0., phi) * degree;
      strength.cohesion = section.nonnegative("Cohesion");
      if (section.text("Tensile strength") != "none")
        strength.tension = section.numbers<1>("Tensile strength").front();
      if (!(strength.tension >= 0.))
        section.fail("Tensile strength",
                     "must not be negative; 'none' leaves the limit "
                     "c / tan(phi) alone.");
      if (strength.cohesion == 0. && phi == 0.)
        section.fail("Cohesion", "must be positive if 'Friction angle' is 0: "
                                 "the material would have no strength.");
      return strength;
    }
  } // namespace

  using dealii::Patterns::Anything;
  using dealii::Patterns::Double;
  using dealii::Patterns::Selection;

  void MaterialParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Groups", "", Anything(),
                      "Physical surfaces of the mesh that are made of this "
                      "material; empty: the one that bears its name; "
                      "'none': no block, only what is beyond.");
    prm.declare_entry("Law", "linear elastic",
                      Selection("linear elastic|Mohr-Coulomb|rigid"),
                      "linear elastic; Mohr-Coulomb: elastic up to a shear "
                      "and a tensile strength, then perfectly plastic; rigid: "
                      "needs only the density.");
    prm.declare_entry("Density", "0", Double(), "rho [kg/m^3]");
    prm.declare_entry("Young's modulus", "0", Double(),
                      "E [Pa]; not read if 'Law = rigid'");
    prm.declare_entry("Poisson's ratio", "0", Double(),
                      "nu [-]; not read if 'Law = rigid'");
    prm.declare_entry(
        "Cohesion", "0", Double(),
        "c [Pa]; read if 'Law = Mohr-Coulomb', as the next three");
    prm.declare_entry("Friction angle", "0", Double(), "phi [deg]");
    prm.declare_entry("Dilation angle", "0", Double(),
                      "psi [deg], not above the friction angle");
    prm.declare_entry("Tensile strength", "none", Anything(),
                      "sigma_t [Pa], or 'none'; at most c / tan(phi) counts");
  }

  MaterialParameters MaterialParameters::read(const ParameterSection &section,
                                              const std::string &name)
  {
    MaterialParameters material;
    material.name   = name;
    material.groups = section.list("Groups");
    if (material.groups.empty())
      material.groups = { name };
    if (material.groups == std::vector<std::string>{ "none" })
      material.groups.clear();
    material.elastic.density = section.positive("Density");
    material.rigid           = section.text("Law") == "rigid";
    if (material.rigid)
      return material;
    material.elastic.young   = section.positive("Young's modulus");
    material.elastic.poisson = section.within("Poisson's ratio", -0.99, 0.4999);
    if (section.text("Law") == "Mohr-Coulomb")
      material.strength = read_strength(section);
    return material;
  }

  MaterialParameters reduced(const MaterialParameters &material,
                             const double factor)
  {
    MaterialParameters weak = material;
    if (!weak.strength)
      return weak;
    MohrCoulombStrength &strength = *weak.strength;
    const double friction         = std::tan(strength.friction_angle);
    // The tip of the cone, c / tan(phi), would stay where it is.
    if (friction > 0.)
      strength.tension
          = std::min(strength.tension, strength.cohesion / friction);
    strength.tension /= factor;
    strength.cohesion /= factor;
    strength.friction_angle = std::atan(friction / factor);
    strength.dilation_angle
        = std::min(strength.dilation_angle, strength.friction_angle);
    return weak;
  }
} // namespace quoin
