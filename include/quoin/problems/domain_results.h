// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_domain_results_h
#define quoin_problems_domain_results_h

#include <quoin/problems/boundary_system.h>
#include <quoin/problems/problem.h>

#include <array>
#include <functional>
#include <vector>

namespace quoin
{
  /** Which steps have rows of histories.csv and fields. */
  struct StepControl
  {
    std::function<bool(std::uint64_t)> row_is_due, fields_are_due;
  };

  /**
   * Histories and the sampled field in the domain of boundary elements. In
   * motion they follow from the record of all steps on the boundary, some
   * points at a time. Members are collective.
   */
  class DomainResults
  {
  public:
    /** @p table: of the histories. What is given must outlive this object. */
    DomainResults(const BoundarySystem &system, const RunContext &run,
                  const StepControl &control, RootTable &table);

    /**
     * Takes the record of the boundary: displacements @p u [m] and tractions
     * @p p [Pa], the steps of one unknown after those of the other, and
     * @p rows of the histories that lack what happens in the domain.
     */
    void begin(const std::vector<double> &u, const std::vector<double> &p,
               std::vector<double> &&rows);
    bool is_over() const;
    /** Share of the points that are done [-]. */
    double fraction() const;
    /** Histories first, then some points of the field; the last ones write it.
     */
    void take_step();

    /** The sampled field of the static solution at @p time [s]. */
    void write_static(double time, const StaticSolution &solution);

  private:
    void write_histories();
    void sample();
    void write_field(double time, const Eigen::VectorXd &displacement,
                     const Eigen::VectorXd &velocity);

    const BoundarySystem &system;
    const RunContext &run;
    const StepControl &control;
    RootTable &table;
    SampledFieldOutput output;

    BoundaryRecord record;
    std::vector<double> rows; /**< empty: none, or written */
    /** Of the fields, the step before and the step. */
    std::vector<unsigned int> steps;
    std::size_t n_done = 0;       /**< points of the field */
    Eigen::MatrixXd displacement; /**< of these in all steps [m] */
  };
} // namespace quoin

#endif
