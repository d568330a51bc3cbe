// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_rayleigh_wave_h
#define quoin_elastodynamics_rayleigh_wave_h

#include <quoin/elastodynamics/plane_wave_sum.h>

#include <functional>

namespace quoin
{
  /** Speed of Rayleigh waves [m/s]: the root of Rayleigh's equation. */
  double rayleigh_speed(const ElasticMedium &medium);

  /**
   * A Rayleigh wave along the free surface y = 0 of the half-plane y < 0
   * @cite Rayleigh1885: a P and an SV wave that cling to the surface. The
   * vertical displacement on the surface, upward, is f(t - x/c_R) for a wave
   * that travels to +x. The horizontal one is the Hilbert transform of f times
   * the ratio of the axes; particles at the surface move against the sense in
   * which a wheel would roll along. At the depth y both parts have all
   * frequencies damped as exp(w y sqrt(1/c_R^2 - 1/c_a^2)).
   *
   * On the Hilbert transform, which comes before the wave: AnalyticSignal.
   */
  class RayleighWave : public PlaneWaveSum
  {
  public:
    /**
     * @param to_right travels to +x, or else to -x
     * @param f vertical displacement [m] of time [s] at the origin
     * @param range of the arguments t - x/c_R of f that occur
     */
    RayleighWave(const ElasticMedium &medium, bool to_right,
                 std::function<double(double)> f, const SignalRange &range);
  };
} // namespace quoin

#endif
