// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_histories_h
#define quoin_results_histories_h

#include <quoin/results/boundary_histories.h>
#include <quoin/results/history_parameters.h>
#include <quoin/operators/state.h>
#include <quoin/dynamics/solver.h>
#include <quoin/dynamics/model.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Samples the quantities of histories.csv at the time of a step: before it
   * what the step overwrites, after it what it computes. Point quantities are
   * those of the nearest node, cell or joint point. Those of boundary elements
   * are of their last step that is over, their displacements continued from its
   * end with its velocities. At a block that is absent they are zero.
   */
  class Histories
  {
  public:
    /**
     * @p geometry: of the boundary elements that @p boundaries describe.
     * @p absent_in_the_end: of physical surfaces, whose nodes come after
     * others at the same place.
     * Throws an InputError about loads and curves that do not exist.
     */
    Histories(const std::vector<HistoryParameters> &parameters,
              const Model &model, const Solver &solver,
              const BoundaryGeometry &geometry,
              const BoundaryElementParameters &boundaries,
              const std::vector<bool> &absent_in_the_end);

    /** "time [s]" and "name [unit]" of each column. */
    std::vector<std::string> column_names() const;

    /** Whether a row needs the unbalanced ratio of its own step. */
    bool need_balance() const;

    void before_step(const State<2> &state);

    /** The row of the time before the step; collective. */
    std::vector<double> after_step(const State<2> &state);

  private:
    struct Probe
    {
      HistoryParameters parameters;
      unsigned int entity               = 0; /**< node, cell or joint point */
      bool here                         = false;
      const MotionConstraint<2> *platen = nullptr;
    };

    void locate(Probe &probe) const;
    /** The load whose reaction or motion @p probe looks at. */
    void find_load(Probe &probe) const;
    /** The rank of the nearest point; @p key: that of this rank. */
    void find_owner(Probe &probe, const std::array<double, 4> &key) const;
    double point_value(const Probe &probe, const State<2> &state) const;
    /** Whether the block that @p probe looks at is absent. */
    bool is_absent(const Probe &probe, const State<2> &state) const;
    /** Puts in the columns of boundary elements. */
    void add_boundary_values(const State<2> &state,
                             std::vector<double> &result) const;
    /** Of a local cell [rad]. */
    double rotation(unsigned int cell, const State<2> &state) const;

    std::vector<Probe> probes;
    const Model &model;
    const Solver &solver;
    std::unique_ptr<BoundaryHistories> of_boundary; /**< or null */
    MPI_Comm communicator;
    const std::vector<bool> absent_in_the_end; /**< of physical surfaces */
    std::array<double, 2> load_clock{};        /**< its time [s] and rate */
    std::vector<double> row;
  };
} // namespace quoin

#endif
