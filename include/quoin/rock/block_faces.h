// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_block_faces_h
#define quoin_rock_block_faces_h

#include <quoin/base/rtree.h>
#include <quoin/rock/joint_network.h>

#include <utility>
#include <vector>

namespace quoin
{
  /**
   * The faces between the edges of a network: closed polygons, perhaps with
   * holes. Half-edge 2 e runs along edge e, 2 e + 1 against it; each has its
   * face on the left.
   */
  class BlockFaces
  {
  public:
    explicit BlockFaces(const JointNetwork &network);

    using Loop = std::vector<unsigned int>; /**< half-edges, end to end */

    struct Face
    {
      Loop outer;              /**< counter-clockwise */
      std::vector<Loop> inner; /**< clockwise; may touch others in a point */
      double area;             /**< [m^2] */
      double perimeter;        /**< inner loops included [m] */

      /** Twice its area by its perimeter: the width of a strip [m]. */
      double width() const
      {
        return 2. * area / perimeter;
      }
    };

    const std::vector<Face> &faces() const
    {
      return all_faces;
    }

    static constexpr unsigned int outside = -1;

    /** Face on the left of a half-edge, or outside. */
    unsigned int face(const unsigned int half_edge) const
    {
      return face_of[half_edge];
    }

    /**
     * Edges with the same loop on both sides: dead ends, and bridges between
     * parts that would else not hang together.
     */
    const std::vector<unsigned int> &dead_ends() const
    {
      return dead;
    }
    const std::vector<unsigned int> &bridges() const
    {
      return all_bridges;
    }

    /** Connected parts of the network. */
    unsigned int n_parts() const
    {
      return parts;
    }

    Polygon polygon(const Loop &loop) const;

    /** The smallest face around @p point, or outside. */
    unsigned int find(const dealii::Point<2> &point) const;

    /** A point inside of face @p f, beside the middle of its longest edge. */
    dealii::Point<2> inner_point(unsigned int f) const;

    unsigned int start(const unsigned int half_edge) const
    {
      const auto &edge = network.edges()[half_edge / 2];
      return half_edge % 2 == 0 ? edge.from : edge.to;
    }

  private:
    void trace_loops();
    void find_dead_ends();
    void assign_holes();
    /** Parts of @p loop that pass no vertex twice. */
    std::vector<Loop> split(const Loop &loop) const;
    /** The face around @p point among those for which @p is_wanted(face) holds.
     */
    template <typename IsWanted>
    unsigned int find(const dealii::Point<2> &point,
                      const IsWanted &is_wanted) const;

    const JointNetwork &network;
    std::vector<Loop> loops;
    /** Loop and face of each half-edge. */
    std::vector<unsigned int> loop_of, face_of;
    std::vector<unsigned int> dead, all_bridges;
    std::vector<Face> all_faces;
    std::vector<Polygon> outer_polygons; /**< outer polygons of the faces */
    using TreePoint = boost::geometry::model::d2::point_xy<double>;
    using Box       = boost::geometry::model::box<TreePoint>;
    boost::geometry::index::rtree<std::pair<Box, unsigned int>,
                                  boost::geometry::index::quadratic<16>>
        tree;
    unsigned int parts = 0;
  };
} // namespace quoin

#endif
