// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_boundary_parameters_h
#define quoin_farfield_boundary_parameters_h

#include <quoin/signals/space_time_function.h>
#include <quoin/base/parameter_section.h>
#include <quoin/farfield/far_field.h>
#include <quoin/signals/time_function.h>
#include <quoin/materials/material_parameters.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/tdbem/formulation.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace quoin
{
  enum class BoundaryShape
  {
    circle,
    polygon,
    line,
    arc,
    mesh,     /**< physical curves of the mesh file */
    interface /**< curves of the mesh with blocks on the other side */
  };

  /** Polygon that approximates a circle. */
  enum class CirclePolygon
  {
    inscribed, /**< vertices on the circle */
    equal_area,
    equal_perimeter
  };

  /** Side of a boundary on which the domain lies. */
  enum class DomainSide
  {
    inside,
    outside,
    left, /**< left of the direction of an open boundary */
    right
  };

  /** One boundary: a subsection of 'Boundary elements'. */
  struct BoundaryCurveParameters
  {
    std::string name;
    BoundaryShape shape = BoundaryShape::circle;
    DomainSide domain   = DomainSide::outside;

    std::array<double, 2> centre{}; /**< [m] */
    double radius = 0.;             /**< [m] */
    std::array<double, 2> angles{}; /**< first and last angle [rad] */
    std::vector<std::array<double, 2>> points; /**< [m] */
    std::vector<std::string> curves;

    unsigned int n_elements = 0;  /**< 0: from the element length */
    double element_length   = 0.; /**< [m]; 0: that of the section */
    double grading          = 1.; /**< last element length by first */
    CirclePolygon polygon   = CirclePolygon::inscribed;

    /** Whether the value is a traction [Pa] or a displacement [m], by
     * component. */
    std::array<bool, 2> traction_is_given{ { true, true } };
    std::array<SpaceTimeFunction, 2> value;
    SpaceTimeFunction pressure; /**< pushes on the domain [Pa] */

    static void declare(dealii::ParameterHandler &prm);
    static BoundaryCurveParameters read(const ParameterSection &section,
                                        const std::string &name);
  };

  enum class IncidentWaveType
  {
    plane_p,
    plane_sv,
    rayleigh,
    line_source
  };

  /** One incident wave: a subsection of 'Incident waves'. */
  struct IncidentWaveParameters
  {
    std::string name;
    IncidentWaveType type = IncidentWaveType::plane_p;
    bool half_plane       = false; /**< reflected at the free surface y = 0 */
    double angle = 0.; /**< angle from the upward vertical towards +x [rad] */
    std::array<double, 2> position{}; /**< position of a line source [m] */
    /** Number of integrations from the signal to displacement. */
    unsigned int n_integrations = 0;
    double amplitude            = 1.; /**< factor of the signal */
    Signal signal;
    std::string signal_entry; /**< 'Signal' or 'Displacement' */

    /**
     * Displacement at the origin [m] or moment [N] as a function of time
     * @param begin, end, step of what is integrated numerically [s]
     */
    std::function<double(double)> function(double begin, double end,
                                           double step) const;

    /** "plane P wave" */
    std::string type_text() const;

    static void declare(dealii::ParameterHandler &prm);
    static IncidentWaveParameters read(const ParameterSection &section,
                                       const std::string &name);
  };

  /** Where the field in the domain is computed: 'Sampled field'. */
  struct SampledFieldParameters
  {
    bool has_box = false;
    std::array<double, 4> box{}; /**< xmin, ymin, xmax, ymax [m] */
    double spacing = 0.;         /**< [m] */

    static void declare(dealii::ParameterHandler &prm);
    static SampledFieldParameters read(const ParameterSection &section);
  };

  /** A run of boundary elements: section 'Boundary elements' and the like. */
  struct BoundaryElementParameters
  {
    std::string material; /**< material of the domain */
    ElasticMedium medium{};
    Formulation formulation  = Formulation::galerkin;
    bool is_static           = false;
    double element_length    = 0.; /**< [m]; 0: each boundary has its own */
    double highest_frequency = 0.; /**< [Hz]; sets element_length if not 0 */
    double step_ratio        = 0.; /**< c_1 dt / shortest element */
    double time_step         = 0.; /**< [s]; 0: as the ratio says */
    double duration          = 0.; /**< [s] */
    double decay             = 0.; /**< [1/s] */
    RayleighDamping damping;
    CouplingScheme coupling = CouplingScheme::implicit;
    bool direct_history     = false;
    double tolerance        = 1e-6;
    /** Number of frequencies of the passivity check. */
    unsigned int n_frequencies = 64;

    std::vector<BoundaryCurveParameters> boundaries;
    std::vector<IncidentWaveParameters> waves;
    SampledFieldParameters sampled_field;

    /** All but the time step and the number of steps. */
    FormulationOptions formulation_options() const;

    /** Whether a boundary has the shape @p shape. */
    bool has(BoundaryShape shape) const;
    /** Physical curves along which blocks lie. */
    std::vector<std::string> interface_curves() const;

    /** The time step that is asked for on @p boundary [s]. */
    double wanted_time_step(const Boundary &boundary) const;

    /** The entries of the section itself. */
    static void declare(dealii::ParameterHandler &prm);
    /**
     * Sections 'Boundary elements', 'Incident waves' and 'Sampled field', with
     * one of @p materials; @p coupled: to blocks, which say how long.
     */
    static BoundaryElementParameters
    read(const ParameterSection &top,
         const std::vector<MaterialParameters> &materials, bool coupled);
  };
} // namespace quoin

#endif
