// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beam_motion_h
#define quoin_structures_beam_motion_h

#include <quoin/blocks/node_update.h>
#include <quoin/structures/beams.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Mass of each node of each placed beam, without and with that of a scaled
      step [kg]. */
  using BeamMasses = std::vector<std::vector<std::array<double, 2>>>;

  /** Masses and explicit steps of beams. */
  class BeamMotion
  {
  public:
    /** Keeps a reference to @p beams of a model with @p nodes. */
    BeamMotion(const Beams &beams, const NodeMap<2> &nodes);

    /** Finds masses of nodes so that @p scaled_step [s] is stable; 0: those of
        the beams. */
    void find_masses(double scaled_step, const State<2> &state);
    /** Masses of the nodes of placed beams, alike on all ranks [kg]. */
    BeamMasses masses(const State<2> &state) const;
    /** Stiffness of interfaces at each local node of blocks, as
        ForceOperator::add_stiffness_bound() with r = 1 [N/m]; empty: there is
        none. */
    std::vector<double> interface_bound(const State<2> &state) const;
    /** Bound of omega^2 of the placed beams [1/s^2]. */
    double largest_eigenvalue(const State<2> &state) const;

    /** What all beams add to the sums of a step, on the first rank. */
    struct Work
    {
      DampingWork damping;
      double unbalanced = 0., applied = 0.; /**< [N] */
    };
    /** Moves the nodes by the forces of Beams::add_forces() and books the work
        of loads. @p damped: whether there is any damping, @p adaptive: whether
        it is adaptive. */
    Work advance(const StepContext &step, bool damped, bool adaptive,
                 State<2> &state);

    /** Kinetic energy [J] and squared change of velocity of the last step, as
        RigidBlocks has them. */
    double kinetic_energy(const State<2> &state, double share) const;
    double squared_change(const State<2> &state) const;
    /** Kinetic energy of this rank with the velocities of @p state [J]. */
    double kinetic_energy(const State<2> &state) const;
    /** Throws a RunError if the motion is not finite. */
    void check_finite(const State<2> &state) const;

  private:
    /** Stiffness bound of each node [N/m]. */
    std::vector<NodeStiffness<2>> stiffness_bound(const State<2> &state) const;

    const Beams &beams;
    const NodeMap<2> &node_map;
    const bool is_first_rank;
    std::vector<double> mass, inverse_mass; /**< [kg], [1/kg] */
    AlignedArray<dealii::Tensor<1, 2>> force, viscous, velocity_before;
  };
} // namespace quoin

#endif
