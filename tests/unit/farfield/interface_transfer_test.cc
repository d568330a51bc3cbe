// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/base/exceptions.h>
#include <quoin/farfield/interface_transfer.h>
#include <quoin/mesh/block_splitter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace quoin;
using quoin::test::add_curve;
using quoin::test::grid;
using quoin::test::TestNodes;

namespace
{
  /** The upper edge of blocks, from (0, 0) to (3, 0) in uneven parts; two
      blocks meet at x = 1 with vertices of their own. */
  struct Top
  {
    const TestNodes nodes{ mesh() };
    /** Of the upper edge alone. */
    const std::vector<BoundaryFace<2>> faces
        = gather_faces(*nodes, { false, true });

    static BlockMesh<2> mesh()
    {
      BlockMesh<2> result;
      result.group_names        = { "rock" };
      result.face_names         = { "", "top" };
      result.block_first_cell   = { 0 };
      result.block_first_vertex = { 0 };
      for (const std::vector<double> &x :
           { std::vector<double>{ 0., 0.4, 1. }, { 1., 1.9, 2.2, 3. } })
      {
        // The block is below, each of its cells up to a vertex at its foot.
        const unsigned int first = result.n_vertices();
        const unsigned int foot  = first + x.size();
        for (const double place : x)
          result.vertices.emplace_back(place, 0.);
        result.vertices.emplace_back(0.5 * (x.front() + x.back()), -1.);
        for (unsigned int k = first; k + 1 < foot; ++k)
        {
          result.boundary_faces.push_back(
              { { { k + 1, k } }, result.n_cells(), 1 });
          result.cells.push_back({ { foot, k + 1, k } });
          result.cell_group.push_back(0);
        }
        result.boundary_faces.push_back(
            { { { first, foot } }, result.block_first_cell.back(), 0 });
        result.boundary_faces.push_back(
            { { { foot, foot - 1 } }, result.n_cells() - 1, 0 });
        result.block_first_cell.push_back(result.n_cells());
        result.block_first_vertex.push_back(result.n_vertices());
      }
      return result;
    }
  };

  /** The domain is above. */
  Boundary above(const std::vector<double> &x)
  {
    Boundary boundary;
    std::vector<dealii::Point<2>> points;
    for (const double place : x)
      points.emplace_back(place, 0.);
    boundary.add_curve(points, false);
    return boundary;
  }
} // namespace

// Elements that end anywhere along the edges.
TEST(InterfaceTransfer, means_of_linear_motion)
{
  const Top top;
  const Boundary boundary = above({ 0., 0.7, 1.5, 3. });
  const InterfaceTransfer transfer(boundary, { 0, 1, 2 }, top.nodes, top.faces);
  Eigen::VectorXd means;
  transfer.gather(
      [&](const unsigned int k)
      {
        const double x = top.nodes->point(transfer.nodes()[k])[0];
        return dealii::Point<2>(2. - x, 3. * x);
      },
      means);
  for (unsigned int e = 0; e < 3; ++e)
  {
    const double middle = boundary.elements[e].middle()[0];
    EXPECT_NEAR(means[2 * e], 2. - middle, 1e-14);
    EXPECT_NEAR(means[2 * e + 1], 3. * middle, 1e-14);
  }
}

// Edges of 1 m of triangles of degree 2, elements that end anywhere: the means
// of a quadratic motion are those of the function.
TEST(InterfaceTransfer, means_of_quadratic_motion)
{
  MeshData<2> data = grid(3, 1, "rock", 0., -1.);
  add_curve(data, "top", 0., 0., 3., 0.);
  data.quadratic    = true;
  BlockMesh<2> mesh = split_into_blocks(data, {});
  std::vector<bool> wanted;
  for (const std::string &name : mesh.face_names)
    wanted.push_back(name == "top");
  const TestNodes nodes(mesh);
  const std::vector<double> ends = { 0., 0.7, 1.2, 1.5, 3. };
  const Boundary boundary        = above(ends);
  const InterfaceTransfer transfer(boundary, { 0, 1, 2, 3 }, nodes,
                                   gather_faces(*nodes, wanted));
  EXPECT_EQ(transfer.nodes().size(), 7);
  Eigen::VectorXd means;
  transfer.gather(
      [&](const unsigned int k)
      {
        const double x = nodes->point(transfer.nodes()[k])[0];
        return dealii::Point<2>(x * x, 2. - x);
      },
      means);
  for (unsigned int e = 0; e + 1 < ends.size(); ++e)
  {
    const double a = ends[e], b = ends[e + 1];
    EXPECT_NEAR(means[2 * e], (a * a + a * b + b * b) / 3., 1e-14);
    EXPECT_NEAR(means[2 * e + 1], 2. - 0.5 * (a + b), 1e-14);
  }
}

