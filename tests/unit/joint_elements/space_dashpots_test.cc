// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "space_stack.h"

#include <gtest/gtest.h>

#include <limits>

using namespace quoin;
using namespace quoin::test;
using namespace quoin::test::space_stack;

namespace
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  /** Blocks of 200 and 300 kg. */
  constexpr double mass = 120.; // reduced
  constexpr double xi = 0.3, friction = 0.6;

  CoulombLaw no_tension()
  {
    CoulombLaw law = elastic();
    law.peak = law.residual = { 0., friction, 0. };
    law.is_no_tension       = true;
    return law;
  }

  /** The stack with dashpots; motions by the frame of its plane joint. */
  struct Damped : Stack
  {
    AlignedArray<dealii::Tensor<1, 3>> viscous;
    Vector n, s, t;
    double area = 0.;

    Damped(const JointLaw &law, const unsigned int nx,
           const JointState initial   = JointState::intact,
           const double lower_inverse = 1. / 200.,
           const double impedance     = infinity)
      : Stack(law, nx)
    {
      JointSetParameters set = set_of(law);
      set.damping            = { xi, xi };
      joints.set_laws({ set });
      DashpotBlocks data;
      data.communicator = MPI_COMM_SELF;
      data.inverse_mass = { lower_inverse, 1. / 300. };
      data.is_divided   = { false, false };
      data.impedance.assign(2, { { impedance, impedance } });
      joints.dashpots.set_blocks(data);
      for (JointState &point : history().state)
        point = initial;
      for (const SpaceJointFace &face : joints.faces())
        area += 3. * face.area;
      const SpaceJointFrame frame
          = joint_frame(joints.faces()[0], state.nodes.data());
      n = frame.n;
      s = frame.s;
      t = frame.t;
      state.velocity.assign(nodes.n_local(), dealii::Tensor<1, 3>());
    }

    void find_forces()
    {
      force.assign(nodes.n_local(), dealii::Tensor<1, 3>());
      viscous = force;
      joints.add_forces(StepContext{}, state, { force.data(), viscous.data() });
    }

    /** Moves the high block there, with a velocity; finds all forces. */
    void move(const Vector &u, const Vector &v)
    {
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        if (is_high(i))
          for (unsigned int d = 0; d < 3; ++d)
          {
            state.nodes[i].u[d]  = u[d];
            state.velocity[i][d] = v[d];
          }
      find_forces();
    }

    /** Force on the high block [N]. */
    Vector on_high(const AlignedArray<dealii::Tensor<1, 3>> &of) const
    {
      Vector sum;
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        if (is_high(i))
          sum += of[i];
      return sum;
    }
    Vector shear_of(const Vector &f) const
    {
      return f - (f * n) * n;
    }
  };

  double critical(const double k, const double area, const double m)
  {
    return 2. * xi * std::sqrt(k * area * m);
  }
} // namespace

// Together the dashpots are 2 xi sqrt(K m), whatever the mesh, and shear along
// the rate of slip, whatever its direction.
TEST(SpaceDashpots, AddUpToTheShareOfCriticalDampingOfTheTwoMasses)
{
  for (const unsigned int nx : { 1, 2, 5 })
  {
    Damped blocks(elastic(), nx);
    const Vector along = std::cos(0.7) * blocks.s + std::sin(0.7) * blocks.t;
    blocks.move(-1e-5 * blocks.n, 0.02 * blocks.n + 0.01 * along);
    const Vector wanted = -0.02 * critical(kn, blocks.area, mass) * blocks.n
                          - 0.01 * critical(ks, blocks.area, mass) * along;
    EXPECT_NEAR((blocks.on_high(blocks.viscous) - wanted).norm(), 0., 1e-3)
        << nx;
  }
}

TEST(SpaceDashpots, AHeldBlockIsInfinitelyHeavy)
{
  Damped blocks(elastic(), 2, JointState::intact, 0.);
  blocks.move(Vector(), 0.01 * blocks.n);
  EXPECT_NEAR(blocks.on_high(blocks.viscous) * blocks.n,
              -0.01 * critical(kn, blocks.area, 300.), 1e-3);
}

TEST(SpaceDashpots, AreNoStrongerThanTheImpedanceOfTheBlocks)
{
  Damped blocks(elastic(), 2, JointState::intact, 1. / 200., 5e5);
  blocks.move(Vector(), 0.01 * blocks.n);
  EXPECT_NEAR(blocks.on_high(blocks.viscous) * blocks.n,
              -5e5 * blocks.area * 0.01, 1e-6);
}

