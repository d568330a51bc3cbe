// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Platens in three dimensions in equilibrium.

#include "../mesh/space_box.h"
#include "implicit_run.h"

#include <quoin/base/constants.h>
#include <quoin/motions/space_platen.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  using Vector = dealii::Tensor<1, 3>;

  LoadParameters cap(const std::string &name, const std::string &side,
                     const std::array<LoadComponent, 3> &along,
                     const std::array<LoadComponent, 3> &about)
  {
    LoadParameters result;
    result.name       = name;
    result.type       = LoadType::platen;
    result.boundaries = { side };
    result.components = along;
    result.rotations  = about;
    return result;
  }

  /** A bar of 1 m x 1 m, 4 m high, between the platens "foot" and "head". */
  struct Bar
  {
    BlockTriangulation<3> blocks;
    NodeMap<3> nodes;
    Model<3> model;
    ImplicitSolver<3> solver;
    State<3> state;

    explicit Bar(const std::vector<LoadParameters> &loads,
                 const ImplicitParameters &numbers,
                 const MPI_Comm communicator = MPI_COMM_SELF)
      : blocks(made(communicator)), nodes(blocks), model(nodes, rock()),
        solver(model, loads, numbers, {}), state(model.initial_state())
    {
      solver.begin_stage(stage_with({ "foot", "head" }), nullptr, state);
      while (!solver.has_ended(state))
        solver.step(state);
    }

    /** Its upper half is that of the last rank, the lower one of the first. */
    static BlockTriangulation<3> made(const MPI_Comm communicator)
    {
      BlockMesh<3> mesh = box_mesh({ 2, 2, 8 }, 0.5);
      std::vector<unsigned int> rank_of_cell;
      for (const auto &cell : mesh.cells)
      {
        double height = 0.;
        for (const unsigned int vertex : cell)
          height += 0.25 * mesh.vertices[vertex][2];
        rank_of_cell.push_back(
            height < 2.
                ? 0
                : dealii::Utilities::MPI::n_mpi_processes(communicator) - 1);
      }
      return { mesh, rank_of_cell, { false }, communicator };
    }

    static ModelParameters rock()
    {
      ModelParameters parameters;
      parameters.materials = { material("rock") };
      return parameters;
    }

    const MotionConstraint<3> &platen(const unsigned int k) const
    {
      return *solver.loads().constraints[k];
    }
    Vector moved(const unsigned int k) const
    {
      const double *u = platen(k).rigid_motion()->displacement(state);
      return Vector({ u[0], u[1], u[2] });
    }
    /** From the centre of the foot to that of the head, undeformed [m]. */
    Vector arm() const
    {
      return state.get<SpacePlatenState>("head").centre
             - state.get<SpacePlatenState>("foot").centre;
    }
    Vector force(const unsigned int k) const
    {
      const auto f = solver.resultant(platen(k).name());
      return Vector({ f[0], f[1], f[2] });
    }
    Vector moment(const unsigned int k) const
    {
      const auto f = solver.resultant(platen(k).name());
      return Vector({ f[3], f[4], f[5] });
    }
  };

  LoadComponent of(const LoadQuantity quantity, const std::string &text)
  {
    return component(quantity, text);
  }
} // namespace

