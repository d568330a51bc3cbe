// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_load_growth_h
#define quoin_loading_load_growth_h

#include <quoin/signals/time_function.h>

#include <vector>

namespace quoin
{
  /** Growth of the loads on blocks that a stage has placed; see Arrival. */
  struct PlacedGrowth
  {
    std::vector<unsigned int> blocks; /**< of the mesh */
    std::vector<unsigned int> loads;  /**< among RunLoads::nodal */
    Growth growth;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(blocks, loads, growth);
    }
  };

  /**
   * How the loads of a run grow in the stage that has begun. A stage that ends
   * before they are there leaves the rest of their growth to the next one.
   */
  struct LoadGrowth
  {
    static constexpr const char *slice_name = "load growth";

    std::vector<Growth> nodal;       /**< of each of RunLoads::nodal */
    std::vector<Growth> constraints; /**< of the forces of each constraint */
    std::vector<Growth> beams;       /**< of the loads of each beam */
    std::vector<PlacedGrowth> placed;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(nodal, constraints, beams, placed);
    }
  };
} // namespace quoin

#endif
