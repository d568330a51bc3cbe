// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "space_stack.h"

#include <quoin/joint_elements/joint_changes.h>
#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/joints/point_arrays.h>
#include <quoin/operators/stored_energy.h>
#include <quoin/base/exceptions.h>

#include <gtest/gtest.h>

using namespace quoin;
using namespace quoin::test;
using namespace quoin::test::space_stack;

TEST(SpaceJoints, FacesHaveTheirAreaAndNormalsPointUp)
{
  Stack stack(elastic());
  ASSERT_EQ(stack.joints.faces().size(), 4U);
  // The middle plane of the box, as inclined() has it: edges along the images
  // of x and y.
  const Vector origin = inclined({ 0., 0., 0.5 });
  const Vector area   = cross_product_3d(inclined({ 1., 0., 0.5 }) - origin,
                                         inclined({ 0., 0.5, 0.5 }) - origin);
  double total        = 0.;
  for (const SpaceJointFace &face : stack.joints.faces())
  {
    total += 3. * face.area;
    const SpaceJointFrame frame = joint_frame(face, stack.state.nodes.data());
    EXPECT_NEAR(frame.n * area / area.norm(), 1., 1e-12);
    EXPECT_NEAR(frame.s * frame.n, 0., 1e-12);
    EXPECT_NEAR((cross_product_3d(frame.s, frame.t) - frame.n).norm(), 0.,
                1e-12);
    for (unsigned int k = 0; k < 3; ++k)
    {
      EXPECT_FALSE(stack.is_high(face.lower[k]));
      EXPECT_TRUE(stack.is_high(face.upper[k]));
    }
  }
  EXPECT_NEAR(total, area.norm(), 1e-12);
}

namespace
{
  /** SpaceJoints::add_forces() point by point, by the equations of theory.md,
      "Joints in three dimensions". */
  template <typename Law>
  void add_forces_by_point(const Law &law, const Stack &stack,
                           SpaceJointHistory &history, EnergyAccounts &energy,
                           std::vector<Vector> &force)
  {
    for (unsigned int i = 0; i < stack.joints.faces().size(); ++i)
    {
      if (history.detached[i])
        continue;
      const SpaceJointFace &face = stack.joints.faces()[i];
      const auto mean            = [&](const unsigned int k)
      {
        return 0.5
               * (stack.position(face.lower[k])
                  + stack.position(face.upper[k]));
      };
      const Vector e1 = mean(1) - mean(0), e2 = mean(2) - mean(0);
      const Vector normal = cross_product_3d(e1, e2);
      const Vector n = normal / normal.norm(), s = e1 / e1.norm();
      const Vector t = cross_product_3d(n, s);
      const auto gap = joint_gaps(face, stack.state.nodes.data());
      Vector couple;
      for (unsigned int k = 0; k < 3; ++k)
      {
        Slip<3> slip;
        slip[0]    = gap[k][1];
        slip[1]    = gap[k][2];
        slip       = slip_since_placing(history, 3 * i + k, slip);
        auto point = read_point(law, history, 3 * i + k);
        JointDissipation lost;
        if (!law.update_elastic(point, gap[k][0], slip))
          lost = law.update_failing(point, gap[k][0], slip);
        write_point(point, history, 3 * i + k);
        energy.friction += face.area * face.share * lost.friction;
        energy.fracture += face.area * face.share * lost.fracture;
        energy.crushing += face.area * face.share * lost.crushing;
        const Vector pull
            = face.area
              * (point.normal_traction * n + point.shear_traction[0] * s
                 + point.shear_traction[1] * t);
        force[face.lower[k]] += pull;
        force[face.upper[k]] -= pull;
        couple += cross_product_3d(pull, stack.position(face.upper[k])
                                             - stack.position(face.lower[k]));
      }
      // The triangle of mean positions turns with the frame: forces on its
      // vertices whose moment is the couple, without resultant, across e1 at
      // its second one and across the plane at both.
      const double lift = couple * s / (e2 * t);
      const Vector f2   = -lift * n;
      const Vector f1
          = ((couple * t + lift * (e2 * s)) * n - couple * n * t) / e1.norm();
      for (const auto &side : { face.lower, face.upper })
      {
        force[side[0]] -= 0.5 * (f1 + f2);
        force[side[1]] += 0.5 * f1;
        force[side[2]] += 0.5 * f2;
      }
    }
  }

