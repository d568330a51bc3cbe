// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_parameter_file_h
#define quoin_base_parameter_file_h

#include <quoin/base/noted_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /** The text of a parameter file, with the overrides of the command line. */
  class ParameterFile
  {
  public:
    /**
     * Reads @p file; @p overrides are of the form "Section/Name=value".
     * Throws an InputError if the file cannot be read.
     */
    ParameterFile(std::string file, std::vector<std::string> overrides);

    /**
     * Puts its values into @p prm, those of the command line last; 'include'
     * resolves against the folder of the file. With @p skip_undefined it skips
     * entries that @p prm does not declare. Throws an InputError that names
     * file, line, section and cure.
     */
    void parse(dealii::ParameterHandler &prm, bool skip_undefined) const;

    /** The names of the subsections that it has in @p section, in their order.
     */
    std::vector<std::string> subsections(const std::string &section) const;

    /** Warnings about overrides of entries of @p prm that have not been read,
       so that they have no effect. Throws an InputError about one in a
       subsection that no 'Names' lists. */
    std::vector<std::string> idle_overrides(NotedParameters &prm) const;

  private:
    std::string file;
    std::string text;
    std::vector<std::string> overrides;
  };

  /**
   * What differs between two texts of the parameters of a run, as
   * ParameterHandler prints them in short: "'Loads/push/Vertical' was '-1' and
   * is '-2'", at most five of them; empty if nothing does.
   */
  std::string parameter_changes(const std::string &before,
                                const std::string &now);
} // namespace quoin

#endif
