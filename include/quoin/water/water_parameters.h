// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_water_water_parameters_h
#define quoin_water_water_parameters_h

#include <quoin/base/known_names.h>
#include <quoin/base/parameter_section.h>
#include <quoin/signals/time_function.h>
#include <quoin/water/flow_network.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  /** Hydraulic aperture of a joint set, by which water flows: a subsection of
      'Water joints'. */
  struct HydraulicAperture
  {
    std::string name;       /**< of the joint set */
    double initial  = 1e-4; /**< where the mesh has the joint [m] */
    double residual = 1e-5; /**< smallest one [m] */
    double largest  = 1e-3; /**< largest one [m] */

    /** Aperture of a joint that has opened by @p opening [m]. */
    double at(const double opening) const
    {
      return std::min(std::max(initial + opening, residual), largest);
    }
    /** Whether it changes with the opening. */
    bool moves(const double opening) const
    {
      return initial + opening > residual && initial + opening < largest;
    }

    static void declare(dealii::ParameterHandler &prm);
    static HydraulicAperture read(const ParameterSection &section,
                                  const std::string &name);
  };

  enum class WaterQuantity
  {
    pressure, /**< [Pa] */
    head,     /**< height to which water would rise [m] */
    flow,     /**< into the joints, of all nodes together [m^3/s] */
    outlet    /**< water leaves at pressure 0, none enters */
  };

  /** Where something is given of the flow: a subsection of 'Water boundaries'.
   */
  struct WaterBoundary
  {
    std::string name;
    /** Curves on which joints end, or of joints; or none. */
    std::vector<std::string> curves;
    std::optional<std::array<double, 2>> point; /**< [m] */
    WaterQuantity quantity = WaterQuantity::pressure;
    TimeFunction value;

    static void declare(dealii::ParameterHandler &prm);
    static WaterBoundary read(const ParameterSection &section,
                              const std::string &name);
  };

  /** Water in the joints when transient flow begins. */
  enum class InitialWater
  {
    dry,   /**< pressure 0; with a free surface: none */
    full,  /**< pressure 0, joints filled */
    steady /**< steady flow */
  };

  enum class FlowKind
  {
    none,
    steady,
    transient
  };

  /** Flow of water in joints: sections 'Water', 'Water joints' and 'Water
      boundaries'. */
  struct WaterParameters
  {
    FlowKind flow = FlowKind::none;
    Fluid fluid;
    InitialWater initial  = InitialWater::dry;
    bool has_suction      = false;   /**< negative pressures pull */
    unsigned int interval = 100;     /**< explicit steps between solutions */
    std::vector<std::string> stages; /**< in which it acts; empty: all */
    std::vector<HydraulicAperture> joints;
    std::vector<WaterBoundary> boundaries;

    /** Whether water is in the joints in stage @p name. */
    bool acts_in(const std::string &name) const
    {
      return stages.empty() || is_among(name, stages);
    }
    /** Whether loads change with time in a stage of @p duration that began at
        @p start [s] because of the water. */
    bool changes(double start, double duration) const;
    /** Number of explicit steps by which water follows what is given late. */
    unsigned int lag() const
    {
      return flow == FlowKind::steady ? interval : 1;
    }

    static void declare(dealii::ParameterHandler &prm);
    /** Reads the three sections of @p top. */
    static WaterParameters read(const ParameterSection &top);
  };
} // namespace quoin

#endif
