// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_static_solver_h
#define quoin_tdbem_static_solver_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/projection.h>

#include <vector>

namespace quoin
{
  /** Boundary values, component by component. */
  struct StaticConditions
  {
    /** Displacement [m] where it is known, traction [Pa] elsewhere. */
    Eigen::VectorXd values;
    std::vector<bool> displacement_known;
    /**
     * Sum of the tractions' forces on an unbounded domain [N/m], used if a
     * displacement is known. Zero keeps displacements bounded.
     */
    dealii::Tensor<1, 2> net_force = dealii::Tensor<1, 2>();
  };

  struct StaticSolution
  {
    Eigen::VectorXd displacement; /**< [m] */
    Eigen::VectorXd traction;     /**< [Pa] */
    /** See solve_static() [m]. */
    dealii::Tensor<1, 2> constant = dealii::Tensor<1, 2>();
  };

  /**
   * Solves the static problem of a domain bounded by closed curves.
   *
   * Bounded domain: rigid motions that no known displacement prevents are
   * excluded by setting their mean over the boundary to zero. The known
   * tractions must be in balance for them, to 1e-3 of the sum of their
   * magnitudes.
   *
   * Unbounded domain: far from the boundary the displacement is that of the
   * net force f at the origin by static_displacement_kernel(), with a
   * reference length of 1 m, plus a constant. If all tractions are known, f is
   * their sum and the constant zero, that is, without a net force the
   * displacement vanishes at infinity. If any displacement is known, f is
   * given and the constant a result.
   *
   * Whenever a traction is unknown, the constant is an unknown and the net
   * force (zero for a bounded domain, where the constant comes out zero but
   * for the error of the method) an equation. This also avoids the sizes of
   * the boundary for which G is singular.
   *
   * Throws InputError if the boundary is not closed, the tractions are out of
   * balance or the equations are singular.
   */
  StaticSolution solve_static(const Boundary &boundary,
                              const ElasticMedium &medium,
                              Projection projection,
                              const StaticConditions &conditions);
} // namespace quoin

#endif
