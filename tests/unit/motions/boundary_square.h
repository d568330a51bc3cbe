// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_motions_boundary_square_h
#define quoin_tests_unit_motions_boundary_square_h

#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/loads/load_parameters.h>
#include <quoin/motions/motion_constraint.h>

#include <string>
#include <vector>

namespace quoin::test
{
  /**
   * One block, the rectangle from (1, 2) to (4, 3) m of two cells, its curves
   * "bottom", "right", "top" and "left", and what a constraint is told of its
   * nodes in the step from 0 to @p dt.
   */
  struct BoundarySquare
  {
    static constexpr double dt = 1e-3;
    BlockMesh<2> mesh
        = rectangle(1., 2., 4., 3., { "", "bottom", "right", "top", "left" },
                    { 1, 2, 3, 4 });
    TestNodes nodes{ mesh };
    std::vector<double> mass = { 2., 1., 2., 1. }; /**< [kg] */
    std::vector<CapturedNode<2>> captured;
    State<2> state;
    StepContext step{};

    BoundarySquare()
    {
      state.nodes.resize(4);
      state.velocity.resize(4);
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int d = 0; d < 2; ++d)
          state.nodes[i].X[d] = mesh.vertices[i][d];
      step.dt = step.dt_before = step.dt_velocity = dt;
      step.load_rate                              = 1.;
      step.middle                                 = { 0.5 * dt, 0.5 * dt };
      step.end                                    = { dt, dt };
    }

    /** What the solver does before it: captures the nodes, as they are. */
    void capture(MotionConstraint<2> &constraint,
                 const std::vector<dealii::Tensor<1, 2>> &force)
    {
      captured.clear();
      std::vector<unsigned int> positions;
      for (const unsigned int node : constraint.nodes())
      {
        positions.push_back(captured.size());
        CapturedNode<2> before{};
        before.node     = node;
        before.mass     = mass[node];
        before.force    = force[node];
        before.velocity = state.velocity[node];
        before.displacement
            = dealii::Point<2>(state.nodes[node].u[0], state.nodes[node].u[1]);
        for (unsigned int d = 0; d < 2; ++d)
          before.owner[d]
              = constraint.traits().moves(d) ? &constraint : nullptr;
        captured.push_back(before);
      }
      constraint.bind(positions);
    }

    void move(MotionConstraint<2> &constraint)
    {
      constraint.correct(step, captured, state);
      constraint.account(step, captured, state);
    }

    static LoadComponent component(const LoadQuantity quantity,
                                   const std::string &text)
    {
      return { quantity, TimeFunction(text, "./") };
    }
  };
} // namespace quoin::test

#endif
