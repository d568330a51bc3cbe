// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Joint laws in SIMD lanes against the laws themselves, point by point.

#include "composite_walk.h"
#include "rock_walk.h"

#include <quoin/law_lanes/barton_bandis_lanes.h>
#include <quoin/law_lanes/composite_lanes.h>
#include <quoin/law_lanes/continuously_yielding_lanes.h>
#include <quoin/law_lanes/coulomb_lanes.h>
#include <quoin/law_lanes/slip_weakening_lanes.h>

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>

using namespace quoin;

namespace
{
  template <int lanes, int dim>
  using Pack = PointPack<lanes, dim>;

  /** Calls @p use with each array of numbers of @p pack and how many a point
      has. */
  template <int lanes, int dim, typename Use>
  void for_arrays(Pack<lanes, dim> &pack, const Use &use)
  {
    use(pack.normal_traction, 1);
    use(pack.shear_traction, dim - 1);
    use(pack.plastic_slip, dim - 1);
    use(pack.plastic_opening, 1);
    for (auto &variable : pack.internal)
      use(variable, 1);
  }

  /** The point in lane @p l in all lanes. */
  template <int lanes, int dim>
  Pack<lanes, dim> filled_with(Pack<lanes, dim> pack, const int l)
  {
    for_arrays(pack,
               [l](double *values, const int n)
               {
                 for (int i = 0; i < n * lanes; ++i)
                   if (i / n < l)
                     values[i] = values[n * l + i % n];
                 for (int i = n * (l + 1); i < n * lanes; ++i)
                   values[i] = values[n * l + i % n];
               });
    std::fill_n(pack.state, lanes, JointState(pack.state[l]));
    return pack;
  }

  /** What points have come to, and what that dissipated. */
  template <int lanes, int dim>
  struct Update
  {
    Pack<lanes, dim> pack;
    PointLanes<lanes, dim> points;
    DissipationLanes<lanes> lost;
    bool is_steady; /**< nothing but tractions changed */
  };

  template <int lanes, int dim, typename Law>
  Update<lanes, dim> update(const Law &law, const Pack<lanes, dim> &before,
                            const double (&opening)[lanes],
                            const Slip<dim> (&slip)[lanes], const double weight)
  {
    using F = LaneFunctions<lanes>;
    const LawLanes<Law, lanes, dim> laws(law);
    Update<lanes, dim> result;
    result.pack    = before;
    auto &points   = result.points;
    points.arrays  = result.pack.arrays();
    points.opening = F::load(opening);
    for (int l = 0; l < lanes; ++l)
      points.slip.set(l, slip[l]);
    const auto steady          = laws.try_elastic(points);
    result.is_steady           = F::all(steady);
    const typename F::Bits all = ~typename F::Bits{};
    if (result.is_steady)
      points.store_tractions();
    else
      laws.update(points, all, typename F::Value{} + weight, result.lost);
    return result;
  }

