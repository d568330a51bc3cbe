// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_contacts.h"

#include <limits>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double infinity = std::numeric_limits<double>::infinity();

  /** Blocks of 200 and 300 kg that press on each other with kn = 8e9. */
  constexpr double mass = 120.; // reduced
  constexpr double gap  = 0.01; // of separate blocks in the mesh [m]

  DashpotBlocks inertia(const double impedance = infinity)
  {
    DashpotBlocks blocks;
    blocks.communicator = MPI_COMM_WORLD;
    blocks.inverse_mass = { 1. / 200., 1. / 300. };
    blocks.is_divided   = { false, false };
    blocks.impedance.assign(3, { { impedance, impedance } });
    return blocks;
  }

  /** A block of 1 m x 1 m on another, edges cut into some, with dashpots. */
  struct Pressed
  {
    TestNodes nodes;
    MatchedJoints joints;
    std::unique_ptr<BlockContacts> contacts;
    State<2> state;
    AlignedArray<dealii::Tensor<1, 2>> force, viscous;
    const bool meets;

    /** @p may_meet: as contacts of separate blocks, else as joint. */
    Pressed(const bool may_meet, const unsigned int n, const double xi,
            const DashpotBlocks &blocks = inertia())
      : nodes(mesh(may_meet, n)), meets(may_meet)
    {
      JointSetParameters set = touching(0.5);
      set.damping            = { xi, xi };
      if (!may_meet)
        set.curves = { "joint" };
      joints.prepare(nodes, { set }, thickness);
      joints.prepare(state);
      contacts = std::make_unique<BlockContacts>(nodes, joints,
                                                 contact_model({ set }));
      contacts->prepare(state);
      joints.dashpots.set_blocks(blocks);
      contacts->set_blocks(blocks);
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
        state.nodes.push_back(
            { { nodes->point(v)[0], nodes->point(v)[1] }, {} });
      state.velocity.assign(nodes->n_local(), dealii::Tensor<1, 2>());
      for (JointState &point : state.get<JointHistory>().state)
        point = JointState::slipped;
    }

    static BlockMesh<2> mesh(const bool may_meet, const unsigned int n)
    {
      BlockMesh<2> result
          = may_meet ? make_blocks(
                { { 0., 0., 1., 1., n, n }, { 0., 1. + gap, 1., 1., n, n } })
                     : make_stack(n, n);
      for (auto &p : result.vertices)
        if (!may_meet)
          p = { p[0] / n, p[1] / n };
      return result;
    }

    bool is_upper(const unsigned int v) const
    {
      return nodes->block_of_node(v) == nodes->block_of_node(upper_corner());
    }
    unsigned int upper_corner() const
    {
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
        if (nodes->point(v)[1] > 1.9)
          return v;
      return 0;
    }

    /** Moves the upper block there, with a velocity; finds all forces. */
    void move(const double x, const double y, const double vx, const double vy)
    {
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
        if (is_upper(v))
        {
          state.nodes[v].u[0]  = x;
          state.nodes[v].u[1]  = meets ? y - gap : y;
          state.velocity[v][0] = vx;
          state.velocity[v][1] = vy;
        }
      force.assign(nodes->n_local(), dealii::Tensor<1, 2>());
      viscous = force;
      StepContext step{};
      step.dt                              = 1e-9;
      state.get<ContactState>().next_check = state.step;
      contacts->update(step, state);
      joints.add_forces(step, state, { force.data(), viscous.data() });
      contacts->add_forces(step, state, { force.data(), viscous.data() });
      ++state.step;
    }

    /** Force on the upper block [N]. */
    std::array<double, 2>
    on_upper(const AlignedArray<dealii::Tensor<1, 2>> &of) const
    {
      std::array<double, 2> sum{}, lower{};
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
        for (unsigned int d = 0; d < 2; ++d)
          (is_upper(v) ? sum : lower)[d] += of[v][d];
      EXPECT_NEAR(sum[0] + lower[0], 0., 1e-6 * (1. + std::abs(sum[0])));
      EXPECT_NEAR(sum[1] + lower[1], 0., 1e-6 * (1. + std::abs(sum[1])));
      return sum;
    }
  };

  /** Restitution of a mass on spring and dashpot that do not pull, by Heun's
      method. */
  double restitution(const double xi)
  {
    const double h = 1e-5;
    double u = 0., v = -1.;
    const auto push
        = [&](const double u, const double v) { return -u - 2. * xi * v; };
    while (push(u, v) >= 0.)
    {
      const double a = push(u, v), v1 = v + h * a, u1 = u + h * v;
      u += 0.5 * h * (v + v1);
      v += 0.5 * h * (a + push(u1, v1));
    }
    return v;
  }
} // namespace

