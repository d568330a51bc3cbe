// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_contact_dashpots_h
#define quoin_contact_contact_dashpots_h

#include <quoin/contact/contact_laws.h>
#include <quoin/contact_geometry/contact_state.h>
#include <quoin/contact_geometry/near_pairs.h>
#include <quoin/joint_elements/pair_dashpots.h>

#include <array>
#include <vector>

namespace quoin
{
  /** A dashpot at point @p k of the pair @p pair of ContactState::pairs. */
  struct ContactDashpot
  {
    unsigned int pair, k;
    double area, lower, upper; /**< see PairGeometry */
    std::array<double, 2> normal;
    std::array<double, 2> gap;       /**< opening and slip [m] */
    std::array<double, 2> stiffness; /**< per area [Pa/m] */
    double force[2]{};               /**< on the lower edge [N] */
  };

  /** The dashpots beside the springs of contacts. JointDashpots are those of
      joints of the mesh. */
  class ContactDashpots
  {
  public:
    /** Keeps references. */
    ContactDashpots(const NearPairs &near, const ContactLaws &laws)
      : near(near), laws(laws)
    {
    }

    /** Sets what dashpots need, without which there are none. */
    void set_blocks(const DashpotBlocks &blocks)
    {
      pairs.set_blocks(blocks);
    }
    /** Whether a set has dashpots that act. */
    bool act() const;

    /** Takes the pairs at hand, between @p edges. Collective. */
    void bind(const ContactState &contacts, const ContactEdges &edges);

    // In each step, in this order.

    /** Forgets all dashpots. */
    void clear();
    /** Adds a dashpot at a point that presses on its springs. */
    void add(const ContactDashpot &dashpot)
    {
      pairs.add_springs(dashpot.pair, near.weights()[dashpot.pair].share,
                        dashpot.area * dashpot.stiffness[0],
                        dashpot.area * dashpot.stiffness[1]);
      dashpots.push_back(dashpot);
    }
    /** Adds their forces to compact nodes, see MovingEdges. Collective. */
    void add_forces(const ContactState &contacts, dealii::Tensor<1, 2> *force);

    /** Those of the present step. */
    const std::vector<ContactDashpot> &all() const
    {
      return dashpots;
    }

  private:
    const NearPairs &near;
    const ContactLaws &laws;
    PairDashpots pairs;
    std::vector<ContactDashpot> dashpots;
  };
} // namespace quoin

#endif
