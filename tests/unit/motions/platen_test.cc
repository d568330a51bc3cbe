// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"
#include "boundary_square.h"

#include <quoin/mesh/block_splitter.h>
#include <quoin/motions/platen.h>
#include <quoin/motions/platen_bearing.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;
using quoin::test::BoundarySquare;

namespace
{
  /** All of the block, with what moves x, y and its rotation. */
  struct HeldBlock : BoundarySquare
  {
    Platen platen;

    HeldBlock(const LoadComponent &x, const LoadComponent &y,
              const LoadComponent &rotation, const std::string &boundary = "")
      : platen(parameters(x, y, rotation, boundary), nodes)
    {
      platen.prepare(state);
      platen.set_mass(mass);
      platen.begin_stage(state, false);
    }

    static LoadParameters parameters(const LoadComponent &x,
                                     const LoadComponent &y,
                                     const LoadComponent &rotation,
                                     const std::string &boundary)
    {
      LoadParameters result;
      result.name = "plate";
      if (boundary.empty())
        result.groups = { "rock" };
      else
        result.boundaries = { boundary };
      result.components = { { x, y, rotation } };
      return result;
    }

    std::array<double, 3> resultant() const
    {
      return platen.MotionConstraint<2>::resultant();
    }

    /** Of the masses, 2, 1, 2 and 1 kg, at the corners [kg m^2]. */
    static double inertia()
    {
      return 6. * (1.5 * 1.5 + 0.5 * 0.5);
    }
  };

  const std::vector<dealii::Tensor<1, 2>> no_forces(4, dealii::Tensor<1, 2>());
} // namespace

// 12 N on 6 kg, 30 N m about the middle of the block, from its loads and from
// a couple of forces of its nodes; leap-frog from rest.
TEST(Platen, ForcesAndMomentsAccelerateItsMass)
{
  HeldBlock block(BoundarySquare::component(LoadQuantity::force, "12"), {},
                  BoundarySquare::component(LoadQuantity::force, "20"));
  // 5 N up on the right end, down on the left one, arms of 1.5 m
  std::vector<dealii::Tensor<1, 2>> forces = no_forces;
  forces[1][1]                             = 10. / 3.;
  forces[3][1]                             = -10. / 3.;
  block.capture(block.platen, forces);
  block.move(block.platen);
  const PlatenState &now = block.state.get<PlatenState>("plate");
  EXPECT_NEAR(now.velocity[0], 12. / 6. * block.dt, 1e-15);
  EXPECT_NEAR(now.velocity[1], 0., 1e-15);
  EXPECT_NEAR(now.velocity[2], 30. / block.inertia() * block.dt, 1e-15);
  // The nodes turn about the middle, (2.5, 2.5); within the step their arms
  // turn by 2e-6.
  EXPECT_NEAR(block.state.velocity[2][0],
              now.velocity[0] - 0.5 * now.velocity[2], 1e-8);
  EXPECT_NEAR(block.state.velocity[2][1], 1.5 * now.velocity[2], 1e-8);
  // All the work is that of the loads.
  EXPECT_NEAR(block.state.pending.external,
              0.5 * block.dt * (12. * now.velocity[0] + 20. * now.velocity[2]),
              1e-15);
  EXPECT_EQ(block.resultant()[0], 12.);
  EXPECT_EQ(block.resultant()[2], 20.);
}

// 90 degrees in a step: the corners change places, and the moment is what
// their inertia needs.
TEST(Platen, ARotationIsGivenInDegrees)
{
  HeldBlock block(
      {}, {}, BoundarySquare::component(LoadQuantity::displacement, "9e4 * t"));
  block.capture(block.platen, no_forces);
  block.move(block.platen);
  const double corners[4][2]
      = { { 3., 1. }, { 3., 4. }, { 2., 4. }, { 2., 1. } };
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_NEAR(block.mesh.vertices[i][d] + block.state.nodes[i].u[d],
                  corners[i][d], 1e-12);
  EXPECT_NEAR(block.resultant()[2],
              block.inertia() * (0.5 * M_PI / block.dt) / block.dt, 1e-3);
}

