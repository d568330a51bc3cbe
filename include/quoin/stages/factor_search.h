// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_stages_factor_search_h
#define quoin_stages_factor_search_h

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
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
    double tolerance = 0.01; /**< width of the bracket [-] */
    /** Displacement beyond which a trial may fail [m]; 0: automatic. */
    double failure_displacement = 0.;
    bool reduces_blocks         = true;
    bool reduces_joints         = true;

    /** Trials of a search whose first one is stable and whose second one
        fails. */
    unsigned int least_trials() const;

    /** Declares or reads the entries in the subsection of a stage. */
    void enter(ParameterEntries &entries);
  };

  /** Outcome of a trial of a factor. */
  enum class Verdict : std::uint8_t
  {
    undecided, /**< neither of the others within the steps allowed */
    stable,    /**< the model came to rest */
    failing    /**< it keeps moving */
  };

  /** "stable", "failing" or "undecided". */
  const char *verdict_text(Verdict verdict);

  /** Outcome of a trial, with the strength divided by a factor. */
  struct SafetyTrial
  {
    double factor         = 0.; /**< [-] */
    Verdict verdict       = Verdict::undecided;
    std::uint64_t n_steps = 0;
    /** Unbalanced ratio at the end of the trial [-]. */
    double unbalanced_ratio = 0.;
    double displacement     = 0.; /**< largest since its start [m] */
    /** Steps to rest with the damping of the stage; 0: it did not rest. */
    std::uint64_t n_to_rest = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &factor &verdict &n_steps &unbalanced_ratio &displacement
          &n_to_rest;
    }
  };

  /**
   * Search for the factor at which a model fails: factors grow or fall by 1.25
   * until one is stable and a larger one fails, then bisection. Undecided
   * factors are kept between the two: both sides of them are searched.
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
    /** Lowest failing factor above it; infinite: none. */
    double lowest_failing() const
    {
      return failing;
    }
    /** Lowest and highest undecided factor between them, if any. */
    std::optional<std::array<double, 2>> undecided() const;
    const std::vector<SafetyTrial> &trials() const
    {
      return all_trials;
    }
    /** Number of steps of all trials. */
    std::uint64_t n_steps() const;
    /** Most steps in which a trial came to rest with the damping of the stage;
        0: none did. */
    std::uint64_t slowest_rest() const;
    /** Whether a trial is stable that did not come to rest with the damping of
        the stage. */
    bool was_misled() const;

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
   * Whether a trial fails: its largest displacement exceeds a limit, and it
   * keeps moving, by 1.8 times in each of the last two doublings of the time.
   * At constant velocity this ratio is two, at constant acceleration four; it
   * tends to one as the model approaches equilibrium. The time may be a
   * pseudo-time.
   */
  class FailureWatch
  {
  public:
    /** @p limit [m]; @p start: the time from which others count. */
    FailureWatch(const double limit, const double start)
      : limit(limit), start(start)
    {
    }

    /** Takes the largest @p displacement [m] at a @p time later than before. */
    bool has_failed(double time, double displacement);

    /**
     * Whether the model has moved on at some time: beyond the limit, by 1.8
     * times in the last doubling of the time. If it is at rest afterwards,
     * something has caught it, perhaps the heap that it fell to, which proves
     * neither that it stands nor that it fails.
     */
    bool has_moved_on() const
    {
      return moved_on;
    }

    /**
     * Whether a model that seems to be at rest creeps: its displacement since
     * the start has grown by 1.8 times in the last doubling of the time, and at
     * that rate it would grow by as much again, and beyond the limit, within
     * @p left, the time that is left to the trial. True while the time since
     * the start is too short to tell but the last two displacements ask for it.
     */
    bool creeps(double left) const;

  private:
    /** The displacement at @p time since the start, interpolated [m]. */
    double displacement_at(double time) const;

    static constexpr double growth = 1.8;
    /** Displacements since the start that show a trend. */
    static constexpr double least_known = 8.;
    const double limit, start;
    bool moved_on = false;
    std::vector<double> times, displacements;
  };

  /**
   * Watches the jumps of a trial by the implicit solver: time and displacements
   * of each count from its own start; once one has moved on, the trial has.
   *
   * A trial fails, too, if it moves beyond three limits: where an approach to
   * equilibrium 1 - exp(-t/T) that FailureWatch takes for a failure would end
   * at least. Under drag ground flows at a velocity that falls slowly from the
   * start, as stresses are redistributed, so that displacements grow by less
   * than 1.8 times in a doubling of time although there is no equilibrium.
   */
  class JumpWatch
  {
  public:
    /** @p limit [m] */
    explicit JumpWatch(const double limit) : limit(limit)
    {
    }

    /** Takes the largest @p displacement [m], within a jump (@p jumps) or at
        an equilibrium, at a pseudo-time since the jump began. */
    bool has_failed(bool jumps, double pseudo_time, double displacement);
    bool has_moved_on() const
    {
      return moved_on;
    }

    /** Limits beyond which a trial fails without an equilibrium on the way. */
    static constexpr double far_beyond = 3.;

  private:
    const double limit;
    double before = 0.; /**< displacement at the last equilibrium [m] */
    bool moved_on = false;
    std::optional<FailureWatch> jump;
  };
} // namespace quoin

#endif
