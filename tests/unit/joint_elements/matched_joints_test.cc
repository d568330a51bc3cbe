// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"
#include "../joint_laws/composite_walk.h"
#include "../joint_laws/rock_walk.h"

#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/operators/stored_energy.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/joints/point_arrays.h>

#include <random>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double kn        = 8e9;
  constexpr double ks        = 3e9;
  constexpr double thickness = 0.3;
  constexpr double degree    = 3.14159265358979323846 / 180.;

  /** The joint between two stacked blocks, the whole turned by an angle. */
  struct Stack
  {
    TestNodes nodes;
    MatchedJoints joints;
    State<2> state;
    AlignedArray<dealii::Tensor<1, 2>> force;
    EnergyAccounts energy;

    explicit Stack(const unsigned int nx = 1, const double angle = 0.,
                   const JointSetParameters &set = elastic_joint(kn, ks),
                   const bool quadratic          = false)
      : nodes(mesh(nx, angle, quadratic))
    {
      joints.prepare(nodes, { set }, thickness);
      joints.prepare(state);
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
        state.nodes.push_back(
            { { nodes->point(v)[0], nodes->point(v)[1] }, {} });
    }

    static BlockMesh<2> mesh(const unsigned int nx, const double angle,
                             const bool quadratic)
    {
      BlockMesh<2> result = make_stack(nx, 1, quadratic);
      const double c = std::cos(angle), s = std::sin(angle);
      for (auto &p : result.vertices)
        p = { c * p[0] - s * p[1], s * p[0] + c * p[1] };
      return result;
    }

    unsigned int first_node(const unsigned int block) const
    {
      return nodes_of_block(nodes, block)[0];
    }
    unsigned int end_node(const unsigned int block) const
    {
      return nodes_of_block(nodes, block)[1];
    }

    void move_upper(const double x, const double y)
    {
      for (unsigned int v = first_node(1); v < end_node(1); ++v)
      {
        state.nodes[v].u[0] += x;
        state.nodes[v].u[1] += y;
      }
    }

    void find_forces()
    {
      force.assign(nodes->n_local(), dealii::Tensor<1, 2>());
      joints.add_forces(state.nodes.data(), state.get<JointHistory>(), energy,
                        force.data());
    }

    std::array<double, 2> total(const unsigned int block) const
    {
      std::array<double, 2> sum{};
      for (unsigned int v = first_node(block); v < end_node(block); ++v)
        for (unsigned int d = 0; d < 2; ++d)
          sum[d] += force[v][d];
      return sum;
    }

    /** Expects the force @p x, @p y on the lower block, its opposite above. */
    void expect_on_lower(const double x, const double y,
                         const double tolerance) const
    {
      EXPECT_NEAR(total(0)[0], x, tolerance);
      EXPECT_NEAR(total(0)[1], y, tolerance);
      EXPECT_NEAR(total(1)[0], -x, tolerance);
      EXPECT_NEAR(total(1)[1], -y, tolerance);
    }
  };

  JointSetParameters frictional()
  {
    JointSetParameters set = elastic_joint(kn, ks);
    coulomb_law(set).peak = coulomb_law(set).residual = { 0., 0.5, 0. };
    return set;
  }

  /** MatchedJoints::add_forces() point by point, by the equations of theory.md,
      "Joints". */
  template <typename Law>
  void add_forces_by_point(const Law &law, const MatchedJoints &joints,
                           const std::vector<NodeRecord<2>> &nodes,
                           JointHistory &history, EnergyAccounts &energy,
                           AlignedArray<dealii::Tensor<1, 2>> &force)
  {
    const auto place = [&](const unsigned int v, const unsigned int d)
    { return nodes[v].X[d] + nodes[v].u[d]; };
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointSegment &segment = joints.segments()[i];
      if (history.handed_over[i])
        continue;
      const auto &[a, b] = std::tie(segment.lower, segment.upper);
      double edge[2];
      for (unsigned int d = 0; d < 2; ++d)
        edge[d]
            = place(a[1], d) - place(a[0], d) + place(b[1], d) - place(b[0], d);
      const double length   = std::hypot(edge[0], edge[1]);
      const double normal[] = { edge[1] / length, -edge[0] / length };
      const auto gaps       = joint_gaps(segment, nodes.data());
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto [opening, slip] = gaps[k];
        const double own = slip_since_placing(history, 2 * i + k, slip);
        auto point       = read_point(law, history, 2 * i + k);
        JointDissipation lost;
        if (!law.update_elastic(point, opening, own))
          lost = law.update_failing(point, opening, own);
        write_point(point, history, 2 * i + k);
        const double weight = segment.area[k] * segment.share;
        energy.friction += weight * lost.friction;
        energy.fracture += weight * lost.fracture;
        energy.crushing += weight * lost.crushing;
        const double sigma  = segment.area[k] * point.normal_traction;
        const double tau    = segment.area[k] * point.shear_traction;
        const double couple = (tau * opening - sigma * slip) / length;
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double pull
              = sigma * normal[d] + tau * (d == 0 ? normal[1] : -normal[0]);
          force[a[k]][d] += pull;
          force[b[k]][d] -= pull;
          for (const unsigned int end : { 0, 1 })
            for (const auto &side : { a, b })
              force[side[end]][d] += (end == 0 ? -1. : 1.) * couple * normal[d];
        }
      }
    }
  }

  /** Walks of @p n segments at random, the last but one of which becomes a
      general contact on the way, and the last one is placed anew; @p reach:
      size of their gaps [m]. */
  template <typename Law>
  void expect_same_as_by_point(const Law &law, const unsigned int n,
                               const double reach)
  {
    JointSetParameters set = elastic_joint(kn, ks);
    set.law                = law;
    Stack stack(n, 20. * degree, set);
    std::vector<NodeRecord<2>> nodes(stack.state.nodes.begin(),
                                     stack.state.nodes.end());
    JointHistory history = stack.state.get<JointHistory>();
    EnergyAccounts energy;
    std::mt19937 random(n);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    unsigned int n_failed = 0;
    for (unsigned int step = 0; step < 40; ++step)
    {
      if (step == 25)
      {
        count_from_placing(stack.joints, stack.state.get<JointHistory>());
        begin_joint_anew(stack.joints, n - 1, stack.state);
        history = stack.state.get<JointHistory>();
      }
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (unsigned int d = 0; d < 2; ++d)
          stack.state.nodes[v].u[d] = nodes[v].u[d]
              += 0.2 * reach * uniform(random);
      if (n > 1 && step == 20)
        stack.state.get<JointHistory>().handed_over[n - 2]
            = history.handed_over[n - 2] = 1;
      stack.find_forces();
      AlignedArray<dealii::Tensor<1, 2>> force(stack.force.size(),
                                               dealii::Tensor<1, 2>());
      add_forces_by_point(law, stack.joints, nodes, history, energy, force);

      const double unit = reach * kn * 0.3;
      for (unsigned int v = 0; v < force.size(); ++v)
        for (unsigned int d = 0; d < 2; ++d)
          EXPECT_NEAR(stack.force[v][d], force[v][d], 1e-14 * unit);
      const JointHistory &now = stack.state.get<JointHistory>();
      for (unsigned int p = 0; p < 2 * n; ++p)
      {
        EXPECT_EQ(now.state[p], history.state[p]);
        EXPECT_NEAR(now.plastic_slip[p], history.plastic_slip[p],
                    1e-14 * reach);
        n_failed += now.state[p] != JointState::intact;
      }
      const EnergyAccounts &lost = stack.energy;
      for (const auto &[a, b] :
           { std::make_pair(lost.friction, energy.friction),
             std::make_pair(lost.fracture, energy.fracture),
             std::make_pair(lost.crushing, energy.crushing) })
        EXPECT_NEAR(a, b, 1e-13 * n * unit * reach);
    }
    EXPECT_GT(n_failed, n);
  }
} // namespace

