// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_boundary_geometry_h
#define quoin_farfield_boundary_geometry_h

#include <quoin/farfield/boundary_parameters.h>
#include <quoin/mesh/mesh_data.h>
#include <quoin/elastodynamics/boundary.h>

#include <vector>

namespace quoin
{
  /** The boundary of a domain and what each element belongs to. */
  struct BoundaryGeometry
  {
    Boundary boundary;
    /** Number of each element's boundary in the parameters. */
    std::vector<unsigned int> owner;

    /** Middles of the elements of boundary @p k [m]. */
    std::vector<dealii::Point<2>> middles(unsigned int k) const;
  };

  /**
   * Cuts the boundaries of @p parameters into elements, with the domain on
   * their left. Those with the shape mesh are curves of @p mesh: their edges
   * or, if an element length or number is given, their straight pieces cut
   * anew into equal parts. Ends of boundaries that meet to within 1e-9 of the
   * size of all are made one point.
   *
   * Throws an InputError that begins with the section if curves do not exist
   * or do not hang together, an open curve is where a closed one was said,
   * there are fewer elements than straight pieces, or elements cross, touch
   * or coincide, or if boundaries meet that have the domain on different
   * sides.
   */
  BoundaryGeometry
  make_boundary_geometry(const BoundaryElementParameters &parameters,
                         const MeshData<2> &mesh = MeshData<2>());

  /** A point of the boundary next to a given one. */
  struct NearestElement
  {
    unsigned int element = 0;
    double distance      = 0.; /**< [m] */
    bool inside_domain   = false;
  };

  /** The element that is nearest to @p point, and on which side that is. */
  NearestElement nearest_element(const Boundary &boundary,
                                 const dealii::Point<2> &point);

  /** Whether two segments have a point in common. */
  bool segments_meet(const dealii::Point<2> &a, const dealii::Point<2> &b,
                     const dealii::Point<2> &c, const dealii::Point<2> &d);
} // namespace quoin

#endif
