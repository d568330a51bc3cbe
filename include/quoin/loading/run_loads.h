// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_run_loads_h
#define quoin_loading_run_loads_h

#include <quoin/absorbing/free_field_boundary.h>
#include <quoin/farfield/far_field.h>
#include <quoin/farfield/static_far_field.h>
#include <quoin/loading/load_pattern.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/model/model.h>
#include <quoin/stages/stage_parameters.h>
#include <quoin/structures/beams.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  class JointFlow;

  /** The two constraints of the load of type 'boundary elements'; null: there
      is none. */
  struct FarFields
  {
    /** Far field of stages that end by time. */
    FarField *elastodynamic      = nullptr;
    StaticFarField *elastostatic = nullptr; /**< far field of static stages */
    /** Scale of the energy that incident waves bring through the interface in
        the run [J]; 0: there are none. */
    double incident_energy = 0.;
    // In the stage that has begun:
    bool elastodynamic_acts = false;
    bool elastostatic_acts  = false;
  };

  /** All loads of a run, of which each stage names those that act in it
      (StageLoads). Boundary elements belong to two dimensions. */
  template <int dim>
  struct RunLoads
  {
    /**
     * @p far_field and @p static_far_field: of the load of type 'boundary
     * elements', or null. Throws an InputError about loads that do not go with
     * the model or with each other. Collective.
     */
    RunLoads(const Model<dim> &model, const std::vector<LoadParameters> &given,
             std::unique_ptr<FarField> far_field,
             std::unique_ptr<StaticFarField> static_far_field);

    /** Whether @p stage names @p constraint and, of far fields, is of its kind.
     */
    bool acts_in(const MotionConstraint<dim> &constraint,
                 const StageParameters &stage) const;
    /**
     * Boundaries that absorb in @p stage but not in @p previous, before it:
     * they keep constant what forces support their nodes when they begin. The
     * static far field after waves knows its forces and is none of them.
     */
    std::vector<std::string>
    loads_that_hold(const StageParameters &stage,
                    const StageParameters &previous) const;
    /**
     * Gives the viscous and free-field boundaries that act in @p stage the
     * materials that @p model has now. Throws an InputError about what they
     * cannot follow: ground beside a model that would change while it moves,
     * as the free field acts in @p previous, the stage before or null, too.
     * Collective.
     */
    void follow_materials(const Model<dim> &model, const StageParameters &stage,
                          const StageParameters *previous);
    /** Whether @p load adds the mass of water, so that it has a resultant. */
    bool has_added_mass(const std::string &load) const;
    /** Throws an InputError about loads that @p stage names wrongly. */
    void check(const StageParameters &stage) const;
    /** Force [N] and moment [N m] of the constraint @p load; collective. */
    Resultant<dim> resultant(const std::string &load,
                             MPI_Comm communicator) const;

    /** Active in the stage or not. */
    std::vector<std::unique_ptr<MotionConstraint<dim>>> constraints;
    std::vector<NodalLoad<dim>> nodal;
    FarFields far;
    /** Water that flows in joints, which the run owns; null: there is none. */
    JointFlow *water = nullptr;
    std::unique_ptr<Beams> beams; /**< in two dimensions, or null */
    /** This rank's terms of the displacement that the load pattern of a stage
        controls, if a history gives it, by the stage's name. */
    std::map<std::string, std::vector<DisplacementTerm>> controls;

  private:
    /** A boundary that continues the blocks with their materials. */
    struct OpenBoundary
    {
      LoadParameters load;
      std::optional<LoadParameters> base; /**< of a free field */
      std::size_t position;               /**< in the list of constraints */
      FreeFieldGround ground;             /**< what it is made for */
    };

    void add_open_boundary(const Model<dim> &model, const LoadParameters &load,
                           const std::optional<LoadParameters> &base = {});
    void refuse_moved_ground(const Model<dim> &model, const OpenBoundary &field,
                             const FreeFieldGround &now,
                             const StageParameters &stage) const;
    void add_free_fields(const Model<dim> &model,
                         const std::vector<LoadParameters> &loads);
    void add_far_fields(std::unique_ptr<FarField> far_field,
                        std::unique_ptr<StaticFarField> static_field);

    std::vector<std::string> names;
    std::vector<std::string> with_added_mass;
    std::vector<OpenBoundary> open_boundaries;
  };

  // Members that exist in two dimensions only.
  template <>
  void
  RunLoads<2>::add_far_fields(std::unique_ptr<FarField> far_field,
                              std::unique_ptr<StaticFarField> static_field);
} // namespace quoin

#endif
