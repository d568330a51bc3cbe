// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_composite_parameters_h
#define quoin_joints_composite_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/joints/composite_law.h>

namespace quoin
{
  /**
   * Declares what CompositeLaw asks for beyond the entries of
   * JointSetParameters::declare(), which must be there too.
   */
  void declare_composite_law(dealii::ParameterHandler &prm);

  /**
   * The law of a set of joints. Refuses, by an InputError, what CompositeLaw
   * asks its user not to give it.
   */
  CompositeLaw read_composite_law(const ParameterSection &section);

  /** What to say of a law that drops by itself; empty: it softens gently. */
  std::string snap_back_warning(const CompositeLaw &law);
} // namespace quoin

#endif
