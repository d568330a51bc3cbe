// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Six-node triangles: forces, stresses and energy of fields that they hold
// exactly, against closed forms and integrals by another rule.

#include "tangent_checks.h"

#include <quoin/blocks/cell_states.h>

#include <gtest/gtest.h>

using namespace quoin;
using namespace quoin::tangent_test;

namespace
{
  /** u = a quadratic polynomial in each component; strains of 1e-9. */
  struct Field
  {
    double c[2][6] = { { 0.3, 1.1, -0.7, 0.9, -1.3, 0.4 },
                       { -0.2, 0.6, 0.8, -0.5, 0.7, 1.2 } };
    double size    = 1e-9;

    double value(const unsigned int i, const double x, const double y) const
    {
      const auto &a = c[i];
      return size
             * (a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y
                + a[5] * y * y);
    }
    /** 11, 22, 12. */
    PlaneTensor strain(const double x, const double y) const
    {
      const auto by_x = [&](const auto &a)
      { return size * (a[1] + 2. * a[3] * x + a[4] * y); };
      const auto by_y = [&](const auto &a)
      { return size * (a[2] + a[4] * x + 2. * a[5] * y); };
      return { by_x(c[0]), by_y(c[1]), 0.5 * (by_y(c[0]) + by_x(c[1])) };
    }
  };

  /** A six-node triangle by itself: nodes a, b, c and those between ab, bc,
      ca. */
  struct SixNodes
  {
    std::array<unsigned int, 6> nodes;
    double x[3], y[3], area;
    double slope[3][2]; /**< of the area coordinates [1/m] */

    SixNodes(const RandomBlocks &mesh, const unsigned int triangle)
    {
      const auto *cells = &mesh.data.cells[4 * triangle];
      for (unsigned int i = 0; i < 3; ++i)
      {
        nodes[i]     = cells[i][0];
        nodes[3 + i] = cells[3][i];
        x[i]         = mesh.nodes[nodes[i]].X[0];
        y[i]         = mesh.nodes[nodes[i]].X[1];
      }
      area = 0.5
             * ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
      for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
        slope[i][0] = (y[j] - y[k]) / (2. * area);
        slope[i][1] = (x[k] - x[j]) / (2. * area);
      }
    }

    /** Of shape function @p i at area coordinates @p l. */
    std::array<double, 2> gradient(const unsigned int i,
                                   const double (&l)[3]) const
    {
      std::array<double, 2> result;
      const unsigned int a = i % 3, b = (i + 1) % 3;
      for (unsigned int d = 0; d < 2; ++d)
        result[d] = i < 3 ? (4. * l[i] - 1.) * slope[i][d]
                          : 4. * (l[a] * slope[b][d] + l[b] * slope[a][d]);
      return result;
    }
  };

  struct Integrals
  {
    Vector force;
    double energy = 0.;
  };

  /** By the rule of the edges' middles, exact for quadratic functions. */
  Integrals integrate(const RandomBlocks &mesh, const Field &field)
  {
    Integrals result{ Vector(2 * mesh.nodes.size(), 0.) };
    for (unsigned int t = 0; t < mesh.data.cells.size() / 4; ++t)
    {
      const SixNodes element(mesh, t);
      const PlaneStiffness &stiffness
          = mesh.data.stiffness[mesh.data.cell_stiffness[4 * t]];
      const double volume = mesh.data.thickness[0] * element.area / 3.;
      for (unsigned int q = 0; q < 3; ++q)
      {
        double l[3] = { 0.5, 0.5, 0.5 }, x = 0., y = 0.;
        l[q] = 0.;
        for (unsigned int i = 0; i < 3; ++i)
        {
          x += l[i] * element.x[i];
          y += l[i] * element.y[i];
        }
        const PlaneTensor e = field.strain(x, y);
        const PlaneTensor s = elastic_stress(stiffness, e);
        result.energy
            += 0.5 * volume * (s[0] * e[0] + s[1] * e[1] + 2. * s[2] * e[2]);
        for (unsigned int i = 0; i < 6; ++i)
        {
          const auto b = element.gradient(i, l);
          double *f    = &result.force[2 * element.nodes[i]];
          f[0] -= volume * (s[0] * b[0] + s[2] * b[1]);
          f[1] -= volume * (s[2] * b[0] + s[1] * b[1]);
        }
      }
    }
    return result;
  }
} // namespace

