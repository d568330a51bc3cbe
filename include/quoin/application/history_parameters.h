// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_application_history_parameters_h
#define quoin_application_history_parameters_h

#include <quoin/base/parameter_section.h>

#include <array>
#include <string>

namespace quoin
{
  enum class HistoryQuantity
  {
    displacement,
    velocity,
    stress,
    rotation,
    joint,
    reaction,
    platen_displacement,
    platen_force,
    unbalanced_ratio,
    kinetic_share,
    contacts
  };

  /** One column of histories.csv: a subsection of 'Histories'. */
  struct HistoryParameters
  {
    std::string name;
    HistoryQuantity quantity = HistoryQuantity::displacement;
    unsigned int component   = 0;
    std::string unit;
    std::array<double, 2> point{}; /**< [m] */
    std::string load;
    std::string curve;

    static void declare(dealii::ParameterHandler &prm);
    static HistoryParameters read(const ParameterSection &section,
                                  const std::string &name);
  };
} // namespace quoin

#endif
