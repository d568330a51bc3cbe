// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_motions_platen_bearing_h
#define quoin_motions_platen_bearing_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /** What a platen exerts on its boundary along the outward normal: a platen
      pulls wherever a plate that only lies on the boundary would open. */
  template <int dim>
  struct PlatenBearing
  {
    double pressed = 0.; /**< sum of the forces of nodes that it presses [N] */
    double pulled  = 0.; /**< sum of those of nodes that it pulls [N] */
    /** Largest pull of a node by the node's share of the boundary [Pa], and
        where it is [m]. */
    double tension = 0.;
    dealii::Point<dim> place;
  };

  /** Whether a platen moves a boundary and something loads or drives it; one
      that stands still is a support. */
  bool bears_boundary(const LoadParameters &parameters);

  /** The outward normal of a platen's boundary at each of @p nodes, times the
      node's share of the area [m^2], in the mesh. Empty unless it
      bears_boundary(). */
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  platen_normals(const LoadParameters &parameters, const NodeMap<dim> &node_map,
                 const std::vector<unsigned int> &nodes,
                 const Thickness &thickness);

  /** Sums what the @p forces [N] of a platen on nodes at @p places [m] with
      the outward @p normals [m^2] are along these, over the nodes of all ranks.
      Collective. */
  template <int dim>
  PlatenBearing<dim>
  platen_bearing(const std::vector<dealii::Tensor<1, dim>> &normals,
                 const std::vector<dealii::Tensor<1, dim>> &forces,
                 const std::vector<dealii::Point<dim>> &places,
                 MPI_Comm communicator);
} // namespace quoin

#endif
