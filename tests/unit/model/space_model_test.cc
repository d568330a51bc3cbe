// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// A model in three dimensions: what holds it and what pushes it.

#include "../joint_elements/space_stack.h"
#include "test_models.h"

#include <quoin/base/exceptions.h>
#include <quoin/model/model_stability.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** Components along x, y and z; "" leaves one free. */
  LoadParameters load(const std::string &name, const LoadType type,
                      const std::string &side, const LoadQuantity quantity,
                      const std::array<std::string, 3> &along)
  {
    LoadParameters result
        = test::load(name, type, side, quantity, along[0], along[2]);
    result.lateral = component(quantity, along[1]);
    return result.along_axes<3>();
  }

  LoadParameters held(const std::string &side,
                      const std::array<std::string, 3> &along)
  {
    return load("held " + side, LoadType::prescribed_motion, side,
                LoadQuantity::velocity, along);
  }

  LoadParameters pull(const std::string &side,
                      const std::array<std::string, 3> &along)
  {
    return load("pull " + side, LoadType::traction, side, LoadQuantity::force,
                along);
  }

  /** The bodies that @p loads push in a box of 2 m x 1 m x 1 m. */
  std::vector<UnsupportedBody<3>>
  pushed(const std::vector<LoadParameters> &loads,
         const StageEnd end = StageEnd::time)
  {
    BlockMesh<3> mesh = box_mesh({ 2, 1, 1 }, 1.);
    const BlockTriangulation<3> blocks(
        mesh, std::vector<unsigned int>(mesh.n_cells(), 0), { false },
        MPI_COMM_SELF);
    const NodeMap<3> nodes(blocks);
    ModelParameters parameters;
    parameters.materials = { material("rock") };
    Model<3> model(nodes, parameters);
    ExplicitSolver<3> solver(model, loads);
    State<3> state        = model.initial_state();
    StageParameters stage = stage_with({});
    for (const LoadParameters &each : loads)
      stage.loads.push_back(each.name);
    stage.end = end;
    solver.begin_stage(stage, nullptr, state);
    return solver.stage_loads().unsupported_bodies(model, stage, state);
  }
} // namespace

TEST(SpaceFreeBodies, NothingHoldsTheBlock)
{
  const auto bodies = pushed({ pull("x1", { "1e3", "", "" }) });
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_NEAR(bodies[0].centre[0], 1., 1e-12);
  EXPECT_NEAR(bodies[0].centre[1], 0.5, 1e-12);
  EXPECT_NEAR(bodies[0].centre[2], 0.5, 1e-12);
  EXPECT_TRUE(bodies[0].is_loose);
}

TEST(SpaceFreeBodies, ForcesThatBalancePushNothing)
{
  EXPECT_TRUE(
      pushed({ pull("x0", { "-1e3", "", "" }), pull("x1", { "1e3", "", "" }) })
          .empty());
  // Shear tractions on four sides are in equilibrium, on two a couple.
  const std::vector<LoadParameters> couple
      = { pull("x0", { "", "-1e3", "" }), pull("x1", { "", "1e3", "" }) };
  EXPECT_EQ(pushed(couple).size(), 1U);
  EXPECT_TRUE(pushed({ couple[0], couple[1], pull("y0", { "-1e3", "", "" }),
                       pull("y1", { "1e3", "", "" }) })
                  .empty());
}

TEST(SpaceFreeBodies, HeldWhereLoadsPush)
{
  const std::vector<LoadParameters> rollers
      = { held("x0", { "0", "", "" }), held("y0", { "", "0", "" }),
          held("z0", { "", "", "0" }) };
  std::vector<LoadParameters> loads = rollers;
  loads.push_back(pull("x1", { "1e3", "2e3", "3e3" }));
  EXPECT_TRUE(pushed(loads).empty());
  // A roller on z0 alone leaves x, y and the turn about z free.
  EXPECT_TRUE(pushed({ rollers[2], pull("x1", { "", "", "1e3" }) }).empty());
  const auto bodies = pushed({ rollers[2], pull("x1", { "", "1e3", "" }) });
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_FALSE(bodies[0].is_loose);
}

TEST(SpaceFreeBodies, RefusedInAStaticStage)
{
  try
  {
    pushed({ held("z0", { "", "", "0" }), pull("x1", { "1e3", "", "" }) },
           StageEnd::static_ratio);
    FAIL();
  }
  catch (const InputError &error)
  {
    const std::string text = error.what();
    // Neither joints nor contacts can be the cure.
    EXPECT_EQ(text.find("Joints along"), std::string::npos) << text;
    EXPECT_EQ(text.find("Displacements"), std::string::npos) << text;
  }
}

// At the critical step of each node h^2 omega^2 + 2 h c/m = 4, where c is twice
// the bound d of its dashpots, for several pairs of blocks.
TEST(SpaceModel, DashpotsShortenTheStep)
{
  BlockMesh<3> mesh
      = space_stack::stack(2, [](const dealii::Point<3> &p) { return p; });
  const BlockTriangulation<3> blocks(
      mesh, std::vector<unsigned int>(mesh.n_cells(), 0), { false, false },
      MPI_COMM_SELF);
  const NodeMap<3> nodes(blocks);
  constexpr double density = 2500., young = 1e10, poisson = 0.2, xi = 0.8;
  ModelParameters parameters;
  parameters.materials = { material("low", density, young, poisson),
                           material("high", density, young, poisson) };
  parameters.joints    = { space_stack::set_of(space_stack::elastic()) };
  const Model<3> plain(nodes, parameters);
  parameters.joints[0].damping = { xi, xi };
  const Model<3> damped(nodes, parameters);

  DampingBound bound;
  bound.dashpot.assign(nodes.n_deformable_nodes(), 0.);
  bound.share.assign(2, 0.);
  const double block = density * 1. * 0.5 * 0.5;
  damped.joints().add_damping_bound(
      { block, block },
      std::sqrt(density * young * (1. - poisson)
                / ((1. + poisson) * (1. - 2. * poisson))),
      bound);
  const auto undamped = stability_at(plain, plain.initial_state());
  const auto shorter  = stability_at(damped, damped.initial_state());
  for (unsigned int i = 0; i < nodes.n_owned(); ++i)
  {
    const double mass   = plain.mass()[i];
    const double before = 4. * undamped.mass_for(i, 1.) / mass;
    const double after  = 4. * shorter.mass_for(i, 1.) / mass;
    const double h      = 2. / std::sqrt(after);
    const double c      = 2. * bound.dashpot[i];
    EXPECT_EQ(c > 0., nodes.point(i)[2] == 0.5); // of the joint
    EXPECT_NEAR(h * h * before + 2. * h * c / mass, 4., 1e-9);
  }
}
