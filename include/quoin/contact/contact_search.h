// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_contact_search_h
#define quoin_contact_contact_search_h

#include <quoin/contact/contact_state.h>
#include <quoin/contact/contact_edges.h>

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

  /**
   * All pairs of edges of @p ends with a motion_to_touch() of @p skin or less
   * [m] of which this rank has one at least, given by their positions in
   * @p ends, ascending, the smaller first: found by the boxes of edges that
   * follow each other, in an R-tree. Edges that share a node are no pair.
   */
  std::vector<std::array<unsigned int, 2>>
  near_edges(const ContactEdges &edges, const std::vector<EdgeEnds> &ends,
             double skin);

  /**
   * By how much nodes have to move against each other before two edges may
   * touch that are @p apart where they do [m]: what brings them there, their
   * distance, which is 0 if they cross, and what turns them until they face
   * each other by least_contact_cosine, whichever is more.
   */
  double motion_to_touch(const EdgeEnds &a, const EdgeEnds &b, double apart);
} // namespace quoin

#endif
