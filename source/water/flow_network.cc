// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/eigen_core.h>
#include <quoin/water/flow_network.h>

#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <utility>

namespace quoin
{
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
                           const std::vector<double> &pressure) const
  {
    const auto [i, j] = channel.nodes;
    return conductance(channel)
           * (pressure[i] - pressure[j]
              + fluid.unit_weight * (elevation[i] - elevation[j]));
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
      if (conditions.is_given[i])
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
      const auto [i, j]        = channel.nodes;
      const long double volume = (long double)(dt * conductance(channel))
                                 * (pressure[i] - pressure[j]
                                    + (long double)(fluid.unit_weight)
                                          * (elevation[i] - elevation[j]));
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
    return result;
  }

  FlowSolution FlowNetwork::transient(const FlowConditions &conditions,
                                      const double dt,
                                      const std::vector<double> &content,
                                      const std::vector<double> &compliance,
                                      const std::vector<double> &guess) const
  {
    const std::vector<double> volume = volumes();
    std::vector<double> storage, known;
    for (unsigned int i = 0; i < n_nodes(); ++i)
    {
      storage.push_back(volume[i] / fluid.bulk_modulus + compliance[i]);
      known.push_back(content[i] - volume[i] + compliance[i] * guess[i]);
    }
    FlowSolution result;
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
