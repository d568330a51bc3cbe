// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_parameters_h
#define quoin_joints_joint_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/joints/composite_law.h>
#include <quoin/joints/coulomb_law.h>
#include <quoin/joints/rock_laws.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /** A set of joints that share a law: one subsection of 'Joints'. */
  struct JointSetParameters
  {
    std::string name;
    std::vector<std::string> curves; /**< physical curves of the mesh */
    /** Pairs of materials whose new contacts follow this set. */
    std::vector<std::pair<std::string, std::string>> new_contacts;
    bool all_new_contacts = false; /**< of pairs that no other set names */
    /** Of a composite set its stiffnesses and strengths, of a rock joint its
        largest stiffnesses and residual strength. */
    CoulombLaw law;
    std::optional<CompositeLaw> composite;
    std::optional<RockLaw> rock;

    static void declare(dealii::ParameterHandler &prm);
    static JointSetParameters read(const ParameterSection &section,
                                   const std::string &name);
  };

  /**
   * The set with its strength divided by @p factor, for factors of safety:
   * cohesion, tensile strength and tan of the friction angle, peak and
   * residual; of Barton-Bandis the shear strength, of continuously yielding
   * the tangents of both angles. A dilation angle is not above the reduced
   * friction angle. Stiffnesses, fracture energies, the cap of the composite
   * law and slips stay.
   */
  JointSetParameters reduced(const JointSetParameters &set, double factor);
} // namespace quoin

#endif
