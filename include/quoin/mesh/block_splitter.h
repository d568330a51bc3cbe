// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_block_splitter_h
#define quoin_mesh_block_splitter_h

#include <quoin/mesh/block_mesh.h>
#include <quoin/mesh/mesh_data.h>

#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /** Curves or surfaces of the joints, and options of the splitting. */
  struct SplitOptions
  {
    /** Physical curves (surfaces) whose edges (faces) are joints. */
    std::vector<std::string> joints_along;
    /** Whether names of these that the mesh does not have are left out, as of
        blocks that may not touch. */
    bool may_lack_joints = false;

    /** Pairs of physical surfaces (volumes) whose common edges (faces) are
        joints. */
    std::vector<std::pair<std::string, std::string>> joints_between;

    /** Common edges (faces) of any two different groups are joints. */
    bool between_all = false;

    /** Treatment of joints that end inside a block. */
    enum JointEnds
    {
      keep,  /**< a crack whose two lips belong to the same block */
      refuse /**< an InputError */
    };
    JointEnds joint_ends = keep;

    /**
     * Faces of blocks that are apart in the mesh coincide if their vertices do
     * within this share of the shortest edge of the mesh.
     */
    double coincidence_tolerance = 1e-3;
  };

  /**
   * Cut a mesh into blocks along its joints.
   *
   * Curves and surfaces are those of two dimensions here; in three they are
   * surfaces and volumes.
   *
   * 1. Faces of cells are joints if they lie on one of the given curves or
   *    between two of the given surfaces.
   * 2. The corners of the cells are united across every face that is not a
   *    joint; the classes are the new vertices, and cells connected by such
   *    faces are a block. Crossings of any number of joints need no case of
   *    their own.
   * 3. Outer faces of opposite direction that coincide are joint faces too:
   *    blocks that are apart in the mesh already.
   * 4. Blocks, cells and vertices are numbered as BlockMesh describes; within
   *    a block, cells follow a space-filling curve and boundary vertices the
   *    boundary or, in three dimensions, the cells. Joint and boundary faces
   *    are in the order of their vertices.
   *
   * Blocks are numbered by their first cell in the mesh, then permuted
   * with @p block_order if that is given: new block i is old block
   * (*block_order)[i].
   *
   * A joint face is named after the curve on it. Where two different curves lie
   * on the two faces of blocks that were apart, one that is in joints_along
   * comes first, then the one on the lower side.
   *
   * Throws InputError: unknown names; joints along curves that are not faces of
   * the mesh or that lie on its outer boundary; two curves on one face; cells
   * or blocks that overlap; refused joint ends.
   */
  template <int dim>
  BlockMesh<dim>
  split_into_blocks(const MeshData<dim> &data, const SplitOptions &options,
                    const std::vector<unsigned int> *block_order = nullptr);
} // namespace quoin

#endif
