// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/factor_search.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    constexpr double step = 1.25; // of factors, until there is a bracket
    constexpr double least_tolerance = 1e-6; // by the highest factor
  }

  void SafetyParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
    using dealii::Patterns::Selection;
    prm.declare_entry("First factor", "1", Double(),
                      "For 'End = factor of safety', as the next five: what "
                      "strengths are divided by first [-]");
    prm.declare_entry("Lowest factor", "0.1", Double(),
                      "The search goes no lower [-]");
    prm.declare_entry("Highest factor", "10", Double(),
                      "The search goes no higher [-]");
    prm.declare_entry("Factor tolerance", "0.01", Double(),
                      "The search ends when a stable factor and one that fails "
                      "are no farther apart; at least a millionth of "
                      "'Highest factor' [-]");
    prm.declare_entry("Failure displacement", "0", Double(),
                      "A factor fails when the largest displacement since its "
                      "start is beyond this and has grown by half or more "
                      "since half of the time; 0: a thousandth of the model's "
                      "diagonal [m]");
    prm.declare_entry("Reduced strength", "joints and blocks",
                      Selection("joints and blocks|joints|blocks"),
                      "Whose cohesion, tensile strength and tangent of the "
                      "friction angle are divided by the factor.");
  }

  SafetyParameters SafetyParameters::read(const ParameterSection &section)
  {
    SafetyParameters safety;
    safety.first   = section.positive("First factor");
    safety.lowest  = section.positive("Lowest factor");
    safety.highest = section.positive("Highest factor");
    if (!(safety.lowest <= safety.first && safety.first <= safety.highest))
      section.fail("First factor", "must be between 'Lowest factor' and "
                                   "'Highest factor'.");
    safety.tolerance = section.positive("Factor tolerance");
    if (safety.tolerance < least_tolerance * safety.highest)
      section.fail("Factor tolerance",
                   "is less than a millionth of 'Highest factor': the search "
                   "would not end. Give a larger one.");
    safety.failure_displacement = section.nonnegative("Failure displacement");
    const std::string reduced   = section.text("Reduced strength");
    safety.reduces_blocks       = reduced != "joints";
    safety.reduces_joints       = reduced != "blocks";
    return safety;
  }

  double FactorSearch::next(const SafetyParameters &parameters) const
  {
    if (all_trials.empty())
      return parameters.first;
    if (stable == 0.)
      return std::max(parameters.lowest, failing / step);
    if (std::isinf(failing))
      return std::min(parameters.highest, stable * step);
    return 0.5 * (stable + failing);
  }

  void FactorSearch::add(const SafetyTrial &trial)
  {
    all_trials.push_back(trial);
    if (trial.is_stable)
      stable = std::max(stable, trial.factor);
    else
      failing = std::min(failing, trial.factor);
  }

  bool FactorSearch::is_over(const SafetyParameters &parameters) const
  {
    return (stable > 0. && failing - stable <= parameters.tolerance)
           || stable >= parameters.highest || failing <= parameters.lowest;
  }
} // namespace quoin
