// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_boundary_history_h
#define quoin_tdbem_boundary_history_h

#include <quoin/base/eigen_core.h>

#include <vector>

namespace quoin
{
  /**
   * What has happened on a boundary so far, and what it still does:
   * the convolution in the equation of InfluenceKernel without its newest term.
   */
  class BoundaryHistory
  {
  public:
    virtual ~BoundaryHistory() = default;

    /**
     * The sum over n >= 1 of G^n p^{M-n} - H^n u^{M-n} [m] for the step M that
     * comes next, two entries per element. Collective if the rows are shared
     * by several ranks, and the same on all of them.
     */
    virtual const Eigen::VectorXd &predict() = 0;

    /** Adds the step: its displacements [m] and tractions [Pa]. */
    virtual void push(const Eigen::VectorXd &u, const Eigen::VectorXd &p) = 0;

    /** After how many steps a step costs more again. */
    virtual unsigned period() const
    {
      return 1;
    }

    /** Number of steps added. */
    virtual unsigned long n_steps() const = 0;

    /**
     * All that push() has changed, for a checkpoint. After restore(), which
     * takes it, this object goes on bitwise as the saved one.
     */
    virtual std::vector<double> save() const               = 0;
    virtual void restore(const std::vector<double> &saved) = 0;
  };
} // namespace quoin

#endif
