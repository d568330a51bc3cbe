// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_added_water_h
#define quoin_dynamics_added_water_h

#include <quoin/dynamics/central_differences.h>
#include <quoin/loads/hydrodynamic_mass.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/model/model.h>
#include <quoin/stages/stage_parameters.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** The water of reservoirs that moves with faces of the blocks in a stage, as
      masses of their nodes. Two dimensions only. */
  template <int dim>
  class AddedWater
  {
  public:
    /** Keeps a reference to @p model; @p loads: all loads of the run. */
    AddedWater(const Model<dim> &model,
               const std::vector<LoadParameters> &loads);

    /** Finds the water in @p stage, which begins at @p start [s]. */
    void begin_stage(const StageParameters &stage, double start);
    /** Masses of this rank in the stage, of all reservoirs. */
    const std::vector<NodeMass<dim>> &masses() const
    {
      return all;
    }

    /** Throws an InputError about a reservoir whose level changes in @p stage,
        which begins at @p start [s]. */
    void check_levels(const StageParameters &stage, double start) const;
    /** Throws an InputError about one of the @p constraints of @p stage that
        moves a node with water, but for prescribed motions. Collective. */
    void
    check_constraints(const std::vector<MotionConstraint<dim> *> &constraints,
                      const StageParameters &stage) const;

    /** Water that moves with faces in the stage [kg]; collective. */
    double total() const;
    /** Force [N] and moment about the origin [N m] of the inertia of the water
        of @p load in the last step of @p stepper; collective. */
    Resultant<dim> resultant(const std::string &load,
                             const CentralDifferences<dim> &stepper) const;

  private:
    const Model<dim> &model;
    std::vector<HydrodynamicMass> reservoirs;
    std::vector<std::vector<NodeMass<dim>>> reservoir_masses; /**< of each */
    std::vector<NodeMass<dim>> all;
  };
} // namespace quoin

#endif
