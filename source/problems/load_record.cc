// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/model/block_placement.h>
#include <quoin/problems/load_record.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    constexpr std::array<const char *, 3> axis_names = { "x", "y", "z" };

    /** Difference of the forces, by the size of the loads, that is warned of
        [-]. */
    constexpr double most_difference = 0.05;
    /** Change of the applied force, by that size, that is loading [-]. */
    constexpr double least_change = 0.01;
  } // namespace

  void LoadRecord::add_factor(const double factor, const double displacement,
                              const double time)
  {
    if (peak.time < 0. || std::abs(factor) > std::abs(peak.factor))
      peak = { factor, displacement, time };
  }

  void LoadRecord::add_forces(const ForceBalance &forces, const double time)
  {
    const auto &[applied, supports, size] = forces;
    for (unsigned int d = 0; d < 3; ++d)
    {
      Axis &axis     = axes[d];
      axis.lowest    = std::min(axis.lowest, applied[d]);
      axis.highest   = std::max(axis.highest, applied[d]);
      axis.size      = std::max(axis.size, size[d]);
      axis.most_up   = std::max(axis.most_up, supports[d]);
      axis.most_down = std::max(axis.most_down, -supports[d]);
      // Constant loads have rounding.
      if (std::abs(applied[d]) < (1. - 1e-9) * std::abs(axis.applied))
        continue;
      axis.applied = applied[d];
      axis.time    = time;
    }
  }

  double LoadRecord::Axis::taken() const
  {
    return applied > 0. ? most_down : -most_up;
  }

  bool LoadRecord::Axis::parts() const
  {
    return highest - lowest > least_change * size
           && std::abs(applied) - std::abs(taken()) > most_difference * size;
  }

  std::string LoadRecord::warning() const
  {
    std::string text;
    for (unsigned int d = 0; d < 3; ++d)
      if (const Axis &axis = axes[d]; axis.parts())
        text += text_of(text.empty() ? "" : " ", "along ", axis_names[d],
                        " the loads came to ", axis.applied, " N at time ",
                        axis.time, " s, but the supports took ", axis.taken(),
                        " N at the most: the difference, ",
                        100. * std::abs(1. - axis.taken() / axis.applied),
                        " %, accelerated the model or was damped, so that the "
                        "applied load is not the resistance of the model.");
    if (!text.empty())
      text += " Load more slowly; beyond a limit load control a displacement, "
              "by 'Load pattern'.";
    return text;
  }

  void LoadRecord::summarise(nlohmann::ordered_json &stage) const
  {
    if (peak.time >= 0.)
      stage["largest load factor"]
          = { { "factor", peak.factor },
              { "controlled displacement [m]", peak.displacement },
              { "time [s]", peak.time } };
    for (unsigned int d = 0; d < 3; ++d)
      if (const Axis &axis = axes[d]; axis.parts())
        stage["supports do not take the loads"][axis_names[d]]
            = { { "applied [N]", axis.applied },
                { "supports [N]", -axis.taken() },
                { "time [s]", axis.time } };
  }

  template <int dim>
  ForceBalance force_balance(const BlockSystem<dim> &system,
                             const State<dim> &state, const double load_time)
  {
    const StageLoads<dim> &loads = system.solver->stage_loads();
    const NodeMap<dim> &nodes    = *system.nodes;
    const TimePoint time{ load_time, state.stage_start + load_time };
    AlignedArray<NodeVector<dim>> force(nodes.n_local(), NodeVector<dim>{});
    for (const NodalLoad<dim> *load : loads.nodal)
      load->add_loads(time, force.data());
    loads.release.add_loads(time, force.data());
    const auto absent = absent_nodes(*system.model, state);
    ForceBalance result;
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      for (unsigned int d = 0; d < dim && !absent[i]; ++d)
      {
        result.applied[d] += force[i].v[d];
        result.size[d] += std::abs(force[i].v[d]);
      }
    for (auto *const sums : { &result.applied, &result.size })
      MPI_Allreduce(MPI_IN_PLACE, sums->data(), 3, MPI_DOUBLE, MPI_SUM,
                    nodes.communicator());
    if (loads.pattern)
    {
      const double factor = state.template get<LoadPatternState>().factor;
      const auto all      = loads.pattern->resultant();
      for (unsigned int d = 0; d < dim; ++d)
      {
        result.applied[d] += factor * all[d];
        result.size[d] += std::abs(factor * all[d]);
      }
    }
    for (const MotionConstraint<dim> *constraint : loads.constraints)
    {
      const auto &traits = constraint->traits();
      const auto forces  = system.solver->resultant(constraint->name());
      for (unsigned int d = 0; d < dim; ++d)
      {
        const bool is_load = traits.is_rigid_body() && !traits.holds[d];
        (is_load ? result.applied : result.supports)[d] += forces[d];
        result.size[d] += is_load ? std::abs(forces[d]) : 0.;
      }
    }
    return result;
  }

  template ForceBalance force_balance(const BlockSystem<2> &, const State<2> &,
                                      double);
  template ForceBalance force_balance(const BlockSystem<3> &, const State<3> &,
                                      double);
} // namespace quoin
