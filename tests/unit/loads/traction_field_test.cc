// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"
#include "../mesh/space_box.h"
#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace quoin;
using quoin::test::TestNodes;

namespace
{
  constexpr double thickness = 0.5;

  /** A block of 3 m by 1 m in two triangles, with curves "right" and "top". */
  struct Rectangle
  {
    const BlockMesh<2> mesh = quoin::test::rectangle(
        0., 0., 3., 1., { "", "right", "top" }, { 0, 1, 2, 0 });
    const TestNodes nodes{ mesh };

    NodalLoad<2> load(const std::string &text) const
    {
      return { read_named_section<LoadParameters>(
                   "push", "set Type = traction\n" + text),
               nodes, std::vector<double>(4, 1.), thickness };
    }
  };

  /** Forces on the four nodes, their resultant and moment about the origin. */
  struct Forces
  {
    Forces(const Rectangle &rectangle, const NodalLoad<2> &load,
           const TimePoint &time)
      : at(4, dealii::Tensor<1, 2>())
    {
      load.add_loads(time, at.data());
      for (unsigned int i = 0; i < 4; ++i)
      {
        const auto &p = rectangle.mesh.vertices[i];
        x += at[i][0];
        y += at[i][1];
        moment += p[0] * at[i][1] - p[1] * at[i][0];
      }
    }
    std::vector<dealii::Tensor<1, 2>> at;
    double x = 0., y = 0., moment = 0.;
  };
} // namespace

// gamma h^2 / 2 at a third of the depth, and the rectangle beyond the top.
TEST(TractionField, WaterAtRestHasItsResultantAndMoment)
{
  const Rectangle rectangle;
  const NodalLoad<2> load = rectangle.load("set Boundary = right\n"
                                           "set Pressure = water 0.4 + t\n");
  for (const double level : { 0.4, 0.7, 1., 2.5 })
  {
    const Forces forces(rectangle, load, { level - 0.4, 77. });
    const double above = std::max(level - 1., 0.), below = level - above;
    const double force
        = weight_of_water * thickness * (0.5 * below * below + above * below);
    const double moment
        = weight_of_water * thickness
          * (below * below * below / 6. + 0.5 * above * below * below);
    EXPECT_NEAR(forces.x, -force, 1e-11 * force);
    EXPECT_NEAR(forces.y, 0., 1e-11 * force);
    EXPECT_NEAR(forces.moment, moment, 1e-11 * force);
  }
  EXPECT_EQ(Forces(rectangle, load, { -0.5, 0. }).x, 0.);
  EXPECT_NE(load.amplitude({ 0., 0. }), load.amplitude({ 1., 1. }));
}

// Levels over the joint: 2 m at the heel, 1 m at the drains, 0.5 m at the toe.
TEST(TractionField, UpliftWithDrainsHasItsResultantAndMoment)
{
  const Rectangle rectangle;
  const NodalLoad<2> load = rectangle.load("set Boundary = top\n"
                                           "set Pressure = uplift\n"
                                           "set Headwater = 3 * t\n"
                                           "set Tailwater = 1.5\n"
                                           "set Heel = 0, 1\n"
                                           "set Toe = 3, 1\n"
                                           "set Drain distance = 1\n"
                                           "set Drain efficiency = 0.5\n");
  const Forces forces(rectangle, load, { 1., 5. });
  EXPECT_NEAR(forces.y, -weight_of_water * thickness * 3., 1e-8);
  EXPECT_NEAR(forces.moment, -weight_of_water * thickness * 3.5, 1e-8);
  // The same level everywhere.
  EXPECT_NEAR(Forces(rectangle, load, { 0.5, 5. }).y,
              -weight_of_water * thickness * 1.5, 1e-8);
}

// The consistent forces of q = (2 + 3 x) t: those of its two end values.
TEST(TractionField, FunctionOfPlaceAndTime)
{
  const Rectangle rectangle;
  const NodalLoad<2> load
      = rectangle.load("set Boundary = top\n"
                       "set Vertical = -(2 + 3*x) * t\n"
                       "set Horizontal = 5 * (T - t) * y\n");
  const Forces forces(rectangle, load, { 4., 10. });
  const double left = 4. * 2., right = 4. * 11.;
  EXPECT_NEAR(forces.at[3][1], -thickness * 3. * (left / 3. + right / 6.),
              1e-12);
  EXPECT_NEAR(forces.at[2][1], -thickness * 3. * (left / 6. + right / 3.),
              1e-12);
  EXPECT_NEAR(forces.x, thickness * 3. * 5. * 6., 1e-12);
  EXPECT_EQ(forces.at[0][1], 0.);

  // Power of a node that moves alone.
  std::vector<dealii::Tensor<1, 2>> velocity(4, dealii::Tensor<1, 2>());
  velocity[2][1] = 2.;
  EXPECT_NEAR(load.external_power({ 4., 10. }, velocity.data()),
              2. * forces.at[2][1], 1e-12);
  EXPECT_NE(load.amplitude({ 4., 10. }), load.amplitude({ 4.1, 10.1 }));
}

