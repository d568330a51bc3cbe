// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_unread_parameters_h
#define quoin_base_unread_parameters_h

#include <quoin/base/parameter_section.h>

#include <string>
#include <vector>

namespace quoin
{
  /** A parameter that only some kinds of its section use. */
  struct SelectiveParameter
  {
    std::string name;
    std::string unset; /**< value of a parameter that is not given */
    std::vector<std::string> kinds; /**< kinds that use it */
  };

  /**
   * Refuses parameters set without effect: those of @p table that the kind of
   * the section, the value of @p chooser, does not use. Numbers are compared as
   * such.
   */
  void refuse_unread(const ParameterSection &section,
                     const std::string &chooser,
                     const std::vector<SelectiveParameter> &table);
} // namespace quoin

#endif
