// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_models.h"

#include <quoin/loads/nodal_load.h>
#include <quoin/motions/platen.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double thickness = 0.5;

  /** Two blocks of 3 m x 2 m, their corners out of square. */
  struct Stack
  {
    TestNodes nodes;
    std::unique_ptr<Model<2>> model;

    explicit Stack(const bool quadratic, const bool upper_is_rigid = false)
      : nodes(mesh(quadratic), { false, upper_is_rigid })
    {
      ModelParameters parameters    = two_blocks();
      parameters.materials[1].rigid = upper_is_rigid;
      model = std::make_unique<Model<2>>(nodes, parameters);
    }

    static BlockMesh<2> mesh(const bool quadratic)
    {
      BlockMesh<2> result = make_stack(3, 2, quadratic);
      for (auto &p : result.vertices)
        p = { p[0] + 0.2 * p[1], p[1] };
      return result;
    }

    /** Sums of force and of its moment about the origin. */
    std::array<double, 3> resultant(const LoadParameters &parameters) const
    {
      const NodalLoad<2> load(parameters, nodes, model->mass(), thickness);
      std::vector<dealii::Tensor<1, 2>> force(nodes->n_local(),
                                              dealii::Point<2>(0., 0.));
      load.add_loads({ 0., 0. }, force.data());
      std::array<double, 3> sum{};
      for (unsigned int v = 0; v < force.size(); ++v)
      {
        const auto &p = nodes->point(v);
        sum[0] += force[v][0];
        sum[1] += force[v][1];
        sum[2] += p[0] * force[v][1] - p[1] * force[v][0];
      }
      return sum;
    }
  };
} // namespace

TEST(QuadraticModel, MassIsInTheMiddleOfEdges)
{
  const Stack stack(true);
  double sum[3]{};
  for (unsigned int v = 0; v < stack.nodes->n_local(); ++v)
  {
    const double mass = stack.model->mass()[v];
    if (stack.nodes->is_midside(v))
      EXPECT_GT(mass, 0.);
    else
      EXPECT_EQ(mass, 0.);
    sum[0] += mass;
    sum[1] += mass * stack.nodes->point(v)[0];
    sum[2] += mass * stack.nodes->point(v)[1];
  }
  const double mass = 2500. * 12. * thickness;
  EXPECT_NEAR(sum[0], mass, 1e-12 * mass);
  EXPECT_NEAR(sum[1] / mass, 1.5 + 0.2 * 2., 1e-12);
  EXPECT_NEAR(sum[2] / mass, 2., 1e-12);
}

TEST(QuadraticModel, GravityHasTheResultantOfTheBody)
{
  const auto [x, y, moment] = Stack(true).resultant(gravity("0", "-10"));
  const double weight       = 2500. * 12. * thickness * 10.;
  EXPECT_NEAR(x, 0., 1e-12 * weight);
  EXPECT_NEAR(y, -weight, 1e-12 * weight);
  EXPECT_NEAR(moment, -1.9 * weight, 1e-12 * weight);
}

TEST(QuadraticModel, TractionAndPressureHaveTheirResultants)
{
  const Stack stack(true);
  const auto sum    = stack.resultant(traction("pull", "top", "3", "5"));
  const double area = 3. * thickness;
  EXPECT_NEAR(sum[0], 3. * area, 1e-12);
  EXPECT_NEAR(sum[1], 5. * area, 1e-12);
  // The top is at y = 4, its middle at x = 1.5 + 0.8.
  EXPECT_NEAR(sum[2], (2.3 * 5. - 4. * 3.) * area, 1e-12);

  LoadParameters pressure = traction("push", "top", "", "");
  pressure.pressure       = component(LoadQuantity::force, "7");
  const auto push         = stack.resultant(pressure);
  EXPECT_NEAR(push[0], 0., 1e-12);
  EXPECT_NEAR(push[1], -7. * area, 1e-12);
  EXPECT_NEAR(push[2], -7. * 2.3 * area, 1e-12);

  // Of each edge of 1 m: a sixth at its ends, two thirds in the middle.
  const NodalLoad<2> load(traction("pull", "top", "0", "1"), stack.nodes,
                          stack.model->mass(), thickness);
  std::vector<dealii::Tensor<1, 2>> force(stack.nodes->n_local(),
                                          dealii::Point<2>(0., 0.));
  load.add_loads({ 0., 0. }, force.data());
  const double expected[]
      = { 1. / 6., 2. / 3., 1. / 3., 2. / 3., 1. / 3., 2. / 3., 1. / 6. };
  for (unsigned int i = 0; i < 7; ++i)
  {
    const auto nodes = nodes_at(stack.nodes, 0.8 + 0.5 * i, 4.);
    ASSERT_EQ(nodes.size(), 1U);
    EXPECT_NEAR(force[nodes[0]][1], expected[i] * thickness, 1e-15);
  }
}

TEST(QuadraticModel, RigidBlocksAreTheBody)
{
  const Stack linear(false, true), quadratic(true, true);
  const auto &a = linear.model->rigid_blocks().block(0);
  const auto &b = quadratic.model->rigid_blocks().block(0);
  EXPECT_NEAR(b.mass, a.mass, 1e-12 * a.mass);
  EXPECT_NEAR(b.inertia, a.inertia, 1e-12 * a.inertia);
  for (unsigned int d = 0; d < 2; ++d)
    EXPECT_NEAR(b.centre[d], a.centre[d], 1e-12);
  // The rule of three midsides is exact for squares, unlike that of corners.
  EXPECT_NEAR(b.lumped_inertia, b.inertia, 1e-12 * b.inertia);
  EXPECT_GT(a.lumped_inertia, 1.05 * a.inertia);
}

TEST(QuadraticModel, PlatensHaveTheCentreOfTheirGroup)
{
  const Stack stack(true);
  State<2> state = stack.model->initial_state();
  Platen plate(platen("plate", "upper", {}, {}, {}), stack.nodes);
  plate.prepare(state);
  plate.set_mass(stack.model->mass());
  plate.begin_stage(state, false);
  EXPECT_NEAR(state.get<PlatenState>("plate").centre[0], 1.5 + 0.2 * 3., 1e-12);
  EXPECT_NEAR(state.get<PlatenState>("plate").centre[1], 3., 1e-12);
}