// Those of rock joints, which have more of springs that are pressed more, are c
// = T k with the k of now, also where springs ahead would be ten times as
// stiff.
TEST(SpaceDashpots, AreThoseOfTheStiffnessOfNow)
{
  const BartonBandisLaw law = rock_test::rough();
  for (const JointState state : { JointState::intact, JointState::slipped })
    for (const double closing : { 1e-4, 3. })
    {
      Damped blocks(law, 2, state);
      blocks.move(-2e-5 * blocks.n, Vector());
      const double pressure = law.closure.traction(2e-5);
      ASSERT_NEAR(blocks.on_high(blocks.force) * blocks.n / blocks.area,
                  pressure, 1e-6 * pressure);
      const auto [k_n, k_s] = law.stiffness_at(-pressure);
      const double time     = 2. * xi * std::sqrt(mass / (k_n * blocks.area));
      // of the fast one the closure is nearly exhausted T ahead
      const double ahead = law.closure.traction(2e-5 + time * closing);
      EXPECT_EQ(law.stiffness_at(-ahead)[0] > 10. * k_n, closing > 0.1);
      blocks.move(-2e-5 * blocks.n, -closing * blocks.n);
      const double wanted = closing * critical(k_n, blocks.area, mass);
      EXPECT_NEAR(blocks.on_high(blocks.viscous) * blocks.n, wanted,
                  1e-9 * wanted);
      // and not more along the joint, where friction may bound them
      const double slow = 1e-6;
      blocks.move(-2e-5 * blocks.n, -closing * blocks.n + slow * blocks.s);
      const double along = slow * critical(k_s, blocks.area, mass);
      EXPECT_LT(blocks.on_high(blocks.viscous) * blocks.s, 0.);
      EXPECT_GE(blocks.on_high(blocks.viscous) * blocks.s,
                -along * (1. + 1e-9));
    }
  // without pressure there are none
  Damped open(law, 1);
  open.move(1e-6 * open.n, -1. * open.n);
  EXPECT_EQ(open.on_high(open.viscous).norm(), 0.);
}

TEST(SpaceDashpots, DoNotPull)
{
  Damped blocks(no_tension(), 2, JointState::slipped);
  blocks.move(-1e-5 * blocks.n, blocks.n);
  EXPECT_LT(blocks.on_high(blocks.viscous) * blocks.n, -1e3);
  EXPECT_NEAR(
      (blocks.on_high(blocks.viscous) + blocks.on_high(blocks.force)).norm(),
      0., 1e-6);
  // open they rest, however fast they close
  blocks.move(1e-4 * blocks.n, -1. * blocks.n + 1. * blocks.s);
  EXPECT_EQ(blocks.on_high(blocks.viscous).norm(), 0.);
}

TEST(SpaceDashpots, RestWhereAJointIsGone)
{
  Damped blocks(elastic(), 1);
  for (std::uint8_t &gone : blocks.history().detached)
    gone = 1;
  blocks.move(-1e-5 * blocks.n, blocks.n);
  EXPECT_EQ(blocks.on_high(blocks.viscous).norm(), 0.);
}

TEST(SpaceDashpots, AJointThatNeverFailedBreaksByItsSpringsAlone)
{
  Damped blocks(no_tension(), 1);
  blocks.move(-1e-6 * blocks.n, 10. * blocks.n);
  const Vector pressure = blocks.on_high(blocks.force);
  EXPECT_GT(pressure * blocks.n, 0.);
  // together they do not pull, as where it has failed
  EXPECT_LT((blocks.on_high(blocks.viscous) + pressure).norm(),
            1e-9 * pressure.norm());
  for (const JointState state : blocks.history().state)
    EXPECT_EQ(state, JointState::intact);
}

TEST(SpaceDashpots, AJointThatNeverFailedIsPulledToItsStrength)
{
  CoulombLaw law    = no_tension();
  law.peak.tension  = 1e4;
  law.peak.cohesion = 5e4;
  Damped blocks(law, 1);
  blocks.move(-1e-6 * blocks.n, 10. * blocks.n);
  // pressed on the other block, pulled by the joint
  const Vector pulled
      = blocks.on_high(blocks.force) + blocks.on_high(blocks.viscous);
  EXPECT_NEAR(pulled * blocks.n, -law.peak.tension * blocks.area,
              1e-9 * law.peak.tension * blocks.area);
  // closing, with more slip than cohesion and friction bear
  blocks.move(-1e-6 * blocks.n, 10. * blocks.s - 0.01 * blocks.n);
  const Vector total
      = blocks.on_high(blocks.force) + blocks.on_high(blocks.viscous);
  EXPECT_GT(total * blocks.n, blocks.on_high(blocks.force) * blocks.n);
  EXPECT_NEAR(blocks.shear_of(total).norm(),
              law.peak.cohesion * blocks.area
                  + law.peak.friction * (total * blocks.n),
              1e-6 * blocks.shear_of(total).norm());
  for (const JointState state : blocks.history().state)
    EXPECT_EQ(state, JointState::intact);
}

