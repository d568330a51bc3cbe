// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_construction_state_h
#define quoin_dynamics_construction_state_h

#include <quoin/base/node_vector.h>

#include <vector>

namespace quoin
{
  /** What excavated blocks exerted on those that stay, as it is let go. */
  struct HeldForces
  {
    /** x, y of owned nodes, as the blocks were taken away [N]. */
    std::vector<double> force;
    double left        = 1.; /**< share where the stage begins [-] */
    double left_at_end = 1.; /**< and at the end of its release [-] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &force &left &left_at_end;
    }
  };

  /** What the stages did to the model; see Construction. */
  struct ConstructionState
  {
    static constexpr const char *slice_name = "construction";

    std::vector<HeldForces> held; /**< of each excavation not let go yet */
    /** xx, yy, xy, zz of each deformable cell without strain, as changes of
        materials and fill left it [Pa]; empty: as at the start. */
    AlignedArray<double> initial_stress;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &held &initial_stress;
    }
  };
} // namespace quoin

#endif
