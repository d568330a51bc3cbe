// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_contact_state_h
#define quoin_contact_geometry_contact_state_h

#include <quoin/joints/joint_history.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace quoin
{
  /** One end of the overlap of two edges in contact; as JointHistory. Its rows
      of four numbers go to and from vectors: what changes in each step, what
      changes often, what flow changes, and what a law adds. */
  struct alignas(32) ContactPoint
  {
    double normal_traction = 0.; /**< [Pa] */
    double shear_traction  = 0.; /**< [Pa] */
    double area            = 0.; /**< area of the last step [m^2] */
    /** Opening of the last step; infinite: not computed yet [m]. */
    double opening = std::numeric_limits<double>::infinity();

    double plastic_slip    = 0.; /**< [m] */
    double plastic_opening = 0.; /**< [m] */
    /** Direction of the normal in the last step, from -1, the normal of the
       lower edge, to 1, that of the upper one. */
    double lean = 0.;
    /** Reduction of the overlap of a contact from corner to corner in the last
        step [m]. */
    double sideways = 0.;

    double slip_offset = 0.; /**< slip at the anchors [m] */
    /** Positions on the edges, 0 to 1, from which slip is measured. */
    double anchor_lower = 0., anchor_upper = 0.;
    JointState state = JointState::slipped;

    /** Internal variables of its law; there is room for most_internal. */
    static constexpr unsigned int most_internal = 4;
    double internal[most_internal]{};
  };

  /** Two edges of blocks that touch or may soon do so. */
  struct ContactPair
  {
    unsigned int lower     = 0; /**< edges, see ContactEdges */
    unsigned int upper     = 0;
    unsigned int set       = 0; /**< joint set whose law the pair follows */
    std::uint8_t active    = 0; /**< whether the points are active */
    std::uint8_t was_joint = 0; /**< whether it was a matched joint */
    std::uint8_t was_open  = 0; /**< whether the edges were seen apart */
    /** Slip of the matched joint that became this pair [m], and what of it is
        still allowed for in the overlap. */
    double shift       = 0.;
    double shift_start = 0.; /**< slip at that time [m] */
    ContactPoint points[2];

    /** Both edges, ascending; so pairs are sorted. */
    std::array<unsigned int, 2> edges() const
    {
      return { std::min(lower, upper), std::max(lower, upper) };
    }
  };

  /** What a step has to know of a pair before it takes any notice. */
  enum class PairMark : std::uint8_t
  {
    unseen  = 0, /**< not active, and not seen apart */
    open    = 1, /**< not active, and seen apart */
    active  = 2,
    distant = 3, /**< unseen, and will not touch for the time being */
    apart   = 7, /**< open, and will not touch for the time being */
    shifted = 10 /**< active, and was a matched joint or has a shift */
  };

  /** Contacts that come and go; empty if displacements are small. */
  struct ContactState
  {
    static constexpr const char *slice_name = "contacts";

    AlignedArray<ContactPair> pairs; /**< ascending in their edges */
    /** Copies of each pair's flags active and was_open, which a step reads of
        all pairs. They are not archived; empty: to be made again. */
    AlignedArray<PairMark> marks;
    /** How far nodes have moved against each other, at most, when it was last
        looked which pairs will not touch for the time being [m]; it is looked
        again when they have moved by more than marked_for since, from the
        positions marked_from of MovingEdges. Not archived. */
    double marked_motion = 0., marked_for = 0.;
    AlignedArray<dealii::Tensor<1, 2>> marked_from;
    unsigned int marked_steps = 0; /**< since then */
    /** Such a motion up to which each pair does not touch [m]. */
    AlignedArray<double> clear_until;

    /** Flag of each interface of joints. */
    AlignedArray<std::uint8_t> handed_over;

    /** Positions of the boundary nodes when pairs were last searched [m]. */
    AlignedArray<dealii::Tensor<1, 2>> search_positions;
    static constexpr std::uint64_t never = -1;
    std::uint64_t next_check = 0; /**< step of the next check of motions */
    /** What nodes may move against each other in a step until then [m]. */
    double foreseen          = 0.;
    std::uint64_t n_searches = 0;
    double skin              = 0.; /**< skin of the last search [m] */
    std::uint64_t searched   = 0;  /**< step of the last search */
    /** Step from which on there are more searches to gain than to lose. */
    std::uint64_t renewal = 0;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.between(pairs);
      visitor.same(handed_over);
      visitor.own(search_positions);
      visitor.same(next_check, foreseen, n_searches, skin, searched, renewal);
    }
  };
} // namespace quoin

#endif