TEST(SpaceDashpots, FrictionBoundsTheWholeShearByTheWholePressure)
{
  for (const double down : { -0.01, 0.002 })
  {
    Damped blocks(no_tension(), 2, JointState::slipped);
    const Vector along  = std::cos(0.7) * blocks.s + std::sin(0.7) * blocks.t;
    const Vector across = cross_product_3d(blocks.n, along);
    // sticking springs, but dashpots that would bear more than friction
    blocks.move(-1e-5 * blocks.n, Vector());
    blocks.move(-1e-5 * blocks.n + 1e-7 * across, 5. * along + down * blocks.n);
    Vector total
        = blocks.on_high(blocks.force) + blocks.on_high(blocks.viscous);
    EXPECT_NEAR(blocks.shear_of(total).norm(), friction * (total * blocks.n),
                1e-3);
    EXPECT_GT(-(total * along), 0.999 * blocks.shear_of(total).norm());
    // springs that slip: their friction follows the pressure
    blocks.move(-1e-5 * blocks.n + 5e-5 * along, 5. * along + down * blocks.n);
    total = blocks.on_high(blocks.force) + blocks.on_high(blocks.viscous);
    EXPECT_NEAR(blocks.shear_of(total).norm(), friction * (total * blocks.n),
                1e-3);
    EXPECT_GT(blocks.shear_of(blocks.on_high(blocks.viscous)).norm(), 1.);
  }
}

TEST(SpaceDashpots, TakeTheEnergyOfTheRatesAndNoMomentum)
{
  Damped blocks(elastic(), 2);
  blocks.shake(0.05);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (auto &node : blocks.state.velocity)
    for (double &v : dealii::make_array_view(node))
      v = uniform(random);
  blocks.find_forces();
  double power = 0., size = 0.;
  Vector sum, moment;
  for (unsigned int i = 0; i < blocks.nodes.n_local(); ++i)
  {
    const Vector f = blocks.viscous[i];
    power += f * blocks.state.velocity[i];
    size += f.norm();
    sum += f;
    moment += cross_product_3d(blocks.position(i), f);
  }
  EXPECT_NEAR(sum.norm(), 0., 1e-12 * size);
  EXPECT_NEAR(moment.norm(), 0., 1e-12 * size);

  // Rates by differences of gaps.
  constexpr double h = 1e-7;
  const auto gaps_at = [&](const double time)
  {
    std::vector<NodeRecord<3>> moved(blocks.state.nodes.begin(),
                                     blocks.state.nodes.end());
    for (unsigned int i = 0; i < moved.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        moved[i].u[d] += time * blocks.state.velocity[i][d];
    std::vector<SpaceJointGap> result;
    for (const SpaceJointFace &face : blocks.joints.faces())
      for (const SpaceJointGap &gap : joint_gaps(face, moved.data()))
        result.push_back(gap);
    return result;
  };
  const auto before = gaps_at(-h), after = gaps_at(h);
  double wanted = 0.;
  for (unsigned int p = 0; p < before.size(); ++p)
    for (unsigned int c = 0; c < 3; ++c)
      wanted -= critical(c == 0 ? kn : ks, blocks.area, mass)
                * blocks.joints.faces()[p / 3].area / blocks.area
                * std::pow((after[p][c] - before[p][c]) / (2. * h), 2);
  EXPECT_NEAR(power / wanted, 1., 1e-6);
}

// Of the formula of theory.md: c^2 of all nodes by the area of the joint, and c
// by the impedance.
TEST(SpaceDashpots, BoundsOfTheNodesAreThoseOfTheirAreas)
{
  Damped blocks(elastic(), 2);
  const auto bound_of = [&](const double impedance)
  {
    DampingBound bound;
    bound.dashpot.assign(blocks.nodes.n_deformable_nodes(), 0.);
    bound.share.assign(2, 0.);
    blocks.joints.add_damping_bound({ 200., 300. }, impedance, bound);
    EXPECT_EQ(bound.share, std::vector<double>({ xi, xi }));
    return bound.dashpot;
  };
  const auto free = bound_of(infinity), capped = bound_of(1e3);
  std::array<double, 2> squares{}, sums{};
  for (unsigned int i = 0; i < blocks.nodes.n_deformable_nodes(); ++i)
  {
    squares[blocks.is_high(i)] += free[i] * free[i];
    sums[blocks.is_high(i)] += capped[i];
  }
  for (const unsigned int high : { 0, 1 })
  {
    const double m = high ? 300. : 200.;
    EXPECT_NEAR(squares[high] / (16. * xi * xi * m * kn * blocks.area), 1.,
                1e-12);
    EXPECT_NEAR(sums[high] / (2. * 1e3 * blocks.area), 1., 1e-12);
  }
}