TEST(MatchedJoints, SegmentsTogetherAreAsPointByPoint)
{
  CoulombLaw brittle;
  brittle.normal_stiffness            = kn;
  brittle.shear_stiffness             = ks;
  brittle.peak                        = { 1e6, 0.75, 0.4e6 };
  brittle.residual                    = { 0.1e6, 0.6, 0.05e6 };
  brittle.dilation                    = 0.3;
  brittle.critical_shear_displacement = 5e-4;
  for (const unsigned int n : { 1U, 3U, 4U, 7U, 8U, 21U })
  {
    expect_same_as_by_point(brittle, n, 5e-4);
    expect_same_as_by_point(composite_test::wall(), n, 3e-5);
    expect_same_as_by_point(rock_test::rough(), n, 1e-4);
  }
}

// Slip away from there dilates, wherever the mesh had the block.
TEST(MatchedJoints, SlipCountsFromWhereABlockWasPlaced)
{
  constexpr double slip = 1e-3, closing = 1e-4;
  JointSetParameters dilating                       = frictional();
  coulomb_law(dilating).dilation                    = 0.2;
  coulomb_law(dilating).critical_shear_displacement = 2e-3;
  JointSetParameters rough                          = elastic_joint(kn, ks);
  rough.law                                         = rock_test::rough();
  for (const JointSetParameters &set : { dilating, rough })
    for (const double way : { slip, -slip })
    {
      std::array<double, 2> pressure{};
      for (const double before : { 0., 5e-3, -5e-3 })
      {
        Stack stack(3, 0., set);
        stack.move_upper(before, 0.5 * before);
        JointHistory &history = stack.state.get<JointHistory>();
        count_from_placing(stack.joints, history);
        for (unsigned int i = 0; i < 3; ++i)
          begin_joint_anew(stack.joints, i, stack.state);
        stack.move_upper(0., -closing);
        stack.find_forces();
        const double at_first = stack.total(0)[1];
        for (unsigned int i = 0; i < 20; ++i)
        {
          stack.move_upper(way / 20., 0.);
          stack.find_forces();
        }
        const auto now = stack.total(0);
        if (before == 0.)
          pressure = now;
        // The lower block is pressed down by more as the joint dilates.
        EXPECT_LT(now[1], 1.01 * at_first);
        EXPECT_NEAR(now[0], pressure[0], 1e-9 * std::abs(pressure[1]));
        EXPECT_NEAR(now[1], pressure[1], 1e-9 * std::abs(pressure[1]));
      }
    }
}

