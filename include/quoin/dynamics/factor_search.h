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

  /** Parameters of the search for a factor of safety. */
  struct SafetyParameters
  {
    double first     = 1.;   /**< factor to try first [-] */
    double lowest    = 0.1;  /**< [-] */
    double highest   = 10.;  /**< [-] */
    double tolerance = 0.01; /**< of the bracket [-] */
    /** Displacement beyond which a trial may be unstable [m]; 0: automatic. */
    double failure_displacement = 0.;
    bool reduces_blocks         = true;
    bool reduces_joints         = true;

    /** Declares or reads the entries in the subsection of a stage. */
    void enter(ParameterEntries &entries);
  };

  /** Outcome of a trial, with the strength divided by a factor. */
  struct SafetyTrial
  {
    double factor           = 0.;    /**< [-] */
    bool is_stable          = false; /**< the model came to rest */
    bool is_decided         = true;  /**< false: neither at rest nor unstable */
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
   * Search for the factor at which a model fails: factors grow or fall by 1.25
   * until one is stable and a larger one is not, then bisection.
   */
  class FactorSearch
  {
  public:
    double next(const SafetyParameters &parameters) const;
    void add(const SafetyTrial &trial);
    bool has_ended(const SafetyParameters &parameters) const;

    /** Highest stable factor; 0: none. */
    double highest_stable() const
    {
      return stable;
    }
    /** Lowest unstable factor; infinite: none. */
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
   * Whether a trial is unstable: its largest displacement exceeds a limit and
   * is at least 1.5 times that at half of the time passed. At constant velocity
   * this ratio is two, at constant acceleration four; it tends to one as the
   * model comes to rest.
   */
  class FailureWatch
  {
  public:
    explicit FailureWatch(const double limit) : limit(limit)
    {
    }

    /** Takes the @p displacement [m] after the next of equal intervals. */
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
