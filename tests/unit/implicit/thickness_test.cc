// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Blocks of different thickness, by both solvers: statics, waves, and the same
// blocks of unit thickness with stiffness and density that many times.

#include "implicit_run.h"

#include <quoin/base/exceptions.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/contact/block_contacts.h>

#include <cmath>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double pressure = 1e5;
  constexpr double width = 3., height = 2.; // of each block of the stack
  constexpr double density = 2500.;

  /** Two blocks without lateral strain. */
  ModelParameters stack_of(const double lower, const double upper)
  {
    ModelParameters result        = two_blocks();
    result.thickness              = lower;
    result.materials              = { material("lower", density, 1e10, 0.),
                                      material("upper", density, 1e10, 0.) };
    result.materials[1].thickness = upper;
    return result;
  }

  std::vector<LoadParameters> held_and(const LoadParameters &other)
  {
    return { motion("held", "bottom", "0", "0"), other };
  }

  double joint_force(const Model<2> &model, const State<2> &state)
  {
    const JointHistory &history = state.get<JointHistory>();
    double sum                  = 0.;
    for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
      for (unsigned int k = 0; k < 2; ++k)
        sum += model.joints().segments()[i].area[k]
               * history.normal_traction[2 * i + k];
    return sum;
  }

  /** Stresses and joint tractions under a pressure on top, which are uniform in
      either block. */
  void expect_pressed(const Model<2> &model, const State<2> &state,
                      const double lower, const double upper,
                      const double tolerance)
  {
    const double force = pressure * upper;
    for (unsigned int c = 0; c < model.nodes().cells().size(); ++c)
    {
      const auto stress   = cell_stress(model.blocks(), state.nodes.data(),
                                        state.get<PlasticHistory>(), c, nullptr);
      const bool is_upper = material_of_cell(model, c) == 1;
      EXPECT_NEAR(stress[1], -force / (is_upper ? upper : lower),
                  tolerance * pressure);
      EXPECT_NEAR(stress[0], 0., tolerance * pressure);
    }
    for (const double traction : state.get<JointHistory>().normal_traction)
      EXPECT_NEAR(traction, -force / std::min(lower, upper),
                  tolerance * pressure);
    EXPECT_NEAR(joint_force(model, state), -force * width,
                tolerance * force * width);
  }

  constexpr double thicknesses[][2] = { { 0.8, 0.2 }, { 0.2, 0.8 } };
} // namespace

TEST(Thickness, StressesAndTractionsOfAStackByTheImplicitSolver)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  for (const auto &[lower, upper] : thicknesses)
  {
    ImplicitRun run(
        mesh, stack_of(lower, upper),
        held_and(traction("press", "top", "0", std::to_string(-pressure))));
    run.begin({ "held", "press" });
    run.finish();
    expect_pressed(run.model, run.state, lower, upper, 1e-4);
    EXPECT_NEAR(run.solver.resultant("held")[1], pressure * upper * width,
                1e-6 * pressure);
  }
}

TEST(Thickness, StressesAndTractionsOfAStackByTheExplicitSolver)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  for (const auto &[lower, upper] : thicknesses)
  {
    TestRun run(
        mesh, stack_of(lower, upper),
        held_and(traction("press", "top", "0", std::to_string(-pressure))));
    run.begin(stage_with({ "held", "press" }, DampingType::local));
    run.step(5000);
    expect_pressed(run.model, run.state, lower, upper, 1e-4);
    EXPECT_NEAR(run.solver.resultant("held")[1], pressure * upper * width,
                1e-4 * pressure);
  }
}

TEST(Thickness, WeightOfAStack)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  for (const auto &[lower, upper] : thicknesses)
  {
    ImplicitRun run(mesh, stack_of(lower, upper),
                    held_and(gravity("0", "-10")));
    run.begin({ "held", "gravity" });
    run.finish();
    const double weight = 10. * density * width * height;
    EXPECT_NEAR(joint_force(run.model, run.state), -weight * upper,
                1e-8 * weight);
    EXPECT_NEAR(run.solver.resultant("held")[1], weight * (lower + upper),
                1e-8 * weight);
  }
}

