// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_exterior_stiffness_h
#define quoin_tdbem_exterior_stiffness_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/projection.h>

#include <vector>

namespace quoin
{
  /** A domain at rest, condensed to a part of its boundary. */
  struct ExteriorStiffness
  {
    /**
     * Traction on each unknown of the interface by the displacement of each
     * [Pa/m]. Multiplied from the left by the elements' lengths it is
     * symmetric and has no negative eigenvalue: the domain stores energy.
     */
    Eigen::MatrixXd traction;
    /**
     * Tractions on the interface, which is held, by the value that is given on
     * each unknown of the rest of the boundary, a displacement [Pa/m] or a
     * traction [-]. Columns of unknowns on the interface are 0.
     */
    Eigen::MatrixXd traction_by_given;
    /**
     * Largest difference of the matrix of forces from its transpose, by its
     * largest entry, before the mean of both was taken.
     */
    double asymmetry = 0.;
  };

  /**
   * The static stiffness of the domain bounded by @p boundary on the unknowns
   * @p interface (2 e + i), as solve_static(), for a unit displacement of one
   * after the other. On the rest of the boundary displacement or traction, as
   * @p traction_is_given says of each unknown, stays what it is.
   *
   * Unbounded domain: the displacement is a constant far away, the same on
   * surfaces that go on beyond the boundary's ends, and the net force
   * of the unknown tractions is zero, because in the plane any other moves the
   * boundary without bound. So a translation meets no resistance.
   *
   * Throws InputError if the equations are singular or energy would be
   * released.
   */
  ExteriorStiffness
  exterior_stiffness(const Boundary &boundary, const ElasticMedium &medium,
                     Projection projection,
                     const std::vector<unsigned int> &interface,
                     const std::vector<bool> &traction_is_given);
} // namespace quoin

#endif
