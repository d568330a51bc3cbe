// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_plane_wave_h
#define quoin_elastodynamics_plane_wave_h

#include <quoin/elastodynamics/plane_wave_sum.h>

#include <functional>

namespace quoin
{
  /**
   * The free field of a plane wave: the incident wave and, in a half-plane,
   * the P and the SV wave that the free surface y = 0 reflects
   * @cite AkiRichards2002. The medium is y < 0 then.
   *
   * The incident wave propagates in the direction (sin, cos) of the angle from
   * the upward vertical towards +x. Its displacement is f(t - s x) d with the
   * slowness vector s. The polarisation d of a P wave is the direction of
   * propagation; that of an SV wave is the same turned clockwise,
   * (cos, -sin), so that at vertical incidence f > 0 moves the medium to +x.
   *
   * Reflected waves have the signal f times a real coefficient, unless an SV
   * wave comes at more than the critical angle, whose sine is c2/c1. Then the
   * P wave clings to the surface, coefficients are complex, and signals contain
   * the Hilbert transform of f: that of the reflected SV wave at all depths,
   * as cos(phi) f - sin(phi) H f.
   *
   * So that the field starts at all places with the value zero, f must be zero
   * before the wave's start; it must also be such that no wave has arrived yet
   * anywhere on the boundary when a computation that starts at rest begins.
   * Beyond the critical angle this is so only nearly (AnalyticSignal).
   */
  class PlaneWave : public PlaneWaveSum
  {
  public:
    enum class Type
    {
      P,
      SV
    };

    /**
     * A wave with the displacement @p f [m] of time [s] at the origin, along
     * its polarisation. In a half-plane the wave must come from below,
     * |angle| < pi/2. Throws InputError otherwise.
     *
     * @param angle [rad]
     * @param range of the arguments t - s x of f that occur; needed only beyond
     *   the critical angle
     */
    PlaneWave(const ElasticMedium &medium, Type type, bool half_plane,
              double angle, std::function<double(double)> f,
              const SignalRange &range = {});
  };
} // namespace quoin

#endif
