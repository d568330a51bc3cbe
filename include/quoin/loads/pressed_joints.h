// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_pressed_joints_h
#define quoin_loads_pressed_joints_h

#include <quoin/base/thickness.h>
#include <quoin/mesh/node_map.h>
#include <quoin/operators/state.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** Joints in which a pressure acts, on both of their faces. */
  class PressedJoints
  {
  public:
    PressedJoints() = default;
    /** Those of @p curves; @p thickness: of each cell group. Collective. */
    template <int dim>
    PressedJoints(const NodeMap<dim> &node_map,
                  const std::vector<std::string> &curves,
                  const Thickness &thickness);

    /** Whether there are any, on any rank. */
    bool exist() const
    {
      return some_exist;
    }
    /** Whether one has a block on one side alone in @p state; @p uneven: one
        between blocks of different thickness. Collective. */
    template <int dim>
    bool have_bared_sides(const State<dim> &state, bool uneven = false) const;
    /** Throws an InputError naming @p load if a joint between blocks of
        different thickness, over the smaller of which the pressure acts, has
        one of them alone in the stage @p name. Collective. */
    template <int dim>
    void refuse_bared_sides(const std::string &load, const std::string &name,
                            const State<dim> &state) const;

  private:
    bool some_exist       = false;
    MPI_Comm communicator = MPI_COMM_SELF;
    /** Blocks on both sides, of all and of those of different thickness. */
    std::vector<std::array<unsigned int, 2>> blocks, uneven_blocks;
  };
} // namespace quoin

#endif
