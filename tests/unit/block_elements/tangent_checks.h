// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_block_elements_tangent_checks_h
#define quoin_tests_unit_block_elements_tangent_checks_h

#include "../blocks/random_blocks.h"

#include <quoin/block_elements/cell_tangent.h>
#include <quoin/blocks/block_forces.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace quoin::tangent_test
{
  using Vector = std::vector<double>;
  using Matrix = std::vector<Vector>;

  inline constexpr LinearElastic stone{ 2700., 30e9, 0.2 };
  inline constexpr LinearElastic clay{ 1900., 5e9, 0.33 };
  inline constexpr PlaneAssumption both_assumptions[]
      = { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress };

  /** Cuts each triangle into the four of a six-node one. */
  inline void make_quadratic(RandomBlocks &mesh)
  {
    const auto corners = mesh.data.cells;
    mesh.data.cells.clear();
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> middles;
    const auto middle = [&](const unsigned int a, const unsigned int b)
    {
      const auto [place, is_new] = middles.emplace(
          std::make_pair(std::min(a, b), std::max(a, b)), mesh.nodes.size());
      if (is_new)
      {
        const auto &A = mesh.nodes[a].X, &B = mesh.nodes[b].X;
        mesh.nodes.push_back(
            { { 0.5 * (A[0] + B[0]), 0.5 * (A[1] + B[1]) }, {} });
      }
      return place->second;
    };
    for (const auto &[a, b, c] : corners)
    {
      const unsigned int d = middle(a, b), e = middle(b, c), f = middle(c, a);
      mesh.data.cells.push_back({ a, d, f });
      mesh.data.cells.push_back({ b, e, d });
      mesh.data.cells.push_back({ c, f, e });
      mesh.data.cells.push_back({ d, e, f });
    }
    mesh.data.block_first_cell = { 0, 4 * (unsigned int)corners.size() };
    mesh.data.block_first_node = { 0, (unsigned int)mesh.nodes.size() };
    mesh.data.quadratic        = true;
  }

  /** One irregular block of two elastic materials, by turns. */
  inline RandomBlocks elastic_block(const PlaneAssumption plane,
                                    const bool quadratic,
                                    const unsigned int m = 3)
  {
    RandomBlocks mesh(29);
    mesh.add_block(m, 1.3);
    if (quadratic)
      make_quadratic(mesh);
    mesh.data.thickness = 0.4;
    mesh.data.stiffness
        = { plane_stiffness(stone, plane), plane_stiffness(clay, plane) };
    for (unsigned int c = 0; c < mesh.data.cells.size(); ++c)
      mesh.data.cell_stiffness.push_back((quadratic ? c / 4 : c) % 3 == 0);
    return mesh;
  }

  /** Forces on all nodes, x and y in turns; and the stiffness if asked for. */
  inline Vector linearised(const BlockForces<2> &blocks,
                           const AlignedArray<NodeRecord<2>> &nodes,
                           PlasticHistory &history, Matrix *stiffness = nullptr,
                           double *dissipated = nullptr)
  {
    Vector force(2 * nodes.size(), 0.);
    if (stiffness)
      stiffness->assign(force.size(), Vector(force.size(), 0.));
    CellLinearisation cell;
    for (unsigned int c = 0; c < blocks.cell_data().cells.size(); ++c)
    {
      if (!linearise_cell(blocks.cell_data(), c, nodes.data(), history, cell))
        continue;
      if (dissipated)
        *dissipated += cell.dissipated;
      const auto place
          = [&](const unsigned int i) { return 2 * cell.nodes[i / 2] + i % 2; };
      for (unsigned int i = 0; i < 2 * cell.n_nodes; ++i)
      {
        force[place(i)] += cell.force[i];
        for (unsigned int j = 0; stiffness && j < 2 * cell.n_nodes; ++j)
          (*stiffness)[place(i)][place(j)] += cell.stiffness[i][j];
      }
    }
    return force;
  }

  inline double largest(const Vector &a)
  {
    double max = 0.;
    for (const double value : a)
      max = std::max(max, std::abs(value));
    return max;
  }

  inline double largest(const Matrix &a)
  {
    double max = 0.;
    for (const Vector &row : a)
      max = std::max(max, largest(row));
    return max;
  }

  inline double largest_difference(Vector a, const Vector &b)
  {
    for (std::size_t i = 0; i < a.size(); ++i)
      a[i] -= b[i];
    return largest(a);
  }

  inline Vector product(const Matrix &a, const Vector &b)
  {
    Vector result;
    for (const Vector &row : a)
      result.push_back(
          std::inner_product(row.begin(), row.end(), b.begin(), 0.));
    return result;
  }
} // namespace quoin::tangent_test

#endif
