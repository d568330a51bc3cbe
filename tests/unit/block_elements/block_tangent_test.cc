// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Forces and stiffness of BlockForces<2>::linearise(): against the kernels of
// the explicit solver, differences, energies and integrals.

#include "tangent_checks.h"

#include <quoin/blocks/cell_states.h>

#include <gtest/gtest.h>

using namespace quoin;
using namespace quoin::tangent_test;

namespace
{
  constexpr double degree = 0.017453292519943295;

  /** The same, but the first one yields. */
  RandomBlocks plastic_block(const PlaneAssumption plane, const bool quadratic,
                             const double dilation_angle)
  {
    RandomBlocks mesh = elastic_block(plane, quadratic);
    mesh.data.laws.resize(2);
    mesh.data.laws[0].emplace(
        stone, MohrCoulombStrength{ 2e6, 35. * degree, dilation_angle, 2e6 },
        plane);
    return mesh;
  }

  Vector lane_forces(const BlockForces<2> &blocks,
                     const AlignedArray<NodeRecord<2>> &nodes,
                     PlasticHistory &history, double *dissipated = nullptr)
  {
    AlignedArray<dealii::Tensor<1, 2>> sums(nodes.size(),
                                            dealii::Tensor<1, 2>());
    double lost = 0.;
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      lost += blocks.add_forces(tile, nodes.data(), history, sums.data());
    if (dissipated)
      *dissipated = lost;
    Vector force;
    for (const dealii::Tensor<1, 2> &sum : sums)
      force.insert(force.end(), sum.begin_raw(), sum.end_raw());
    return force;
  }

  double asymmetry(const Matrix &a)
  {
    double max = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        max = std::max(max, std::abs(a[i][j] - a[j][i]));
    return max / largest(a);
  }

  /** Minus the derivative of @p forces by displacement @p j. */
  template <typename Forces>
  Vector slope(const AlignedArray<NodeRecord<2>> &nodes, const unsigned int j,
               const double h, const Forces &forces)
  {
    auto moved           = nodes;
    double &displacement = moved[j / 2].u[j % 2];
    const double middle  = displacement;
    displacement         = middle + h;
    const double right   = displacement;
    Vector result        = forces(moved);
    displacement         = middle - h;
    const Vector other   = forces(moved);
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = (other[i] - result[i]) / (right - displacement);
    return result;
  }

  /** Largest error of the columns of @p stiffness, by its largest entry. */
  template <typename Forces>
  double derivative_error(const Matrix &stiffness,
                          const AlignedArray<NodeRecord<2>> &nodes,
                          const double h, const Forces &forces)
  {
    double error = 0.;
    for (unsigned int j = 0; j < stiffness.size(); ++j)
    {
      const Vector column = slope(nodes, j, h, forces);
      for (unsigned int i = 0; i < stiffness.size(); ++i)
        error = std::max(error, std::abs(stiffness[i][j] - column[i]));
    }
    return error / largest(stiffness);
  }
} // namespace

TEST(BlockTangent, ForcesAreThoseOfTheLanes)
{
  for (const PlaneAssumption plane : both_assumptions)
    for (const bool plastic : { false, true })
      for (const double angle : { 0., 2.1, -1.3 })
      {
        RandomBlocks mesh = plastic ? plastic_block(plane, false, 0.)
                                    : elastic_block(plane, false, 7);
        mesh.add_initial_stress(5e5);
        BlockForces<2> blocks = mesh.prepared();
        PlasticHistory a = initial_history(blocks), b = a;
        for (const double strain : { 5e-4, 1.5e-3 })
        {
          mesh.deform(strain, angle);
          double lost = 0., expected = 0.;
          const Vector force
              = linearised(blocks, mesh.nodes, a, nullptr, &lost);
          const Vector wanted = lane_forces(blocks, mesh.nodes, b, &expected);
          EXPECT_LT(largest_difference(force, wanted), 1e-10 * largest(wanted));
          EXPECT_EQ(expected != 0., plastic);
          EXPECT_NEAR(lost, expected, 1e-10 * std::abs(expected));
        }
        EXPECT_EQ(a.yielding, b.yielding);
        for (unsigned int c = 0; c < a.cells.size(); ++c)
          for (unsigned int i = 0; i < 4; ++i)
            EXPECT_NEAR(a.cells[c].inverse_stretch[i],
                        b.cells[c].inverse_stretch[i], 1e-13);
      }
}

TEST(BlockTangent, ElasticStiffnessIsTheDerivativeOfTheForces)
{
  for (const PlaneAssumption plane : both_assumptions)
    for (const bool quadratic : { false, true })
      for (const double angle : { 0., 0.8, 3.0, -1.6 })
      {
        RandomBlocks mesh = elastic_block(plane, quadratic);
        mesh.add_initial_stress(2e9); // so that the geometric part counts
        BlockForces<2> blocks = mesh.prepared();
        mesh.deform(0.08, angle);
        PlasticHistory none;
        Matrix stiffness;
        linearised(blocks, mesh.nodes, none, &stiffness);
        EXPECT_LT(asymmetry(stiffness), 1e-14);
        const double error
            = derivative_error(stiffness, mesh.nodes, 1e-6,
                               [&](const auto &nodes)
                               {
                                 return quadratic
                                            ? linearised(blocks, nodes, none)
                                            : lane_forces(blocks, nodes, none);
                               });
        EXPECT_LT(error, 1e-8) << quadratic << " " << angle;
      }
}