  /** Walks of the 2 @p nx faces at random, the last but one of which is
      detached on the way, and the last one placed anew; @p reach: size of their
      gaps [m]. */
  template <typename Law>
  void expect_same_as_by_point(const Law &law, const unsigned int nx,
                               const double reach)
  {
    Stack stack(law, nx);
    const unsigned int n_faces = stack.joints.faces().size();
    ASSERT_EQ(n_faces, 2 * nx);
    SpaceJointHistory history = stack.history();
    EnergyAccounts energy;
    unsigned int n_failed = 0;
    for (unsigned int step = 0; step < 40; ++step)
    {
      if (step == 25)
      {
        count_from_placing(stack.joints, stack.history());
        begin_joint_anew(stack.joints, n_faces - 1, stack.state);
        history = stack.history();
      }
      stack.shake(0.2 * reach, 100 * nx + step);
      if (step == 20)
        stack.history().detached[n_faces - 2] = history.detached[n_faces - 2]
            = 1;
      stack.update();
      std::vector<Vector> force(stack.force.size());
      add_forces_by_point(law, stack, history, energy, force);

      const double unit = reach * kn * 0.04;
      // Rock joints grow far stiffer than that where they close.
      double largest = unit;
      for (const Vector &f : force)
        largest = std::max(largest, f.norm());
      for (unsigned int v = 0; v < force.size(); ++v)
        EXPECT_NEAR((stack.force[v] - force[v]).norm(), 0., 1e-13 * largest);
      const SpaceJointHistory &now = stack.history();
      for (unsigned int p = 0; p < 3 * n_faces; ++p)
      {
        EXPECT_EQ(now.state[p], history.state[p]);
        for (const unsigned int c : { 2 * p, 2 * p + 1 })
          EXPECT_NEAR(now.plastic_slip[c], history.plastic_slip[c],
                      1e-13 * reach);
        n_failed += now.state[p] != JointState::intact;
      }
      EXPECT_NEAR(stack.energy.friction, energy.friction,
                  1e-13 * n_faces * unit * reach);
      EXPECT_NEAR(stack.energy.fracture, energy.fracture,
                  1e-13 * n_faces * unit * reach);
      EXPECT_NEAR(stack.energy.crushing, energy.crushing,
                  1e-13 * n_faces * unit * reach);
    }
    EXPECT_GT(n_failed, n_faces);
  }
} // namespace

TEST(SpaceJoints, FacesTogetherAreAsPointByPoint)
{
  // The last one has more nodes than are loaded together.
  for (const unsigned int nx : { 1U, 2U, 3U, 4U, 11U, 100U })
  {
    expect_same_as_by_point(coulomb(), nx, 5e-4);
    expect_same_as_by_point(composite_test::wall(), nx, 3e-5);
    expect_same_as_by_point(composite_test::dilatant(), nx, 3e-5);
    expect_same_as_by_point(rock_test::rough(), nx, 1e-4);
  }
}

TEST(SpaceJoints, ForcesAreTheSameFarFromTheOrigin)
{
  // Coordinates that are exact in both places.
  const auto placed = [](const double away)
  {
    return [away](const dealii::Point<3> &p)
    {
      dealii::Point<3> result = inclined(p);
      for (double &x : dealii::make_array_view(result))
        x = away + std::round(std::ldexp(x, 20)) * std::ldexp(1., -20);
      return result;
    };
  };
  Stack near(elastic(), 3, placed(0.)), far(elastic(), 3, placed(1 << 22));
  for (Stack *stack : { &near, &far })
  {
    stack->shake(1e-3);
    stack->update();
  }
  double largest = 0., difference = 0.;
  for (unsigned int i = 0; i < near.force.size(); ++i)
  {
    largest    = std::max(largest, near.force[i].norm());
    difference = std::max(difference, (near.force[i] - far.force[i]).norm());
  }
  EXPECT_GT(largest, 0.);
  EXPECT_LE(difference, 1e-14 * largest);
}

