// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_matched_joints_h
#define quoin_contact_matched_joints_h

#include <quoin/joints/joint_history.h>
#include <quoin/operators/force_operator.h>
#include <quoin/joints/joint_parameters.h>
#include <quoin/mesh/node_map.h>

#include <array>
#include <functional>
#include <string>
#include <variant>
#include <vector>

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

  /** Points of brittle joints that may break in a step of an implicit solver;
      see MatchedJoints::linearise(). */
  struct BreakingJoints
  {
    static constexpr const char *slice_name = "breaking joints";

    std::vector<std::uint8_t> points; /**< 1: it may; one entry for each */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.own(points, 2, JointHistory::slice_name);
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive_members(archive, *this);
    }
  };

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
     * Takes the joint faces of @p nodes.
     * Throws an InputError about a joint face that belongs to no set, or a
     * curve named by two sets.
     */
    void prepare(const NodeMap<2> &nodes,
                 const std::vector<JointSetParameters> &sets, double thickness);

    const char *kind() const override
    {
      return "joints";
    }

    /** Intact points, free of traction. */
    void prepare(State<2> &state) const override;

    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;

    double stored_energy(const State<2> &state) const override
    {
      return stored_energy(state.nodes.data(), state.get<JointHistory>());
    }

    unsigned int n_segments() const
    {
      return segments.size();
    }
    unsigned int n_points() const
    {
      return 2 * segments.size();
    }

    /** Whether a joint of any rank may open or slip. */
    bool can_fail() const;

    /** Stress xx, yy, xy [Pa] for both points of a joint face. */
    using FaceStress = std::array<std::array<double, 3>, 2>;

    /** Intact points, free of traction. */
    JointHistory make_history() const;

    /** Sets the tractions that balance an initial stress at rest. */
    void initialise(const std::vector<FaceStress> &face_stress,
                    const State<2> &state, JointHistory &history) const;

    /** Points, of all ranks, whose tractions exceed their strength. */
    double n_beyond_strength(const JointHistory &history,
                             MPI_Comm communicator) const;

    // For blocks that are taken away or placed, and for other laws.

    /** Adds the forces of segment @p i by the tractions of @p history. */
    void add_traction_forces(unsigned int i, const NodeRecord<2> *nodes,
                             const JointHistory &history,
                             NodeVector<2> *force) const;

    /** Segment @p i is no joint from now on: a side of it is not there. */
    void detach(unsigned int i, JointHistory &history) const;

    /** Segment @p i is an intact joint, free of traction where it is now. */
    void begin_anew(unsigned int i, const NodeRecord<2> *nodes,
                    JointHistory &history) const;

    /**
     * Joints follow the laws of @p sets from now on, of which there are as
     * many as before, each of its kind. Their tractions jump unless
     * keep_tractions() moves the offsets too.
     */
    void set_laws(const std::vector<JointSetParameters> &sets);

    /**
     * Inelastic opening and slip of @p history become those with which the
     * tractions it has are the law's at the gaps in @p nodes.
     */
    void keep_tractions(const NodeRecord<2> *nodes,
                        JointHistory &history) const;

    /**
     * Brings the histories to the positions in @p nodes, adds the joint
     * forces to @p force and books the dissipation.
     */
    void add_forces(const NodeRecord<2> *nodes, JointHistory &history,
                    EnergyAccounts &energy, NodeVector<2> *force) const;

    /**
     * Adds the stiffness-proportional damping forces of points that neither
     * slip nor are open: beta kn, beta ks times the rates [Pa].
     */
    void add_viscous_forces(const NodeRecord<2> *nodes,
                            const JointHistory &history,
                            const NodeVector<2> *velocity, double beta,
                            NodeVector<2> *force) const;

    /**
     * What add_forces() does, of all segments or of segment @p i, with its
     * derivative, consistent with the update of @p history, if
     * @p with_stiffness; otherwise stiffness and inelastic_gradient are not
     * set. Books the dissipation.
     *
     * The tractions of a brittle joint jump when it breaks, which no Newton
     * iteration survives. So intact points of a brittle law stay elastic here
     * beyond their strength unless @p broken or BreakingJoints of the state, an
     * entry for each point, say that they break; see excess().
     */
    void linearise(State<2> &state, bool with_stiffness,
                   const TakeElement<2> &take) const override;
    void linearise(unsigned int i, const NodeRecord<2> *nodes,
                   const std::vector<std::uint8_t> &broken,
                   JointHistory &history, EnergyAccounts &energy,
                   JointLinearisation &result,
                   bool with_stiffness = true) const;

    /**
     * By how much entry @p point of @p history that linearise() left elastic
     * exceeds its strength, as a share of its stress; zero or less: it holds.
     */
    double excess(unsigned int point, const JointHistory &history) const;

    /** Recoverable energy [J] of this rank's share of the joints. */
    double stored_energy(const NodeRecord<2> *nodes,
                         const JointHistory &history) const;

    void add_stiffness_bound(
        const State<2> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<2>> &stiffness) const override;

    struct Segment
    {
      std::array<unsigned int, 2> lower, upper; /**< local nodes */
      std::array<double, 2> area;               /**< of each point [m^2] */
      float share; /**< of the energy that this rank counts */
      unsigned int set;
      unsigned int face; /**< into LocalFaces::joints */
    };

    const Segment &segment(const unsigned int i) const
    {
      return segments[i];
    }

    /** Opening and slip [m] of both points of segment @p i. */
    std::array<std::array<double, 2>, 2> gaps(const NodeRecord<2> *nodes,
                                              unsigned int i) const;

    const JointLaw &law(const unsigned int set) const
    {
      return laws[set];
    }

    /** Names of the fields for results that laws of the sets have. */
    std::vector<std::string> field_names() const;

    /** The field @p name at entry @p point of @p history; 0 if the law there
        has none. */
    double field(const std::string &name, unsigned int point,
                 const JointHistory &history) const;

  private:
    struct Frame
    {
      double normal[2];
      double tangent[2];
    };
    static Frame frame(const Segment &segment, const NodeRecord<2> *nodes);
    static std::array<double, 2> gap(const Segment &segment, const Frame &frame,
                                     const NodeRecord<2> *nodes,
                                     unsigned int k);

    /** Calls @p use with the law of a set, of its own type. */
    template <typename Use>
    void with_law(const unsigned int set, const Use &use) const
    {
      std::visit(use, laws[set]);
    }

    /** add_forces() of a set. */
    template <typename Law>
    void add_set_forces(unsigned int set, const Law &law,
                        const NodeRecord<2> *nodes, JointHistory &history,
                        EnergyAccounts &energy, NodeVector<2> *force) const;

    std::vector<Segment> segments;       /**< sorted by set */
    std::vector<JointLaw> laws;          /**< of each set */
    std::vector<unsigned int> set_begin; /**< first segment of each set */
  };
} // namespace quoin

#endif
