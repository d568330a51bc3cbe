// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/dynamics/factor_search.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    constexpr double step = 1.25; // ratio of factors until there is a bracket
    constexpr double least_tolerance = 1e-6; // ratio to the highest factor
  }

  void SafetyParameters::enter(ParameterEntries &entries)
  {
    enum Reduced
    {
      all,
      joints,
      blocks
    } reduced
        = all;
    entries.positive("First factor", first,
                     "Factor by which strengths are divided first, for 'End = "
                     "factor of safety' [-]");
    entries.positive("Lowest factor", lowest,
                     "Lowest factor of the search for the factor of safety "
                     "[-]");
    entries.positive("Highest factor", highest,
                     "Highest factor of the search for the factor of safety "
                     "[-]");
    entries.positive("Factor tolerance", tolerance,
                     "Distance between a stable factor and one that fails at "
                     "which the search for the factor of safety ends; at least "
                     "a millionth of 'Highest factor' [-]");
    entries.nonnegative("Failure displacement", failure_displacement,
                        "A trial of a factor is unstable when the largest "
                        "displacement since its start exceeds this and has "
                        "grown by half or more since half of the time; 0: a "
                        "thousandth of the model's diagonal [m]");
    entries.choice("Reduced strength", reduced,
                   { { "joints and blocks", all },
                     { "joints", joints },
                     { "blocks", blocks } },
                   "Whose cohesion, tensile strength and tangent of the "
                   "friction angle are divided by the factor, for 'End = "
                   "factor of safety'.");
    reduces_blocks                  = reduced != joints;
    reduces_joints                  = reduced != blocks;
    const ParameterSection *section = entries.read_section();
    if (!section)
      return;
    if (!(lowest <= first && first <= highest))
      section->fail("First factor", "must be between 'Lowest factor' and "
                                    "'Highest factor'.");
    if (tolerance < least_tolerance * highest)
      section->fail("Factor tolerance",
                    "is less than a millionth of 'Highest factor': the search "
                    "would not end. Give a larger one.");
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

  bool FactorSearch::has_ended(const SafetyParameters &parameters) const
  {
    return (stable > 0. && failing - stable <= parameters.tolerance)
           || stable >= parameters.highest || failing <= parameters.lowest;
  }

  std::string FactorSearch::table() const
  {
    std::ostringstream text;
    text.precision(12);
    text << "factor [-],stable,decided,steps,unbalanced ratio [-],largest "
            "displacement [m]\n";
    for (const SafetyTrial &trial : all_trials)
      text << trial.factor << "," << trial.is_stable << "," << trial.is_decided
           << "," << trial.n_steps << "," << trial.unbalanced_ratio << ","
           << trial.displacement << "\n";
    return text.str();
  }
} // namespace quoin
