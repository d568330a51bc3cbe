// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/blas_kernels.h>
#include <quoin/base/eigen_core.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

extern "C" char *openblas_get_corename();

using namespace quoin;

TEST(BlasKernels, SuitTheProcessorAndMultiplyRightly)
{
  if (std::getenv("OPENBLAS_CORETYPE"))
    GTEST_SKIP() << "what the user has chosen stays";
  choose_blas_kernels();
  EXPECT_EQ(std::getenv("OPENBLAS_CORETYPE"), nullptr) << "as before";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    EXPECT_NE(std::string(openblas_get_corename()), "Prescott");
  }
  const Eigen::Index n = 150;
  Eigen::MatrixXd a(n, n), b(n, n), product = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
    {
      a(i, j) = double((7 * i + 3 * j) % 11 - 5);
      b(i, j) = double((5 * i + 9 * j) % 13 - 6);
    }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index k = 0; k < n; ++k)
        product(i, j) += a(i, k) * b(k, j);
  EXPECT_EQ(Eigen::MatrixXd(a * b), product) << "whole numbers: no rounding";
}
