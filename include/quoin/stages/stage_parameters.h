// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_stages_stage_parameters_h
#define quoin_stages_stage_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/stages/factor_search.h>
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
    local,    /**< Cundall's, of each degree of freedom */
    adaptive, /**< mass-proportional, its coefficient adapted to the power */
    rayleigh
  };

  /** Default share of the unbalanced force that local damping opposes. */
  constexpr double default_local_damping = 0.8;

  enum class StageEnd
  {
    time,
    static_ratio
  };

  /** A condition on histories by which a stage ends: see HistoryConditions. */
  struct EndCondition
  {
    std::string outcome; /**< outcome of the stage if the condition is met */
    std::string expression;
  };

  /** Loads that one factor scales, so that a displacement follows a function of
      time; see LoadPattern. */
  struct PatternParameters
  {
    std::vector<std::string> loads;
    std::string controlled = "mean"; /**< "mean" or the name of a history */
    /** Function of the time in the stage, from 0 on [m]. */
    TimeFunction control;
  };

  /** Results that are reset at the start of a stage: see ResultOrigin. */
  struct ResultReset
  {
    bool displacements = false;
    bool slips         = false; /**< slip of joints */
    bool joint_states  = false;

    bool any() const
    {
      return displacements || slips || joint_states;
    }
  };

  /** One stage of a run: a subsection of 'Stages'. */
  struct StageParameters
  {
    std::string name;
    std::vector<std::string> loads;
    StageEnd end            = StageEnd::time;
    double duration         = 0.; /**< [s] */
    double static_ratio     = 1e-6;
    double minimum_duration = 0.; /**< minimum duration of a static stage [s] */
    std::uint64_t maximum_steps = 0;
    double start_time           = -1.; /**< [s]; -1: previous end */
    /** Conditions in addition to 'End'. */
    std::vector<EndCondition> end_conditions;

    DampingType damping          = DampingType::none;
    double local_coefficient     = 0.;
    double mass_coefficient      = 0.; /**< alpha [1/s] */
    double stiffness_coefficient = 0.; /**< beta [s] */

    double scaled_time_step = 0.; /**< time step of mass scaling [s]; 0: none */

    /** Ratio of kinetic energy to energy throughput above which the loading
        rate is reduced [-]; 0: loads follow the time. */
    double kinetic_limit = 0.;

    std::vector<std::string> excavate; /**< physical surfaces */
    std::vector<std::string> fill;     /**< physical surfaces */
    /** Released share of the forces of excavated blocks at the end [-]. */
    double release = 1.;
    /** Duration in load time [s]; -1: automatic. */
    double release_duration = -1.;
    /** None given: by the implicit solver alone, as a rate that jumps makes
        waves in dynamics. */
    std::optional<bool> releases_linearly;
    /** Physical surfaces and their new materials. */
    std::vector<std::pair<std::string, std::string>> materials;
    /** Joint sets and the sets whose laws they take over. */
    std::vector<std::pair<std::string, std::string>> joint_properties;

    /** Cohesion, tensile strength and tangent of the friction angle of joints
        and blocks by those of their parameters [-]. */
    double strength_factor = 1.;

    /** Loads beside 'loads' that are scaled; see PatternParameters. */
    std::optional<PatternParameters> pattern;

    ResultReset reset; /**< reset at the start of the stage */

    /** Strength reduction by trials, which leave the state unchanged. */
    std::optional<SafetyParameters> safety;

    bool changes_properties() const
    {
      return !materials.empty() || !joint_properties.empty();
    }

    bool slows_loads() const
    {
      return kinetic_limit > 0.;
    }

    /** Whether the stage lasts as long as 'Duration' says. */
    bool duration_is_known() const
    {
      return end == StageEnd::time && !slows_loads() && end_conditions.empty();
    }

    /** Whether the stage computes waves, not equilibria. */
    bool is_dynamic() const
    {
      return end == StageEnd::time && !slows_loads()
             && (damping == DampingType::none
                 || damping == DampingType::rayleigh);
    }

    /** "stage S: loads, end, damping and construction", for --check. */
    std::string text(bool is_implicit) const;

    static void declare(dealii::ParameterHandler &prm);
    static StageParameters read(const ParameterSection &section,
                                const std::string &name);
  };

  /** Whether @p stage names the load @p name. */
  bool names_load(const StageParameters &stage, const std::string &name);

  /** The last stage before @p index that leaves the state changed (no safety
      stage), or null. */
  const StageParameters *
  previous_stage(const std::vector<StageParameters> &stages,
                 unsigned int index);

  /** Reads section 'Stages'. Throws an InputError also where stages contradict
      each other or the @p loads that they name. */
  std::vector<StageParameters>
  read_stages(const ParameterSection &top,
              const std::vector<LoadParameters> &loads, bool is_implicit);

  /** Start time of stage @p index, or the end of the last one [s], without the
      unknown durations of static stages. */
  double start_of_stage(const std::vector<StageParameters> &stages,
                        unsigned int index);
} // namespace quoin

#endif