TEST(MatchedJoints, TributaryAreasSumToTheJoint)
{
  for (const double angle : { 0., 50. * degree })
  {
    const Stack stack(3, angle);
    ASSERT_EQ(stack.joints.segments().size(), 3U);
    ASSERT_EQ(stack.joints.n_points(), 6U);
    double area = 0.;
    for (unsigned int i = 0; i < 3; ++i)
    {
      EXPECT_EQ(stack.joints.segments()[i].share, 1.f);
      for (const double a : stack.joints.segments()[i].area)
      {
        EXPECT_NEAR(a, 0.5 * thickness, 1e-15);
        area += a;
      }
    }
    EXPECT_NEAR(area, 3. * thickness, 1e-14);
  }
}

TEST(MatchedJoints, QuadraticEdgesHaveTheWeightsOfSimpsonsRule)
{
  Stack stack(3, 50. * degree, elastic_joint(kn, ks), true);
  ASSERT_EQ(stack.joints.segments().size(), 6U);
  double area = 0.;
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int k = 0; k < 2; ++k)
    {
      const auto &segment = stack.joints.segments()[i];
      const bool middle   = stack.nodes->is_midside(segment.lower[k]);
      EXPECT_NEAR(segment.area[k], (middle ? 1. / 3. : 1. / 6.) * thickness,
                  1e-15);
      area += segment.area[k];
    }
  EXPECT_NEAR(area, 3. * thickness, 1e-14);

  // The upper block turns a little about the lower left end of the joint:
  // force and moment are those of the integrals of s and s^2 over the length
  // of 3, which the trapezoidal rule on the same nodes misses by 1/72.
  const double turn = 1e-9;
  const double c = std::cos(50. * degree), s = std::sin(50. * degree);
  std::vector<dealii::Tensor<1, 2>> motion(stack.nodes->n_local(),
                                           dealii::Point<2>(0., 0.));
  for (unsigned int v = stack.first_node(1); v < stack.end_node(1); ++v)
  {
    const auto arm = stack.nodes->point(v) - dealii::Point<2>(-s, c);
    motion[v]      = dealii::Point<2>(-turn * arm[1], turn * arm[0]);
    for (unsigned int d = 0; d < 2; ++d)
      stack.state.nodes[v].u[d] = motion[v][d];
  }
  stack.find_forces();
  double force = 0., moment = 0.;
  for (unsigned int v = 0; v < stack.end_node(0); ++v)
  {
    const double along
        = c * stack.nodes->point(v)[0] + s * stack.nodes->point(v)[1];
    const double normal = -s * stack.force[v][0] + c * stack.force[v][1];
    force += normal;
    moment += along * normal;
  }
  const double unit = kn * turn * thickness;
  EXPECT_NEAR(force, 4.5 * unit, 1e-6 * unit);
  EXPECT_NEAR(moment, 9. * unit, 1e-6 * unit);
  EXPECT_NEAR(stored_energy(stack.state, stack.joints), 4.5 * turn * unit,
              1e-6 * turn * unit);

  // At the rate of this motion dampers of the joint's stiffness give the same
  // force; that of each node has its own area.
  std::vector<dealii::Tensor<1, 2>> viscous(stack.nodes->n_local(),
                                            dealii::Point<2>(0., 0.));
  stack.joints.add_viscous_forces(stack.state.nodes.data(),
                                  stack.state.get<JointHistory>(),
                                  motion.data(), 1., viscous.data());
  std::vector<std::array<double, 3>> stiffness(stack.nodes->n_local(),
                                               { { 0., 0., 0. } });
  stack.joints.add_stiffness_bound(
      stack.state, [](unsigned int, unsigned int) { return 0.; }, stiffness);
  for (unsigned int v = 0; v < stack.end_node(0); ++v)
  {
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_NEAR(viscous[v][d], stack.force[v][d], 1e-6 * unit);
    const double along
        = c * stack.nodes->point(v)[0] + s * stack.nodes->point(v)[1];
    const bool on_joint = std::abs(c * stack.nodes->point(v)[1]
                                   - s * stack.nodes->point(v)[0] - 1.)
                          < 1e-9;
    const double share = !on_joint                    ? 0.
                         : stack.nodes->is_midside(v) ? 2. / 3.
                         : along < 0.1 || along > 2.9 ? 1. / 6.
                                                      : 1. / 3.;
    EXPECT_NEAR(stiffness[v][0] + stiffness[v][1],
                share * thickness * (kn + ks), 1e-5 * kn);
  }
}

