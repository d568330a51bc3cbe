// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/signals/record.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace quoin
{
  namespace
  {
    using constants::gravity;
    using constants::pi;

    std::string upper(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(),
                     [](const unsigned char c) { return std::toupper(c); });
      return text;
    }

    /** Fortran may write D for E. */
    std::string with_c_exponent(std::string number)
    {
      std::replace(number.begin(), number.end(), 'D', 'E');
      return number;
    }

    const char *const real = "([-+]?[0-9]*\\.?[0-9]+(?:[ED][-+]?[0-9]+)?)";

    /** Finds the number of values and their spacing in a header line. */
    bool find_size(const std::string &line, std::size_t &n, double &step)
    {
      static const std::regex named(
          std::string("NPTS\\s*=?\\s*([0-9]{1,9})\\s*,?\\s*DT\\s*=?\\s*")
          + real);
      static const std::regex before(std::string("([0-9]{1,9})\\s*,?\\s+")
                                     + real + "\\s*,?\\s*NPTS\\s*,\\s*DT");
      std::smatch found;
      if (!std::regex_search(line, found, named)
          && !std::regex_search(line, found, before))
        return false;
      n    = std::stoul(found[1]);
      step = std::stod(with_c_exponent(found[2]));
      return true;
    }

    /** Unit in m and s, by the header or else the kind of file. */
    double unit(const std::string &header, const std::string &name)
    {
      static const std::regex stated("UNITS?\\s*(?:OF|IN|:|=)\\s*\\(?([A-Z]+)");
      static const std::map<std::string, double> known
          = { { "G", gravity }, { "CM", 0.01 }, { "GAL", 0.01 }, { "M", 1. } };
      std::smatch found;
      if (std::regex_search(header, found, stated))
      {
        const auto factor = known.find(found[1]);
        if (factor == known.end())
          throw InputError("the record '" + name + "' says that its unit is '"
                           + found[1].str()
                           + "', which is not known. Convert it to g, cm/s^2 "
                             "or m/s^2 (velocities: cm/s or m/s).");
        return factor->second;
      }
      if (std::regex_search(header, std::regex("\\(G\\)")))
        return gravity;
      if (std::regex_search(header, std::regex("\\bCM\\b")))
        return 0.01;
      if (std::regex_search(header, std::regex("\\bM/S")))
        return 1.;
      return file_extension(name) == "AT2" ? gravity : 0.01;
    }

    TimeTable read_peer(const std::string &name)
    {
      std::ifstream file(name);
      if (!file)
        throw InputError("the record '" + name
                         + "' cannot be read. Check its path.");
      std::string line, header;
      std::size_t n = 0;
      double step   = 0.;
      bool found    = false;
      // The header has four or five lines, seldom more.
      for (unsigned int k = 0; k < 20 && !found && std::getline(file, line);
           ++k)
      {
        // Regular expressions use stack for each character, and in a line cut
        // off the last number would change.
        if (line.size() > 200)
          continue;
        line = upper(line);
        header += line + "\n";
        try
        {
          found = find_size(line, n, step);
        }
        catch (const std::out_of_range &)
        {
          break; // the step is out of range
        }
      }
      if (!found || n < 2 || !(step > 0.))
        throw InputError("the record '" + name
                         + "' has no header with the number of points and the "
                           "time step, such as 'NPTS= 2000, DT= .0200 SEC'.");
      const double factor = unit(header, name);
      TimeTable table;
      std::string word;
      while (table.size() < n && file >> word)
      {
        word             = with_c_exponent(word);
        std::size_t used = 0;
        double value     = 0.;
        try
        {
          value = std::stod(word, &used);
        }
        catch (const std::exception &)
        {
        }
        if (used != word.size() || !std::isfinite(value))
          throw InputError("the record '" + name + "' has '" + word
                           + "' where value " + std::to_string(table.size() + 1)
                           + " of " + std::to_string(n) + " should be.");
        table.emplace_back(double(table.size()) * step, factor * value);
      }
      if (table.size() < n)
        throw InputError("the record '" + name + "' ends after "
                         + std::to_string(table.size()) + " of "
                         + std::to_string(n) + " values.");
      return table;
    }

    /** First and second integral up to each sample. */
    struct Sums
    {
      std::vector<double> once, twice;
    };

    Sums integrals(const TimeTable &table)
    {
      Sums sums{ { 0. }, { 0. } };
      for (std::size_t k = 0; k + 1 < table.size(); ++k)
      {
        const double h = table[k + 1].first - table[k].first;
        const double a = table[k].second, b = table[k + 1].second;
        sums.twice.push_back(sums.twice.back() + h * sums.once.back()
                             + h * h * (2. * a + b) / 6.);
        sums.once.push_back(sums.once.back() + 0.5 * h * (a + b));
      }
      return sums;
    }
  } // namespace

  std::string file_extension(const std::string &file)
  {
    const std::size_t dot = file.rfind('.');
    return dot == std::string::npos ? "" : upper(file.substr(dot + 1));
  }

  Record Record::read(const std::string &file)
  {
    const std::string kind = file_extension(file);
    const bool is_peer     = kind == "AT2" || kind == "VT2" || kind == "DT2";
    return Record(is_peer ? read_peer(file) : read_time_table(file));
  }

  Record::Record(TimeTable samples) : table(std::move(samples))
  {
    if (table.size() < 2)
      throw InputError("a record must have two samples or more.");
  }

  double Record::duration() const
  {
    return table.back().first - table.front().first;
  }

  double Record::peak() const
  {
    double peak = 0.;
    for (const auto &[time, value] : table)
      peak = std::max(peak, std::abs(value));
    return peak;
  }

  double Record::final_integral() const
  {
    return integrals(table).once.back();
  }

  double Record::final_second_integral() const
  {
    return integrals(table).twice.back();
  }

  void Record::scale(const double factor)
  {
    for (auto &[time, value] : table)
      value *= factor;
  }

  void Record::taper(const double share)
  {
    const double length = share * duration();
    for (auto &[time, value] : table)
    {
      const double from_end
          = std::min(time - table.front().first, table.back().first - time);
      if (from_end < length)
        value *= 0.5 * (1. - std::cos(pi * from_end / length));
    }
  }

  void Record::correct(const Baseline baseline)
  {
    if (baseline == Baseline::none)
      return;
    const double begin = table.front().first;
    const double all   = duration();
    const double v = final_integral(), u = final_second_integral();
    // a + b t has the integrals a T + b T^2/2 and a T^2/2 + b T^3/6.
    double a = -v / all, b = 0.;
    if (baseline == Baseline::quadratic)
    {
      a = 2. * v / all - 6. * u / (all * all);
      b = 12. * u / (all * all * all) - 6. * v / (all * all);
    }
    for (auto &[time, value] : table)
      value += a + b * (time - begin);
  }

  Signal Record::signal() const
  {
    struct Data
    {
      TimeTable table;
      Sums sums;
    };
    const auto data
        = std::make_shared<const Data>(Data{ table, integrals(table) });
    // The sample before a time within the record.
    const auto before = [data](const double t)
    {
      const auto after = std::upper_bound(
          data->table.begin(), data->table.end(), std::make_pair(t, 1e300));
      return std::min(std::size_t(after - data->table.begin()),
                      data->table.size() - 1)
             - 1;
    };
    const double first = table.front().first, last = table.back().first;
    Signal signal;
    signal.value = [=](const double t)
    { return t < first || t > last ? 0. : interpolate(data->table, t); };
    signal.integral = [=](const double t)
    {
      if (!(t > first))
        return 0.;
      if (t >= last)
        return data->sums.once.back();
      const std::size_t k = before(t);
      const double s      = t - data->table[k].first;
      return data->sums.once[k]
             + 0.5 * s * (data->table[k].second + interpolate(data->table, t));
    };
    signal.second_integral = [=](const double t)
    {
      if (!(t > first))
        return 0.;
      if (t >= last)
        return data->sums.twice.back() + (t - last) * data->sums.once.back();
      const std::size_t k = before(t);
      const double s      = t - data->table[k].first;
      return data->sums.twice[k] + s * data->sums.once[k]
             + s * s
                   * (2. * data->table[k].second + interpolate(data->table, t))
                   / 6.;
    };
    std::ostringstream report;
    report.precision(4);
    report << table.size() << " values over " << duration() << " s, peak "
           << peak() << "; at the end its integral is " << final_integral()
           << " and that of the integral " << final_second_integral();
    signal.report = report.str();
    return signal;
  }
} // namespace quoin
