// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_largest_force_h
#define quoin_dynamics_largest_force_h

namespace quoin
{
  /** The part of State by which a stage that takes all loads away knows how
      large forces were. */
  struct LargestForce
  {
    static constexpr const char *slice_name = "largest force";

    double applied = 0.; /**< in the stage, where a balance was found [N] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(applied);
    }
  };
} // namespace quoin

#endif
