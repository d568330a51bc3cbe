// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_motions_boundary_square_h
#define quoin_tests_unit_motions_boundary_square_h

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
    BlockMesh<2> mesh          = rectangle();
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

    static BlockMesh<2> rectangle()
    {
      BlockMesh<2> result;
      result.vertices   = { { 1., 2. }, { 4., 2. }, { 4., 3. }, { 1., 3. } };
      result.cells      = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
      result.cell_group = { 0, 0 };
      result.block_first_cell   = { 0, 2 };
      result.block_first_vertex = { 0, 4 };
      result.group_names        = { "rock" };
      result.face_names         = { "", "bottom", "right", "top", "left" };
      for (const unsigned int k : { 0U, 1U, 2U, 3U })
        result.boundary_faces.push_back(
            { { { k, (k + 1) % 4 } }, k < 2 ? 0U : 1U, k + 1 });
      return result;
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