// It takes over the momentum and the spin of its nodes.
TEST(Platen, TakesOverTheMotionOfItsNodes)
{
  HeldBlock block({}, {}, {});
  for (unsigned int i = 0; i < 4; ++i)
  {
    const double x          = block.mesh.vertices[i][0] - 2.5;
    const double y          = block.mesh.vertices[i][1] - 2.5;
    block.state.velocity[i] = dealii::Point<2>(4. - 3. * y, -1. + 3. * x);
  }
  block.platen.begin_stage(block.state, false);
  const PlatenState &now = block.state.get<PlatenState>("plate");
  EXPECT_NEAR(now.velocity[0], 4., 1e-14);
  EXPECT_NEAR(now.velocity[1], -1., 1e-14);
  EXPECT_NEAR(now.velocity[2], 3., 1e-14);
  // Without forces it keeps them.
  block.capture(block.platen, no_forces);
  block.move(block.platen);
  EXPECT_NEAR(now.velocity[2], 3., 1e-14);
  EXPECT_NEAR(now.displacement[0], 4. * block.dt, 1e-15);
}

// The bottom, 3 m with 2 kg on the left and 1 kg on the right: its force acts
// in the middle, 0.5 m from the centre of mass, about which it has 2 * 1 + 1 *
// 4 kg m^2.
TEST(Platen, ForcesOnABoundaryActInItsMiddle)
{
  HeldBlock block({}, BoundarySquare::component(LoadQuantity::force, "12"), {},
                  "bottom");
  block.capture(block.platen, no_forces);
  block.move(block.platen);
  const PlatenState &now = block.state.get<PlatenState>("plate");
  const double turns     = 12. * 0.5 / 6. * block.dt;
  EXPECT_NEAR(now.centre[0], 2.5, 1e-15);
  EXPECT_NEAR(now.velocity[2], turns, 1e-15);
  EXPECT_NEAR(now.velocity[1], 12. / 3. * block.dt + 0.5 * turns, 1e-15);
  EXPECT_NEAR(block.state.velocity[0][1], 12. / 3. * block.dt - turns, 1e-8);
  EXPECT_NEAR(block.state.velocity[1][1], 12. / 3. * block.dt + 2. * turns,
              1e-8);
}

// Two blocks of 1 m side by side, of which one is three times as thick: a
// uniform pressure on both acts in their middle.
TEST(Platen, TheMiddleOfABoundaryIsThatOfItsArea)
{
  MeshData<2> data;
  test::add_grid(data, 1, 1, "thin", 0., 0.);
  test::add_curve(data, "bottom", 0., 0., 1., 0.);
  test::add_grid(data, 1, 1, "thick", 1., 0.);
  test::add_curve(data, "bottom", 1., 0., 2., 0.);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  const test::TestNodes nodes(mesh);
  const LoadParameters load = HeldBlock::parameters({}, {}, {}, "bottom");
  const auto found          = platen_nodes<2>(load, nodes);
  const auto areas
      = platen_areas<2>(load, nodes, found, Thickness({ 0.5, 1.5 }));
  double total = 0., middle = 0.;
  for (unsigned int i = 0; i < found.size(); ++i)
  {
    total += areas[i];
    middle += areas[i] * nodes->point(found[i])[0];
  }
  EXPECT_NEAR(total, 2., 1e-12);
  EXPECT_NEAR(middle / total, 1.25, 1e-12);
}

// A boundary that is turned about its middle and free to move else wobbles
// about its centre of mass, which stays where it is.
TEST(Platen, ABoundaryTurnsAboutItsCentreOfMass)
{
  HeldBlock block({}, {},
                  BoundarySquare::component(LoadQuantity::velocity, "36e3 * t"),
                  "bottom");
  const auto centre_of_mass = [&]()
  {
    return 2. / 3. * (block.mesh.vertices[0] + block.state.nodes[0].u)
           + 1. / 3. * (block.mesh.vertices[1] + block.state.nodes[1].u);
  };
  const auto before = centre_of_mass();
  for (unsigned int i = 0; i < 200; ++i)
  {
    block.step.begin  = { i * block.dt, i * block.dt };
    block.step.middle = { (i + 0.5) * block.dt, (i + 0.5) * block.dt };
    block.capture(block.platen, no_forces);
    block.move(block.platen);
  }
  // Two turns; a step turns it by up to 7 degrees.
  EXPECT_NEAR((centre_of_mass() - before).norm(), 0., 5e-3);
}

