// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_parameters_plausibility_h
#define quoin_parameters_plausibility_h

#include <quoin/parameters/parameters.h>

namespace quoin
{
  /** Young's modulus below which no stone, brick or soil is [Pa]. */
  constexpr double softest_modulus = 1e6;

  /** Normal stiffness below which no joint of blocks that matter is [Pa/m]. */
  constexpr double softest_joint = 1e5;

  /**
   * Warnings about values that are allowed but far from those of all rocks,
   * bricks, mortars, concretes and soils, with the unit that was likely meant:
   * of materials, joints, gravity and the thickness. @p top is the file of
   * @p parameters.
   */
  std::vector<std::string> implausible_values(const ParameterSection &top,
                                              const Parameters &parameters);

  /**
   * Warnings about stages of the explicit solver whose file gives coefficients
   * of Rayleigh damping without that, or that without coefficients. @p top is
   * the file of @p parameters.
   */
  std::vector<std::string> idle_damping(const ParameterSection &top,
                                        const Parameters &parameters);

  /**
   * Warnings about properties of materials and joints and about entries of
   * histories that the file of @p top gives and that their law or quantity does
   * not read. @p prm has notes of what was read.
   */
  std::vector<std::string> idle_properties(const NotedParameters &prm,
                                           const ParameterSection &top);

  /** Warnings about what needs motion, which the implicit solver leaves out:
      histories of velocities and the mass of the water before a dam. */
  std::vector<std::string> idle_motion(const Parameters &parameters);

  /**
   * Warnings about tables and records of @p parameters that last far longer
   * than all stages, of which the run reads next to nothing: their times may
   * be in milliseconds. None if no stage ends by time.
   */
  std::vector<std::string> long_time_files(const Parameters &parameters);
} // namespace quoin

#endif
