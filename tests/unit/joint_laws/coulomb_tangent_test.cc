// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_laws/coulomb_law.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace quoin;

namespace
{
  constexpr double kn       = 8e9;
  constexpr double ks       = 3e9;
  constexpr double cohesion = 1e6;
  constexpr double mu       = 0.75;
  constexpr double ft       = 0.4e6;

  const JointPoint<2> fresh = { 0., 0., 0., 0., JointState::intact };

  /** Elastic; open; slips without dilation, away from the origin, back; slip
      bounded by the shear traction; residual strength above the peak's. */
  enum Branch
  {
    strains,
    opens,
    slips,
    dilates,
    returns,
    stops,
    sticks,
    n_branches
  };

  /** The one that took @p before to @p after at this slip. */
  Branch branch_of(const CoulombLaw &law, const JointPoint<2> &before,
                   const JointPoint<2> &after, const double slip)
  {
    if (after.state == JointState::open)
      return opens;
    if (after.state != JointState::slipping)
      return strains;
    const double moved = after.plastic_slip - before.plastic_slip;
    if (moved == 0.)
      return sticks;
    if (std::abs(after.shear_traction) < 1e-6 * cohesion)
      return stops;
    if (law.dilation == 0. || std::abs(slip) >= law.critical_shear_displacement)
      return slips;
    return moved * slip >= 0. ? dilates : returns;
  }

  /** Of the tangent from central differences, by the normal stiffness; the
      differences stay in one branch or the point is passed over. */
  double tangent_error(const CoulombLaw &law, const JointPoint<2> &start,
                       const double opening, const double slip,
                       std::array<unsigned int, n_branches> &seen)
  {
    constexpr double h  = 1e-9;
    JointPoint<2> end   = start;
    JointTangent<2> d   = { NAN, NAN, NAN, NAN };
    const auto lost     = law.update(end, opening, slip, d);
    const Branch branch = branch_of(law, start, end, slip);

    JointPoint<2> same   = start;
    const auto same_lost = law.update(same, opening, slip);
    // Up to how the compiler rounds two copies of the same formula.
    EXPECT_NEAR(same.normal_traction, end.normal_traction, 1e-9 * cohesion);
    EXPECT_NEAR(same.shear_traction, end.shear_traction, 1e-9 * cohesion);
    EXPECT_NEAR(same.plastic_slip, end.plastic_slip, 1e-15);
    EXPECT_NEAR(same.plastic_opening, end.plastic_opening, 1e-15);
    EXPECT_EQ(same.state, end.state);
    EXPECT_NEAR(same_lost.friction, lost.friction, 1e-9);
    EXPECT_NEAR(same_lost.fracture, lost.fracture, 1e-9);

    bool is_smooth   = true;
    const auto moved = [&](const double du, const double dv)
    {
      JointPoint<2> point = start;
      law.update(point, opening + du, slip + dv);
      is_smooth &= branch_of(law, start, point, slip + dv) == branch;
      return point;
    };
    const auto right = moved(h, 0.), left = moved(-h, 0.);
    const auto above = moved(0., h), below = moved(0., -h);
    if (!is_smooth)
      return 0.;
    ++seen[branch];
    const auto error
        = [&](const double plus, const double minus, const double tangent)
    { return std::abs((plus - minus) / (2. * h) - tangent) / kn; };
    return std::max(
        { error(right.normal_traction, left.normal_traction, d.normal_opening),
          error(above.normal_traction, below.normal_traction, d.normal_slip),
          error(right.shear_traction, left.shear_traction, d.shear_opening),
          error(above.shear_traction, below.shear_traction, d.shear_slip) });
  }

  /** Brittle, no-tension and residually stronger laws, with and without
      dilation, also one too steep to be solved on the way back. */
  std::vector<CoulombLaw> laws_with_tangents()
  {
    std::vector<CoulombLaw> laws;
    for (const double dilation : { 0., 0.1, 0.6 })
      for (const JointStrength &residual :
           { JointStrength{ 0., mu, 0. },
             JointStrength{ 0.2e6, 0.5, 0.25 * ft },
             JointStrength{ 2. * cohesion, mu, ft } })
      {
        CoulombLaw law;
        law.normal_stiffness            = kn;
        law.shear_stiffness             = ks;
        law.peak                        = { cohesion, mu, ft };
        law.residual                    = residual;
        law.dilation                    = dilation;
        law.critical_shear_displacement = 1.5e-3;
        laws.push_back(law);
      }
    return laws;
  }
} // namespace

TEST(CoulombTangent, IsTheDerivative)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::array<unsigned int, n_branches> seen{};
  for (const CoulombLaw &law : laws_with_tangents())
  {
    JointPoint<2> point = fresh;
    for (unsigned int i = 0; i < 5000; ++i)
    {
      if (i % 50 == 0)
        point = fresh;
      // About the strengths, from where the joint is, and now and then far.
      const double far = i % 7 == 0 ? 10. : 1.;
      const double opening
          = point.plastic_opening + (uniform(random) - 0.5) * far * 1e6 / kn;
      const double slip = point.plastic_slip + uniform(random) * far * 2e6 / ks;
      ASSERT_LT(tangent_error(law, point, opening, slip, seen), 1e-5)
          << i << " dilation " << law.dilation;
      law.update(point, opening, slip);
    }
  }
  for (unsigned int branch = 0; branch < n_branches; ++branch)
    EXPECT_GT(seen[branch], 50U) << branch;
}

TEST(CoulombTangent, OfAnElasticJoint)
{
  CoulombLaw law;
  law.normal_stiffness = kn;
  law.shear_stiffness  = ks;
  JointPoint<2> point  = fresh;
  JointTangent<2> tangent;
  law.update(point, 1., -2., tangent);
  EXPECT_EQ(tangent.normal_opening, kn);
  EXPECT_EQ(tangent.normal_slip, 0.);
  EXPECT_EQ(tangent.shear_opening, 0.);
  EXPECT_EQ(tangent.shear_slip, ks);
}
