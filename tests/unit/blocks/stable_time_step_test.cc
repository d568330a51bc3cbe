// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"

#include <quoin/blocks/stable_time_step.h>
#include <quoin/dynamics/highest_frequency.h>
#include <quoin/dynamics/step_limit.h>
#include <quoin/model/model_stability.h>

#include <Eigen/Dense>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** Internal and joint forces at the displacements @p u. */
  std::vector<double> forces(const Model<2> &model,
                             const std::vector<double> &u)
  {
    State<2> state = model.initial_state();
    for (unsigned int i = 0; i < u.size(); ++i)
      state.nodes[i / 2].u[i % 2] = u[i];
    AlignedArray<dealii::Tensor<1, 2>> force(u.size() / 2,
                                             dealii::Tensor<1, 2>());
    EnergyAccounts energy;
    model.joints().add_forces(state.nodes.data(), state.get<JointHistory>(),
                              energy, force.data());
    for (unsigned int tile = 0; tile < model.blocks().n_tiles(); ++tile)
      model.blocks().add_forces(tile, state.nodes.data(),
                                state.get<PlasticHistory>(), force.data());
    std::vector<double> result;
    for (const dealii::Tensor<1, 2> &f : force)
      result.insert(result.end(), { f[0], f[1] });
    return result;
  }

  /** The largest omega^2 of the assembled operator, with the stiffness by
      central differences of the forces. */
  double exact_eigenvalue(const Model<2> &model)
  {
    const unsigned int n = 2 * model.mass().size();
    Eigen::MatrixXd A(n, n); // M^-1/2 K M^-1/2
    const double h = 1e-6;
    for (unsigned int j = 0; j < n; ++j)
    {
      std::vector<double> u(n, 0.);
      u[j]             = h;
      const auto plus  = forces(model, u);
      u[j]             = -h;
      const auto minus = forces(model, u);
      for (unsigned int i = 0; i < n; ++i)
        A(i, j) = (minus[i] - plus[i])
                  / (2. * h * std::sqrt(model.mass()[i / 2])
                     * std::sqrt(model.mass()[j / 2]));
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
               0.5 * (A + A.transpose()), Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
  }

  double largest_speed(const State<2> &state)
  {
    double speed = 0.;
    for (const dealii::Tensor<1, 2> &v : state.velocity)
      speed = std::max({ speed, std::abs(v[0]), std::abs(v[1]) });
    return speed;
  }

  const std::vector<std::pair<double, double>> joint_stiffnesses
      = { { 1e7, 5e6 }, { 2e10, 1e10 }, { 1e11, 1e9 }, { 5e12, 2e12 } };
} // namespace

TEST(StableTimeStep, CriticalStep)
{
  const double omega = 3e4;
  EXPECT_DOUBLE_EQ(StableTimeStep<2>::critical(omega * omega, 0.), 2. / omega);
  for (const double beta : { 1e-6, 1e-4, 1e-2 })
  {
    const double xi = 0.5 * beta * omega;
    EXPECT_NEAR(StableTimeStep<2>::critical(omega * omega, beta),
                2. / omega * (std::sqrt(1. + xi * xi) - xi), 1e-9 / omega);
    const double critical = StableTimeStep<2>::critical(omega * omega, beta);
    EXPECT_NEAR(StableTimeStep<2>::shortened_by(critical, beta) * critical,
                2. / omega, 1e-9 / omega);
  }
  // All damping: 2 / (beta omega^2), which the difference above would lose.
  EXPECT_NEAR(StableTimeStep<2>::critical(omega * omega, 1e6)
                  * (1e6 * omega * omega),
              2., 1e-12);
}

TEST(StableTimeStep, CriticalStepOfTheDampedScheme)
{
  // One degree of freedom: v += -(omega^2 u + beta omega^2 v) dt, u += v dt.
  const double omega = 2., beta = 0.4;
  const double critical = StableTimeStep<2>::critical(omega * omega, beta);
  const auto amplitude  = [&](const double dt)
  {
    double u = 1., v = 0.;
    for (unsigned int i = 0; i < 5000; ++i)
    {
      v -= omega * omega * (u + beta * v) * dt;
      u += v * dt;
    }
    return std::abs(u);
  };
  EXPECT_LT(amplitude(0.999 * critical), 1.);
  EXPECT_GT(amplitude(1.001 * critical), 10.);
}

