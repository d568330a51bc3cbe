// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_contact_laws_h
#define quoin_contact_contact_laws_h

#include <quoin/contact_geometry/contact_state.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/joint_laws/joint_parameters.h>

#include <string>
#include <variant>
#include <vector>

namespace quoin
{
  /** The laws of contacts, one of each joint set, and which of them a new
      contact between two materials follows. */
  class ContactLaws
  {
  public:
    /** Throws an InputError about unknown materials, pairs named twice and
        materials that no set for new contacts covers. */
    ContactLaws(const std::vector<JointSetParameters> &sets,
                const std::vector<std::string> &materials,
                const std::vector<unsigned int> &material_of_group);

    /** Other laws of the same joint sets, with the same stiffness, and other
        materials of the cell groups. */
    void set_properties(const std::vector<JointSetParameters> &sets,
                        const std::vector<unsigned int> &of_group);

    /** Law of each set. */
    const std::vector<JointLaw> &laws() const
    {
      return all_laws;
    }
    /** Dashpots of each set. */
    const std::vector<JointDamping> &dampings() const
    {
      return all_dampings;
    }
    /** Whether a set does. */
    bool dilates() const
    {
      return any_dilates;
    }
    /** The set of a new contact between cells of two groups. */
    unsigned int set_between(const unsigned int a, const unsigned int b) const
    {
      return set_of_materials[material_of_group[a] * n_materials
                              + material_of_group[b]];
    }
    /** Calls @p use with the law of a set, of its own type. */
    template <typename Use>
    void with_law(const unsigned int set, const Use &use) const
    {
      // The usual law in line: a visit calls through a table.
      if (const auto *coulomb = std::get_if<CoulombLaw>(&all_laws[set]))
        use(*coulomb);
      else
        std::visit(use, all_laws[set]);
    }
    /** Forgets the history of @p pair; returns the energy that it stored
        [J]. */
    double release(ContactPair &pair) const;

    /** As sets_on_blocks() of @p joints, with sets that may act once the block
        touches others: those of its joints and of new contacts of its
        materials with any that are in the mesh. Collective. */
    std::vector<std::uint8_t> sets_on_blocks(const MatchedJoints &joints,
                                             const NodeMap<2> &node_map) const;

  private:
    std::vector<JointLaw> all_laws;
    std::vector<JointDamping> all_dampings;
    bool any_dilates = false;
    const unsigned int n_materials;
    const std::vector<unsigned int> set_of_materials; /**< square table */
    std::vector<unsigned int> material_of_group;
  };
} // namespace quoin

#endif
