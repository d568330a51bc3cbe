// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_reinforcement_cable_parameters_h
#define quoin_reinforcement_cable_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/reinforcement/bar_chain.h>

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** Ends of a bar: its head, where a face plate is, and its far end [m]. */
  using BarEnds = std::array<dealii::Point<2>, 2>;

  /** One bar or a pattern of equal ones: a subsection of 'Reinforcement'. */
  struct CableParameters
  {
    std::string name;
    std::vector<BarEnds> bars;
    std::string stage; /**< in which it is installed; empty: the first one */
    BarLaw law;        /**< of one bar */
    double pretension     = 0.; /**< [N] */
    double free_length    = 0.; /**< without bond, from the head on [m] */
    double element_length = 0.; /**< the longest [m] */
    double spacing        = 1.; /**< out of the plane [m] */

    static void declare(dealii::ParameterHandler &prm);
    static CableParameters read(const ParameterSection &section,
                                const std::string &name);
  };

  /** The ends of all bars of @p cables, one after the other. */
  std::vector<BarEnds> all_bars(const std::vector<CableParameters> &cables);
} // namespace quoin

#endif