// The same work on both sides, and the resultants.
TEST(InterfaceTransfer, virtual_work)
{
  const Top top;
  const Boundary boundary = above({ 0., 0.7, 1.5, 3. });
  const InterfaceTransfer transfer(boundary, { 0, 1, 2 }, top.nodes, top.faces);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  std::vector<dealii::Tensor<1, 2>> v(transfer.nodes().size());
  for (auto &node : v)
    node = dealii::Point<2>(uniform(random), uniform(random));
  Eigen::VectorXd p(6), means;
  for (double &value : p)
    value = uniform(random);
  transfer.gather([&](const unsigned int k) { return v[k]; }, means);

  double on_nodes = 0., on_elements = 0.;
  dealii::Tensor<1, 2> resultant;
  for (unsigned int k = 0; k < v.size(); ++k)
    for (unsigned int d = 0; d < 2; ++d)
    {
      on_nodes += transfer.force(k, p)[d] * v[k][d];
      resultant[d] += transfer.force(k, p)[d];
    }
  for (unsigned int e = 0; e < 3; ++e)
    for (unsigned int d = 0; d < 2; ++d)
    {
      on_elements += transfer.lengths()[e] * p[2 * e + d] * means[2 * e + d];
      resultant[d] -= transfer.lengths()[e] * p[2 * e + d];
    }
  EXPECT_NEAR(on_nodes, on_elements, 1e-14);
  EXPECT_NEAR(resultant[0], 0., 1e-14);
  EXPECT_NEAR(resultant[1], 0., 1e-14);
}

// w S L from the definition.
TEST(InterfaceTransfer, congruence)
{
  const Top top;
  const Boundary boundary = above({ 0., 1., 2.2, 3. });
  const InterfaceTransfer transfer(boundary, { 0, 1, 2 }, top.nodes, top.faces);
  std::vector<double> diagonal;
  for (unsigned int k = 0; k < transfer.nodes().size(); ++k)
    diagonal.push_back(1. + k);
  const Eigen::MatrixXd matrix = transfer.congruence(diagonal);
  for (unsigned int e = 0; e < 3; ++e)
  {
    Eigen::VectorXd p = Eigen::VectorXd::Zero(6), means;
    p[2 * e]          = 1.;
    transfer.gather(
        [&](const unsigned int k)
        {
          const double f = diagonal[k] * transfer.force(k, p)[0];
          return dealii::Point<2>(f, 0.);
        },
        means);
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_NEAR(matrix(i, e), means[2 * i], 1e-14);
  }
}

// Chords of a circle of edges, whose motion as a rigid body they follow.
TEST(InterfaceTransfer, chords)
{
  constexpr unsigned int n = 24;
  BlockMesh<2> mesh;
  mesh.group_names        = { "rock" };
  mesh.face_names         = { "", "circle" };
  mesh.block_first_cell   = { 0, n };
  mesh.block_first_vertex = { 0, n + 1 };
  std::vector<dealii::Point<2>> points;
  for (unsigned int k = 0; k < n; ++k)
  {
    const double angle = 2. * M_PI * k / n;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle));
    mesh.boundary_faces.push_back({ { { k, (k + 1) % n } }, k, 1 });
    mesh.cells.push_back({ { n, k, (k + 1) % n } });
    mesh.cell_group.push_back(0);
    if (k % 3 == 0) // clockwise: the domain is outside
      points.insert(points.begin(), { std::cos(angle), std::sin(angle) });
  }
  mesh.vertices.emplace_back(0., 0.);
  const TestNodes nodes(mesh);
  Boundary boundary;
  boundary.add_curve(points, true);
  const InterfaceTransfer transfer(boundary, { 0, 1, 2, 3, 4, 5, 6, 7 }, nodes,
                                   gather_faces(*nodes, { false, true }));
  EXPECT_EQ(transfer.nodes().size(), n);
  Eigen::VectorXd means;
  transfer.gather([](const unsigned int) { return dealii::Point<2>(1., -2.); },
                  means);
  for (unsigned int e = 0; e < 8; ++e)
  {
    EXPECT_NEAR(means[2 * e], 1., 1e-14);
    EXPECT_NEAR(means[2 * e + 1], -2., 1e-14);
  }
}

TEST(InterfaceTransfer, refuses_gaps)
{
  const Top top;
  EXPECT_THROW(
      InterfaceTransfer(above({ 0., 1., 2. }), { 0, 1 }, top.nodes, top.faces),
      InputError);
  EXPECT_THROW(InterfaceTransfer(above({ 0., 1., 3., 4. }), { 0, 1, 2 },
                                 top.nodes, top.faces),
               InputError);
}
