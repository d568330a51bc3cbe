// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/stages/factor_search.h>

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
                     "First trial factor of the search for the factor of "
                     "safety, by which strengths are divided [-]");
    entries.positive("Lowest factor", lowest,
                     "Lowest factor of the search for the factor of safety "
                     "[-]");
    entries.positive("Highest factor", highest,
                     "Highest factor of the search for the factor of safety "
                     "[-]");
    entries.positive("Factor tolerance", tolerance,
                     "Distance between a stable and an unstable factor at "
                     "which the search for the factor of safety ends, at least "
                     "a millionth of 'Highest factor' [-]");
    entries.nonnegative(
        "Failure displacement", failure_displacement,
        "Displacement that makes a trial of the search for the factor of "
        "safety unstable: the largest displacement since the start of the "
        "trial exceeds it and keeps growing, by a factor of 1.8 in each of the "
        "last two doublings of the time or by 3.24 in the last one; 0: ten "
        "times the mean elastic displacement under the loads, which is twice "
        "the stored energy of blocks and joints divided by the weights and "
        "tractions, or a thousandth of the model's diagonal without loads; at "
        "least twice the peak slip of joints of the law 'Barton-Bandis', and "
        "0.5 % "
        "of the diagonal if the trials are implicit and joints alone may fail, "
        "without bars, beams and materials that yield [m]");
    entries.choice(
        "Reduced strength", reduced,
        { { "joints and blocks", all },
          { "joints", joints },
          { "blocks", blocks } },
        "Joints and blocks, joints alone or blocks alone, whose cohesion, "
        "tensile strength and tangent of the friction angle are divided by the "
        "trial factors of the search for the factor of safety.");
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

  unsigned int SafetyParameters::least_trials() const
  {
    const double bracket = (step - 1.) * first;
    return 2
           + (unsigned int)(std::ceil(
               std::max(0., std::log2(bracket / tolerance))));
  }

  const char *verdict_text(const Verdict verdict)
  {
    switch (verdict)
    {
    case Verdict::stable:
      return "stable";
    case Verdict::failing:
      return "failing";
    default:
      return "undecided";
    }
  }

  std::optional<std::array<double, 2>> FactorSearch::undecided() const
  {
    std::optional<std::array<double, 2>> range;
    for (const SafetyTrial &trial : all_trials)
      if (trial.verdict == Verdict::undecided && trial.factor > stable
          && trial.factor < failing)
        range
            = range
                  ? std::array<double, 2>{ std::min((*range)[0], trial.factor),
                                           std::max((*range)[1], trial.factor) }
                  : std::array<double, 2>{ trial.factor, trial.factor };
    return range;
  }

  double FactorSearch::next(const SafetyParameters &parameters) const
  {
    if (all_trials.empty())
      return parameters.first;
    const auto open          = undecided();
    const double not_stable  = open ? (*open)[0] : failing;
    const double not_failing = open ? (*open)[1] : stable;
    if (stable == 0. && not_stable > parameters.lowest)
      return std::max(parameters.lowest, not_stable / step);
    if (std::isinf(failing) && not_failing < parameters.highest)
      return std::min(parameters.highest, not_failing * step);
    if (!open)
      return 0.5 * (stable + failing);
    const bool is_low
        = std::isinf(failing)
          || (stable > 0. && not_stable - stable > failing - not_failing);
    return is_low ? 0.5 * (stable + (*open)[0]) : 0.5 * ((*open)[1] + failing);
  }

  void FactorSearch::add(const SafetyTrial &trial)
  {
    all_trials.push_back(trial);
    if (trial.verdict == Verdict::stable)
      stable = std::max(stable, trial.factor);
    if (trial.verdict == Verdict::failing)
      failing = std::min(failing, trial.factor);
  }

  bool FactorSearch::has_ended(const SafetyParameters &parameters) const
  {
    if (all_trials.empty())
      return false;
    const auto open          = undecided();
    const double not_stable  = open ? (*open)[0] : failing;
    const double not_failing = open ? (*open)[1] : stable;
    if (stable == 0. && not_stable > parameters.lowest)
      return false;
    if (std::isinf(failing) && not_failing < parameters.highest)
      return false;
    // An end of the range that was not found needs no bracket.
    return (stable == 0. || (std::isinf(failing) && !open)
            || not_stable - stable <= parameters.tolerance)
           && (std::isinf(failing) || (stable == 0. && !open)
               || failing - not_failing <= parameters.tolerance);
  }

  std::uint64_t FactorSearch::n_steps() const
  {
    std::uint64_t n = 0;
    for (const SafetyTrial &trial : all_trials)
      n += trial.n_steps;
    return n;
  }

  std::uint64_t FactorSearch::slowest_rest() const
  {
    std::uint64_t slowest = 0;
    for (const SafetyTrial &trial : all_trials)
      slowest = std::max(slowest, trial.n_to_rest);
    return slowest;
  }

  bool FactorSearch::was_misled() const
  {
    return std::any_of(all_trials.begin(), all_trials.end(),
                       [](const SafetyTrial &trial) {
                         return trial.verdict == Verdict::stable
                                && trial.n_to_rest == 0;
                       });
  }

  std::string FactorSearch::table() const
  {
    std::ostringstream text;
    text.precision(12);
    text << "factor [-],stable,decided,steps,unbalanced ratio [-],largest "
            "displacement [m]\n";
    for (const SafetyTrial &trial : all_trials)
      text << trial.factor << "," << (trial.verdict == Verdict::stable) << ","
           << (trial.verdict != Verdict::undecided) << "," << trial.n_steps
           << "," << trial.unbalanced_ratio << "," << trial.displacement
           << "\n";
    return text.str();
  }

  bool FailureWatch::has_failed(const double time, const double displacement)
  {
    times.push_back(time);
    displacements.push_back(displacement);
    const double passed = time - start;
    if (displacement <= limit || passed <= 0. || times[0] - start > passed / 4.)
      return false;
    const double half = displacement_at(passed / 2.);
    if (displacement < growth * half)
      return false;
    moved_on = true;
    // What accelerates only now has grown in one doubling as much as in two.
    return displacement >= growth * growth * half
           || half >= growth * displacement_at(passed / 4.);
  }

  bool FailureWatch::creeps(const double left) const
  {
    const std::size_t n = times.size();
    if (n < 2)
      return false;
    const double interval = times[n - 1] - times[n - 2];
    const double passed = times.back() - start, now = displacements.back();
    const bool is_known = passed >= least_known * interval;
    const double last   = is_known ? passed / 2. : interval;
    const double moved  = now - displacement_at(passed - last);
    // Beyond the limit, and by as much as has_failed() asks for.
    const double further = std::max(limit - now, (growth - 1.) * now);
    if (moved <= 0. || moved / last * left <= further)
      return false;
    if (!is_known)
      return true;
    const double before = displacement_at(passed - last) - displacement_at(0.);
    return moved >= (growth - 1.) * before;
  }

  double FailureWatch::displacement_at(const double time) const
  {
    const auto after
        = std::lower_bound(times.begin(), times.end(), start + time);
    const std::size_t i = std::max<std::ptrdiff_t>(1, after - times.begin());
    const double share
        = (start + time - times[i - 1]) / (times[i] - times[i - 1]);
    return displacements[i - 1]
           + share * (displacements[i] - displacements[i - 1]);
  }

  bool JumpWatch::has_failed(const bool jumps, const double pseudo_time,
                             const double displacement)
  {
    if (!jumps)
    {
      jump.reset();
      before = displacement;
      return false;
    }
    if (!jump)
      jump.emplace(limit, 0.);
    const double moved = displacement - before;
    const bool failed  = jump->has_failed(pseudo_time, moved);
    moved_on           = moved_on || jump->has_moved_on();
    return failed || moved > far_beyond * limit;
  }
} // namespace quoin
