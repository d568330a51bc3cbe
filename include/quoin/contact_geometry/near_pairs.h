// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_near_pairs_h
#define quoin_contact_geometry_near_pairs_h

#include <quoin/contact_geometry/moving_edges.h>
#include <quoin/contact_geometry/pair_copies.h>

#include <array>
#include <vector>

namespace quoin
{
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

  /** The forces of a pair on the ends of the lower edge and then of the upper
      one as they act on the nodes, without viscous ones. They have the
      resultant of Contact::force; their moment is also that by which the
      contact's area and normals go with the rotation of the edges. */
  struct ContactEndForces
  {
    std::array<dealii::Tensor<1, 2>, 4> place; /**< [m] */
    std::array<dealii::Tensor<1, 2>, 4> force; /**< [N] */
    double share; /**< of the contact that this rank counts */
  };

  /**
   * The pairs at hand, ContactState::pairs, and beside them the copies of other
   * ranks' (PairCopies): entries are pairs and then copies. bind() prepares for
   * them whenever they change; nothing here is part of the state.
   */
  class NearPairs
  {
  public:
    using Geometry = PairGeometry<1>;
    using Edges    = std::array<std::uint32_t, 2>;

    /** What stays the same of a pair. */
    struct alignas(16) Weight
    {
      double share; /**< of the energy that we count */
      double depth; /**< that is too deep [m] */
    };

    /** Keeps references to @p nodes and @p edges. */
    NearPairs(const NodeMap<2> &nodes, ContactEdges &edges,
              const ContactParameters &parameters, const Thickness &thickness);

    /** Prepares for the pairs of @p contacts. Collective. */
    void bind(const ContactState &contacts);
    /** Copies pairs of other ranks as they are now; see PairCopies. */
    void update_copies(const ContactState &contacts)
    {
      copies.update(contacts.pairs);
    }

    MovingEdges &moving_edges()
    {
      return moving;
    }
    const MovingEdges &moving_edges() const
    {
      return moving;
    }

    /** Moving edges, lower and upper, of an entry; after the last one there
        are zeros for all lanes. */
    const Edges &edges_of(const unsigned int i) const
    {
      return pair_edges[i];
    }
    /** Weight of each pair. */
    const AlignedArray<Weight> &weights() const
    {
      return pair_weights;
    }
    /** What entry @p i stands for. */
    const ContactPair &pair_or_copy(const ContactState &contacts,
                                    const unsigned int i) const
    {
      return i < contacts.pairs.size()
                 ? contacts.pairs[i]
                 : copies.pairs()[i - contacts.pairs.size()];
    }
    /** Share of the energy of @p pair that this rank counts. */
    float share(const ContactPair &pair) const;
    /** Some entries, ascending in their edges. */
    struct Entries
    {
      const unsigned int *first, *last;

      const unsigned int *begin() const
      {
        return first;
      }
      const unsigned int *end() const
      {
        return last;
      }
    };
    /** The entries of pairs that moving edge @p e is in. */
    Entries entries_of(const unsigned int e) const
    {
      return { edge_pairs.data() + edge_pairs_begin[e],
               edge_pairs.data() + edge_pairs_begin[e + 1] };
    }

    /** Finds the geometry of @p pair, entry @p i; false: its edges do not
        overlap. */
    bool geometry(const ContactPair &pair, unsigned int i,
                  Geometry &result) const;
    /** Slip of a point of entry @p i [m]. */
    double slip(const ContactPoint &point, unsigned int i,
                const double (&normal)[2]) const;
    /** What of the shift of entry @p i, @p pair, is left after the slip since
        [m]. */
    double shift_left(const ContactPair &pair, unsigned int i,
                      const Geometry &g) const;

    /** The contact of pair @p pair where its edges are; false if it is inactive
        or they do not overlap. */
    bool contact(const ContactState &contacts, unsigned int pair,
                 Contact &result) const;
    /** Forces of @p pair there; false as contact(). */
    bool end_forces(const ContactState &contacts, unsigned int pair,
                    ContactEndForces &result) const;
    /** The @p force [N] on the lower edge of a pair at its place @p lower, 0 to
        1, and against it on the upper one at @p upper, spread to their ends. */
    ContactEndForces spread(unsigned int pair, double lower, double upper,
                            const double (&force)[2]) const;

  private:
    const ContactEdges &edges;
    const double deepest; /**< ContactParameters::deepest */
    MovingEdges moving;
    PairCopies copies;
    std::vector<Edges> pair_edges;
    AlignedArray<Weight> pair_weights;
    std::vector<unsigned int> edge_pairs_begin, edge_pairs;
  };

  /** Points that press on each other, this rank's share. */
  double n_touching(const NearPairs &near, const ContactState &contacts);
} // namespace quoin

#endif
