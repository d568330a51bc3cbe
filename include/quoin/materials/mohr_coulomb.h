// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_mohr_coulomb_h
#define quoin_materials_mohr_coulomb_h

#include <quoin/materials/corotated_strain.h>
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
   * One plastic cell: what the law reads and overwrites. With the inverse of
   * the plastic stretch, symmetric, the elastic part of the deformation is
   * @f$F_e = F (I + Q) = R_e U_e@f$. Tensors have the components xx, yy, xy,
   * zz, the third that of the tensor (half the engineering shear strain).
   */
  struct PlasticPoint
  {
    /** Q [-]; small plastic strains are -Q. zz: of the plastic stretch alone
        in plane stress, of the elastic one in plane strain, which is the same
        as the thickness stays. */
    std::array<double, 4> inverse_stretch{};

    /**
     * Biot's stress S of F_e in the frame R_e [Pa], tension positive; at the
     * start the initial stress.
     */
    std::array<double, 4> stress{};

    /**
     * Sum of the increments' $\sqrt{\mathrm{dev}\, \Delta p :
     * \mathrm{dev}\, \Delta p / 2}$, as in @cite Itasca2019, with logarithmic
     * strains p.
     */
    double plastic_shear = 0.;
    std::uint8_t state   = 0; /**< bits of yielding; 0: has never yielded */
  };

  /** Result of MohrCoulomb::update(). */
  struct PlasticStep
  {
    /**
     * Stress [Pa] that does the work on a change of the elastic Biot strain at
     * constant Q: piola_stress() of it times (I + Q) is that of the cell.
     */
    PlaneTensor stress;
    double dissipated; /**< [J/m^3] */
  };

  inline PlasticPoint plastic_point(const PlasticHistory &history,
                                    const std::size_t cell)
  {
    PlasticPoint point;
    std::copy_n(history.cells[cell].inverse_stretch, 4,
                point.inverse_stretch.begin());
    std::copy_n(history.cells[cell].stress, 4, point.stress.begin());
    point.plastic_shear = history.shear[cell];
    point.state         = history.yielding[cell];
    return point;
  }

  inline void set_plastic_point(const PlasticPoint &point,
                                const std::size_t cell, PlasticHistory &history)
  {
    std::copy_n(point.inverse_stretch.begin(), 4,
                history.cells[cell].inverse_stretch);
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
   * The stresses are Cauchy's. The deformation is F = F_e F_p
   * (@cite Lee1969); the energy is that of the elastic cell with F_e in the
   * place of F, by the volume before any deformation, so that a cell which has
   * never yielded is a linear elastic one. Plastic flow scales the principal
   * elastic stretches by exp(-dp), dp along the flow at the end of the step
   * (backward Euler, @cite Simo1992). In principal axes the step is the return
   * of small strains, which is piecewise linear (@cite DeSouzaNeto2008, chapter
   * 8; @cite Clausen2006), corrected until it holds for the stresses of the
   * stretches.
   */
  class MohrCoulomb
  {
  public:
    /** The material's Poisson ratio and the strength are taken as valid. */
    MohrCoulomb(const LinearElastic &material,
                const MohrCoulombStrength &strength,
                PlaneAssumption assumption);

    /**
     * Updates @p point for the elastic Biot strain @p e (U_e - I with the
     * point's present Q) under the @p initial stress [Pa] (xx, yy, xy, zz; in
     * plane stress zz is 0), which belongs to a cell that has never yielded:
     * when it does, its elastic stretch becomes the one that has the present
     * stress alone. A cell that is inverted is elastic.
     *
     * The dissipated energy is the difference between the step's trapezoidal
     * work and what it stores. Only a step that jumps from one side of the
     * elastic domain to the other can make it negative.
     */
    PlasticStep update(PlasticPoint &point, const PlaneTensor &e,
                       const std::array<double, 4> &initial = {}) const;

    /** Biot's stress xx, yy, xy, zz [Pa] if nothing yields on the way to @p e,
        see update(). */
    std::array<double, 4>
    trial_stress(const PlasticPoint &point, const PlaneTensor &e,
                 const std::array<double, 4> &initial = {}) const
    {
      const auto &bears = point.state == 0 ? initial : no_stress;
      const double zz   = assumption == PlaneAssumption::plane_stress
                              ? 0.
                              : point.inverse_stretch[3];
      return { stiffness.c11 * e[0] + stiffness.c12 * (e[1] + zz) + bears[0],
               stiffness.c12 * (e[0] + zz) + stiffness.c11 * e[1] + bears[1],
               2. * stiffness.c33 * e[2] + bears[2],
               assumption == PlaneAssumption::plane_stress
                   ? 0.
                   : stiffness.c12 * (e[0] + e[1]) + stiffness.c11 * zz
                         + bears[3] };
    }

    /** Cauchy's stress at a point in the frame R_e, xx, yy, xy, zz [Pa]. */
    std::array<double, 4>
    cauchy_stress(const PlasticPoint &point, const PlaneTensor &e,
                  const std::array<double, 4> &initial = {}) const;

    /**
     * Gives a point that has yielded, at the elastic strain @p e under another
     * material, the elastic stretch that has the same stress under this one.
     */
    void take_over(PlasticPoint &point, const PlaneTensor &e,
                   const MohrCoulomb &before) const;

    /**
     * Elastic energy [J/m^3] of Biot's @p stress by the volume at the start. A
     * cell that has yielded stores that of its stress less that of its initial
     * one, and so does one that has not.
     */
    double stored_energy(const std::array<double, 4> &stress) const;

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

    /**
     * Derivative [Pa] of PlasticStep::stress with respect to the strains xx, yy
     * and 2 xy at what update() is given. On the border between two regions it
     * is that of one of them.
     */
    std::array<PlaneTensor, 3>
    tangent(const PlasticPoint &point, const PlaneTensor &e,
            const std::array<double, 4> &initial = {}) const;

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

  protected:
    using Principal = std::array<double, 3>;

    static constexpr std::array<double, 4> no_stress{};

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
      tension_three, /**< three principal stresses at the limit */
      shear_tension, /**< edge of the shear and tension planes */
      vertex_major,  /**< vertex of shear and tension planes with s1 = s2 */
      vertex_minor,  /**< vertex of shear and tension planes with s2 = s3 */
      squeeze,
      squeeze_two,  /**< both in-plane stresses */
      shear_squeeze /**< uniaxial compression */
    };

    /** Constants of the yield planes [Pa]. */
    struct Limits
    {
      double strength; /**< 2 c sqrt(N_phi): of a free cube in compression */
      double tension;  /**< largest principal stress */
      double in_plane; /**< largest principal stress in plane stress */
      double minor;    /**< s3 where shear and tension planes meet */
    };

    /**
     * A tensor by its principal values, in plane strain sorted, in plane
     * stress the major and minor one in the plane.
     */
    struct PrincipalAxes
    {
      Principal s;
      /** Indices of the principal stresses in s. */
      unsigned int major, minor, out;
      double radius; /**< half the in-plane difference */
      /** Functions of twice the angle of the major direction. */
      double cos2, sin2;

      std::array<double, 4> tensor(const Principal &values) const
      {
        const double mean = 0.5 * (values[major] + values[minor]);
        const double half = 0.5 * (values[major] - values[minor]);
        return { mean + half * cos2, mean - half * cos2, half * sin2,
                 values[out] };
      }
    };

    /** The stress before the return. */
    struct Trial
    {
      std::array<double, 4> biot, kirchhoff; /**< [Pa] */
      double jacobian; /**< det F: current volume by initial volume */
    };

    /** A step of flow in principal axes. */
    struct Flow
    {
      Region where;
      Principal strain;    /**< elastic, Biot's, at the end */
      Principal kirchhoff; /**< [Pa] */
      Principal flowed;    /**< logarithmic plastic strain */
      double jacobian;     /**< det F at the end */
    };

    double shear_function(const double major, const double minor) const
    {
      return n_phi * major - minor - limits.strength;
    }

    PrincipalAxes principal(const std::array<double, 4> &tensor) const;

    Trial trial(const PlasticPoint &point, const PlaneTensor &e,
                const std::array<double, 4> &initial) const;
    bool yields(const Trial &at) const;

    /** Elastic principal strains that have the stress of @p at; its axes. */
    PrincipalAxes elastic_strain(const PlasticPoint &point,
                                 const PlaneTensor &e,
                                 const std::array<double, 4> &initial,
                                 const Trial &at) const;
    PrincipalAxes
    strain_of_kirchhoff(const std::array<double, 4> &kirchhoff) const;
    Principal strain_of_principal(const Principal &kirchhoff) const;

    Flow find_flow(const Principal &trial_strain, double jacobian) const;

    /** update() of a point that yields. */
    PlasticStep update_yielding(PlasticPoint &point, const PlaneTensor &e,
                                const std::array<double, 4> &initial,
                                const Trial &at) const;

    /**
     * Changes the elastic strain of @p point from @p e to @p strain. Returns
     * the turn of the frame R_e by it.
     */
    CorotatedStrain
    change_elastic_strain(PlasticPoint &point, const PlaneTensor &e,
                          const std::array<double, 4> &strain) const;

    /** Derivatives of a flow's Kirchhoff stress, in principal axes. */
    struct FlowRates
    {
      std::array<Principal, 3> by_trial; /**< [i][j]: of i, by trial stress j */
      /** Derivative by the logarithm of the trial's det F [Pa]. */
      Principal by_volume;
    };
    FlowRates flow_rates(const Principal &trial_strain, const Flow &step) const;

    Principal hooke(const Principal &strain) const;
    std::array<double, 4> compliance(const std::array<double, 4> &s) const;

    /** Strain zz of plane stress included. */
    Principal inverse_hooke(const Principal &stress) const;

    /** @f$\lambda_i S_i@f$ of elastic principal strains [Pa]. */
    Principal kirchhoff(const Principal &strain) const;

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

    /** Plastic strain in the order of PrincipalAxes::s. */
    Principal plastic_increment(Region region, const Principal &trial,
                                const Principal &end) const;
    double plane_stress_thinning(Region region, double major,
                                 double minor) const;

    /** Bits of namespace yielding of a return to @p region. */
    std::uint8_t yields_now(Region region) const;

    /** Increment of PlasticPoint::plastic_shear by a flow. */
    static double shear_of(const Principal &flowed);

    PlaneAssumption assumption;
    PlaneStiffness stiffness;
    double young, poisson;
    double thinning; /**< elastic strain zz by xx + yy; 0 in plane strain */
    double n_phi, n_psi;
    Limits limits;

    /** Stiffness times the direction of shear flow (N_psi, 0, -1) [Pa]. */
    Principal flow;
    double plane_modulus; /**< decrease of F_s per unit of this flow [Pa] */
    /** Sum of plane_modulus of the two planes at s1 = s2. */
    double major_modulus;
    /** Sum of plane_modulus of the two planes at s2 = s3. */
    double minor_modulus;
  };
} // namespace quoin

#endif
