// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_models.h"

#include <quoin/blocks/cell_states.h>
#include <quoin/model/material_waves.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  LoadParameters initial_stress(const std::array<double, 3> &stress,
                                const std::array<double, 3> &gradient,
                                const std::vector<std::string> &groups = {})
  {
    LoadParameters result;
    result.name            = "insitu";
    result.type            = LoadType::initial_stress;
    result.stress          = stress;
    result.stress_gradient = gradient;
    result.groups          = groups;
    return result;
  }

  void make_model(const BlockMesh<2> &mesh, const ModelParameters &parameters)
  {
    const TestNodes nodes(mesh, parameters.materials);
    Model<2>(nodes, parameters);
  }
} // namespace

TEST(Model, LumpsAThirdOfEachCell)
{
  BlockMesh<2> mesh          = make_stack(1, 1);
  ModelParameters parameters = two_blocks();
  parameters.materials = { material("upper", 3000.), material("lower", 1200.) };
  const TestNodes nodes(mesh);
  const Model<2> model(nodes, parameters);
  ASSERT_EQ(model.mass().size(), 8U);
  double mass[2]{};
  for (unsigned int v = 0; v < 8; ++v)
  {
    const unsigned int block = mesh.block_of_vertex(v);
    mass[block] += model.mass()[v];
    // Two of the corners of a square belong to one triangle, two to both.
    const double third = (block == 0 ? 1200. : 3000.) * 0.5 * 0.5 / 3.;
    const auto &p      = mesh.vertices[v];
    const bool both    = std::abs(p[0] - (p[1] - block)) < 1e-12;
    EXPECT_DOUBLE_EQ(model.mass()[v], both ? 2. * third : third);
  }
  EXPECT_DOUBLE_EQ(mass[0], 1200. * 0.5);
  EXPECT_DOUBLE_EQ(mass[1], 3000. * 0.5);
  EXPECT_EQ(model.nodes().table().n_blocks(), 2U);
  EXPECT_EQ(model.nodes().cells().size(), 4U);
  EXPECT_EQ(model.parameters().thickness, 0.5);
}

TEST(Model, ImpedanceOfWaves)
{
  BlockMesh<2> mesh = make_stack(1, 1);
  const double rho = 2500., E = 1e10, nu = 0.2;
  for (const bool strain : { true, false })
  {
    ModelParameters parameters = two_blocks();
    parameters.plane           = strain ? PlaneAssumption::plane_strain
                                        : PlaneAssumption::plane_stress;
    const TestNodes nodes(mesh);
    const Model<2> model(nodes, parameters);
    const double modulus = strain ? E * (1. - nu) / ((1. + nu) * (1. - 2. * nu))
                                  : E / (1. - nu * nu);
    const auto impedance = impedance_beyond(model, LoadParameters());
    ASSERT_EQ(impedance.size(), 2U);
    EXPECT_NEAR(impedance[1].normal, std::sqrt(rho * modulus), 1e-3);
    EXPECT_NEAR(impedance[1].shear, std::sqrt(rho * E / (2. * (1. + nu))),
                1e-3);
  }
}

TEST(Model, StartsAtRestInPlace)
{
  BlockMesh<2> mesh = make_stack(2, 1);
  const TestNodes nodes(mesh);
  const Model<2> model(nodes, two_blocks());
  const State<2> state = model.initial_state();
  ASSERT_EQ(state.nodes.size(), mesh.n_vertices());
  ASSERT_EQ(state.get<JointHistory>().state.size(), 4U);
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_EQ(state.nodes[v].X[d], mesh.vertices[v][d]);
      EXPECT_EQ(state.nodes[v].u[d], 0.);
      EXPECT_EQ(state.velocity[v][d], 0.);
    }
  for (const double sigma : state.get<JointHistory>().normal_traction)
    EXPECT_EQ(sigma, 0.);
  EXPECT_EQ(state.time, 0.);
  EXPECT_EQ(state.step, 0U);
}

TEST(Model, InitialStressInEquilibriumStaysAtRest)
{
  // Uniform stress, held by the tractions that belong to it. The joint is
  // elastic, so that it may take what it gets.
  BlockMesh<2> mesh           = make_stack(2, 2);
  ModelParameters parameters  = two_blocks();
  parameters.initial_stresses = { initial_stress({ { -1e6, -2e6, 0. } }, {}) };
  TestRun run(mesh, parameters,
              { traction("top", "top", "0", "-2e6"),
                traction("bottom", "bottom", "0", "2e6"),
                motion("sides", "sides", "0", "") });
  for (unsigned int p = 0; p < run.model.joints().n_points(); ++p)
  {
    EXPECT_DOUBLE_EQ(run.state.get<JointHistory>().normal_traction[p], -2e6);
    EXPECT_NEAR(run.state.get<JointHistory>().shear_traction[p], 0., 1e-9);
  }
  run.begin(stage_with({ "top", "bottom", "sides" }));
  run.step(100);
  for (const dealii::Tensor<1, 2> &v : run.state.velocity)
    for (unsigned int d = 0; d < 2; ++d)
      // To rounding of forces of 1e6 N on 400 kg, a hundred times.
      EXPECT_NEAR(v[d], 0., 1e-10 * run.dt() * 1e6 / 400. * 100.);
  // The rollers carry the horizontal stress: both sides together nothing,
  // the moment of either about the origin opposite.
  EXPECT_NEAR(run.solver.resultant("sides")[0], 0., 1e-4);
}

