// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/results/histories.h>
#include <quoin/mesh/block_numbering.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  HistoryParameters velocity_at(const double x, const double y)
  {
    HistoryParameters history;
    history.name     = "v";
    history.quantity = HistoryQuantity::velocity;
    history.point    = { { x, y } };
    return history;
  }

  /** Velocities at @p points where the upper of two blocks, which meet at
      y = 2 m, moves by 1 m/s and the lower one rests. */
  std::vector<double> velocities(const std::vector<HistoryParameters> &points,
                                 const bool upper_first)
  {
    BlockMesh<2> mesh;
    make_stack(mesh, 3, 2);
    if (upper_first)
      renumber_blocks(mesh, { 1, 0 });
    TestRun run(mesh, two_blocks(), {});
    run.begin(stage_with({}));
    for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
      if (mesh.block_of_vertex(v) == (upper_first ? 0U : 1U))
        run.state.velocity[v].v[0] = 1.;
    Histories<2> histories(points, run.model, run.solver, BoundaryGeometry(),
                           BoundaryElementParameters(), { false, false });
    histories.before_step(run.state);
    return histories.after_step(run.state);
  }
} // namespace

TEST(Histories, AtAJointTheyAreOfOneBlockWhateverTheNumbers)
{
  const std::vector<HistoryParameters> points
      = { velocity_at(1., 2.), velocity_at(1.1, 2.05), velocity_at(1.1, 1.95),
          velocity_at(1., 4.) };
  for (const bool upper_first : { false, true })
  {
    const auto row = velocities(points, upper_first);
    ASSERT_EQ(row.size(), 5U);
    EXPECT_EQ(row[1], 0.) << "on the joint: the lower block";
    EXPECT_EQ(row[2], 1.) << "in the upper block";
    EXPECT_EQ(row[3], 0.) << "in the lower block";
    EXPECT_EQ(row[4], 1.);
  }
}
