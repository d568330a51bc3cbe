// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_material_waves_h
#define quoin_model_material_waves_h

#include <quoin/absorbing/free_field_column.h>
#include <quoin/absorbing/viscous_boundary.h>
#include <quoin/model/model.h>

#include <vector>

namespace quoin
{
  // Waves in the materials that a Model has now.

  /**
   * Impedances of each cell group [Pa s/m] beyond a viscous boundary: those of
   * the material that @p load names, or of the cells there. Throws an
   * InputError.
   */
  template <int dim>
  std::vector<Impedance> impedance_beyond(const Model<dim> &model,
                                          const LoadParameters &load);

  /** Lowest S wave velocity of deformable blocks [m/s]; infinite: there are
      none. */
  template <int dim>
  double slowest_shear_wave(const Model<dim> &model);

  /** Materials of the ground beside free-field boundaries. */
  template <int dim>
  FreeFieldGround free_field_ground(const Model<dim> &model);
} // namespace quoin

#endif