TEST(Dashpots, RestitutionIsThatOfTheIntegratedOscillator)
{
  for (const double xi : { 1e-3, 0.1, 0.5, 0.95, 1., 1.05, 2. })
    EXPECT_NEAR(restitution_of_damping(xi), restitution(xi), 1e-4) << xi;
  EXPECT_NEAR(restitution_of_damping(1.), std::exp(-2.), 1e-12);
}

TEST(Dashpots, DampingIsTheInverseOfRestitution)
{
  EXPECT_EQ(damping_of_restitution(1.), 0.);
  for (const double e : { 0.05, 0.135, std::exp(-2.), 0.2, 0.5, 0.9, 0.999 })
    EXPECT_NEAR(restitution_of_damping(damping_of_restitution(e)), e, 1e-9);
}

// Together the dashpots are 2 xi sqrt(K m), whatever the mesh.
TEST(Dashpots, AddUpToTheShareOfCriticalDampingOfTheTwoMasses)
{
  for (const bool may_meet : { false, true })
    for (const unsigned int n : { 1, 2, 5 })
    {
      Pressed blocks(may_meet, n, 0.3);
      blocks.move(0., -1e-5, 0., -0.01);
      EXPECT_NEAR(blocks.on_upper(blocks.viscous)[1],
                  2. * 0.3 * std::sqrt(kn * thickness * mass) * 0.01, 1e-3)
          << may_meet << n;
      EXPECT_NEAR(blocks.on_upper(blocks.viscous)[0], 0., 1e-6);
    }
}

// As histories of the force between two blocks add them up.
TEST(Dashpots, ForcesOfEachAddUpToThoseOfAll)
{
  for (const bool may_meet : { false, true })
  {
    Pressed blocks(may_meet, 3, 0.3);
    blocks.move(0., -1e-5, 0.004, -0.01);
    std::array<double, 2> sum{};
    AlignedArray<dealii::Tensor<1, 2>> force(blocks.nodes->n_local());
    for (unsigned int i = 0; i < blocks.joints.segments().size(); ++i)
      blocks.joints.add_dashpot_forces(i, blocks.state, force.data());
    for (const double f : blocks.on_upper(force))
      EXPECT_TRUE(!may_meet || f == 0.);
    const BlockContacts &contacts = *blocks.contacts;
    EXPECT_NE(contacts.dashpots().all().empty(), may_meet);
    for (const ContactDashpot &at : contacts.dashpots().all())
    {
      const ContactEndForces ends
          = contacts.near_pairs().spread(at.pair, at.lower, at.upper, at.force);
      for (const unsigned int k : { 2, 3 })  // the upper edge is of the upper
        for (unsigned int c = 0; c < 2; ++c) // block
          sum[c] += ends.share * ends.force[k][c];
      EXPECT_NEAR(
          (ends.force[0] + ends.force[1] + ends.force[2] + ends.force[3])
              .norm(),
          0., 1e-9);
      EXPECT_LT(at.pair, blocks.state.get<ContactState>().pairs.size());
    }
    for (unsigned int c = 0; c < 2; ++c)
    {
      sum[c] += blocks.on_upper(force)[c];
      EXPECT_NEAR(sum[c], blocks.on_upper(blocks.viscous)[c],
                  1e-9 * std::abs(sum[c]));
      EXPECT_GT(std::abs(sum[c]), 100.);
    }
  }
}

TEST(Dashpots, AddUpToTheSameWhereBlocksOverlapInPart)
{
  Pressed blocks(true, 3, 0.3);
  blocks.move(0.4, -1e-5, 0., -0.01);
  EXPECT_NEAR(blocks.on_upper(blocks.viscous)[1],
              2. * 0.3 * std::sqrt(0.6 * kn * thickness * mass) * 0.01, 1e-3);
}

TEST(Dashpots, AHeldBlockIsInfinitelyHeavy)
{
  DashpotBlocks held   = inertia();
  held.inverse_mass[0] = 0.;
  Pressed blocks(true, 2, 0.3, held);
  blocks.move(0., -1e-5, 0., -0.01);
  EXPECT_NEAR(blocks.on_upper(blocks.viscous)[1],
              2. * 0.3 * std::sqrt(kn * thickness * 300.) * 0.01, 1e-3);
}

