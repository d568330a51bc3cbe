// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_contact_search_h
#define quoin_contact_geometry_contact_search_h

#include <quoin/contact_geometry/contact_edges.h>
#include <quoin/contact_geometry/contact_state.h>

#include <algorithm>
#include <array>
#include <vector>

namespace quoin
{
  /** Cosine of the angle between the outward normal of an edge and the inward
      one of another at which a contact between them has no area. */
  constexpr double least_contact_cosine = 0.02;

  /** Current positions of the two ends of an edge [m]. */
  struct EdgeEnds
  {
    unsigned int edge; /**< index into ContactEdges */
    double x[2], y[2];
    bool is_own = true; /**< whether it is an edge of this rank */
  };

  /**
   * The edges of this rank and those of other ranks that may be nearer to one
   * of them than @p skin [m], in ascending order; the latter, and the edges
   * before and after them, are known to @p edges from then on. Blocks marked in
   * @p left_out take no part. @p nodes: local. Collective.
   *
   * Ranks whose bounding boxes are near each other exchange boxes around some
   * consecutive edges each, then the edges that reach into those.
   */
  std::vector<EdgeEnds>
  edges_within_reach(const NodeMap<2> &node_map, ContactEdges &edges,
                     const NodeRecord<2> *nodes,
                     const AlignedArray<std::uint8_t> &left_out, double skin);

  /** Two edges that may touch before long. */
  struct NearEdges
  {
    std::array<unsigned int, 2> places; /**< in a list, the smaller first */
    /** By how much nodes have to move against each other until the edges face
        each other by least_contact_cosine [m]. */
    double to_face;
    double distance; /**< 0 if they cross [m] */

    /** By how much they have to move before edges touch that are @p apart where
        they do [m]. */
    double motion_to_touch(const double apart) const
    {
      return std::max(to_face, distance - apart);
    }
  };

  /**
   * All pairs of edges of @p ends that are nearer than @p skin [m], and need to
   * turn by no more to face each other, of which this rank has one at least,
   * ascending in their places in @p ends: found by the boxes of edges that
   * follow each other, in an R-tree. Edges that share a node are no pair.
   */
  std::vector<NearEdges> near_edges(const ContactEdges &edges,
                                    const std::vector<EdgeEnds> &ends,
                                    double skin);
} // namespace quoin

#endif
