// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/signals/record.h>
#include <quoin/signals/signal_text.h>
#include <quoin/signals/synthetic_record.h>

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

namespace quoin
{
  namespace
  {
    using Words = std::vector<std::string>;

    using constants::degree;

    Words split(const std::string &text)
    {
      std::istringstream stream(text);
      Words words;
      std::string word;
      while (stream >> word)
        words.push_back(word);
      return words;
    }

    double number(const std::string &word, const std::string &what)
    {
      std::size_t used = 0;
      double value     = 0.;
      try
      {
        value = std::stod(word, &used);
      }
      catch (const std::exception &)
      {
      }
      if (used != word.size() || word.empty() || !std::isfinite(value))
        throw InputError("has '" + word + "' for " + what
                         + ": it must be a number.");
      return value;
    }

    double positive(const std::string &word, const std::string &what)
    {
      const double value = number(word, what);
      if (!(value > 0.))
        throw InputError("has '" + word + "' for " + what
                         + ": it must be positive.");
      return value;
    }

    Signal delayed(Signal signal, const double delay)
    {
      for (auto *f :
           { &signal.value, &signal.integral, &signal.second_integral })
        if (*f)
          *f = [f = *f, delay](const double t) { return f(t - delay); };
      return signal;
    }

    /** Numbers after the first two words: all positive but the delay, which is
        last. */
    std::vector<double> numbers(const Words &words, const std::string &usage,
                                const std::vector<std::string> &names,
                                const bool delay_may_lack)
    {
      const std::size_t n = words.size() - 2;
      if (n != names.size() && !(delay_may_lack && n + 1 == names.size()))
        throw InputError("must read '" + usage + "'.");
      std::vector<double> values;
      for (std::size_t k = 0; k < n; ++k)
        values.push_back(names[k] == "DELAY" || names[k] == "PHASE"
                             ? number(words[k + 2], names[k])
                             : positive(words[k + 2], names[k]));
      return values;
    }

    Signal read_wavelet(const Words &words)
    {
      if (words.size() > 1 && words[1] == "Ricker")
      {
        const auto v = numbers(words, "wavelet Ricker FREQUENCY [DELAY]",
                               { "FREQUENCY", "DELAY" }, true);
        return ricker_wavelet(v[0], v.size() > 1 ? v[1] : 1.5 / v[0]);
      }
      if (words.size() > 1 && words[1] == "Gabor")
      {
        const auto v
            = numbers(words, "wavelet Gabor FREQUENCY WIDTH PHASE DELAY",
                      { "FREQUENCY", "WIDTH", "PHASE", "DELAY" }, false);
        return gabor_wavelet(v[0], v[1], v[2] * degree, v[3]);
      }
      throw InputError("must be 'wavelet Ricker ...' or 'wavelet Gabor ...'.");
    }

    Signal read_pulse(const Words &words)
    {
      const std::string kind = words.size() > 1 ? words[1] : "";
      if (kind == "half-sine")
      {
        const auto v = numbers(words, "pulse half-sine DURATION [DELAY]",
                               { "DURATION", "DELAY" }, true);
        return delayed(half_sine_pulse(v[0]), v.size() > 1 ? v[1] : 0.);
      }
      if (kind == "triangular" || kind == "exponential")
      {
        const auto v = numbers(words, "pulse " + kind + " RISE DECAY [DELAY]",
                               { "RISE", "DECAY", "DELAY" }, true);
        return delayed(kind == "triangular" ? triangular_pulse(v[0], v[1])
                                            : exponential_pulse(v[0], v[1]),
                       v.size() > 2 ? v[2] : 0.);
      }
      if (kind == "Friedlander")
      {
        const auto v
            = numbers(words, "pulse Friedlander DURATION COEFFICIENT [DELAY]",
                      { "DURATION", "COEFFICIENT", "DELAY" }, true);
        return delayed(friedlander_pulse(v[0], v[1]), v.size() > 2 ? v[2] : 0.);
      }
      throw InputError("must be 'pulse half-sine ...', 'pulse triangular ...', "
                       "'pulse exponential ...' or 'pulse Friedlander ...'.");
    }

    Signal read_cycles(const Words &words)
    {
      if (words.size() < 3)
        throw InputError("must read 'cycles RATE AMPLITUDE [AMPLITUDE ...]'.");
      std::vector<double> amplitudes;
      for (std::size_t k = 2; k < words.size(); ++k)
        amplitudes.push_back(positive(words[k], "AMPLITUDE"));
      return sine_cycles(positive(words[1], "RATE"), amplitudes);
    }

    /** Options: pairs of a word and a value, each used once. */
    class Options
    {
    public:
      Options(const Words &words, const std::size_t first)
      {
        for (std::size_t k = first; k < words.size(); k += 2)
        {
          if (k + 1 == words.size())
            throw InputError("lacks a value after '" + words[k] + "'.");
          if (!values.emplace(words[k], words[k + 1]).second)
            throw InputError("has '" + words[k] + "' twice.");
        }
      }

      /** The value of @p name, or @p otherwise. */
      std::string take(const std::string &name, const std::string &otherwise)
      {
        known += (known.empty() ? "" : ", ") + name;
        const auto found = values.find(name);
        if (found == values.end())
          return otherwise;
        const std::string value = found->second;
        values.erase(found);
        return value;
      }

      double take_positive(const std::string &name, const double otherwise)
      {
        const std::string value = take(name, "");
        return value.empty() ? otherwise : positive(value, name);
      }

