// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/absorbing/plane_waves.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/number_text.h>
#include <quoin/loading/run_loads.h>
#include <quoin/loads/joint_crack.h>
#include <quoin/loads/load_field.h>
#include <quoin/motions/space_platen.h>
#include <quoin/motions/prescribed_motion.h>
#include <quoin/absorbing/viscous_boundary.h>
#include <quoin/model/material_waves.h>

#include <algorithm>
#include <iterator>

namespace quoin
{
  namespace
  {
    /** Lets the @p uplift of @p load follow cracks, if it does. */
    void follow_cracks(const Model<2> &model, const LoadParameters &load,
                       NodalLoad<2> &uplift)
    {
      const UpliftDiagram &diagram = *load.pressure.field->uplift();
      if (!diagram.enters_cracks)
        return;
      const std::string section
          = "section 'Loads/" + load.name + "': 'In cracks = full head' ";
      if (model.parameters().large_displacements)
        throw InputError(
            section
            + "needs joints of the mesh, but with 'Displacements = "
              "large' they become contacts. Take 'small' in section "
              "'Contact', or 'given'.");
      uplift.set_crack(std::make_shared<JointCrack>(
          diagram, load.boundaries, load.name, model.nodes(), model.joints()));
    }

    void follow_cracks(const Model<3> &, const LoadParameters &load,
                       NodalLoad<3> &)
    {
      throw InputError(
          "section 'Loads/" + load.name
          + "': 'Pressure = uplift' is known in two dimensions "
            "alone. Give the pressure as a function of the place.");
    }

    void refuse_leaving_waves(const Model<2> &,
                              const std::vector<LoadParameters> &)
    {
    }

    /** Refuses plane waves that enter the model through no face of the
        boundaries that pass waves in the same direction. */
    void refuse_leaving_waves(const Model<3> &model,
                              const std::vector<LoadParameters> &loads)
    {
      const auto enters
          = [&](const LoadParameters &load, const dealii::Tensor<1, 3> &d)
      {
        for (const BoundaryFace<3> &face :
             faces_of_curves(model.nodes(), load.boundaries, load.name))
          if (const auto outward = outward_area(face.points);
              d * outward < -1e-9 * outward.norm() * d.norm())
            return true;
        return false;
      };
      for (const LoadParameters &load : loads)
        // Waves that a free surface reflects enter, too.
        if (load.wave_direction && !load.free_surface
            && std::none_of(loads.begin(), loads.end(),
                            [&](const LoadParameters &other) {
                              return other.wave_direction
                                     && enters(other, *load.wave_direction);
                            }))
        {
          const auto &d = *load.wave_direction;
          throw InputError(text_of(
              "section 'Loads/", load.name, "': 'Incident direction = ", d[0],
              ", ", d[1], ", ", d[2],
              "' leads into the model through no face of 'Boundary', so that "
              "the wave would bring nothing. Point it into the model."));
        }
    }

    /** Refuses free fields with common nodes, where one alone would act. */
    template <int dim>
    void refuse_meeting_fields(
        const std::vector<const MotionConstraint<dim> *> &fields,
        const MPI_Comm communicator)
    {
      for (const auto *a : fields)
        for (const auto *b : fields)
        {
          std::vector<unsigned int> common;
          if (a != b)
            std::set_intersection(a->nodes().begin(), a->nodes().end(),
                                  b->nodes().begin(), b->nodes().end(),
                                  std::back_inserter(common));
          if (dealii::Utilities::MPI::max(int(!common.empty()), communicator)
              > 0)
            throw InputError("section 'Loads/" + a->name()
                             + "': 'Boundary' meets that of the load '"
                             + b->name()
                             + "', but where sides meet one free field acts on "
                               "the nodes. Give all of these sides to one "
                               "load.");
        }
    }
  } // namespace

  namespace
  {
    /** Whether @p group is of the same ground in @p a and @p b. */
    bool is_same(const FreeFieldGround &a, const FreeFieldGround &b,
                 const unsigned int group)
    {
      const LinearElastic &one   = a.materials[group],
                          &other = b.materials[group];
      return one.density == other.density && one.young == other.young
             && one.poisson == other.poisson
             && a.yields[group] == b.yields[group];
    }

    bool is_same(const FreeFieldGround &a, const FreeFieldGround &b)
    {
      for (unsigned int group = 0; group < a.materials.size(); ++group)
        if (!is_same(a, b, group))
          return false;
      return true;
    }

    template <int dim>
    std::unique_ptr<ViscousBoundary<dim>>
    viscous_boundary(const Model<dim> &model, const LoadParameters &load)
    {
      return std::make_unique<ViscousBoundary<dim>>(
          load, model.nodes(), impedance_beyond(model, load),
          model.thickness());
    }

    template <int dim>
    std::unique_ptr<FreeFieldBoundary<dim>>
    free_field(const Model<dim> &model, const LoadParameters &load,
               const LoadParameters &base)
    {
      return std::make_unique<FreeFieldBoundary<dim>>(
          load, model.nodes(), free_field_ground(model),
          FreeFieldBase{ base, impedance_beyond(model, base) });
    }
  } // namespace

