// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/stages/factor_search.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace quoin;

namespace
{
  /** Searches in a model that is stable below @p limit and fails from
      @p first_failing on. */
  FactorSearch searched(const SafetyParameters &parameters, const double limit,
                        const double first_failing = 0.)
  {
    FactorSearch search;
    while (!search.has_ended(parameters) && search.trials().size() < 1000)
    {
      SafetyTrial trial;
      trial.factor  = search.next(parameters);
      trial.verdict = trial.factor < limit           ? Verdict::stable
                      : trial.factor < first_failing ? Verdict::undecided
                                                     : Verdict::failing;
      search.add(trial);
    }
    return search;
  }
} // namespace

TEST(FactorSearch, BracketsTheLimit)
{
  for (const double limit : { 0.11, 0.5, 0.99, 1.01, 3., 9.9 })
  {
    const FactorSearch search = searched({}, limit);
    EXPECT_LT(search.highest_stable(), limit);
    EXPECT_GE(search.lowest_failing(), limit);
    EXPECT_LE(search.lowest_failing() - search.highest_stable(), 0.01);
    EXPECT_LT(search.trials().size(), 25U);
  }
}

TEST(FactorSearch, TakesAsManyTrialsAsEstimated)
{
  for (const double tolerance : { 0.5, 0.1, 0.01 })
  {
    SafetyParameters parameters;
    parameters.tolerance = tolerance;
    EXPECT_EQ(searched(parameters, 1.1).trials().size(),
              parameters.least_trials());
    EXPECT_GE(searched(parameters, 2.1).trials().size(),
              parameters.least_trials());
  }
}

TEST(FactorSearch, EndsAtTheLowestAndHighestFactors)
{
  EXPECT_EQ(searched({}, 0.05).lowest_failing(), 0.1);
  EXPECT_EQ(searched({}, 0.05).highest_stable(), 0.);
  EXPECT_EQ(searched({}, 11.).highest_stable(), 10.);
}

TEST(FactorSearch, NoStableFactorIsNoneOfTheBracket)
{
  SafetyParameters parameters;
  parameters.tolerance      = 1.;
  const FactorSearch search = searched(parameters, 0.5);
  EXPECT_GT(search.highest_stable(), 0.);
  EXPECT_GE(search.trials().size(), 4U);
}

TEST(FactorSearch, FindsBothEndsOfWhatIsUndecided)
{
  for (const double first : { 1.2, 3.1, 20. })
  {
    const FactorSearch search = searched({}, 1.1, first);
    ASSERT_TRUE(search.undecided());
    const auto [low, high] = *search.undecided();
    EXPECT_LT(search.highest_stable(), 1.1);
    EXPECT_LE(low - search.highest_stable(), 0.01);
    if (first > 10.)
      EXPECT_EQ(high, 10.);
    else
      EXPECT_LE(search.lowest_failing() - high, 0.01);
    EXPECT_LT(search.trials().size(), 30U);
  }
  const FactorSearch nothing = searched({}, 0., 20.);
  EXPECT_EQ(nothing.highest_stable(), 0.);
  EXPECT_TRUE(std::isinf(nothing.lowest_failing()));
}

TEST(FactorSearch, UndecidedFactorsBelowAStableOneAreForgotten)
{
  FactorSearch search;
  search.add({ 1., Verdict::undecided, 10 });
  search.add({ 1.25, Verdict::stable, 20 });
  EXPECT_FALSE(search.undecided());
  EXPECT_EQ(search.n_steps(), 30U);
}

TEST(FactorSearch, KnowsWhetherItsDampingMisled)
{
  FactorSearch search;
  EXPECT_EQ(search.slowest_rest(), 0U);
  search.add({ 1., Verdict::stable, 10, 0., 0., 10 });
  search.add({ 1.25, Verdict::failing, 90 });
  search.add({ 1.125, Verdict::stable, 30, 0., 0., 30 });
  EXPECT_EQ(search.slowest_rest(), 30U);
  EXPECT_FALSE(search.was_misled());
  search.add({ 1.1875, Verdict::stable, 400 }); // by local damping
  EXPECT_EQ(search.slowest_rest(), 30U);
  EXPECT_TRUE(search.was_misled());
}

TEST(FailureWatch, WhatSlowsDownHasNotFailed)
{
  // 5 (1 - exp(-t/3)) is above the limit from t = 6.9 on, where it was 3.4 at
  // half the time.
  FailureWatch settles(4.5, 0.);
  for (unsigned int i = 1; i <= 100; ++i)
    EXPECT_FALSE(settles.has_failed(i, 5. * (1. - std::exp(-1. / 3. * i))));
  EXPECT_FALSE(settles.has_moved_on());
}

TEST(FailureWatch, WhatIsCaughtFarAwayHasMovedOn)
{
  // It falls from 1 m at t = 10 to 2.5 m at t = 13 and lies still: 2.5 times as
  // far as at half the time, where that of a quarter was no less.
  for (const double limit : { 1.5, 3. })
  {
    FailureWatch caught(limit, 0.);
    for (double t = 0.1; t <= 40.; t += 0.1)
      EXPECT_FALSE(
          caught.has_failed(t, 1. + 0.5 * std::clamp(t - 10., 0., 3.)));
    EXPECT_EQ(caught.has_moved_on(), limit < 2.5);
  }
}