// Forces and moments on the head, which is turned about x, in one step.
TEST(SpacePlatens, IterationsConvergeQuadraticallyToEquilibrium)
{
  const auto still = of(LoadQuantity::velocity, "0");
  const auto push
      = [](const std::string &text) { return of(LoadQuantity::force, text); };
  ImplicitParameters numbers;
  numbers.first_step = numbers.largest_step = 1.;
  numbers.force_ratio                       = 1e-12;
  numbers.line_search                       = false;
  const Bar bar(
      { cap("foot", "z0", { still, still, still }, { still, still, still }),
        cap("head", "z1", { push("8e6*t"), push("5e6*t"), {} },
            { of(LoadQuantity::displacement, "6*t"), push("2e7*t"),
              push("-3e7*t") }) },
      numbers);
  auto &record = const_cast<Bar &>(bar).solver.record();
  expect_quadratic_convergence(record.iterations, 2);

  const double *motion = bar.platen(1).rigid_motion()->displacement(bar.state);
  EXPECT_GT(motion[0], 0.2);
  EXPECT_NEAR(motion[3], 6. * constants::degree, 1e-14);
  EXPECT_LT(motion[5], -0.05);
  // Statics in the deformed position.
  const Vector arm = bar.arm() + bar.moved(1);
  EXPECT_LT((bar.force(0) + bar.force(1)).norm(), 1e-5 * 8e6);
  EXPECT_LT((bar.moment(0) + bar.moment(1)
             + dealii::cross_product_3d(arm, bar.force(1)))
                .norm(),
            1e-5 * 3e7);
  EXPECT_NEAR(bar.moment(1)[1], 2e7, 1.);
}

// A moment bends the bar, and counts in the unbalanced force, whichever rank
// has the nodes of the head.
TEST(PlatensOfRanks, AMomentCountsWhereverTheNodesAre)
{
  const auto still = of(LoadQuantity::velocity, "0");
  const LoadComponent free;
  ImplicitParameters numbers;
  numbers.first_step = numbers.largest_step = 1.;
  numbers.force_ratio                       = 1e-6;
  numbers.line_search                       = false;
  double turned[2];
  std::vector<IterationReport> iterations[2];
  for (const unsigned int k : { 0, 1 })
  {
    Bar bar(
        { cap("foot", "z0", { still, still, still }, { still, still, still }),
          cap("head", "z1", {},
              { free, of(LoadQuantity::force, "2e7*t"), free }) },
        numbers, k == 0 ? MPI_COMM_SELF : MPI_COMM_WORLD);
    turned[k]     = bar.platen(1).rigid_motion()->displacement(bar.state)[4];
    iterations[k] = bar.solver.record().iterations;
  }
  EXPECT_GT(turned[0], 0.02);
  EXPECT_NEAR(turned[1], turned[0], 1e-6 * turned[0]);
  ASSERT_EQ(iterations[1].size(), iterations[0].size());
  ASSERT_GT(iterations[0].size(), 3U);
  for (unsigned int i = 0; i < iterations[0].size(); ++i)
    EXPECT_NEAR(iterations[1][i].unbalanced_ratio,
                iterations[0][i].unbalanced_ratio,
                1e-5 * iterations[0][i].unbalanced_ratio + 1e-9);
}

// The foot turns about a skew axis and moves; the head follows without force.
TEST(SpacePlatens, ALooseHeadFollowsTheFootThroughLargeTurns)
{
  ImplicitParameters numbers;
  numbers.first_step = numbers.largest_step = 0.2;
  numbers.force_ratio                       = 1e-5;
  const auto turn                           = [](const std::string &text)
  { return of(LoadQuantity::displacement, text); };
  const Bar bar(
      { cap("foot", "z0", { turn("2*t"), turn("-t"), turn("0") },
            { turn("80*t"), of(LoadQuantity::velocity, "40"), turn("-60*t") }),
        cap("head", "z1", {}, {}) },
      numbers);
  const Vector whole = constants::degree * Vector({ 80., 40., -60. });
  const Vector arm   = bar.arm(), shift({ 2., -1., 0. });
  EXPECT_LT((bar.moved(1) - shift - (rotation_by(whole) * arm - arm)).norm(),
            1e-9);
  const double *motion = bar.platen(1).rigid_motion()->displacement(bar.state);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(motion[3 + d], whole[d], 1e-9);
  EXPECT_LT((turn_of(rotation_by(whole)) - whole).norm(), 1e-14);
  EXPECT_LT(bar.moment(0).norm(), 1.);
}
