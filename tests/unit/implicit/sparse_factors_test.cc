// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/sparse_factors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace quoin
{
  namespace
  {
    /** A matrix of five-point stars on a square grid, two unknowns a node,
        with random values, and one more on the diagonal. */
    struct GridMatrix
    {
      std::vector<int> starts{ 0 }, columns;
      std::vector<double> values;
      int n;

      GridMatrix(const int side, const double diagonal) : n(2 * side * side)
      {
        std::mt19937 generator(7);
        std::uniform_real_distribution<double> random(-1., 1.);
        for (int row = 0; row < n; ++row)
        {
          const int x = row / 2 % side, y = row / 2 / side;
          for (int column = 0; column < n; ++column)
          {
            const int dx = std::abs(column / 2 % side - x),
                      dy = std::abs(column / 2 / side - y);
            if (dx + dy > 1)
              continue;
            columns.push_back(column);
            values.push_back(random(generator) + diagonal * (row == column));
          }
          starts.push_back(columns.size());
        }
      }

      /** Largest component of b - A x. */
      double residual(const std::vector<double> &x,
                      const std::vector<double> &b) const
      {
        double largest = 0.;
        for (int row = 0; row < n; ++row)
        {
          double left = b[row];
          for (int e = starts[row]; e < starts[row + 1]; ++e)
            left -= values[e] * x[columns[e]];
          largest = std::max(largest, std::abs(left));
        }
        return largest;
      }
    };
  } // namespace

  TEST(SparseFactors, SolveGridsOfAllSizes)
  {
    // Without a large diagonal rows are exchanged.
    for (const double diagonal : { 0., 6. })
      for (const int side : { 1, 2, 5, 30 })
      {
        GridMatrix matrix(side, diagonal);
        SparseFactors factors;
        ASSERT_TRUE(factors.analyse(matrix.n, matrix.starts.data(),
                                    matrix.columns.data()));
        std::vector<double> b(matrix.n), x(matrix.n);
        for (int i = 0; i < matrix.n; ++i)
          b[i] = std::sin(1. + i);
        // The second time with other values on the same pattern.
        for (unsigned int repeat = 0; repeat < 2; ++repeat)
        {
          ASSERT_TRUE(factors.factorise(matrix.values.data()));
          factors.solve(b.data(), x.data());
          double largest = 1.;
          for (const double value : x)
            largest = std::max(largest, std::abs(value));
          EXPECT_LT(matrix.residual(x, b), 1e-11 * largest);
          for (double &value : matrix.values)
            value *= 1. + 0.1 * std::cos(value);
        }
      }
  }

  TEST(SparseFactors, ExchangeRowsWithinSupernodes)
  {
    // Nothing but a zero on the diagonal.
    const std::vector<int> starts{ 0, 2, 4 }, columns{ 0, 1, 0, 1 };
    const std::vector<double> values{ 0., 2., 4., 0. }, b{ 6., 8. };
    SparseFactors factors;
    ASSERT_TRUE(factors.analyse(2, starts.data(), columns.data()));
    ASSERT_TRUE(factors.factorise(values.data()));
    std::vector<double> x(2);
    factors.solve(b.data(), x.data());
    EXPECT_DOUBLE_EQ(x[0], 2.);
    EXPECT_DOUBLE_EQ(x[1], 3.);
  }

  TEST(SparseFactors, RefuseWhatTheyCannotSolve)
  {
    const std::vector<int> starts{ 0, 2, 4 }, columns{ 0, 1, 0, 1 };
    const std::vector<double> singular{ 1., 0., 0., 0. };
    SparseFactors factors;
    ASSERT_TRUE(factors.analyse(2, starts.data(), columns.data()));
    EXPECT_FALSE(factors.factorise(singular.data()));

    const std::vector<int> one_sided_starts{ 0, 2, 3 }, one_sided{ 0, 1, 1 };
    EXPECT_FALSE(factors.analyse(2, one_sided_starts.data(), one_sided.data()));
  }
} // namespace quoin
