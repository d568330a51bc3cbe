// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/mesh/block_splitter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** A rectangle of 3 m by 1 m, the block inside, whose curve is "wall". */
  struct Rectangle
  {
    const BlockMesh<2> mesh
        = rectangle(0., 0., 3., 1., { "", "wall", "right" }, { 1, 2, 1, 1 });
    const TestNodes nodes{ mesh };

    NodalLoad<2> load(const std::vector<std::string> &curves,
                      const std::string &pressure, const double thickness) const
    {
      LoadParameters parameters;
      parameters.name       = "charge";
      parameters.boundaries = curves;
      parameters.pressure
          = { LoadQuantity::force, TimeFunction(pressure, "./") };
      return { parameters, nodes, std::vector<double>(4, 1.), thickness };
    }
  };
} // namespace

TEST(NodalLoad, GravityGrowsWhereItBegins)
{
  const Rectangle rectangle;
  LoadParameters parameters;
  parameters.type          = LoadType::gravity;
  parameters.components[1] = { LoadQuantity::force, TimeFunction("-8", "./") };
  for (const double given : { -1., 0., 4. })
  {
    parameters.ramp_duration = given;
    NodalLoad<2> load(parameters, rectangle.nodes, std::vector<double>(4, 1.),
                      1.);
    const auto at = [&](const double t) {
      return load.amplitude({ t, 10. + t })[1];
    };
    EXPECT_EQ(at(0.), -8.);
    load.begin_stage(true, { load.ramp_where_begun(2.), 0. });
    const double duration = given < 0. ? 2. : given;
    EXPECT_EQ(at(0.), duration > 0. ? 0. : -8.);
    EXPECT_NEAR(at(0.25 * duration),
                duration > 0. ? -4. + 2. * std::sqrt(2.) : -8., 1e-14);
    EXPECT_EQ(at(duration), -8.);
    load.begin_stage(false, {}); // it has been there before
    EXPECT_EQ(at(0.), -8.);
  }
}

TEST(NodalLoad, PressurePushesOnTheBlock)
{
  const Rectangle rectangle;
  const NodalLoad<2> load = rectangle.load({ "right" }, "2 * t", 0.5);
  std::vector<dealii::Tensor<1, 2>> force(4, dealii::Tensor<1, 2>());
  load.add_loads({ 3., 3. }, force.data());
  for (const unsigned int node : { 1U, 2U })
  {
    EXPECT_DOUBLE_EQ(force[node][0], -6. * 0.5 * 0.5);
    EXPECT_DOUBLE_EQ(force[node][1], 0.);
  }
  EXPECT_EQ(force[0][0], 0.);
}

TEST(NodalLoad, PressureAllAroundIsInBalanceAndDoesTheWorkOfVolume)
{
  const Rectangle rectangle;
  const NodalLoad<2> load = rectangle.load({ "wall", "right" }, "7", 2.);
  std::vector<dealii::Tensor<1, 2>> force(4, dealii::Tensor<1, 2>());
  load.add_loads({ 0., 0. }, force.data());
  double sum[2] = { 0., 0. };
  for (const dealii::Tensor<1, 2> &f : force)
    for (unsigned int d = 0; d < 2; ++d)
      sum[d] += f[d];
  EXPECT_NEAR(sum[0], 0., 1e-14);
  EXPECT_NEAR(sum[1], 0., 1e-14);
  // The area, 3 m^2, grows by 0.1 + 0.2 of itself a second.
  std::vector<dealii::Tensor<1, 2>> velocity;
  for (const auto &p : rectangle.mesh.vertices)
    velocity.push_back(dealii::Point<2>(0.1 * p[0], 0.2 * p[1]));
  EXPECT_NEAR(load.external_power({ 0., 0. }, velocity.data()),
              -7. * 2. * 3. * 0.3, 1e-13);
}

TEST(NodalLoad, DistributionIsAFactorByPlace)
{
  const Rectangle rectangle;
  LoadParameters parameters;
  parameters.name          = "triangle";
  parameters.type          = LoadType::gravity;
  parameters.components[0] = { LoadQuantity::force, TimeFunction("2", "./") };
  parameters.distribution  = SpaceTimeFunction("x + 10 * y", "./", 3);
  // Two triangles from (0, 0) to (3, 1), of a mass by area of one.
  std::vector<double> mass(4, 0.);
  for (const auto &cell : rectangle.mesh.cells)
    for (const unsigned int node : cell)
      mass[node] += 0.5;
  NodalLoad<2> load(parameters, rectangle.nodes, mass, 1.);
  // Also of a change of masses.
  for (const double density : { 1., 5. })
  {
    std::vector<double> changed = mass;
    for (double &m : changed)
      m *= density;
    load.set_mass(changed);
    std::vector<dealii::Tensor<1, 2>> force(4, dealii::Tensor<1, 2>());
    load.add_loads({ 0., 0. }, force.data());
    // Integrals of the distribution, and of it times x and y.
    std::array<double, 3> sums{};
    for (unsigned int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(force[i][1], 0.);
      sums[0] += force[i][0];
      for (unsigned int d = 0; d < 2; ++d)
        sums[d + 1] += force[i][0] * rectangle.mesh.vertices[i][d];
    }
    EXPECT_NEAR(sums[0], 2. * density * 19.5, 1e-13 * density);
    EXPECT_NEAR(sums[1], 2. * density * 31.5, 1e-13 * density);
    EXPECT_NEAR(sums[2], 2. * density * 12.25, 1e-13 * density);
  }
  // A pressure on the foot of 3 m, with its moment about its end.
  parameters.type          = LoadType::traction;
  parameters.boundaries    = { "wall" };
  parameters.components[0] = {};
  parameters.pressure      = { LoadQuantity::force, TimeFunction("1", "./") };
  parameters.distribution  = SpaceTimeFunction("if(y > 0.5, 0, x)", "./", 3);
  const NodalLoad<2> pressure(parameters, rectangle.nodes,
                              std::vector<double>(4, 1.), 1.);
  std::vector<dealii::Tensor<1, 2>> force(4, dealii::Tensor<1, 2>());
  pressure.add_loads({ 0., 0. }, force.data());
  EXPECT_NEAR(force[1][1], 3., 1e-14);
  EXPECT_NEAR(force[0][1], 1.5, 1e-14);
  EXPECT_EQ(force[2][1], 0.);
}