TEST(SpaceJoints, TractionOfUniformOpeningAndSlip)
{
  Stack stack(elastic());
  const Vector jump({ 1e-4, -2e-4, 3e-4 });
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    if (stack.is_high(i))
      stack.place(i, stack.position(i) + jump);
  stack.update();
  Vector on_high;
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    if (stack.is_high(i))
      for (unsigned int d = 0; d < 3; ++d)
        on_high[d] += stack.force[i][d];
  const SpaceJointFace &face = stack.joints.faces()[0];
  const Vector n             = joint_frame(face, stack.state.nodes.data()).n;
  const Vector traction      = ks * jump + (kn - ks) * (jump * n) * n;
  double area                = 0.;
  Vector sum;
  for (unsigned int i = 0; i < stack.joints.faces().size(); ++i)
  {
    area += 3. * stack.joints.faces()[i].area;
    sum += force_on_upper(stack.joints, i, stack.state);
  }
  EXPECT_LE((on_high + area * traction).norm(), 1e-9 * area * traction.norm());
  EXPECT_LE((sum + area * traction).norm(), 1e-9 * area * traction.norm());
}

TEST(SpaceJoints, ForceIsMinusTheDerivativeOfTheEnergy)
{
  Stack stack(elastic());
  // Far from the mesh, so that the rotation of the frames matters.
  stack.shake(0.05);
  stack.update();
  const auto force   = stack.force;
  double largest     = 0.;
  constexpr double h = 1e-6;
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
    {
      double energy[2];
      for (unsigned int side = 0; side < 2; ++side)
      {
        stack.state.nodes[i].u[d] += side == 0 ? h : -2. * h;
        stack.update();
        energy[side] = stored_energy(stack.state, stack.joints);
      }
      stack.state.nodes[i].u[d] += h;
      largest = std::max(largest, std::abs(force[i][d]));
      EXPECT_NEAR(force[i][d], -(energy[0] - energy[1]) / (2. * h),
                  1e-7 * kn * 0.05);
    }
  EXPECT_GT(largest, 1e-3 * kn * 0.05);
}

TEST(SpaceJoints, ForcesHaveNoResultantAndNoMoment)
{
  for (const JointLaw &law : all_laws())
  {
    Stack stack(law);
    stack.shake(1e-3);
    stack.update();
    Vector resultant, moment;
    double size = 0.;
    for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    {
      const dealii::Tensor<1, 3> &v = stack.force[i];
      const Vector f({ v[0], v[1], v[2] });
      resultant += f;
      moment += cross_product_3d(stack.position(i), f);
      size += f.norm();
    }
    EXPECT_GT(size, 0.);
    EXPECT_LE(resultant.norm(), 1e-13 * size);
    EXPECT_LE(moment.norm(), 1e-13 * size);
  }
}

TEST(SpaceJoints, RigidRotationTurnsForcesAndNothingElse)
{
  const Matrix turn = rotation(Vector({ 1.5, 2., -0.7 }));
  for (const JointLaw &law : all_laws())
  {
    Stack still(law), turned(law);
    for (unsigned int step = 0; step < 20; ++step)
    {
      still.shake(1e-4, step);
      still.update();
      for (unsigned int i = 0; i < still.nodes.n_local(); ++i)
        turned.place(i, turn * still.position(i));
      turned.update();
    }
    double size = 0., difference = 0.;
    for (unsigned int i = 0; i < still.nodes.n_local(); ++i)
    {
      const auto &a = still.force[i], &b = turned.force[i];
      const Vector f({ a[0], a[1], a[2] });
      size       = std::max(size, f.norm());
      difference = std::max(difference,
                            (turn * f - Vector({ b[0], b[1], b[2] })).norm());
    }
    EXPECT_GT(size, 0.);
    EXPECT_LE(difference, 1e-7 * size);
    EXPECT_NEAR(turned.lost(), still.lost(), 1e-7 * (1. + still.lost()));
  }
}

