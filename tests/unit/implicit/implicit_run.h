// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_implicit_implicit_run_h
#define quoin_tests_unit_implicit_implicit_run_h

#include "../model/test_models.h"

#include <quoin/implicit/implicit_solver.h>

namespace quoin::test
{
  /** A model of one rank with its implicit solver. */
  struct ImplicitRun
  {
    TestNodes nodes;
    Model<2> model;
    ImplicitSolver<2> solver;
    State<2> state;

    ImplicitRun(const BlockMesh<2> &mesh, const ModelParameters &parameters,
                const std::vector<LoadParameters> &loads,
                const ImplicitParameters &numbers = {})
      : nodes(mesh, parameters.materials), model(nodes, parameters),
        solver(model, loads, numbers, names(parameters)),
        state(model.initial_state())
    {
    }

    static std::vector<std::string> names(const ModelParameters &parameters)
    {
      std::vector<std::string> result;
      for (const JointSetParameters &set : parameters.joints)
        result.push_back(set.name);
      return result;
    }

    /** All steps of a stage of these loads of 1 s, or @p previous goes on. */
    void begin(const std::vector<std::string> &loads,
               const StageParameters *previous = nullptr)
    {
      solver.begin_stage(stage_with(loads), previous, state);
    }

    void finish()
    {
      while (!solver.has_ended(state))
        solver.step(state);
    }
  };
} // namespace quoin::test

#endif