TEST(MatchedJoints, UniformOpeningAndSlip)
{
  Stack stack(2);
  const double slip = 2e-4, opening = 5e-4, area = 2. * thickness;
  stack.move_upper(slip, opening);
  for (unsigned int i = 0; i < 2; ++i)
    for (const auto &[o, s] :
         joint_gaps(stack.joints.segments()[i], stack.state.nodes.data()))
    {
      EXPECT_NEAR(o, opening, 1e-18);
      EXPECT_NEAR(s, slip, 1e-18);
    }
  stack.find_forces();
  stack.expect_on_lower(area * ks * slip, area * kn * opening, 1e-6);
  for (unsigned int p = 0; p < 4; ++p)
  {
    EXPECT_NEAR(stack.state.get<JointHistory>().normal_traction[p],
                kn * opening, 1e-6);
    EXPECT_NEAR(stack.state.get<JointHistory>().shear_traction[p], ks * slip,
                1e-6);
  }

  // Half as much at the ends of the joint as in its middle; and the couple by
  // which tractions on sides a slip apart are balanced, of each segment on the
  // ends of both edges, whose sum is 2 m long. It vanishes in the middle.
  const double couple = area / 2. * (ks * slip * opening - kn * opening * slip);
  for (const double x : { 0., 1., 2. })
    for (const unsigned int v : nodes_at(stack.nodes, x, 1.))
    {
      const double share = (x == 1. ? 0.5 : 0.25)
                           * (stack.nodes->block_of_node(v) == 0 ? 1. : -1.);
      EXPECT_NEAR(stack.force[v][0], share * area * ks * slip, 1e-6);
      EXPECT_NEAR(stack.force[v][1],
                  share * area * kn * opening + 0.5 * couple * (1. - x), 1e-6);
    }
  EXPECT_NEAR(stored_energy(stack.state, stack.joints),
              0.5 * area * (kn * opening * opening + ks * slip * slip), 1e-9);
}

TEST(MatchedJoints, NoForceOnNodesOffTheJoint)
{
  Stack stack;
  stack.move_upper(1e-3, -2e-3);
  stack.find_forces();
  for (const double y : { 0., 2. })
    for (const double x : { 0., 1. })
      for (const unsigned int v : nodes_at(stack.nodes, x, y))
      {
        EXPECT_EQ(stack.force[v][0], 0.);
        EXPECT_EQ(stack.force[v][1], 0.);
      }
}

TEST(MatchedJoints, SlipOfAHeadJoint)
{
  // The block on the right is the upper one; it slips when it moves down.
  Stack stack(1, -90. * degree);
  stack.move_upper(5e-4, -2e-4);
  const auto gaps
      = joint_gaps(stack.joints.segments()[0], stack.state.nodes.data());
  for (const auto &[opening, slip] : gaps)
  {
    EXPECT_NEAR(opening, 5e-4, 1e-15);
    EXPECT_NEAR(slip, 2e-4, 1e-15);
  }
}

TEST(MatchedJoints, TheFrameTurnsWithTheBlocks)
{
  Stack stack(2);
  const double angle = 37. * degree;
  const double c = std::cos(angle), s = std::sin(angle);
  for (NodeRecord<2> &node : stack.state.nodes)
  {
    const double x = node.X[0] - 3., y = node.X[1] + 1.;
    node.u[0] = c * x - s * y - x + 0.7;
    node.u[1] = s * x + c * y - y - 0.2;
  }
  for (unsigned int i = 0; i < 2; ++i)
    for (const auto &gap :
         joint_gaps(stack.joints.segments()[i], stack.state.nodes.data()))
    {
      EXPECT_NEAR(gap[0], 0., 1e-15);
      EXPECT_NEAR(gap[1], 0., 1e-15);
    }
  stack.find_forces();
  stack.expect_on_lower(0., 0., 1e-15 * kn);

  // What opens and slips in the turned frame pulls in the turned frame.
  const double opening = 3e-4, slip = -1e-4, area = 2. * thickness;
  stack.move_upper(slip * c - opening * s, slip * s + opening * c);
  stack.find_forces();
  const double fn = area * kn * opening, fs = area * ks * slip;
  stack.expect_on_lower(fs * c - fn * s, fs * s + fn * c, 1e-11 * fn);
}

