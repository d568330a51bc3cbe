// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_blocks_random_blocks_h
#define quoin_tests_unit_blocks_random_blocks_h

#include <quoin/base/node_record.h>
#include <quoin/blocks/block_forces.h>

#include <deal.II/base/array_view.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace quoin
{
  /** Irregular blocks: squares cut along random diagonals, nodes shaken. */
  class RandomBlocks
  {
  public:
    explicit RandomBlocks(const unsigned int seed) : generator(seed)
    {
      data.block_first_cell = { 0 };
      data.block_first_node = { 0 };
    }

    /** A square of m by m pairs of triangles, its corner at (k side, 0). */
    void add_block(const unsigned int m, const double side)
    {
      const unsigned int first = nodes.size();
      for (unsigned int j = 0; j <= m; ++j)
        for (unsigned int i = 0; i <= m; ++i)
        {
          const bool inside = i > 0 && j > 0 && i < m && j < m;
          const double h    = side / m;
          const double x    = h * (i + (inside ? 0.25 * random() : 0.));
          const double y    = h * (j + (inside ? 0.25 * random() : 0.));
          nodes.push_back({ { x, y }, {} });
        }
      std::vector<std::array<unsigned int, 3>> cells;
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < m; ++i)
        {
          const unsigned int a = first + j * (m + 1) + i, b = a + 1;
          const unsigned int c = b + m + 1, d = a + m + 1;
          if (random() < 0.)
          {
            cells.push_back({ a, b, c });
            cells.push_back({ c, d, a });
          }
          else
          {
            cells.push_back({ a, b, d });
            cells.push_back({ b, c, d });
          }
        }
      std::shuffle(cells.begin(), cells.end(), generator);
      data.cells.insert(data.cells.end(), cells.begin(), cells.end());
      finish_block();
    }

    void add_triangle()
    {
      const unsigned int n = nodes.size();
      nodes.push_back({ { 3., 1. }, {} });
      nodes.push_back({ { 4., 1.2 }, {} });
      nodes.push_back({ { 3.4, 2. }, {} });
      data.cells.push_back({ n, n + 1, n + 2 });
      finish_block();
    }

    void add_initial_stress(const double size)
    {
      data.initial_stress.clear();
      for (std::size_t k = 0; k < data.cells.size(); ++k)
        data.initial_stress.push_back(
            { size * random(), size * random(), size * random() });
    }

    template <typename Function>
    void displace(const Function &u)
    {
      for (NodeRecord<2> &node : nodes)
        u(node.X[0], node.X[1], node.u);
    }

    /** Turns about the origin, then shifts. */
    void move_rigidly(const double angle, const double ux, const double uy)
    {
      // cos - 1 without cancellation
      const double h  = std::sin(0.5 * angle);
      const double c1 = -2. * h * h, s = std::sin(angle);
      displace(
          [=](const double x, const double y, dealii::Tensor<1, 2> &u)
          {
            u[0] = c1 * x - s * y + ux;
            u[1] = s * x + c1 * y + uy;
          });
    }

    /** Random strains of about @p strain on top of a rotation. */
    void deform(const double strain, const double angle)
    {
      move_rigidly(angle, 0.3, 0.1);
      std::vector<double> reach(nodes.size(), 1e300);
      for (const auto &cell : data.cells)
        for (unsigned int i = 0; i < 3; ++i)
        {
          const NodeRecord<2> &a = nodes[cell[i]];
          const NodeRecord<2> &b = nodes[cell[(i + 1) % 3]];
          const double length    = std::hypot(a.X[0] - b.X[0], a.X[1] - b.X[1]);
          reach[cell[i]]         = std::min(reach[cell[i]], length);
          reach[cell[(i + 1) % 3]] = std::min(reach[cell[(i + 1) % 3]], length);
        }
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (double &u : dealii::make_array_view(nodes[i].u))
          u += strain * reach[i] * random();
    }

    BlockForces<2> prepared(const BlockForcesOptions &options
                            = BlockForcesOptions()) const
    {
      BlockForces<2> blocks;
      blocks.prepare(data, options);
      return blocks;
    }

    AlignedArray<dealii::Tensor<1, 2>> random_velocity()
    {
      AlignedArray<dealii::Tensor<1, 2>> velocity(nodes.size());
      for (dealii::Tensor<1, 2> &v : velocity)
        v = dealii::Point<2>(random(), random());
      return velocity;
    }

    /** In (-1, 1). */
    double random()
    {
      return std::uniform_real_distribution<double>(-1., 1.)(generator);
    }

    BlockForcesData<2> data;
    AlignedArray<NodeRecord<2>> nodes;

  private:
    void finish_block()
    {
      data.block_first_cell.push_back(data.cells.size());
      data.block_first_node.push_back(nodes.size());
    }

    std::mt19937 generator;
  };

  inline double largest(const AlignedArray<dealii::Tensor<1, 2>> &a)
  {
    double max = 0.;
    for (const dealii::Tensor<1, 2> &f : a)
      max = std::max({ max, std::abs(f[0]), std::abs(f[1]) });
    return max;
  }

  inline double largest_difference(const AlignedArray<dealii::Tensor<1, 2>> &a,
                                   const AlignedArray<dealii::Tensor<1, 2>> &b)
  {
    double max = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        max = std::max(max, std::abs(a[i][d] - b[i][d]));
    return max;
  }
} // namespace quoin

#endif
