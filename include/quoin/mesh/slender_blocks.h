// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_slender_blocks_h
#define quoin_mesh_slender_blocks_h

#include <quoin/mesh/block_mesh.h>

#include <boost/serialization/map.hpp>

#include <map>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * A straight block much thinner than long with so few linear cells across its
   * thickness that they are far too stiff in bending. Sizes of faces are those
   * of a MeshReport.
   */
  struct SlenderBlock
  {
    unsigned int group = 0;  /**< index into BlockMesh::group_names */
    double thickness   = 0.; /**< extent where it is least [m] */
    double length      = 0.; /**< extent where it is largest [m] */
    double n_across    = 0.; /**< thickness by the mean extent of a cell [-] */
    dealii::Point<3> axis;   /**< along its thickness, of length 1 */
    dealii::Point<3> middle; /**< [m] */
    /** Size of the faces that bound its thickness, and, by the names of curves
        or surfaces, of those of them that are no joints. */
    double faces = 0.;
    std::map<std::string, double> outer;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &group &thickness &length &n_across &axis &middle &faces &outer;
    }

    /** Part of the deflection in bending that linear cells may lose [-]: what
        structured meshes of cantilevers ten times as long as thick lose, in
        @p dimension dimensions; others lose less. */
    double lost_deflection(unsigned int dimension) const;
  };

  /** Those blocks of @p mesh; none with quadratic or mixed cells. */
  template <int dim>
  std::vector<SlenderBlock> slender_blocks(const BlockMesh<dim> &mesh);
} // namespace quoin

#endif