TEST(MatchedJoints, TheFrameIsTheMeanOfBothSides)
{
  // The upper side turns by a small angle about the middle of the joint.
  Stack stack;
  const double angle = 2e-3;
  for (unsigned int v = stack.first_node(1); v < stack.end_node(1); ++v)
  {
    NodeRecord<2> &node = stack.state.nodes[v];
    const double x = node.X[0] - 0.5, y = node.X[1] - 1.;
    node.u[0] = (std::cos(angle) - 1.) * x - std::sin(angle) * y;
    node.u[1] = std::sin(angle) * x + (std::cos(angle) - 1.) * y;
  }
  // Half the angle lies on either side, so the gap is normal to the frame.
  const auto gaps
      = joint_gaps(stack.joints.segments()[0], stack.state.nodes.data());
  for (const auto &[opening, slip] : gaps)
  {
    EXPECT_NEAR(std::abs(opening), std::sin(0.5 * angle), 1e-15);
    EXPECT_NEAR(slip, 0., 1e-15);
  }
  EXPECT_NEAR(gaps[0][0] + gaps[1][0], 0., 1e-15);
}

TEST(MatchedJoints, InitialStressBecomesTraction)
{
  const double xx = -3e6, yy = -7e6, xy = 0.9e6;
  for (const double angle : { 0., 30. * degree, -60. * degree })
  {
    Stack stack(2, angle);
    const JointFaceStress<2> uniform
        = { { { { xx, yy, xy } }, { { xx, yy, xy } } } };
    initialise_joints(stack.joints, { uniform, uniform }, stack.state);
    // The normal of a joint turned by the angle, and the tangent.
    const double n[2]        = { -std::sin(angle), std::cos(angle) };
    const double t[2]        = { n[1], -n[0] };
    const double traction[2] = { xx * n[0] + xy * n[1], xy * n[0] + yy * n[1] };
    for (unsigned int p = 0; p < 4; ++p)
    {
      EXPECT_NEAR(stack.state.get<JointHistory>().normal_traction[p],
                  traction[0] * n[0] + traction[1] * n[1], 1e-6);
      EXPECT_NEAR(stack.state.get<JointHistory>().shear_traction[p],
                  traction[0] * t[0] + traction[1] * t[1], 1e-6);
    }
    // At rest the first step must not change it.
    stack.find_forces();
    const double area = 2. * thickness;
    stack.expect_on_lower(area * traction[0], area * traction[1], 1e-6);
    EXPECT_EQ(stack.state.get<JointHistory>().state[0], JointState::intact);
  }
}

TEST(MatchedJoints, InitialStressOfRockJoints)
{
  const double xx = -3e6, yy = -7e6, xy = 0.9e6;
  JointSetParameters rough = elastic_joint(kn, ks), yielding = rough;
  rough.law    = rock_test::rough();
  yielding.law = rock_test::yielding();
  for (const JointSetParameters &set : { rough, yielding })
  {
    Stack stack(2, 0., set);
    const JointFaceStress<2> uniform
        = { { { { xx, yy, xy } }, { { xx, yy, xy } } } };
    initialise_joints(stack.joints, { uniform, uniform }, stack.state);
    stack.find_forces();
    const double area = 2. * thickness;
    stack.expect_on_lower(area * xy, area * yy, 1e-3);
    EXPECT_EQ(stack.state.get<JointHistory>().state[0], JointState::intact);
    // From there it closes with the stiffness at that pressure.
    const double more = 1e-8;
    stack.move_upper(0., -more);
    stack.find_forces();
    std::visit(
        [&](const auto &law)
        {
          const double kn = law.stiffness_at(yy)[0];
          stack.expect_on_lower(area * xy, area * (yy - kn * more),
                                1e-3 * area * kn * more);
        },
        set.law);
  }
}

TEST(MatchedJoints, AYieldingJointInPlaceOfARoughOneBearsItsStrengthAtMost)
{
  const double yy = -2e6, xy = 1.6e6;
  JointSetParameters rough = elastic_joint(kn, ks), yielding = rough;
  rough.law = rock_test::rough();
  for (const double angle : { 50., 20. })
  {
    ContinuouslyYieldingLaw law = rock_test::yielding();
    law.initial_angle           = angle * rock_test::degree;
    law.residual_angle          = 0.75 * law.initial_angle;
    yielding.law                = law;
    Stack stack(2, 0., rough);
    const JointFaceStress<2> uniform
        = { { { { 0., yy, xy } }, { { 0., yy, xy } } } };
    initialise_joints(stack.joints, { uniform, uniform }, stack.state);
    stack.find_forces();
    JointHistory &history = stack.state.get<JointHistory>();
    ASSERT_NEAR(history.shear_traction[0], xy, 1e-3);
    stack.joints.set_laws({ yielding });
    keep_joint_tractions(stack.joints, stack.state);
    for (unsigned int step = 0; step < 3; ++step)
    {
      stack.find_forces();
      for (unsigned int p = 0; p < stack.joints.n_points(); ++p)
      {
        const auto point = read_point(law, history, p);
        // By the pressure before the dilation of the fall.
        const double largest
            = -yy * std::tan(law.bounding_angle(point.worn_slip));
        EXPECT_NEAR(point.shear_traction, std::min(xy, largest), 1e-6 * xy);
      }
    }
  }
}

