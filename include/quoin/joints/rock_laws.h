// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_rock_laws_h
#define quoin_joints_rock_laws_h

#include <quoin/base/parameter_section.h>
#include <quoin/joints/joint_law.h>

namespace quoin
{
  /**
   * Declares what rock joints ask for beyond the entries of
   * JointSetParameters::declare(), which must be there too.
   */
  void declare_rock_laws(dealii::ParameterHandler &prm);

  /** The law that 'Law' names. Refuses what makes no sense by an InputError. */
  JointLaw read_rock_law(const ParameterSection &section);
} // namespace quoin

#endif
