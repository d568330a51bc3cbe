// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/unread_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    bool are_equal(const std::string &a, const std::string &b)
    {
      using dealii::Utilities::split_string_list;
      using dealii::Utilities::string_to_double;
      if (a == b)
        return true;
      try
      {
        return string_to_double(split_string_list(a, ','))
               == string_to_double(split_string_list(b, ','));
      }
      catch (const dealii::ExceptionBase &) // words
      {
        return false;
      }
    }
  } // namespace

  void refuse_unread(const ParameterSection &section,
                     const std::string &chooser,
                     const std::vector<SelectiveParameter> &table)
  {
    const std::string kind = section.text(chooser);
    for (const auto &[name, unset, kinds] : table)
    {
      if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()
          || are_equal(section.text(name), unset))
        continue;
      std::string readers;
      for (const std::string &one : kinds)
        readers += (readers.empty() ? "'" : ", '") + one + "'";
      section.fail(name,
                   "has no effect with '" + chooser + " = " + kind
                       + "', only with " + readers + ". "
                       + (unset.empty() ? "Leave it empty."
                                        : "Leave it at '" + unset + "'."));
    }
  }
} // namespace quoin
