// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Joint laws in SIMD lanes against the laws themselves, point by point.

#include "composite_walk.h"
#include "rock_walk.h"

#include <quoin/joint_laws/composite_lanes.h>
#include <quoin/joint_laws/coulomb_lanes.h>
#include <quoin/joint_laws/slip_weakening_law.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

using namespace quoin;

namespace
{
  template <int lanes>
  using Pack = PointPack<lanes>;

  /** The point in lane @p l in all lanes. */
  template <int lanes>
  Pack<lanes> filled_with(const Pack<lanes> &pack, const int l)
  {
    Pack<lanes> result;
    for (unsigned int i = 0; i < 4 + PointArrays::most_internal; ++i)
      std::fill_n(result.values[i], lanes, pack.values[i][l]);
    std::fill_n(result.state, lanes, pack.state[l]);
    return result;
  }

  /** What points have come to, and what that dissipated. */
  template <int lanes>
  struct Update
  {
    Pack<lanes> pack;
    PointLanes<lanes> points;
    DissipationLanes<lanes> lost;
    bool is_steady; /**< nothing but tractions changed */
  };

  template <typename Law, int lanes>
  Update<lanes> update(const Law &law, const Pack<lanes> &before,
                       const double (&opening)[lanes],
                       const double (&slip)[lanes], const double weight)
  {
    using F = LaneFunctions<lanes>;
    const LawLanes<Law, lanes> laws(law);
    Update<lanes> result;
    result.pack                = before;
    auto &points               = result.points;
    points.arrays              = result.pack.arrays();
    points.opening             = F::load(opening);
    points.slip                = F::load(slip);
    const auto steady          = laws.try_elastic(points);
    result.is_steady           = F::all(steady);
    const typename F::Bits all = ~typename F::Bits{};
    if (result.is_steady)
      points.store_tractions();
    else
      laws.update(points, all, typename F::Value{} + weight, result.lost);
    return result;
  }

  /** Largest differences, and how often points came to each state. */
  struct Comparison
  {
    double tractions = 0.; /**< as a share of the largest stress */
    double others    = 0.; /**< plastic gaps by the reach, internal variables */
    double lost      = 0.; /**< as a share of stress times reach */
    unsigned int n_states = 0, n_neighbours = 0; /**< that differ */
    std::map<JointState, unsigned int> visits;
    unsigned int n_closing = 0, n_crushing = 0, n_steady = 0;
    double fracture = 0., friction = 0.;
  };

  double difference(const double a, const double b)
  {
    return a == b ? 0. : std::abs(a - b);
  }

