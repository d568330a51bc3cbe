// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_noted_parameters_h
#define quoin_base_noted_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <set>
#include <string>

namespace quoin
{
  /** Parameters with a note of the entries that a ParameterSection has read. */
  class NotedParameters : public dealii::ParameterHandler
  {
  public:
    /** Names of the entries read, with their sections as in "Section/Name". */
    std::set<std::string> read;
  };
} // namespace quoin

#endif
