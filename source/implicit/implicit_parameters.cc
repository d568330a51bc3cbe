// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/implicit/implicit_parameters.h>

namespace quoin
{
  namespace
  {
    void check_steps(const ParameterSection &section,
                     const ImplicitParameters &parameters)
    {
      for (const std::string name : { "Smallest step", "First step" })
        if (section.number(name) > parameters.largest_step)
          section.fail(name, "must not exceed 'Largest step'.");
      if (parameters.smallest_step > parameters.first_step)
        section.fail("Smallest step", "must not exceed 'First step'.");
      if (parameters.wanted_iterations > parameters.maximum_iterations)
        section.fail("Wanted iterations", "must not exceed 'Maximum "
                                          "iterations'.");
    }

    void enter(ParameterEntries &entries, ImplicitParameters &parameters)
    {
      entries.positive(
          "First step", parameters.first_step,
          "First load increment of a stage, as a fraction of its duration and "
          "of the out-of-balance forces at its start; later ones are longer "
          "only while the motion of one, continued, leaves few forces out of "
          "balance in the next [-]");
      entries.within(
          "Largest step", parameters.largest_step, 0., 1.,
          "Largest load increment, as a fraction of the stage, up to which "
          "increments grow while few iterations are needed and the motion "
          "continues [-]");
      entries.positive("Smallest step", parameters.smallest_step,
                       "Smallest load increment, as a fraction of the stage; "
                       "the stage fails if it does not converge with it [-]");
      entries.within("Force ratio", parameters.force_ratio, 1e-14, 0.1,
                     "Ratio of unbalanced to applied force, each summed over "
                     "nodes, at which iterations have converged; with "
                     "transient flow of water at most 1e-8 [-]");
      entries.integer("Wanted iterations", parameters.wanted_iterations, 1,
                      "Number of iterations of a step below which steps grow "
                      "and above which they are reduced [-]");
      entries.integer("Maximum iterations", parameters.maximum_iterations, 2,
                      "Number of iterations beyond which a step is repeated "
                      "with a smaller increment [-]");
      entries.flag("Line search", parameters.line_search,
                   "Whether a line search shortens iterations that do not "
                   "reduce the unbalanced force.");
      entries.flag("Jumps", parameters.jumps,
                   "Whether the model, where no equilibrium is near, moves "
                   "against a viscous drag, while loads go on slowly by a "
                   "part of the step and then rest, until it reaches one, as "
                   "in a displacement-controlled test; the work of the "
                   "drag is booked as damping. If not, the stage fails there.");
      entries.choice(
          "Path following", parameters.path,
          { { "never", PathFollowing::never },
            { "automatic", PathFollowing::automatic },
            { "always", PathFollowing::always } },
          "Whether the load time becomes an unknown, which may decrease, with "
          "steps that are increments of the mean inelastic opening and slip of "
          "joints. never: load steps only; automatic: where load steps do not "
          "converge; always: as soon as joints yield.");
      entries.list("Path joints", parameters.path_joints,
                   "Joint sets whose inelastic opening and slip control path "
                   "following; empty: all sets.");
      entries.positive("Largest path step", parameters.largest_path_step,
                       "Largest step of path following: the mean of inelastic "
                       "opening and slip over the area of the path joints [m]");
      entries.choice(
          "Linear solver", parameters.linear_solver,
          { { "automatic", LinearSolverType::automatic },
            { "direct", LinearSolverType::direct },
            { "iterative", LinearSolverType::iterative } },
          "Solver of linear systems. direct: LU factors; iterative: "
          "GMRES with algebraic multigrid that includes the rigid body modes; "
          "automatic: iterative beyond 200 000 degrees of freedom, in three "
          "dimensions 30 000.");
      if (const ParameterSection *section = entries.read_section())
        check_steps(*section, parameters);
    }
  } // namespace

  void ImplicitParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  ImplicitParameters ImplicitParameters::read(const ParameterSection &section)
  {
    return read_entries(section, enter);
  }
} // namespace quoin
