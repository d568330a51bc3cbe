// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_node_update_h
#define quoin_blocks_node_update_h

#include <quoin/base/local_damping.h>
#include <quoin/base/node_record.h>

#include <cmath>
#include <cstddef>

namespace quoin
{
  /**
   * One undamped central difference step of the nodes [begin, end):
   * v(t + dt/2) = v(t - dt'/2) + f / m dt_velocity, u(t + dt) = u(t) + v dt,
   * where dt_velocity is the mean of this step and the one before. Leaves the
   * force zero for the next step, while it is in cache.
   *
   * @p inverse_mass is 1/m [1/kg], zero where a node must keep its velocity.
   */
  template <int dim>
  inline void advance_nodes(const std::size_t begin, const std::size_t end,
                            NodeRecord<dim> *__restrict nodes,
                            dealii::Tensor<1, dim> *__restrict velocity,
                            dealii::Tensor<1, dim> *__restrict force,
                            const double *__restrict inverse_mass,
                            const double dt_velocity, const double dt)
  {
    // x and y at once: compilers do not vectorise this by themselves.
    using Pair = double __attribute__((vector_size(16), aligned(8), may_alias));
    for (std::size_t i = begin; i < end; ++i)
    {
      Pair &f           = *reinterpret_cast<Pair *>(&force[i]);
      Pair &v           = *reinterpret_cast<Pair *>(&velocity[i]);
      Pair &u           = *reinterpret_cast<Pair *>(&nodes[i].u);
      const double gain = inverse_mass[i] * dt_velocity;
      const Pair w      = v + gain * f;
      v                 = w;
      u += dt * w;
      f = Pair{};
      if constexpr (dim == 3)
      {
        const double wz = velocity[i][2] + gain * force[i][2];
        velocity[i][2]  = wz;
        nodes[i].u[2] += dt * wz;
        force[i][2] = 0.;
      }
    }
  }

  /** Damping in one step; zero factors switch a part off. */
  struct DampingFactors
  {
    double local;       /**< Cundall's: share of the unbalanced force [-] */
    double mass;        /**< alpha [1/s] */
    double dt_before;   /**< previous step [s] */
    double dt_velocity; /**< time step from t - dt/2 to t + dt/2 [s] */
  };

  /** Energies of damping in one step. */
  struct DampingWork
  {
    double before = 0.; /**< energy taken from t - dt/2 to t [J] */
    double after  = 0.; /**< energy taken from t to t + dt/2 [J] */

    /** Power of mass-proportional damping per alpha [J]. */
    double mass_power = 0.;
    /** Change of kinetic energy [J]. */
    double kinetic_change = 0.;

    DampingWork &operator+=(const DampingWork &other)
    {
      before += other.before;
      after += other.after;
      mass_power += other.mass_power;
      kinetic_change += other.kinetic_change;
      return *this;
    }
  };

  /**
   * As advance_nodes(), with local and mass-proportional damping and the
   * stiffness-proportional damping forces @p viscous, which it clears too.
   * Mass-proportional damping is centred in time (@cite JinWangZhang1998,
   * Eq. 5) and does not affect stability.
   *
   * @p mass and @p inverse_mass are both zero at constrained nodes, which are
   * damped elsewhere. Power and change of kinetic energy are computed if
   * @p adaptive.
   */
  template <bool adaptive, int dim>
  inline DampingWork
  advance_nodes_damped(const std::size_t begin, const std::size_t end,
                       NodeRecord<dim> *__restrict nodes,
                       dealii::Tensor<1, dim> *__restrict velocity,
                       dealii::Tensor<1, dim> *__restrict force,
                       dealii::Tensor<1, dim> *__restrict viscous,
                       const double *__restrict mass,
                       const double *__restrict inverse_mass,
                       const DampingFactors &damping, const double dt)
  {
    const double a            = 0.5 * damping.dt_velocity * damping.mass;
    const double decay        = (1. - a) / (1. + a);
    const double push         = damping.dt_velocity / (1. + a);
    const double inverse_push = 1. / push;
    // Sums by component: half the length of each chain of additions.
    double before[dim]{}, after[dim]{}, power[dim]{}, change[dim]{};
    for (std::size_t i = begin; i < end; ++i)
    {
      const double m    = mass[i];
      const double gain = push * inverse_mass[i];
      const double keep = m > 0. ? decay : 1.;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double v0 = velocity[i][d];
        const double f  = force[i][d];
        const double fv = viscous[i][d];
        const double w  = keep * v0 + gain * (f + fv);
        const double v1 = w
                          - local_damping_velocity(
                              damping.local * gain * std::abs(f), v0, w);
        const double drag
            = (m > 0. ? fv : 0.)
              + m * (inverse_push * (v1 - w) - 0.5 * damping.mass * (v0 + v1));
        before[d] -= drag * v0;
        after[d] -= drag * v1;
        if (adaptive)
        {
          power[d] += 0.25 * m * (v0 + v1) * (v0 + v1);
          change[d] += 0.5 * m * (v1 - v0) * (v1 + v0);
        }
        velocity[i][d] = v1;
        nodes[i].u[d] += dt * v1;
        force[i][d]   = 0.;
        viscous[i][d] = 0.;
      }
    }
    for (unsigned int d = 1; d < dim; ++d)
    {
      before[0] += before[d];
      after[0] += after[d];
      power[0] += power[d];
      change[0] += change[d];
    }
    return { 0.5 * damping.dt_before * before[0], 0.5 * dt * after[0], power[0],
             change[0] };
  }
} // namespace quoin

#endif
