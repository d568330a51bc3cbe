// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_load_parameters_h
#define quoin_loads_load_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/loads/in_situ_stress.h>
#include <quoin/signals/space_time_function.h>
#include <quoin/signals/time_function.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  enum class LoadType
  {
    prescribed_motion,
    traction,
    viscous_boundary,
    free_field,
    platen,
    gravity,
    initial_stress,   /**< initial stress, including LoadParameters::in_situ */
    boundary_elements /**< boundary elements of section 'Boundary elements' */
  };

  /** Quantity of a time function of a load. */
  enum class LoadQuantity
  {
    free,
    force, /**< traction [Pa], acceleration [m/s^2], force [N], moment */
    velocity,
    displacement /**< displacement since the start of the stage */
  };

  class LoadField;
  struct MovingShape;

  struct LoadComponent
  {
    LoadQuantity quantity = LoadQuantity::free;
    /** Where it differs from place to place: a function that changes when it
        does; of water the level. */
    TimeFunction value;
    /** Value by place and time; null: it is the same everywhere. */
    std::shared_ptr<const LoadField> field = nullptr;

    /** Value at @p place in the mesh [m]. */
    double at(const dealii::Point<3> &place, const TimePoint &time) const;
  };

  /** Values of the functions; zero for free components. */
  std::array<double, 3>
  component_values(const std::array<LoadComponent, 3> &components,
                   const TimePoint &time);

  /**
   * Throws an InputError naming @p load and one of @p names if a displacement
   * is not zero at @p time, the start of a stage.
   */
  void check_no_jump(const std::array<LoadComponent, 3> &components,
                     const std::array<const char *, 3> &names,
                     const TimePoint &time, const std::string &load);

  /** One load: a subsection of 'Loads'. */
  struct LoadParameters
  {
    std::string name;
    LoadType type = LoadType::traction;
    std::vector<std::string> boundaries; /**< physical curves */
    std::vector<std::string> groups;     /**< physical surfaces */

    /**
     * Components x, y and, for platens, the rotation; for a viscous boundary
     * the incident normal and shear velocity. along_axes() has components x, y,
     * z, and the rotations of platens apart.
     */
    std::array<LoadComponent, 3> components;
    /** Rotations of a platen in three dimensions about x, y and, in
        along_axes() alone, z. */
    std::array<LoadComponent, 3> rotations;
    LoadComponent lateral;  /**< component y in three dimensions, where the
                               vertical one is z */
    LoadComponent pressure; /**< pressure of tractions */
    /** Time over which gravity grows where it begins [s]; -1: automatic. */
    double ramp_duration = -1.;

    /** Tractions and gravity: factor by which they differ from place to place,
        of the position in the mesh alone [-]; none: 1. */
    std::optional<SpaceTimeFunction> distribution;
    /** Tractions, the pressure of water: whether it also adds its mass, see
        HydrodynamicMass, and the floor of the reservoir [m]; none: the lowest
        point of 'boundaries'. */
    bool has_added_mass = false;
    std::optional<double> reservoir_floor;
    /** Tractions: factor that travels along the boundary; null: 1. */
    std::shared_ptr<const MovingShape> shape;

    /** Whether tractions or motions differ from place to place, but for
        'distribution'. */
    bool differs_by_place() const;

    /** Whether the pressure is that of water at rest, without a factor by
        place, which follows the faces that it presses on. */
    bool is_water_that_follows() const;

    /** Whether tractions are a pressure and nothing else: it may act in
        joints. */
    bool is_pressure_alone() const;

    /** All functions of time: the components, lateral, pressure, rotations. */
    std::array<LoadComponent, 7> functions() const
    {
      return { components[0], components[1], components[2], lateral,
               pressure,      rotations[0],  rotations[1] };
    }

    /** This load with its components along the axes in @p dim dimensions.
        Throws an InputError about a component that does not exist there. */
    template <int dim>
    LoadParameters along_axes() const;

    /** Viscous boundary: material beyond; empty: that of the cells there. */
    std::string far_material;
    /** Viscous boundary in three dimensions: direction in which incident waves
        propagate [-]; none: along the normal. A place that they pass at t = 0
        [m]; none: where they reach the boundary. Height of a free surface that
        reflects them [m]; none: there is none. */
    std::optional<dealii::Tensor<1, 3>> wave_direction;
    std::optional<dealii::Point<3>> wave_origin;
    std::optional<double> free_surface;
    std::string
        base; /**< free field: load that drives the foot of the column */

    std::array<double, 3> stress{}; /**< xx, yy, xy at y = 0 [Pa] */
    /** Stress gradient with y [Pa/m]. */
    std::array<double, 3> stress_gradient{};
    /** zz at y = 0 [Pa] and its gradient [Pa/m]; none: nu (xx + yy). */
    std::optional<std::array<double, 2>> stress_zz;
    /** In three dimensions, in place of these: xx, yy, zz, xy, xz, yz at z = 0
        [Pa] and their gradient with z [Pa/m]. */
    std::optional<std::array<double, 6>> space_stress;
    std::array<double, 6> space_gradient{};
    /** xx, yy, xy [Pa] as functions of the place and, if it is one, zz, or the
        six of three dimensions; empty: the numbers above. */
    std::vector<SpaceTimeFunction> stress_fields;
    /** Stress by depth, instead of all of these. */
    std::optional<InSituStress> in_situ;

    /** Initial stress xx, yy, xy, zz [Pa] at (@p x, @p y) of a material with
        the given Poisson's ratio. */
    std::array<double, 4> initial_stress(double x, double y,
                                         double poisson) const;

    /** Initial stress xx, yy, zz, xy, xz, yz [Pa] at @p place in three
        dimensions. */
    std::array<double, 6> initial_stress(const dealii::Point<3> &place) const;

    /** The name of its type in parameter files. */
    std::string type_text() const;

    /** A component that the load type has. */
    struct NamedComponent
    {
      std::string name; /**< "horizontal", as in a parameter file */
      std::string unit;
      const LoadComponent &component;
    };
    /** The components that are not free. */
    std::vector<NamedComponent> given_components() const;

    static void declare(dealii::ParameterHandler &prm);
    static LoadParameters read(const ParameterSection &section,
                               const std::string &name);
  };
} // namespace quoin

#endif
