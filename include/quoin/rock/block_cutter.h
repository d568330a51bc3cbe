// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_block_cutter_h
#define quoin_rock_block_cutter_h

#include <deal.II/base/point.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace quoin
{
  /** The plane normal * x = offset, of a unit normal [-] and offset [m]. */
  struct JointPlane
  {
    dealii::Tensor<1, 3> normal;
    double offset = 0.;

    double distance(const dealii::Point<3> &p) const
    {
      return normal * (p - dealii::Point<3>()) - offset;
    }
  };

  /**
   * A box cut into convex polyhedra by planes, one block at a time. Neighbours
   * share vertices, edges and faces also where a plane cuts only one of them:
   * an edge that is cut is cut in all faces that have it, and a face in both of
   * its blocks. Volumes thus always sum up to that of the box.
   */
  class BlockCutter
  {
  public:
    static constexpr unsigned int none = -1;

    /** Vertices in order around the face, and what is on both sides. */
    struct Face
    {
      std::vector<unsigned int> loop; /**< counter-clockwise from outside of
                                         @p inner */
      unsigned int surface;           /**< 0..5: side of the box, see below */
      unsigned int inner;             /**< block */
      unsigned int outer;             /**< block, or none: the outside */
    };

    /** What came of the cut of one block. */
    enum Result
    {
      missed, /**< the plane does not pass through the block */
      cut,    /**< there are two blocks, the last one is new */
      refused /**< a part would be too small: the block stays whole */
    };

    /**
     * A box from @p low to @p high [m] whose sides are the surfaces 0 to 5: x,
     * y and z, first low, then high. Cuts that make an edge shorter than
     * @p shortest_edge [m] or a block smaller than @p smallest_block [m^3] are
     * refused.
     */
    BlockCutter(const dealii::Point<3> &low, const dealii::Point<3> &high,
                double shortest_edge, double smallest_block);

    /** Refuses no cuts from here on but those that leave nothing on a side. */
    void refuse_none()
    {
      shortest_edge = smallest_block = 0.;
    }

    /** What cut_block() would return. */
    Result try_cut(unsigned int block, const JointPlane &plane) const;
    /** Cuts @p block by @p plane; the new face is part of @p surface. */
    Result cut_block(unsigned int block, const JointPlane &plane,
                     unsigned int surface);

    unsigned int n_blocks() const
    {
      return blocks.size();
    }
    const std::vector<Face> &faces() const
    {
      return all_faces;
    }
    const std::set<unsigned int> &faces_of(const unsigned int block) const
    {
      return blocks[block];
    }
    const std::vector<dealii::Point<3>> &vertices() const
    {
      return points;
    }
    double volume(unsigned int block) const; /**< [m^3] */
    /** Normal of a face times its area [m^2]. */
    dealii::Tensor<1, 3> area(unsigned int face) const;
    /** Area of @p plane within @p block [m^2]. */
    double section(unsigned int block, const JointPlane &plane) const;

  private:
    using Edge = std::pair<unsigned int, unsigned int>;

    /** Corners of a face, in its order [m]. */
    std::vector<dealii::Point<3>> corners(unsigned int face) const;
    /** Volumes below and above @p plane of a block [m^3]. */
    std::pair<double, double> volumes(unsigned int block,
                                      const JointPlane &plane) const;
    bool may_cut(unsigned int block, const JointPlane &plane) const;
    int side(unsigned int vertex, const JointPlane &plane) const;
    void cut_edges(unsigned int block, const JointPlane &plane);
    void cut_faces(unsigned int block, const JointPlane &plane);
    void split_face(unsigned int face, std::size_t from, std::size_t to);
    std::vector<unsigned int>
    cut_loop(unsigned int block, const std::set<unsigned int> &above) const;
    void enter_edges(unsigned int face, bool there);

    double shortest_edge, smallest_block, tolerance;
    std::vector<dealii::Point<3>> points;
    std::vector<Face> all_faces;
    std::vector<std::set<unsigned int>> blocks;      /**< faces of each */
    std::map<Edge, std::set<unsigned int>> faces_at; /**< edge */
  };
} // namespace quoin

#endif
