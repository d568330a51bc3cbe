// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// MatchedJoints::linearise(): against add_forces() and differences, along
// random paths through all branches of the laws.

#include "../model/test_models.h"
#include "../joint_laws/composite_walk.h"
#include "../joint_laws/rock_walk.h"

#include <quoin/joint_elements/joint_changes.h>
#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/contact/law_fields.h>
#include <quoin/joint_elements/matched_joints.h>

#include <map>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double thickness = 0.3;

  /** One joint between two blocks, its segment turned by an angle. */
  struct Joint
  {
    MatchedJoints joints;
    AlignedArray<NodeRecord<2>> nodes;
    JointHistory history;
    std::vector<std::uint8_t> broken{ 0, 0 };

    explicit Joint(const JointSetParameters &set)
    {
      BlockMesh<2> mesh = make_stack(1, 1);
      joints.prepare(TestNodes(mesh), { set }, thickness);
      State<2> state;
      joints.prepare(state);
      history = state.get<JointHistory>();
      for (const auto &p : mesh.vertices)
        nodes.push_back({ { p[0], p[1] }, {} });
    }

    /** Turns all by @p angle; then points of the upper side are apart by
        @p gaps, opening and slip of each, along the turned joint. */
    void place(const double angle, const double (&gaps)[2][2])
    {
      const double c = std::cos(angle), s = std::sin(angle);
      for (NodeRecord<2> &node : nodes)
      {
        node.u[0] = (c - 1.) * node.X[0] - s * node.X[1] + 0.3;
        node.u[1] = s * node.X[0] + (c - 1.) * node.X[1] - 0.1;
      }
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto &[opening, slip] = gaps[k];
        dealii::Tensor<1, 2> &u     = nodes[joints.segments()[0].upper[k]].u;
        u[0] += c * slip - s * opening;
        u[1] += s * slip + c * opening;
      }
    }

    /** What linearise() makes of the history, which it leaves. */
    JointLinearisation linearise(const AlignedArray<NodeRecord<2>> &at,
                                 JointHistory *end      = nullptr,
                                 EnergyAccounts *energy = nullptr) const
    {
      JointHistory trial = history;
      EnergyAccounts lost;
      JointLinearisation result;
      quoin::linearise(joints, 0, at.data(), broken, trial, lost, result);
      if (end)
        *end = trial;
      if (energy)
        *energy = lost;
      return result;
    }
  };

  double largest(const std::array<double, 8> &a)
  {
    double max = 0.;
    for (const double value : a)
      max = std::max(max, std::abs(value));
    return max;
  }

  /** Force, then the inelastic volume, beyond and before a displacement. */
  using Ends = std::array<std::array<double, 9>, 2>;

  Ends differences(const Joint &joint, const unsigned int j, const double h)
  {
    const auto here = joint.linearise(joint.nodes);
    Ends slopes;
    for (const unsigned int side : { 0U, 1U })
    {
      auto moved        = joint.nodes;
      double &u         = moved[here.nodes[j / 2]].u[j % 2];
      const double from = u;
      u += side == 0 ? h : -h;
      const double step = u - from;
      const auto there  = joint.linearise(moved);
      for (unsigned int i = 0; i < 8; ++i)
        slopes[side][i] = (there.force[i] - here.force[i]) / step;
      slopes[side][8] = (there.inelastic - here.inelastic) / step;
    }
    return slopes;
  }

  struct Errors
  {
    double stiffness = 0., gradient = 0.; /**< relative */
    unsigned int n_smooth = 0, n_kinks = 0;
  };

  /** The larger of kn and ks [Pa/m], of rock joints under 10 MPa. */
  double elastic_stiffness(const JointLaw &law)
  {
    return std::visit(
        [](const auto &own)
        {
          const auto stiffness = own.stiffness_at(-1e7);
          return std::max(stiffness[0], stiffness[1]);
        },
        law);
  }

  /** Derivatives at the configuration against central differences. */
  void add_errors(const Joint &joint, const double h, Errors &errors)
  {
    const auto result = joint.linearise(joint.nodes);
    // By the elastic stiffness, as a branch may have none.
    const double area  = joint.joints.segments()[0].area[0];
    const double scale = area * elastic_stiffness(joint.joints.laws()[0]);
    for (unsigned int j = 0; j < 8; ++j)
    {
      const Ends slopes = differences(joint, j, h);
      double kink       = 0.;
      for (unsigned int i = 0; i < 8; ++i)
        kink = std::max(kink, std::abs(slopes[0][i] - slopes[1][i]) / scale);
      kink = std::max(kink, std::abs(slopes[0][8] - slopes[1][8]) / area);
      if (kink > 0.01)
      {
        ++errors.n_kinks;
        continue;
      }
      ++errors.n_smooth;
      for (unsigned int i = 0; i < 8; ++i)
        errors.stiffness = std::max(
            errors.stiffness, std::abs(result.stiffness[i][j]
                                       + 0.5 * (slopes[0][i] + slopes[1][i]))
                                  / scale);
      errors.gradient = std::max(errors.gradient,
                                 std::abs(result.inelastic_gradient[j]
                                          - 0.5 * (slopes[0][8] + slopes[1][8]))
                                     / area);
    }
  }

  /** Where a path has been. */
  using Visits = std::map<JointState, unsigned int>;

  /**
   * A path of @p n committed steps, each to a random place within openings and
   * slips of [-@p closing, @p size] and +-@p size, in a frame that turns.
   */
  void walk(Joint &joint, const unsigned int seed, const unsigned int n,
            const double size, const double closing, const double h,
            Errors &errors, Visits &visits)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0., 1.);
    for (unsigned int i = 0; i < n; ++i)
    {
      double gaps[2][2];
      for (auto &gap : gaps)
      {
        gap[0] = -closing + (closing + size) * uniform(random);
        gap[1] = size * (2. * uniform(random) - 1.);
      }
      joint.place(6.2 * uniform(random) - 3.1, gaps);
      add_errors(joint, h, errors);
      joint.linearise(joint.nodes, &joint.history);
      for (const JointState state : joint.history.state)
        ++visits[state];
    }
  }

  JointSetParameters coulomb(const double dilation)
  {
    JointSetParameters set          = elastic_joint(8e9, 3e9);
    CoulombLaw &law                 = coulomb_law(set);
    law.peak                        = { 2e5, 0.6, 1e5 };
    law.residual                    = { 2e4, 0.5, 1e4 };
    law.dilation                    = dilation;
    law.critical_shear_displacement = 1e-3;
    return set;
  }

  JointSetParameters joint_of(const JointLaw &law)
  {
    JointSetParameters set = elastic_joint(0., 0.);
    set.law                = law;
    return set;
  }
} // namespace

