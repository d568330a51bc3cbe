// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_parameter_section_h
#define quoin_base_parameter_section_h

#include <quoin/base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * One subsection of a parameter file, entered for the lifetime of this
   * object. Reads values and refuses wrong ones with a sentence that names
   * file, section, parameter, value and cure (InputError).
   */
  class ParameterSection
  {
  public:
    /** The top of @p file, whose values @p prm holds. */
    ParameterSection(dealii::ParameterHandler &prm, std::string file);

    /** The subsection @p name of @p parent. */
    ParameterSection(const ParameterSection &parent, const std::string &name);

    ParameterSection(const ParameterSection &) = delete;
    ~ParameterSection();

    std::string text(const std::string &name) const;
    double number(const std::string &name) const;
    double positive(const std::string &name) const;
    double nonnegative(const std::string &name) const;
    /** A number in [low, high]. */
    double within(const std::string &name, double low, double high) const;
    /** Comma-separated words; empty if the text is. */
    std::vector<std::string> list(const std::string &name) const;
    /** Exactly N comma-separated numbers. */
    template <std::size_t N>
    std::array<double, N> numbers(const std::string &name) const
    {
      std::array<double, N> result{};
      const auto values = number_list(name, N);
      std::copy(values.begin(), values.end(), result.begin());
      return result;
    }
    /** One of the words of @p table, returned as its value. */
    template <typename Enum>
    Enum choice(const std::string &name,
                const std::vector<std::pair<std::string, Enum>> &table) const
    {
      std::string words;
      for (const auto &[word, value] : table)
      {
        if (text(name) == word)
          return value;
        words += (words.empty() ? "" : ", ") + word;
      }
      fail(name, "must be one of: " + words + ".");
    }

    /** Throws an InputError about the value of @p name. */
    [[noreturn]] void fail(const std::string &name,
                           const std::string &why) const;

    /** The result of @p make(); its InputErrors become errors of @p name. */
    template <typename Make>
    auto made(const std::string &name, const Make &make) const
    {
      try
      {
        return make();
      }
      catch (const InputError &error)
      {
        fail(name, error.what());
      }
    }

    const std::string &file() const
    {
      return file_name;
    }
    /** Folder of the parameter file, with a trailing slash. */
    std::string folder() const;

  private:
    std::vector<double> number_list(const std::string &name,
                                    std::size_t size) const;

    dealii::ParameterHandler &prm;
    std::string file_name;
    std::string path;
    bool entered;
  };

  /**
   * The value of @p name as rows of @p n_columns finite numbers, such as
   * "0, 0; 10, 5"; none if the text is empty. @p must_be: the end of the
   * message about anything else.
   */
  std::vector<std::vector<double>> number_rows(const ParameterSection &section,
                                               const std::string &name,
                                               std::size_t n_columns,
                                               const std::string &must_be);

  /** @p path in the folder of the parameter file, unless it is absolute. */
  std::string in_folder(const ParameterSection &section,
                        const std::string &path);
} // namespace quoin

#endif
