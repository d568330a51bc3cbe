// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/section_text.h"
#include "../mesh/space_box.h"
#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/loads/load_parameters.h>
#include <quoin/loads/nodal_load.h>

#include <cmath>
#include <string>
#include <vector>

using namespace quoin;
using quoin::test::TestNodes;

namespace
{
  constexpr double thickness = 0.5;

  template <int dim>
  using Places = std::vector<dealii::Point<dim>>;

  template <int dim>
  NodalLoad<dim> water_on(const NodeMap<dim> &nodes, const std::string &where,
                          const std::string &water)
  {
    const auto parameters = read_named_section<LoadParameters>(
        "water", "set Type = traction\nset Boundary = " + where
                     + "\nset Pressure = water " + water + "\n");
    return { parameters.along_axes<dim>(), nodes,
             std::vector<double>(nodes.n_local(), 1.), thickness };
  }

  /** A state whose nodes are at @p places. */
  template <int dim>
  State<dim> state_at(const NodeMap<dim> &nodes, const Places<dim> &places)
  {
    State<dim> state;
    state.nodes.resize(nodes.n_local());
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
      state.nodes[i] = { nodes.point(i), places[i] - nodes.point(i) };
    return state;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> forces_of(const NodalLoad<dim> &load,
                                                const Places<dim> &places)
  {
    std::vector<dealii::Tensor<1, dim>> force(places.size(),
                                              dealii::Tensor<1, dim>());
    load.add_loads({ 0., 0. }, force.data());
    return force;
  }

  /** The nodes turned by @p angle in the plane of x and the height, and
      moved. */
  template <int dim>
  Places<dim> moved(const NodeMap<dim> &nodes, const double angle,
                    const dealii::Tensor<1, dim> &by)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    Places<dim> places;
    for (unsigned int i = 0; i < nodes.n_local(); ++i)
    {
      const auto &X            = nodes.point(i);
      dealii::Point<dim> place = X;
      place[0]                 = c * X[0] - s * X[dim - 1];
      place[dim - 1]           = s * X[0] + c * X[dim - 1];
      places.push_back(place + by);
    }
    return places;
  }

  /** Holds the stiffness against differences of the forces. */
  template <int dim>
  void check_stiffness(const NodeMap<dim> &nodes, const std::string &where,
                       const std::string &water, const Places<dim> &places)
  {
    NodalLoad<dim> load  = water_on(nodes, where, water);
    State<dim> state     = state_at(nodes, places);
    const unsigned int n = dim * nodes.n_local();
    std::vector<double> stiffness(n * n, 0.);
    load.linearise(state, true,
                   [&](const ElementLinearisation<dim> &element)
                   {
                     for (unsigned int i = 0; i < dim * dim; ++i)
                       for (unsigned int j = 0; j < dim * dim; ++j)
                         stiffness[(dim * element.nodes[i / dim] + i % dim) * n
                                   + dim * element.nodes[j / dim] + j % dim]
                             += element.stiffness[i * element.row_length + j];
                   });
    constexpr double by = 1e-5;
    double largest      = 0.;
    for (const double each : stiffness)
      largest = std::max(largest, std::abs(each));
    EXPECT_GT(largest, 0.1 * weight_of_water * thickness);
    for (unsigned int j = 0; j < n; ++j)
    {
      std::vector<std::vector<dealii::Tensor<1, dim>>> beside;
      for (const double sign : { -1., 1. })
      {
        Places<dim> other = places;
        other[j / dim][j % dim] += sign * by;
        load.follow(state_at(nodes, other));
        beside.push_back(forces_of(load, other));
      }
      for (unsigned int i = 0; i < n; ++i)
      {
        const double slope
            = (beside[1][i / dim][i % dim] - beside[0][i / dim][i % dim])
              / (2. * by);
        EXPECT_NEAR(stiffness[i * n + j], -slope, 1e-4 * largest)
            << where << ", " << water << ": " << i << ", " << j;
      }
    }
  }

  const std::string plane_faces = "left, right, top, bottom";
  const std::string space_faces = "x0, x1, y0, y1, z0, z1";

  /** A block of 3 m by 1 m in two triangles. */
  BlockMesh<2> rectangle()
  {
    return quoin::test::rectangle(
        0., 0., 3., 1., { "left", "right", "top", "bottom" }, { 3, 1, 2, 0 });
  }

  const NodeMap<3> &cube()
  {
    static BlockMesh<3> mesh = quoin::test::box_mesh({ 2, 2, 2 }, 0.5);
    static const BlockTriangulation<3> blocks(
        mesh, std::vector<unsigned int>(mesh.n_cells(), 0), { false },
        MPI_COMM_SELF);
    static const NodeMap<3> nodes(blocks);
    return nodes;
  }
} // namespace

// Archimedes: the weight of the water in its place goes up through the
// centroid of what is below the level, wherever the block is.
TEST(WaterPressure, LiftsMovedBlocks)
{
  const BlockMesh<2> mesh = rectangle();
  const TestNodes nodes{ mesh };
  NodalLoad<2> load = water_on<2>(nodes, plane_faces, "10");
  for (const double angle : { 0., 0.3, 2. })
  {
    const auto places
        = moved<2>(nodes, angle, dealii::Tensor<1, 2>({ 0.7, 4. }));
    load.follow(state_at<2>(nodes, places));
    const auto forces = forces_of(load, places);
    double x = 0., y = 0., moment = 0.;
    dealii::Tensor<1, 2> centre;
    for (unsigned int i = 0; i < 4; ++i)
    {
      x += forces[i][0];
      y += forces[i][1];
      moment += places[i][0] * forces[i][1] - places[i][1] * forces[i][0];
      centre += 0.25 * dealii::Tensor<1, 2>(places[i]);
    }
    const double lift = weight_of_water * 3. * thickness;
    EXPECT_NEAR(x, 0., 1e-11 * lift);
    EXPECT_NEAR(y, lift, 1e-11 * lift);
    EXPECT_NEAR(moment, centre[0] * lift, 1e-10 * lift);
  }
}