TEST(QuadraticTangent, QuadraticFieldsAreIntegratedExactly)
{
  for (const PlaneAssumption plane : both_assumptions)
  {
    RandomBlocks mesh = elastic_block(plane, true);
    const Field field;
    mesh.displace(
        [&](const double x, const double y, dealii::Tensor<1, 2> &u)
        {
          u[0] = field.value(0, x, y);
          u[1] = field.value(1, x, y);
        });
    BlockForces<2> blocks = mesh.prepared();
    PlasticHistory none;
    const Vector force   = linearised(blocks, mesh.nodes, none);
    const Integrals want = integrate(mesh, field);
    EXPECT_LT(largest_difference(force, want.force),
              2e-8 * largest(want.force));
    EXPECT_NEAR(strain_energy(blocks, mesh.nodes.data(), none), want.energy,
                2e-8 * want.energy);

    // At the centroids of the four cells, the inner one's too.
    for (unsigned int c = 0; c < mesh.data.cells.size(); ++c)
    {
      double x = 0., y = 0.;
      for (const unsigned int node : mesh.data.cells[c])
      {
        x += mesh.nodes[node].X[0] / 3.;
        y += mesh.nodes[node].X[1] / 3.;
      }
      const PlaneTensor want = elastic_stress(
          blocks.cell_data().stiffness_of(c), field.strain(x, y));
      const auto stress = cell_stress(blocks, mesh.nodes.data(), none, c);
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(stress[i], want[i], 1e-6);
    }
  }
}

TEST(QuadraticTangent, LinearFieldsPullAtTheEdgesAlone)
{
  // x -> R U X of one material, whose first Piola-Kirchhoff stress R S is
  // the same everywhere.
  const double angle = 2.2, c = std::cos(angle), s = std::sin(angle);
  const PlaneTensor e{ 0.03, -0.02, 0.015 };
  for (const PlaneAssumption plane : both_assumptions)
  {
    RandomBlocks mesh = elastic_block(plane, true);
    mesh.data.stiffness.resize(1);
    mesh.data.cell_stiffness.clear();
    mesh.displace(
        [&](const double x, const double y, dealii::Tensor<1, 2> &u)
        {
          const double a = x + e[0] * x + e[2] * y, b = y + e[2] * x + e[1] * y;
          u[0] = c * a - s * b - x;
          u[1] = s * a + c * b - y;
        });
    BlockForces<2> blocks = mesh.prepared();
    PlasticHistory none;
    const Vector force   = linearised(blocks, mesh.nodes, none);
    const PlaneTensor S  = elastic_stress(mesh.data.stiffness[0], e);
    const double P[2][2] = { { c * S[0] - s * S[2], c * S[2] - s * S[1] },
                             { s * S[0] + c * S[2], s * S[2] + c * S[1] } };
    const double side    = 1.3;
    const double edge    = mesh.data.thickness[0] * side / 3.; // of an element
    const auto is_at
        = [](const double a, const double b) { return std::abs(a - b) < 1e-9; };
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    {
      // Simpson's rule: a sixth of an edge at its ends, two thirds between.
      const auto &X     = mesh.nodes[i].X;
      double outward[2] = { 0., 0. };
      for (unsigned int d = 0; d < 2; ++d)
      {
        if (!is_at(X[d], 0.) && !is_at(X[d], side))
          continue;
        const double along = X[1 - d] / side * 6.;
        const bool middle  = std::lround(along) % 2 == 1;
        const bool is_end  = is_at(along, 0.) || is_at(along, 6.);
        const double share = middle ? 2. / 3. : is_end ? 1. / 6. : 1. / 3.;
        outward[d]         = share * edge * (is_at(X[d], 0.) ? -1. : 1.);
      }
      for (unsigned int d = 0; d < 2; ++d)
        EXPECT_NEAR(force[2 * i + d],
                    -P[d][0] * outward[0] - P[d][1] * outward[1],
                    1e-12 * edge * stone.young);
    }
  }
}
