// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/sparse_factors.h>

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace quoin
{
  namespace
  {
    /** Columns that are eliminated together. */
    constexpr int block_size = 24;

    using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

    /** Scalar product in eight parts, which the compiler takes at once. */
    double product(const double *a, const double *b, const int n)
    {
      double parts[8] = {}, rest = 0.;
      int i = 0;
      for (; i + 8 <= n; i += 8)
        for (int k = 0; k < 8; ++k)
          parts[k] += a[i + k] * b[i + k];
      for (; i < n; ++i)
        rest += a[i] * b[i];
      for (const double part : parts)
        rest += part;
      return rest;
    }

    bool is_symmetric(const int n, const int *starts, const int *columns)
    {
      for (int i = 0; i < n; ++i)
        for (int e = starts[i]; e < starts[i + 1]; ++e)
          if (!std::binary_search(columns + starts[columns[e]],
                                  columns + starts[columns[e] + 1], i))
            return false;
      return true;
    }
  } // namespace

  bool SparseFactors::analyse(const int n, const int *starts,
                              const int *columns)
  {
    supernodes.clear();
    for (int i = 0; i < n; ++i)
      if (!std::is_sorted(columns + starts[i], columns + starts[i + 1]))
        return false;
    if (n == 0 || !is_symmetric(n, starts, columns))
      return false;

    cholmod_common common;
    cholmod_start(&common);
    common.supernodal         = CHOLMOD_SUPERNODAL;
    common.print              = 0;
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_NESDIS;
    cholmod_sparse pattern{};
    pattern.nrow = pattern.ncol = n;
    pattern.nzmax               = starts[n];
    pattern.p                   = const_cast<int *>(starts);
    pattern.i                   = const_cast<int *>(columns);
    pattern.stype               = 1;
    pattern.itype               = CHOLMOD_INT;
    pattern.xtype               = CHOLMOD_PATTERN;
    pattern.dtype               = CHOLMOD_DOUBLE;
    pattern.sorted = pattern.packed = 1;
    cholmod_factor *found           = cholmod_analyze(&pattern, &common);
    const bool is_found = found && found->is_super && common.status >= 0;
    std::vector<int> place(n), supernode_of(n);
    if (is_found)
    {
      const int *perm  = static_cast<int *>(found->Perm),
                *super = static_cast<int *>(found->super),
                *begin = static_cast<int *>(found->pi),
                *rows  = static_cast<int *>(found->s);
      permutation.assign(perm, perm + n);
      supernodes.resize(found->nsuper);
      for (unsigned int s = 0; s < supernodes.size(); ++s)
      {
        Supernode &node = supernodes[s];
        node.first      = super[s];
        node.n_columns  = super[s + 1] - super[s];
        node.rows.assign(rows + begin[s], rows + begin[s + 1]);
        node.n_rows = node.rows.size();
        std::fill(supernode_of.begin() + super[s],
                  supernode_of.begin() + super[s + 1], s);
      }
    }
    cholmod_free_factor(&found, &common);
    cholmod_finish(&common);
    if (!is_found)
      return false;

    for (int k = 0; k < n; ++k)
      place[permutation[k]] = k;
    const auto find = [](const Supernode &node, const int row)
    {
      return int(std::lower_bound(node.rows.begin(), node.rows.end(), row)
                 - node.rows.begin());
    };
    for (int i = 0; i < n; ++i)
      for (int e = starts[i]; e < starts[i + 1]; ++e)
      {
        const int a = place[i], b = place[columns[e]];
        Supernode &node = supernodes[supernode_of[std::min(a, b)]];
        node.entries.push_back(
            { e, find(node, a) + find(node, b) * node.n_rows });
      }
    std::size_t largest = 0, stacked = 0, most = 0;
    for (Supernode &node : supernodes)
    {
      const std::size_t n_rows = node.n_rows;
      const std::size_t n_more = n_rows - node.n_columns;
      largest                  = std::max(largest, n_rows * n_rows);
      if (n_more > 0)
      {
        Supernode &parent = supernodes[supernode_of[node.rows[node.n_columns]]];
        ++parent.n_children;
        for (std::size_t k = node.n_columns; k < n_rows; ++k)
          node.in_parent.push_back(find(parent, node.rows[k]));
      }
      node.lower.resize(n_rows, node.n_columns);
      node.upper.resize(n_more, node.n_columns);
      node.exchanges.resize(node.n_columns);
    }
    // Supernodes are in postorder: the updates of children lie on the top.
    std::vector<std::size_t> stack;
    for (const Supernode &node : supernodes)
    {
      for (unsigned int c = 0; c < node.n_children; ++c)
      {
        stacked -= stack.back();
        stack.pop_back();
      }
      if (const std::size_t m = node.in_parent.size(); m > 0)
      {
        stack.push_back(m * m);
        stacked += m * m;
        most = std::max(most, stacked);
      }
    }
    front.resize(largest);
    updates.resize(most);
    work.resize(n);
    gathered.resize(std::size_t(std::sqrt(double(largest)) + 0.5));
    return true;
  }

  bool SparseFactors::factorise(const double *values)
  {
    std::vector<unsigned int> stack; // supernodes
    double *top = updates.data();
    for (unsigned int s = 0; s < supernodes.size(); ++s)
    {
      Supernode &node = supernodes[s];
      const int n = node.n_columns, n_rows = node.n_rows, m = n_rows - n;
      front.head(std::size_t(n_rows) * n_rows).setZero();
      for (const Entry &entry : node.entries)
        front[entry.offset] += values[entry.value];
      for (unsigned int c = 0; c < node.n_children; ++c)
      {
        const std::vector<int> &to = supernodes[stack.back()].in_parent;
        const std::size_t size     = to.size();
        stack.pop_back();
        top -= size * size;
        for (std::size_t j = 0; j < size; ++j)
        {
          double *column       = front.data() + std::size_t(to[j]) * n_rows;
          const double *update = top + j * size;
          for (std::size_t i = 0; i < size; ++i)
            column[to[i]] += update[i];
        }
      }

      const Matrix all(front.data(), n_rows, n_rows,
                       Eigen::OuterStride<>(n_rows));
      node.lower = all.leftCols(n);
      node.upper = all.topRightCorner(n, m).transpose();
      for (int begin = 0; begin < n; begin += block_size)
        if (!eliminate(node, begin, std::min(block_size, n - begin)))
          return false;
      if (m == 0)
        continue;
      Matrix update(top, m, m, Eigen::OuterStride<>(m));
      update = all.bottomRightCorner(m, m);
      update.noalias() -= node.lower.bottomRows(m) * node.upper.transpose();
      top += std::size_t(m) * m;
      stack.push_back(s);
    }
    return true;
  }

  bool SparseFactors::eliminate(Supernode &node, const int begin,
                                const int size)
  {
    const int n = node.n_columns, n_rows = node.n_rows;
    auto &lower = node.lower;
    auto &upper = node.upper;
    for (int k = begin; k < begin + size; ++k)
    {
      int pivot;
      const double largest
          = lower.col(k).segment(k, n - k).cwiseAbs().maxCoeff(&pivot);
      if (!(largest > 0.))
        return false;
      pivot += k;
      node.exchanges[k] = pivot;
      if (pivot != k)
      {
        lower.row(k).swap(lower.row(pivot));
        upper.col(k).swap(upper.col(pivot));
      }
      const int left = n_rows - k - 1;
      lower.col(k).tail(left) /= lower(k, k);
      for (int j = k + 1; j < begin + size; ++j)
        lower.col(j).tail(left) -= lower(k, j) * lower.col(k).tail(left);
    }
    // Rows of other columns, once no row is exchanged any more.
    const int next = begin + size, later = n - next;
    for (int k = begin; k < next; ++k)
      for (int j = k + 1; j < next; ++j)
      {
        upper.col(j) -= lower(j, k) * upper.col(k);
        lower.row(j).tail(later) -= lower(j, k) * lower.row(k).tail(later);
      }
    if (later == 0)
      return true;
    lower.bottomRightCorner(n_rows - next, later).noalias()
        -= lower.block(next, begin, n_rows - next, size)
           * lower.block(begin, next, size, later);
    if (upper.rows() > 0)
      upper.rightCols(later).noalias()
          -= upper.middleCols(begin, size)
             * lower.block(next, begin, later, size).transpose();
    return true;
  }

  void SparseFactors::solve(const double *right_hand_side, double *solution)
  {
    for (unsigned int k = 0; k < permutation.size(); ++k)
      work[k] = right_hand_side[permutation[k]];
    for (const Supernode &node : supernodes)
    {
      const int n = node.n_columns, m = node.n_rows - n;
      auto own = work.segment(node.first, n);
      for (int k = 0; k < n; ++k)
        std::swap(own[k], own[node.exchanges[k]]);
      for (int j = 0; j < n; ++j)
        own.tail(n - j - 1)
            -= own[j] * node.lower.col(j).segment(j + 1, n - j - 1);
      auto more = gathered.head(m);
      if (m > 0)
        more.noalias() = node.lower.bottomRows(m) * own;
      for (int i = 0; i < m; ++i)
        work[node.rows[n + i]] -= more[i];
    }
    for (auto node = supernodes.rbegin(); node != supernodes.rend(); ++node)
    {
      const int n = node->n_columns, m = node->n_rows - n;
      auto own  = work.segment(node->first, n);
      auto more = gathered.head(m);
      for (int i = 0; i < m; ++i)
        more[i] = work[node->rows[n + i]];
      for (int j = 0; j < n; ++j)
        own[j] -= product(node->upper.col(j).data(), more.data(), m);
      for (int j = n - 1; j >= 0; --j)
      {
        own[j] /= node->lower(j, j);
        own.head(j) -= own[j] * node->lower.col(j).head(j);
      }
    }
    for (unsigned int k = 0; k < permutation.size(); ++k)
      solution[permutation[k]] = work[k];
  }
} // namespace quoin