TEST(FailureWatch, WhatGoesOnMovingHasFailed)
{
  // Times may be far apart; those before the start do not count.
  for (const double step : { 0.01, 0.1, 1. })
  {
    FailureWatch slides(1., 2.), settles(1., 2.);
    bool has_failed = false;
    for (double t = 2.1; t <= 40.; t += step * (1. + t))
    {
      has_failed = has_failed || slides.has_failed(t, 0.1 * (t - 2.));
      EXPECT_FALSE(settles.has_failed(t, 5. - 1. / t));
      EXPECT_FALSE(t <= 12. && has_failed) << "within the limit";
    }
    EXPECT_TRUE(has_failed);
  }
}

TEST(FailureWatch, WhatCollapsesLateHasFailed)
{
  // It hardly moves for long, then accelerates, and comes to rest as a heap.
  FailureWatch watch(1., 0.);
  bool has_failed = false;
  for (double t = 0.1; t <= 100.; t += 0.1)
  {
    const double fall = std::clamp(t - 30., 0., 5.);
    has_failed = watch.has_failed(t, 0.3 + 0.2 * fall * fall) || has_failed;
    EXPECT_FALSE(t < 31.5 && has_failed);
  }
  EXPECT_TRUE(has_failed);
}

TEST(FailureWatch, WhatCreepsIsNotAtRest)
{
  // It settles by 0.1 m until t = 2, creeps by a millimetre a second from there
  // on, or approaches an end, of which it knows after eight displacements.
  FailureWatch creeps(1., 2.), approaches(1., 2.);
  for (unsigned int i = 1; i <= 60; ++i)
  {
    const double t = 0.1 * i, since = std::max(0., t - 2.);
    const double settled = 0.1 * std::min(1., t / 2.);
    EXPECT_FALSE(creeps.has_failed(t, settled + 1e-3 * since));
    EXPECT_FALSE(approaches.has_failed(
        t, settled + 0.01 * (1. - std::exp(-since / 0.5))));
    if (since < 0.15)
      continue;
    EXPECT_TRUE(creeps.creeps(1e4)) << t;
    EXPECT_FALSE(creeps.creeps(100.)) << t << ": within the limit in the end";
    const bool is_clear = since < 0.75 || since > 0.85;
    EXPECT_TRUE(!is_clear || approaches.creeps(1e4) == (since < 0.8)) << t;
  }
}

TEST(FailureWatch, WhatRestsBeyondTheLimitDoesNotCreep)
{
  // It came to 2 m while it was reduced, where 1 m is the limit, and rests
  // there, springs back by a twentieth, or drifts by a picometre a second.
  for (const double rate : { 0., 1e-12 })
    for (const double back : { 0., 0.1 })
    {
      FailureWatch watch(1., 2.);
      for (unsigned int i = 1; i <= 60; ++i)
      {
        const double t = 0.1 * i, since = std::max(0., t - 2.);
        EXPECT_FALSE(watch.has_failed(t, 2. - back * std::min(1., 5. * since)
                                             + rate * since));
        EXPECT_FALSE(since > 0.1 && watch.creeps(1e4)) << t;
      }
    }
}

TEST(JumpWatch, RemembersEveryJump)
{
  // The motion of FailureWatch.WhatIsCaughtFarAwayHasMovedOn in the first or
  // the second of two jumps, from 4 m; the other one settles within 1 m.
  for (const unsigned int far : { 0, 1 })
  {
    JumpWatch watch(1.5);
    double before = 4.;
    for (unsigned int jump = 0; jump < 2; ++jump)
    {
      EXPECT_FALSE(watch.has_failed(false, 0., before));
      double moved = 0.;
      for (double t = 0.1; t <= 40.; t += 0.1)
      {
        moved = jump == far ? 1. + 0.5 * std::clamp(t - 10., 0., 3.)
                            : 1. - std::exp(-t);
        EXPECT_FALSE(watch.has_failed(true, t, before + moved));
      }
      EXPECT_EQ(watch.has_moved_on(), jump >= far);
      before += moved;
    }
    EXPECT_FALSE(watch.has_failed(false, 0., before));
    EXPECT_TRUE(watch.has_moved_on());
  }
}

TEST(JumpWatch, CountsFromTheStartOfAJump)
{
  // What slides on fails, however far equilibria had moved before, and those do
  // not count.
  JumpWatch watch(1.);
  for (unsigned int i = 0; i <= 100; ++i)
    EXPECT_FALSE(watch.has_failed(false, 0., 0.1 * i));
  double failed_at = 0.;
  for (double t = 0.01; t < 20. && failed_at == 0.; t += 0.01)
    if (watch.has_failed(true, t, 10. + 0.2 * t))
      failed_at = t;
  EXPECT_NEAR(failed_at, 5., 0.02);
}

TEST(JumpWatch, WhatFlowsEverMoreSlowlyFailsBeyondThreeLimits)
{
  // As ground flows against drag, by 1.62 times in each doubling of the time.
  JumpWatch watch(1.);
  double failed_at = 0.;
  for (double t = 0.01; t < 20. && failed_at == 0.; t += 0.01)
    if (watch.has_failed(true, t, std::pow(t, 0.7)))
      failed_at = t;
  EXPECT_NEAR(std::pow(failed_at, 0.7), 3., 0.01);
}
