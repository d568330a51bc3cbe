// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/dynamics/release.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace quoin
{
  Release::Release(const State<2> &state, const StageParameters &stage,
                   const double duration)
    : is_linear(stage.releases_linearly), ramp_duration(duration)
  {
    const auto &held = state.get<ConstructionState>().held;
    for (const HeldForces &item : held)
      is_changing = is_changing || item.left != item.left_at_end;
    const std::size_t n = held.empty() ? 0 : held.front().force.size() / 2;
    for (std::size_t i = 0; i < n; ++i)
    {
      NodalForce sum{ static_cast<unsigned int>(i), { 0., 0. }, { 0., 0. } };
      for (const HeldForces &item : held)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double force = item.force[2 * i + d];
          sum.start[d] += item.left * force;
          sum.change[d] += (item.left_at_end - item.left) * force;
        }
      if (sum.start[0] != 0. || sum.start[1] != 0. || sum.change[0] != 0.
          || sum.change[1] != 0.)
        forces.push_back(sum);
    }
  }

  double Release::share(const double load_time) const
  {
    if (load_time >= ramp_duration)
      return 1.;
    const double t = load_time / ramp_duration;
    return is_linear ? t : 0.5 * (1. - std::cos(dealii::numbers::PI * t));
  }

  void Release::add_forces(const double load_time, NodeVector<2> *force) const
  {
    const double s = share(load_time);
    for (const NodalForce &item : forces)
      for (unsigned int d = 0; d < 2; ++d)
        force[item.node].v[d] += item.start[d] + s * item.change[d];
  }

  double Release::external_power(const TimePoint &time,
                                 const NodeVector<2> *velocity) const
  {
    const double s = share(time.stage);
    double result  = 0.;
    for (const NodalForce &item : forces)
      for (unsigned int d = 0; d < 2; ++d)
        result
            += (item.start[d] + s * item.change[d]) * velocity[item.node].v[d];
    return result;
  }
} // namespace quoin