      /** Index of the value of @p name among @p words. */
      unsigned int take_choice(const std::string &name, const Words &words)
      {
        const std::string value = take(name, words.front());
        std::string all;
        for (unsigned int k = 0; k < words.size(); ++k)
        {
          if (words[k] == value)
            return k;
          all += (k == 0 ? "" : ", ") + words[k];
        }
        throw InputError("has '" + value + "' for " + name
                         + ": it must be one of " + all + ".");
      }

      /** Throws an InputError about unused options. */
      void finish() const
      {
        if (!values.empty())
          throw InputError("has an unknown option '" + values.begin()->first
                           + "': there are " + known + ".");
      }

    private:
      std::map<std::string, std::string> values;
      std::string known;
    };

    /** Applies the options of all records: integrals and delay. */
    Signal finish_record(const Record &record, Options &options)
    {
      const unsigned int times
          = options.take_choice("integrated", { "no", "once", "twice" });
      const double delay = number(options.take("delay", "0"), "delay");
      options.finish();
      Signal signal = record.signal();
      for (unsigned int k = 0; k < times; ++k)
      {
        signal.value           = signal.integral;
        signal.integral        = signal.second_integral;
        signal.second_integral = nullptr;
      }
      return delayed(std::move(signal), delay);
    }

    Signal read_record(const Words &words, const std::string &folder)
    {
      if (words.size() < 2)
        throw InputError("must read 'record FILE' and options.");
      const std::string &name = words[1];
      Record record = Record::read(name.front() == '/' ? name : folder + name);
      Options options(words, 2);
      const std::string share = options.take("taper", "0");
      const double taper      = number(share, "taper");
      if (!(taper >= 0. && taper <= 0.5))
        throw InputError("has '" + share
                         + "' for taper: it must be between 0 and 0.5.");
      record.taper(taper);
      constexpr Baseline baselines[]
          = { Baseline::none, Baseline::linear, Baseline::quadratic };
      record.correct(baselines[options.take_choice(
          "baseline", { "none", "linear", "quadratic" })]);
      Signal signal = finish_record(record, options);
      signal.report = name + ": " + signal.report;
      return signal;
    }

    Signal read_synthetic(const Words &words)
    {
      Options options(words, 1);
      SyntheticRecordParameters parameters;
      const auto take = [&](const std::string &name, double &value)
      { value = options.take_positive(name, value); };
      take("frequency", parameters.frequency);
      take("damping", parameters.damping);
      take("high-pass", parameters.low_frequency);
      take("duration", parameters.duration);
      take("step", parameters.step);
      const std::string peak  = options.take("peak", "");
      const std::string arias = options.take("Arias", "");
      if (!peak.empty() && !arias.empty())
        throw InputError("has both 'peak' and 'Arias': give one of them.");
      if (!peak.empty())
        parameters.peak = positive(peak, "peak");
      if (!arias.empty())
        parameters.arias = positive(arias, "Arias");
      parameters.envelope
          = options.take_choice("envelope", { "Saragoni-Hart", "trapezoidal" })
                    == 0
                ? Envelope::saragoni_hart
                : Envelope::trapezoidal;
      const std::string seed = options.take("seed", "1");
      if (seed.find_first_not_of("0123456789") != std::string::npos
          || seed.size() > 18)
        throw InputError("has '" + seed
                         + "' for seed: it must be a whole number.");
      parameters.seed     = std::stoull(seed);
      const Record record = synthetic_record(parameters);
      Signal signal       = finish_record(record, options);
      signal.report       = "synthetic record: " + signal.report;
      return signal;
    }
  } // namespace

  bool is_signal_text(const std::string &text)
  {
    const Words words = split(text.substr(0, 80));
    if (words.empty())
      return false;
    for (const char *const word :
         { "wavelet", "pulse", "cycles", "record", "synthetic" })
      if (words[0] == word)
        return true;
    return false;
  }

  Signal read_signal(const std::string &text, const std::string &folder)
  {
    const Words words = split(text);
    if (words.empty() || !is_signal_text(text))
      throw InputError(
          "must begin with wavelet, pulse, cycles, record or synthetic.");
    if (words[0] == "wavelet")
      return read_wavelet(words);
    if (words[0] == "pulse")
      return read_pulse(words);
    if (words[0] == "cycles")
      return read_cycles(words);
    return words[0] == "record" ? read_record(words, folder)
                                : read_synthetic(words);
  }

  std::string motion_word(const int derivative)
  {
    return derivative == 0   ? "displacement"
           : derivative == 1 ? "velocity"
                             : "acceleration";
  }

  std::string other_motion_text(const std::string &text, const int derivative)
  {
    std::istringstream stream(text);
    std::string word, file;
    stream >> word;
    const bool is_synthetic = word == "synthetic";
    if (word == "record")
      stream >> file;
    const std::string end = file_extension(file);
    const int of_source   = is_synthetic || end == "AT2" ? 2
                            : end == "VT2"               ? 1
                            : end == "DT2"               ? 0
                                                         : -1;
    int integrated        = 0;
    while (stream >> word)
      if (word == "integrated" && stream >> word)
        integrated = word == "once" ? 1 : word == "twice" ? 2 : 0;
    if (of_source < 0 || of_source - integrated == derivative)
      return "";
    const int missing = of_source - derivative;
    return "must be of " + motion_word(derivative) + ", but "
           + (is_synthetic ? "a synthetic record" : "the file") + " is of "
           + motion_word(of_source) + ": "
           + (missing == 1   ? "take 'integrated once'"
              : missing == 2 ? "take 'integrated twice'"
              : missing == 0 ? "leave out 'integrated'"
                             : "take another file");
  }
} // namespace quoin
