// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_joint_parameters_h
#define quoin_joint_laws_joint_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/joints/joint_damping.h>
#include <quoin/joint_laws/joint_law.h>

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
    /** Whether pairs that no other set names belong here. */
    bool all_new_contacts = false;
    JointLaw law;
    JointDamping damping;

    static void declare(dealii::ParameterHandler &prm);
    static JointSetParameters read(const ParameterSection &section,
                                   const std::string &name);
  };
} // namespace quoin

#endif
