// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_named_sections_h
#define quoin_base_named_sections_h

#include <quoin/base/parameter_section.h>

#include <string>
#include <vector>

namespace quoin
{
  /** A section and the function that declares its entries; for sections with
      'Names', those of each listed subsection. */
  struct SectionEntries
  {
    std::string name;
    void (*declare)(dealii::ParameterHandler &);
  };

  /** Declares @p sections with their entries. */
  void declare_sections(const std::vector<SectionEntries> &sections,
                        dealii::ParameterHandler &prm);

  /** Declares @p sections with the entry 'Names'. */
  void declare_names(const std::vector<SectionEntries> &sections,
                     dealii::ParameterHandler &prm);

  /**
   * Declares the subsections that 'Names' in @p names lists. Throws an
   * InputError that begins with @p file about names that appear twice or are
   * parameters.
   */
  void declare_listed(const std::vector<SectionEntries> &sections,
                      const std::string &file, dealii::ParameterHandler &names,
                      dealii::ParameterHandler &prm);

  /**
   * Declares the subsections of @p found of @p section that 'Names' in
   * @p names does not list, whose values are read and not used. Returns a
   * warning about each. Throws an InputError that begins with @p file about
   * one that may be meant by a listed name that has no subsection.
   */
  std::vector<std::string>
  declare_unlisted(const SectionEntries &section, const std::string &file,
                   const std::vector<std::string> &found,
                   dealii::ParameterHandler &names,
                   dealii::ParameterHandler &prm);

  /** Declares a subsection NAME in each of @p sections, for a reference. */
  void declare_examples(const std::vector<SectionEntries> &sections,
                        dealii::ParameterHandler &prm);

  /** T::read() of each subsection of @p section_name that its 'Names' lists. */
  template <typename T>
  std::vector<T> read_named(const ParameterSection &top,
                            const std::string &section_name)
  {
    const ParameterSection section(top, section_name);
    std::vector<T> result;
    for (const std::string &name : section.list("Names"))
      result.push_back(T::read(ParameterSection(section, name), name));
    return result;
  }
} // namespace quoin

#endif
