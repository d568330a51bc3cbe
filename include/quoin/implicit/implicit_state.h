// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_implicit_state_h
#define quoin_implicit_implicit_state_h

#include <string>
#include <vector>

namespace quoin
{
  /** What the implicit solver keeps from step to step; see ImplicitSolver. */
  struct ImplicitState
  {
    static constexpr const char *slice_name = "implicit";

    /** Out-of-balance forces with which the stage began, x, y of owned nodes
        and three of each platen [N, N m]; empty: none. */
    std::vector<double> held;
    double released  = 1.; /**< share of them that is gone [-] */
    double step      = 0.; /**< to try next, share of the stage [-] */
    double last_step = 0.; /**< of the loads that converged last, likewise */

    bool follows_path  = false; /**< the load time is an unknown */
    double path_step   = 0.;    /**< to try next, of the path's length [m] */
    double path_length = 0.;    /**< in the stage so far [m] */
    double farthest    = 0.;    /**< load time reached in the stage [s] */
    unsigned int ahead = 0;     /**< steps on the path that reached farther */

    bool jumps          = false; /**< on the way to another equilibrium */
    double jump_time    = 0.;    /**< load time of that [s] */
    double drag_step    = 0.;    /**< to try next, of the way [-] */
    unsigned int n_drag = 0;     /**< steps of the way so far */
    double jump_loss    = 0.;    /**< taken by the drag since it began [J] */
    /** In checkpoints within a jump: the archived State of the equilibrium
        before it. */
    std::string before_jump;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &held &released &step &last_step &follows_path &path_step
          &path_length &farthest &ahead &jumps &jump_time &drag_step &n_drag
              &jump_loss &before_jump;
    }
  };
} // namespace quoin

#endif
