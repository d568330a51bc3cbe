// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_plain_vector_h
#define quoin_tdbem_plain_vector_h

#include <quoin/base/eigen_core.h>

#include <vector>

// Vectors of Eigen from and to those that archives hold.

namespace quoin
{
  inline Eigen::VectorXd to_eigen(const std::vector<double> &values)
  {
    return Eigen::VectorXd::Map(values.data(), Eigen::Index(values.size()));
  }

  inline std::vector<double> to_vector(const Eigen::VectorXd &values)
  {
    return { values.data(), values.data() + values.size() };
  }
} // namespace quoin

#endif
