// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_block_contacts_h
#define quoin_contact_block_contacts_h

#include <quoin/base/lanes.h>
#include <quoin/contact/contact_dashpots.h>
#include <quoin/contact/contact_laws.h>
#include <quoin/contact/pair_search.h>
#include <quoin/contact_geometry/contact_state.h>
#include <quoin/contact_geometry/near_pairs.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/operators/force_operator.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** What contacts are made of, beside the mesh. */
  struct ContactModel
  {
    ContactParameters parameters;
    std::vector<JointSetParameters> sets;
    std::vector<std::string> materials;
    std::vector<unsigned int> material_of_group;
    Thickness thickness; /**< of each cell group */
    /** Pairs that go through the lanes together, 1, 4 or 8. One by one they
        are the reference of the others. */
    unsigned int n_lanes = native_lanes;
  };

  /** What this rank and process has spent on contacts so far. */
  struct ContactWork
  {
    std::uint64_t updates = 0;  /**< pairs looked at */
    double search_seconds = 0.; /**< wall time of searches [s] */
  };

  /**
   * Contacts between the boundaries of blocks that move and rotate without
   * limit.
   *
   * Two edges whose outward normals oppose each other touch over their
   * overlap, the common part of their projections on the mean of their two
   * directions. Each of its ends is a vertex of one edge against a point of
   * the other, and bears the law at half of the overlap as tributary length:
   * trapezoidal quadrature over the vertices of both sides, so that the
   * lengths of a row of edges add up to the overlap of the rows, a uniform
   * traction passes unchanged between meshes that do not match, and forces are
   * continuous as vertices pass from edge to edge, because a pair of edges
   * comes and goes with length zero. A matched joint (matched_joints.h) is the
   * pair whose vertices coincide.
   *
   * With theta the angle by which the edges fail to be parallel, lengths are
   * measured on the other edge (times cos theta), fading to zero near
   * theta = 90 degrees, and where the next edge beyond a corner lies flatter on
   * the other block. The normal is that of the edge which a corner touches;
   * where two corners meet within the rounding length it turns from one edge's
   * to the other's, and for what was a joint it is the mean of both as long as
   * they are almost parallel. Where corners overlap sideways, by a length l
   * less than the depth d, the depth counts as l^2 / d.
   *
   * Slip is measured from material anchors on both edges, so that a point at
   * rest cannot creep; a new pair takes over slip, failure and set from the
   * pair between the same blocks that shares a vertex with it.
   *
   * Pairs go through SIMD lanes together: of those that have no history it is
   * seen first whether their edges overlap, the others are brought to the
   * present in packs. What is rare, pairs that begin and end, is done one by
   * one.
   *
   * A pair across two ranks is computed by both from the same numbers; each
   * then counts half of its energy. Where a block is divided, the pair that a
   * new one takes over from may be a copy of another rank's.
   */
  class BlockContacts : public ForceOperator<2>
  {
  public:
    /**
     * Keeps references to @p node_map and @p joints; collective. Throws an
     * InputError about materials that no set for new contacts covers.
     */
    BlockContacts(const NodeMap<2> &node_map, const MatchedJoints &joints,
                  const ContactModel &model);

    const char *kind() const override
    {
      return "contacts";
    }

    void prepare(State<2> &state) const override;

    /**
     * Takes the present positions. When due, hands over joints that slipped or
     * opened too far, and searches pairs if edges may have approached by more
     * than the skin. Throws a RunError about deep overlap and runaway
     * velocities.
     */
    void update(const StepContext &step, State<2> &state) override;

    /** Springs wherever blocks may touch, at matched joints too. */
    void add_stiffness_bound(
        const State<2> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<2>> &stiffness) const override;
    void add_damping_bound(const std::vector<double> &masses, double impedance,
                           DampingBound &bound) const override;
    /** Other laws of the same joint sets, with the same stiffness, and other
        materials of the cell groups: what begins from now on follows their
        sets. */
    void set_properties(const std::vector<JointSetParameters> &sets,
                        const std::vector<unsigned int> &material_of_group)
    {
      contact_laws.set_properties(sets, material_of_group);
    }
    const ContactLaws &laws() const
    {
      return contact_laws;
    }

    /** Sets what dashpots need, without which there are none. */
    void set_blocks(const DashpotBlocks &blocks)
    {
      all_dashpots.set_blocks(blocks);
      bound_search = -1;
    }
    /** The next update() searches: blocks were removed. Collective. */
    void search_anew(ContactState &contacts)
    {
      contacts.next_check = 0;
      search_is_due       = true;
    }

    /** Adds the forces at the positions of update() to owned nodes. */
    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;

    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override;

    const ContactWork &work() const
    {
      return spent;
    }
    const ContactEdges &contact_edges() const
    {
      return edges;
    }
    /** Pairs at the positions of update(). */
    const NearPairs &near_pairs() const
    {
      return near;
    }
    /** Whether near_pairs() are those of @p contacts. */
    bool is_bound(const ContactState &contacts) const
    {
      return bound_search == contacts.n_searches;
    }
    /** Those that acted when forces were last added. */
    const ContactDashpots &dashpots() const
    {
      return all_dashpots;
    }

  private:
    /** Whether blocks move faster against each other than was foreseen when
        the next check was put off. Collective. */
    bool moves_faster(const State<2> &state, double dt) const;
    void check(State<2> &state, double dt);
    /** Prepares for the pairs at hand. */
    void bind(const ContactState &contacts);
    /** What a step loses [J]. */
    struct Losses
    {
      double friction = 0., fracture = 0., crushing = 0.;
      double contact = 0.; /**< loss with contact areas and contacts that end */
    };
    /** What add_forces() does with @p lanes pairs at once. */
    template <int lanes>
    void add_forces_in_lanes(ContactState &contacts, double viscous_beta,
                             bool damps, Losses &losses);
    /** add_forces_in_lanes() for the pairs @p active under one law. */
    template <int lanes, typename Law>
    void add_forces_under(const Law &law,
                          const std::vector<unsigned int> &active,
                          ContactState &contacts, double viscous_beta,
                          bool damps, Losses &losses);
    /** Activates pairs that have come into contact; sets active_pairs. */
    template <int lanes>
    void begin_contacts(ContactState &contacts);
    /** Activates those of @p n idle pairs, from @p first on, that have come
       into contact. */
    template <int lanes>
    void look_at_idle(const unsigned int *first, unsigned int n,
                      ContactState &contacts);
    /** Activates a pair that overlaps by @p geometry if it is in contact;
        returns true if so. */
    bool begin_contact(ContactState &contacts, unsigned int pair,
                       const NearPairs::Geometry &geometry);
    /**
     * Set, history, slip (as offset) and deepest opening [m] of the neighbour
     * that a new pair goes on from; false if there is none.
     */
    bool find_parent(const ContactState &contacts, unsigned int pair,
                     unsigned int &set, ContactPoint &inherited,
                     double &deepest) const;
    void note_depth(unsigned int pair, double depth);
    [[noreturn]] void refuse_depth(const State<2> &state, double ratio) const;
    [[noreturn]] void refuse_speed(const State<2> &state, double speed,
                                   double dt) const;

    const NodeMap<2> &node_map;
    const MatchedJoints &joints;
    const NodeExchange &exchange;
    ContactEdges edges;
    const ContactParameters parameters;
    const Thickness thickness;
    NearPairs near;
    ContactLaws contact_laws;
    ContactDashpots all_dashpots;
    PairSearch search;

    std::uint64_t bound_search = -1; /**< search whose pairs are at hand */
    const unsigned int n_lanes;
    AlignedArray<dealii::Tensor<1, 2>> compact_force,
        compact_viscous; /**< [N] */
    // Pairs of the present step.
    std::vector<unsigned int> active_pairs, idle_pairs, new_contacts;
    std::vector<std::vector<unsigned int>> pairs_of_set; /**< active ones */

    bool search_is_due        = false;
    double deepest_ratio      = 0.;
    unsigned int deepest_pair = 0;
    ContactWork spent;
  };
} // namespace quoin

#endif