TEST(JointTangent, ElasticJointsInAnyFrame)
{
  // Exact to rounding but for the step: gaps are large beside the segment.
  Joint joint(elastic_joint(8e9, 3e9));
  Errors errors;
  Visits visits;
  walk(joint, 3, 40, 0.2, 0.2, 1e-6, errors, visits);
  EXPECT_LT(errors.stiffness, 1e-8);
  EXPECT_LT(errors.gradient, 1e-8);
  EXPECT_EQ(errors.n_kinks, 0U);
  EXPECT_EQ(visits[JointState::intact], 80U);
}

TEST(JointTangent, CoulombJointsInAllBranches)
{
  for (const double dilation : { 0., 0.2 })
  {
    Errors errors;
    Visits visits;
    for (const unsigned int seed : { 1U, 2U, 3U, 4U })
    {
      Joint joint(coulomb(dilation));
      joint.broken = { 1, 1 };
      walk(joint, seed, 100, 2e-4, 3e-4, 1e-10, errors, visits);
    }
    EXPECT_LT(errors.stiffness, 2e-5);
    EXPECT_LT(errors.gradient, 2e-5);
    EXPECT_LT(errors.n_kinks, errors.n_smooth / 50);
    for (const JointState state :
         { JointState::slipping, JointState::slipped, JointState::open })
      EXPECT_GT(visits[state], 30U) << static_cast<int>(state);
  }
}

TEST(JointTangent, CompositeJointsInAllBranches)
{
  CompositeLaw closing = composite_test::dilatant();
  closing.cracks_close = true;
  for (const CompositeLaw &law :
       { composite_test::wall(), composite_test::dilatant(), closing })
  {
    // Small steps beyond the elastic range: tension, shear and the cap
    Errors errors;
    Visits visits;
    double bond = 1., crushing = 0.;
    for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      Joint joint(joint_of(law));
      const double size = seed % 2 == 0 ? 2e-5 : 1.2e-4;
      walk(joint, seed, 20, size, size, 1e-12 + 1e-6 * size, errors, visits);
      bond     = std::min(bond,
                          1. - law_field(joint.joints, "damage", 0, joint.history));
      crushing = std::max(
          crushing, law_field(joint.joints, "crushing", 0, joint.history));
    }
    EXPECT_LT(errors.stiffness, 1e-4);
    EXPECT_LT(errors.gradient, 1e-4);
    EXPECT_LT(errors.n_kinks, errors.n_smooth / 20);
    EXPECT_LT(bond, 0.5);
    EXPECT_GT(crushing, 1e-5);
    for (const JointState state :
         { JointState::slipping, JointState::slipped, JointState::open })
      EXPECT_GT(visits[state], 30U) << static_cast<int>(state);
  }
}