// The force is traction times width times thickness, and acts at the centre,
// whatever the shape; what has not come upon the boundary does not act.
TEST(TractionField, MovingShapesHaveTheirResultantEverywhere)
{
  const Rectangle rectangle;
  for (const std::string shape : { "uniform", "triangular", "cosine" })
  {
    const NodalLoad<2> load
        = rectangle.load("set Boundary = top\nset Vertical = -7\n"
                         "set Moving width = 0.6\n"
                         "set Moving centre = -1 + 2*t\nset Moving shape = "
                         + shape + "\n");
    const double force = 7. * 0.6 * thickness;
    const double error = shape == "cosine" ? 1e-5 : 1e-13;
    for (const double centre : { 0.31, 0.7, 1.234567, 2.69 })
    {
      const Forces forces(rectangle, load, { 0.5 * (centre + 1.), 0. });
      EXPECT_NEAR(forces.y, -force, error * force) << shape << centre;
      EXPECT_NEAR(forces.moment, -force * centre, 3. * error * force)
          << shape << centre;
      EXPECT_EQ(forces.x, 0.);
    }
    EXPECT_EQ(Forces(rectangle, load, { 0., 0. }).y, 0.);
    EXPECT_NEAR(Forces(rectangle, load, { 0.5, 0. }).y, -0.5 * force,
                error * force);
    EXPECT_EQ(Forces(rectangle, load, { 3., 0. }).y, 0.);
    // It changes as long as it moves.
    EXPECT_NE(load.amplitude({ 0., 0. }), load.amplitude({ 1e-3, 0. }));
  }
}

TEST(TractionField, SeveralAxlesMoveTogether)
{
  const Rectangle rectangle;
  const NodalLoad<2> load
      = rectangle.load("set Boundary = top\nset Vertical = -7\n"
                       "set Moving width = 0.2\nset Moving shape = uniform\n"
                       "set Moving centre = t; t + 1\n"
                       "set Distribution = 1 + x\n");
  const Forces forces(rectangle, load, { 0.5, 0. });
  const double force = 7. * 0.2 * thickness;
  EXPECT_NEAR(forces.y, -force * (1.5 + 2.5), 1e-13);
}

// Resultants and moments of functions with kinks and jumps within an edge of
// 3 m: those of triangles and rectangles; and of one that has neither.
TEST(TractionField, FunctionsOfPlaceMayHaveKinksAndJumps)
{
  const Rectangle rectangle;
  const auto forces = [&](const std::string &q)
  {
    return Forces(
        rectangle,
        rectangle.load("set Boundary = top\nset Vertical = " + q + "\n"),
        { 1., 1. });
  };
  const double a    = 1.234567;
  const Forces rise = forces("max(0, x - 1.234567)");
  const double size = 0.5 * (3. - a) * (3. - a) * thickness;
  EXPECT_NEAR(rise.y, size, 1e-6 * size);
  EXPECT_NEAR(rise.moment, size * (a + 2. * (3. - a) / 3.), 3e-6 * size);
  const Forces step = forces("if(x < 1.234567, 2, 0)");
  EXPECT_NEAR(step.y, 2. * a * thickness, 1e-3 * 2. * a * thickness);
  EXPECT_NEAR(step.moment, a * a * thickness, 1e-3 * a * a * thickness);
  const Forces wave = forces("1 + sin(7*x)");
  const double sum  = (3. + (1. - std::cos(21.)) / 7.) * thickness;
  EXPECT_NEAR(wave.y, sum, 1e-6 * sum);
  // no kink next to the largest value
  const Forces flat = forces("1e6 + abs(x - 0.7)");
  EXPECT_NEAR(flat.y, 1e6 * 3. * thickness, 1e-5 * 1e6);
}

