// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_parameters.h>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;
  } // namespace

  void ImplicitParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("First step", "0.01", Double(),
                      "Share of a stage's duration, and of the out-of-balance "
                      "forces at its start [-]");
    prm.declare_entry("Largest step", "0.05", Double(),
                      "Steps grow to this share of the stage while few "
                      "iterations are needed [-]");
    prm.declare_entry("Smallest step", "1e-7", Double(),
                      "A stage fails that does not converge with this share "
                      "of it [-]");
    prm.declare_entry("Force ratio", "1e-6", Double(),
                      "Unbalanced to applied force, each summed over nodes, "
                      "at which iterations end [-]");
    prm.declare_entry("Wanted iterations", "8", Integer(1),
                      "Steps grow if fewer are needed, else shrink [-]");
    prm.declare_entry("Maximum iterations", "25", Integer(2),
                      "A step that needs more is cut [-]");
    prm.declare_entry("Line search", "yes", Selection("yes|no|true|false"),
                      "Shorten iterations that do not bring the unbalanced "
                      "force down.");
    prm.declare_entry("Jumps", "yes", Selection("yes|no|true|false"),
                      "Where no equilibrium is near, move at constant loads "
                      "against a drag until there is one, as a test under "
                      "given displacements would; what the drag takes is "
                      "booked as damping. If not, the stage fails there.");
    prm.declare_entry("Path following", "never",
                      Selection("never|automatic|always"),
                      "The load time becomes an unknown, which may go back, "
                      "and steps are those of the mean inelastic opening and "
                      "slip of joints: where steps of the loads do not "
                      "converge, or as soon as joints flow.");
    prm.declare_entry("Path joints", "", Anything(),
                      "Joint sets whose inelastic opening and slip measure "
                      "the path; empty: all.");
    prm.declare_entry("Largest path step", "1e-5", Double(),
                      "Of the mean over the area of these joints [m]");
    prm.declare_entry("Linear solver", "automatic",
                      Selection("automatic|direct|iterative"),
                      "direct: LU factors, by Amesos; iterative: GMRES with "
                      "algebraic multigrid that knows the rigid motions; "
                      "automatic: iterative beyond 200 000 unknowns.");
  }

  ImplicitParameters ImplicitParameters::read(const ParameterSection &section)
  {
    ImplicitParameters parameters;
    parameters.first_step    = section.positive("First step");
    parameters.largest_step  = section.within("Largest step", 0., 1.);
    parameters.smallest_step = section.positive("Smallest step");
    for (const std::string name : { "Smallest step", "First step" })
      if (section.number(name) > parameters.largest_step)
        section.fail(name, "must not exceed 'Largest step'.");
    if (parameters.smallest_step > parameters.first_step)
      section.fail("Smallest step", "must not exceed 'First step'.");
    parameters.force_ratio        = section.within("Force ratio", 1e-14, 0.1);
    parameters.wanted_iterations  = section.integer("Wanted iterations");
    parameters.maximum_iterations = section.integer("Maximum iterations");
    if (parameters.wanted_iterations > parameters.maximum_iterations)
      section.fail("Wanted iterations", "must not exceed 'Maximum "
                                        "iterations'.");
    parameters.line_search = section.flag("Line search");
    parameters.jumps       = section.flag("Jumps");
    parameters.path        = section.choice<PathFollowing>(
        "Path following", { { "never", PathFollowing::never },
                                   { "automatic", PathFollowing::automatic },
                                   { "always", PathFollowing::always } });
    parameters.path_joints       = section.list("Path joints");
    parameters.largest_path_step = section.positive("Largest path step");
    parameters.linear_solver     = section.choice<LinearSolverType>(
        "Linear solver", { { "automatic", LinearSolverType::automatic },
                               { "direct", LinearSolverType::direct },
                               { "iterative", LinearSolverType::iterative } });
    return parameters;
  }
} // namespace quoin
