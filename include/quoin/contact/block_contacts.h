// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_block_contacts_h
#define quoin_contact_block_contacts_h

#include <quoin/base/lanes.h>
#include <quoin/contact/contact_state.h>
#include <quoin/operators/force_operator.h>
#include <quoin/contact/contact_edges.h>
#include <quoin/contact/contact_parameters.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/contact/pair_copies.h>
#include <quoin/joint_elements/pair_dashpots.h>
#include <quoin/joint_laws/joint_parameters.h>

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace quoin
{
  struct EdgeEnds;
  template <int lanes>
  struct EdgeLanes;
  template <int lanes>
  struct PairLanes;
  template <int lanes>
  struct PairGeometry;
  template <int lanes>
  struct EndForceLanes;

  /** What contacts are made of, beside the mesh. */
  struct ContactModel
  {
    ContactParameters parameters;
    std::vector<JointSetParameters> sets;
    std::vector<std::string> materials;
    std::vector<unsigned int> material_of_group;
    Thickness thickness; /**< of each cell group */
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
    /** As MatchedJoints::sets_on_blocks(), with sets that may act once the
        block touches others: those of its joints and of new contacts of its
        materials with any that are in the mesh. Collective. */
    std::vector<std::uint8_t> sets_on_blocks() const;

    /** Other laws of the same joint sets, with the same stiffness. */
    void set_laws(const std::vector<JointSetParameters> &sets);
    /** Other materials of the cell groups: what begins from now on follows
        their sets. */
    void set_materials(const std::vector<unsigned int> &of_group)
    {
      material_of_group = of_group;
    }

    /** Pairs that go through the lanes together, 1, 4 or 8: for tests, which
        take pairs one by one for reference. */
    void set_lanes(const unsigned int n)
    {
      n_lanes = n;
    }

    /** Sets what dashpots need, without which there are none. */
    void set_blocks(const DashpotBlocks &blocks)
    {
      dashpots.set_blocks(blocks);
      bound_search = -1;
    }
    /** Whether a set has dashpots that act. */
    bool has_dashpots() const;

    /** The next update() searches: blocks were removed. Collective. */
    void search_anew(ContactState &contacts)
    {
      contacts.next_check = 0;
      search_is_due       = true;
    }

    /** Adds the forces at the positions of update() to owned nodes. */
    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;

    double stored_energy(const State<2> &state) const;
    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override
    {
      energies.joint += stored_energy(state);
    }

    /** Points that press on each other, this rank's share. */
    double n_touching(const ContactState &contacts) const;

    /** Pairs looked at so far, by this rank and process. */
    std::uint64_t n_updates() const
    {
      return updates;
    }
    /** Wall time of this rank's searches so far [s]. */
    double search_seconds() const
    {
      return seconds;
    }

    const ContactEdges &contact_edges() const
    {
      return edges;
    }
    /** Local nodes of ContactState::search_positions. */
    const std::vector<unsigned int> &watched_nodes() const
    {
      return boundary_nodes;
    }

    /** One contact as it is written to files and tables. */
    struct Contact
    {
      /** Vectors x, y at both ends of the overlap. */
      using Ends = std::array<dealii::Tensor<1, 2>, 2>;

      unsigned int set;
      Ends lower, upper;                   /**< places on both edges [m] */
      Ends reference;                      /**< of lower [m] */
      std::array<double, 2> opening, slip; /**< [m] */
      Ends force;   /**< on the lower edge, without viscous ones [N] */
      double share; /**< of the contact that this rank counts */
    };
    /** The contact of pair @p pair at the positions of update(); false if it is
        inactive or the edges do not overlap. */
    bool contact(const ContactState &contacts, unsigned int pair,
                 Contact &result) const;
    /** The forces of a pair on the ends of the lower edge and then of the upper
        one as they act on the nodes, without viscous ones. They have the
        resultant of Contact::force; their moment is also that by which the
        contact's area and normals go with the rotation of the edges. */
    struct EndForces
    {
      std::array<dealii::Tensor<1, 2>, 4> place; /**< [m] */
      std::array<dealii::Tensor<1, 2>, 4> force; /**< [N] */
      double share; /**< of the contact that this rank counts */
    };
    /** Forces of @p pair at the positions of update(); returns false if it is
        inactive or the edges do not overlap. */
    bool end_forces(const ContactState &contacts, unsigned int pair,
                    EndForces &result) const;
    /** Whether this rank writes the pair. */
    bool is_own(const ContactState &contacts, unsigned int pair) const;

  private:
    /** An edge that takes part, where it is now; see EdgeLanes. */
    struct alignas(64) Edge
    {
      double x, y, tangent[2];
      double length, inverse_length, thickness, reference_ratio;
    };
    /** What it is joined to. */
    struct alignas(32) EdgeLinks
    {
      double corner[2];            /**< see ContactEdge */
      std::uint32_t nodes[2];      /**< compact */
      std::uint32_t neighbours[2]; /**< edges before and after, or itself */
    };
    /** What stays the same of a pair. */
    struct alignas(16) PairWeight
    {
      double share; /**< of the energy that we count */
      double depth; /**< that is too deep [m] */
    };
    using Geometry                           = PairGeometry<1>;
    static constexpr unsigned int most_lanes = 8;

    /** Calls @p use with the law of a set, of its own type. */
    template <typename Use>
    void with_law(const unsigned int set, const Use &use) const
    {
      // The usual law in line: a visit calls through a table.
      if (const auto *coulomb = std::get_if<CoulombLaw>(&laws[set]))
        use(*coulomb);
      else
        std::visit(use, laws[set]);
    }
    void find_set_of_materials(const std::vector<JointSetParameters> &sets);
    void check(State<2> &state, double dt);
    /** Marks interfaces with joints of this rank that are to become general
        contacts; whether there are any. */
    bool find_handovers(State<2> &state) const;
    /** Makes general contacts of the joints of marked interfaces. Collective.
     */
    void hand_over(State<2> &state) const;
    /** @p rate: by what edges may have approached in a step since the last
        search [m]. */
    void search(State<2> &state, double rate);
    /** The pairs within the skin and by how much contacts are @p apart [m], by
        their places in @p ends; sets the skin. */
    std::vector<std::array<unsigned int, 2>>
    find_pairs(const std::vector<EdgeEnds> &ends, double apart, double rate,
               ContactState &contacts) const;
    /** Step after which another search may be cheaper; largest: none. */
    std::uint64_t renewal(const ContactState &contacts, double rate) const;
    /** Distance within which a search looks for pairs [m]. */
    double search_distance(const ContactState &contacts) const;
    /** The skin within search_distance() [m] for which searches and pairs that
       stay apart cost least together. @p sides: by skin, how many sides of
       pairs of this rank it takes in. */
    double cheapest_skin(std::vector<unsigned int> sides, double rate,
                         const ContactState &contacts) const;
    bool is_matched(const ContactState &contacts, unsigned int a,
                    unsigned int b) const;
    ContactPair new_pair(const EdgeEnds &a, const EdgeEnds &b) const;
    void inherit_shifts(ContactState &contacts) const;
    /** Counts slip from where the edges touch now. */
    void reanchor(ContactState &contacts) const;
    float share(const ContactPair &pair) const;
    /** Prepares for the pairs at hand. */
    void bind(const ContactState &contacts);
    void bind_edges(const ContactState &contacts);
    void bind_nodes();
    void bind_pairs(const ContactState &contacts);
    /** The pair that entry @p i of edge_pairs stands for. */
    const ContactPair &pair_or_copy(const ContactState &contacts,
                                    const unsigned int i) const
    {
      return i < contacts.pairs.size()
                 ? contacts.pairs[i]
                 : copies.pairs()[i - contacts.pairs.size()];
    }
    /** Index of @p edge into local_edges. */
    unsigned int local_edge(unsigned int edge) const;
    void gather(const State<2> &state);

    /** The edges @p e, one for each lane. */
    template <int lanes>
    void load_edges(const std::uint32_t *e, EdgeLanes<lanes> &to) const;
    /** See PairFunctions::find(); @p ea, @p eb: the edges @p a and @p b. */
    template <int lanes>
    typename Lanes<lanes>::Bits
    find_geometry(const PairLanes<lanes> &pairs, const std::uint32_t *ea,
                  const EdgeLanes<lanes> &a, const std::uint32_t *eb,
                  const EdgeLanes<lanes> &b, PairGeometry<lanes> &result) const;
    /** That of entry @p i of pair_edges, @p pair; false if its edges do not
        overlap. */
    bool geometry(const ContactPair &pair, unsigned int i,
                  Geometry &result) const;
    double slip(const ContactPoint &point, unsigned int i,
                const double (&normal)[2]) const;
    /** What of the shift of a pair is left after the slip since. */
    double shift_left(const ContactPair &pair, unsigned int i,
                      const Geometry &g) const;
    /** Velocity of places of the edges @p eb against those of @p ea. */
    template <int lanes>
    void relative_velocity(const std::uint32_t *ea, const std::uint32_t *eb,
                           const typename Lanes<lanes>::Value &lower,
                           const typename Lanes<lanes>::Value &upper,
                           typename Lanes<lanes>::Value (&rate)[2]) const;
    /** Adds forces of the lanes @p present to compact nodes. */
    template <int lanes>
    void add_to_ends(const EndForceLanes<lanes> &forces,
                     const std::uint32_t *ea, const std::uint32_t *eb,
                     unsigned int present, dealii::Tensor<1, 2> *to) const;
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
    void gather_velocities(const dealii::Tensor<1, 2> *velocity);
    void bind_dashpots(const ContactState &contacts);
    struct DashpotPoint;
    /** Notes a point that presses on its springs. */
    void note_dashpot(const DashpotPoint &point);
    /** Adds the forces of the dashpots of noted points. */
    void add_dashpot_forces(const ContactState &contacts);
    /** Adds what is in @p from to nodes of own edges, and empties that. */
    void scatter(AlignedArray<dealii::Tensor<1, 2>> &from,
                 dealii::Tensor<1, 2> *to) const;
    void make_marks(ContactState &contacts) const;
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
                       const Geometry &geometry);
    /** Whether the vertex at end @p k of a pair lies within the edges before
        and after the one that it touches. */
    bool vertex_is_inside(unsigned int pair, const Geometry &geometry,
                          unsigned int k) const;
    /**
     * Set, history, slip (as offset) and deepest opening [m] of the neighbour
     * that a new pair goes on from; false if there is none.
     */
    bool find_parent(const ContactState &contacts, unsigned int pair,
                     unsigned int &set, ContactPoint &inherited,
                     double &deepest) const;
    /** Forgets the history; returns the energy that it stored [J]. */
    double release(ContactPair &pair) const;

    void note_depth(unsigned int pair, double depth);
    [[noreturn]] void refuse_depth(const State<2> &state, double ratio) const;
    [[noreturn]] void refuse_speed(const State<2> &state, double speed,
                                   double dt) const;

    const NodeMap<2> &node_map;
    const MatchedJoints &joints;
    const NodeExchange &exchange;
    ContactEdges edges;
    PairCopies copies;
    const ContactParameters parameters;
    const Thickness thickness;
    double largest_skin;                /**< [m] */
    std::vector<JointLaw> laws;         /**< of each set */
    std::vector<JointDamping> dampings; /**< the same */
    bool dilates = false;               /**< a set does */
    std::vector<std::string> materials;
    std::vector<unsigned int> material_of_group;
    std::vector<unsigned int> set_of_materials; /**< square table */
    std::vector<unsigned int> boundary_nodes;   /**< owned, local, ascending */

    // What the pairs at hand need, made again whenever they change. Nodes of
    // own edges come first, then those of foreign edges, which may be the same:
    // forces on the latter are their rank's.
    std::uint64_t bound_search = -1;
    std::unique_ptr<NodeExchange> reach;
    std::vector<unsigned int> compact_own; /**< local node of each */
    std::vector<unsigned int> far_nodes;   /**< of foreign edges, global */
    std::vector<NodeRecord<2>> ghost_nodes;
    std::vector<dealii::Tensor<1, 2>> ghost_velocity;
    /** Local edges of pairs, then of copies, then zeros for all lanes. */
    std::vector<std::array<std::uint32_t, 2>> pair_edges;
    AlignedArray<PairWeight> pair_weights;
    unsigned int n_lanes = native_lanes;
    std::vector<double> reference_lengths;  /**< of the local edges [m] */
    std::vector<double> edge_thickness;     /**< of the cells behind them [m] */
    std::vector<unsigned int> edge_numbers; /**< of the local edges */
    /** Pairs and copies of each local edge, ascending in their edges. */
    std::vector<unsigned int> edge_pairs_begin, edge_pairs;

    AlignedArray<dealii::Tensor<1, 2>> position, compact_force,
        compact_velocity, compact_viscous;
    AlignedArray<Edge> local_edges;
    AlignedArray<EdgeLinks> edge_links;
    // Pairs of the present step.
    std::vector<unsigned int> active_pairs, idle_pairs, new_contacts;
    std::vector<std::vector<unsigned int>> pairs_of_set; /**< active ones */

    /** A point that presses, at the last forces. */
    struct DashpotPoint
    {
      unsigned int pair, k;
      double area, lower, upper; /**< see PairGeometry */
      std::array<double, 2> normal;
      std::array<double, 2> gap;       /**< opening and slip [m] */
      std::array<double, 2> stiffness; /**< per area [Pa/m] */
    };
    PairDashpots dashpots;
    std::vector<DashpotPoint> dashpot_points;

    bool search_is_due        = false;
    double deepest_ratio      = 0.;
    unsigned int deepest_pair = 0;
    std::uint64_t updates     = 0;
    double seconds            = 0.;
  };
} // namespace quoin

#endif
