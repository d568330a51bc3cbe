// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_water_flow_network_h
#define quoin_water_flow_network_h

#include <array>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** Water in joints. */
  struct Fluid
  {
    double viscosity    = 1e-3;  /**< dynamic [Pa s] */
    double unit_weight  = 9810.; /**< [N/m^3] */
    double bulk_modulus = 2.2e9; /**< [Pa] */
    /** Whether joints can be partly filled; otherwise they are full. */
    bool has_free_surface = false;
  };

  /** A piece of a joint between two nodes of a FlowNetwork, whose aperture
      varies linearly between its ends. */
  struct FlowChannel
  {
    std::array<unsigned int, 2> nodes;
    double length;                  /**< [m] */
    double thickness;               /**< out of the plane [m] */
    std::array<double, 2> aperture; /**< at either end, positive [m] */
    bool is_open = true; /**< false: no flow, no volume, as if not there */
  };

  /** What is given at the nodes of a FlowNetwork. */
  struct FlowConditions
  {
    std::vector<std::uint8_t> is_given; /**< 1: the pressure is */
    std::vector<double> pressure;       /**< where it is given [Pa] */
    std::vector<double> source;         /**< elsewhere, into the node [m^3/s] */
    /** With a free surface, 1: at pressure 0 water leaves here, none enters. */
    std::vector<std::uint8_t> is_outlet;

    explicit FlowConditions(const std::size_t n_nodes)
      : is_given(n_nodes, 0), pressure(n_nodes, 0.), source(n_nodes, 0.),
        is_outlet(n_nodes, 0)
    {
    }
  };

  /** Pressures, and the volumes of water that enter and are stored over a time.
   */
  struct FlowSolution
  {
    std::vector<double> pressure;   /**< of each node [Pa] */
    std::vector<double> saturation; /**< filled share of each node [-] */
    std::vector<double> inflow;  /**< volume into each node from outside [m^3]
                                  */
    std::vector<double> content; /**< volume of water at each node, as it is
                                    without pressure [m^3] */
    /** Inflow less what is stored, of all nodes [m^3]. */
    double residual = 0.;
  };

  /**
   * One-dimensional flow of water in a network of channels by the cubic law,
   * q = t a^3 / (12 mu) (- d(p + gamma y)/ds), exact for linearly varying
   * aperture (@cite WitherspoonWangIwaiGale1980). Water is stored at the nodes:
   * the content V (1 + p/K_w) of the volume V of half of the channels that meet
   * there. No mesh: nodes have an elevation alone.
   *
   * With a free surface a node may be filled in part, to the saturation s. Its
   * pressure is 0 then, its content s V, and what flows from it is less by the
   * factor s^2 (3 - 2 s), 1 where it is full and 0 where it is empty
   * (@cite Itasca2011). Air is everywhere at the pressure 0.
   */
  class FlowNetwork
  {
  public:
    FlowNetwork() = default;
    FlowNetwork(const Fluid &fluid, const std::vector<double> &elevation,
                const std::vector<FlowChannel> &channels);

    unsigned int n_nodes() const
    {
      return elevation.size();
    }
    const std::vector<FlowChannel> &channels() const
    {
      return all_channels;
    }
    std::vector<FlowChannel> &channels()
    {
      return all_channels;
    }

    /** Flow by pressure difference [m^3/(s Pa)]. */
    double conductance(const FlowChannel &channel) const;
    /** Flow of @p channel from its first to its second node [m^3/s] with the
        pressures and saturations of @p solution. */
    double flow(const FlowChannel &channel, const FlowSolution &solution) const;
    /** Volume of the channels at each node, weighted as nodal forces of a
        linearly varying pressure are [m^3]. */
    std::vector<double> volumes() const;
    /** Content of the nodes at @p pressure [m^3]. */
    std::vector<double> contents(const std::vector<double> &pressure) const;

    /**
     * Parts of the network that no open channel connects with a node of given
     * pressure: 1 for each of their nodes.
     */
    std::vector<std::uint8_t>
    unconnected_nodes(const FlowConditions &conditions) const;

    /** Steady flow, with the volumes of a second. Nodes without connection to a
        given pressure have none, 0. */
    FlowSolution steady(const FlowConditions &conditions) const;

    /** That with a free surface, to which the water @p content comes in time:
        what has no way out stays. Throws a RunError if it does not. */
    FlowSolution steady(const FlowConditions &conditions,
                        const std::vector<double> &content) const;

    /**
     * A step of @p dt [s] from @p content by backward Euler, with the apertures
     * at its end. @p compliance [m^3/Pa] of the nodes: by how much volumes are
     * expected to grow with the pressure above @p guess, which lets an
     * iteration with the deformation converge; 0: volumes are those given.
     */
    FlowSolution transient(const FlowConditions &conditions, double dt,
                           const std::vector<double> &content,
                           const std::vector<double> &compliance,
                           const std::vector<double> &guess) const;

  private:
    /** Beside a crack, whose resistance is 1e-9 of that of a closed joint, the
        differences of its pressures are below the rounding of a double. */
    using Pressures = std::vector<long double>;

    /** By how much p + gamma y is larger at the first node of @p channel [Pa].
     */
    template <typename Vector>
    typename Vector::value_type drop(const FlowChannel &channel,
                                     const Vector &pressure) const
    {
      const auto [i, j] = channel.nodes;
      return pressure[i] - pressure[j] +
             typename Vector::value_type(fluid.unit_weight)
                 * (elevation[i] - elevation[j]);
    }

    /** Solves storage p + dt (flow out) = known + dt source at nodes whose
        pressure is not given. */
    Pressures solve(const FlowConditions &conditions, double dt,
                    const std::vector<double> &storage,
                    const std::vector<double> &known) const;
    /** A step with a free surface by Newton's method; false: it does not
        converge, or leaves more than @p most_left [m^3] that rounding does not
        let it place. Other arguments: see transient(). */
    bool fill(const FlowConditions &conditions, double dt,
              const std::vector<double> &content,
              const std::vector<double> &compliance,
              const std::vector<double> &guess, double most_left,
              FlowSolution &result) const;
    /** Does fill() in parts of @p dt that are as short as they must be; @p
        guess serves all of them. Throws a RunError. */
    FlowSolution fill_in_parts(const FlowConditions &conditions, double dt,
                               const std::vector<double> &content,
                               const std::vector<double> &compliance,
                               const std::vector<double> &guess,
                               double most_left) const;
    /** Volume that leaves each node through its channels [m^3]. */
    std::vector<double> outflow(const Pressures &pressure, double dt) const;

    Fluid fluid;
    std::vector<double> elevation; /**< [m] */
    std::vector<FlowChannel> all_channels;
  };

  /**
   * Anderson's acceleration of a fixed-point iteration x = g(x): the next x is
   * the combination of the last g(x) whose residuals g(x) - x cancel best
   * (@cite WalkerNi2011).
   */
  class FixedPointAcceleration
  {
  public:
    /** The next x after @p x and @p value = g(x). */
    std::vector<double> next(const std::vector<double> &x,
                             const std::vector<double> &value);
    void clear()
    {
      residuals.clear();
      values.clear();
    }

  private:
    static constexpr std::size_t depth = 8;
    std::vector<std::vector<double>> residuals, values;
  };
} // namespace quoin

#endif
