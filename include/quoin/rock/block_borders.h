// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_block_borders_h
#define quoin_rock_block_borders_h

#include <quoin/rock/rock_box.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * The plane polygons between the blocks of a box of rock. Convex pieces of a
   * block are put together: what is left are borders of blocks, without the
   * lines and points that only belong to the cuts by bodies.
   */
  class BlockBorders
  {
  public:
    using Loop = std::vector<unsigned int>; /**< vertices in order */

    struct Border
    {
      std::vector<Loop> loops; /**< the outer one first, then holes */
      std::string name;        /**< physical surface; empty: it has none */
      std::array<unsigned int, 2> blocks; /**< none: outside, or a void */
    };

    /** Borders have the names of the sides, joint sets and bodies of @p rock.
     */
    BlockBorders(const RockBoxParameters &rock, const RockBox &box);

    const std::vector<dealii::Point<3>> &vertices() const
    {
      return points;
    }
    /** Size of the elements at a vertex [m]. */
    double size(const unsigned int vertex) const
    {
      return sizes[vertex];
    }
    const std::vector<Border> &borders() const
    {
      return all;
    }
    unsigned int n_blocks() const
    {
      return groups.size();
    }
    /** Physical volume of a block. */
    const std::string &group(const unsigned int block) const
    {
      return groups[block];
    }
    /** Lists the borders of each closed surface of each block, the outer
        surface of a block first. */
    std::vector<std::vector<std::vector<unsigned int>>> shells() const;
    double shortest_edge() const; /**< [m] */

  private:
    using Edge = std::pair<unsigned int, unsigned int>;

    std::string name_of(const RockBoxParameters &rock, const RockBox &box,
                        unsigned int face) const;
    /** Borders that meet at each edge. */
    std::map<Edge, std::vector<unsigned int>> borders_at_edges() const;
    /** Unites borders in one plane between the same blocks. */
    void unite_borders(const std::vector<int> &surface);
    /** One border of several; false if its edge would not be a simple one. */
    bool unite(const std::vector<unsigned int> &members,
               const std::map<Edge, std::vector<unsigned int>> &at_edge,
               Border &result) const;
    std::vector<std::vector<unsigned int>>
    closed_surfaces(const std::vector<unsigned int> &borders) const;
    /** Takes out vertices in the middle of straight edges. */
    void straighten();
    dealii::Tensor<1, 3> area(const Loop &loop) const;

    std::vector<dealii::Point<3>> points;
    std::vector<double> sizes;
    std::vector<Border> all;
    std::vector<std::string> groups;
  };
} // namespace quoin

#endif
