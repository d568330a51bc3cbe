// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_material_parameters_h
#define quoin_materials_material_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/materials/mohr_coulomb.h>

#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  /** One material: a subsection of 'Materials'. */
  struct MaterialParameters
  {
    std::string name;
    std::vector<std::string> groups; /**< physical surfaces of the mesh */
    /** Whether blocks are rigid: only the density counts. */
    bool rigid       = false;
    double thickness = 0.; /**< 0: that of the model [m] */
    LinearElastic elastic{};
    /** Strength; none: linear elastic. */
    std::optional<MohrCoulombStrength> strength;

    static void declare(dealii::ParameterHandler &prm);
    static MaterialParameters read(const ParameterSection &section,
                                   const std::string &name);
  };

  /** Law, stiffness, density, wave speeds and strength, for --check. */
  std::string material_text(const MaterialParameters &material,
                            PlaneAssumption plane);

  /**
   * The material with its strength divided by @p factor, for factors of
   * safety: c, tan(phi) and the tensile strength; psi is not above the
   * reduced phi. An elastic material has none and stays.
   */
  MaterialParameters reduced(const MaterialParameters &material, double factor);
} // namespace quoin

#endif
