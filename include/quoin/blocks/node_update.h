// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_node_update_h
#define quoin_blocks_node_update_h

#include <quoin/base/local_damping.h>
#include <quoin/base/node_record.h>

#include <cmath>
#include <cstddef>
#include <type_traits>

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
    for (std::size_t i = begin; i < end; ++i)
    {
      Two &f            = *reinterpret_cast<Two *>(&force[i]);
      Two &v            = *reinterpret_cast<Two *>(&velocity[i]);
      Two &u            = *reinterpret_cast<Two *>(&nodes[i].u);
      const double gain = inverse_mass[i] * dt_velocity;
      const Two w       = v + gain * f;
      v                 = w;
      u += dt * w;
      f = Two{};
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

  /** The numbers from @p first on, each twice. */
  template <int lanes>
  QUOIN_INLINE typename Lanes<lanes>::Value twice(const double *first)
  {
    if constexpr (lanes == 4)
      return typename Lanes<lanes>::Value{ first[0], first[0], first[1],
                                           first[1] };
    else
    {
      const Lanes<4>::Value a = Lanes<4>::four(first);
      return __builtin_shufflevector(a, a, 0, 0, 1, 1, 2, 2, 3, 3);
    }
  }

  /**
   * Degrees of freedom that advance_nodes_damped() moves at once; one has its
   * formulas, too. @p is_local: there is local damping.
   */
  template <bool adaptive, bool is_local, int lanes>
  struct DampedLanes
  {
    using F     = LaneFunctions<lanes>;
    using Value = typename F::Value;

    double decay, push, inverse_push, local, mass_damping;
    Value before{}, after{}, power{}, change{};

    DampedLanes(const DampingFactors &damping)
      : local(damping.local), mass_damping(damping.mass)
    {
      const double a = 0.5 * damping.dt_velocity * damping.mass;
      decay          = (1. - a) / (1. + a);
      push           = damping.dt_velocity / (1. + a);
      inverse_push   = 1. / push;
    }

    /** The new velocity. */
    QUOIN_INLINE Value advance(const Value &v0, const Value &f,
                               const Value &viscous, const Value &m,
                               const Value &inverse_mass)
    {
      const Value gain = push * inverse_mass;
      const Value keep = m > 0. ? Value{} + decay : Value{} + 1.;
      const Value w    = keep * v0 + gain * (f + viscous);
      Value v1{ w }, local_drag{};
      if constexpr (is_local)
      {
        v1 = w
             - local_damping_velocity<lanes>(local * gain * F::absolute(f), v0,
                                             w);
        local_drag = inverse_push * (v1 - w);
      }
      const Value drag = (m > 0. ? viscous : Value{})
                         + m * (local_drag - 0.5 * mass_damping * (v0 + v1));
      before -= drag * v0;
      after -= drag * v1;
      if (adaptive)
      {
        power += 0.25 * m * (v0 + v1) * (v0 + v1);
        change += 0.5 * m * (v1 - v0) * (v1 + v0);
      }
      return v1;
    }

    DampingWork work(const double dt_before, const double dt) const
    {
      return { 0.5 * dt_before * F::sum(before), 0.5 * dt * F::sum(after),
               F::sum(power), F::sum(change) };
    }
  };

  /**
   * As advance_nodes(), with local and mass-proportional damping and the
   * stiffness-proportional damping forces @p viscous, which it clears too; null
   * if there are none. Mass-proportional damping is centred in time
   * (@cite JinWangZhang1998, Eq. 5) and does not affect stability.
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
    const auto advance_with = [&](const auto is_local)
    {
      std::size_t i = begin;
      DampingWork work;
      if constexpr (dim == 2)
      {
        constexpr int lanes   = native_lanes;
        constexpr int n_nodes = lanes / dim;
        using F               = LaneFunctions<lanes>;
        DampedLanes<adaptive, decltype(is_local)::value, lanes> several(
            damping);
        for (; i + n_nodes <= end; i += n_nodes)
        {
          double *v = &velocity[i][0], *f = &force[i][0];
          typename F::Value fv{};
          if (viscous)
          {
            fv = F::load(&viscous[i][0]);
            F::store(&viscous[i][0], typename F::Value{});
          }
          const typename F::Value v1 = several.advance(
              F::load(v), F::load(f), fv, twice<lanes>(mass + i),
              twice<lanes>(inverse_mass + i));
          F::store(v, v1);
          F::store(f, typename F::Value{});
          for (int k = 0; k < n_nodes; ++k)
            *reinterpret_cast<Two *>(&nodes[i + k].u)
                += dt * Two{ v1[2 * k], v1[2 * k + 1] };
        }
        work = several.work(damping.dt_before, dt);
      }
      DampedLanes<adaptive, decltype(is_local)::value, 1> one(damping);
      for (; i < end; ++i)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double v1 = one.advance(velocity[i][d], force[i][d],
                                        viscous ? viscous[i][d] : 0., mass[i],
                                        inverse_mass[i]);
          velocity[i][d]  = v1;
          nodes[i].u[d] += dt * v1;
          force[i][d] = 0.;
          if (viscous)
            viscous[i][d] = 0.;
        }
      work += one.work(damping.dt_before, dt);
      return work;
    };
    return damping.local == 0. ? advance_with(std::false_type())
                               : advance_with(std::true_type());
  }
} // namespace quoin

#endif