  template <int dim>
  RunLoads<dim>::RunLoads(const Model<dim> &model,
                          const std::vector<LoadParameters> &given,
                          std::unique_ptr<FarField> far_field,
                          std::unique_ptr<StaticFarField> static_field)
  {
    const auto &nodes                 = model.nodes();
    std::vector<LoadParameters> loads = given;
    if constexpr (dim == 3)
      find_wave_origins(nodes, loads);
    for (const LoadParameters &load : loads)
    {
      names.push_back(load.name);
      if (load.has_added_mass && dim == 3)
        throw InputError("section 'Loads/" + load.name
                         + "': 'Added mass' is known in two dimensions alone. "
                           "Set it to 'none'.");
      if (load.has_added_mass)
        with_added_mass.push_back(load.name);
      switch (load.type)
      {
      case LoadType::viscous_boundary:
        add_open_boundary(model, load);
        break;
      case LoadType::prescribed_motion:
        constraints.push_back(
            std::make_unique<PrescribedMotion<dim>>(load, nodes));
        break;
      case LoadType::traction:
      case LoadType::gravity:
        nodal.emplace_back(load, nodes, model.mass(), model.thickness());
        if (load.pressure.field && load.pressure.field->uplift())
          follow_cracks(model, load, nodal.back());
        break;
      case LoadType::platen:
        constraints.push_back(
            std::make_unique<PlatenOf<dim>>(load, nodes, model.thickness()));
        break;
      case LoadType::boundary_elements:
        if constexpr (dim == 2)
          add_far_fields(std::move(far_field), std::move(static_field));
        break;
      case LoadType::initial_stress:
      case LoadType::free_field:
        break;
      }
    }
    add_free_fields(model, loads);
    refuse_leaving_waves(model, loads);
  }

  template <>
  void RunLoads<2>::add_far_fields(std::unique_ptr<FarField> far_field,
                                   std::unique_ptr<StaticFarField> static_field)
  {
    far.elastodynamic = far_field.get();
    if (far_field)
      constraints.push_back(std::move(far_field));
    far.elastostatic = static_field.get();
    if (static_field)
      constraints.push_back(std::move(static_field));
  }

  template <int dim>
  void
  RunLoads<dim>::add_open_boundary(const Model<dim> &model,
                                   const LoadParameters &load,
                                   const std::optional<LoadParameters> &base)
  {
    open_boundaries.push_back(
        { load, base, constraints.size(), free_field_ground(model) });
    if (base)
      constraints.push_back(free_field(model, load, *base));
    else
      constraints.push_back(viscous_boundary(model, load));
  }

  template <int dim>
  void RunLoads<dim>::follow_materials(const Model<dim> &model,
                                       const StageParameters &stage,
                                       const StageParameters *previous)
  {
    const FreeFieldGround now = free_field_ground(model);
    for (OpenBoundary &each : open_boundaries)
    {
      MotionConstraint<dim> &constraint = *constraints[each.position];
      if (!acts_in(constraint, stage) || is_same(now, each.ground))
        continue;
      if (each.base && previous && acts_in(constraint, *previous))
        refuse_moved_ground(model, each, now, stage);
      try
      {
        if (each.base)
          static_cast<FreeFieldBoundary<dim> &>(constraint)
              = std::move(*free_field(model, each.load, *each.base));
        else
          static_cast<ViscousBoundary<dim> &>(constraint)
              = std::move(*viscous_boundary(model, each.load));
      }
      catch (const InputError &error)
      {
        throw InputError("section 'Stages/" + stage.name
                         + "': with the materials of this stage, "
                         + error.what());
      }
      each.ground = now;
    }
    // Where viscous boundaries meet, the last one moves the nodes for all.
    std::vector<const ViscousBoundary<dim> *> before;
    for (const OpenBoundary &each : open_boundaries)
      if (MotionConstraint<dim> &constraint = *constraints[each.position];
          !each.base && acts_in(constraint, stage))
      {
        auto &boundary = static_cast<ViscousBoundary<dim> &>(constraint);
        boundary.take_over(before);
        before.push_back(&boundary);
      }
  }

  template <int dim>
  void RunLoads<dim>::refuse_moved_ground(const Model<dim> &model,
                                          const OpenBoundary &field,
                                          const FreeFieldGround &now,
                                          const StageParameters &stage) const
  {
    for (const BoundaryFace<dim> &face :
         faces_of_curves(model.nodes(), field.load.boundaries, field.load.name))
      if (!is_same(now, field.ground, face.group))
        throw InputError(
            "section 'Stages/" + stage.name + "': 'Materials' changes '"
            + model.nodes().table().group_names[face.group]
            + "' along the boundary of the load '" + field.load.name
            + "', while the ground beside it moves with the former material. "
              "Change it in the stage in which the load begins, and hold the "
              "side by a prescribed motion until then: the load keeps its "
              "reactions.");
  }

