// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/materials/material_parameters.h>

namespace quoin
{
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
                      Selection("linear elastic|rigid"),
                      "Whether blocks of this material deform; rigid blocks "
                      "need only the density.");
    prm.declare_entry("Density", "0", Double(), "rho [kg/m^3]");
    prm.declare_entry("Young's modulus", "0", Double(),
                      "E [Pa]; not read if 'Law = rigid'");
    prm.declare_entry("Poisson's ratio", "0", Double(),
                      "nu [-]; not read if 'Law = rigid'");
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
    return material;
  }
} // namespace quoin
