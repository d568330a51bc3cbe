// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_block_table_h
#define quoin_mesh_block_table_h

#include <deal.II/base/point.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Data of the whole mesh on every rank: names, sizes and an entry for each
   * block, but nothing for each cell or node.
   */
  template <int dim>
  struct BlockTable
  {
    std::vector<std::string> group_names; /**< names of material ids */
    /** Names of boundary ids: curves in two dimensions; [0] is "", unnamed. */
    std::vector<std::string> face_names;

    /** Cells [first_cell[b], first_cell[b + 1]) of the whole mesh are those of
        block b. */
    std::vector<unsigned int> first_cell;
    /** Group of the first cell of each block. */
    std::vector<unsigned int> group;
    std::vector<bool> is_rigid; /**< flag of each block */
    /** Pairs of blocks with a joint between them, ascending, each once; a
        crack inside a block is a pair of that block with itself. */
    std::vector<std::array<unsigned int, 2>> joined;

    unsigned int n_vertices    = 0;
    unsigned int n_joint_faces = 0;
    bool is_quadratic          = false;      /**< cells have midside nodes */
    bool is_mixed              = false;      /**< see BlockMesh::mixed */
    std::array<dealii::Point<dim>, 2> box{}; /**< lower and upper corner [m] */

    /** Name of joints of @p face_name, an index into face_names: 'unnamed' of
        those on no named curve. */
    std::string joint_name(const unsigned int face_name) const
    {
      return face_name == 0 ? "unnamed" : face_names[face_name];
    }

    /** Diagonal of the box around all vertices [m]. */
    double diagonal() const
    {
      return box[0].distance(box[1]);
    }
    unsigned int n_blocks() const
    {
      return group.size();
    }
    unsigned int n_cells() const
    {
      return first_cell.empty() ? 0 : first_cell.back();
    }
    /** Number of the block that has cell @p cell of the whole mesh. */
    unsigned int block_of_cell(const unsigned int cell) const
    {
      return std::upper_bound(first_cell.begin(), first_cell.end(), cell)
             - first_cell.begin() - 1;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &group_names &face_names &first_cell &group &is_rigid &joined
          &n_vertices &n_joint_faces &is_quadratic &is_mixed &box;
    }
  };

  /**
   * Whether @p names has each group of @p table. Throws an InputError that
   * begins with @p where about a name that is no group.
   */
  template <int dim>
  std::vector<bool> find_groups(const BlockTable<dim> &table,
                                const std::vector<std::string> &names,
                                const std::string &where);
} // namespace quoin

#endif
