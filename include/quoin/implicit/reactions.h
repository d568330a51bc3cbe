// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_reactions_h
#define quoin_implicit_reactions_h

#include <quoin/implicit/equilibrium.h>

#include <array>

namespace quoin
{
  /**
   * Adds the work from the equilibrium @p start of @p state to @p balance at
   * @p configuration by the trapezoidal rule: of loads and of reactions of
   * prescribed motions as external work, of forces out of balance as damping.
   * @p far_field: null if it does not act. Leaves @p dof_map with the arms of
   * @p configuration. Collective.
   */
  template <int dim>
  void book_work(const Model<dim> &model, DofMap<dim> &dof_map,
                 const StaticFarField *far_field, const State<dim> &state,
                 const Balance<dim> &start,
                 const Configuration<dim> &configuration,
                 const Balance<dim> &balance, EnergyAccounts &energy);

  /** Forces [N] and moments [N m] that drive or load @p platen, of all ranks.
      Collective. */
  template <int dim>
  Resultant<dim> platen_drive(const Model<dim> &model,
                              const DofMap<dim> &dof_map,
                              const Balance<dim> &balance,
                              const MotionConstraint<dim> &platen);

  /** Force [N] and moment [N m] of @p constraint, as
      MotionConstraint::resultant(), of all ranks; @p far_field: that of the
      solver, or null. Collective. */
  template <int dim>
  Resultant<dim> reaction(const Model<dim> &model, const DofMap<dim> &dof_map,
                          const StaticFarField *far_field,
                          const Balance<dim> &balance,
                          const MotionConstraint<dim> &constraint);
} // namespace quoin

#endif
