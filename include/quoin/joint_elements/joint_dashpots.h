// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_joint_dashpots_h
#define quoin_joint_elements_joint_dashpots_h

#include <quoin/base/node_record.h>
#include <quoin/joint_elements/pair_dashpots.h>
#include <quoin/joint_laws/joint_parameters.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /** The dashpots beside the springs of joints of the mesh, in two and in three
      dimensions. */
  class JointDashpots
  {
  public:
    /** Sets the damping of each set. */
    void set_dampings(const std::vector<JointSetParameters> &sets);
    const std::vector<JointDamping> &dampings() const
    {
      return all_dampings;
    }

    /** Sets the joint faces, of which @p joints are the sides. */
    template <typename Face, typename Joint>
    void set_faces(const std::vector<Face> &faces,
                   const std::vector<Joint> &joints)
    {
      sides.clear();
      for (const Face &face : faces)
        sides.push_back({ joints[face.face].blocks, joints[face.face].groups });
    }

    /** Sets what dashpots need, without which there are none. Collective. */
    void set_blocks(const DashpotBlocks &blocks)
    {
      pairs.set_blocks(blocks);
      pairs.bind(sides);
    }
    /** Whether a set has dashpots that act. */
    bool act() const;

    /**
     * Adds the forces of the dashpots of @p faces, those of set_faces(), with
     * the law of each set, at nodes that move with @p velocity. @p gone:
     * nonzero for faces that are no joints any more. Collective.
     */
    template <int dim, typename Face, typename History>
    void add_forces(const std::vector<Face> &faces,
                    const std::vector<JointLaw> &laws,
                    const NodeRecord<dim> *nodes, const History &history,
                    const std::uint8_t *gone,
                    const dealii::Tensor<1, dim> *velocity,
                    dealii::Tensor<1, dim> *force);

    /** Adds those of face @p i alone, with the springs of all that were pressed
        when add_forces() was last called. */
    template <int dim, typename Face, typename History>
    void add_face_forces(unsigned int i, const std::vector<Face> &faces,
                         const std::vector<JointLaw> &laws,
                         const NodeRecord<dim> *nodes, const History &history,
                         const std::uint8_t *gone,
                         const dealii::Tensor<1, dim> *velocity,
                         dealii::Tensor<1, dim> *force) const;

  private:
    std::vector<PairDashpots::Item> sides; /**< of each face */
    std::vector<JointDamping> all_dampings;
    PairDashpots pairs;
  };
} // namespace quoin

#endif