  /**
   * Random walks of packs of points, each with its own path of straight pieces
   * within @p reach [m] of closing by @p closed [m]. The law updates what the
   * lanes have come to before, so that errors do not add up; @p scales: what a
   * difference of the internal variables is held against.
   */
  template <typename Law, int lanes>
  Comparison compare(const Law &law, const double closed, const double reach,
                     const std::array<double, 4> &scales)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    constexpr unsigned int n_steps = 12;
    const auto stiffness           = law.largest_stiffness();
    const double stress = reach * std::max(stiffness[0], stiffness[1]);
    const double weight = 0.7;
    Comparison worst;
    for (unsigned int walk = 0; walk < 60; ++walk)
    {
      Pack<lanes> pack;
      PointArrays first = pack.arrays();
      for (int l = 0; l < lanes; ++l)
        write_point(PointOf<Law>(), first, l);
      double opening[lanes]{}, slip[lanes]{}, from[2][lanes], to[2][lanes]{};
      for (unsigned int piece = 0; piece < 30; ++piece)
      {
        std::copy_n(to[0], lanes, from[0]);
        std::copy_n(to[1], lanes, from[1]);
        // Pieces of very different sizes; some stay where they are.
        for (int l = 0; l < lanes; ++l)
        {
          const double size = reach * std::pow(10., uniform(random) - 1.);
          to[0][l]          = -closed + size * uniform(random);
          to[1][l] = (piece + l) % 7 == 0 ? to[1][l] : size * uniform(random);
        }
        for (unsigned int step = 1; step <= n_steps; ++step)
        {
          for (int l = 0; l < lanes; ++l)
          {
            const double t = double(step) / n_steps;
            opening[l]     = from[0][l] + t * (to[0][l] - from[0][l]);
            slip[l]        = from[1][l] + t * (to[1][l] - from[1][l]);
          }
          Pack<lanes> before      = pack;
          const Update<lanes> now = update(law, before, opening, slip, weight);
          pack                    = now.pack;
          worst.n_steady += now.is_steady;
          PointArrays old = before.arrays(), after = pack.arrays();
          for (int l = 0; l < lanes; ++l)
          {
            const auto start = read_point(law, old, l);
            auto point       = start;
            JointDissipation lost;
            if (!law.update_elastic(point, opening[l], slip[l]))
              lost = law.update_failing(point, opening[l], slip[l]);
            const auto there = read_point(law, after, l);
            for (const double d :
                 { there.normal_traction - point.normal_traction,
                   there.shear_traction - point.shear_traction,
                   now.points.sigma[l] - point.normal_traction,
                   now.points.tau[l] - point.shear_traction })
              worst.tractions = std::max(worst.tractions, std::abs(d) / stress);
            worst.others = std::max(
                { worst.others,
                  std::abs(there.plastic_slip - point.plastic_slip) / reach,
                  std::abs(there.plastic_opening - point.plastic_opening)
                      / reach });
            constexpr auto &internal = PointOf<Law>::internal;
            for (unsigned int i = 0; i < internal.size(); ++i)
              worst.others
                  = std::max(worst.others,
                             difference(there.*internal[i], point.*internal[i])
                                 / scales[i]);
            for (const double d :
                 { now.lost.friction[l] - weight * lost.friction,
                   now.lost.fracture[l] - weight * lost.fracture,
                   now.lost.crushing[l] - weight * lost.crushing })
              worst.lost = std::max(worst.lost,
                                    std::abs(d) / (weight * stress * reach));
            worst.n_states += there.state != point.state;
            ++worst.visits[point.state];
            worst.fracture += lost.fracture;
            worst.friction += lost.friction;
            worst.n_crushing += lost.crushing != 0.;
            if constexpr (internal.size() == 3)
              worst.n_closing += point.*internal[2] < start.*internal[2];
          }

          // The neighbours of a point do not matter.
          const int l = step % lanes;
          double same_opening[lanes], same_slip[lanes];
          std::fill_n(same_opening, lanes, opening[l]);
          std::fill_n(same_slip, lanes, slip[l]);
          const Update<lanes> alone = update(law, filled_with(before, l),
                                             same_opening, same_slip, weight);
          for (unsigned int i = 0; i < 4 + PointArrays::most_internal; ++i)
            worst.n_neighbours += alone.pack.values[i][0] != pack.values[i][l];
          worst.n_neighbours += alone.pack.state[0] != pack.state[l];
        }
      }
    }
    return worst;
  }

  template <typename Law, int lanes>
  Comparison
  expect_same(const Law &law, const double closed, const double reach,
              const std::array<double, 4> &scales = { 1., 1., 1., 1. })
  {
    const Comparison worst = compare<Law, lanes>(law, closed, reach, scales);
    EXPECT_LT(worst.tractions, 1e-14);
    EXPECT_LT(worst.others, 1e-14);
    EXPECT_LT(worst.lost, 1e-14);
    EXPECT_EQ(worst.n_states, 0U);
    EXPECT_EQ(worst.n_neighbours, 0U);
    return worst;
  }

  CoulombLaw brittle()
  {
    CoulombLaw law;
    law.normal_stiffness            = 8e9;
    law.shear_stiffness             = 3e9;
    law.peak                        = { 1e6, 0.75, 0.4e6 };
    law.residual                    = { 0.1e6, 0.6, 0.05e6 };
    law.dilation                    = 0.3;
    law.critical_shear_displacement = 5e-4;
    return law;
  }

  template <int lanes>
  void check_coulomb()
  {
    const Comparison visited
        = expect_same<CoulombLaw, lanes>(brittle(), 2e-4, 1e-3);
    for (const JointState state : { JointState::intact, JointState::slipping,
                                    JointState::slipped, JointState::open })
      EXPECT_GT(visited.visits.at(state), 500U) << static_cast<int>(state);
    EXPECT_GT(visited.fracture, 0.);
    EXPECT_GT(visited.friction, 0.);
    EXPECT_GT(visited.n_steady, 50U);

    CoulombLaw never;
    never.normal_stiffness   = 8e9;
    never.shear_stiffness    = 3e9;
    const Comparison elastic = expect_same<CoulombLaw, lanes>(never, 0., 1e-3);
    EXPECT_EQ(elastic.visits.size(), 1U);

    CoulombLaw loose = never;
    loose.peak = loose.residual = { 0., 0.6, 0. };
    expect_same<CoulombLaw, lanes>(loose, 2e-4, 1e-3);
  }

  template <int lanes>
  void check_composite(const CompositeLaw &law, const bool closes)
  {
    const double kp = law.cap.peak_crushing;
    // Tension and slip, then pressure up to the cap as well
    const Comparison light = expect_same<CompositeLaw, lanes>(
        law, 5e-6, 3e-5, { 1., kp, 3e-5, 1. });
    const Comparison heavy = expect_same<CompositeLaw, lanes>(
        law, 9e-5, 2e-4, { 1., kp, 2e-4, 1. });
    for (const Comparison &visited : { light, heavy })
    {
      for (const JointState state : { JointState::intact, JointState::slipping,
                                      JointState::slipped, JointState::open })
        EXPECT_GT(visited.visits.at(state), 100U) << static_cast<int>(state);
      EXPECT_GT(visited.fracture, 0.);
      EXPECT_GT(visited.friction, 0.);
      EXPECT_EQ(visited.n_closing > 100, closes);
    }
    EXPECT_GT(heavy.n_crushing, 100U);
  }
} // namespace