// The same on the top of a block of the last rank, on another one of the first,
// which has none of its nodes and books the work.
TEST(PlatensOfRanks, ABoundaryTurnsAboutItsCentreOfMassOnEachRank)
{
  const MPI_Comm world    = MPI_COMM_WORLD;
  const unsigned int last = dealii::Utilities::MPI::n_mpi_processes(world) - 1;
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(world) == 0;
  BlockMesh<2> mesh   = BoundarySquare().mesh;
  mesh.boundary_faces.clear();
  mesh.vertices.insert(mesh.vertices.end(),
                       { { 1., 3. }, { 4., 3. }, { 4., 4. }, { 1., 4. } });
  mesh.cells.insert(mesh.cells.end(), { { { 4, 5, 6 } }, { { 4, 6, 7 } } });
  mesh.cell_group.resize(4, 0);
  mesh.block_first_cell.push_back(4);
  mesh.block_first_vertex.push_back(8);
  mesh.boundary_faces.push_back({ { { 6, 7 } }, 3, 3 });
  const BlockTriangulation<2> blocks(mesh, { 0, 0, last, last },
                                     { false, false }, world);
  const NodeMap<2> nodes(blocks);

  State<2> state;
  std::vector<double> mass;
  for (unsigned int i = 0; i < nodes.n_local(); ++i)
  {
    state.nodes.emplace_back();
    for (const unsigned int d : { 0, 1 })
      state.nodes[i].X[d] = nodes.point(i)[d];
    mass.push_back(nodes.point(i)[0] < 2.5 ? 2. : 1.);
  }
  state.velocity.assign(nodes.n_local(), dealii::Tensor<1, 2>());
  Platen platen(
      HeldBlock::parameters(
          {}, BoundarySquare::component(LoadQuantity::force, "12"), {}, "top"),
      nodes);
  EXPECT_EQ(platen.nodes().size(), last > 0 && is_first ? 0U : 2U);
  platen.prepare(state);
  platen.set_mass(mass);
  platen.begin_stage(state, false);

  std::vector<CapturedNode<2>> captured;
  std::vector<unsigned int> positions;
  for (const unsigned int node : platen.nodes())
  {
    positions.push_back(captured.size());
    captured.emplace_back();
    captured.back().node = node;
    captured.back().mass = mass[node];
  }
  platen.bind(positions);
  StepContext step{};
  constexpr double dt = BoundarySquare::dt;
  step.dt = step.dt_before = step.dt_velocity = dt;
  step.load_rate                              = 1.;
  platen.correct(step, captured, state);
  platen.account(step, captured, state);
  const PlatenState &now = state.get<PlatenState>("plate");
  EXPECT_NEAR(now.velocity[1], 4.5 * dt, 1e-15);
  EXPECT_NEAR(now.velocity[2], dt, 1e-15);
  EXPECT_NEAR(state.pending.external, is_first ? 0.5 * dt * 12. * 4.5 * dt : 0.,
              1e-15);
}

// The bottom, whose outward normal is down: one node presses, the other hangs.
TEST(Platen, PullsWhereAPlateWouldOpen)
{
  const LoadComponent still
      = BoundarySquare::component(LoadQuantity::velocity, "0");
  const LoadComponent moved
      = BoundarySquare::component(LoadQuantity::velocity, "0*t");
  HeldBlock block(moved, still, still, "bottom");
  std::vector<dealii::Tensor<1, 2>> forces = no_forces;
  forces[0][1]                             = -5.;
  forces[1][1]                             = 3.;
  block.capture(block.platen, forces);
  block.move(block.platen);
  const RigidMotion<2> &body = *block.platen.rigid_motion();
  ASSERT_TRUE(body.bears());
  const auto bearing = platen_bearing<2>(
      body.normals(block.state), body.node_forces(),
      { block.mesh.vertices[0], block.mesh.vertices[1] }, MPI_COMM_SELF);
  EXPECT_NEAR(bearing.pressed, 5., 1e-12);
  EXPECT_NEAR(bearing.pulled, 3., 1e-12);
  EXPECT_NEAR(bearing.tension, 3. / 1.5, 1e-12);
  EXPECT_EQ(bearing.place, block.mesh.vertices[1]);
  // One that stands still is a support, and a group has joints around it.
  EXPECT_FALSE(
      HeldBlock(still, still, {}, "bottom").platen.rigid_motion()->bears());
  EXPECT_FALSE(HeldBlock(moved, still, {}).platen.rigid_motion()->bears());
}

// A quarter of a turn: normals turn, too.
TEST(Platen, NormalsTurnWithIt)
{
  const LoadComponent still
      = BoundarySquare::component(LoadQuantity::velocity, "0");
  HeldBlock block(
      still, still,
      BoundarySquare::component(LoadQuantity::displacement, "9e4 * t"),
      "bottom");
  block.capture(block.platen, no_forces);
  block.move(block.platen);
  for (const auto &normal : block.platen.normals(block.state))
  {
    EXPECT_NEAR(normal[0], 1.5, 1e-12);
    EXPECT_NEAR(normal[1], 0., 1e-12);
  }
}
