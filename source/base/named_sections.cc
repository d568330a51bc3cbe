// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/known_names.h>
#include <quoin/base/named_sections.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/noted_parameters.h>

#include <set>

namespace quoin
{
  using dealii::ParameterHandler;

  namespace
  {
    /** Runs @p task in the subsection @p name. */
    template <typename Task>
    void in_section(ParameterHandler &prm, const std::string &name,
                    const Task &task)
    {
      prm.enter_subsection(name);
      task(prm);
      prm.leave_subsection();
    }

    /** Whether the section that @p prm is in has a parameter @p name. */
    bool has_entry(ParameterHandler &prm, const std::string &name)
    {
      try
      {
        // get() returns an empty text for an entry that does not exist.
        prm.set(name, prm.get(name));
        return true;
      }
      catch (const dealii::ExceptionBase &)
      {
        return false;
      }
    }

    std::vector<std::string> listed_names(const SectionEntries &section,
                                          ParameterHandler &names)
    {
      std::vector<std::string> listed;
      in_section(names, section.name,
                 [&](ParameterHandler &all) {
                   listed = dealii::Utilities::split_string_list(
                       all.get("Names"), ',');
                 });
      return listed;
    }

    /** Declares the subsections named in @p listed. */
    void declare_listed(const SectionEntries &section, const std::string &file,
                        const std::vector<std::string> &listed,
                        ParameterHandler &prm)
    {
      std::set<std::string> seen;
      for (const std::string &name : listed)
      {
        if (name.empty())
          continue;
        const std::string what
            = file + ", section '" + section.name + "': 'Names' lists '" + name;
        if (!seen.insert(name).second)
          throw InputError(what + "' twice. Names must differ.");
        if (has_entry(prm, name))
          throw InputError(what
                           + "', which is a parameter of this section. Take "
                             "another name.");
        in_section(prm, name, section.declare);
      }
    }
  } // namespace

  void declare_sections(const std::vector<SectionEntries> &sections,
                        ParameterHandler &prm)
  {
    for (const SectionEntries &section : sections)
      in_section(prm, section.name, section.declare);
  }

  void declare_names(const std::vector<SectionEntries> &sections,
                     ParameterHandler &prm)
  {
    for (const SectionEntries &section : sections)
      in_section(
          prm, section.name,
          [](ParameterHandler &all)
          {
            all.declare_entry(
                "Names", "", dealii::Patterns::Anything(),
                "Comma-separated names, each of which has a subsection.");
          });
  }

  void declare_listed(const std::vector<SectionEntries> &sections,
                      const std::string &file, ParameterHandler &names,
                      ParameterHandler &prm)
  {
    for (const SectionEntries &section : sections)
    {
      const auto listed = listed_names(section, names);
      in_section(prm, section.name,
                 [&](ParameterHandler &all)
                 { declare_listed(section, file, listed, all); });
    }
  }

  std::vector<std::string>
  declare_unlisted(const SectionEntries &section, const std::string &file,
                   const std::vector<std::string> &found,
                   ParameterHandler &names, ParameterHandler &prm)
  {
    /** Letters by which a misspelled name differs. */
    constexpr unsigned int near = 2;
    const auto listed           = listed_names(section, names);
    std::vector<std::string> warnings;
    for (const std::string &name : found)
    {
      if (is_among(name, listed))
        continue;
      const std::string what = "section '" + section.name
                               + "': 'Names' does not list its subsection '"
                               + name + "'";
      for (const std::string &other : listed)
        if (!is_among(other, found) && edit_distance(name, other) <= near)
          throw InputError(place_of(names, section.name + "/Names", file) + ", "
                           + what + ", but '" + other
                           + "', which has none. Spell them alike.");
      in_section(prm, section.name,
                 [&](ParameterHandler &all)
                 { in_section(all, name, section.declare); });
      warnings.push_back(what + ", which is left out.");
    }
    return warnings;
  }

  void declare_examples(const std::vector<SectionEntries> &sections,
                        ParameterHandler &prm)
  {
    for (const SectionEntries &section : sections)
      in_section(prm, section.name,
                 [&](ParameterHandler &all)
                 { in_section(all, "NAME", section.declare); });
  }
} // namespace quoin
