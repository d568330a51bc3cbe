// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_element_limit_h
#define quoin_layout_element_limit_h

#include <quoin/base/parameter_section.h>

namespace quoin
{
  /**
   * Throws an InputError about 'Element size' if it makes @p n elements, more
   * than fit into the memory of a machine.
   */
  inline void limit_elements(const ParameterSection &section, const double n)
  {
    constexpr double most_elements = 1e8;
    if (!(n <= most_elements))
      section.fail("Element size",
                   "makes more than 100 million elements. Check "
                   "that lengths are in metres.");
  }
} // namespace quoin

#endif
