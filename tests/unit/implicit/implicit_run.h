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

  /** Of one step in which Newton's method needs no help. */
  template <typename Reports>
  void expect_quadratic_convergence(const Reports &reports,
                                    const unsigned int least_pairs)
  {
    unsigned int n_pairs = 0;
    double largest       = 0.;
    for (unsigned int i = 1; i < reports.size(); ++i)
    {
      const double before = reports[i - 1].unbalanced_ratio;
      const double after  = reports[i].unbalanced_ratio;
      if (before > 1e-2 || before < 1e-6) // rounding beyond
        continue;
      ++n_pairs;
      largest = std::max(largest, after / (before * before));
    }
    EXPECT_GE(n_pairs, least_pairs);
    EXPECT_LT(largest, 20.);
    EXPECT_LT(reports.size(), 12U);
  }
} // namespace quoin::test

#endif