TEST(MatchedJoints, RockJointsAreBeyondTheirStrengthIfTheyCannotHold)
{
  for (const JointLaw &law :
       { JointLaw(rock_test::rough()), JointLaw(rock_test::yielding()) })
    // Residual friction is 0.53 or 0.58, that of the unworn joint 1 or 1.19.
    for (const auto &[ratio, n_beyond] :
         { std::pair<double, double>{ 0.7, 0. }, { -0.7, 0. }, { 1.3, 4. } })
    {
      JointSetParameters set = elastic_joint(kn, ks);
      set.law                = law;
      Stack stack(2, 0., set);
      const JointFaceStress<2> uniform = { { { { 0., -2e6, ratio * 2e6 } },
                                             { { 0., -2e6, ratio * 2e6 } } } };
      initialise_joints(stack.joints, { uniform, uniform }, stack.state);
      EXPECT_EQ(n_beyond_strength(stack.joints, stack.state.get<JointHistory>(),
                                  MPI_COMM_SELF),
                n_beyond)
          << ratio;
    }
}

TEST(MatchedJoints, ViscousForcesOfRockJointsByTheStiffnessOfTheMoment)
{
  JointSetParameters set = elastic_joint(kn, ks);
  const auto law         = rock_test::rough();
  set.law                = law;
  Stack stack(1, 0., set);
  const double s = 5e6, rate = 1e-3, beta = 1e-4;
  stack.move_upper(0., -law.closure.closure(s));
  stack.find_forces();
  AlignedArray<dealii::Tensor<1, 2>> velocity(stack.nodes->n_local(),
                                              dealii::Tensor<1, 2>());
  for (unsigned int v = stack.first_node(1); v < stack.end_node(1); ++v)
    velocity[v][1] = -rate;
  stack.force.assign(stack.nodes->n_local(), dealii::Tensor<1, 2>());
  stack.joints.add_viscous_forces(stack.state.nodes.data(),
                                  stack.state.get<JointHistory>(),
                                  velocity.data(), beta, stack.force.data());
  const double expected = -beta * law.closure.stiffness(s) * rate * thickness;
  stack.expect_on_lower(0., expected, 1e-9 * std::abs(expected));
}

TEST(MatchedJoints, BoundIsExactForTwoMassesAndASpring)
{
  const double angle = 30. * degree;
  Stack stack(1, angle);
  std::vector<double> mass;
  for (unsigned int v = 0; v < stack.nodes->n_local(); ++v)
    mass.push_back(1. + 0.37 * v * v);
  std::vector<std::array<double, 3>> bound(mass.size(), { { 0., 0., 0. } });
  stack.joints.add_stiffness_bound(
      stack.state,
      [&](const unsigned int a, const unsigned int b)
      { return mass[a] / mass[b]; },
      bound);

  const double n[2]  = { -std::sin(angle), std::cos(angle) };
  const double t[2]  = { n[1], -n[0] };
  const auto segment = stack.joints.segments()[0];
  for (unsigned int k = 0; k < 2; ++k)
  {
    const unsigned int a = segment.lower[k], b = segment.upper[k];
    for (const unsigned int v : { a, b })
    {
      const auto &[xx, yy, xy] = bound[v];
      // omega^2 = k (1/m_a + 1/m_b), in both directions.
      const double inverse = 1. / mass[a] + 1. / mass[b];
      const double area    = 0.5 * thickness;
      EXPECT_NEAR((xx * n[0] * n[0] + yy * n[1] * n[1] + 2. * xy * n[0] * n[1])
                      / mass[v],
                  area * kn * inverse, 1e-12 * kn);
      EXPECT_NEAR((xx * t[0] * t[0] + yy * t[1] * t[1] + 2. * xy * t[0] * t[1])
                      / mass[v],
                  area * ks * inverse, 1e-12 * kn);
      EXPECT_NEAR(xx * n[0] * t[0] + yy * n[1] * t[1]
                      + xy * (n[0] * t[1] + n[1] * t[0]),
                  0., 1e-12 * kn * mass[v]);
    }
  }
  for (unsigned int v = 0; v < mass.size(); ++v)
    if (std::abs(stack.nodes->point(v)[1] * std::cos(angle)
                 - stack.nodes->point(v)[0] * std::sin(angle) - 1.)
        > 0.1)
    {
      EXPECT_EQ(bound[v][0] + bound[v][1], 0.);
    }
}

