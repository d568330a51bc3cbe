// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_plane_wave_h
#define quoin_tdbem_plane_wave_h

#include <quoin/tdbem/boundary.h>
#include <quoin/tdbem/elastic_medium.h>

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace quoin
{
  /**
   * The free field of a plane wave: the incident wave and, in a half-plane,
   * the P and the SV wave that the free surface y = 0 reflects. The medium is
   * y < 0 then.
   *
   * The incident wave propagates in the direction (sin, cos) of the angle from
   * the upward vertical towards +x. Its displacement is f(t - s x) d with the
   * slowness vector s. The polarisation d of a P wave is the direction of
   * propagation; that of an SV wave is the same turned clockwise,
   * (cos, -sin), so that at vertical incidence f > 0 moves the medium to +x.
   *
   * Reflected waves have the signal f times a real coefficient. So that the
   * field starts at all places with the value zero, f must be zero before the
   * wave's start; it must also be such that no wave has arrived yet anywhere
   * on the boundary when a computation that starts at rest begins.
   */
  class PlaneWave
  {
  public:
    enum class Type
    {
      P,
      SV
    };

    /**
     * A wave with the displacement @p f [m] of time [s] at the origin, along
     * its polarisation.
     *
     * In a half-plane the wave must come from below, |angle| < pi/2. The
     * sine of the angle of an SV wave must not exceed c2/c1: beyond the
     * critical angle the P wave clings to the surface, the coefficients are
     * complex and the signals contain the Hilbert transform of f, which needs
     * more of f than its past. Throws InputError otherwise.
     *
     * @param angle [rad]
     */
    PlaneWave(const ElasticMedium &medium, Type type, bool half_plane,
              double angle, std::function<double(double)> f);

    /** Displacement of the free field [m]. */
    Eigen::Vector2d displacement(const Eigen::Vector2d &x, double t) const;

    /**
     * The mean over [@p t0, @p t1] of the free field's traction [Pa] on a plane
     * with the unit normal @p n. Tractions are linear in the derivative of f:
     * the mean is exact and needs f only at both ends.
     */
    Eigen::Vector2d mean_traction(const Eigen::Vector2d &x,
                                  const Eigen::Vector2d &n, double t0,
                                  double t1) const;

    /**
     * Displacements of the free field at the time @p t [m], in the mean over
     * each element by four Gauss points: entry 2 e + i.
     */
    Eigen::VectorXd displacements(const Boundary &boundary, double t) const;

    /**
     * Tractions of the free field [Pa] on the boundary, in the mean over
     * [@p t0, @p t1] and, by four Gauss points, over each element: entry
     * 2 e + i.
     */
    Eigen::VectorXd mean_tractions(const Boundary &boundary, double t0,
                                   double t1) const;

    /** Displacement amplitude f(t - s x) of one of the waves in the field. */
    struct Component
    {
      Eigen::Vector2d amplitude; /**< polarisation times coefficient */
      Eigen::Vector2d slowness;  /**< [s/m] */
    };

    /** The incident wave and, in a half-plane, the reflected P and SV wave. */
    const std::vector<Component> &components() const
    {
      return waves;
    }

  private:
    ElasticMedium medium;
    std::function<double(double)> f;
    std::vector<Component> waves;
  };
} // namespace quoin

#endif