TEST(JointTangent, RockJointsInAllBranches)
{
  for (const JointSetParameters &set :
       { joint_of(rock_test::rough()), joint_of(rock_test::yielding()) })
  {
    Errors errors;
    Visits visits;
    double worn = 0.;
    for (unsigned int seed = 1; seed <= 20; ++seed)
    {
      Joint joint(set);
      // Slips of either size against the peak slip
      const double size = seed % 2 == 0 ? 5e-5 : 5e-4;
      walk(joint, seed, 20, size, 2e-4, 1e-11, errors, visits);
      worn = std::max(worn, joint.history.internal[0][0]);
    }
    EXPECT_LT(errors.stiffness, 1e-4);
    EXPECT_LT(errors.gradient, 2e-4);
    EXPECT_LT(errors.n_kinks, errors.n_smooth / 20);
    EXPECT_GT(worn, 2e-3);
    for (const JointState state : { JointState::slipping, JointState::open })
      EXPECT_GT(visits[state], 30U) << static_cast<int>(state);
  }
}

TEST(JointTangent, ForcesAreThoseOfTheExplicitSolver)
{
  CompositeLaw closing = composite_test::dilatant();
  closing.cracks_close = true;
  // Cohesion that opening takes waits for its turn.
  JointSetParameters loose             = coulomb(0.2);
  coulomb_law(loose).residual.cohesion = 0.;
  for (const JointSetParameters &set :
       { elastic_joint(8e9, 3e9), loose, joint_of(composite_test::wall()),
         joint_of(closing), joint_of(rock_test::rough()),
         joint_of(rock_test::yielding()) })
  {
    Joint joint(set);
    // From here on a brittle joint has broken, and the laws are the same.
    const double apart[2][2] = { { 1e-3, 0. }, { 1e-3, 0. } };
    joint.place(0., apart);
    joint.broken = { 1, 1 };
    joint.linearise(joint.nodes, &joint.history);
    joint.broken = { 0, 0 };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    for (unsigned int i = 0; i < 100; ++i)
    {
      double gaps[2][2];
      for (auto &gap : gaps)
        for (double &part : gap)
          part = 2e-4 * uniform(random);
      joint.place(3.1 * uniform(random), gaps);
      if (i == 50) // as if its block had been placed there
        joint.history.placed_slip = { 1e-4, -2e-4 };
      JointHistory end;
      EnergyAccounts lost, expected;
      const auto result = joint.linearise(joint.nodes, &end, &lost);
      AlignedArray<dealii::Tensor<1, 2>> force(joint.nodes.size(),
                                               dealii::Tensor<1, 2>());
      joint.joints.add_forces(joint.nodes.data(), joint.history, expected,
                              force.data());
      for (unsigned int j = 0; j < 8; ++j)
        EXPECT_NEAR(result.force[j], force[result.nodes[j / 2]][j % 2],
                    1e-9 * largest(result.force) + 1e-12);
      EXPECT_NEAR(lost.friction, expected.friction, 1e-12);
      EXPECT_NEAR(lost.fracture, expected.fracture, 1e-12);
      EXPECT_NEAR(lost.crushing, expected.crushing, 1e-12);
      EXPECT_EQ(end.state, joint.history.state);
      for (unsigned int p = 0; p < 2; ++p)
      {
        EXPECT_NEAR(end.plastic_slip[p], joint.history.plastic_slip[p], 1e-15);
        EXPECT_NEAR(end.plastic_opening[p], joint.history.plastic_opening[p],
                    1e-15);
        EXPECT_NEAR(end.normal_traction[p], joint.history.normal_traction[p],
                    1e-3);
        EXPECT_NEAR(end.shear_traction[p], joint.history.shear_traction[p],
                    1e-3);
      }
      for (const std::string &name : law_field_names(joint.joints))
        for (unsigned int p = 0; p < 2; ++p)
          EXPECT_NEAR(law_field(joint.joints, name, p, end),
                      law_field(joint.joints, name, p, joint.history),
                      name == "damage" ? 1e-9 : 1e-15);
    }
  }
}

