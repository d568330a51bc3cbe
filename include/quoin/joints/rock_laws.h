// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_rock_laws_h
#define quoin_joints_rock_laws_h

#include <quoin/base/parameter_section.h>
#include <quoin/joints/barton_bandis_law.h>
#include <quoin/joints/continuously_yielding_law.h>

#include <variant>

namespace quoin
{
  /** A law of rock joints. */
  using RockLaw = std::variant<BartonBandisLaw, ContinuouslyYieldingLaw>;

  /**
   * Declares what rock joints ask for beyond the entries of
   * JointSetParameters::declare(), which must be there too.
   */
  void declare_rock_laws(dealii::ParameterHandler &prm);

  /** The law that 'Law' names. Refuses what makes no sense by an InputError. */
  RockLaw read_rock_law(const ParameterSection &section);

  /** The law with its shear strength divided by @p factor. */
  BartonBandisLaw reduced(const BartonBandisLaw &law, double factor);
  ContinuouslyYieldingLaw reduced(const ContinuouslyYieldingLaw &law,
                                  double factor);
} // namespace quoin

#endif
