// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_space_mohr_coulomb_h
#define quoin_materials_space_mohr_coulomb_h

#include <quoin/materials/mohr_coulomb.h>
#include <quoin/materials/space_strain.h>

namespace quoin
{
  /** PlasticPoint of a cell in three dimensions. */
  struct SpacePlasticPoint
  {
    SpaceTensor inverse_stretch{}; /**< Q [-] */
    SpaceTensor stress{};          /**< Biot's, of F_e, in the frame R_e [Pa] */
    double plastic_shear = 0.;
    std::uint8_t state   = 0; /**< bits of yielding; 0: has never yielded */
  };

  /** Result of SpaceMohrCoulomb::update(). */
  struct SpacePlasticStep
  {
    SpaceTensor stress; /**< see PlasticStep [Pa] */
    double dissipated;  /**< [J/m^3] */
  };

  inline SpacePlasticPoint space_plastic_point(const PlasticHistory &history,
                                               const std::size_t cell)
  {
    SpacePlasticPoint point;
    const SpacePlasticCell &from = history.space_cells[cell];
    std::copy_n(from.inverse_stretch, 6, point.inverse_stretch.begin());
    std::copy_n(from.stress, 6, point.stress.begin());
    point.plastic_shear = history.shear[cell];
    point.state         = history.yielding[cell];
    return point;
  }

  inline void set_plastic_point(const SpacePlasticPoint &point,
                                const std::size_t cell, PlasticHistory &history)
  {
    SpacePlasticCell &to = history.space_cells[cell];
    std::copy_n(point.inverse_stretch.begin(), 6, to.inverse_stretch);
    std::copy_n(point.stress.begin(), 6, to.stress);
    history.shear[cell]    = point.plastic_shear;
    history.yielding[cell] = point.state;
  }

  /**
   * The law of MohrCoulomb for tetrahedra: the same yield planes, flow and
   * finite strains, with all three principal directions free in space. In
   * principal axes it is that of plane strain, where the third principal
   * stress may be any of the three as well.
   */
  class SpaceMohrCoulomb : private MohrCoulomb
  {
  public:
    SpaceMohrCoulomb(const LinearElastic &material,
                     const MohrCoulombStrength &strength)
      : MohrCoulomb(material, strength, PlaneAssumption::plane_strain)
    {
    }

    /** See MohrCoulomb::update(); @p strain: of F_e with the present Q. */
    SpacePlasticStep update(SpacePlasticPoint &point, const SpaceStrain &strain,
                            const SpaceTensor &initial = {}) const;

    /** Biot's stress [Pa] if nothing yields on the way to @p e. */
    SpaceTensor trial_stress(const SpacePlasticPoint &point,
                             const SpaceTensor &e,
                             const SpaceTensor &initial = {}) const;

    /** Cauchy's stress in the frame R_e [Pa]. */
    SpaceTensor cauchy_stress(const SpacePlasticPoint &point,
                              const SpaceStrain &strain,
                              const SpaceTensor &initial = {}) const;

    /** See MohrCoulomb::take_over(). */
    void take_over(SpacePlasticPoint &point, const SpaceStrain &strain,
                   const SpaceMohrCoulomb &before) const;

    /** Elastic energy [J/m^3] of Biot's @p stress by the volume at the
        start. */
    double stored_energy(const SpaceTensor &stress) const;

    using MohrCoulomb::compressive_strength;
    using MohrCoulomb::friction_number;
    using MohrCoulomb::past;
    using MohrCoulomb::tensile_strength;

    /** Functions of the principal Cauchy stresses of @p stress; negative inside
        the elastic domain [Pa]. */
    YieldFunctions yield_functions(const SpaceTensor &stress) const;

  private:
    struct SpaceTrial
    {
      SpaceTensor biot, kirchhoff; /**< [Pa] */
      double jacobian;             /**< det F */
    };
    SpaceTrial trial(const SpacePlasticPoint &point, const SpaceStrain &strain,
                     const SpaceTensor &initial) const;
    bool yields(const SpaceTrial &at) const;
    SpacePlasticStep update_yielding(SpacePlasticPoint &point,
                                     const SpaceStrain &strain,
                                     const SpaceTensor &initial,
                                     const SpaceTrial &at) const;
    SpaceTensor compliance(const SpaceTensor &stress) const;
  };
} // namespace quoin

#endif