TEST(MatchedJoints, ViscousForcesOfStickingPoints)
{
  Stack stack(1, 0., frictional());
  stack.move_upper(0., -1e-4);
  stack.find_forces();
  AlignedArray<dealii::Tensor<1, 2>> velocity(stack.nodes->n_local(),
                                              dealii::Tensor<1, 2>());
  for (unsigned int v = stack.first_node(1); v < stack.end_node(1); ++v)
    velocity[v] = dealii::Point<2>(0.3, -0.2);

  const double beta = 1e-4;
  const auto damp   = [&]()
  {
    stack.force.assign(stack.nodes->n_local(), dealii::Tensor<1, 2>());
    stack.joints.add_viscous_forces(stack.state.nodes.data(),
                                    stack.state.get<JointHistory>(),
                                    velocity.data(), beta, stack.force.data());
  };
  damp();
  stack.expect_on_lower(thickness * beta * ks * 0.3,
                        -thickness * beta * kn * 0.2, 1e-8);

  stack.state.get<JointHistory>().state[0] = JointState::slipping;
  stack.state.get<JointHistory>().state[1] = JointState::slipped;
  damp();
  stack.expect_on_lower(0.5 * thickness * beta * ks * 0.3,
                        -0.5 * thickness * beta * kn * 0.2, 1e-8);
  stack.state.get<JointHistory>().state[1] = JointState::open;
  damp();
  stack.expect_on_lower(0., 0., 0.);
}

TEST(MatchedJoints, ViscousForcesByRatesAsElasticOnesByDisplacements)
{
  for (const unsigned int n : { 1U, 7U, 9U })
  {
    Stack stack(n, 35. * degree);
    std::mt19937 random(n);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    AlignedArray<dealii::Tensor<1, 2>> velocity(stack.state.nodes.size());
    for (unsigned int v = 0; v < velocity.size(); ++v)
      for (unsigned int d = 0; d < 2; ++d)
      {
        stack.state.nodes[v].u[d] = 0.02 * uniform(random);
        velocity[v][d]            = uniform(random);
      }
    AlignedArray<dealii::Tensor<1, 2>> viscous(velocity.size(),
                                               dealii::Tensor<1, 2>());
    AlignedArray<dealii::Tensor<1, 2>> elastic(velocity.size(),
                                               dealii::Tensor<1, 2>());
    stack.joints.add_viscous_forces(stack.state.nodes.data(),
                                    stack.state.get<JointHistory>(),
                                    velocity.data(), 1., viscous.data());
    add_elastic_forces(stack.joints, stack.state.nodes.data(), velocity.data(),
                       elastic.data());
    for (unsigned int v = 0; v < velocity.size(); ++v)
      for (unsigned int d = 0; d < 2; ++d)
        EXPECT_NEAR(viscous[v][d], elastic[v][d], 1e-14 * kn);
  }
}

TEST(MatchedJoints, BooksFrictionPerArea)
{
  Stack stack(2, 0., frictional());
  const double sigma = 1e6, area = 2. * thickness;
  stack.move_upper(0., -sigma / kn);
  stack.find_forces();
  EXPECT_EQ(stack.energy.friction, 0.);
  // From the limit on, all further slip is inelastic at constant traction.
  stack.move_upper(0.5 * sigma / ks, 0.);
  stack.find_forces();
  stack.move_upper(4e-3, 0.);
  stack.find_forces();
  EXPECT_NEAR(stack.energy.friction, area * 0.5 * sigma * 4e-3,
              1e-9 * area * sigma);
  EXPECT_EQ(stack.energy.fracture, 0.);
  EXPECT_EQ(stack.state.get<JointHistory>().state[3], JointState::slipping);
}

TEST(MatchedJoints, CrackTipsAreHarmless)
{
  MeshData<2> data = grid(2, 2, "rock");
  add_curve(data, "crack", 0, 1, 1, 1);
  SplitOptions options;
  options.joints_along = { "crack" };
  BlockMesh<2> mesh    = split_into_blocks(data, options);
  ASSERT_EQ(mesh.n_blocks(), 1U);
  ASSERT_EQ(mesh.joint_faces.size(), 1U);
  const unsigned int n = mesh.n_vertices();

  MatchedJoints joints;
  joints.prepare(TestNodes(mesh), { elastic_joint(kn, ks, "crack") },
                 thickness);
  const auto segment     = joints.segments()[0];
  const unsigned int tip = segment.lower[0] == segment.upper[0] ? 0 : 1;
  ASSERT_EQ(segment.lower[tip], segment.upper[tip]);
  ASSERT_NE(segment.lower[1 - tip], segment.upper[1 - tip]);

  State<2> state;
  joints.prepare(state);
  for (const auto &p : mesh.vertices)
    state.nodes.push_back({ p, dealii::Point<2>(0.01 * p[0], -0.02 * p[1]) });
  state.nodes[segment.upper[1 - tip]].u[1] += 1e-4;
  initialise_joints(
      joints, { { { { { 2e5, 3e5, 1e5 } }, { { 2e5, 3e5, 1e5 } } } } }, state);

  AlignedArray<dealii::Tensor<1, 2>> force(n, dealii::Tensor<1, 2>());
  EnergyAccounts energy;
  joints.add_forces(state.nodes.data(), state.get<JointHistory>(), energy,
                    force.data());
  const auto gaps = joint_gaps(joints.segments()[0], state.nodes.data());
  EXPECT_EQ(gaps[tip][0], 0.);
  EXPECT_EQ(gaps[tip][1], 0.);
  // The tip has no traction, only its share of the couple that balances the
  // tractions at the other end, 5e4 N on sides 1e-4 m apart.
  const dealii::Tensor<1, 2> &at_tip = force[segment.lower[tip]];
  EXPECT_LT(std::hypot(at_tip[0], at_tip[1]), 10.);
  for (unsigned int d = 0; d < 2; ++d)
  {
    double sum = 0.;
    for (const dealii::Tensor<1, 2> &f : force)
      sum += f[d];
    EXPECT_NEAR(sum, 0., 1e-9);
  }
  double moment = 0.;
  for (unsigned int v = 0; v < n; ++v)
  {
    const NodeRecord<2> &node = state.nodes[v];
    moment += (node.X[0] + node.u[0]) * force[v][1]
              - (node.X[1] + node.u[1]) * force[v][0];
  }
  EXPECT_NEAR(moment, 0., 1e-9);
  EXPECT_NEAR(gaps[1 - tip][0], 1e-4, 1e-8);
  EXPECT_NEAR(force[segment.lower[1 - tip]][1],
              0.5 * thickness * (3e5 + kn * 1e-4), 1e2);

  std::vector<std::array<double, 3>> bound(n, { { 0., 0., 0. } });
  joints.add_stiffness_bound(
      state, [](unsigned int, unsigned int) { return 1.; }, bound);
  EXPECT_EQ(bound[segment.lower[tip]][0], 0.);
  EXPECT_EQ(bound[segment.lower[tip]][1], 0.);
  EXPECT_GT(bound[segment.lower[1 - tip]][1], 0.);
}

