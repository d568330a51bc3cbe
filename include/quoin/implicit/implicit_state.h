// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_implicit_state_h
#define quoin_implicit_implicit_state_h

#include <quoin/blocks/rigid_blocks.h>

#include <string>
#include <vector>

namespace quoin
{
  /** State of the implicit solver from step to step; see ImplicitSolver. */
  struct ImplicitState
  {
    static constexpr const char *slice_name = "implicit";

    unsigned int dim = 2; /**< components of the forces on a node */
    /** Unbalanced forces at the start of the stage, the components of owned
        nodes, those of each platen and of each rigid block of this rank
        [N, N m]; empty: none. */
    std::vector<double> held, held_platens, held_blocks;
    /** Motion in the last load step or step of a jump, in the same order
        [m, rad], and by how much the load time [s] or the pseudo-time [-]
        advanced in it; zero: do not predict by it. */
    std::vector<double> moved, moved_platens, moved_blocks;
    double moved_for = 0.;
    /** By how much the forces changed in it that hold owned nodes [N]. */
    std::vector<double> held_by;
    double released  = 1.; /**< released share of them [-] */
    double step      = 0.; /**< next step, share of the stage [-] */
    double last_step = 0.; /**< last converged load step, share [-] */

    bool follows_path  = false; /**< the load time is an unknown */
    double path_step   = 0.;    /**< next step of the path's length [m] */
    double path_length = 0.;    /**< path length in the stage so far [m] */
    double farthest    = 0.;    /**< load time reached in the stage [s] */
    unsigned int ahead = 0;     /**< path steps with a new farthest load time */

    /** Whether the state is in a jump to another equilibrium. */
    bool jumps           = false;
    double jump_time     = 0.; /**< load time of the jump [s] */
    double jump_released = 1.; /**< share of the held forces that it releases */
    double jump_rate = 0.; /**< of the load time, by the pseudo-time, at most;
                              0: the loads of the jump are there at once [s] */
    double drag_step    = 0.; /**< next step of pseudo-time [-] */
    double drag_time    = 0.; /**< pseudo-time of the jump so far [-] */
    double drag_path    = 0.; /**< path's length in the jump so far [m] */
    unsigned int n_drag = 0;  /**< steps of the jump so far */
    /** Step of the jump when the drag was last compared with what it was, and
        this, by the applied forces. */
    unsigned int watched_from = 0;
    double watched_drag       = 0.;
    double jump_loss = 0.; /**< dissipated by drag since the jump began [J] */
    bool after_jump  = false; /**< whether the last equilibrium ended one */
    /** Archived State of the equilibrium before a jump, in checkpoints within
     * it. */
    std::string before_jump;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.owned_nodes(held, dim);
      visitor.same(held_platens);
      visitor.own(held_blocks, 3, RigidBlockStates::slice_name);
      visitor.owned_nodes(moved, dim);
      visitor.owned_nodes(held_by, dim);
      visitor.same(moved_platens);
      visitor.own(moved_blocks, 3, RigidBlockStates::slice_name);
      visitor.same(dim, moved_for, released, step, last_step, follows_path,
                   path_step, path_length, farthest, ahead, jumps, jump_time,
                   jump_released, jump_rate, drag_step, drag_time, drag_path,
                   n_drag, watched_from, watched_drag, jump_loss, after_jump,
                   before_jump);
    }
  };
} // namespace quoin

#endif