TEST(JointTangent, IntactBrittlePointsWaitForTheirFlag)
{
  // Tension 1e5 / kn is exceeded twice over at point 0, not at point 1.
  Joint joint(coulomb(0.));
  const double kn = 8e9, area = 0.5 * thickness;
  const double gaps[2][2] = { { 2e5 / kn, 0. }, { 0.9e5 / kn, 0. } };
  joint.place(0., gaps);
  JointHistory end;
  EnergyAccounts lost;
  auto result = joint.linearise(joint.nodes, &end, &lost);
  EXPECT_EQ(end.state[0], JointState::intact);
  EXPECT_NEAR(result.force[1], 2e5 * area, 1e-3);
  EXPECT_NEAR(excess(joint.joints, 0, end), 0.5, 1e-6);
  EXPECT_LE(excess(joint.joints, 1, end), 0.);
  EXPECT_EQ(lost.fracture, 0.);
  EXPECT_EQ(result.inelastic, 0.);

  // Allowed to, it breaks to the residual strength; its energy is lost.
  joint.broken = { 1, 0 };
  result       = joint.linearise(joint.nodes, &end, &lost);
  EXPECT_EQ(end.state[0], JointState::open);
  EXPECT_EQ(end.state[1], JointState::intact);
  EXPECT_NEAR(result.force[1], 1e4 * area, 1e-3);
  EXPECT_NEAR(result.force[3], 0.9e5 * area, 1e-3);
  // As the frame turns it bears a little shear, by its residual cohesion.
  EXPECT_LT(excess(joint.joints, 0, end), 1e-4);
  // From rest in one step: half of (old + new) traction by the opening less
  // what is stored, 1e4 (2e5 - 1e4 / 2) / kn.
  EXPECT_NEAR(lost.fracture,
              (0.5 * 1e4 * 2e5 - 1e4 * (2e5 - 0.5e4)) / kn * area, 1e-9);

  // In shear: at sigma = -1e6 it holds 2e5 + 0.6e6.
  joint.broken = { 0, 0 };
  const double sheared[2][2]
      = { { -1e6 / kn, 1e6 / 3e9 }, { -1e6 / kn, 7e5 / 3e9 } };
  joint.place(0.7, sheared);
  joint.linearise(joint.nodes, &end);
  EXPECT_NEAR(end.shear_traction[0], 1e6, 10.);
  EXPECT_NEAR(excess(joint.joints, 0, end), 0.2, 1e-3);
  EXPECT_LT(excess(joint.joints, 1, end), 0.);
  joint.broken = { 1, 1 };
  joint.linearise(joint.nodes, &end);
  EXPECT_EQ(end.state[0], JointState::slipping);
  EXPECT_NEAR(end.shear_traction[0], 2e4 + 0.5e6, 10.);
  // Once it may break, the residual strength counts below the peak too.
  EXPECT_EQ(end.state[1], JointState::slipping);
}

TEST(JointTangent, ShearOfCohesionWaitsWhereAJointOpens)
{
  // Broken and closed, it opens, under more shear than the cohesion at point 0.
  Joint joint(coulomb(0.));
  const double kn = 8e9, ks = 3e9, area = 0.5 * thickness;
  joint.broken = { 1, 1 };
  const double shut[2][2]
      = { { -1e5 / kn, 0.9e5 / ks }, { -1e5 / kn, 0.9e5 / ks } };
  joint.place(0., shut);
  joint.linearise(joint.nodes, &joint.history);
  ASSERT_EQ(joint.history.state[0], JointState::slipping);
  joint.broken      = { 0, 0 };
  const double slip = joint.history.plastic_slip[0];
  const double ajar[2][2]
      = { { 3e4 / kn, slip + 4e4 / ks }, { 3e4 / kn, slip + 0.3e4 / ks } };
  joint.place(0., ajar);
  JointHistory end;
  EnergyAccounts lost;
  joint.linearise(joint.nodes, &end, &lost);
  // At the residual tension 1e4 it bears 2e4 - 0.5 * 1e4 of shear.
  EXPECT_EQ(end.state[0], JointState::open);
  EXPECT_NEAR(end.normal_traction[0], 1e4, 1e-3);
  EXPECT_NEAR(end.shear_traction[0], 1.5e4, 1e-3);
  EXPECT_NEAR(end.shear_traction[1], 0.3e4, 1e-3);
  EXPECT_NEAR(excess(joint.joints, 0, end), 0.75, 1e-6);
  EXPECT_NEAR(excess(joint.joints, 1, end), 0.15, 1e-6);
  EXPECT_NEAR(lost.friction, 0.5 * (7e4 + 1.5e4) * (4e4 - 1.5e4) / ks * area,
              1e-9);
  // Without cohesion it bears none, and closed only friction, on which the
  // tractions depend without a jump.
  joint.broken = { 2, 2 };
  joint.linearise(joint.nodes, &end);
  EXPECT_EQ(end.shear_traction[0], 0.);
  EXPECT_EQ(excess(joint.joints, 0, end), 0.);
  const double touching[2][2]
      = { { -100. / kn, slip + 4e4 / ks }, { -100. / kn, slip } };
  joint.place(0., touching);
  joint.linearise(joint.nodes, &end);
  EXPECT_NEAR(end.shear_traction[0], 50., 1e-3);
  // So does in the step in which it closes one that was open before; in the
  // next it has its cohesion.
  joint.broken = { 2, 2 };
  joint.place(0., ajar);
  joint.linearise(joint.nodes, &joint.history);
  joint.broken = { 0, 0 };
  const double further[2][2]
      = { { -100. / kn, slip + 9e4 / ks }, { -100. / kn, slip } };
  joint.place(0., further);
  joint.linearise(joint.nodes, &joint.history);
  EXPECT_NEAR(joint.history.shear_traction[0], 50., 1e-3);
  const double on[2][2]
      = { { -100. / kn, slip + 10e4 / ks }, { -100. / kn, slip } };
  joint.place(0., on);
  joint.linearise(joint.nodes, &end);
  EXPECT_NEAR(end.shear_traction[0], 50. + 1e4, 1e-2);
}

