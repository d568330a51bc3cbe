// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/materials/material_parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    void enter_strength(ParameterEntries &entries,
                        MohrCoulombStrength &strength)
    {
      using constants::degree;
      entries.nonnegative("Cohesion", strength.cohesion,
                          "Cohesion c; read if 'Law = Mohr-Coulomb' [Pa]");
      entries.within("Friction angle", strength.friction_angle, 0., 80.,
                     "Friction angle phi, at most 80; read if 'Law = "
                     "Mohr-Coulomb' [deg]",
                     degree);
      const ParameterSection *section = entries.read_section();
      const double phi = section ? section->number("Friction angle") : 0.;
      entries.within("Dilation angle", strength.dilation_angle, 0., phi,
                     "Dilation angle psi, not above the friction angle; read "
                     "if 'Law = Mohr-Coulomb' [deg]",
                     degree);
      entries.number_or(
          "none", std::numeric_limits<double>::infinity(), "Tensile strength",
          strength.tension,
          "Tensile strength sigma_t, or 'none'; c / tan(phi) is used if it is "
          "less; read if 'Law = Mohr-Coulomb' [Pa]");
      if (!section)
        return;
      if (!(strength.tension >= 0.))
        section->fail("Tensile strength",
                      "must not be negative; 'none' leaves the limit "
                      "c / tan(phi) alone.");
      if (strength.cohesion == 0. && phi == 0.)
        section->fail("Cohesion", "must be positive if 'Friction angle' is 0: "
                                  "the material would have no strength.");
    }

    void enter(ParameterEntries &entries, MaterialParameters &material)
    {
      enum Law
      {
        elastic,
        mohr_coulomb,
        rigid
      } law
          = elastic;
      entries.list(
          "Groups", material.groups,
          "Physical surfaces of the mesh that are made of this material; "
          "empty: the surface that bears the material's name; 'none': no "
          "block, only the medium beyond the blocks.");
      entries.choice(
          "Law", law,
          { { "linear elastic", elastic },
            { "Mohr-Coulomb", mohr_coulomb },
            { "rigid", rigid } },
          "Constitutive law. linear elastic; Mohr-Coulomb: linear elastic up "
          "to a shear and a tensile strength, then perfectly plastic; rigid: "
          "rigid blocks, which need only the density.");
      entries.positive("Density", material.elastic.density,
                       "Density rho [kg/m^3]");
      entries.other("Thickness", "",
                    "Out-of-plane thickness of blocks of this material; empty: "
                    "the 'Thickness' at the top of the file. Joints between "
                    "materials of different thickness have the smaller one [m]",
                    [&](const ParameterSection &section)
                    {
                      if (!section.text("Thickness").empty())
                        material.thickness = section.positive("Thickness");
                    });
      material.rigid = law == rigid;
      if (entries.reads_if(!material.rigid))
      {
        entries.positive("Young's modulus", material.elastic.young,
                         "Young's modulus E; not read if 'Law = rigid' [Pa]");
        entries.within("Poisson's ratio", material.elastic.poisson, -0.99,
                       0.4999,
                       "Poisson's ratio nu; not read if 'Law = rigid' [-]");
      }
      if (entries.reads_if(law == mohr_coulomb))
        enter_strength(entries, material.strength.emplace());
    }
  } // namespace

  void MaterialParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  MaterialParameters MaterialParameters::read(const ParameterSection &section,
                                              const std::string &name)
  {
    MaterialParameters material = read_entries(section, enter);
    material.name               = name;
    if (material.groups.empty())
      material.groups = { name };
    if (material.groups == std::vector<std::string>{ "none" })
      material.groups.clear();
    return material;
  }

  std::string material_text(const MaterialParameters &material,
                            const PlaneAssumption plane)
  {
    using constants::degree;
    const LinearElastic &elastic = material.elastic;
    const std::string thickness
        = material.thickness > 0.
              ? text_of(", thickness ", material.thickness, " m")
              : "";
    if (material.rigid)
      return text_of("rigid, density ", elastic.density, " kg/m^3", thickness);
    const WaveSpeeds speeds = wave_speeds(elastic, plane);
    const std::string text
        = text_of(material.strength ? "Mohr-Coulomb" : "elastic", ", E ",
                  elastic.young, " Pa, nu ", elastic.poisson, ", density ",
                  elastic.density, " kg/m^3, P waves ", speeds.p,
                  " m/s, S waves ", speeds.s, " m/s", thickness);
    if (!material.strength)
      return text;
    const MohrCoulombStrength &strength = *material.strength;
    return text_of(
        text, ", ", named_number("cohesion", strength.cohesion, "Pa"), ", ",
        named_number("friction angle", strength.friction_angle / degree,
                     "degrees"),
        ", ",
        named_number("dilation angle", strength.dilation_angle / degree,
                     "degrees"),
        ", ", named_number("tensile strength", strength.tension, "Pa"));
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