namespace
{
  /** Moves the high block along random lines, at @p spin [rad a line] turning
      both blocks, and returns what is missing in the balance of energy by what
      was turned over. */
  double imbalance(const JointLaw &law, const double spin,
                   const unsigned int n_steps)
  {
    Stack stack(law);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    double work = 0., turnover = 0.;
    Vector jump, turned;
    stack.update();
    for (unsigned int line = 0; line < 20; ++line)
    {
      const Vector start
          = jump,
          end = 2e-3
                * Vector({ uniform(random), uniform(random), uniform(random) });
      for (unsigned int step = 1; step <= n_steps; ++step)
      {
        const double share = double(step) / n_steps;
        jump               = start + share * (end - start);
        const Matrix turn
            = rotation(spin * (line + share) * Vector({ 0.6, 0.48, 0.64 }));
        const auto before = stack.force;
        std::vector<Vector> from;
        for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
        {
          from.push_back(stack.position(i));
          const auto &X = stack.state.nodes[i].X;
          const Vector place({ X[0], X[1], X[2] });
          stack.place(i, turn * (stack.is_high(i) ? place + jump : place));
        }
        stack.update();
        for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
          for (unsigned int d = 0; d < 3; ++d)
          {
            const double by = -0.5 * (before[i][d] + stack.force[i][d])
                              * (stack.position(i)[d] - from[i][d]);
            work += by;
            turnover += std::abs(by);
          }
      }
    }
    EXPECT_GT(turnover, 0.);
    return (work - stack.lost() - stored_energy(stack.state, stack.joints))
           / turnover;
  }
} // namespace

TEST(SpaceJoints, WorkIsStoredOrDissipated)
{
  for (const JointLaw &law : all_laws())
  {
    // A joint without tension that opens leaves the kink of its law to the
    // residual, as in two dimensions.
    const bool is_exact
        = std::holds_alternative<CompositeLaw>(law) || !can_fail(law);
    EXPECT_NEAR(imbalance(law, 0., 200), 0., is_exact ? 1e-11 : 1e-5);
    // Joints that turn, to second order in the step.
    const double coarse = imbalance(law, 0.05, 200);
    EXPECT_NEAR(coarse, 0., 2e-4);
    if (is_exact)
    {
      EXPECT_NEAR(imbalance(law, 0.05, 400), coarse / 4.,
                  0.2 * std::abs(coarse) + 1e-9);
    }
  }
}

TEST(SpaceJoints, RateForcesAreTheDerivativeOfForces)
{
  Stack stack(elastic());
  // Free of traction but for the small motion, by which forces are linear.
  AlignedArray<dealii::Tensor<1, 3>> velocity(stack.nodes.n_local(),
                                              dealii::Tensor<1, 3>());
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (auto &node : velocity)
    for (double &v : dealii::make_array_view(node))
      v = uniform(random);
  AlignedArray<dealii::Tensor<1, 3>> elastic_force(stack.nodes.n_local(),
                                                   dealii::Tensor<1, 3>()),
      viscous(stack.nodes.n_local(), dealii::Tensor<1, 3>());
  add_elastic_forces(stack.joints, stack.state.nodes.data(), velocity.data(),
                     elastic_force.data());
  constexpr double beta = 1e-4;
  stack.joints.add_viscous_forces(stack.state.nodes.data(), stack.history(),
                                  velocity.data(), beta, viscous.data());
  constexpr double h = 1e-7;
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
      stack.state.nodes[i].u[d] = h * velocity[i][d];
  stack.update();
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
    {
      EXPECT_NEAR(elastic_force[i][d], stack.force[i][d] / h, 1e-5 * kn);
      EXPECT_NEAR(viscous[i][d], beta * elastic_force[i][d], 1e-9 * kn);
    }
}

