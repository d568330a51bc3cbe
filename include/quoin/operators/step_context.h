// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_step_context_h
#define quoin_operators_step_context_h

namespace quoin
{
  /** Time since the stage began and since the run began [s]. */
  struct TimePoint
  {
    double stage;
    double total;
  };

  /** The current step, from t to t + dt. */
  struct StepContext
  {
    TimePoint begin, middle, end; /**< by the loads' clock */
    double load_rate;             /**< of that clock [-] */
    double dt;                    /**< from t to t + dt [s] */
    double dt_before;             /**< previous step; 0 at the first [s] */
    double dt_velocity;           /**< from middle to middle [s] */
    double local_damping;         /**< Cundall's factor; 0: none */
    double mass_damping;          /**< alpha [1/s] */
    double stiffness_damping;     /**< beta [s] */
  };
} // namespace quoin

#endif
