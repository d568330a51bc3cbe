// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_matched_joints_h
#define quoin_joint_elements_matched_joints_h

#include <quoin/base/thickness.h>
#include <quoin/joint_elements/face_groups.h>
#include <quoin/joint_elements/joint_dashpots.h>
#include <quoin/joints/joint_history.h>
#include <quoin/operators/force_operator.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/mesh/node_map.h>

#include <array>
#include <variant>
#include <vector>

namespace quoin
{
  /** A joint face of this rank. */
  struct JointSegment
  {
    std::array<unsigned int, 2> lower, upper; /**< local nodes */
    std::array<double, 2> area;               /**< area of each point [m^2] */
    float share; /**< fraction of the energy that this rank counts */
    unsigned int set;
    unsigned int face; /**< index into LocalFaces::joints */
  };

  /** Area of point @p k [m^2]. */
  inline double point_area(const JointSegment &segment, const unsigned int k)
  {
    return segment.area[k];
  }

  /** Opening and slip [m] of both points of @p segment. */
  std::array<std::array<double, 2>, 2> joint_gaps(const JointSegment &segment,
                                                  const NodeRecord<2> *nodes);

  /**
   * The zero-thickness joints between coincident edges of two blocks, or of
   * the two lips of a crack.
   *
   * Each joint face is a segment with a contact point at either end: the
   * vertex of one side against the vertex of the other, with half the
   * segment's length as tributary length, or that of Simpson's rule on the
   * halves of a quadratic edge (nodal quadrature, which keeps stiff joints free
   * of traction oscillations). The local frame turns with the
   * segment: normal n from the lower to the upper side, tangent s = (n_y,
   * -n_x), both from the mean of the two current edges. Opening and slip are
   * the components of the upper vertex's displacement relative to the lower
   * one. Point k of segment i has history entry 2 i + k.
   *
   * A segment between blocks of two ranks is computed by both, from the same
   * numbers; each then counts half of its energy.
   */
  class MatchedJoints : public ForceOperator<2>
  {
  public:
    /**
     * Takes the joint faces of @p nodes, to which it keeps a reference;
     * @p thickness: of each cell group.
     * Throws an InputError about a joint face that belongs to no set, or a
     * curve named by two sets.
     */
    void prepare(const NodeMap<2> &nodes,
                 const std::vector<JointSetParameters> &sets,
                 const Thickness &thickness);

    const char *kind() const override
    {
      return "joints";
    }

    /** Intact points, free of traction. */
    void prepare(State<2> &state) const override;

    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;

    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override;

    void add_stiffness_bound(
        const State<2> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<2>> &stiffness) const override;
    void add_damping_bound(const std::vector<double> &masses, double impedance,
                           DampingBound &bound) const override;

    const std::vector<JointSegment> &segments() const
    {
      return all_segments;
    }
    unsigned int n_points() const
    {
      return 2 * all_segments.size();
    }

    /** The law of each set. */
    const std::vector<JointLaw> &laws() const
    {
      return all_laws;
    }

    /**
     * Joints follow the laws of @p sets from now on, of which there are as
     * many as before, each of its kind. Their tractions jump unless
     * keep_joint_tractions() moves the offsets too.
     */
    void set_laws(const std::vector<JointSetParameters> &sets);

    /** Beside the springs; none before set_blocks(). */
    JointDashpots dashpots;
    /** Adds the forces [N] of the dashpots of face @p i as they were when
       forces were last added, with the nodes, velocities and histories of @p
       state. */
    void add_dashpot_forces(unsigned int i, const State<2> &state,
                            dealii::Tensor<1, 2> *force) const;

    /**
     * Updates the internal variables for the positions in @p nodes, adds the
     * joint forces to @p force and the dissipation to @p energy.
     */
    void add_forces(const NodeRecord<2> *nodes, JointHistory &history,
                    EnergyAccounts &energy, dealii::Tensor<1, 2> *force) const;

    /**
     * Adds the stiffness-proportional damping forces of points that neither
     * slip nor are open: beta kn, beta ks times the rates [Pa].
     */
    void add_viscous_forces(const NodeRecord<2> *nodes,
                            const JointHistory &history,
                            const dealii::Tensor<1, 2> *velocity, double beta,
                            dealii::Tensor<1, 2> *force) const;

    /** What add_forces() does, with derivatives; see joint_tangent.h and
        BreakingJoints. */
    void linearise(State<2> &state, bool with_stiffness,
                   const TakeElement<2> &take) const override;

  private:
    const NodeMap<2> *node_map = nullptr;
    std::vector<JointSegment> all_segments; /**< sorted by set */
    std::vector<JointLaw> all_laws;
    FaceGroups<2> groups;
  };
} // namespace quoin

#endif
