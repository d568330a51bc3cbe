// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_fuzz_mutations_h
#define quoin_tests_fuzz_mutations_h

#include <random>
#include <string>
#include <vector>

namespace quoin
{
  /** Right files, made wrong in places; the same seed makes the same ones. */
  class Mutator
  {
  public:
    explicit Mutator(const std::uint64_t seed) : random(seed)
    {
    }

    /** Below @p n. */
    std::size_t below(const std::size_t n)
    {
      return n > 0 ? random() % n : 0;
    }

    template <typename T>
    const T &one_of(const std::vector<T> &all)
    {
      return all[below(all.size())];
    }

    /** One to three changes to @p text; of a parameter file also to values. */
    std::string mutate(std::string text, const bool is_parameter_file)
    {
      for (std::size_t n = 1 + below(3); n > 0; --n)
        if (is_parameter_file && below(2) == 0)
          change_value(text);
        else
          change_text(text);
      return text;
    }

  private:
    using Words = std::vector<std::string>;

    static const Words &numbers()
    {
      static const Words all
          = { "nan",    "inf",       "-inf",   "1e400",       "-1e400",
              "1e-400", "1e300",     "-1e300", "0",           "-1",
              "-0.5",   "1e-300",    "1e9",    "99999999999", "1e-9",
              "0x10",   "1,2",       "",       "1e",          "--1",
              "1..2",   "1 2",       "two",    "2147483648",  "1e5",
              "0.3333", "4294967295" };
      return all;
    }

    static const Words &values()
    {
      static const Words all = { "",
                                 "1/0",
                                 "0/0",
                                 "sqrt(-1)",
                                 "log(0)",
                                 "exp(1e9)",
                                 "((((((((",
                                 "if(t, 1",
                                 "t; t",
                                 "t, t",
                                 "rand()",
                                 "x + y + z",
                                 "t^t^t^t^t",
                                 "table",
                                 "table  times 2",
                                 "table nowhere.csv",
                                 "record",
                                 "record nowhere.AT2",
                                 "synthetic",
                                 "synthetic frequency 1e-300",
                                 "synthetic high-pass 1e-12",
                                 "synthetic duration 1e12 step 1e-12",
                                 "wavelet Ricker 0",
                                 "wavelet Ricker 1e300 1e300",
                                 "pulse exponential 1 1.0000000001",
                                 "cycles 1 1e-300",
                                 "all",
                                 "none",
                                 "a:b:c",
                                 ":",
                                 ",",
                                 ",,,",
                                 "a, a",
                                 "Names",
                                 "/",
                                 "../../..",
                                 "velocity ",
                                 "displacement t/0",
                                 "force if(t>0,1,0)",
                                 "Fisher 30, 1e6",
                                 "log-normal 1, 1e200",
                                 "normal 1e-300, 0",
                                 "exponential 1e-300",
                                 "uniform 1, 1e300",
                                 "\"quoted\"",
                                 "M\xC3\xBCller",
                                 "\xFF\xFE",
                                 "%s%s%n",
                                 "$HOME",
                                 "# nothing",
                                 "Line <99999999999999999999>" };
      return all;
    }

    static bool is_of_number(const char c)
    {
      return (c >= '0' && c <= '9') || c == '.';
    }

    /** Begin and length of a line. */
    std::pair<std::size_t, std::size_t> line_of(const std::string &text)
    {
      const std::size_t place = below(text.size());
      const std::size_t begin = text.rfind('\n', place) + 1;
      const std::size_t end   = text.find('\n', begin);
      return { begin,
               (end == std::string::npos ? text.size() : end + 1) - begin };
    }

    /** Puts another number for one of the numbers from @p place on. */
    void change_number(std::string &text, std::size_t place)
    {
      while (place < text.size() && !is_of_number(text[place]))
        ++place;
      std::size_t end = place;
      while (end < text.size()
             && (is_of_number(text[end])
                 || (text[end] == 'e' && end + 1 < text.size()
                     && (is_of_number(text[end + 1]) || text[end + 1] == '-'))
                 || (text[end] == '-' && end > place && text[end - 1] == 'e')))
        ++end;
      text.replace(place, end - place, one_of(numbers()));
    }

    /** In a line "set NAME = VALUE". */
    void change_value(std::string &text)
    {
      for (unsigned int trial = 0; trial < 50; ++trial)
      {
        const auto [begin, length]  = line_of(text);
        const std::string line      = text.substr(begin, length);
        const std::size_t equals    = line.find('=');
        const std::size_t set_place = line.find("set ");
        if (set_place == std::string::npos || equals == std::string::npos)
          continue;
        const std::string head = line.substr(0, equals + 1) + " ";
        std::string value      = line.substr(equals + 1);
        switch (below(4))
        {
        case 0:
        case 1:
          change_number(value, below(value.size()));
          break;
        case 2:
          value = one_of(values());
          break;
        default: // that of another line
        {
          const auto [other, n]     = line_of(text);
          const std::string from    = text.substr(other, n);
          const std::size_t another = from.find('=');
          value
              = another == std::string::npos ? from : from.substr(another + 1);
        }
        }
        while (!value.empty() && value.back() == '\n')
          value.pop_back();
        text.replace(begin, length, head + value + "\n");
        return;
      }
    }

    void change_text(std::string &text)
    {
      if (text.empty())
        return;
      const std::size_t place    = below(text.size());
      const auto [begin, length] = line_of(text);
      switch (below(14))
      {
      case 0:
        text.erase(begin, length);
        break;
      case 1:
        text.insert(begin, text.substr(begin, length));
        break;
      case 2:
      {
        const std::string line = text.substr(begin, length);
        text.erase(begin, length);
        if (!text.empty())
          text.insert(line_of(text).first, line);
        break;
      }
      case 3:
        text.resize(place);
        break;
      case 4:
        text[place] = static_cast<char>(below(256));
        break;
      case 5:
        for (std::size_t n = below(20); n > 0; --n)
          text[below(text.size())] = static_cast<char>(below(256));
        break;
      case 6:
        text.insert(
            place,
            std::string(1, "\0\t\r\n\"'\\#{}();,=<>\x7F\xFF"[below(20)]));
        break;
      case 7: // carriage returns
        for (std::size_t i = 0; i < text.size(); ++i)
          if (text[i] == '\n')
            text.insert(i++, 1, '\r');
        break;
      case 8: // the mark of some editors
        text.insert(0, "\xEF\xBB\xBF");
        break;
      case 9: // a line that never ends
        text.insert(place,
                    std::string(1 + below(200000), " a9(,\t;.-"[below(9)]));
        break;
      case 10:
        text.erase(place, 1 + below(40));
        break;
      case 11:
        text.insert(place, text.substr(below(text.size()), below(200)));
        break;
      default:
        change_number(text, place);
      }
    }

    std::mt19937_64 random;
  };
} // namespace quoin

#endif
