// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_tangent_h
#define quoin_joints_joint_tangent_h

namespace quoin
{
  /** Derivative of a joint's tractions by opening and slip [Pa/m]. */
  struct JointTangent
  {
    double normal_opening = 0.;
    double normal_slip    = 0.;
    double shear_opening  = 0.;
    double shear_slip     = 0.;
  };
} // namespace quoin

#endif
