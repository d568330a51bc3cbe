// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_interior_points_h
#define quoin_tdbem_interior_points_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/tdbem/static_solver.h>

#include <mpi.h>

#include <vector>

namespace quoin
{
  /** All that happened on a boundary, for InteriorPoints. */
  struct BoundaryRecord
  {
    double time_step = 0.; /**< [s] */
    /** Decay rate, InfluenceMatrices::Options::decay [1/s]. */
    double decay = 0.;

    /**
     * Displacements [m] at the ends of the steps and tractions [Pa], constant
     * in each: row m - 1 is step m, column 2 e + i component i on element e.
     */
    Eigen::MatrixXd displacement, traction;
  };

  /**
   * Displacements [m] of points in the domain at the end of some steps, from
   * what happened on the boundary (@cite JinWangZhang1998, Eq. 2): entry
   * (2 k + i, l) is component i of point k at the end of step steps[l], which
   * may be 0, when all is at rest. With the notation of InfluenceMatrices and a
   * source at the point x,
   * @f[ u(x)^M = \sum_{n=0}^{M-1}
   *     (A_n - A_{n-1}) p^{M-n}
   *     - \frac{B_n - 2 B_{n-1} + B_{n-2}}{\Delta t} u^{M-n} . @f]
   * Exactly zero before the first P wave arrives from the boundary, and zero
   * but for the error of the method at points that are not in the domain. The
   * fields are those of the boundary elements, constant on each, so that
   * points should keep a distance of a quarter of an element. For late lags
   * the second difference of B loses digits: its absolute error stays at
   * 1e-12 and less.
   *
   * Each kernel is computed once for all steps: they cost less than the
   * kernels if there are fewer than some 50. Points are shared by the ranks of
   * @p communicator, all of which get the result.
   */
  Eigen::MatrixXd interior_displacements(
      const Boundary &boundary, const ElasticMedium &medium,
      const BoundaryRecord &record, const std::vector<dealii::Point<2>> &points,
      const std::vector<unsigned> &steps, MPI_Comm communicator);

  /**
   * Static displacements [m] of points in the domain, two entries each, from
   * the solution on the boundary.
   */
  Eigen::VectorXd
  static_interior_displacements(const Boundary &boundary,
                                const ElasticMedium &medium,
                                const StaticSolution &solution,
                                const std::vector<dealii::Point<2>> &points);
} // namespace quoin

#endif