// A step of the displacement that runs into a bar of another thickness: behind
// the waves that leave the section all moves on by 2 A1 / (A1 + A2) of it, one
// and the coefficient of reflection of velocities.
TEST(Thickness, WaveIsReflectedByTheRatioOfSections)
{
  constexpr unsigned int length = 200;
  constexpr double step = 1e-3, start = 50., section = 100., ramp = 8.;
  MeshData<2> data = grid(length, 1, "thin");
  data.group_names.push_back("thick");
  for (unsigned int c = 0; c < data.cells.size(); ++c)
    data.cell_group[c] = data.vertices[data.cells[c][0]][0] > section - 0.5;
  BlockMesh<2> mesh = split_into_blocks(data, {});
  ASSERT_EQ(mesh.n_blocks(), 1U);

  for (const double other : { 0.1, 1.5 })
  {
    constexpr double first = 0.4;
    ModelParameters parameters;
    parameters.plane                  = PlaneAssumption::plane_stress;
    parameters.materials              = { material("thin", density, 1e10, 0.),
                                          material("thick", density, 1e10, 0.) };
    parameters.materials[0].thickness = first;
    parameters.materials[1].thickness = other;
    TestRun run(mesh, parameters, {});
    run.begin(stage_with({}), 0.5);
    const double c = std::sqrt(1e10 / density);
    for (unsigned int i = 0; i < run.nodes->n_local(); ++i)
    {
      const double x          = run.state.nodes[i].X[0] - start;
      const double z          = (x + 0.5 * c * run.dt()) / ramp;
      run.state.nodes[i].u[0] = 0.5 * step * std::erfc(x / ramp);
      run.state.velocity[i]   = dealii::Point<2>(
          step * c / (ramp * std::sqrt(M_PI)) * std::exp(-z * z), 0.);
    }
    run.step(std::lround(125. / (c * run.dt())));
    // The mean of both sides: at the step their nodes have different masses.
    // Fronts are at 25 m and 175 m, and about 75 m is what of the start does
    // not go to the right in a discrete bar, back from the left end.
    for (const double x : { 50., 100., 120., 140. })
      EXPECT_NEAR(0.5
                      * (run.state.nodes[run.node(x, 0.)].u[0]
                         + run.state.nodes[run.node(x, 1.)].u[0]),
                  step * 2. * first / (first + other), 1e-4 * step)
          << x;
  }
}

// Thickness is stiffness, density, load and joint stiffness that many times.
TEST(Thickness, IsAFactorOfAllThatABlockIsAndBears)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  const auto solve  = [&](const bool scaled, const bool rigid)
  {
    constexpr double lower = 0.8, upper = 0.2;
    ModelParameters parameters = two_blocks(2e10, 1e10);
    parameters.thickness       = 1.;
    for (MaterialParameters &m : parameters.materials)
    {
      const double t = m.name == "lower" ? lower : upper;
      m.rigid        = rigid && m.name == "upper";
      if (scaled)
      {
        m.elastic.density *= t;
        m.elastic.young *= t;
      }
      else
        m.thickness = t;
    }
    if (scaled)
      parameters.joints = { elastic_joint(2e10 * upper, 1e10 * upper) };
    TestRun run(mesh, parameters,
                { viscous("base", "bottom"), gravity("1", "-10"),
                  traction("press", "top", scaled ? "2e4" : "1e5", "0") });
    StageParameters stage
        = stage_with({ "base", "gravity", "press" }, DampingType::rayleigh);
    stage.mass_coefficient      = 10.;
    stage.stiffness_coefficient = 1e-6;
    run.begin(stage);
    run.step(200);
    run.solver.step(run.state, { true, false });
    EXPECT_LT(std::abs(run.solver.energies().residual()),
              1e-9 * run.solver.energies().throughput());
    return std::make_pair(run.dt(), run.state);
  };
  for (const bool rigid : { false, true })
  {
    const auto [dt, state]       = solve(false, rigid);
    const auto [other_dt, other] = solve(true, rigid);
    EXPECT_NEAR(dt, other_dt, 1e-12 * dt);
    double largest = 0., error = 0.;
    for (unsigned int i = 0; i < state.nodes.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        largest = std::max(largest, std::abs(other.nodes[i].u[d]));
        error   = std::max(error,
                           std::abs(state.nodes[i].u[d] - other.nodes[i].u[d]));
      }
    EXPECT_GT(largest, 1e-7);
    EXPECT_LT(error, 1e-9 * largest);
  }
}

// Two blocks whose vertices do not meet overlap by a little.
TEST(Thickness, GeneralContactsBearOverTheSmallerOne)
{
  constexpr double overlap = 1e-5, stiffness = 1e9;
  MeshData<2> data;
  add_grid(data, 3, 2, "lower");
  add_grid(data, 3, 2, "upper", 0.25, height - overlap);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  for (const auto &[lower, upper] : thicknesses)
  {
    ModelParameters parameters             = stack_of(lower, upper);
    parameters.large_displacements         = true;
    parameters.contact.large_displacements = true;
    parameters.joints = { elastic_joint(stiffness, 0.5 * stiffness) };
    parameters.joints[0].curves.clear();
    parameters.joints[0].all_new_contacts = true;
    TestRun run(mesh, parameters, {});
    run.begin(stage_with({}), 1e-3);
    run.step(1);
    const ContactState &state = run.state.get<ContactState>();
    double force              = 0.;
    for (unsigned int i = 0; i < state.pairs.size(); ++i)
      if (Contact contact;
          run.model.contacts()->near_pairs().contact(state, i, contact))
        force += contact.force[0][1] + contact.force[1][1];
    EXPECT_NEAR(force, -stiffness * overlap * 2.75 * std::min(lower, upper),
                1e-6 * stiffness * overlap);
  }
}
