// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_boundary_history_h
#define quoin_tdbem_boundary_history_h

#include <quoin/base/archive_members.h>
#include <quoin/base/eigen_core.h>

#include <vector>

namespace quoin
{
  /** Result of BoundaryHistory::save(). */
  struct SavedHistory
  {
    std::vector<double> common; /**< common part of all ranks */
    /** Histories of the equations that ranks share, group by group: from
        @p first_group on those of one rank, or all of them. */
    std::vector<std::vector<double>> groups;
    unsigned int first_group = 0;

    bool empty() const
    {
      return common.empty();
    }

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(common);
      visitor.joined(groups);
      // With the first rank's groups all begin.
      visitor.same(first_group);
    }
  };

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
     * takes it, this object continues bitwise as the saved one.
     */
    virtual SavedHistory save() const               = 0;
    virtual void restore(const SavedHistory &saved) = 0;
  };
} // namespace quoin

#endif
