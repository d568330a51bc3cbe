// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_thickness_h
#define quoin_base_thickness_h

#include <algorithm>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Thickness of a plane model out of the plane [m]: one for all cells, or one
   * for each kind of them, such as a physical surface. Two cells that touch do
   * so over the smaller of theirs. In three dimensions it is 1.
   */
  class Thickness
  {
  public:
    Thickness(const double everywhere = 1.) : values(1, everywhere)
    {
    }
    explicit Thickness(std::vector<double> of_each) : values(std::move(of_each))
    {
    }

    double operator[](const unsigned int kind) const
    {
      return values.size() == 1 ? values[0] : values[kind];
    }
    double common(const unsigned int a, const unsigned int b) const
    {
      return std::min((*this)[a], (*this)[b]);
    }

  private:
    std::vector<double> values;
  };
} // namespace quoin

#endif
