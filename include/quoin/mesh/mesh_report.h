// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_mesh_report_h
#define quoin_mesh_mesh_report_h

#include <quoin/mesh/block_mesh.h>

#include <boost/serialization/map.hpp>

#include <map>
#include <string>

namespace quoin
{
  /** Sizes and quality of a mesh of blocks. */
  struct MeshReport
  {
    unsigned int n_blocks      = 0;
    unsigned int n_cells       = 0;
    unsigned int n_nodes       = 0;
    unsigned int n_joint_faces = 0;
    bool quadratic             = false; /**< nodes on the middle of edges */

    /** Length of joints by curve name; "" stands for joints without one [m]. */
    std::map<std::string, double> joint_length;
    double total_joint_length = 0.; /**< [m] */

    double shortest_edge  = 0.; /**< of a triangle, linear or quadratic [m] */
    double longest_edge   = 0.; /**< [m] */
    double smallest_angle = 0.; /**< of any cell [degree] */

    unsigned int n_joint_ends = 0; /**< ends inside a block */
    /** Joint faces with both ends unsplit: they can never open or slip. */
    unsigned int n_tied_joint_faces = 0;
    unsigned int n_reoriented_cells = 0; /**< clockwise in the file */

    /**
     * Length along which outer edges lie on each other without coinciding:
     * non-matching meshes on the two sides of a contact, which no joint face
     * joins [m].
     */
    double unmatched_length = 0.;
    dealii::Point<2> unmatched_position; /**< where the first of them is [m] */

    /**
     * Whether blocks overlap: outer edges cross, by more than those of two
     * meshes along one curve do, or a block lies within another.
     */
    bool overlaps = false;
    dealii::Point<2> overlap_position; /**< where, first [m] */

    dealii::Point<2> lower_left;  /**< of the bounding box [m] */
    dealii::Point<2> upper_right; /**< of the bounding box [m] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &n_blocks &n_cells &n_nodes &n_joint_faces &quadratic
          &joint_length &total_joint_length &shortest_edge &longest_edge
              &smallest_angle &n_joint_ends &n_tied_joint_faces
                  &n_reoriented_cells &unmatched_length &unmatched_position
                      &overlaps &overlap_position &lower_left &upper_right;
    }

    /** Lines of text without a final newline. */
    std::string to_text() const;
    /** What is most likely a mistake in the mesh, a sentence each. */
    std::vector<std::string> warnings() const;
  };

  MeshReport make_mesh_report(const BlockMesh<2> &mesh);
} // namespace quoin

#endif
