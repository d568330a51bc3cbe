// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_implicit_parameters_h
#define quoin_implicit_implicit_parameters_h

#include <quoin/base/parameter_section.h>

#include <string>
#include <vector>

namespace quoin
{
  enum class LinearSolverType
  {
    automatic, /**< direct up to a size, then iterative */
    direct,
    iterative
  };

  enum class PathFollowing
  {
    never,
    automatic, /**< path following if load steps do not converge */
    always     /**< path following once joints of the sets yield */
  };

  /** Section 'Implicit': the equilibrium iterations. */
  struct ImplicitParameters
  {
    double first_step    = 0.01; /**< share of the stage [-] */
    double largest_step  = 0.05; /**< share of the stage [-] */
    double smallest_step = 1e-7; /**< share of the stage [-] */
    double force_ratio   = 1e-6; /**< unbalanced to applied force [-] */
    unsigned int wanted_iterations  = 8;
    unsigned int maximum_iterations = 25;
    bool line_search                = true;
    bool jumps                      = true;

    PathFollowing path = PathFollowing::never;
    std::vector<std::string> path_joints; /**< sets; empty: all */
    double largest_path_step = 1e-5;      /**< mean inelastic motion [m] */

    LinearSolverType linear_solver = LinearSolverType::automatic;

    static void declare(dealii::ParameterHandler &prm);
    static ImplicitParameters read(const ParameterSection &section);
  };
} // namespace quoin

#endif
