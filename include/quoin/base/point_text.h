// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_point_text_h
#define quoin_base_point_text_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace quoin
{
  /** "(1, 2)" for a message: coordinates [m] have at least six digits, and
      large ones, such as those of maps, at least three decimals. */
  template <int dim>
  std::string point_text(const dealii::Tensor<1, dim> &point)
  {
    double largest = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      largest = std::max(largest, std::abs(point[d]));
    std::ostringstream text;
    if (std::isfinite(largest))
      text.precision(std::max(6, 4 + static_cast<int>(std::log10(largest))));
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "(" : ", ") << point[d];
    text << ")";
    return text.str();
  }
} // namespace quoin

#endif
