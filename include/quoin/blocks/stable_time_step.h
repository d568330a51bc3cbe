// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_stable_time_step_h
#define quoin_blocks_stable_time_step_h

#include <quoin/operators/force_operator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace quoin
{
  /**
   * A bound of the highest frequency of blocks and joints together, node by
   * node. With lambda_e the largest eigenvalue of element e and its lumped
   * mass m_e at a node, and springs k between nodes a and b,
   *
   *   u^T K u <= sum_i u_i^T S_i u_i,
   *   S_i = sum_e lambda_e m_e I + sum_k m_i (1/m_a + 1/m_b) k,
   *
   * so omega^2 <= max_i eig(S_i) / m_i: exact for one element and for one
   * spring, and never too low. Mass scaling raises m_i.
   *
   * A rigid block has one matrix, that of its three degrees of freedom
   * (RigidBlocks::largest_eigenvalue()); its nodes do not count.
   */
  template <int dim>
  class StableTimeStep
  {
  public:
    using Bound = NodeStiffness<dim>;

    /** @p bound: S_i [N/m] of each owned node. */
    explicit StableTimeStep(const std::vector<Bound> &bound);

    /** Adds rigid blocks with their omega^2 [1/s^2]. */
    void set_rigid_blocks(const std::vector<double> &eigenvalues)
    {
      rigid_eigenvalue = eigenvalues;
    }

    /** Bound of omega^2 [1/s^2] of owned node @p i with mass @p mass [kg]. */
    double squared_frequency(const unsigned int i, const double mass) const
    {
      return eigenvalue[i] / mass;
    }

    /** omega^2 [1/s^2] of each rigid block. */
    const std::vector<double> &rigid_blocks() const
    {
      return rigid_eigenvalue;
    }

    /** Mass that node @p i needs for the step @p dt to be critical [kg]. */
    double mass_for(const unsigned int i, const double dt) const
    {
      return eigenvalue[i] * dt * dt / 4.;
    }

    /** Mass factor of rigid block @p b for the step @p dt to be critical [-].
     */
    double rigid_factor(const unsigned int b, const double dt) const
    {
      return std::max(1., rigid_eigenvalue[b] * dt * dt / 4.);
    }

    /**
     * Largest omega^2 [1/s^2] of the owned nodes with masses @p mass and of
     * the rigid blocks with @p rigid_factors times theirs; empty: 1.
     */
    double largest_eigenvalue(const std::vector<double> &mass,
                              const std::vector<double> &rigid_factors
                              = {}) const;

    /**
     * Critical step [s] of central differences with the stiffness-
     * proportional damping @p beta [s] lagging half a step:
     * 2/omega (sqrt(1 + xi^2) - xi), xi = beta omega / 2.
     */
    static double critical(double largest_eigenvalue, double beta);

    /** How many times shorter @p beta makes the critical step: @p critical is
        the damped one. */
    static double shortened_by(const double critical, const double beta)
    {
      return std::sqrt(1. + 2. * beta / critical);
    }

  private:
    std::vector<double> eigenvalue; /**< largest eigenvalue of S_i [N/m] */
    std::vector<double> rigid_eigenvalue; /**< omega^2 [1/s^2] */
  };
} // namespace quoin

#endif
