// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_random_stream_h
#define quoin_rock_random_stream_h

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Random numbers that depend on nothing but the seed, a name and a number:
   * each line of each joint set has its own, so that a change of one leaves
   * the others where they are. The same with every library.
   */
  class RandomStream
  {
  public:
    RandomStream(const std::uint64_t seed, const std::string &name,
                 const std::int64_t number)
    {
      std::vector<std::uint32_t> words;
      const auto add = [&](const std::uint64_t value)
      {
        words.push_back(static_cast<std::uint32_t>(value));
        words.push_back(static_cast<std::uint32_t>(value >> 32));
      };
      add(seed);
      add(static_cast<std::uint64_t>(number));
      for (const char letter : name)
        words.push_back(static_cast<unsigned char>(letter));
      std::seed_seq sequence(words.begin(), words.end());
      generator.seed(sequence);
    }

    /** Uniform in (0, 1). */
    double uniform()
    {
      return std::ldexp(static_cast<double>(generator() >> 11) + 0.5, -53);
    }

  private:
    std::mt19937_64 generator;
  };
} // namespace quoin

#endif
