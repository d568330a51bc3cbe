// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_initial_motion_h
#define quoin_loads_initial_motion_h

#include <quoin/signals/space_time_function.h>
#include <quoin/base/parameter_section.h>
#include <quoin/mesh/node_map.h>
#include <quoin/operators/state.h>

#include <vector>

namespace quoin
{
  /**
   * Displacement [m] and velocity [m/s] of all nodes of the blocks that are
   * there at the start of the run, as functions of x, y and, in three
   * dimensions, z: section 'Initial motion'.
   * Both are those of t = 0; the first half step to the velocities of dt/2
   * follows from the forces.
   */
  struct InitialMotion
  {
    /** By component: two, three or, where none is given, no functions. */
    using Components = std::vector<SpaceTimeFunction>;
    Components displacement, velocity;

    static void declare(dealii::ParameterHandler &prm);
    static InitialMotion read(const ParameterSection &section);

    bool is_given() const
    {
      return !displacement.empty() || !velocity.empty();
    }
    /** Sets the motion of the @p nodes of @p state, ghosts included, but for
        those of blocks that are absent. Throws an InputError where it has not
        dim components or is not finite. */
    template <int dim>
    void apply(const NodeMap<dim> &nodes, State<dim> &state) const;
  };
} // namespace quoin

#endif