TEST(BlockTangent, ForcesAreMinusTheGradientOfTheEnergy)
{
  for (const PlaneAssumption plane : both_assumptions)
    for (const bool quadratic : { false, true })
    {
      RandomBlocks mesh = elastic_block(plane, quadratic);
      mesh.add_initial_stress(2e8);
      BlockForces<2> blocks = mesh.prepared();
      mesh.deform(0.05, -2.4);
      PlasticHistory none;
      const Vector force = linearised(blocks, mesh.nodes, none);
      for (unsigned int j = 0; j < force.size(); ++j)
      {
        const Vector gradient = slope(
            mesh.nodes, j, 1e-5,
            [&](const auto &nodes)
            { return Vector{ strain_energy(blocks, nodes.data(), none) }; });
        EXPECT_NEAR(force[j], gradient[0], 1e-7 * largest(force));
      }
    }
}

TEST(BlockTangent, PlasticStiffnessIsTheDerivativeOfTheForces)
{
  for (const PlaneAssumption plane : both_assumptions)
    for (const bool quadratic : { false, true })
      for (const auto &[dilation, size] :
           { std::pair(35. * degree, 1.), std::pair(10. * degree, 1.),
             std::pair(0., 200.) })
      {
        RandomBlocks mesh = plastic_block(plane, quadratic, dilation);
        mesh.add_initial_stress(5e5);
        BlockForces<2> blocks  = mesh.prepared();
        PlasticHistory history = initial_history(blocks);
        mesh.deform(1.2e-4 * size, 1.9); // some cells have yielded before
        linearised(blocks, mesh.nodes, history);
        mesh.deform(2.5e-4 * size, 2.0);
        Matrix stiffness;
        PlasticHistory end = history;
        linearised(blocks, mesh.nodes, end, &stiffness);
        unsigned int n_yielding = 0;
        for (const auto state : end.yielding)
          n_yielding
              += (state & (yielding::shear_now | yielding::tension_now)) != 0;
        EXPECT_GT(n_yielding, 3U);

        // Strains change by less than would take a cell past a corner of the
        // yield surface; the seed has none at one.
        const double error
            = derivative_error(stiffness, mesh.nodes, 1e-9 * std::sqrt(size),
                               [&](const auto &nodes)
                               {
                                 PlasticHistory trial = history;
                                 return quadratic
                                            ? linearised(blocks, nodes, trial)
                                            : lane_forces(blocks, nodes, trial);
                               });
        EXPECT_LT(error, 3e-7) << quadratic << " " << dilation << " " << size;
        // The flow is associated with Cauchy's stress, by whose volume the
        // stiffness is not symmetric: to the size of the elastic strains.
        if (dilation == 35. * degree)
        {
          EXPECT_LT(asymmetry(stiffness), 1e-3);
        }
        else if (size == 1.)
        {
          EXPECT_GT(asymmetry(stiffness), 1e-2);
        }
      }
}

TEST(BlockTangent, RigidMotionsMakeNoForce)
{
  for (const bool quadratic : { false, true })
    for (const double angle : { 1e-7, 0.4, 1.5707, 3.14159, -2.5, -0.9 })
    {
      RandomBlocks mesh      = plastic_block(PlaneAssumption::plane_strain,
                                             quadratic, 10. * degree);
      BlockForces<2> blocks  = mesh.prepared();
      PlasticHistory history = initial_history(blocks);
      mesh.move_rigidly(angle, 1.7, -2.3);
      Matrix stiffness;
      const Vector force = linearised(blocks, mesh.nodes, history, &stiffness);
      EXPECT_LT(largest(force), 1e-14 * largest(stiffness));
      // Nor do motions that begin here: two shifts and a turn.
      for (unsigned int mode = 0; mode < 3; ++mode)
      {
        Vector motion;
        for (const NodeRecord<2> &node : mesh.nodes)
          for (unsigned int d = 0; d < 2; ++d)
            motion.push_back(mode < 2 ? double(mode == d)
                             : d == 0 ? -(node.X[1] + node.u[1])
                                      : node.X[0] + node.u[0]);
        EXPECT_LT(largest(product(stiffness, motion)),
                  1e-13 * largest(stiffness));
      }
    }
}

TEST(BlockTangent, ForcesTurnWithTheBody)
{
  // K r = -J f: what a turn adds to forces is that they turn, too.
  for (const bool quadratic : { false, true })
  {
    RandomBlocks mesh = elastic_block(PlaneAssumption::plane_stress, quadratic);
    mesh.add_initial_stress(1e9);
    BlockForces<2> blocks = mesh.prepared();
    mesh.deform(0.04, 0.7);
    PlasticHistory none;
    Matrix stiffness;
    const Vector force = linearised(blocks, mesh.nodes, none, &stiffness);
    Vector turn, turned;
    for (unsigned int i = 0; i < mesh.nodes.size(); ++i)
    {
      const NodeRecord<2> &node = mesh.nodes[i];
      turn.push_back(-(node.X[1] + node.u[1]));
      turn.push_back(node.X[0] + node.u[0]);
      turned.push_back(force[2 * i + 1]);
      turned.push_back(-force[2 * i]);
    }
    EXPECT_GT(largest(force), 1e-3 * largest(stiffness));
    EXPECT_LT(largest_difference(product(stiffness, turn), turned),
              1e-13 * largest(stiffness));
  }
}