// On the sides of a cube of 1 m: resultants, and the moments of a linear
// traction; those with kinks and jumps are exact to what the parts of faces
// resolve.
TEST(TractionField, InThreeDimensions)
{
  BlockMesh<3> mesh = quoin::test::box_mesh({ 2, 2, 2 }, 0.5);
  const BlockTriangulation<3> blocks(
      mesh, std::vector<unsigned int>(mesh.n_cells(), 0), { false },
      MPI_COMM_SELF);
  const NodeMap<3> nodes(blocks);
  // Sums of f, and of x f_z, y f_z and z f_x.
  const auto sums = [&](const std::string &text)
  {
    const auto parameters = read_named_section<LoadParameters>(
        "push", "set Type = traction\n" + text);
    const NodalLoad<3> load(parameters.along_axes<3>(), nodes,
                            std::vector<double>(nodes.n_owned(), 1.), 1.);
    std::vector<dealii::Tensor<1, 3>> force(nodes.n_local(),
                                            dealii::Tensor<1, 3>());
    load.add_loads({ 0., 0. }, force.data());
    std::array<double, 6> result{};
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
    {
      const auto &p = nodes.point(i);
      for (unsigned int d = 0; d < 3; ++d)
        result[d] += force[i][d];
      result[3] += p[0] * force[i][2];
      result[4] += p[1] * force[i][2];
      result[5] += p[2] * force[i][0];
    }
    return result;
  };
  const auto linear
      = sums("set Boundary = z1\nset Vertical = -(1 + x + 2*y)*z\n");
  EXPECT_NEAR(linear[2], -2.5, 1e-13);
  EXPECT_NEAR(linear[3], -(0.5 + 1. / 3. + 0.5), 1e-13);
  EXPECT_NEAR(linear[4], -(0.5 + 0.25 + 2. / 3.), 1e-13);
  EXPECT_EQ(linear[0], 0.);

  const auto full = sums("set Boundary = x0\nset Pressure = water 1\n");
  EXPECT_NEAR(full[0], weight_of_water / 2., 1e-10 * weight_of_water);
  EXPECT_NEAR(full[5], weight_of_water / 6., 1e-10 * weight_of_water);
  const auto part = sums("set Boundary = x0\nset Pressure = water 0.8\n");
  EXPECT_NEAR(part[0], weight_of_water * 0.32, 1e-3 * weight_of_water * 0.32);
  const auto same
      = sums("set Boundary = x0\nset Pressure = 9810 * max(0, 0.8 - z)\n");
  EXPECT_NEAR(same[0], weight_of_water * 0.32, 1e-3 * weight_of_water * 0.32);
  const auto jump
      = sums("set Boundary = x0\nset Pressure = if(z < 0.8, 2, 0)\n");
  EXPECT_NEAR(jump[0], 1.6, 2e-2 * 1.6);
  const auto quadratic = sums("set Boundary = x0\nset Pressure = z * y\n");
  EXPECT_NEAR(quadratic[0], 0.25, 1e-13);
  // (0.2 + 0.8 x)^2 / 2 at each x.
  const auto line
      = sums("set Boundary = y0\nset Pressure = water through 0, 0.2; 1, 1\n");
  EXPECT_NEAR(line[1], weight_of_water * 0.992 / 4.8,
              1e-3 * weight_of_water * 0.2);

  const auto moving = sums("set Boundary = z1\nset Vertical = -3\n"
                           "set Moving shape = cosine\n"
                           "set Moving width = 0.6\nset Moving centre = 0.4\n"
                           "set Moving axis = y\n");
  EXPECT_NEAR(moving[2], -1.8, 2e-3 * 1.8);
  EXPECT_NEAR(moving[4], -0.4 * 1.8, 2e-3 * 1.8);
}

TEST(TractionField, InitialStressByPlace)
{
  const auto load = read_named_section<LoadParameters>(
      "ground", "set Type = initial stress\n"
                "set Stress = 1e3*x; -2e3*y*y; 5\nset Stress zz = 7*x*y\n");
  const auto stress = load.initial_stress(2., 3., 0.25);
  EXPECT_EQ(stress[0], 2e3);
  EXPECT_EQ(stress[1], -18e3);
  EXPECT_EQ(stress[2], 5.);
  EXPECT_EQ(stress[3], 42.);
}

TEST(TractionField, WrongText)
{
  const auto refused = [](const std::string &text, const std::string &setting,
                          const std::string &why)
  {
    expect_section_refused(
        "push", setting + "' ", why,
        [&] { read_named_section<LoadParameters>("push", text); });
  };
  const std::string top = "set Type = traction\nset Boundary = top\n";
  refused(top + "set Vertical = x + z*T\n", "Vertical = x + z*T",
          "both z and T");
  refused(top + "set Vertical = x + q\n", "Vertical = x + q",
          "x, y, z, t and T");
  refused(top + "set Pressure = water y\n", "Pressure = water y",
          "differs from place to place");
  refused(top + "set Vertical = 1\nset Moving shape = cosine\n",
          "Moving centre = ", "2 + 10*t");
  refused(top
              + "set Vertical = 1\nset Moving shape = cosine\n"
                "set Moving centre = t\n",
          "Moving width = 0", "must be positive");
  refused(top + "set Vertical = 1\nset Moving centre = t\n",
          "Moving centre = t", "has no effect with 'Moving shape = none'");
  refused("set Type = gravity\nset Vertical = -9.81*y\n", "Vertical = -9.81*y",
          "'Distribution'");
  refused("set Type = initial stress\nset Stress = x; y\n", "Stress = x; y",
          "three expressions");
  refused("set Type = initial stress\nset Stress = x; y; t\n",
          "Stress = x; y; t", "depends on time");
}
