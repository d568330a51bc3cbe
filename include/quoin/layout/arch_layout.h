// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_arch_layout_h
#define quoin_layout_arch_layout_h

#include <quoin/layout/arch_parameters.h>
#include <quoin/layout/gmsh_geometry.h>
#include <quoin/layout/polygon.h>

#include <string>
#include <vector>

namespace quoin
{
  /** A block of an arch bridge. */
  struct ArchBlock
  {
    enum Kind
    {
      voussoir,
      abutment,
      backing,
      fill
    };
    Kind kind;
    std::string name; /**< name of a voussoir; may be empty */
    /** Into ArchLayout::points, counter-clockwise. */
    std::vector<unsigned int> corners;
  };

  /** The blocks of an arch bridge, which share their points. */
  struct ArchLayout
  {
    Polygon points;
    std::vector<ArchBlock> blocks; /**< voussoirs first, from the left */

    double area(ArchBlock::Kind kind) const; /**< [m^2] */
  };

  /**
   * An arch of straight-sided voussoirs on radial joints, whose intrados is an
   * arc of a circle from (-span/2, 0) to (span/2, 0); below its first and last
   * joint the abutments; beside it, above the abutments, the backing; over all
   * the fill. All are as wide as the abutments.
   *
   * Throws InputError: a backing that is too thin for an element.
   */
  ArchLayout lay_arch(const ArchParameters &arch);

  /** Line with the number and the area of the parts of each kind. */
  std::string arch_report(const ArchLayout &layout);

  /**
   * The layout as a gmsh geometry that makes the mesh of the arch: physical
   * surfaces `voussoir` or `voussoir_NAME`, `abutment`, `backing`, `fill`;
   * physical curves `ring_joint` between voussoirs and to the abutments,
   * `backing_joint` between backing and what is beside it, `fill_joint` below
   * the fill; on the outside `intrados`, `extrados` (both with _NAME on named
   * voussoirs) where nothing is above it, `road` on top of the fill, `base`
   * below the abutments, and the sides `abutment_left`, `abutment_right`,
   * `backing_left`, ..., `fill_right`. Other outer edges have no name.
   */
  GmshGeometry arch_geometry(const ArchParameters &arch,
                             const ArchLayout &layout);
} // namespace quoin

#endif
