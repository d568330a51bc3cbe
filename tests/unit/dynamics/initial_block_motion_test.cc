// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../model/test_models.h"

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/initial_block_motion.h>
#include <quoin/dynamics/initial_energy.h>
#include <quoin/loads/initial_motion.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  NamedBlock upper(const double x, const double y, const double spin)
  {
    NamedBlock block;
    block.name        = "stone";
    block.group       = "upper";
    block.velocity[0] = x;
    block.velocity[1] = y;
    block.spin        = spin;
    return block;
  }

  ModelParameters stack_of(const bool rigid)
  {
    ModelParameters parameters = two_blocks();
    for (MaterialParameters &stone : parameters.materials)
      stone.rigid = rigid;
    return parameters;
  }

  std::string refusal(const LoadParameters &load, const NamedBlock &block)
  {
    TestRun run(make_stack(3, 2), stack_of(false), { load });
    std::vector<NamedBlock> blocks = { block };
    find_named_blocks(run.nodes, blocks);
    return message_of<InputError>(
        [&]
        {
          start_blocks(blocks, run.model, run.solver, stage_with({ load.name }),
                       run.state);
        });
  }
} // namespace

TEST(InitialBlockMotion, IsThatOfARigidBodyWithItsEnergy)
{
  for (const bool rigid : { false, true })
  {
    TestRun run(make_stack(3, 2), stack_of(rigid), {});
    std::vector<NamedBlock> blocks = { upper(0.3, -0.2, 2.) };
    find_named_blocks(run.nodes, blocks);
    start_blocks(blocks, run.model, run.solver, stage_with({}), run.state);
    account_for_initial_motion(run.model, run.state);
    const BlockInertia inertia = inertia_of_block(run.model, 1);
    for (unsigned int i = 0; i < run.nodes->n_local(); ++i)
    {
      const bool moves = run.nodes->block_of_node(i) == 1;
      const auto arm   = run.nodes->point(i) - inertia.centroid;
      EXPECT_NEAR(run.state.velocity[i][0], moves ? 0.3 - 2. * arm[1] : 0.,
                  1e-13);
      EXPECT_NEAR(run.state.velocity[i][1], moves ? -0.2 + 2. * arm[0] : 0.,
                  1e-13);
    }
    const double energy
        = 0.5
          * (inertia.mass * (0.3 * 0.3 + 0.2 * 0.2) + inertia.moment * 2. * 2.);
    EXPECT_NEAR(run.state.energy.external, energy, 1e-12 * energy);
    if (!rigid)
      continue;
    const auto &states = run.state.get<RigidBlockStates>();
    EXPECT_EQ(states[1].velocity[0], 0.3);
    EXPECT_EQ(states[1].velocity[1], -0.2);
    EXPECT_EQ(states[1].velocity[2], 2.);
    EXPECT_EQ(states[0].velocity[2], 0.);
    // The energy that was booked is the one that steps find.
    run.begin(stage_with({}), 0.3);
    run.solver.step(run.state, { true, false });
    EXPECT_NEAR(run.solver.energies().kinetic, energy, 1e-12 * energy);
    EXPECT_NEAR(run.solver.energies().residual(), 0., 1e-12 * energy);
  }
}

TEST(InitialBlockMotion, IsNoneOfBlocksThatAreHeldOrAbsent)
{
  const auto roller         = motion("roller", "top", "", "0");
  const std::string nothing = "nothing was thrown";
  EXPECT_NE(refusal(roller, upper(0., 1., 0.)).find("'roller' holds"),
            std::string::npos);
  EXPECT_NE(refusal(roller, upper(0., 0., 1.)).find("'roller' holds"),
            std::string::npos);
  EXPECT_EQ(refusal(roller, upper(1., 0., 0.)), nothing) << "it may roll";
  EXPECT_EQ(refusal(motion("base", "bottom", "0", "0"), upper(1., 1., 1.)),
            nothing)
      << "of the other block";
  const auto still = component(LoadQuantity::velocity, "0");
  EXPECT_NE(
      refusal(platen("press", "upper", still, still, still), upper(1., 0., 0.))
          .find("'press' holds or drives in the stage 'stage'"),
      std::string::npos);

  TestRun run(make_stack(3, 2), stack_of(false), {});
  std::vector<NamedBlock> blocks = { upper(1., 0., 0.) };
  find_named_blocks(run.nodes, blocks);
  run.state.block_marks     = { block_mark::present, block_mark::absent };
  const std::string message = message_of<InputError>(
      [&] {
        start_blocks(blocks, run.model, run.solver, stage_with({}), run.state);
      });
  EXPECT_NE(message.find("not there at the start"), std::string::npos)
      << message;
}

TEST(InitialMotion, IsNoneOfAbsentBlocks)
{
  TestRun run(make_stack(3, 2), stack_of(false), {});
  run.state.block_marks = { block_mark::present, block_mark::absent };
  InitialMotion motion;
  for (const std::string value : { "2", "x" })
  {
    motion.displacement.emplace_back("1e-3*" + value, "./", 2);
    motion.velocity.emplace_back(value, "./", 2);
  }
  motion.apply(*run.nodes, run.state);
  for (unsigned int i = 0; i < run.nodes->n_local(); ++i)
  {
    const double moves = run.nodes->block_of_node(i) == 0 ? 1. : 0.;
    const double x     = run.state.nodes[i].X[0];
    EXPECT_EQ(run.state.nodes[i].u[0], moves * 2e-3);
    EXPECT_DOUBLE_EQ(run.state.nodes[i].u[1], moves * 1e-3 * x);
    EXPECT_EQ(run.state.velocity[i][0], moves * 2.);
    EXPECT_EQ(run.state.velocity[i][1], moves * x);
  }
}
