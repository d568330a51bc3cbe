// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>

#include <deal.II/base/utilities.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

namespace quoin
{
  using dealii::Patterns::Anything;
  using dealii::Patterns::Double;

  namespace
  {
    /** The pattern @p Base with words of our own about what is meant, which
        messages and the schema have. Ranges are checked where entries are
        read, with a sentence about the value. */
    template <typename Base>
    class Described : public Base
    {
    public:
      explicit Described(std::string words) : words(std::move(words))
      {
      }
      std::string description(const typename Base::OutputStyle
                              = Base::Machine) const override
      {
        return words;
      }
      std::unique_ptr<dealii::Patterns::PatternBase> clone() const override
      {
        return std::make_unique<Described>(words);
      }

    private:
      std::string words;
    };
    using Number = Described<Double>;
    using Text   = Described<Anything>;
  } // namespace

  bool ParameterEntries::declare(const std::string &name,
                                 const std::string &preset,
                                 const dealii::Patterns::PatternBase &pattern,
                                 const std::string &sentence)
  {
    if (prm)
      prm->declare_entry(name, preset, pattern, sentence);
    return prm != nullptr;
  }

  std::string default_text(const std::vector<double> &values)
  {
    std::string result;
    for (const double value : values)
    {
      char digits[32];
      // Fifteen digits: a quotient by a unit may be off in the last one.
      const auto end
          = std::abs(value) < 1e6
                ? std::to_chars(digits, digits + sizeof(digits), value,
                                std::chars_format::general, 15)
                      .ptr
                : std::to_chars(digits, digits + sizeof(digits), value,
                                std::chars_format::scientific)
                      .ptr;
      std::string text(digits, end);
      // Writes 1e-7 and 1e6, not 1e-07 and 1e+06.
      if (const auto power = text.find('e'); power != std::string::npos)
        text = text.substr(0, power + 1)
               + std::to_string(std::stoi(text.substr(power + 1)));
      result += (result.empty() ? "" : ", ") + text;
    }
    return result;
  }

  void ParameterEntries::number(const std::string &name, double &value,
                                const std::string &sentence, const double unit)
  {
    if (!declare(name, default_text({ value / unit }), Number("number"),
                 sentence))
      value = section->number(name) * unit;
  }

  void ParameterEntries::positive(const std::string &name, double &value,
                                  const std::string &sentence)
  {
    if (!declare(name, default_text({ value }), Number("number above 0"),
                 sentence))
      value = section->positive(name);
  }

  void ParameterEntries::nonnegative(const std::string &name, double &value,
                                     const std::string &sentence)
  {
    if (!declare(name, default_text({ value }), Number("number of at least 0"),
                 sentence))
      value = section->nonnegative(name);
  }

  void ParameterEntries::within(const std::string &name, double &value,
                                const double low, const double high,
                                const std::string &sentence, const double unit)
  {
    if (!declare(name, default_text({ value / unit }),
                 Number("number from " + default_text({ low }) + " to "
                        + default_text({ high })),
                 sentence))
      value = section->within(name, low, high) * unit;
  }

  void ParameterEntries::number_or(const std::string &word,
                                   const double word_value,
                                   const std::string &name, double &value,
                                   const std::string &sentence)
  {
    if (!declare(name, value == word_value ? word : default_text({ value }),
                 Anything(), sentence))
      value = section->text(name) == word ? word_value
                                          : section->numbers<1>(name).front();
  }

  void ParameterEntries::flag(const std::string &name, bool &value,
                              const std::string &sentence)
  {
    if (!declare(name, value ? "yes" : "no",
                 dealii::Patterns::Selection("yes|no|true|false"), sentence))
      value = section->text(name) == "yes" || section->text(name) == "true";
  }

  void ParameterEntries::text(const std::string &name, std::string &value,
                              const std::string &sentence)
  {
    if (!declare(name, value, Anything(), sentence))
      value = section->text(name);
  }

  void ParameterEntries::list(const std::string &name,
                              std::vector<std::string> &value,
                              const std::string &sentence)
  {
    if (!declare(name, "", Text("list of words"), sentence))
      value = section->list(name);
  }

  void ParameterEntries::pairs(
      const std::string &name,
      std::vector<std::pair<std::string, std::string>> &value,
      const std::string &must_be, const std::string &sentence, bool *const all)
  {
    if (declare(name, "", Text("list of pairs a:b"), sentence))
      return;
    value.clear();
    for (const std::string &pair : section->list(name))
    {
      if (all != nullptr && pair == "all")
      {
        *all = true;
        continue;
      }
      const auto words = dealii::Utilities::split_string_list(pair, ':');
      if (words.size() != 2 || words[0].empty() || words[1].empty())
        section->fail(name, must_be);
      value.emplace_back(words[0], words[1]);
    }
  }
} // namespace quoin
