// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_mesh_report_h
#define quoin_mesh_mesh_report_h

#include <quoin/mesh/slender_blocks.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Sizes and quality of a mesh of blocks. Sizes of faces are lengths [m] in
   * two dimensions and areas [m^2] in three; positions of plane meshes have
   * z = 0.
   */
  struct MeshReport
  {
    unsigned int dimension     = 2;
    unsigned int n_blocks      = 0;
    unsigned int n_cells       = 0;
    unsigned int n_nodes       = 0;
    unsigned int n_joint_faces = 0;
    bool quadratic             = false; /**< nodes on the middle of edges */
    bool mixed                 = false; /**< see BlockMesh::mixed */

    /** Length [m] or area [m^2] of joints by the name of their curve or
        surface; "" stands for joints without one. */
    std::map<std::string, double> joint_size;
    double total_joint_size = 0.;

    /** Shortest edge of a cell, linear or quadratic [m]. */
    double shortest_edge = 0.;
    double longest_edge  = 0.; /**< [m] */
    /** Median length of the edges of cells [m]. */
    double median_edge = 0.;
    /** Least height of a corner of a cell above the opposite side [m], and the
        middle of that cell. */
    double smallest_height = 0.;
    dealii::Point<3> smallest_position;
    /** Between edges of a triangle or faces of a tetrahedron [degree], and the
        middle of the tetrahedron that has it. */
    double smallest_angle = 0.;
    dealii::Point<3> angle_position;

    unsigned int n_joint_ends = 0; /**< unsplit vertices inside a block */
    /** Joint faces with all vertices unsplit: they can never open or slip. */
    unsigned int n_tied_joint_faces = 0;
    /** Number of cells with the opposite orientation in the file. */
    unsigned int n_reoriented_cells = 0;
    double largest_shift            = 0.; /**< see BlockMesh [m] */

    /**
     * Where outer faces lie on each other without coinciding: non-matching
     * meshes on the two sides of a contact, which no joint face joins.
     */
    double unmatched_size = 0.;
    /** Whether these faces are in contact, in large displacements. */
    bool unmatched_touch = false;
    /** Position of the first unmatched node [m]. */
    dealii::Point<3> unmatched_position;

    /**
     * Whether blocks overlap: outer faces cross, by more than those of two
     * meshes along one curve or surface do, or a block lies within another.
     */
    bool overlaps = false;
    /** By how much they do, where it is most; infinite: a block lies within
        another [m]. */
    double overlap_depth = 0.;
    dealii::Point<3> overlap_position; /**< where that is [m] */

    /** Blocks with few cells across their thickness. */
    std::vector<SlenderBlock> slender;

    std::array<dealii::Point<3>, 2> box{}; /**< lower and upper corner [m] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &dimension &n_blocks &n_cells &n_nodes &n_joint_faces &quadratic
          &mixed &joint_size &total_joint_size &shortest_edge &longest_edge
              &median_edge &smallest_height &smallest_position &smallest_angle
                  &angle_position &n_joint_ends &n_tied_joint_faces
                      &n_reoriented_cells &largest_shift &unmatched_size
                          &unmatched_touch &unmatched_position &overlaps
                              &overlap_depth &overlap_position &slender &box;
    }

    /** Lines of text without a final newline. */
    std::string to_text() const;
    /** Where blocks overlap and by how much, and what to do about it. */
    std::string overlap_text() const;
    std::string overlap_cure() const;
    /** Sentences on likely mistakes in the mesh. */
    std::vector<std::string> warnings() const;
    /** A sentence on a cell so much lower than others that it alone makes the
        steps of deformable blocks short; empty: there is none. */
    std::string sliver_text() const;
    /** A place in the words of messages, without unit. */
    std::string position(const dealii::Point<3> &p) const;
  };

  template <int dim>
  MeshReport make_mesh_report(const BlockMesh<dim> &mesh);
} // namespace quoin

#endif
