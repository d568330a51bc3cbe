// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/joint_dashpots.h>

#include <algorithm>

namespace quoin
{
  void JointDashpots::set_dampings(const std::vector<JointSetParameters> &sets)
  {
    all_dampings.clear();
    for (const JointSetParameters &set : sets)
      all_dampings.push_back(set.damping);
  }

  bool JointDashpots::act() const
  {
    return pairs.knows_blocks()
           && std::any_of(all_dampings.begin(), all_dampings.end(),
                          [](const JointDamping &damping)
                          { return damping.acts(); });
  }
} // namespace quoin
