// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_construction_state_h
#define quoin_model_construction_state_h

#include <quoin/base/node_record.h>

#include <vector>

namespace quoin
{
  /** Forces of excavated blocks on those that stay, as they are released. */
  template <int dim>
  struct HeldForces
  {
    /** Components at each owned node at the time of excavation [N]. */
    std::vector<double> force;
    double left        = 1.; /**< share left at the start of the stage [-] */
    double left_at_end = 1.; /**< fraction left at the end of the release [-] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.owned_nodes(force, dim);
      visitor.same(left, left_at_end);
    }
  };

  /** Changes of the model by stages; see Construction. */
  template <int dim>
  struct ConstructionState
  {
    /** Components of the stress of a cell. */
    static constexpr unsigned int n_stresses = dim == 2 ? 4 : 6;

    static constexpr const char *slice_name = "construction";

    /** Forces of each excavation not fully released. */
    std::vector<HeldForces<dim>> held;
    /** Stress of each deformable cell at zero strain, components as of
        cell_stress() [Pa], after changes of materials and fill; empty: as at
        the start. */
    AlignedArray<double> initial_stress;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.each(held);
      visitor.cells(initial_stress, n_stresses);
    }
  };
} // namespace quoin

#endif
