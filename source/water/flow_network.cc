// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/water/flow_network.h>

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace quoin
{
  namespace
  {
    /** Share of the flow that joints of the saturation @p s carry. */
    double carried(const double s)
    {
      return s * s * (3. - 2. * s);
    }
  } // namespace

  FlowNetwork::FlowNetwork(const Fluid &fluid,
                           const std::vector<double> &elevation,
                           const std::vector<FlowChannel> &channels)
    : fluid(fluid), elevation(elevation), all_channels(channels)
  {
  }

  double FlowNetwork::conductance(const FlowChannel &channel) const
  {
    // The integral of ds / a^3 over a linearly varying aperture.
    const auto [a, b]   = channel.aperture;
    const double length = channel.length * (a + b) / (2. * a * a * b * b);
    return channel.is_open
               ? channel.thickness / (12. * fluid.viscosity * length)
               : 0.;
  }

  double FlowNetwork::flow(const FlowChannel &channel,
                           const FlowSolution &solution) const
  {
    const double full = conductance(channel) * drop(channel, solution.pressure);
    return carried(solution.saturation[channel.nodes[full > 0. ? 0 : 1]])
           * full;
  }

  std::vector<double> FlowNetwork::volumes() const
  {
    std::vector<double> result(n_nodes(), 0.);
    for (const FlowChannel &channel : all_channels)
      for (unsigned int k = 0; channel.is_open && k < 2; ++k)
        result[channel.nodes[k]]
            += channel.thickness * channel.length / 6.
               * (2. * channel.aperture[k] + channel.aperture[1 - k]);
    return result;
  }

  std::vector<double>
  FlowNetwork::contents(const std::vector<double> &pressure) const
  {
    std::vector<double> result = volumes();
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] *= 1. + pressure[i] / fluid.bulk_modulus;
    return result;
  }

  std::vector<std::uint8_t>
  FlowNetwork::unconnected_nodes(const FlowConditions &conditions) const
  {
    DisjointSets parts(n_nodes());
    for (const FlowChannel &channel : all_channels)
      if (channel.is_open)
        parts.unite(channel.nodes[0], channel.nodes[1]);
    std::vector<std::uint8_t> is_connected(n_nodes(), 0), result;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (conditions.is_given[i] || conditions.is_outlet[i])
        is_connected[parts.find(i)] = 1;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      result.push_back(!is_connected[parts.find(i)]);
    return result;
  }

  std::vector<double> FlowNetwork::outflow(const Pressures &pressure,
                                           const double dt) const
  {
    Pressures sum(n_nodes(), 0.);
    for (const FlowChannel &channel : all_channels)
    {
      const auto [i, j] = channel.nodes;
      const long double volume
          = (long double)(dt * conductance(channel)) * drop(channel, pressure);
      sum[i] += volume;
      sum[j] -= volume;
    }
    return { sum.begin(), sum.end() };
  }

  FlowNetwork::Pressures
  FlowNetwork::solve(const FlowConditions &conditions, const double dt,
                     const std::vector<double> &storage,
                     const std::vector<double> &known) const
  {
    Pressures pressure(n_nodes(), 0.);
    std::vector<int> row(n_nodes(), -1);
    int n = 0;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (conditions.is_given[i])
        pressure[i] = conditions.pressure[i];
      else
        row[i] = n++;
    if (n == 0)
      return pressure;

    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> diagonal(n_nodes(), 0.);
    for (const FlowChannel &channel : all_channels)
    {
      const auto [i, j]  = channel.nodes;
      const double value = dt * conductance(channel);
      diagonal[i] += value;
      diagonal[j] += value;
      if (row[i] < 0 || row[j] < 0 || value == 0.)
        continue;
      entries.emplace_back(row[i], row[j], -value);
      entries.emplace_back(row[j], row[i], -value);
    }
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (row[i] >= 0)
      {
        // A node that has neither flow nor storage keeps the pressure 0.
        const double value = diagonal[i] + storage[i];
        entries.emplace_back(row[i], row[i], value > 0. ? value : 1.);
      }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);

    // Later passes take off what rounding left in the first one.
    for (unsigned int pass = 0; pass < 4; ++pass)
    {
      const std::vector<double> out = outflow(pressure, dt);
      Eigen::VectorXd lacking(n);
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (row[i] >= 0)
          lacking[row[i]] = diagonal[i] + storage[i] > 0.
                                ? known[i] + dt * conditions.source[i]
                                      - double(storage[i] * pressure[i])
                                      - out[i]
                                : 0.;
      const Eigen::VectorXd correction = factors.solve(lacking);
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (row[i] >= 0)
          pressure[i] += correction[row[i]];
    }
    return pressure;
  }

  FlowSolution FlowNetwork::steady(const FlowConditions &given) const
  {
    FlowConditions conditions = given;
    const auto unconnected    = unconnected_nodes(given);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (unconnected[i])
      {
        conditions.is_given[i] = 1;
        conditions.pressure[i] = -fluid.unit_weight * elevation[i];
      }
    const std::vector<double> nothing(n_nodes(), 0.);
    FlowSolution result;
    const Pressures pressure = solve(conditions, 1., nothing, nothing);
    const auto out           = outflow(pressure, 1.);
    result.pressure.assign(pressure.begin(), pressure.end());
    for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      if (unconnected[i])
        result.pressure[i] = 0.;
      result.inflow.push_back(conditions.is_given[i]
                                  ? (unconnected[i] ? 0. : out[i])
                                  : conditions.source[i]);
      result.residual += result.inflow.back();
    }
    result.content = contents(result.pressure);
    result.saturation.assign(n_nodes(), 1.);
    return result;
  }

  FlowSolution FlowNetwork::transient(const FlowConditions &conditions,
                                      const double dt,
                                      const std::vector<double> &content,
                                      const std::vector<double> &compliance,
                                      const std::vector<double> &guess) const
  {
    FlowSolution result;
    if (fluid.has_free_surface)
    {
      const std::vector<double> all = volumes();
      return fill_in_parts(conditions, dt, content, compliance, guess,
                           1e-9 * std::accumulate(all.begin(), all.end(), 0.));
    }
    result.saturation.assign(n_nodes(), 1.);
    const std::vector<double> volume = volumes();
    std::vector<double> storage, known;
    for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      storage.push_back(volume[i] / fluid.bulk_modulus + compliance[i]);
      known.push_back(content[i] - volume[i] + compliance[i] * guess[i]);
    }
    const Pressures pressure = solve(conditions, dt, storage, known);
    result.pressure.assign(pressure.begin(), pressure.end());
    result.content = contents(result.pressure);
    const auto out = outflow(pressure, dt);
    for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      // Without a given pressure the content follows from the flow: none is
      // lost where volumes are not yet in balance with pressures.
      if (!conditions.is_given[i])
        result.content[i] = content[i] + dt * conditions.source[i] - out[i];
      result.inflow.push_back(conditions.is_given[i]
                                  ? result.content[i] - content[i] + out[i]
                                  : dt * conditions.source[i]);
      result.residual
          += result.inflow.back() - (result.content[i] - content[i]);
    }
    return result;
  }

  bool FlowNetwork::fill(const FlowConditions &conditions, const double dt,
                         const std::vector<double> &content,
                         const std::vector<double> &compliance,
                         const std::vector<double> &guess,
                         const double most_left, FlowSolution &result) const
  {
    constexpr unsigned int most_iterations = 60;
    // The unknown of a node is its pressure where that is positive; where it is
    // negative the node is filled in part, to 1 at 0 and to 0 at -scale. At an
    // outlet water leaves by a positive one.
    const std::vector<double> volume = volumes();
    double scale                     = 1.; // [Pa]
    std::vector<double> conducts(n_nodes(), 0.);
    for (const FlowChannel &channel : all_channels)
      for (const unsigned int i : channel.nodes)
      {
        conducts[i] += dt * conductance(channel);
        scale = std::max({ scale, conditions.pressure[i],
                           fluid.unit_weight * channel.length });
      }
    const auto is_known = [&](const unsigned int i)
    { return conditions.is_given[i] || volume[i] == 0.; };
    std::vector<int> row(n_nodes(), -1);
    int n = 0;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (!is_known(i))
        row[i] = n++;

    struct Filling
    {
      Pressures pressure, lacking;
      std::vector<double> saturation, factor, slope;
      double error = 0.; /**< sum of what is lacking [m^3] */
    };
    double flows        = 0.; // [m^3], to which the error is compared
    const auto evaluate = [&](const Pressures &unknown, Filling &at)
    {
      at.pressure.assign(n_nodes(), 0.);
      at.saturation.assign(n_nodes(), 1.);
      at.factor.assign(n_nodes(), 1.);
      at.slope.assign(n_nodes(), 0.); // of the factor by the unknown
      at.lacking.assign(n_nodes(), 0.);
      flows = 0.;
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (is_known(i))
          at.pressure[i] = conditions.is_given[i] ? conditions.pressure[i] : 0.;
        else
        {
          if (!conditions.is_outlet[i])
            at.pressure[i] = std::max(unknown[i], 0.L);
          const double s
              = std::min(1., std::max(0., 1. + double(unknown[i]) / scale));
          at.saturation[i] = s;
          at.factor[i]     = carried(s);
          if (unknown[i] < 0. && s > 0.)
            at.slope[i] = 6. * s * (1. - s) / scale;
          at.lacking[i]
              = content[i] + dt * conditions.source[i]
                - s
                      * (volume[i] * (1. + at.pressure[i] / fluid.bulk_modulus)
                         + compliance[i] * (at.pressure[i] - guess[i]));
          if (conditions.is_outlet[i])
            at.lacking[i] -= conducts[i] * std::max(unknown[i], 0.L);
          flows += std::abs(content[i] - s * volume[i])
                   + dt * std::abs(conditions.source[i]);
        }
      for (const FlowChannel &channel : all_channels)
      {
        const auto [i, j] = channel.nodes;
        const double drive
            = dt * conductance(channel) * drop(channel, at.pressure);
        const long double passes
            = (drive > 0. ? at.factor[i] : at.factor[j]) * drive;
        at.lacking[i] -= passes;
        at.lacking[j] += passes;
        flows += std::abs(passes);
      }
      at.error = 0.;
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (row[i] >= 0)
          at.error += std::abs(at.lacking[i]);
    };

    Pressures unknown(n_nodes(), 0.);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (row[i] >= 0)
      {
        const double s = content[i] / volume[i];
        unknown[i]     = s < 1. ? scale * (s - 1.) : std::max(0., guess[i]);
      }
    Filling at, trial;
    evaluate(unknown, at);
    bool is_found = n == 0;
    for (unsigned int iteration = 0; !is_found; ++iteration)
    {
      if (iteration == most_iterations)
        return false;
      std::vector<Eigen::Triplet<double>> entries;
      const auto enter
          = [&](const unsigned int i, const unsigned int j, const double value)
      {
        if (row[i] >= 0 && row[j] >= 0 && value != 0.)
          entries.emplace_back(row[i], row[j], value);
      };
      std::vector<double> diagonal(n_nodes(), 0.);
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (row[i] >= 0)
          diagonal[i] = unknown[i] < 0. ? volume[i] / scale
                        : conditions.is_outlet[i]
                            ? conducts[i]
                            : volume[i] / fluid.bulk_modulus + compliance[i];
      for (const FlowChannel &channel : all_channels)
      {
        const double k = dt * conductance(channel);
        if (k == 0.)
          continue;
        const auto [i, j]       = channel.nodes;
        const double drive      = k * drop(channel, at.pressure);
        const unsigned int from = drive > 0. ? i : j, to = drive > 0. ? j : i;
        const double size = std::abs(drive);
        // By the pressure of either end, and by the filling of that above.
        const double by_from = (row[from] >= 0 && unknown[from] > 0.
                                        && !conditions.is_outlet[from]
                                    ? at.factor[from] * k
                                    : 0.)
                               + at.slope[from] * size;
        const double by_to
            = row[to] >= 0 && unknown[to] > 0. && !conditions.is_outlet[to]
                  ? at.factor[from] * k
                  : 0.;
        diagonal[from] += by_from;
        diagonal[to] += by_to;
        enter(from, to, -by_to);
        enter(to, from, -by_from);
      }
      for (unsigned int i = 0; i < n_nodes(); ++i)
        enter(i, i, diagonal[i]);
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      Eigen::VectorXd lacking(n);
      for (unsigned int i = 0; i < n_nodes(); ++i)
        if (row[i] >= 0)
          lacking[row[i]] = at.lacking[i];
      Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(matrix);
      if (factors.info() != Eigen::Success)
        return false;
      const Eigen::VectorXd change = factors.solve(lacking);
      const double error           = at.error;
      Pressures best               = unknown;
      double share                 = 1.;
      for (unsigned int halving = 0; halving < 8; ++halving, share *= 0.5)
      {
        Pressures next = unknown;
        for (unsigned int i = 0; i < n_nodes(); ++i)
          if (row[i] >= 0)
            next[i] = std::max<long double>(
                -scale, unknown[i] + share * change[row[i]]);
        evaluate(next, trial);
        if (halving == 0 || trial.error < at.error)
        {
          best = next;
          std::swap(at, trial);
        }
        if (at.error < error)
          break;
      }
      unknown = best;
      // Beside a wide crack rounding leaves more.
      is_found = at.error <= 1e-13 * flows
                 || (at.error <= std::min(1e-6 * flows, most_left)
                     && at.error > 0.5 * error);
    }

    result.pressure.assign(at.pressure.begin(), at.pressure.end());
    result.saturation = at.saturation;
    result.content.assign(n_nodes(), 0.);
    result.inflow.assign(n_nodes(), 0.);
    result.residual = 0.;
    for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      // What Newton's method leaves over stays in the node.
      if (row[i] >= 0)
      {
        const double leaves
            = conditions.is_outlet[i]
                  ? conducts[i] * double(std::max(unknown[i], 0.L))
                  : 0.;
        result.inflow[i] = dt * conditions.source[i] - leaves;
        result.content[i]
            = at.saturation[i]
                  * (volume[i] * (1. + at.pressure[i] / fluid.bulk_modulus)
                     + compliance[i] * (at.pressure[i] - guess[i]))
              + at.lacking[i];
      }
      else if (conditions.is_given[i])
      {
        result.content[i]
            = volume[i] * (1. + at.pressure[i] / fluid.bulk_modulus);
        result.inflow[i] = result.content[i] - content[i] - at.lacking[i];
      }
      result.residual += result.inflow[i] - (result.content[i] - content[i]);
    }
    return true;
  }

  FlowSolution FlowNetwork::fill_in_parts(const FlowConditions &conditions,
                                          const double dt,
                                          const std::vector<double> &content,
                                          const std::vector<double> &compliance,
                                          const std::vector<double> &guess,
                                          const double most_left) const
  {
    constexpr unsigned int most_failures = 60;
    unsigned int n_failures              = 0;
    FlowSolution result, part;
    result.content     = content;
    result.inflow      = std::vector<double>(n_nodes(), 0.);
    double part_length = dt;
    for (double done = 0.; done < dt;)
    {
      part_length = std::min(part_length, dt - done);
      if (!fill(conditions, part_length, result.content, compliance, guess,
                most_left, part))
      {
        if (++n_failures > most_failures)
          throw RunError("section 'Water': the flow with a free surface is not "
                         "found, however short the step. Check the apertures "
                         "and what 'Water boundaries' give.");
        part_length *= 0.25;
        continue;
      }
      done = part_length < dt - done ? done + part_length : dt;
      part_length *= 2.;
      for (unsigned int i = 0; i < n_nodes(); ++i)
        part.inflow[i] += result.inflow[i];
      part.residual += result.residual;
      result = part;
    }
    return result;
  }

  FlowSolution FlowNetwork::steady(const FlowConditions &conditions,
                                   const std::vector<double> &content) const
  {
    // Steps that grow until nothing moves any more. The first one moves about
    // as much as a node holds.
    const std::vector<double> volume = volumes(), nothing(n_nodes(), 0.);
    double largest                   = 0.;
    for (const FlowChannel &channel : all_channels)
      for (const unsigned int i : channel.nodes)
        largest = std::max(largest, conditions.pressure[i]);
    double dt = std::numeric_limits<double>::max();
    for (const FlowChannel &channel : all_channels)
      if (const double fastest
          = conductance(channel)
            * (largest + fluid.unit_weight * channel.length);
          fastest > 0.)
        for (const unsigned int i : channel.nodes)
          dt = std::min(dt, volume[i] / fastest);
    if (dt == std::numeric_limits<double>::max())
      dt = 1.;
    constexpr unsigned int most_steps = 60;
    std::vector<double> held          = content, pressure(n_nodes(), 0.);
    for (unsigned int step = 0; step < most_steps; ++step, dt *= 3.)
    {
      FlowSolution result
          = fill_in_parts(conditions, dt, held, nothing, pressure,
                          std::numeric_limits<double>::max());
      // In long steps what Newton's method leaves over is more than a node
      // holds: it does not stay there.
      std::vector<double> holds = contents(result.pressure);
      double moved = 0., passes = 0., stored = 0.;
      for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        holds[i] *= result.saturation[i];
        moved += std::abs(holds[i] - held[i]);
        stored += volume[i];
        passes += std::abs(result.inflow[i]);
      }
      held     = holds;
      pressure = result.pressure;
      if (moved <= 1e-12 * passes
          || (passes <= 1e-12 * stored && moved <= 1e-9 * stored))
      {
        for (double &inflow : result.inflow)
          inflow /= dt;
        result.content = holds;
        result.residual
            = std::accumulate(result.inflow.begin(), result.inflow.end(), 0.);
        return result;
      }
    }
    throw RunError("section 'Water': the flow with a free surface does not "
                   "become steady. Take 'Flow = transient', and see whether "
                   "water has a way out.");
  }

  std::vector<double>
  FixedPointAcceleration::next(const std::vector<double> &x,
                               const std::vector<double> &value)
  {
    const std::size_t n = x.size();
    std::vector<double> residual(n), result = value;
    for (std::size_t i = 0; i < n; ++i)
      residual[i] = value[i] - x[i];
    residuals.push_back(residual);
    values.push_back(value);
    if (values.size() > depth)
    {
      values.erase(values.begin());
      residuals.erase(residuals.begin());
    }
    const std::size_t m = values.size() - 1;
    if (m == 0)
      return result;
    Eigen::MatrixXd changes(n, m);
    Eigen::VectorXd last(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      last[i] = residual[i];
      for (std::size_t k = 0; k < m; ++k)
        changes(i, k) = residuals[k + 1][i] - residuals[k][i];
    }
    const Eigen::VectorXd weights = changes.colPivHouseholderQr().solve(last);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < m; ++k)
        result[i] -= weights[k] * (values[k + 1][i] - values[k][i]);
    return result;
  }
} // namespace quoin