TEST(JointTangent, InelasticVolumeOfSlipAndOpening)
{
  // Opening 1e-3 and slip 2e-3, of which 1e4 / kn and no slip are elastic;
  // on the way back slip counts as less of it.
  Joint joint(coulomb(0.));
  joint.broken            = { 1, 1 };
  const double gaps[2][2] = { { -1e-5, 2e-3 }, { -1e-5, 2e-3 } };
  joint.place(1.1, gaps);
  const double elastic = (2e4 + 0.5 * 8e4) / 3e9, area = thickness;
  auto result = joint.linearise(joint.nodes, &joint.history);
  EXPECT_NEAR(result.inelastic, area * (2e-3 - elastic), 1e-9 * area);
  const double back[2][2] = { { -1e-5, 1.5e-3 }, { -1e-5, 1.5e-3 } };
  joint.place(1.1, back);
  result = joint.linearise(joint.nodes, &joint.history);
  EXPECT_NEAR(result.inelastic, -area * (5e-4 - 2. * elastic), 1e-9 * area);
}

TEST(JointTangent, TheSlipOfAnInitialTractionIsNoInelasticOne)
{
  // Under a shear traction from the start a point slips on along it, against
  // the plastic slip that stands for the traction.
  Joint joint(coulomb(0.));
  joint.broken = { 1, 1 };
  State<2> state;
  joint.joints.prepare(state);
  state.nodes      = joint.nodes;
  const double tau = 3e4;
  std::vector<JointFaceStress<2>> stress(1);
  stress[0] = { { { { 0., -8e4, tau } }, { { 0., -8e4, tau } } } };
  initialise_joints(joint.joints, stress, state);
  joint.history = state.get<JointHistory>();
  ASSERT_LT(joint.history.plastic_slip[0] * joint.history.shear_traction[0],
            0.);
  const double sign       = std::copysign(1., joint.history.shear_traction[0]);
  const double gaps[2][2] = { { 0., sign * 1e-3 }, { 0., sign * 1e-3 } };
  joint.place(0., gaps);
  auto result       = joint.linearise(joint.nodes, &joint.history);
  const double size = thickness * 1e-3;
  EXPECT_GT(result.inelastic, 0.9 * size);
  EXPECT_LT(result.inelastic, size);
  const double back[2][2] = { { 0., sign * 5e-4 }, { 0., sign * 5e-4 } };
  joint.place(0., back);
  result = joint.linearise(joint.nodes, &joint.history);
  EXPECT_LT(result.inelastic, -0.3 * size);
}

TEST(JointTangent, JointsThatWereHandedOverDoNothing)
{
  Joint joint(elastic_joint(8e9, 3e9));
  const double gaps[2][2] = { { 1e-4, 2e-4 }, { -1e-4, 0. } };
  joint.place(0.2, gaps);
  joint.history.handed_over[0] = 1;
  const auto result            = joint.linearise(joint.nodes);
  EXPECT_EQ(largest(result.force), 0.);
  for (const auto &row : result.stiffness)
    EXPECT_EQ(largest(row), 0.);
}
