// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loading/arrival.h>
#include <quoin/signals/time_function.h>

namespace quoin
{
  template <int dim>
  Arrival<dim>::Arrival(const std::vector<unsigned int> &placed,
                        const std::vector<const NodalLoad<dim> *> &loads,
                        const TimePoint &start, const std::size_t n_local,
                        const double duration)
    : ramp_duration(duration)
  {
    AlignedArray<dealii::Tensor<1, dim>> all(n_local, dealii::Tensor<1, dim>());
    for (const NodalLoad<dim> *load : loads)
      load->add_loads(start, all.data());
    for (const unsigned int node : placed)
      if (all[node] != dealii::Tensor<1, dim>())
      {
        nodes.push_back(node);
        forces.push_back(all[node]);
      }
  }

  template <int dim>
  double Arrival<dim>::share(const double load_time) const
  {
    return half_cosine(load_time, ramp_duration);
  }

  template <int dim>
  void Arrival<dim>::add_loads(const TimePoint &time,
                               dealii::Tensor<1, dim> *force) const
  {
    const double lacking = 1. - share(time.stage);
    if (lacking == 0.)
      return;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      force[nodes[i]] -= lacking * forces[i];
  }

  template <int dim>
  double
  Arrival<dim>::external_power(const TimePoint &time,
                               const dealii::Tensor<1, dim> *velocity) const
  {
    const double lacking = 1. - share(time.stage);
    if (lacking == 0.)
      return 0.;
    double power = 0.;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      power += forces[i] * velocity[nodes[i]];
    return -lacking * power;
  }

  template class Arrival<2>;
  template class Arrival<3>;
} // namespace quoin
