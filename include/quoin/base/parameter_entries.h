// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_parameter_entries_h
#define quoin_base_parameter_entries_h

#include <quoin/base/parameter_section.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /** Numbers as in parameter files: 1e6, not 1e+06. */
  std::string default_text(const std::vector<double> &values);

  /**
   * The entries of one section of a parameter file, each written once, by a
   * function
   *
   *     void enter(ParameterEntries &entries, T &parameters)
   *     {
   *       entries.choice("Damping", parameters.damping, words, "...");
   *       if (entries.reads_if(parameters.damping == local))
   *         entries.within("Coefficient", parameters.coefficient, 0., 1.,
   * "..");
   *     }
   *
   * that declare_entries() and read_entries() call. Where entries are declared
   * the variables hold the defaults; where they are read they get the values,
   * and wrong ones are refused as by ParameterSection. The last argument of
   * each function is its sentence in the reference manual.
   */
  class ParameterEntries
  {
  public:
    explicit ParameterEntries(dealii::ParameterHandler &prm) : prm(&prm)
    {
    }
    explicit ParameterEntries(const ParameterSection &section)
      : section(&section)
    {
    }

    /** Whether to process entries that are read only if @p condition holds; all
        are declared. */
    bool reads_if(const bool condition) const
    {
      return prm != nullptr || condition;
    }
    /** The section that is read; null while entries are declared. Check
        combinations of values only if it is not null. */
    const ParameterSection *read_section() const
    {
      return section;
    }

    /** A finite number; @p unit: value in the program of 1 in the file. */
    void number(const std::string &name, double &value,
                const std::string &sentence, double unit = 1.);
    /** A positive number, see ParameterSection::positive(). */
    void positive(const std::string &name, double &value,
                  const std::string &sentence);
    void nonnegative(const std::string &name, double &value,
                     const std::string &sentence);
    /** A number in [@p low, @p high], both as in the file. */
    void within(const std::string &name, double &value, double low, double high,
                const std::string &sentence, double unit = 1.);
    /** A number, or @p word for @p word_value. */
    void number_or(const std::string &word, double word_value,
                   const std::string &name, double &value,
                   const std::string &sentence);

    /** An integer in [@p least, @p most], which the library checks. */
    template <typename Integer>
    void integer(const std::string &name, Integer &value, const int least,
                 const std::string &sentence,
                 const int most = dealii::Patterns::Integer::max_int_value)
    {
      if (declare(name, std::to_string(value),
                  dealii::Patterns::Integer(least, most), sentence))
        return;
      value = static_cast<Integer>(section->number(name));
    }

    /** yes, no, true or false. */
    void flag(const std::string &name, bool &value,
              const std::string &sentence);
    void text(const std::string &name, std::string &value,
              const std::string &sentence);
    /** Comma-separated words. */
    void list(const std::string &name, std::vector<std::string> &value,
              const std::string &sentence);
    /** Pairs of words, such as "a:b, c:d". If @p all is given, the word 'all'
        may stand among them and sets it. @p must_be: the end of the message
        about anything else. */
    void pairs(const std::string &name,
               std::vector<std::pair<std::string, std::string>> &value,
               const std::string &must_be, const std::string &sentence,
               bool *all = nullptr);

    /** N comma-separated numbers. */
    template <std::size_t N>
    void numbers(const std::string &name, std::array<double, N> &value,
                 const std::string &sentence)
    {
      if (declare(name, default_text({ value.begin(), value.end() }),
                  dealii::Patterns::Anything(), sentence))
        return;
      value = section->numbers<N>(name);
    }

    /** One of the words of @p table and its value; of several words for a
        value, the first one is the default. */
    template <typename T>
    void choice(const std::string &name, T &value,
                const std::vector<std::pair<std::string, T>> &table,
                const std::string &sentence)
    {
      if (section)
      {
        value = section->choice<T>(name, table);
        return;
      }
      std::string words, preset;
      for (const auto &[word, meaning] : table)
      {
        words += (words.empty() ? "" : "|") + word;
        if (meaning == value && preset.empty())
          preset = word;
      }
      declare(name, preset, dealii::Patterns::Selection(words), sentence);
    }

    /**
     * An entry whose text @p read turns into a value, as
     * read(section), where it is read.
     */
    template <typename Read>
    void other(const std::string &name, const std::string &preset,
               const std::string &sentence, const Read &read)
    {
      if (!declare(name, preset, dealii::Patterns::Anything(), sentence))
        read(*section);
    }

  private:
    /** Declares the entry unless a section is read; returns whether it did. */
    bool declare(const std::string &name, const std::string &preset,
                 const dealii::Patterns::PatternBase &pattern,
                 const std::string &sentence);

    dealii::ParameterHandler *prm   = nullptr;
    const ParameterSection *section = nullptr;
  };

  /** The first word of @p table, as choice() takes it, for @p value. */
  template <typename T>
  std::string word_of(const std::vector<std::pair<std::string, T>> &table,
                      const T &value)
  {
    for (const auto &[word, meaning] : table)
      if (meaning == value)
        return word;
    return "";
  }

  /** Declares what @p enter names, with the defaults of a new T. */
  template <typename T>
  void declare_entries(dealii::ParameterHandler &prm,
                       void (*enter)(ParameterEntries &, T &))
  {
    ParameterEntries entries(prm);
    T parameters;
    enter(entries, parameters);
  }

  /** Reads what @p enter names into a new T. */
  template <typename T>
  T read_entries(const ParameterSection &section,
                 void (*enter)(ParameterEntries &, T &))
  {
    ParameterEntries entries(section);
    T parameters;
    enter(entries, parameters);
    return parameters;
  }
} // namespace quoin

#endif
