// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/crossed_triangles.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace quoin;

namespace
{
  MeshData<2> cut(const std::vector<dealii::Point<2>> &corners)
  {
    MeshData<2> mesh;
    mesh.vertices = corners;
    add_crossed_triangles({ { { { 0, 1, 2, 3 } } }, { 7 } }, mesh);
    EXPECT_EQ(mesh.cell_group, std::vector<unsigned int>(mesh.cells.size(), 7));
    return mesh;
  }

  std::vector<double> areas(const MeshData<2> &mesh)
  {
    std::vector<double> result;
    for (const auto &t : mesh.cells)
    {
      const auto a = mesh.vertices[t[0]];
      const auto b = mesh.vertices[t[1]] - a, c = mesh.vertices[t[2]] - a;
      result.push_back(0.5 * (b[0] * c[1] - b[1] * c[0]));
    }
    return result;
  }
} // namespace

TEST(CrossedTriangles, MeetWhereTheDiagonalsDo)
{
  const MeshData<2> mesh
      = cut({ { 0., 0. }, { 2., 0. }, { 3., 3. }, { 0., 1. } });
  ASSERT_EQ(mesh.cells.size(), 4U);
  ASSERT_EQ(mesh.vertices.size(), 5U);
  // y = x and y = 1 - x/2
  EXPECT_NEAR(mesh.vertices[4][0], 2. / 3., 1e-15);
  EXPECT_NEAR(mesh.vertices[4][1], 2. / 3., 1e-15);
  double sum = 0.;
  for (const double area : areas(mesh))
  {
    EXPECT_GT(area, 0.);
    sum += area;
  }
  EXPECT_NEAR(sum, 4.5, 1e-14);
}

TEST(CrossedTriangles, ConditionsOfConstantAreaDepend)
{
  // Rows: derivatives of the four areas by the five vertices.
  const MeshData<2> mesh
      = cut({ { 0., 0. }, { 2., 0.1 }, { 2.4, 1.7 }, { -0.2, 1. } });
  double rows[4][10]{};
  for (unsigned int t = 0; t < 4; ++t)
    for (unsigned int i = 0; i < 3; ++i)
    {
      const auto &cell = mesh.cells[t];
      const auto edge
          = mesh.vertices[cell[(i + 2) % 3]] - mesh.vertices[cell[(i + 1) % 3]];
      rows[t][2 * cell[i]]     = -edge[1];
      rows[t][2 * cell[i] + 1] = edge[0];
    }
  // Opposite triangles: row 0 over its area plus row 2 over its area is the
  // same sum of rows 1 and 3.
  const auto area = areas(mesh);
  for (unsigned int d = 0; d < 10; ++d)
    EXPECT_NEAR(rows[0][d] / area[0] + rows[2][d] / area[2],
                rows[1][d] / area[1] + rows[3][d] / area[3], 1e-13);
}

TEST(CrossedTriangles, ConcaveQuadranglesBecomeTwo)
{
  for (unsigned int inner = 0; inner < 4; ++inner)
  {
    std::vector<dealii::Point<2>> corners(4);
    const dealii::Point<2> dart[]
        = { { 0.3, 0.3 }, { 0., -2. }, { 2., 2. }, { -2., 0. } };
    for (unsigned int i = 0; i < 4; ++i)
      corners[(i + inner) % 4] = dart[i];
    const MeshData<2> mesh = cut(corners);
    ASSERT_EQ(mesh.cells.size(), 2U);
    EXPECT_EQ(mesh.vertices.size(), 4U);
    double sum = 0.;
    for (const double area : areas(mesh))
    {
      EXPECT_GT(area, 0.);
      sum += area;
    }
    double wanted = 0.;
    for (unsigned int i = 0; i < 4; ++i)
    {
      const auto a = dart[i], b = dart[(i + 1) % 4];
      wanted += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    EXPECT_NEAR(sum, wanted, 1e-14);
  }
}
