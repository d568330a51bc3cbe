// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_space_joints_h
#define quoin_joint_elements_space_joints_h

#include <quoin/joint_elements/face_groups.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/joint_elements/space_joint_history.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <type_traits>
#include <vector>

namespace quoin
{
  /** A joint face of this rank in three dimensions. */
  struct SpaceJointFace
  {
    std::array<unsigned int, 3> lower, upper; /**< local nodes */
    double area; /**< area of each of its points, a third of its own [m^2] */
    float share; /**< fraction of the energy that this rank counts */
    unsigned int set;
    unsigned int face; /**< index into LocalFaces::joints */
  };

  /** Area of each point [m^2]. */
  inline double point_area(const SpaceJointFace &face, unsigned int)
  {
    return face.area;
  }

  /**
   * The frame of a joint face and how it turns. Its plane is that of the mean
   * of both sides, with the edges E1 and E2 from its first vertex:
   * normal n along E1 x E2, from the lower to the upper side, tangents s along
   * E1 and t = n x s. Numbers may carry derivatives.
   */
  template <typename Vector, typename Number>
  struct FaceFrame
  {
    Vector n, s, t;
    Number length;       /**< of E1 [m] */
    Number along, above; /**< E2 = along s + above t [m] */
  };
  using SpaceJointFrame = FaceFrame<dealii::Tensor<1, 3>, double>;

  SpaceJointFrame joint_frame(const SpaceJointFace &face,
                              const NodeRecord<3> *nodes);

  /** Opening, and slip along s and t [m]. */
  using SpaceJointGap = std::array<double, 3>;

  /** Opening and slip of the three points of @p face. */
  std::array<SpaceJointGap, 3> joint_gaps(const SpaceJointFace &face,
                                          const NodeRecord<3> *nodes);

  /**
   * The zero-thickness joints of MatchedJoints in three dimensions: between
   * coincident faces of two blocks, or of the two lips of a crack.
   *
   * Each joint face is a triangle with a contact point at each vertex, which
   * has a third of the area of the mesh (nodal quadrature, as in two
   * dimensions). Opening and the two components of slip are those of the upper
   * vertex's displacement relative to the lower one in the frame of the face,
   * which turns with it: see SpaceJointFrame. Forces are minus the derivative
   * of the energy, the rotation of the frame included. Point k of face i has
   * history entry 3 i + k.
   *
   * A face between blocks of two ranks is computed by both, from the same
   * numbers; each then counts half of its energy.
   */
  class SpaceJoints : public ForceOperator<3>
  {
  public:
    /**
     * Takes the joint faces of @p nodes, to which it keeps a reference. Throws
     * an InputError about a joint face that belongs to no set, or a surface
     * named by two sets.
     */
    void prepare(const NodeMap<3> &nodes,
                 const std::vector<JointSetParameters> &sets);

    /** Replaces the laws of the sets by others of the same kinds. */
    void set_laws(const std::vector<JointSetParameters> &sets);

    const char *kind() const override
    {
      return "joints";
    }

    /** Intact points, free of traction. */
    void prepare(State<3> &state) const override;

    void add_forces(const StepContext &step, State<3> &state,
                    const NodeForces<3> &forces) override;

    void add_stored_energy(const State<3> &state,
                           EnergyAccounts &energies) const override;

    void add_stiffness_bound(
        const State<3> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<3>> &stiffness) const override;
    void add_damping_bound(const std::vector<double> &masses, double impedance,
                           DampingBound &bound) const override;

    /** See joint_tangent.h and BreakingJoints. */
    void linearise(State<3> &state, bool with_stiffness,
                   const TakeElement<3> &take) const override;

    const std::vector<SpaceJointFace> &faces() const
    {
      return all_faces;
    }
    unsigned int n_points() const
    {
      return 3 * all_faces.size();
    }
    /** The law of each set. */
    const std::vector<JointLaw> &laws() const
    {
      return all_laws;
    }

    /** Beside the springs; none before set_blocks(). */
    JointDashpots dashpots;

    /**
     * Updates the internal variables for the positions in @p nodes, adds the
     * joint forces to @p force and the dissipation to @p energy.
     */
    void add_forces(const NodeRecord<3> *nodes, SpaceJointHistory &history,
                    EnergyAccounts &energy, dealii::Tensor<1, 3> *force) const;

    /** Adds the stiffness-proportional damping forces of points that neither
        slip nor are open: beta kn, beta ks times the rates [Pa]. */
    void add_viscous_forces(const NodeRecord<3> *nodes,
                            const SpaceJointHistory &history,
                            const dealii::Tensor<1, 3> *velocity, double beta,
                            dealii::Tensor<1, 3> *force) const;

  private:
    const NodeMap<3> *node_map = nullptr;
    std::vector<SpaceJointFace> all_faces; /**< sorted by set */
    std::vector<JointLaw> all_laws;
    FaceGroups<3> groups;
  };

  /** Names of the quantities of the laws for results; see JointField. */
  std::vector<std::string> law_field_names(const SpaceJoints &joints);
  /** The quantity @p name of point @p p; 0 if its law has none. */
  double law_field(const SpaceJoints &joints, const std::string &name,
                   unsigned int p, const SpaceJointHistory &history);

  /** The joints of a model. */
  template <int dim>
  using JointsOf = std::conditional_t<dim == 2, MatchedJoints, SpaceJoints>;
} // namespace quoin

#endif
