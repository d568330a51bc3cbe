// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_implicit_steps_h
#define quoin_implicit_implicit_steps_h

#include <quoin/implicit/implicit_parameters.h>
#include <quoin/implicit/implicit_state.h>
#include <quoin/operators/state.h>

#include <cmath>

namespace quoin
{
  /** Target of a step. */
  struct StepTarget
  {
    double load_time;
    double released;
    double path; /**< increment of Balance::path [m]; 0: load control */
  };

  /** Number of steps of a short jump: the next equilibrium is the next one on
      the same path. */
  constexpr unsigned int short_jump = 3;

  /** Chooses the steps of an ImplicitSolver from its state: of the load time,
      of the path or of the pseudo-time of a jump. */
  class ImplicitSteps
  {
  public:
    explicit ImplicitSteps(const ImplicitParameters &parameters)
      : parameters(parameters)
    {
    }

    /** Begins a stage that ends at the load time @p duration [s]. @p rests:
        whether its loads are constant; @p searches_factor: whether it asks if
        the model keeps moving, for a factor of safety. */
    void begin_stage(double duration, bool rests, bool searches_factor);

    /** Load time at which the stage ends [s]. */
    double duration() const
    {
      return stage_end;
    }
    /** Makes the next step the first of the release of held forces. */
    void begin_release(ImplicitState &now) const;
    /** Makes the next step the first of the loads; constant loads take one. */
    void begin_loads(ImplicitState &now) const;
    /** Least number of steps of the stage, if none is cut. */
    double least_steps() const
    {
      return rests ? 1. : std::ceil(1. / parameters.largest_step * (1. - 1e-9));
    }

    /** The target of the step from the load time @p time [s] on. */
    StepTarget target(const ImplicitState &now, double time) const;
    /** Reduces the next step; false: it is the smallest one. @p measures_path:
        whether the path can be followed. */
    bool cut(bool measures_path, double time, ImplicitState &now) const;
    /** Whether a load step from @p time to @p target is longer than the first
        one although its prediction left @p error of the forces out of
        balance. */
    bool is_too_long(double time, const StepTarget &target, double error) const;
    /** Makes the next step from @p time, to @p target, shorter for that. */
    void shorten(const StepTarget &target, double error, double time,
                 ImplicitState &now) const;
    /** Chooses the step after that from @p before to @p state, which took
        @p n_iterations, whose prediction left @p error of the forces out of
        balance, 0 if there was none, and which went along @p path [m]. */
    template <int dim>
    void adapt(const State<dim> &before, unsigned int n_iterations,
               double error, double path, State<dim> &state) const;

    /** Makes the next step the first of a jump; false: there are none. */
    bool begin_jump(double time, ImplicitState &now) const;
    /** As adapt(), within a jump. */
    void adapt_jump(unsigned int n_iterations, double path,
                    ImplicitState &now) const;
    /** Whether the loads of a jump went so fast in the step from @p time to
        @p target that drag, @p ratio by the applied forces, held the model;
        they go slower then. @p last: that of the same step at another rate. */
    bool slows_loads(const StepTarget &target, double ratio, double last,
                     double time, ImplicitState &now) const;
    /** Chooses the step after a jump from the equilibrium @p before. */
    void end_jump(const ImplicitState &before, ImplicitState &now) const;
    /** Largest path increment in the next step of a jump [m]. */
    double most_jump_path(const ImplicitState &now) const;

  private:
    /** First load step, share of the stage. */
    double first_load_step() const
    {
      return rests ? 1. : parameters.first_step;
    }
    /** Longest step for the error that a prediction had in a step that went so
        far, shares of the stage. */
    double longest_step(double went, double error) const;

    const ImplicitParameters parameters;
    double stage_end = 0.; /**< load time [s] */
    bool rests = false, searches_factor = false;
  };
} // namespace quoin

#endif