TEST(StableTimeStep, LargestEigenvalueAndMassScaling)
{
  // Eigenvalues 5 and 1, and 2 +- 3 of a shear-like bound.
  const StableTimeStep<2> bound({ { { 5., 1., 0. } }, { { 2., 2., 3. } } });
  EXPECT_DOUBLE_EQ(bound.largest_eigenvalue({ 1., 1. }), 5.);
  EXPECT_DOUBLE_EQ(bound.largest_eigenvalue({ 1., 0.5 }), 10.);
  EXPECT_DOUBLE_EQ(bound.largest_eigenvalue({ 0.1, 1. }), 50.);

  const double dt            = 0.3;
  const double omega_squared = bound.largest_eigenvalue(
      { bound.mass_for(0, dt), bound.mass_for(1, dt) });
  EXPECT_DOUBLE_EQ(StableTimeStep<2>::critical(omega_squared, 0.), dt);
}

TEST(StableTimeStep, BoundsTheLargestFrequencyClosely)
{
  BlockMesh<2> mesh = make_stack(2, 2);
  for (const auto &[kn, ks] : joint_stiffnesses)
  {
    const TestNodes nodes(mesh);
    const Model<2> model(nodes, two_blocks(kn, ks));
    const double exact = exact_eigenvalue(model);
    const double bound = stability_at(model, model.initial_state())
                             .largest_eigenvalue(model.mass());
    EXPECT_GE(bound, exact * (1. - 1e-6)) << kn;
    EXPECT_LE(bound, 1.3 * exact) << kn;
  }
}

TEST(HighestFrequency, IsThatOfTheAssembledOperator)
{
  // Few degrees of freedom, of which the iteration finds all, and more.
  for (const unsigned int n : { 2U, 5U })
    for (const auto &[kn, ks] : joint_stiffnesses)
    {
      BlockMesh<2> mesh          = make_stack(2 * n, n);
      ModelParameters parameters = two_blocks(kn, ks);
      parameters.materials       = { material("lower", 8000., 1e9, 0.4),
                                     material("upper", 1000., 5e10, 0.) };
      const TestNodes nodes(mesh);
      const Model<2> model(nodes, parameters);
      const double exact = exact_eigenvalue(model);
      std::vector<KnownFrequency> known;
      const double found
          = highest_squared_frequency(model, model.mass(), {}, known);
      EXPECT_GE(found, exact * (1. - 1e-6)) << n << " " << kn;
      EXPECT_LE(found, exact * 1.015) << n << " " << kn;
    }
}

TEST(HighestFrequency, IsFoundOnceForOneStiffnessAndMass)
{
  const TestNodes nodes(make_stack(8, 4));
  std::vector<KnownFrequency> known;
  std::vector<double> mass;
  const auto find = [&](const double kn, const double mass_factor)
  {
    const Model<2> model(nodes, two_blocks(kn, 0.5 * kn));
    mass = model.mass();
    for (double &m : mass)
      m *= mass_factor;
    return highest_squared_frequency(model, mass, {}, known);
  };
  const double first = find(1e13, 1.);
  EXPECT_EQ(find(1e13, 1.), first);
  EXPECT_EQ(known.size(), 1U);
  EXPECT_NEAR(find(1e13, 2.), 0.5 * first, 1e-5 * first);
  EXPECT_GT(find(1e14, 1.), 2. * first);
  EXPECT_EQ(known.size(), 3U);
  EXPECT_EQ(find(1e13, 1.), first);
  EXPECT_EQ(known.size(), 3U);
}

