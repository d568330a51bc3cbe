// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_point_text_h
#define quoin_base_point_text_h

#include <deal.II/base/tensor.h>

#include <sstream>
#include <string>

namespace quoin
{
  /** "(1, 2)" for a message, with six digits. */
  template <int dim>
  std::string point_text(const dealii::Tensor<1, dim> &point)
  {
    std::ostringstream text;
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "(" : ", ") << point[d];
    text << ")";
    return text.str();
  }
} // namespace quoin

#endif
