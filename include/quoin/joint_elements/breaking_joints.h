// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_breaking_joints_h
#define quoin_joint_elements_breaking_joints_h

#include <quoin/joint_elements/space_joint_history.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /**
   * Points of brittle joints that may break in a step of an implicit solver.
   *
   * The tractions of a brittle joint jump when it breaks, and those of one that
   * keeps cohesion as it slips where it opens, which no Newton iteration
   * survives. So in ForceOperator::linearise() points of a brittle law bear
   * what they must beyond their strength until these say what they have lost.
   */
  template <int dim>
  struct BreakingJoints
  {
    static constexpr const char *slice_name = "breaking joints";

    std::vector<std::uint8_t> points; /**< JointLoss of each */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.own(points, dim, JointHistoryOf<dim>::slice_name);
    }
  };
} // namespace quoin

#endif
