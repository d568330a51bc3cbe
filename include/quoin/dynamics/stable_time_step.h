// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_stable_time_step_h
#define quoin_dynamics_stable_time_step_h

#include <array>
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
   */
  class StableTimeStep
  {
  public:
    /** @p bound: S_i as xx, yy, xy [N/m] of each owned node. */
    explicit StableTimeStep(const std::vector<std::array<double, 3>> &bound);

    /** Mass that node @p i needs for the step @p dt to be critical [kg]. */
    double mass_for(const unsigned int i, const double dt) const
    {
      return eigenvalue[i] * dt * dt / 4.;
    }

    /** Largest omega^2 of the owned nodes with masses @p mass [1/s^2]. */
    double largest_eigenvalue(const std::vector<double> &mass) const;

    /**
     * Critical step [s] of central differences with the stiffness-
     * proportional damping @p beta [s] lagging half a step:
     * 2/omega (sqrt(1 + xi^2) - xi), xi = beta omega / 2.
     */
    static double critical(double largest_eigenvalue, double beta);

  private:
    std::vector<double> eigenvalue; /**< of S_i [N/m] */
  };
} // namespace quoin

#endif
