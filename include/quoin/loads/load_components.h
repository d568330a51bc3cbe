// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_load_components_h
#define quoin_loads_load_components_h

#include <quoin/loads/load_parameters.h>

#include <string>

namespace quoin
{
  // What parameters of a load say of its components. Each throws an InputError
  // about the parameter @p name of @p section.

  /** The function of time @p text, which may not depend on the place. */
  TimeFunction time_function(const ParameterSection &section,
                             const std::string &name, const std::string &text);

  /** "free", or a function of time that stands for @p quantity. A prescribed
      motion may have 'velocity' or 'displacement' before it; other loads take
      no such word. */
  LoadComponent load_component(const ParameterSection &section,
                               const std::string &name, LoadQuantity quantity);

  /** "free", or 'velocity', 'displacement' or 'force' and a function. */
  LoadComponent platen_component(const ParameterSection &section,
                                 const std::string &name);
  /** "free", or 'velocity', 'displacement' or 'moment' and a function. */
  LoadComponent rotation_component(const ParameterSection &section,
                                   const std::string &name);

  /** A load_component(), or "water" and its level; "uplift" gives a component
      without a value. */
  LoadComponent pressure_component(const ParameterSection &section,
                                   const std::string &name);
} // namespace quoin

#endif