TEST(MatchedJoints, SetsActOnTheirOwnCurves)
{
  // Three blocks side by side; the set of the second joint comes first.
  MeshData<2> data;
  for (unsigned int i = 0; i < 3; ++i)
  {
    add_grid(data, 1, 1, "rock", i, 0.);
    if (i > 0)
      add_curve(data, i == 1 ? "first" : "second", i, 0, i, 1);
  }
  BlockMesh<2> mesh    = split_into_blocks(data, {});
  const unsigned int n = mesh.n_vertices();
  MatchedJoints joints;
  joints.prepare(
      TestNodes(mesh),
      { elastic_joint(1e9, 1e8, "second"), elastic_joint(5e9, 5e8, "first") },
      1.);
  State<2> state;
  joints.prepare(state);
  for (const auto &p : mesh.vertices)
    state.nodes.push_back({ { p[0], p[1] }, {} });
  for (unsigned int b = 1; b < 3; ++b)
    for (unsigned int v = mesh.block_first_vertex[b];
         v < mesh.block_first_vertex[b + 1]; ++v)
      state.nodes[v].u[0] = b * 1e-3;
  AlignedArray<dealii::Tensor<1, 2>> force(n, dealii::Tensor<1, 2>());
  EnergyAccounts energy;
  joints.add_forces(state.nodes.data(), state.get<JointHistory>(), energy,
                    force.data());
  const double expected[3] = { 5e6, 1e6 - 5e6, -1e6 };
  for (unsigned int b = 0; b < 3; ++b)
  {
    double sum = 0.;
    for (unsigned int v = mesh.block_first_vertex[b];
         v < mesh.block_first_vertex[b + 1]; ++v)
      sum += force[v][0];
    EXPECT_NEAR(sum, expected[b], 1e-3);
  }
}

TEST(MatchedJoints, RefusesCurvesItCannotPlace)
{
  Stack stack;
  const auto prepare = [&](const std::vector<JointSetParameters> &sets)
  { MatchedJoints().prepare(stack.nodes, sets, thickness); };
  expect_input_error([&] { prepare({ elastic_joint(1., 1., "crack") }); },
                     { "Joints/crack", "'crack'", ", joint,", "Curves" });
  auto again = elastic_joint(1., 1.);
  again.name = "again";
  expect_input_error(
      [&] {
        prepare({ elastic_joint(1., 1.), again });
      },
      { "Joints/again", "'joint'" });
  expect_input_error([&] { prepare({ elastic_joint(1., 1., "top") }); },
                     { "'joint'", "'lower'", "'upper'", "no joint set" });
}

TEST(MatchedJoints, UnnamedJointsHaveAWordOfTheirOwn)
{
  MeshData<2> data;
  add_grid(data, 1, 1, "lower");
  add_grid(data, 1, 1, "upper", 0., 1.);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  const TestNodes nodes(mesh);
  MatchedJoints joints;
  joints.prepare(nodes, { elastic_joint(kn, ks, "unnamed") }, 1.);
  EXPECT_EQ(joints.segments().size(), 1U);
  expect_input_error([&] { joints.prepare(nodes, {}, 1.); },
                     { "'unnamed'", "'lower'", "'upper'" });
}
