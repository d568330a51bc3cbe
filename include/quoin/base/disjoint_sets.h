// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_disjoint_sets_h
#define quoin_base_disjoint_sets_h

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Disjoint sets of the numbers below n. The representative of a set is its
   * smallest member, so that numbers by representatives do not depend on the
   * order of the unions; in boost::disjoint_sets this holds only between a call
   * of normalize_sets() and the next union.
   */
  class DisjointSets
  {
  public:
    explicit DisjointSets(const unsigned int n) : parent(n)
    {
      std::iota(parent.begin(), parent.end(), 0U);
    }

    /** The representative of the set of @p i. */
    unsigned int find(unsigned int i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }

    void unite(const unsigned int i, const unsigned int j)
    {
      const unsigned int a = find(i), b = find(j);
      parent[std::max(a, b)] = std::min(a, b);
    }

    /** The number of the set of each i, in the order of first members, and the
        number of sets. */
    std::pair<std::vector<unsigned int>, unsigned int> numbers()
    {
      std::vector<unsigned int> result(parent.size());
      unsigned int n = 0;
      for (unsigned int i = 0; i < parent.size(); ++i)
      {
        const unsigned int first = find(i);
        result[i]                = first == i ? n++ : result[first];
      }
      return { result, n };
    }

  private:
    std::vector<unsigned int> parent;
  };
} // namespace quoin

#endif