TEST(SpaceJoints, ViscousForcesTakeEnergyAndNoMomentum)
{
  Stack stack(elastic());
  stack.shake(0.05);
  stack.update();
  AlignedArray<dealii::Tensor<1, 3>> velocity(stack.nodes.n_local(),
                                              dealii::Tensor<1, 3>()),
      viscous(stack.nodes.n_local(), dealii::Tensor<1, 3>());
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (auto &node : velocity)
    for (double &v : dealii::make_array_view(node))
      v = uniform(random);
  stack.joints.add_viscous_forces(stack.state.nodes.data(), stack.history(),
                                  velocity.data(), 1e-4, viscous.data());
  double power = 0., size = 0.;
  Vector moment;
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
  {
    const dealii::Tensor<1, 3> &f = viscous[i];
    const Vector force({ f[0], f[1], f[2] });
    for (unsigned int d = 0; d < 3; ++d)
      power += f[d] * velocity[i][d];
    moment += cross_product_3d(stack.position(i), force);
    size += force.norm();
  }
  EXPECT_LT(power, 0.);
  EXPECT_LE(moment.norm(), 1e-13 * size);

  // None of a rigid rotation, in which no gap changes.
  viscous.assign(viscous.size(), dealii::Tensor<1, 3>());
  const Vector spin({ 0.3, -0.2, 0.5 });
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
  {
    const Vector v = cross_product_3d(spin, stack.position(i));
    for (unsigned int d = 0; d < 3; ++d)
      velocity[i][d] = v[d];
  }
  stack.joints.add_viscous_forces(stack.state.nodes.data(), stack.history(),
                                  velocity.data(), 1e-4, viscous.data());
  for (const auto &f : viscous)
    for (const double component : dealii::make_array_view(f))
      EXPECT_NEAR(component, 0., 1e-12 * size);
}

TEST(SpaceJoints, BoundOfTheStiffnessIsThatOfSprings)
{
  Stack stack(elastic());
  std::vector<NodeStiffness<3>> bound(stack.nodes.n_local(),
                                      NodeStiffness<3>{});
  stack.joints.add_stiffness_bound(
      stack.state, [](unsigned int, unsigned int) { return 0.; }, bound);
  double trace = 0., area = 0.;
  for (unsigned int i = 0; i < stack.nodes.n_local(); ++i)
    if (stack.is_high(i))
      trace += bound[i][0] + bound[i][1] + bound[i][2];
  for (const SpaceJointFace &face : stack.joints.faces())
    area += 3. * face.area;
  EXPECT_NEAR(trace, area * (kn + 2. * ks), 1e-9 * trace);
  // Along the normal it is kn alone.
  const SpaceJointFace &face = stack.joints.faces()[0];
  const Vector n             = joint_frame(face, stack.state.nodes.data()).n;
  const auto &[xx, yy, zz, xy, xz, yz] = bound[face.upper[0]];
  const Vector pushed({ xx * n[0] + xy * n[1] + xz * n[2],
                        xy * n[0] + yy * n[1] + yz * n[2],
                        xz * n[0] + yz * n[1] + zz * n[2] });
  EXPECT_LE((pushed - (pushed * n) * n).norm(), 1e-12 * pushed.norm());
}

TEST(SpaceJoints, RefusesFacesWithoutSet)
{
  Stack stack(elastic());
  SpaceJoints joints;
  JointSetParameters set = set_of(elastic());
  set.curves             = {};
  try
  {
    joints.prepare(stack.nodes, { set });
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("on no named surface"),
              std::string::npos);
  }
}
