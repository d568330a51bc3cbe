// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_mohr_coulomb_h
#define quoin_materials_mohr_coulomb_h

#include <quoin/materials/plastic_history.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/materials/plane_assumption.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace quoin
{
  /** Strength of a Mohr-Coulomb material. */
  struct MohrCoulombStrength
  {
    double cohesion       = 0.; /**< c [Pa], not negative */
    double friction_angle = 0.; /**< phi [rad], in [0, pi/2) */
    double dilation_angle = 0.; /**< psi [rad], in [0, phi] */

    /** Tensile strength [Pa], not negative; c / tan(phi) if that is less. */
    double tension = std::numeric_limits<double>::infinity();
  };

  /** Bits of PlasticPoint::state. */
  namespace yielding
  {
    constexpr std::uint8_t shear_now    = 1;
    constexpr std::uint8_t tension_now  = 2;
    constexpr std::uint8_t shear_past   = 4;
    constexpr std::uint8_t tension_past = 8;
  } // namespace yielding

  /**
   * One plastic cell: what the law reads and overwrites. Tensors are those of
   * the frame that rotates with the cell, components xx, yy, xy, zz, the
   * third that of the tensor (half the engineering shear strain).
   */
  struct PlasticPoint
  {
    std::array<double, 4> plastic_strain{};
    /** [Pa], tension positive; at the start the initial stress. */
    std::array<double, 4> stress{};

    /**
     * Sum of the increments' $\sqrt{\mathrm{dev}\, \Delta p :
     * \mathrm{dev}\, \Delta p / 2}$, as in @cite Itasca2019.
     */
    double plastic_shear = 0.;
    std::uint8_t state   = 0; /**< bits of yielding */
  };

  inline PlasticPoint plastic_point(const PlasticHistory &history,
                                    const std::size_t cell)
  {
    PlasticPoint point;
    std::copy_n(history.cells[cell].strain, 4, point.plastic_strain.begin());
    std::copy_n(history.cells[cell].stress, 4, point.stress.begin());
    point.plastic_shear = history.shear[cell];
    point.state         = history.yielding[cell];
    return point;
  }

  inline void set_plastic_point(const PlasticPoint &point,
                                const std::size_t cell, PlasticHistory &history)
  {
    std::copy_n(point.plastic_strain.begin(), 4, history.cells[cell].strain);
    std::copy_n(point.stress.begin(), 4, history.cells[cell].stress);
    history.shear[cell]    = point.plastic_shear;
    history.yielding[cell] = point.state;
  }

  /** Yield functions [Pa]; negative inside the elastic domain. */
  struct YieldFunctions
  {
    double shear;
    double tension;
  };

  /**
   * The perfectly plastic Mohr-Coulomb law with tension cut-off
   * (@cite ZhugeHunt2003, Eqs. 14-20; @cite Itasca2019). With the principal
   * stresses @f$\sigma_1 \ge \sigma_2 \ge \sigma_3@f$, tension positive, among
   * them the one out of the plane,
   * @f[ F_s = N_\varphi \sigma_1 - \sigma_3 - 2 c \sqrt{N_\varphi}, \quad
   *     F_t = \sigma_1 - \sigma_t, \quad
   *     N_\varphi = \frac{1 + \sin\varphi}{1 - \sin\varphi} . @f]
   * Flow: @f$G_s = N_\psi \sigma_1 - \sigma_3@f$ in shear, associated in
   * tension; on edges and vertices the sum of the adjoining planes'
   * (@cite Koiter1953).
   *
   * The stress is @f$\sigma = \sigma_0 + C (e - p)@f$ with the total strain e
   * and the plastic strain p, so that a cell which never yields is a linear
   * elastic one. A step is one implicit return (backward Euler), which in
   * principal stresses is piecewise linear and hence exact
   * (@cite DeSouzaNeto2008, chapter 8; @cite Clausen2006).
   */
  class MohrCoulomb
  {
  public:
    /** The material's Poisson ratio and the strength are taken as valid. */
    MohrCoulomb(const LinearElastic &material,
                const MohrCoulombStrength &strength,
                PlaneAssumption assumption);

    /**
     * Brings @p point to the total strain @p strain (xx, yy, xy) under the
     * @p initial stress [Pa] (xx, yy, xy, zz; in plane stress zz is not
     * read). Returns what that dissipated [J/m^3], by the trapezoidal rule of
     * the explicit scheme: (old + new stress)/2 : plastic increment, the exact
     * difference between the step's trapezoidal work and stored energy. Only
     * a step that jumps from one side of the elastic domain to the other can
     * make it negative.
     */
    double update(PlasticPoint &point, const std::array<double, 3> &strain,
                  const std::array<double, 4> &initial = {}) const
    {
      const auto trial = trial_stress(point, strain, initial);
      if (!is_elastic(trial))
        return update_yielding(point, trial);
      point.stress = trial;
      point.state  = past(point.state);
      return 0.;
    }

    /** Stress xx, yy, xy, zz [Pa] if nothing yields on the way to @p strain. */
    std::array<double, 4>
    trial_stress(const PlasticPoint &point, const std::array<double, 3> &strain,
                 const std::array<double, 4> &initial = {}) const
    {
      const auto &p   = point.plastic_strain;
      const double xx = strain[0] - p[0];
      const double yy = strain[1] - p[1];
      const double xy = strain[2] - p[2];
      if (assumption == PlaneAssumption::plane_stress)
        return { stiffness.c11 * xx + stiffness.c12 * yy + initial[0],
                 stiffness.c12 * xx + stiffness.c11 * yy + initial[1],
                 2. * stiffness.c33 * xy + initial[2], 0. };
      return { stiffness.c11 * xx + stiffness.c12 * yy - stiffness.c12 * p[3]
                   + initial[0],
               stiffness.c12 * xx + stiffness.c11 * yy - stiffness.c12 * p[3]
                   + initial[1],
               2. * stiffness.c33 * xy + initial[2],
               stiffness.c12 * (xx + yy) - stiffness.c11 * p[3] + initial[3] };
    }

    YieldFunctions yield_functions(const std::array<double, 4> &stress) const
    {
      const double mean   = 0.5 * (stress[0] + stress[1]);
      const double half   = 0.5 * (stress[0] - stress[1]);
      const double radius = std::sqrt(half * half + stress[2] * stress[2]);
      const double major  = std::max(mean + radius, stress[3]);
      const double minor  = std::min(mean - radius, stress[3]);
      return { shear_function(major, minor), major - limits.tension };
    }

    bool is_elastic(const std::array<double, 4> &stress) const
    {
      const auto f = yield_functions(stress);
      return f.shear <= 0. && f.tension <= 0.;
    }

    /** update() for a @p trial stress [Pa] that is_elastic() refuses. */
    double update_yielding(PlasticPoint &point,
                           const std::array<double, 4> &trial) const;

    /**
     * Derivative [Pa] of the updated stress xx, yy, xy with respect to the
     * strains xx, yy and 2 xy, at a @p trial stress. Exact for one step of
     * update(); symmetric if psi = phi. On the border between two regions it
     * is that of one of them.
     */
    std::array<std::array<double, 3>, 3>
    tangent(const std::array<double, 4> &trial) const;

    /** c / tan(phi) or what was given, whichever is less [Pa]. */
    double tensile_strength() const
    {
      return limits.tension;
    }

    /** 2 c sqrt(N_phi) [Pa]: strength of a free cube in compression. */
    double compressive_strength() const
    {
      return limits.strength;
    }

    PlaneAssumption plane_assumption() const
    {
      return assumption;
    }

    /** N_phi [-]. */
    double friction_number() const
    {
      return n_phi;
    }

    /** State, bits of namespace yielding, after a step that is elastic. */
    static std::uint8_t past(const std::uint8_t state)
    {
      return (state | (state << 2))
             & (yielding::shear_past | yielding::tension_past);
    }

  private:
    using Principal = std::array<double, 3>;

    /**
     * Where a return ends. Planes, edges and vertices in the sector
     * s1 >= s2 >= s3; 'squeeze' is yielding in shear out of the plane, in
     * plane stress, where the in-plane minor stress is the strength of a free
     * cube.
     */
    enum class Region
    {
      shear,
      shear_major, /**< edge s1 = s2 */
      shear_minor, /**< edge s2 = s3 */
      tension,
      tension_two,   /**< two principal stresses at the limit */
      tension_three, /**< all three */
      shear_tension, /**< where both planes meet */
      vertex_major,  /**< there, with s1 = s2 */
      vertex_minor,  /**< there, with s2 = s3 */
      squeeze,
      squeeze_two,  /**< both in-plane stresses */
      shear_squeeze /**< uniaxial compression */
    };

    /** Constants of the yield planes [Pa]. */
    struct Limits
    {
      double strength; /**< 2 c sqrt(N_phi): of a free cube in compression */
      double tension;  /**< largest principal stress */
      double in_plane; /**< the same in plane stress */
      double minor;    /**< s3 where shear and tension planes meet */
    };

    /**
     * A stress by its principal values, in plane strain sorted, in plane
     * stress the major and minor one in the plane.
     */
    struct PrincipalStress
    {
      Principal s;
      unsigned int major, minor, out; /**< which is which in s */
      double radius;                  /**< half the in-plane difference [Pa] */
      double cos2, sin2; /**< of twice the angle of the major direction */
    };

    double shear_function(const double major, const double minor) const
    {
      return n_phi * major - minor - limits.strength;
    }

    PrincipalStress principal(const std::array<double, 4> &stress) const;

    Region region(const Principal &trial) const;
    Region region_plane_strain(const Principal &trial) const;
    Region region_plane_stress(const Principal &trial) const;

    /**
     * The return to a region: linear in trial stress and limits, so that with
     * zero limits it is its own derivative.
     */
    Principal returned(Region region, const Principal &trial,
                       const Limits &limits) const;
    Principal returned_plane_strain(Region region, const Principal &trial,
                                    const Limits &limits) const;
    Principal returned_plane_stress(Region region, const Principal &trial,
                                    const Limits &limits) const;

    /** Plastic strain in the order of PrincipalStress::s. */
    Principal plastic_increment(Region region, const Principal &trial,
                                const Principal &end) const;
    double plane_stress_thinning(Region region, double major,
                                 double minor) const;

    /** Bits of namespace yielding of a return to @p region. */
    std::uint8_t yields_now(Region region) const;

    PlaneAssumption assumption;
    PlaneStiffness stiffness;
    double young, poisson;
    double n_phi, n_psi;
    Limits limits;

    /** Stiffness times the direction of shear flow (N_psi, 0, -1) [Pa]. */
    Principal flow;
    double plane_modulus; /**< F_s that a unit of this flow takes away [Pa] */
    double major_modulus; /**< the same for the two planes at s1 = s2, summed */
    double minor_modulus; /**< and at s2 = s3 */
  };
} // namespace quoin

#endif