TEST(Dashpots, BetweenHeldBlocksTheirOwnMassesCount)
{
  DashpotBlocks held    = inertia();
  held.own_inverse_mass = held.inverse_mass;
  held.inverse_mass     = { 0., 0. };
  Pressed blocks(true, 2, 0.3, held);
  blocks.move(0., -1e-5, 0., -0.01);
  EXPECT_NEAR(blocks.on_upper(blocks.viscous)[1],
              2. * 0.3 * std::sqrt(kn * thickness * mass) * 0.01, 1e-3);
}

TEST(Dashpots, AreNoStrongerThanTheImpedanceOfTheBlocks)
{
  Pressed blocks(true, 2, 0.3, inertia(5e5));
  blocks.move(0., -1e-5, 0., -0.01);
  EXPECT_NEAR(blocks.on_upper(blocks.viscous)[1], 5e5 * thickness * 0.01, 1e-6);
}

TEST(Dashpots, DoNotPull)
{
  for (const bool may_meet : { false, true })
  {
    Pressed blocks(may_meet, 2, 0.3);
    blocks.move(0., -1e-5, 0., 1.);
    EXPECT_LT(blocks.on_upper(blocks.viscous)[1], -1e3);
    EXPECT_NEAR(blocks.on_upper(blocks.viscous)[1],
                -blocks.on_upper(blocks.force)[1], 1e-6);
    // apart they rest, however fast they close
    blocks.move(0., 1e-4, 0., -1.);
    EXPECT_EQ(blocks.on_upper(blocks.viscous)[1], 0.);
  }
}

TEST(Dashpots, RestWhereAJointHasGone)
{
  // Its edges lie against each other, in opposite directions: the joint has no
  // direction any more.
  Pressed blocks(false, 2, 0.3);
  for (std::uint8_t &gone : blocks.state.get<JointHistory>().handed_over)
    gone = 1;
  for (unsigned int v = 0; v < blocks.nodes->n_local(); ++v)
    if (blocks.is_upper(v))
    {
      const auto p = blocks.nodes->point(v);
      blocks.state.nodes[v].u
          = dealii::Point<2>(1. - 2. * p[0], 2. - 2. * p[1]);
      blocks.state.velocity[v] = dealii::Point<2>(0.1, -1.);
    }
  blocks.force.assign(blocks.nodes->n_local(), dealii::Tensor<1, 2>());
  blocks.viscous = blocks.force;
  StepContext step{};
  step.stiffness_damping = 1e-5;
  blocks.joints.add_forces(step, blocks.state,
                           { blocks.force.data(), blocks.viscous.data() });
  for (unsigned int v = 0; v < blocks.nodes->n_local(); ++v)
    EXPECT_EQ(blocks.force[v].norm() + blocks.viscous[v].norm(), 0.);
}

TEST(Dashpots, FrictionBoundsTheWholeShearByTheWholePressure)
{
  for (const bool may_meet : { false, true })
    for (const double down : { -0.01, 0.002 })
    {
      // sticking springs, but dashpots that would bear more than friction
      Pressed blocks(may_meet, 2, 0.3);
      blocks.move(0., -1e-5, 0., 0.);
      blocks.move(1e-7, -1e-5, 5., down);
      auto sum = blocks.on_upper(blocks.force);
      auto own = blocks.on_upper(blocks.viscous);
      EXPECT_NEAR(-(sum[0] + own[0]), 0.5 * (sum[1] + own[1]), 1e-3);
      // springs that slip: their friction follows the pressure
      blocks.move(5e-5, -1e-5, 5., down);
      sum = blocks.on_upper(blocks.force);
      own = blocks.on_upper(blocks.viscous);
      EXPECT_NEAR(-sum[0], 0.5 * sum[1], 1e-3);
      EXPECT_NEAR(-(sum[0] + own[0]), 0.5 * (sum[1] + own[1]), 1e-3);
      EXPECT_GT(std::abs(own[0]), 1.);
    }
}

TEST(Dashpots, ThatStickAreThoseOfTheShearSprings)
{
  Pressed blocks(true, 2, 0.3);
  blocks.move(0., -1e-4, 0., 0.);
  blocks.move(0., -1e-4, 1e-3, 0.);
  EXPECT_NEAR(blocks.on_upper(blocks.viscous)[0],
              -2. * 0.3 * std::sqrt(ks * thickness * mass) * 1e-3, 1e-4);
}
