// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loading/release.h>
#include <quoin/signals/time_function.h>

#include <algorithm>

namespace quoin
{
  template <int dim>
  Release<dim>::Release(const State<dim> &state, const bool is_linear,
                        const double duration)
    : is_linear(is_linear), ramp_duration(duration)
  {
    const auto &held = state.template get<ConstructionState<dim>>().held;
    for (const HeldForces<dim> &item : held)
      is_changing = is_changing || item.left != item.left_at_end;
    const std::size_t n = held.empty() ? 0 : held.front().force.size() / dim;
    for (std::size_t i = 0; i < n; ++i)
    {
      NodalForce sum{ static_cast<unsigned int>(i), {}, {} };
      for (const HeldForces<dim> &item : held)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double force = item.force[dim * i + d];
          sum.start[d] += item.left * force;
          sum.change[d] += (item.left_at_end - item.left) * force;
        }
      const auto acts = [](const double part) { return part != 0.; };
      if (std::any_of(sum.start, sum.start + dim, acts)
          || std::any_of(sum.change, sum.change + dim, acts))
        forces.push_back(sum);
    }
  }

  template <int dim>
  double Release<dim>::share(const double load_time) const
  {
    if (is_linear && load_time < ramp_duration)
      return load_time / ramp_duration;
    return half_cosine(load_time, ramp_duration);
  }

  template <int dim>
  void Release<dim>::add_loads(const TimePoint &time,
                               dealii::Tensor<1, dim> *force) const
  {
    const double s = share(time.stage);
    for (const NodalForce &item : forces)
      for (unsigned int d = 0; d < dim; ++d)
        force[item.node][d] += item.start[d] + s * item.change[d];
  }

  template <int dim>
  double
  Release<dim>::external_power(const TimePoint &time,
                               const dealii::Tensor<1, dim> *velocity) const
  {
    const double s = share(time.stage);
    double result  = 0.;
    for (const NodalForce &item : forces)
      for (unsigned int d = 0; d < dim; ++d)
        result += (item.start[d] + s * item.change[d]) * velocity[item.node][d];
    return result;
  }

  template class Release<2>;
  template class Release<3>;
} // namespace quoin
