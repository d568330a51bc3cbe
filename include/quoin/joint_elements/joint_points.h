// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_joint_points_h
#define quoin_joint_elements_joint_points_h

#include <quoin/joint_laws/joint_law.h>
#include <quoin/joints/point_arrays.h>
#include <quoin/operators/energy_accounts.h>

namespace quoin
{
  inline void book(const JointDissipation &lost, const double weight,
                   EnergyAccounts &energy)
  {
    energy.friction += weight * lost.friction;
    energy.fracture += weight * lost.fracture;
    energy.crushing += weight * lost.crushing;
  }
} // namespace quoin

#endif