  template <int dim>
  void RunLoads<dim>::add_free_fields(const Model<dim> &model,
                                      const std::vector<LoadParameters> &loads)
  {
    std::vector<const MotionConstraint<dim> *> fields;
    for (const LoadParameters &load : loads)
    {
      if (load.type != LoadType::free_field)
        continue;
      const auto base = std::find_if(loads.begin(), loads.end(),
                                     [&](const LoadParameters &other)
                                     { return other.name == load.base; });
      if (base == loads.end()
          || (base->type != LoadType::viscous_boundary
              && base->type != LoadType::prescribed_motion))
        throw InputError("section 'Loads/" + load.name
                         + "': 'Base = " + load.base
                         + "' must name the load that drives the base of the "
                           "model, of type 'viscous boundary' or 'prescribed "
                           "motion'.");
      if (base->differs_by_place())
        throw InputError("section 'Loads/" + load.name
                         + "': 'Base = " + load.base
                         + "' is a motion that differs from place to place, "
                           "but waves in the column beside the model are those "
                           "of one motion. Give the base a function of time "
                           "alone.");
      if (base->wave_direction)
        throw InputError("section 'Loads/" + load.name
                         + "': 'Base = " + load.base
                         + "' has an 'Incident direction', but waves between "
                           "free fields rise vertically. Take it out, or let a "
                           "'viscous boundary' all around the model pass the "
                           "wave.");
      add_open_boundary(model, load, *base);
      fields.push_back(constraints.back().get());
    }
    if (dim == 3)
      refuse_meeting_fields(fields, model.nodes().communicator());
  }

  template <int dim>
  bool RunLoads<dim>::acts_in(const MotionConstraint<dim> &constraint,
                              const StageParameters &stage) const
  {
    if constexpr (dim == 2)
    {
      const bool is_static = stage.end == StageEnd::static_ratio;
      if ((&constraint == far.elastodynamic && is_static)
          || (&constraint == far.elastostatic && far.elastodynamic
              && !is_static))
        return false;
    }
    return names_load(stage, constraint.name());
  }

  template <int dim>
  std::vector<std::string>
  RunLoads<dim>::loads_that_hold(const StageParameters &stage,
                                 const StageParameters &previous) const
  {
    std::vector<std::string> result;
    for (const auto &constraint : constraints)
    {
      bool follows_waves = false;
      if constexpr (dim == 2)
        follows_waves = constraint.get() == far.elastostatic
                        && far.elastodynamic
                        && acts_in(*far.elastodynamic, previous);
      if (constraint->traits().kind == MotionKind::absorbing
          && acts_in(*constraint, stage) && !acts_in(*constraint, previous)
          && !follows_waves)
        result.push_back(constraint->name());
    }
    return result;
  }

  template <int dim>
  bool RunLoads<dim>::has_added_mass(const std::string &load) const
  {
    return std::count(with_added_mass.begin(), with_added_mass.end(), load) > 0;
  }

  template <int dim>
  void RunLoads<dim>::check(const StageParameters &stage) const
  {
    for (const std::string &name : stage.loads)
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError("section 'Stages/" + stage.name + "': 'Loads' names '"
                         + name + "', which is no load. Loads are: "
                         + known_names_like(name, names) + ".");

    for (const auto &constraint : constraints)
      if (names_load(stage, constraint->name())
          && !constraint->traits().companion.empty()
          && !names_load(stage, constraint->traits().companion))
        throw InputError(
            "section 'Stages/" + stage.name + "': 'Loads' names '"
            + constraint->name() + "', whose columns stand on the base '"
            + constraint->traits().companion + "', but not that. Add it.");

    if (stage.slows_loads())
      for (const auto &constraint : constraints)
        if (constraint->traits().kind == MotionKind::absorbing
            && acts_in(*constraint, stage))
          throw InputError("section 'Stages/" + stage.name
                           + "': 'Kinetic energy limit' slows loads down, "
                             "which waves through the boundary of the load '"
                           + constraint->name()
                           + "' cannot follow. Set it to 0, or use that load "
                             "in another stage.");
  }

  template <int dim>
  Resultant<dim> RunLoads<dim>::resultant(const std::string &load,
                                          const MPI_Comm communicator) const
  {
    const MotionConstraint<dim> *idle = nullptr; // of two with one name
    if constexpr (dim == 2)
    {
      if (far.elastostatic_acts)
        idle = far.elastodynamic;
      else
        idle = far.elastostatic;
    }
    for (const auto &constraint : constraints)
      if (constraint->name() == load && constraint.get() != idle)
      {
        auto values = constraint->resultant();
        if (!constraint->traits().is_rigid_body())
          MPI_Allreduce(MPI_IN_PLACE, values.data(), values.size(), MPI_DOUBLE,
                        MPI_SUM, communicator);
        return values;
      }
    throw InputError("'" + load
                     + "' is no prescribed motion, platen, viscous or "
                       "free-field boundary, so it has no reaction.");
  }

  template struct RunLoads<2>;
  template struct RunLoads<3>;
} // namespace quoin
