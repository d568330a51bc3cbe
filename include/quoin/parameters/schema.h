// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_parameters_schema_h
#define quoin_parameters_schema_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace quoin
{
  /**
   * The entries that @p prm declares as JSON, for editors and other programs:
   *
   *     {"program": "quoin", "version": ..., "entries": [...], "sections":
   *      [{"name": ..., "entries": [...], "each": [...]}, ...]}
   *
   * where "each" has the entries of the subsections that 'Names' lists. An
   * entry has "name", "type" (number, integer, flag, choice, list, text),
   * "default", "description" and, where they are known, "unit", "minimum",
   * "above", "maximum" and "choices". A default is a text, as in a file.
   */
  std::string schema_text(const dealii::ParameterHandler &prm);

  /** The schema_text() of all parameters. */
  std::string parameter_schema();
} // namespace quoin

#endif