  /** A slip or a traction of random components. */
  template <int dim, typename Random>
  Slip<dim> random_slip(const double size, Random &&random)
  {
    if constexpr (dim == 2)
      return size * random();
    else
    {
      Slip<dim> slip;
      for (int c = 0; c < dim - 1; ++c)
        slip[c] = size * random();
      return slip;
    }
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
   * difference of the internal variables is held against. Points that follow
   * a law with @p rests stay where they are in some pieces.
   */
  template <int lanes, int dim, typename Law>
  Comparison compare(const Law &law, const double closed, const double reach,
                     const std::array<double, 4> &scales, const bool rests)
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
      Pack<lanes, dim> pack;
      PointArrays<dim> first = pack.arrays();
      for (int l = 0; l < lanes; ++l)
      {
        PointOf<Law, dim> point;
        if (!point.internal.empty() && walk % 4 == 3 && l % 2 == 0)
        {
          law.wear_out(point); // a new contact
          point.state = JointState::slipped;
        }
        write_point(point, first, l);
      }
      double opening[lanes]{}, opening_from[lanes]{}, opening_to[lanes]{};
      Slip<dim> slip[lanes]{}, slip_from[lanes]{}, slip_to[lanes]{};
      for (unsigned int piece = 0; piece < 30; ++piece)
      {
        std::copy_n(opening_to, lanes, opening_from);
        std::copy_n(slip_to, lanes, slip_from);
        // Pieces of very different sizes; some stay where they are.
        for (int l = 0; l < lanes; ++l)
        {
          const double size = reach * std::pow(10., uniform(random) - 1.);
          opening_to[l]     = -closed + size * uniform(random);
          if (!rests || (piece + l) % 7 != 0)
            slip_to[l]
                = random_slip<dim>(size, [&] { return uniform(random); });
        }
        for (unsigned int step = 1; step <= n_steps; ++step)
        {
          for (int l = 0; l < lanes; ++l)
          {
            const double t = double(step) / n_steps;
            opening[l]
                = opening_from[l] + t * (opening_to[l] - opening_from[l]);
            slip[l] = slip_from[l] + t * (slip_to[l] - slip_from[l]);
          }
          // A weaker law of the same kind comes in place of the one before.
          if constexpr (PointOf<Law, dim>::internal.size() == 4)
            if (step == 6 && piece % 5 == 4)
              for (int l = 0; l < lanes; l += 2)
                pack.internal[3][l] = 2.; // tan(phi_m) of that
          Pack<lanes, dim> before = pack;
          const auto now
              = update<lanes, dim>(law, before, opening, slip, weight);
          pack = now.pack;
          worst.n_steady += now.is_steady;
          PointArrays<dim> old = before.arrays(), after = pack.arrays();
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
                   magnitude(there.shear_traction - point.shear_traction),
                   now.points.sigma[l] - point.normal_traction,
                   magnitude(now.points.tau.at(l) - point.shear_traction) })
              worst.tractions = std::max(worst.tractions, std::abs(d) / stress);
            worst.others = std::max(
                { worst.others,
                  magnitude(there.plastic_slip - point.plastic_slip) / reach,
                  std::abs(there.plastic_opening - point.plastic_opening)
                      / reach });
            constexpr auto &internal = PointOf<Law, dim>::internal;
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
          double same_opening[lanes];
          Slip<dim> same_slip[lanes];
          std::fill_n(same_opening, lanes, double(opening[l]));
          std::fill_n(same_slip, lanes, Slip<dim>(slip[l]));
          auto alone = update<lanes, dim>(law, filled_with(before, l),
                                          same_opening, same_slip, weight)
                           .pack;
          auto expected = filled_with(pack, l);
          std::vector<double> values[2];
          for (auto &[of, to] :
               { std::tie(alone, values[0]), std::tie(expected, values[1]) })
            for_arrays(of, [&to = to](const double *all, const int n)
                       { to.insert(to.end(), all, all + n); });
          worst.n_neighbours
              += values[0] != values[1] || alone.state[0] != pack.state[l];
        }
      }
    }
    return worst;
  }

  template <int lanes, int dim, typename Law>
  Comparison
  expect_same(const Law &law, const double closed, const double reach,
              const std::array<double, 4> &scales = { 1., 1., 1., 1. },
              const bool rests = true, const double tolerance = 1e-14)
  {
    const Comparison worst
        = compare<lanes, dim>(law, closed, reach, scales, rests);
    EXPECT_LT(worst.tractions, 1e-14);
    EXPECT_LT(worst.others, tolerance);
    EXPECT_LT(worst.lost, tolerance);
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

  template <int lanes, int dim>
  void check_coulomb()
  {
    const Comparison visited = expect_same<lanes, dim>(brittle(), 2e-4, 1e-3);
    for (const JointState state : { JointState::intact, JointState::slipping,
                                    JointState::slipped, JointState::open })
      EXPECT_GT(visited.visits.at(state), 500U) << static_cast<int>(state);
    EXPECT_GT(visited.fracture, 0.);
    EXPECT_GT(visited.friction, 0.);
    EXPECT_GT(visited.n_steady, 50U);

    CoulombLaw never;
    never.normal_stiffness   = 8e9;
    never.shear_stiffness    = 3e9;
    const Comparison elastic = expect_same<lanes, dim>(never, 0., 1e-3);
    EXPECT_EQ(elastic.visits.size(), 1U);

    CoulombLaw loose = never;
    loose.peak = loose.residual = { 0., 0.6, 0. };
    expect_same<lanes, dim>(loose, 2e-4, 1e-3);
  }

  template <int lanes, int dim>
  void check_composite(const CompositeLaw &law, const bool closes)
  {
    const double kp = law.cap.peak_crushing;
    // Tension and slip, then pressure up to the cap as well
    const Comparison light
        = expect_same<lanes, dim>(law, 5e-6, 3e-5, { 1., kp, 3e-5, 1. });
    const Comparison heavy
        = expect_same<lanes, dim>(law, 9e-5, 2e-4, { 1., kp, 2e-4, 1. });
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
  check_coulomb<4, 2>();
  check_coulomb<4, 3>();
  check_coulomb<8, 2>();
  check_coulomb<8, 3>();
}

TEST(LawLanes, Composite)
{
  check_composite<4, 2>(composite_test::wall(), false);
  check_composite<4, 3>(composite_test::wall(), false);
  check_composite<8, 2>(composite_test::wall(), false);
  check_composite<8, 3>(composite_test::wall(), false);
  CompositeLaw closing      = composite_test::wall();
  closing.residual_friction = 0.5;
  closing.cracks_close      = true;
  check_composite<4, 2>(closing, true);
  check_composite<4, 3>(closing, true);
  check_composite<8, 2>(closing, true);
  check_composite<8, 3>(closing, true);
  check_composite<4, 2>(composite_test::dilatant(), false);
  check_composite<4, 3>(composite_test::dilatant(), false);
}

namespace
{
  SlipWeakeningLaw fault()
  {
    SlipWeakeningLaw law;
    law.normal_stiffness  = 8e9;
    law.shear_stiffness   = 3e9;
    law.cohesion          = 0.2e6;
    law.friction          = 0.7;
    law.residual_friction = 0.4;
    law.weakening_slip    = 1e-3;
    return law;
  }

  void expect_all_states(const Comparison &visited)
  {
    for (const JointState state : { JointState::intact, JointState::slipping,
                                    JointState::slipped, JointState::open })
      EXPECT_GT(visited.visits.at(state), 500U) << static_cast<int>(state);
    EXPECT_GT(visited.friction, 0.);
  }

  template <int lanes, int dim>
  void check_slip_weakening()
  {
    const Comparison visited = expect_same<lanes, dim>(fault(), 2e-4, 1e-3);
    expect_all_states(visited);
    EXPECT_GT(visited.fracture, 0.);
    EXPECT_GT(visited.n_steady, 50U);
    // It drops by itself.
    SlipWeakeningLaw brittle_fault = fault();
    brittle_fault.weakening_slip   = 2e-5;
    expect_same<lanes, dim>(brittle_fault, 2e-4, 1e-3);
  }

  template <int lanes, int dim>
  void check_barton_bandis()
  {
    using rock_test::rough;
    // Slip up and down the asperities, then beyond them and beyond the end of
    // the hyperbola at 0.24 mm
    const Comparison light
        = expect_same<lanes, dim>(rough(), 1e-4, 4e-4, { 4e-4, 4e-4, 1., 1. });
    expect_all_states(light);
    EXPECT_GT(light.n_steady, 50U);
    BartonBandisLaw worn = rough();
    worn.peak_slip       = 2e-5;
    const std::array<double, 4> scales{ 3e-4, 3e-4, 1., 1. };
    expect_same<lanes, dim>(worn, 2e-4, 3e-4, scales);
    expect_same<lanes, dim>(worn.reduced(3.), 1e-4, 3e-4, scales);
    BartonBandisLaw smooth = rough();
    smooth.roughness       = 0.;
    expect_same<lanes, dim>(smooth, 1e-4, 3e-4, scales);
  }

  template <int lanes, int dim>
  void check_continuously_yielding()
  {
    const std::array<double, 4> scales{ 4e-4, 4e-4, 1., 1. };
    // Where the pressure has gone, and the traction not yet, it comes down by
    // the rounding of the slip.
    constexpr bool rests = false;
    // Where the pressure has fallen the traction stands above the strength, by
    // up to some hundred times, and comes down by exp(-growth/strength), which
    // takes the rounding of the traction that many times: the law itself
    // differs as much for tractions that differ in their last bit.
    constexpr double tolerance = 1e-12;
    const auto check
        = [&](const ContinuouslyYieldingLaw &law, const double closed)
    {
      return expect_same<lanes, dim>(law, closed, 4e-4, scales, rests,
                                     tolerance);
    };
    for (ContinuouslyYieldingLaw law :
         { rock_test::yielding(), rock_test::yielding(0.) })
    {
      expect_all_states(check(law, 1e-4));
      law.roughness = 2e-5;
      check(law, 3e-4);
    }
    if (dim == 3) // slip in space closes as in the plane
      return;
    // The closure of other exponents, and one that reaches its end
    for (const double exponent : { 0., 0.7, 1. })
    {
      const PowerStiffness normal{ 20e9, exponent, 1e6, 1e4, 3e6 };
      ContinuouslyYieldingLaw law = rock_test::yielding();
      law.closure                 = PowerClosure(normal);
      expect_all_states(check(law, 1e-4));
    }
  }
} // namespace

TEST(LawLanes, SlipWeakening)
{
  check_slip_weakening<4, 2>();
  check_slip_weakening<4, 3>();
  check_slip_weakening<8, 2>();
  check_slip_weakening<8, 3>();
}

TEST(LawLanes, BartonBandis)
{
  check_barton_bandis<4, 2>();
  check_barton_bandis<4, 3>();
  check_barton_bandis<8, 2>();
  check_barton_bandis<8, 3>();
}

TEST(LawLanes, ContinuouslyYielding)
{
  check_continuously_yielding<4, 2>();
  check_continuously_yielding<4, 3>();
  check_continuously_yielding<8, 2>();
  check_continuously_yielding<8, 3>();
}

namespace
{
  /** Points that are closed, sheared and held, but for the rounding of their
      slip, do not begin to load anew. */
  template <int lanes, int dim>
  void check_held()
  {
    const auto law = rock_test::yielding();
    const double V = law.closure.closure(2e6);
    Pack<lanes, dim> pack;
    PointArrays<dim> first = pack.arrays();
    for (int l = 0; l < lanes; ++l)
      write_point(PointOf<ContinuouslyYieldingLaw, dim>(), first, l);
    double opening[lanes];
    Slip<dim> slip[lanes]{};
    std::fill_n(opening, lanes, -V);
    const auto go_to = [&](const double size)
    {
      for (int l = 0; l < lanes; ++l)
        if constexpr (dim == 2)
          slip[l] = size;
        else
        {
          slip[l][0] = 0.6 * size;
          slip[l][1] = -0.8 * size;
        }
      const Pack<lanes, dim> before = pack;
      pack = update<lanes, dim>(law, before, opening, slip, 1.).pack;
    };
    for (unsigned int i = 1; i <= 100; ++i)
      go_to(2e-6 * i);
    for (unsigned int i = 0; i < 100; ++i)
      go_to(2e-4 + (i % 3 - 1.) * 1e-15);
    PointArrays<dim> arrays = pack.arrays();
    for (int l = 0; l < lanes; ++l)
      EXPECT_EQ(read_point(law, arrays, l).reload, 0.);
    go_to(1.9e-4);
    for (int l = 0; l < lanes; ++l)
      EXPECT_GT(read_point(law, arrays, l).reload, 0.1);
  }
} // namespace

TEST(LawLanes, YieldingJointsThatAreHeld)
{
  check_held<4, 2>();
  check_held<4, 3>();
  check_held<8, 2>();
  check_held<8, 3>();
}

namespace
{
  /** A law that is not specialised, without an elastic part. */
  struct NewLaw : SlipWeakeningLaw
  {
    template <int dim>
    bool update_elastic(SlipWeakeningPoint<dim> &, double,
                        const Slip<dim> &) const
    {
      return false;
    }
    template <int dim>
    JointDissipation update_failing(SlipWeakeningPoint<dim> &point,
                                    const double opening,
                                    const Slip<dim> &slip) const
    {
      return SlipWeakeningLaw::update(point, opening, slip);
    }
  };
} // namespace

TEST(LawLanes, LawWithoutItsOwn)
{
  const NewLaw law{ fault() };
  expect_same<4, 2>(law, 2e-4, 1e-3);
  expect_same<4, 3>(law, 2e-4, 1e-3);
  expect_same<8, 2>(law, 2e-4, 1e-3);
  expect_same<8, 3>(law, 2e-4, 1e-3);
}

namespace
{
  /** The tractions of lanes without a point, whose forces are these times an
      area of zero, are finite. */
  template <int lanes, int dim, typename Law>
  void expect_finite_beside(const Law &law)
  {
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;
    const LawLanes<Law, lanes, dim> laws(law);
    // Beside points that stick, that slip and that are open
    for (const auto &[opening, slip] :
         { std::pair(0., 0.), std::pair(-1e-4, 1e-2), std::pair(1e-4, 0.) })
    {
      Pack<lanes, dim> pack;
      PointLanes<lanes, dim> points;
      std::memset(static_cast<void *>(&points), 0xff,
                  sizeof(points)); // not a number
      points.arrays               = pack.arrays();
      points.first                = 0;
      points.opening              = Value{};
      points.opening[0]           = opening;
      points.slip                 = {};
      points.slip.component[0][0] = slip;
      DissipationLanes<lanes> lost;
      laws.try_elastic(points);
      laws.update(points, F::mask_of(1), Value{} + 1., lost);
      for (int l = 0; l < lanes; ++l)
      {
        EXPECT_TRUE(std::isfinite(points.sigma[l])) << l;
        EXPECT_TRUE(std::isfinite(magnitude(points.tau.at(l)))) << l;
        EXPECT_TRUE(std::isfinite(lost.friction[l])) << l;
      }
    }
  }
} // namespace

TEST(LawLanes, LanesWithoutPoint)
{
  const auto check = [](const auto &law)
  {
    expect_finite_beside<4, 2>(law);
    expect_finite_beside<4, 3>(law);
    expect_finite_beside<8, 2>(law);
    expect_finite_beside<8, 3>(law);
  };
  check(brittle());
  check(composite_test::wall());
  check(rock_test::rough());
  check(rock_test::yielding());
  check(fault());
  check(NewLaw{ fault() });
}

template <int lanes, int n>
void
check_interleaving()
{
  using F     = LaneFunctions<lanes>;
  using Value = typename F::Value;
  Value from[n], to[n], back[n];
  for (int i = 0; i < n; ++i)
    for (int l = 0; l < lanes; ++l)
      from[i][l] = n * l + i;
  F::interleave(from, to);
  F::take_apart(to, back);
  for (int i = 0; i < n; ++i)
    for (int l = 0; l < lanes; ++l)
    {
      EXPECT_EQ(to[i][l], i * lanes + l);
      EXPECT_EQ(back[i][l], from[i][l]);
    }
}

TEST(LawLanes, Interleaving)
{
  check_interleaving<4, 2>();
  check_interleaving<8, 2>();
  check_interleaving<4, 3>();
  check_interleaving<8, 3>();
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

TEST(LawLanes, SineAndCosine)
{
  using F = LaneFunctions<8>;
  for (double from = 1e-9; from < 1e7; from *= 3.7)
  {
    const double at[8] = { 0.,         from,        -from,      1.1 * from,
                           1.3 * from, -1.7 * from, 2.1 * from, 3. * from };
    double sine[8], cosine[8];
    F::Value s, c;
    F::sine_cosine(F::load(at), s, c);
    F::store(sine, s);
    F::store(cosine, c);
    for (unsigned int i = 0; i < 8; ++i)
    {
      EXPECT_NEAR(sine[i], std::sin(at[i]),
                  3e-16 * std::min(1., std::abs(at[i])));
      EXPECT_NEAR(cosine[i], std::cos(at[i]), 3e-16);
    }
  }
}
