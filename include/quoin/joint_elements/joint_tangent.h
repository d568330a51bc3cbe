// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_joint_tangent_h
#define quoin_joint_elements_joint_tangent_h

#include <quoin/joint_elements/breaking_joints.h>
#include <quoin/joint_elements/space_joints.h>

// Derivatives of the forces of joints.

namespace quoin
{
  /**
   * A segment's nodal forces and minus their derivative by the displacements
   * of its nodes, lower[0], lower[1], upper[0], upper[1]: entry 2 i + d is
   * node i, component d.
   */
  struct JointLinearisation
  {
    std::array<unsigned int, 4> nodes;
    std::array<double, 8> force;                    /**< [N] */
    std::array<std::array<double, 8>, 8> stiffness; /**< [N/m] */
    /**
     * Sum over the points of area times what inelastic opening and slip grew
     * by, less on the way back [m^3], and its derivative [m^2].
     */
    double inelastic;
    std::array<double, 8> inelastic_gradient;
  };

  /**
   * The forces of segment @p i of @p joints at @p nodes, and their derivative
   * if @p with_stiffness; otherwise stiffness and inelastic_gradient are not
   * set. It is consistent with the update of @p history; the dissipation is
   * booked in @p energy. @p broken: see BreakingJoints.
   */
  void linearise(const MatchedJoints &joints, unsigned int i,
                 const NodeRecord<2> *nodes,
                 const std::vector<std::uint8_t> &broken, JointHistory &history,
                 EnergyAccounts &energy, JointLinearisation &result,
                 bool with_stiffness = true);

  /**
   * By how much entry @p point of @p history, which waits for its loss in an
   * equilibrium, exceeds its strength, as a share of its stress or cohesion;
   * zero or less: it holds. See BreakingJoints.
   */
  double excess(const MatchedJoints &joints, unsigned int point,
                const JointHistory &history);
  double excess(const SpaceJoints &joints, unsigned int point,
                const SpaceJointHistory &history);

  /**
   * Adds the forces [N] of intact joints that are as stiff as they can become
   * to @p force, for nodes displaced by @p displacement [m] from @p nodes.
   */
  void add_elastic_forces(const MatchedJoints &joints,
                          const NodeRecord<2> *nodes,
                          const dealii::Tensor<1, 2> *displacement,
                          dealii::Tensor<1, 2> *force);
  void add_elastic_forces(const SpaceJoints &joints, const NodeRecord<3> *nodes,
                          const dealii::Tensor<1, 3> *displacement,
                          dealii::Tensor<1, 3> *force);
} // namespace quoin

#endif
