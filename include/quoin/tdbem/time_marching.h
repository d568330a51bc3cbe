// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_time_marching_h
#define quoin_tdbem_time_marching_h

#include <quoin/base/eigen_core.h>
#include <quoin/tdbem/boundary_history.h>
#include <quoin/elastodynamics/influence_kernel.h>

#include <Eigen/Dense>

#include <vector>

namespace quoin
{
  /**
   * Solves the boundary integral equation step by step.
   *
   * Of each component of each element either the displacement or the traction
   * is given, the same one at all times; any mixture will do. Each step solves
   * @f[ H^0 u^M - G^0 p^M = \sum_{n=1}^{M-1} (G^n p^{M-n} - H^n u^{M-n}) @f]
   * for the other ones by a matrix that is factored once.
   *
   * The same factors condense the domain to an interface
   * (@cite JinWangZhang1998, Eqs. 14-16): unknowns whose displacement is given,
   * not beforehand but by what is on the other side. See condensed_matrix().
   */
  class TimeMarching
  {
  public:
    /**
     * Entry k of @p traction_is_given says which of the fields is given at
     * unknown k. Kernel and history, which must be one of that kernel, must
     * outlive this object. Throws InputError if the equations are singular.
     */
    TimeMarching(const InfluenceKernel &kernel, BoundaryHistory &history,
                 const std::vector<bool> &traction_is_given);

    /**
     * Takes one step to the boundary values @p given: displacements [m] or
     * tractions [Pa] that are the kernel's of its step (see InfluenceKernel).
     */
    void step(const Eigen::VectorXd &given);

    /** Computes the part of the history in the step to come, as begin_step()
        does unless it was called. */
    void predict();

    /** Does what step() does without adding the step to the history: see
     * finish_step(). */
    void begin_step(const Eigen::VectorXd &given);

    /**
     * Adds the step to the history, the tractions on the unknowns
     * @p replaced, if any, with other @p values [Pa].
     */
    void finish_step(const std::vector<unsigned> &replaced = {},
                     const Eigen::VectorXd &values         = {});

    /** Displacements [m] after the last step. */
    const Eigen::VectorXd &u() const
    {
      return displacement;
    }

    /** Tractions [Pa] in the last step. */
    const Eigen::VectorXd &p() const
    {
      return traction;
    }

    /**
     * Derivative of the tractions on the unknowns of @p interface with
     * respect to their displacements in the same step [Pa/m]: A without the
     * lengths in F_I = A u_I + C. All of them must have given displacements.
     */
    Eigen::MatrixXd
    condensed_matrix(const std::vector<unsigned> &interface) const;

    /**
     * The tractions [Pa] on the unknowns of @p interface in the step to come
     * if their displacements in it are zero and all other boundary values are
     * @p given: C without the lengths. Takes no step.
     */
    Eigen::VectorXd condensed_load(const std::vector<unsigned> &interface,
                                   const Eigen::VectorXd &given);

    /** Sets the values of the last step, for a restart. */
    void restore(const Eigen::VectorXd &u, const Eigen::VectorXd &p);

  private:
    Eigen::VectorXd solve(const Eigen::VectorXd &given);

    BoundaryHistory &history;
    std::vector<bool> traction_is_given;
    Eigen::MatrixXd G0, H0;
    double traction_scale; /**< scale of columns to a similar size [Pa/m] */
    Eigen::PartialPivLU<Eigen::MatrixXd> solver;
    Eigen::VectorXd displacement, traction;
    Eigen::VectorXd past; /**< the history's prediction for the next step */
    bool has_past = false;
  };
} // namespace quoin

#endif
