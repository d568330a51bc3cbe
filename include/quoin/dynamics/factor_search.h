// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_factor_search_h
#define quoin_dynamics_factor_search_h

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace quoin
{
  class ParameterEntries;

  /** How a stage looks for a factor of safety. */
  struct SafetyParameters
  {
    double first     = 1.;   /**< factor to try first [-] */
    double lowest    = 0.1;  /**< [-] */
    double highest   = 10.;  /**< [-] */
    double tolerance = 0.01; /**< of the bracket [-] */
    /** Beyond it a trial may be failing [m]; 0: automatic. */
    double failure_displacement = 0.;
    bool reduces_blocks         = true;
    bool reduces_joints         = true;

    /** Declares or reads the entries in the subsection of a stage. */
    void enter(ParameterEntries &entries);
  };

  /** What became of a model whose strength was divided by a factor. */
  struct SafetyTrial
  {
    double factor           = 0.;    /**< [-] */
    bool is_stable          = false; /**< it came to rest */
    bool is_decided         = true;  /**< or neither that nor failing */
    std::uint64_t n_steps   = 0;
    double unbalanced_ratio = 0.; /**< at its end [-] */
    double displacement     = 0.; /**< largest since its start [m] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &factor &is_stable &is_decided &n_steps &unbalanced_ratio
          &displacement;
    }
  };

  /**
   * The search for the factor at which a model fails: in steps of a quarter
   * until one factor is stable and a larger one is not, then by halves.
   */
  class FactorSearch
  {
  public:
    double next(const SafetyParameters &parameters) const;
    void add(const SafetyTrial &trial);
    bool is_over(const SafetyParameters &parameters) const;

    /** 0 if there is none. */
    double highest_stable() const
    {
      return stable;
    }
    /** Infinite if there is none. */
    double lowest_failing() const
    {
      return failing;
    }
    const std::vector<SafetyTrial> &trials() const
    {
      return all_trials;
    }

    /** The trials as a table (CSV). */
    std::string table() const;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &all_trials &stable &failing;
    }

  private:
    std::vector<SafetyTrial> all_trials;
    double stable = 0., failing = std::numeric_limits<double>::infinity();
  };

  /**
   * Whether a model is failing: its largest displacement is beyond a limit and
   * has grown by half or more since half of the time that has passed. What
   * slides grows by a factor of two at constant velocity and of four at
   * constant acceleration, what comes to rest by less and less.
   */
  class FailureWatch
  {
  public:
    explicit FailureWatch(const double limit) : limit(limit)
    {
    }

    /** @p displacement [m] after another one of equal spans of time. */
    bool has_failed(const double displacement)
    {
      displacements.push_back(displacement);
      return displacement > limit
             && displacement
                    >= growth * displacements[(displacements.size() - 1) / 2];
    }

  private:
    static constexpr double growth = 1.5;
    const double limit; /**< [m] */
    std::vector<double> displacements;
  };
} // namespace quoin

#endif