TEST(NodalLoad, PressureInAJointIsInBalanceWhateverTheThicknesses)
{
  MeshData<2> data;
  add_grid(data, 1, 1, "footing", 0., 0.);
  add_grid(data, 1, 1, "wall", 0., 1.);
  add_curve(data, "joint", 0., 1., 1., 1.);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  const TestNodes nodes(mesh);
  LoadParameters constant;
  constant.name        = "water";
  constant.boundaries  = { "joint" };
  constant.pressure    = { LoadQuantity::force, TimeFunction("8", "./") };
  LoadParameters level = constant; // 1 kPa at the joint
  level.pressure.field
      = std::make_shared<LoadField>(TimeFunction("1 + 8/9810", "./"));
  for (const LoadParameters &parameters : { constant, level })
  {
    const NodalLoad<2> load(parameters, nodes, std::vector<double>(8, 1.),
                            Thickness({ 0.6, 0.25 }));
    std::vector<dealii::Tensor<1, 2>> force(8, dealii::Tensor<1, 2>());
    load.add_loads({ 0., 0. }, force.data());
    double sum[2] = { 0., 0. }; // of both blocks
    for (unsigned int i = 0; i < 8; ++i)
    {
      sum[i < 4 ? 0 : 1] += force[i][1];
      EXPECT_NEAR(force[i][0], 0., 1e-12);
    }
    EXPECT_NEAR(std::abs(sum[0]), 8. * 0.25, 1e-9);
    EXPECT_NEAR(sum[0] + sum[1], 0., 1e-12);
    // Where the wall has gone the pressure has one side, of any thickness.
    const NodalLoad<2> even(parameters, nodes, std::vector<double>(8, 1.), 1.);
    State<2> state;
    EXPECT_FALSE(load.pressed_joints().have_bared_sides(state));
    state.block_marks = { 0, block_mark::removed };
    EXPECT_TRUE(load.pressed_joints().have_bared_sides(state));
    EXPECT_TRUE(load.pressed_joints().have_bared_sides(state, true));
    EXPECT_TRUE(even.pressed_joints().have_bared_sides(state));
    EXPECT_FALSE(even.pressed_joints().have_bared_sides(state, true));
    state.block_marks[0] = block_mark::removed;
    EXPECT_FALSE(even.pressed_joints().have_bared_sides(state));
  }
}

TEST(NodalLoad, GravityActsInItsGroupsAlone)
{
  // Two squares of one block each; the second one is the slab.
  BlockMesh<2> mesh;
  mesh.vertices = { { 0., 0. }, { 1., 0. }, { 1., 1. }, { 0., 1. },
                    { 1., 0. }, { 2., 0. }, { 2., 1. }, { 1., 1. } };
  mesh.cells
      = { { { 0, 1, 2 } }, { { 0, 2, 3 } }, { { 4, 5, 6 } }, { { 4, 6, 7 } } };
  mesh.cell_group         = { 0, 0, 1, 1 };
  mesh.block_first_cell   = { 0, 2, 4 };
  mesh.block_first_vertex = { 0, 4, 8 };
  mesh.group_names        = { "unit", "slab" };
  mesh.face_names         = { "" };
  LoadParameters parameters;
  parameters.name          = "floor";
  parameters.type          = LoadType::gravity;
  parameters.groups        = { "slab" };
  parameters.components[1] = { LoadQuantity::force, TimeFunction("-3", "./") };
  const std::vector<double> mass = { 1., 1., 1., 1., 2., 1., 2., 1. };
  {
    const TestNodes nodes(mesh);
    const NodalLoad<2> load(parameters, nodes, mass, Thickness({ 1., 1. }));
    std::vector<dealii::Tensor<1, 2>> force(8, dealii::Tensor<1, 2>());
    load.add_loads({ 0., 0. }, force.data());
    for (unsigned int i = 0; i < 8; ++i)
      EXPECT_DOUBLE_EQ(force[i][1], i < 4 ? 0. : -3. * mass[i]);
  }
  // One block of both groups has no weight of its own to be told apart.
  mesh.cells[2] = { { 1, 5, 6 } };
  mesh.cells[3] = { { 1, 6, 2 } };
  mesh.vertices.erase(mesh.vertices.begin() + 4);
  mesh.vertices.pop_back();
  for (unsigned int c : { 2U, 3U })
    for (unsigned int &v : mesh.cells[c])
      v = v > 4 ? v - 1 : v;
  mesh.block_first_cell   = { 0, 4 };
  mesh.block_first_vertex = { 0, 6 };
  const TestNodes nodes(mesh);
  EXPECT_THROW(NodalLoad<2>(parameters, nodes, std::vector<double>(6, 1.),
                            Thickness({ 1., 1. })),
               InputError);
}
