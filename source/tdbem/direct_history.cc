// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/direct_history.h>

namespace quoin
{
  DirectHistory::DirectHistory(const InfluenceKernel &kernel)
    : kernel(kernel), sum(Eigen::VectorXd::Zero(kernel.size()))
  {
  }

  const Eigen::VectorXd &DirectHistory::predict()
  {
    const std::size_t n_past = us.size();
    while (G.size() < n_past)
    {
      G.emplace_back();
      H.emplace_back();
      kernel.lag(unsigned(G.size()), G.back(), H.back());
    }
    sum.setZero();
    for (std::size_t n = 1; n <= n_past; ++n)
    {
      sum.noalias() += G[n - 1] * ps[n_past - n];
      sum.noalias() -= H[n - 1] * us[n_past - n];
    }
    return sum;
  }

  void DirectHistory::push(const Eigen::VectorXd &u, const Eigen::VectorXd &p)
  {
    us.push_back(u);
    ps.push_back(p);
  }

  SavedHistory DirectHistory::save() const
  {
    SavedHistory result;
    auto &saved = result.common;
    for (std::size_t step = 0; step < us.size(); ++step)
    {
      saved.insert(saved.end(), us[step].begin(), us[step].end());
      saved.insert(saved.end(), ps[step].begin(), ps[step].end());
    }
    return result;
  }

  void DirectHistory::restore(const SavedHistory &given)
  {
    const auto &saved = given.common;
    us.clear();
    ps.clear();
    const std::size_t size = kernel.size();
    for (std::size_t k = 0; k + 2 * size <= saved.size(); k += 2 * size)
    {
      us.push_back(Eigen::VectorXd::Map(saved.data() + k, size));
      ps.push_back(Eigen::VectorXd::Map(saved.data() + k + size, size));
    }
  }
} // namespace quoin
