// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_mesh_size_h
#define quoin_mesh_mesh_size_h

#include <quoin/mesh/block_mesh.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  /** The largest distance of a vertex from the first, a size to scale with
      [m]. */
  inline double size_from_first_vertex(const BlockMesh<2> &mesh)
  {
    double size = 0.;
    for (const auto &p : mesh.vertices)
      size = std::max(size, p.distance(mesh.vertices[0]));
    return size;
  }

  /** Of the box around all vertices [m]. */
  inline double diagonal(const BlockMesh<2> &mesh)
  {
    const dealii::BoundingBox<2> box(mesh.vertices);
    return std::hypot(box.side_length(0), box.side_length(1));
  }
} // namespace quoin

#endif
