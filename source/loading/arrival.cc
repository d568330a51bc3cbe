// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loading/arrival.h>

#include <algorithm>

namespace quoin
{
  template <int dim>
  void Arrival<dim>::add(const std::vector<unsigned int> &placed,
                         const std::vector<const NodalLoad<dim> *> &loads,
                         const std::size_t n_local, const Growth &growth)
  {
    parts.push_back({ placed, loads, n_local, growth, {}, {} });
  }

  template <int dim>
  void Arrival<dim>::Part::find_forces(const TimePoint &time) const
  {
    std::vector<std::array<double, 5>> now;
    for (const NodalLoad<dim> *load : loads)
      now.push_back(load->amplitude(time));
    if (forces.size() == nodes.size() && now == amplitudes)
      return;
    amplitudes = std::move(now);
    AlignedArray<dealii::Tensor<1, dim>> all(n_local, dealii::Tensor<1, dim>());
    for (const NodalLoad<dim> *load : loads)
      load->add_loads(time, all.data());
    forces.clear();
    for (const unsigned int node : nodes)
      forces.push_back(all[node]);
  }

  template <int dim>
  double Arrival<dim>::rest() const
  {
    double last = 0.;
    for (const Part &part : parts)
      last = std::max(last, part.growth.rest());
    return last;
  }

  template <int dim>
  bool Arrival<dim>::differ(const double one, const double other) const
  {
    return std::any_of(
        parts.begin(), parts.end(),
        [&](const Part &part)
        { return part.growth.share(one) != part.growth.share(other); });
  }

  template <int dim>
  void Arrival<dim>::add_loads(const TimePoint &time,
                               dealii::Tensor<1, dim> *force) const
  {
    for (const Part &part : parts)
    {
      const double lacking = 1. - part.growth.share(time.stage);
      if (lacking == 0.)
        continue;
      part.find_forces(time);
      for (std::size_t i = 0; i < part.nodes.size(); ++i)
        force[part.nodes[i]] -= lacking * part.forces[i];
    }
  }

  template <int dim>
  double
  Arrival<dim>::external_power(const TimePoint &time,
                               const dealii::Tensor<1, dim> *velocity) const
  {
    double result = 0.;
    for (const Part &part : parts)
    {
      const double lacking = 1. - part.growth.share(time.stage);
      if (lacking == 0.)
        continue;
      part.find_forces(time);
      double power = 0.;
      for (std::size_t i = 0; i < part.nodes.size(); ++i)
        power += part.forces[i] * velocity[part.nodes[i]];
      result -= lacking * power;
    }
    return result;
  }

  template class Arrival<2>;
  template class Arrival<3>;
} // namespace quoin