TEST(Model, InitialStressOfAGroupAndWithDepth)
{
  BlockMesh<2> mesh          = make_stack(1, 1);
  ModelParameters parameters = two_blocks();
  parameters.initial_stresses
      = { initial_stress({ { 0., -1e6, 0. } }, { { 0., 3e5, 0. } }),
          initial_stress({ { -5e5, 0., 1e5 } }, {}, { "upper" }) };
  const TestNodes nodes(mesh);
  const Model<2> model(nodes, parameters);
  const State<2> state = model.initial_state();
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
  {
    double y = 0.;
    for (const unsigned int v : mesh.cells[c])
      y += mesh.vertices[v][1] / 3.;
    const bool upper  = mesh.block_of_cell(c) == 1;
    const auto stress = cell_stress(model.blocks(), state.nodes.data(), {}, c);
    EXPECT_NEAR(stress[0], upper ? -5e5 : 0., 1e-6);
    EXPECT_NEAR(stress[1], -1e6 + 3e5 * y, 1e-6);
    EXPECT_NEAR(stress[2], upper ? 1e5 : 0., 1e-6);
  }
  // The joint takes the mean of the cells on its sides, at y = 2/3 and 4/3.
  for (unsigned int p = 0; p < 2; ++p)
  {
    EXPECT_NEAR(state.get<JointHistory>().normal_traction[p], -1e6 + 3e5, 1e-6);
    EXPECT_NEAR(state.get<JointHistory>().shear_traction[p], 0.5e5, 1e-6);
  }
}

TEST(Model, InitialStressOutOfThePlane)
{
  BlockMesh<2> mesh          = make_stack(1, 1);
  ModelParameters parameters = two_blocks();
  parameters.plane           = PlaneAssumption::plane_strain;
  parameters.initial_stresses
      = { initial_stress({ { -3e6, -1e6, 0. } }, { { 0., 3e5, 0. } }),
          initial_stress({ { -5e5, 0., 1e5 } }, {}, { "upper" }) };
  parameters.initial_stresses[1].stress_zz = { { -7e5, 2e5 } };
  for (auto &material : parameters.materials)
    material.strength = MohrCoulombStrength{ 1e9, 0., 0. };
  const TestNodes nodes(mesh);
  const Model<2> model(nodes, parameters);
  const State<2> state = model.initial_state();
  for (unsigned int c = 0; c < mesh.n_cells(); ++c)
  {
    double y = 0.;
    for (const unsigned int v : mesh.cells[c])
      y += mesh.vertices[v][1] / 3.;
    const double elastic = 0.2 * (-4e6 + 3e5 * y);
    const double wanted
        = mesh.block_of_cell(c) == 1 ? elastic - 7e5 + 2e5 * y : elastic;
    EXPECT_NEAR(state.get<PlasticHistory>().cells[c].stress[3], wanted, 1e-6);
    EXPECT_NEAR(cell_stress(model.blocks(), state.nodes.data(),
                            state.get<PlasticHistory>(), c)[3],
                wanted, 1e-6);
  }
  parameters.plane = PlaneAssumption::plane_stress;
  expect_input_error([&] { make_model(mesh, parameters); },
                     { "Loads/insitu", "Stress zz", "plane stress" });
}

TEST(Model, RefusesGroupsWithoutMaterialAndJointsWithoutSet)
{
  BlockMesh<2> mesh          = make_stack(1, 1);
  ModelParameters parameters = two_blocks();
  parameters.materials       = { material("lower") };
  expect_input_error([&] { make_model(mesh, parameters); },
                     { "Materials", "'upper'", "no material" });

  parameters.materials
      = { material("lower"), material("upper"), material("marble") };
  expect_input_error([&] { make_model(mesh, parameters); },
                     { "Materials/marble", "'marble'", "lower, upper" });

  parameters.materials = { material("lower"), material("upper") };
  parameters.materials[1].groups.push_back("lower");
  expect_input_error([&] { make_model(mesh, parameters); },
                     { "Materials/upper", "'lower'", "already" });

  parameters = two_blocks();
  parameters.joints.clear();
  expect_input_error([&] { make_model(mesh, parameters); },
                     { "'joint'", "no joint set" });

  parameters                  = two_blocks();
  parameters.initial_stresses = { initial_stress({}, {}, { "marble" }) };
  expect_input_error([&] { make_model(mesh, parameters); },
                     { "Loads/insitu", "marble", "lower, upper" });
}
