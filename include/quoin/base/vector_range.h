// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_vector_range_h
#define quoin_base_vector_range_h

#include <quoin/base/lane_functions.h>
#include <quoin/base/native_lanes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace quoin
{
  /** The box around vectors of two components; empty at first. */
  struct VectorRange
  {
    static constexpr unsigned int dim = 2;
    /** Largest component in each direction, and minus the least one. */
    std::array<double, 2 * dim> largest;

    VectorRange()
    {
      largest.fill(-std::numeric_limits<double>::infinity());
    }
    void take(const double component, const unsigned int d)
    {
      largest[d]       = std::max(largest[d], component);
      largest[dim + d] = std::max(largest[dim + d], -component);
    }
    /** Length of the diagonal, which bounds the difference of two vectors. */
    double diagonal() const
    {
      return largest[0] < -largest[dim]
                 ? 0.
                 : std::hypot(largest[0] + largest[2], largest[1] + largest[3]);
    }
  };

  /**
   * The range of @p n components, x and y in turn: @p lanes_at returns those of
   * native_lanes from a place on, @p at one of them.
   */
  template <typename LanesAt, typename At>
  VectorRange range_of(const std::size_t n, const LanesAt &lanes_at,
                       const At &at)
  {
    using F                    = LaneFunctions<native_lanes>;
    constexpr unsigned int dim = VectorRange::dim;
    static_assert(native_lanes % dim == 0);
    // Several vectors, none of which waits for the others.
    constexpr unsigned int n_chains = 4;
    constexpr double infinity       = std::numeric_limits<double>::infinity();
    F::Value largest[n_chains], least[n_chains];
    std::fill_n(largest, n_chains, F::Value{} - infinity);
    std::fill_n(least, n_chains, F::Value{} + infinity);
    std::size_t i = 0;
    for (; i + n_chains * native_lanes <= n; i += n_chains * native_lanes)
      for (unsigned int k = 0; k < n_chains; ++k)
      {
        const F::Value value = lanes_at(i + k * native_lanes);
        largest[k]           = F::maximum(largest[k], value);
        least[k]             = F::minimum(least[k], value);
      }
    VectorRange range;
    for (std::size_t j = i; j < n; ++j)
      range.take(at(j), j % dim);
    for (unsigned int k = 0; k < n_chains && i > 0; ++k)
      for (unsigned int l = 0; l < native_lanes; ++l)
      {
        range.take(F::at(largest[k], l), l % dim);
        range.take(F::at(least[k], l), l % dim);
      }
    return range;
  }
} // namespace quoin

#endif
