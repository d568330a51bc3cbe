// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../mesh/test_nodes.h"

#include <quoin/farfield/far_field.h>

#include <gtest/gtest.h>

using namespace quoin;
using quoin::test::TestNodes;

namespace
{
  constexpr double length    = 3.; /**< [m] */
  constexpr double thickness = 0.5;
  constexpr unsigned int n   = 60; /**< elements and edges */
  constexpr double element   = length / n;
  const ElasticMedium medium{ 2000., 400., 200. };

  /**
   * The upper side of a block, from (0, 0) to (3, 0), with so much mass that
   * nothing changes its velocity, and boundary elements above it, one to an
   * edge, whose P waves cross one in a step.
   */
  struct HeavyBlock
  {
    const TestNodes nodes{ mesh() };
    State<2> state;
    StepContext step{};
    std::vector<CapturedNode<2>> captured;
    std::unique_ptr<FarField> far;

    HeavyBlock()
    {
      std::vector<dealii::Point<2>> points;
      for (unsigned int i = 0; i <= n; ++i)
        points.emplace_back(element * i, 0.);
      FarFieldDomain domain;
      domain.boundary.add_curve(points, false);
      domain.medium = medium;
      for (unsigned int k = 0; k < n; ++k)
        domain.interface.push_back(k);
      far     = std::make_unique<FarField>("beyond", std::move(domain), nodes,
                                       gather_faces(*nodes, { false, true }),
                                       thickness);
      step.dt = step.dt_before = step.dt_velocity = element / medium.c1;
      state.nodes.resize(nodes->n_local());
      state.velocity.resize(nodes->n_local());
      for (unsigned int i = 0; i < nodes->n_local(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          state.nodes[i].X[d] = nodes->point(i)[d];
      far->set_time_step(step.dt, 1, 100);
      far->prepare(state);
      far->begin_stage(state, false);
    }

    /** The block below the side, all cells of which meet at its foot. */
    static BlockMesh<2> mesh()
    {
      BlockMesh<2> result;
      result.group_names        = { "rock" };
      result.face_names         = { "", "side" };
      result.block_first_cell   = { 0, n };
      result.block_first_vertex = { 0, n + 2 };
      for (unsigned int i = 0; i <= n; ++i)
        result.vertices.emplace_back(element * i, 0.);
      result.vertices.emplace_back(0.5 * length, -1.);
      for (unsigned int k = 0; k < n; ++k)
      {
        result.boundary_faces.push_back({ { { k + 1, k } }, k, 1 });
        result.cells.push_back({ { n + 1, k + 1, k } });
        result.cell_group.push_back(0);
      }
      result.boundary_faces.push_back({ { { 0, n + 1 } }, 0, 0 });
      result.boundary_faces.push_back({ { { n + 1, n } }, n - 1, 0 });
      return result;
    }

    void move(const dealii::Tensor<1, 2> &velocity)
    {
      std::vector<unsigned int> positions;
      captured.clear();
      for (const unsigned int node : far->nodes())
      {
        positions.push_back(captured.size());
        CapturedNode<2> before{};
        before.node         = node;
        before.mass         = 1e15;
        before.velocity     = velocity;
        before.displacement = state.nodes[node].u;
        before.owner[0] = before.owner[1] = far.get();
        captured.push_back(before);
      }
      far->bind(positions);
      far->correct(step, captured, state);
      far->account(step, captured, state);
    }
  };
} // namespace

// Before waves from the ends matter: rho c1 v along the normal, rho c2 v along
// the side; what is missing are the ends, some elements of 60.
TEST(FarField, ResistsMotionByTheImpedanceOfWhatIsBeyond)
{
  for (const unsigned int d : { 0U, 1U })
  {
    HeavyBlock block;
    dealii::Tensor<1, 2> velocity;
    velocity[d]         = 0.1;
    const double c      = d == 1 ? medium.c1 : medium.c2;
    const double wanted = -medium.density * c * 0.1 * length * thickness;
    for (unsigned int i = 0; i < 3; ++i)
    {
      block.move(velocity);
      EXPECT_NEAR(block.far->resultant()[d] / wanted, 1., 0.05) << d << i;
      EXPECT_NEAR(block.far->resultant()[1 - d] / wanted, 0., 0.02);
      // about the origin, from the middle of the side
      EXPECT_NEAR(block.far->resultant()[2] / wanted,
                  d == 1 ? 0.5 * length : 0., 0.05);
    }
    // Over three steps: what the blocks do against it leaves as waves.
    const double work = -wanted * 0.1 * 3. * block.step.dt;
    EXPECT_NEAR((block.state.energy.radiated + block.state.pending.radiated)
                    / work,
                1., 0.05);
    EXPECT_NEAR((block.state.energy.external + block.state.pending.external)
                    / work,
                0., 1e-9);
    // The elements' own books say the same.
    EXPECT_NEAR(block.state.get<FarFieldState>().ledger.radiated / work, 1.,
                0.05);
    EXPECT_LT(block.state.get<FarFieldState>().ledger.mismatch, 1e-9);
  }
}

// Blocks that move as the wave that comes in send nothing back: then the wave
// pushes on them with its own traction. A step moves them until half a step
// later.
TEST(FarField, AWaveThatTheBlocksFollowIsNotScattered)
{
  HeavyBlock block;
  // upwards through the side, v = 0.1 m/s: traction -rho c1 v on the domain
  const Eigen::Index size = 2 * n;
  const double step       = block.step.dt;
  block.far->set_incident_field(
      [=](const double t)
      {
        Eigen::VectorXd u = Eigen::VectorXd::Zero(size);
        for (unsigned int e = 0; e < n; ++e)
          u[2 * e + 1] = 0.1 * (t + 0.5 * step);
        return u;
      },
      [=](double, double)
      {
        Eigen::VectorXd p = Eigen::VectorXd::Zero(size);
        for (unsigned int e = 0; e < n; ++e)
          p[2 * e + 1] = 7e3;
        return p;
      });
  for (unsigned int i = 0; i < 3; ++i)
  {
    block.move(dealii::Point<2>(0., 0.1));
    EXPECT_NEAR(block.far->resultant()[1], -7e3 * length * thickness, 1e-3);
  }
  EXPECT_NEAR(block.state.energy.radiated + block.state.pending.radiated, 0.,
              1e-9);
}