TEST(LawLanes, Coulomb)
{
  check_coulomb<4>();
  check_coulomb<8>();
}

TEST(LawLanes, Composite)
{
  check_composite<4>(composite_test::wall(), false);
  check_composite<8>(composite_test::wall(), false);
  CompositeLaw closing      = composite_test::wall();
  closing.residual_friction = 0.5;
  closing.cracks_close      = true;
  check_composite<4>(closing, true);
  check_composite<8>(closing, true);
  check_composite<4>(composite_test::dilatant(), false);
}

TEST(LawLanes, LawsThatHaveNone)
{
  SlipWeakeningLaw fault;
  fault.normal_stiffness  = 8e9;
  fault.shear_stiffness   = 3e9;
  fault.cohesion          = 0.2e6;
  fault.friction          = 0.7;
  fault.residual_friction = 0.4;
  fault.weakening_slip    = 1e-3;
  expect_same<SlipWeakeningLaw, 4>(fault, 2e-4, 1e-3);
  expect_same<BartonBandisLaw, 8>(rock_test::rough(), 1e-4, 1e-4);
}

TEST(LawLanes, ExponentialAndLogarithm)
{
  const double at[8] = { -700., -30., -1., -1e-9, 0., 1e-3, 0.5, 3. };
  using F            = LaneFunctions<8>;
  double values[8];
  F::store(values, F::exponential(F::load(at)));
  for (unsigned int i = 0; i < 8; ++i)
    EXPECT_NEAR(values[i], std::exp(at[i]), 5e-16 * std::exp(at[i]));
}
