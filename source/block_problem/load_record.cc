// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/model/block_placement.h>
#include <quoin/block_problem/load_record.h>

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
    /** Most means of rows that are kept; an even number. */
    constexpr unsigned int most_means = 512;
    /** Windows of the stage whose means are compared: that many have room, one
        behind the other. */
    constexpr unsigned int n_windows = 10;
    /** Share of the work of a load pattern that damping may take. */
    constexpr double most_damped = 0.05;
    /** Most places on the path of a load pattern that are kept, an even number,
        windows of the path whose means are compared, and the least motion in
        one, by that of all. */
    constexpr unsigned int most_places = 1024, n_path_windows = 20;
    constexpr double least_way = 0.1;
    /** Excess of the largest factor over the largest mean that is warned of. */
    constexpr double most_excess = 0.05;
    /** Pull of a platen, by the largest force that it presses with, and share
        of the rows with more, that is warned of [-]. */
    constexpr double most_pull = 0.05, most_pulling = 0.05;
    /** Pull by the force that it presses with at the same time from which on it
        is a clamp [-], and tension that is nothing [Pa]. */
    constexpr double clamping = 0.8, no_tension = 100.;

    /** Keeps the first of each two of @p rows of @p n numbers. */
    void keep_every_second(const unsigned int n, std::vector<double> &rows)
    {
      const std::size_t left = (rows.size() / n + 1) / 2;
      for (std::size_t i = 0; i < left; ++i)
        std::copy_n(&rows[2 * i * n], n, &rows[i * n]);
      rows.resize(left * n);
    }
  } // namespace

  void LoadRecord::add_factor(const double factor, const double displacement,
                              const double time)
  {
    if (peak.time < 0. || std::abs(factor) > std::abs(peak.factor))
      peak = { factor, displacement, time };
  }

  void LoadRecord::add_work(const double factor, const double unit_work,
                            const double damped, const double kinetic)
  {
    if (pattern.n_rows++ > 0)
    {
      pattern.work
          += 0.5 * (pattern.factor + factor) * (unit_work - pattern.unit_work);
      pattern.loss += damped - pattern.damped;
      pattern.kinetic_gain += kinetic - pattern.kinetic;
    }
    pattern.factor    = factor;
    pattern.unit_work = unit_work;
    pattern.damped    = damped;
    pattern.kinetic   = kinetic;
    if ((pattern.n_rows - 1) % n_per_place != 0)
      return;
    path.push_back(unit_work);
    path.push_back(pattern.work);
    path.push_back(pattern.work - pattern.loss - pattern.kinetic_gain);
    if (path.size() < n_of_place * most_places)
      return;
    keep_every_second(n_of_place, path);
    n_per_place *= 2;
  }

  std::optional<double>
  LoadRecord::largest_mean_factor(const unsigned int column) const
  {
    const std::size_t n     = path.size() / n_of_place;
    const std::size_t width = n / n_path_windows;
    if (width < 2)
      return {};
    const double sign  = peak.factor < 0. ? -1. : 1.;
    const double least = least_way * double(width) / double(n)
                         * std::abs(path[n_of_place * (n - 1)] - path[0]);
    std::optional<double> largest;
    for (std::size_t i = 0; i + width < n; ++i)
    {
      const double *first = &path[n_of_place * i];
      const double *last  = &path[n_of_place * (i + width)];
      const double way    = last[0] - first[0];
      if (!(std::abs(way) > least))
        continue;
      double mean = (last[column] - first[column]) / way;
      // Kinetic energy that a window begins with is no resistance either.
      if (column == work_at_rest)
        mean
            = sign
              * std::min(sign * mean,
                         sign * (last[work_of_all] - first[work_of_all]) / way);
      if (!largest || sign * mean > sign * *largest)
        largest = mean;
    }
    return largest;
  }

  bool LoadRecord::has_spike() const
  {
    const auto mean   = largest_mean_factor(work_at_rest);
    const double sign = peak.factor < 0. ? -1. : 1.;
    return mean && sign * peak.factor > (1. + most_excess) * sign * *mean;
  }

  void LoadRecord::add_forces(const ForceBalance &forces, const double time,
                              const bool to_means)
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
    if (!to_means)
      return;
    sum[0] += time;
    for (unsigned int d = 0; d < 3; ++d)
    {
      sum[1 + d] += applied[d];
      sum[4 + d] += supports[d];
    }
    if (++n_summed < n_per_mean)
      return;
    for (double &value : sum)
      means.push_back(value / n_per_mean);
    sum.assign(n_numbers, 0.);
    n_summed = 0;
    if (means.size() < n_numbers * most_means)
      return;
    for (unsigned int i = 0; i < most_means / 2; ++i)
      for (unsigned int k = 0; k < n_numbers; ++k)
        means[n_numbers * i + k] = 0.5
                                   * (means[n_numbers * 2 * i + k]
                                      + means[n_numbers * (2 * i + 1) + k]);
    means.resize(n_numbers * most_means / 2);
    n_per_mean *= 2;
  }

  template <int dim>
  void LoadRecord::add_bearing(const std::string &name,
                               const PlatenBearing<dim> &bearing,
                               const double time)
  {
    auto found = std::find_if(pulls.begin(), pulls.end(),
                              [&](const PlatenPull &pull)
                              { return pull.name == name; });
    if (found == pulls.end())
    {
      found       = pulls.insert(pulls.end(), PlatenPull());
      found->name = name;
    }
    PlatenPull &pull = *found;
    ++pull.n_rows;
    pull.pressed = std::max(pull.pressed, bearing.pressed);
    if (!(bearing.pulled > most_pull * pull.pressed
          && bearing.pulled < clamping * bearing.pressed
          && bearing.tension > no_tension))
      return;
    ++pull.n_pulling;
    if (bearing.pulled <= pull.pulled)
      return;
    pull.pulled  = bearing.pulled;
    pull.tension = bearing.tension;
    pull.place.assign(bearing.place.begin_raw(), bearing.place.end_raw());
    pull.time = time;
  }
  template void LoadRecord::add_bearing(const std::string &,
                                        const PlatenBearing<2> &, double);
  template void LoadRecord::add_bearing(const std::string &,
                                        const PlatenBearing<3> &, double);

  double LoadRecord::Axis::taken() const
  {
    return applied > 0. ? most_down : -most_up;
  }

  std::optional<LoadRecord::Lack>
  LoadRecord::lack_of_means(const unsigned int d) const
  {
    const std::size_t n     = means.size() / n_numbers;
    const std::size_t width = n / n_windows;
    if (width < 2)
      return {};
    const double sign = axes[d].applied > 0. ? 1. : -1.;
    Lack most{ 0., 0., 0., true };
    for (std::size_t begin = 0; begin + width <= n; ++begin)
    {
      double time = 0., applied = 0., taken = 0.;
      for (std::size_t i = begin; i < begin + width; ++i)
      {
        const double *row = &means[n_numbers * i];
        time += row[0] / double(width);
        applied += row[1 + d] / double(width);
        taken -= row[4 + d] / double(width);
      }
      most.taken = sign * std::max(sign * most.taken, sign * taken);
      if (sign * applied < sign * most.applied)
        continue;
      most.applied = applied;
      most.time    = time;
    }
    return most;
  }

  std::optional<LoadRecord::Lack> LoadRecord::lack(const unsigned int d) const
  {
    const Axis &axis = axes[d];
    if (!(axis.highest - axis.lowest > least_change * axis.size))
      return {};
    const Lack of_rows{ axis.applied, axis.taken(), axis.time, false };
    for (const auto &found : { std::optional(of_rows), lack_of_means(d) })
      if (found
          && std::abs(found->applied) - std::abs(found->taken)
                 > most_difference * axis.size)
        return found;
    return {};
  }

  std::string LoadRecord::warning() const
  {
    std::string text;
    for (unsigned int d = 0; d < 3; ++d)
      if (const auto found = lack(d))
        text += text_of(
            text.empty() ? "" : " ", "along ", axis_names[d],
            " the loads came to ", found->applied, " N at time ", found->time,
            " s, but the supports took ", found->taken, " N at the most",
            found->is_of_means ? ", by means over a tenth of the stage" : "",
            ": the difference, ",
            100. * std::abs(1. - found->taken / found->applied),
            " %, accelerated the model or was damped, so that the applied load "
            "is not the resistance of the model.");
    if (!text.empty())
      text += pattern.n_rows > 0
                  ? " Push more slowly."
                  : " Load more slowly; beyond a limit load control a "
                    "displacement, by 'Load pattern'.";
    if (damped_share() > most_damped)
      text += text_of(
          text.empty() ? "" : " ", "damping took ", 100. * damped_share(),
          " % of the work of the load pattern, so that its factor is larger by "
          "about as much than what the model bears at rest. Push more slowly, "
          "take 'Damping = Rayleigh' with a stiffness coefficient, or 'Solver "
          "= implicit', and compare.");
    if (has_spike())
      text += text_of(
          text.empty() ? "" : " ", "the largest load factor, ", peak.factor,
          " at time ", peak.time, " s, is ",
          100. * (peak.factor / *largest_mean_factor(work_at_rest) - 1.),
          " % above ", *largest_mean_factor(work_at_rest),
          ", the largest mean over a twentieth of the stage of what motion and "
          "damping did not take: unless strength is lost as quickly, the model "
          "bore the rest by inertia or damping, as it vibrates, jumps or sets "
          "parts in motion that the control does not hold. That mean is nearer "
          "to what "
          "it bears at rest; push more slowly and compare.");
    for (const PlatenPull &pull : pulls)
      if (pull.pulled > most_pull * pull.pressed
          && pull.n_pulling >= most_pulling * pull.n_rows)
      {
        std::string place;
        for (const double x : pull.place)
          place += (place.empty() ? "" : ", ") + number_text(x);
        text += text_of(
            text.empty() ? "" : " ", "the platen ", pull.name,
            " pulled its boundary with up to ", pull.tension, " Pa, at (",
            place, ") m and time ", pull.time, " s, with ", pull.pulled,
            " N in all, where it presses with ", pull.pressed,
            " N at the most: a platen on a 'Boundary' is glued to it, while a "
            "plate that only lies there would open. For such a plate lay a "
            "block on the boundary, with a joint without cohesion and tensile "
            "strength below it, and give the platen its 'Group'; let the "
            "platen be if it is bonded.");
      }
    return text;
  }

  void LoadRecord::summarise(nlohmann::ordered_json &stage) const
  {
    if (peak.time >= 0.)
      stage["largest load factor"]
          = { { "factor", peak.factor },
              { "controlled displacement [m]", peak.displacement },
              { "time [s]", peak.time } };
    if (const auto mean = largest_mean_factor(work_of_all))
      stage["largest load factor"]["mean over a twentieth of the stage"]
          = *mean;
    if (const auto mean = largest_mean_factor(work_at_rest))
      stage["largest load factor"]["mean without inertia and damping"] = *mean;
    if (pattern.n_rows > 1)
      stage["damping by work of the load pattern"] = damped_share();
    for (unsigned int d = 0; d < 3; ++d)
      if (const auto found = lack(d))
        stage["supports do not take the loads"][axis_names[d]]
            = { { "applied [N]", found->applied },
                { "supports [N]", -found->taken },
                { "time [s]", found->time } };
    for (const PlatenPull &pull : pulls)
      if (pull.pulled > 0.)
        stage["platens that pull"][pull.name]
            = { { "tension [Pa]", pull.tension },
                { "place [m]", pull.place },
                { "pulled [N]", pull.pulled },
                { "largest pressing [N]", pull.pressed },
                { "time [s]", pull.time } };
  }

  namespace
  {
    /** Adds the loads on @p beams that are placed, and what holds their ends.
     */
    void add_beams(const Beams &beams, const State<2> &state,
                   const TimePoint &time, ForceBalance &result)
    {
      const BeamState &now = state.get<BeamState>();
      for (std::size_t b = 0; b < beams.all().size(); ++b)
      {
        if (!now.placed[b])
          continue;
        const BeamLine &line = beams.all()[b].line;
        const auto loads     = beams.node_loads(b, time);
        for (unsigned int i = line.begin; i < line.end; ++i)
          for (unsigned int d = 0; d < 2; ++d)
          {
            result.applied[d] += loads[i - line.begin][d];
            result.size[d] += std::abs(loads[i - line.begin][d]);
            if (line.held(i, d))
              result.supports[d] -= beams.node_forces()[i][d];
          }
      }
    }
  } // namespace

  template <int dim>
  ForceBalance force_balance(const BlockSystem<dim> &system,
                             const State<dim> &state, const double load_time)
  {
    const StageLoads<dim> &loads = system.solver->stage_loads();
    const NodeMap<dim> &nodes    = *system.nodes;
    const TimePoint time{ load_time, state.load_start() + load_time };
    AlignedArray<dealii::Tensor<1, dim>> force(nodes.n_local(),
                                               dealii::Tensor<1, dim>());
    for (const NodalLoad<dim> *load : loads.nodal)
      load->add_loads(time, force.data());
    loads.release.add_loads(time, force.data());
    loads.arrival.add_loads(time, force.data());
    const auto absent = absent_nodes(*system.model, state);
    ForceBalance result;
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      for (unsigned int d = 0; d < dim && !absent[i]; ++d)
      {
        result.applied[d] += force[i][d];
        result.size[d] += std::abs(force[i][d]);
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
    if constexpr (dim == 2)
      if (loads.beams)
        add_beams(*loads.beams, state, time, result);
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
