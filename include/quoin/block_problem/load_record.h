// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_load_record_h
#define quoin_block_problem_load_record_h

#include <quoin/motions/platen_bearing.h>
#include <quoin/operators/state.h>
#include <quoin/block_problem/block_system.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  /** Forces of a stage along the axes [N]. */
  struct ForceBalance
  {
    std::array<double, 3> applied{};  /**< resultants of the loads */
    std::array<double, 3> supports{}; /**< resultants of the supports */
    /** Sums of the magnitudes of the loads on nodes and platens, whose
        resultant may be zero. */
    std::array<double, 3> size{};
  };

  /** How a platen on a boundary has pulled there in a stage. */
  struct PlatenPull
  {
    std::string name;         /**< of the load */
    double pressed      = 0.; /**< largest force that it pressed with [N] */
    unsigned int n_rows = 0, n_pulling = 0; /**< rows, those that pull */
    /** The row with the largest pull: all of it [N], the largest per area [Pa],
        where that is [m], and when [s]. */
    double pulled = 0., tension = 0.;
    std::vector<double> place;
    double time = 0.;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &name &pressed &n_rows &n_pulling &pulled &tension &place &time;
    }
  };

  /**
   * What the rows of a stage have shown of its loads: the largest factor of a
   * load pattern and the share of damping in its work, and whether the supports
   * carried the applied loads.
   */
  class LoadRecord
  {
  public:
    /** The factor of the largest magnitude [-], and where [m] and when [s] it
        was. */
    struct Peak
    {
      double factor = 0., displacement = 0.;
      double time = -1.; /**< -1: there is none */
    };

    /** Adds a row with the @p factor of a load pattern. */
    void add_factor(double factor, double displacement, double time);
    /** Adds to it that the loads with the factor 1 have done @p unit_work, and
        damping has taken @p damped, both from any reference on, and the
        @p kinetic energy [J]. */
    void add_work(double factor, double unit_work, double damped,
                  double kinetic);

    /** Adds a row at @p time [s]; @p to_means: also to the means, which say
        nothing where a stage seeks an equilibrium and loads pass on the way. */
    void add_forces(const ForceBalance &forces, double time,
                    bool to_means = true);

    /** Adds a row at @p time [s] with what the platen @p name exerts on its
        boundary. */
    template <int dim>
    void add_bearing(const std::string &name, const PlatenBearing<dim> &bearing,
                     double time);

    /**
     * What is to be warned of: that along an axis along which the applied force
     * varies, the largest force that supports carried at any time is less than
     * the largest applied one, by more than 5 % of the size of the loads, or
     * that the largest means over a tenth of the rows do so, as vibration may
     * raise the force of supports for a moment. A model that vibrates about a
     * balance passes, as its supports take more than is applied, too; so do
     * loads that balance each other. Or that damping took more than 5 % of the
     * work of a load pattern, or that its largest factor is more than 5 % above
     * the largest mean over a twentieth of the rows of what neither motion nor
     * damping took. Or that a platen which presses its boundary pulls a part of
     * it, in a twentieth of the rows or more, with more than 5 % of the largest
     * force that it has pressed with until then, and less than 80 % of what it
     * presses with at the same time: one that pulls more is a clamp. Empty:
     * nothing.
     */
    std::string warning() const;

    /** Adds its figures to those of the stage in summary.json. */
    void summarise(nlohmann::ordered_json &stage) const;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &peak.factor &peak.displacement &peak.time;
      for (Axis &axis : axes)
        archive &axis.lowest &axis.highest &axis.most_up &axis.most_down &axis
            .applied &axis.time &axis.size;
      archive &pattern.factor &pattern.unit_work &pattern.damped &pattern
          .work &pattern.loss &pattern.kinetic &pattern.kinetic_gain &pattern
          .n_rows;
      archive &path &n_per_place;
      archive &means &sum &n_summed &n_per_mean;
      archive &pulls;
    }

  private:
    /** Forces along an axis: the range of the applied one and, at the last time
        when its magnitude was largest, its value; the largest forces of the
        supports in both directions [N, s]. */
    struct Axis
    {
      double lowest  = std::numeric_limits<double>::infinity();
      double highest = -std::numeric_limits<double>::infinity();
      double most_up = 0., most_down = 0.;
      double applied = 0., time = 0.;
      double size = 0.; /**< largest sum of magnitudes of the loads [N] */

      /** Largest applied force that supports carried, in its direction [N]. */
      double taken() const;
    };

    /** A load pattern: its last row, and since the first one its work, what
        damping took of it and the change of kinetic energy [J]. */
    struct PatternWork
    {
      double factor = 0., unit_work = 0., damped = 0., kinetic = 0.;
      double work = 0., loss = 0., kinetic_gain = 0.;
      unsigned int n_rows = 0;
    };

    /** What supports lack of the largest applied force. */
    struct Lack
    {
      double applied, taken; /**< [N] */
      double time;           /**< of the applied force [s] */
      bool is_of_means;      /**< over a tenth of the rows */
    };

    /** What supports lack along axis @p d; empty: nothing to be warned of. */
    std::optional<Lack> lack(unsigned int d) const;
    /** What the largest means over a tenth of the rows lack, however little;
        empty: there are too few rows. */
    std::optional<Lack> lack_of_means(unsigned int d) const;

    /** Numbers of a row: time [s], applied forces and forces of supports [N].
     */
    static constexpr unsigned int n_numbers = 7;

    /** What damping took of the work of a load pattern [-]. */
    double damped_share() const
    {
      return pattern.work > 0. ? pattern.loss / pattern.work : 0.;
    }

    /** The largest mean factor of a load pattern over a twentieth of the rows,
       in the direction of the largest one: the work of @p column of the path by
       that of the loads with the factor 1. Empty: there are too few rows. */
    std::optional<double> largest_mean_factor(unsigned int column) const;
    /** Whether the largest factor is far above that of the work at rest. */
    bool has_spike() const;

    Peak peak;
    PatternWork pattern;
    /** The work of a load pattern with the factor 1, its work since the first
        row and that without what became kinetic energy or was damped [J], in
        turn, of rows at equal distances. */
    std::vector<double> path;
    static constexpr unsigned int n_of_place = 3, work_of_all = 1,
                                  work_at_rest = 2;
    unsigned int n_per_place = 1; /**< rows from one to the next */
    std::array<Axis, 3> axes;
    /** Means of equally many rows, one after the other, and the sum of the rows
        behind them. */
    std::vector<double> means;
    std::vector<double> sum = std::vector<double>(n_numbers, 0.);
    unsigned int n_summed = 0, n_per_mean = 1;
    std::vector<PlatenPull> pulls; /**< of the platens that have borne */
  };

  /**
   * The forces at @p load_time [s] of the stage that has begun, after the step
   * of @p state from there on. Forces of platens and those on beams count as
   * applied, reactions of all other loads that move nodes, of driven platens
   * and of the held ends of beams as supports.
   * Collective.
   */
  template <int dim>
  ForceBalance force_balance(const BlockSystem<dim> &system,
                             const State<dim> &state, double load_time);
} // namespace quoin

#endif
