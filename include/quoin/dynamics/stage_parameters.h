// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_stage_parameters_h
#define quoin_dynamics_stage_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/dynamics/factor_search.h>
#include <quoin/loads/load_parameters.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  enum class DampingType
  {
    none,
    local,    /**< Cundall's: opposes the unbalanced force, per freedom */
    adaptive, /**< mass-proportional, its coefficient led by the power */
    rayleigh
  };

  enum class StageEnd
  {
    time,
    static_ratio
  };

  /** One stage of a run: a subsection of 'Stages'. */
  struct StageParameters
  {
    std::string name;
    std::vector<std::string> loads;
    StageEnd end                = StageEnd::time;
    double duration             = 0.; /**< [s] */
    double static_ratio         = 1e-6;
    double minimum_duration     = 0.; /**< of a static stage [s] */
    std::uint64_t maximum_steps = 0;
    double start_time           = -1.; /**< [s]; -1: previous end */

    DampingType damping          = DampingType::none;
    double local_coefficient     = 0.;
    double mass_coefficient      = 0.; /**< alpha [1/s] */
    double stiffness_coefficient = 0.; /**< beta [s] */

    double scaled_time_step = 0.; /**< of mass scaling [s]; 0: none */

    /** Above this share of the energy that went through, kinetic energy slows
        the loads down [-]; 0: they follow the time. */
    double kinetic_limit = 0.;

    std::vector<std::string> excavate; /**< physical surfaces */
    std::vector<std::string> fill;     /**< physical surfaces */
    /** Share of what excavated blocks exerted that is gone in the end [-]. */
    double release = 1.;
    double release_duration
        = -1.; /**< of the loads' clock [s]; -1: automatic */
    bool releases_linearly = false;
    /** Physical surfaces and the materials they are made of from now on. */
    std::vector<std::pair<std::string, std::string>> materials;
    /** Joint sets and those whose laws they follow from now on. */
    std::vector<std::pair<std::string, std::string>> joint_properties;

    /** The stage settles with ever lower strength, and changes nothing. */
    std::optional<SafetyParameters> safety;

    bool changes_properties() const
    {
      return !materials.empty() || !joint_properties.empty();
    }

    bool slows_loads() const
    {
      return kinetic_limit > 0.;
    }

    /** Whether waves, not equilibria, are what the stage computes. */
    bool is_dynamic() const
    {
      return end == StageEnd::time && !slows_loads() && scaled_time_step == 0.
             && (damping == DampingType::none
                 || damping == DampingType::rayleigh);
    }

    /** "stage S: loads, end, damping and what is built", for --check. */
    std::string text(bool is_implicit) const;

    static void declare(dealii::ParameterHandler &prm);
    static StageParameters read(const ParameterSection &section,
                                const std::string &name);
  };

  /** The last one before stage @p index that leaves the model changed, or
      null. */
  const StageParameters *
  previous_stage(const std::vector<StageParameters> &stages,
                 unsigned int index);

  /** Section 'Stages'. Throws an InputError also where stages do not go
      together, or with the @p loads that they name. */
  std::vector<StageParameters>
  read_stages(const ParameterSection &top,
              const std::vector<LoadParameters> &loads, bool is_implicit);

  /** The time when stage @p index begins [s], without what stages that settle
      take, or all of them together. */
  double start_of_stage(const std::vector<StageParameters> &stages,
                        unsigned int index);
} // namespace quoin

#endif
