// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_model_summary_h
#define quoin_advice_model_summary_h

#include <quoin/mesh/mesh_report.h>
#include <quoin/mesh/node_map.h>
#include <quoin/parameters/parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  // Materials, joints and loads of a model of blocks, a line each, for
  // --check. All ranks get the same lines; those about nodes are collective.

  /**
   * @p material_of_group: index into the materials of the parameters, as
   * ModelProperties has it.
   */
  template <int dim>
  std::vector<std::string>
  material_lines(const Parameters &parameters, const NodeMap<dim> &nodes,
                 const std::vector<unsigned int> &material_of_group);

  /** Names of the curves in @p report are those of the mesh. */
  std::vector<std::string> joint_lines(const Parameters &parameters,
                                       const MeshReport &report);

  /**
   * How many faces joints have between two blocks, and by how much that makes
   * them too stiff in rotation, see block_joints(). None for quadratic
   * triangles, on whose edges Simpson's rule is exact. Collective.
   */
  template <int dim>
  std::vector<std::string> face_lines(const Parameters &parameters,
                                      const NodeMap<dim> &nodes);

  /**
   * A line about the joint that its few faces make too stiff in rotation most,
   * of those between two rigid blocks or groups of platens, if it is by more
   * than 10 %: where nothing but joints gives way tilts are wrong by as much.
   * Collective.
   */
  template <int dim>
  std::vector<std::string> rigid_face_lines(const Parameters &parameters,
                                            const NodeMap<dim> &nodes);

  /** The deformable blocks of @p report that are slender, of plain linear cells
      of which few lie across them, and not bedded in joints. */
  std::vector<const SlenderBlock *>
  coarse_slender_blocks(const Parameters &parameters, const MeshReport &report,
                        const std::vector<unsigned int> &material_of_group);

  /** How many they are, and by how much they are too stiff where they bend. */
  std::vector<std::string>
  bending_lines(const Parameters &parameters, const MeshReport &report,
                const std::vector<unsigned int> &material_of_group);

  template <int dim>
  std::vector<std::string> load_lines(const Parameters &parameters,
                                      const NodeMap<dim> &nodes);
} // namespace quoin

#endif