// A cube of 1 m that stands on an edge, half of it below the level: a prism
// with a triangle of the area 1/2, its centroid a third of its height down.
TEST(WaterPressure, LiftsWhatIsBelowTheLevel)
{
  NodalLoad<3> load = water_on<3>(cube(), space_faces, "2.5");
  const auto places = moved<3>(cube(), 0.25 * std::acos(-1.),
                               dealii::Tensor<1, 3>({ 0.2, 0., 1. }));
  // The level is at half of the diagonal.
  load.follow(state_at<3>(cube(), places));
  NodalLoad<3> halfway = water_on<3>(cube(), space_faces, "1 + sqrt(0.5)");
  halfway.follow(state_at<3>(cube(), places));
  const auto sums = [&](const NodalLoad<3> &each)
  {
    const auto forces = forces_of(each, places);
    std::array<double, 5> result{};
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      for (unsigned int d = 0; d < 3; ++d)
        result[d] += forces[i][d];
      result[3] += places[i][2] * forces[i][0] - places[i][0] * forces[i][2];
      result[4] += places[i][1] * forces[i][2] - places[i][2] * forces[i][1];
    }
    return result;
  };
  const double all = weight_of_water * thickness;
  const auto whole = sums(load), half = sums(halfway);
  EXPECT_NEAR(whole[2], all, 1e-11 * all);
  EXPECT_NEAR(whole[3], -0.2 * all, 1e-10 * all);
  EXPECT_NEAR(whole[4], 0.5 * all, 1e-10 * all);
  EXPECT_NEAR(half[0], 0., 1e-11 * all);
  EXPECT_NEAR(half[1], 0., 1e-11 * all);
  EXPECT_NEAR(half[2], 0.5 * all, 1e-11 * all);
  EXPECT_NEAR(half[3], -0.5 * 0.2 * all, 1e-10 * all);
  EXPECT_NEAR(half[4], 0.25 * all, 1e-10 * all);
}

// The level falls from 1 m at x = 1 m to 0.4 m at x = 2 m above the bottom.
TEST(WaterPressure, LevelThroughPoints)
{
  const BlockMesh<2> mesh = rectangle();
  const TestNodes nodes{ mesh };
  NodalLoad<2> load  = water_on<2>(nodes, "bottom", "through 1, 1; 2, 0.4");
  const auto in_mesh = moved<2>(nodes, 0., {});
  const auto lift    = [&](const Places<2> &places)
  {
    load.follow(state_at<2>(nodes, places));
    double sum = 0.;
    for (const auto &force : forces_of(load, places))
      sum += force[1];
    return sum / (weight_of_water * thickness);
  };
  EXPECT_NEAR(lift(in_mesh), 1. + 0.7 + 0.4, 1e-12);
  // Moved by 0.5 m to the right and by 0.7 m up, where it is dry from 1.5 m on.
  EXPECT_NEAR(lift(moved<2>(nodes, 0., dealii::Tensor<1, 2>({ 0.5, 0.7 }))),
              0.5 * 0.3 + 0.5 * 0.5 * 0.3, 1e-12);
}

TEST(WaterPressure, StiffnessIsTheDerivative)
{
  const BlockMesh<2> mesh = rectangle();
  const TestNodes nodes{ mesh };
  for (const double angle : { 0.2, 2.5 })
  {
    const auto places = moved<2>(nodes, angle, dealii::Tensor<1, 2>());
    for (const std::string water : { "9", "0.5", "through -1, 1; 0.6, 0.3" })
      check_stiffness<2>(nodes, plane_faces, water, places);
  }
  const auto places = moved<3>(cube(), 0.4, dealii::Tensor<1, 3>());
  for (const std::string water : { "9", "0.52", "through -1, 1; 0.6, 0.3" })
    check_stiffness<3>(cube(), space_faces, water, places);
}

TEST(WaterPressure, ReturnsToTheMesh)
{
  const BlockMesh<2> mesh = rectangle();
  const TestNodes nodes{ mesh };
  NodalLoad<2> load   = water_on<2>(nodes, plane_faces, "0.5");
  const auto in_mesh  = moved<2>(nodes, 0., {});
  const auto before   = forces_of(load, in_mesh);
  const auto at_first = load.amplitude({ 0., 0. });
  load.follow(state_at<2>(nodes, moved<2>(nodes, 1., dealii::Tensor<1, 2>())));
  EXPECT_NE(forces_of(load, in_mesh), before);
  EXPECT_NE(load.amplitude({ 0., 0. }), at_first);
  load.return_to_mesh();
  EXPECT_EQ(forces_of(load, in_mesh), before);
}

TEST(WaterPressure, ALevelThatIsNoNumberIsNotDryGround)
{
  const BlockMesh<2> mesh = rectangle();
  const TestNodes nodes{ mesh };
  const NodalLoad<2> load = water_on<2>(nodes, plane_faces, "sqrt(t - 1) + 3");
  EXPECT_TRUE(
      std::isnan(forces_of(load, moved<2>(nodes, 0., {})).front().norm()));
}