TEST(StepLimit, NamesTheStiffestBody)
{
  // Cells of the light and stiff block above, then stiff joints between.
  BlockMesh<2> mesh = make_stack(8, 4);
  for (const double kn : { 1e3, 1e15 })
  {
    ModelParameters parameters = two_blocks(kn, 0.5 * kn);
    parameters.materials       = { material("lower", 8000., 1e9, 0.4),
                                   material("upper", 1000., 5e10, 0.) };
    const TestNodes nodes(mesh);
    const Model<2> model(nodes, parameters);
    const StepLimit<2> limit = find_step_limit(model, model.initial_state());

    const auto stability = stability_at(model, model.initial_state());
    std::vector<double> squared;
    for (unsigned int i = 0; i < model.mass().size(); ++i)
      squared.push_back(stability.squared_frequency(i, model.mass()[i]));
    const unsigned int stiffest
        = std::max_element(squared.begin(), squared.end()) - squared.begin();
    EXPECT_EQ(limit.where, model.nodes().point(stiffest));
    EXPECT_EQ(limit.block, model.nodes().block_of_node(stiffest));
    EXPECT_FALSE(limit.is_rigid);
    EXPECT_NEAR(limit.cells_share, kn < 1e9 ? 1. : 0., 1e-3);
    if (kn < 1e9)
    {
      EXPECT_EQ(limit.block, 1U);
    }

    std::sort(squared.begin(), squared.end(), std::greater<>());
    const double n = squared.size();
    EXPECT_DOUBLE_EQ(limit.critical, 2. / std::sqrt(squared[0]));
    for (unsigned int k = 0; k < limit.longer.size(); ++k)
      EXPECT_NEAR(
          limit.longer[k],
          std::sqrt(squared[0] / squared[std::ceil(limit.shares[k] * n)]),
          2e-6 * limit.longer[k]);
  }
}

TEST(StableTimeStep, BoundsTheLargestFrequencyOfUnequalBlocks)
{
  // Stiff and light on soft and heavy, at all joint stiffnesses.
  BlockMesh<2> mesh = make_stack(2, 1);
  for (const auto &[kn, ks] : joint_stiffnesses)
  {
    ModelParameters parameters = two_blocks(kn, ks);
    parameters.materials       = { material("lower", 8000., 1e9, 0.4),
                                   material("upper", 1000., 5e10, 0.) };
    const TestNodes nodes(mesh);
    const Model<2> model(nodes, parameters);
    EXPECT_GE(stability_at(model, model.initial_state())
                  .largest_eigenvalue(model.mass()),
              exact_eigenvalue(model) * (1. - 1e-6))
        << kn;
  }
}

TEST(StableTimeStep, BoundsTheFrequencyWhereFourBlocksMeet)
{
  MeshData<2> data;
  for (const double x : { 0., 1. })
    for (const double y : { 0., 1. })
      add_grid(data, 1, 1, "rock", x, y);
  BlockMesh<2> mesh = split_into_blocks(data, {});
  ASSERT_EQ(mesh.n_blocks(), 4U);
  for (const auto &[kn, ks] : joint_stiffnesses)
  {
    ModelParameters parameters;
    parameters.materials = { material("rock") };
    parameters.joints    = { elastic_joint(kn, ks, "unnamed") };
    const TestNodes nodes(mesh);
    const Model<2> model(nodes, parameters);
    const double exact = exact_eigenvalue(model);
    const double bound = stability_at(model, model.initial_state())
                             .largest_eigenvalue(model.mass());
    EXPECT_GE(bound, exact * (1. - 1e-6)) << kn;
    EXPECT_LE(bound, 1.3 * exact) << kn;
  }
}

TEST(StableTimeStep, RunsAtTheBoundStayBounded)
{
  BlockMesh<2> mesh = make_stack(2, 2);
  for (const auto &[kn, ks] : joint_stiffnesses)
    for (const double beta : { 0., 2e-4 })
    {
      TestRun run(mesh, two_blocks(kn, ks), {});
      StageParameters stage = stage_with({}, beta > 0. ? DampingType::rayleigh
                                                       : DampingType::none);
      stage.stiffness_coefficient = beta;
      run.begin(stage, 0.99);
      run.throw_at_random(1e-6);
      run.step(2000, true);
      EXPECT_LT(largest_speed(run.state), 2e-5) << kn << " " << beta;
    }
}

TEST(StableTimeStep, RunsAboveTheLargestFrequencyBlowUp)
{
  // So that the test above would notice a step that is too long.
  BlockMesh<2> mesh = make_stack(2, 2);
  for (const auto &[kn, ks] : joint_stiffnesses)
  {
    TestRun run(mesh, two_blocks(kn, ks), {});
    run.begin(stage_with({}));
    run.solver.set_time_step(1.01 * 2.
                             / std::sqrt(exact_eigenvalue(run.model)));
    run.throw_at_random(1e-12);
    run.step(300);
    EXPECT_GT(largest_speed(run.state), 1e-6) << kn;
  }
}
