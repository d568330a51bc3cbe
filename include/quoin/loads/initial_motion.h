// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_initial_motion_h
#define quoin_loads_initial_motion_h

#include <quoin/loads/space_time_function.h>
#include <quoin/base/parameter_section.h>
#include <quoin/operators/state.h>

#include <array>

namespace quoin
{
  /**
   * Displacement [m] and velocity [m/s] of all nodes at the start of the run,
   * as functions of x and y: section 'Initial motion'. Both are those of t = 0;
   * the first half step to the velocities of dt/2 follows from the forces.
   */
  struct InitialMotion
  {
    bool is_given = false;
    std::array<SpaceTimeFunction, 2> displacement;
    std::array<SpaceTimeFunction, 2> velocity;

    static void declare(dealii::ParameterHandler &prm);
    static InitialMotion read(const ParameterSection &section);

    /** Sets the motion of the nodes of @p state, ghosts included. */
    void apply(State<2> &state) const;
  };
} // namespace quoin

#endif
