// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_absorbing_plane_waves_h
#define quoin_absorbing_plane_waves_h

#include <quoin/loads/load_parameters.h>
#include <quoin/absorbing/viscous_boundary.h>

#include <vector>

namespace quoin
{
  /**
   * Plane waves of any direction in an elastic medium in three dimensions, with
   * those that a free horizontal surface above it reflects @cite
   * AkiRichards2002. Each has the velocity a g(t - s (x - x0)) with the
   * amplitude a, the slowness s, the velocity g of its signal and the origin
   * x0.
   *
   * The polarisations of the incident P, SV and SH wave are the direction d of
   * propagation, p_SH x d, and p_SH, which is horizontal, to the left of d; for
   * a vertical d it is y. So SV and SH waves that rise vertically move along x
   * and y.
   */
  class PlaneWaves
  {
  public:
    struct Component
    {
      unsigned int signal;            /**< 0: P, 1: SV, 2: SH */
      dealii::Tensor<1, 3> amplitude; /**< [-] */
      dealii::Tensor<1, 3> slowness;  /**< [s/m] */
      double delay;                   /**< added to s (x - x0) [s] */
    };

    /**
     * Waves of the unit vector @p direction in a medium of @p impedance.
     * Throws an InputError that begins with the section of @p load: an SV wave
     * that meets the surface at more than the critical angle, a wave that does
     * not rise to it.
     */
    PlaneWaves(const LoadParameters &load, const Impedance &impedance);

    /** The waves of all signals that are given. */
    const std::vector<Component> &components() const
    {
      return waves;
    }

    /** By which time the signal arrives at @p x later than at the origin [s].
     */
    double arrival(const Component &wave, const dealii::Point<3> &x) const;

    /**
     * Traction [Pa] on an area with the outward normal @p n by the velocity 1
     * m/s of the signal of @p wave: that of the stress of the wave, and that of
     * a dashpot which moves with it.
     */
    dealii::Tensor<1, 3> traction(const Component &wave,
                                  const dealii::Tensor<1, 3> &n) const;

  private:
    /** Traction of the stress of @p wave alone. */
    dealii::Tensor<1, 3> stress_vector(const Component &wave,
                                       const dealii::Tensor<1, 3> &n) const;
    /** Adds what the free surface makes of @p incident. */
    void reflect(const Component &incident, const LoadParameters &load);

    Impedance impedance;
    double speed[2];   /**< of P and S waves [m/s] */
    double lambda, mu; /**< [Pa] */
    dealii::Tensor<1, 3> direction, across;
    dealii::Point<3> origin;
    std::vector<Component> waves;
  };

  /**
   * Gives the @p loads with a direction of plane waves but without an origin
   * one in common with all others of this direction: the place of their
   * boundaries that the waves reach first. Collective.
   */
  void find_wave_origins(const NodeMap<3> &node_map,
                         std::vector<LoadParameters> &loads);

  /** What plane waves do to the nodes of a viscous boundary. */
  class PlaneWaveForces
  {
  public:
    /**
     * Takes the waves of @p load on the local nodes @p nodes (ascending) of the
     * @p faces; @p impedance: beyond each cell group. Throws an InputError:
     * faces before different media or above the free surface, a signal that is
     * not zero before it begins, an origin that the wave reaches after a part
     * of the boundary.
     */
    PlaneWaveForces(const LoadParameters &load, const NodeMap<3> &node_map,
                    const std::vector<BoundaryFace<3>> &faces,
                    const std::vector<Impedance> &impedance,
                    const std::vector<unsigned int> &nodes);

    /** Sets @p force to the forces [N] on the nodes at @p time, for signals
        @p components. */
    void find(const std::array<LoadComponent, 3> &components,
              const TimePoint &time,
              std::vector<dealii::Tensor<1, 3>> &force) const;

  private:
    /** A wave at a node. */
    struct Arrival
    {
      unsigned int signal, node;  /**< node: index into the list */
      double delay;               /**< [s] */
      dealii::Tensor<1, 3> force; /**< by its velocity [N s/m] */
    };
    std::vector<Arrival> arrivals; /**< by signal and delay */
  };
} // namespace quoin

#endif
