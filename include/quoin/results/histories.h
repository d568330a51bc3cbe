// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_histories_h
#define quoin_results_histories_h

#include <quoin/results/beam_output.h>
#include <quoin/results/block_histories.h>
#include <quoin/results/boundary_histories.h>
#include <quoin/results/history_points.h>
#include <quoin/operators/state.h>
#include <quoin/dynamics/solver.h>
#include <quoin/model/model.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Samples the quantities of histories.csv at the time of a step: before it
   * those that the step overwrites, after it those that it computes. Point
   * quantities are those of the nearest node, cell or joint point: zero in
   * blocks that are excavated or not placed yet, NaN in deleted ones, and so
   * are those of two points. Those of boundary elements are of their last
   * completed step, with displacements extrapolated by its velocities.
   * Displacements, angles between them and slips count from where a stage has
   * reset them, but not those of boundary elements.
   */
  template <int dim>
  class Histories
  {
  public:
    /**
     * @p geometry: of the boundary elements of @p boundaries.
     * @p absence: of each physical surface, see find_history_point().
     * @p named_blocks: all that histories of blocks name. Throws an InputError
     * about loads and curves that do not exist.
     */
    Histories(const std::vector<HistoryParameters> &parameters,
              const Model<dim> &model, const Solver<dim> &solver,
              const BoundaryGeometry &geometry,
              const BoundaryElementParameters &boundaries,
              const std::vector<double> &absence,
              const std::vector<NamedBlock> &named_blocks = {});

    /** "time [s]" and "name [unit]" of each column. */
    std::vector<std::string> column_names() const;

    /** A line for each history of the motion of a point that lies outside of
        all blocks: that of the nearest node is recorded; collective. */
    std::vector<std::string> moved_points() const;

    /** The histories of points in @p block; collective. */
    std::vector<std::string> names_in(unsigned int block) const;

    /** Whether a row needs the unbalanced ratio of its own step. */
    bool need_balance() const;

    /**
     * This rank's terms of the displacement or relative displacement that the
     * history @p name records. Throws an InputError about any other, which
     * begins with @p where.
     */
    std::vector<DisplacementTerm> terms_of(const std::string &name,
                                           const std::string &where) const;

    /** Counts what @p reset names from @p state on, where a stage begins;
        collective. */
    void begin_stage(const ResultReset &reset, const State<dim> &state);

    /** Collective. */
    void before_step(const State<dim> &state);

    /** The row for the time before the step; collective. */
    std::vector<double> after_step(const State<dim> &state);

    /** Writes or reads the part of a checkpoint. */
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &origin;
      if (of_blocks)
        archive &*of_blocks;
    }

  private:
    struct Probe
    {
      HistoryParameters parameters;
      HistoryPoint at; /**< nowhere: a quantity of something else */
      /** Coordinate of an end in the mesh [m]. */
      double coordinate = 0.;
      unsigned int ends = 0; /**< first probe of the ends, for two points */
      const MotionConstraint<dim> *platen = nullptr;
      /** Nodes of the flow's network; none: all. */
      std::vector<unsigned int> water_nodes;
    };

    void locate(Probe &probe) const;
    /** Where the mesh has the motion that @p probe records [m]; collective. */
    dealii::Point<dim> place_of(const Probe &probe) const;
    /** Adds probes of the displacements of both points of a @p column. */
    void add_ends(unsigned int column);
    /** The value of a quantity of two points, from the displacements of both in
        @p values, those of probes. */
    double value_of_two(const Probe &probe, const double *values) const;
    /** Length of open joints that this rank counts [m]. */
    double open_length(const State<2> &state) const;
    /** Throws an InputError if the law of the joint at @p probe has no such
        result; collective. */
    void check_law(const Probe &probe) const;
    /** Throws an InputError if no joint is where @p probe sums forces;
        collective. */
    void find_surface(const Probe &probe) const;
    /** Finds the load whose reaction or motion @p probe records. */
    void find_load(Probe &probe) const;
    /** The row as it counts from the start of the run; collective. */
    std::vector<double> whole_row(const State<dim> &state);
    /** Whether @p probe, or one of the ends between which it is, is in a block
        of this rank that is absent. */
    bool is_at_absent(const Probe &probe, const State<dim> &state) const;
    /** Whether each column is about a block that is absent; collective. */
    std::vector<unsigned int> about_absent(const State<dim> &state) const;
    double cable_value(const HistoryParameters &wanted,
                       const State<dim> &state) const;
    /** Finds where the flow of water is recorded; collective. */
    void find_water(Probe &probe) const;
    double water_value(const Probe &probe, const State<dim> &state) const;
    /** Share of this rank of the force on the upper sides of joints [N]. */
    double joint_force(const Probe &probe, const State<3> &state) const;
    /** Adds the columns of boundary elements. */
    void add_boundary_values(const State<dim> &state,
                             std::vector<double> &result) const;
    /** Sets the columns of beams, on the first rank. */
    void add_beam_values(const State<dim> &state);
    /** Adds the columns of named blocks; collective. */
    void add_block_values(const State<dim> &state, std::vector<double> &result);

    /** Probes of the columns, followed by those of ends. */
    std::vector<Probe> probes;
    unsigned int n_columns;
    const Model<dim> &model;
    const Solver<dim> &solver;
    /** Null: no boundary elements. */
    std::unique_ptr<BoundaryHistories> of_boundary;
    /** Null: no quantities of blocks. */
    std::unique_ptr<BlockHistories> of_blocks;
    MPI_Comm communicator;
    /** What Construction::absence() gives for each physical surface. */
    const std::vector<double> absence;
    std::array<double, 2> load_clock{}; /**< time [s] and rate [-] */
    double n_outside = 0.;              /**< blocks that have left the box */
    /** Displacement controlled by a load pattern, NaN without [m]. */
    double controlled = 0.;
    std::vector<double> row;
    /** Reference value of each column, by whole_row(). */
    std::vector<double> origin;
  };

  template <>
  double Histories<3>::joint_force(const Probe &probe,
                                   const State<3> &state) const;

  // Members that exist in two dimensions only.
  template <>
  double Histories<2>::open_length(const State<2> &state) const;
  template <>
  void Histories<2>::add_beam_values(const State<2> &state);
  template <>
  void Histories<2>::add_block_values(const State<2> &state,
                                      std::vector<double> &result);
  template <>
  void Histories<2>::add_boundary_values(const State<2> &state,
                                         std::vector<double> &result) const;
} // namespace quoin

#endif
