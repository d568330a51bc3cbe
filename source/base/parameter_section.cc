// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/finite_numbers.h>
#include <quoin/base/noted_parameters.h>
#include <quoin/base/parameter_section.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

namespace quoin
{
  using dealii::Utilities::split_string_list;

  namespace
  {
    /** Notes that the entry @p name of the section @p path is read. */
    void note(dealii::ParameterHandler &prm, const std::string &path,
              const std::string &name)
    {
      if (auto *const noted = dynamic_cast<NotedParameters *>(&prm))
        noted->read.insert(path.empty() ? name : path + "/" + name);
    }
  } // namespace

  ParameterSection::ParameterSection(dealii::ParameterHandler &prm,
                                     std::string file)
    : prm(prm), file_name(std::move(file)), entered(false)
  {
  }

  ParameterSection::ParameterSection(const ParameterSection &parent,
                                     const std::string &name)
    : prm(parent.prm), file_name(parent.file_name),
      path(parent.path.empty() ? name : parent.path + "/" + name), entered(true)
  {
    prm.enter_subsection(name);
  }

  ParameterSection::~ParameterSection()
  {
    if (entered)
      prm.leave_subsection();
  }

  std::string ParameterSection::text(const std::string &name) const
  {
    note(prm, path, name);
    return prm.get(name);
  }

  double ParameterSection::number(const std::string &name) const
  {
    note(prm, path, name);
    double value = std::numeric_limits<double>::quiet_NaN();
    try
    {
      value = prm.get_double(name);
    }
    catch (const dealii::ExceptionBase &)
    {
      // The pattern accepts numbers that are too small for a double.
    }
    if (!std::isfinite(value))
      fail(name, "must be a finite number, and 0 rather than one below "
                 "1e-300.");
    return value;
  }

  double ParameterSection::positive(const std::string &name) const
  {
    const double value = number(name);
    if (!(value > 0.))
      fail(name, "must be positive: give a number above zero.");
    // Products of values outside this range overflow.
    if (value < 1e-60 || value > 1e60)
      fail(name, "is outside the admissible range: check its power of ten.");
    return value;
  }

  double ParameterSection::nonnegative(const std::string &name) const
  {
    const double value = number(name);
    if (value < 0.)
      fail(name, "must not be negative: give zero or a positive number.");
    return value;
  }

  double ParameterSection::within(const std::string &name, const double low,
                                  const double high) const
  {
    const double value = number(name);
    if (!(value >= low && value <= high))
    {
      std::ostringstream why;
      why << "must lie between " << low << " and " << high << ".";
      fail(name, why.str());
    }
    return value;
  }

  std::vector<std::string> ParameterSection::list(const std::string &name) const
  {
    auto words = split_string_list(text(name), ',');
    if (words.size() == 1 && words.front().empty())
      words.clear();
    for (const std::string &word : words)
      if (word.empty())
        fail(name, "has nothing before or between commas: remove a comma.");
    return words;
  }

  std::vector<double>
  ParameterSection::number_list(const std::string &name,
                                const std::size_t size) const
  {
    const auto values = finite_numbers(list(name));
    if (values.size() != size)
      fail(name,
           "must be " + std::to_string(size) + " numbers separated by commas.");
    return values;
  }

  void ParameterSection::fail(const std::string &name,
                              const std::string &why) const
  {
    throw InputError(
        place_of(prm, path.empty() ? name : path + "/" + name, file_name)
        + section_phrase(path) + ": '" + name + " = " + text(name) + "' "
        + why);
  }

  std::string ParameterSection::folder() const
  {
    const auto parent = std::filesystem::path(file_name).parent_path();
    return parent.empty() ? "./" : parent.string() + "/";
  }

  std::vector<std::vector<double>> number_rows(const ParameterSection &section,
                                               const std::string &name,
                                               const std::size_t n_columns,
                                               const std::string &must_be)
  {
    std::vector<std::vector<double>> result;
    for (const std::string &row : split_string_list(section.text(name), ';'))
    {
      result.push_back(finite_numbers(split_string_list(row, ',')));
      if (result.back().size() != n_columns)
        section.fail(name, must_be);
    }
    return result;
  }

  std::string in_folder(const ParameterSection &section,
                        const std::string &path)
  {
    return !path.empty() && path.front() == '/' ? path
                                                : section.folder() + path;
  }
} // namespace quoin
