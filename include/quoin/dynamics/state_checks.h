// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_state_checks_h
#define quoin_dynamics_state_checks_h

#include <quoin/model/model.h>
#include <quoin/stages/stage_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Throws a ModelFailure if a cell is inverted, which tells whether its mesh
   * or the @p loads, those that act in the stage, are the likely cause.
   * Collective.
   */
  template <int dim>
  void check_cells(const Model<dim> &model, const State<dim> &state,
                   const std::vector<std::string> &loads);

  /**
   * Throws a ModelFailure if plastic flow has changed cells so much that
   * @p time_step [s] is no longer stable in @p stage, with the masses of local
   * nodes @p node_mass [kg] and factors of those of rigid blocks
   * @p mass_factor [-]. Collective.
   */
  template <int dim>
  void check_time_step(const Model<dim> &model, const State<dim> &state,
                       const StageParameters &stage,
                       const std::vector<double> &node_mass,
                       const std::vector<double> &mass_factor,
                       double time_step);

  /** The node of present blocks that has moved farthest. */
  template <int dim>
  struct FarthestNode
  {
    double distance = 0.; /**< [m] */
    /** Velocity along the displacement, positive: it moves on [m/s]. */
    double speed       = 0.;
    unsigned int block = 0; /**< number of the block in the whole mesh */
    dealii::Point<dim> before, now; /**< [m] */
  };

  /** Collective. */
  template <int dim>
  FarthestNode<dim> farthest_node(const Model<dim> &model,
                                  const State<dim> &state);

  /**
   * The largest slip of a matched joint under pressure, by the length of
   * its face [-]: beyond about one half its blocks no longer face each other,
   * and small displacements are no longer valid. Collective.
   */
  double largest_slip_share(const Model<2> &model, const State<2> &state);

  /** Largest motions of matched joints and of the blocks that they join. */
  struct JointMotion
  {
    double slip     = 0.; /**< see largest_slip_share() [-] */
    double distance = 0.; /**< between points that faced each other [m] */
    /** Difference of the mean rotations of two blocks, as small displacements
        have them [rad]. */
    double turn = 0.;

    void take_larger(const JointMotion &other);

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &slip &distance &turn;
    }
  };

  /** Joints of absent blocks do not count. Collective. */
  JointMotion joint_motion(const Model<2> &model, const State<2> &state);
  JointMotion joint_motion(const Model<3> &model, const State<3> &state);
} // namespace quoin

#endif
