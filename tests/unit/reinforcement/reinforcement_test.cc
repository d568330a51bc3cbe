// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Bars in the cells of two blocks: resultants and derivatives of their forces.

#include "../model/test_models.h"

#include <quoin/reinforcement/bar_results.h>
#include <quoin/reinforcement/reinforcement.h>

#include <random>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** A bar through two blocks of 2 x 2 m, and a dowel in their joint. */
  struct BarInBlocks
  {
    BlockMesh<2> mesh = make_stack(2, 2);
    std::unique_ptr<BlockTriangulation<2>> blocks;
    std::unique_ptr<NodeMap<2>> nodes;
    std::unique_ptr<Model<2>> model;
    State<2> state;

    BarInBlocks()
    {
      CableParameters cable;
      cable.element_length      = 0.25;
      cable.name                = "bar";
      cable.bars                = { { { { 0.3, 3.7 }, { 1.6, 0.2 } } } };
      BarLaw &law               = cable.law;
      law.stiffness             = 1e8;
      law.yield                 = 2e5;
      law.bond_stiffness        = 1e9;
      law.bond_strength         = 3e5;
      law.plate_stiffness       = 1e8;
      law.dowel_stiffness       = 1e8;
      law.dowel_axial_stiffness = 2e8;
      law.active_length         = 0.1;
      cable.pretension          = 5e4;
      cable.free_length         = 1.;
      ModelParameters parameters;
      parameters.materials = { material("lower"), material("upper") };
      JointSetParameters set;
      set.name          = "joint";
      set.curves        = { "joint" };
      parameters.joints = { set };
      parameters.cables = { cable };
      blocks            = std::make_unique<BlockTriangulation<2>>(
          mesh, std::vector<unsigned int>(mesh.n_cells(), 0),
          std::vector<bool>(mesh.n_blocks(), false), MPI_COMM_SELF);
      nodes = std::make_unique<NodeMap<2>>(
          *blocks, std::vector<NodeMap<2>::Segment>{
                       { { { 0.3, 3.7 }, { 1.6, 0.2 } } } });
      model = std::make_unique<Model<2>>(*nodes, parameters);
      state = model->initial_state();
      model->reinforcement().begin_stage("first", true, 0., state);
    }

    std::vector<double> forces(State<2> &at,
                               std::vector<double> *stiffness = nullptr) const
    {
      const std::size_t n = 2 * nodes->n_local();
      std::vector<double> result(n, 0.);
      if (stiffness)
        stiffness->assign(n * n, 0.);
      model->reinforcement().linearise(
          at, stiffness,
          [&](const ElementLinearisation<2> &element)
          {
            for (unsigned int i = 0; i < 2 * element.n_nodes; ++i)
            {
              const unsigned int row = 2 * element.nodes[i / 2] + i % 2;
              result[row] += element.force[i];
              for (unsigned int j = 0; stiffness && j < 2 * element.n_nodes;
                   ++j)
                (*stiffness)[row * n + 2 * element.nodes[j / 2] + j % 2]
                    += element.stiffness[i * element.row_length + j];
            }
          });
      return result;
    }
  };
} // namespace

TEST(Reinforcement, ForcesHaveNoResultant)
{
  BarInBlocks bar;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> change(-1e-3, 1e-3);
  for (NodeRecord<2> &node : bar.state.nodes)
    for (double &u : dealii::make_array_view(node.u))
      u += change(random);
  const auto force = bar.forces(bar.state);
  double sum[3] = { 0., 0., 0. }, size = 0.;
  for (unsigned int i = 0; i < bar.state.nodes.size(); ++i)
  {
    const NodeRecord<2> &node = bar.state.nodes[i];
    const double x = node.X[0] + node.u[0], y = node.X[1] + node.u[1];
    sum[0] += force[2 * i];
    sum[1] += force[2 * i + 1];
    sum[2] += x * force[2 * i + 1] - y * force[2 * i];
    size += std::hypot(force[2 * i], force[2 * i + 1]);
  }
  EXPECT_GT(size, 1e5);
  EXPECT_NEAR(sum[0], 0., 1e-12 * size);
  EXPECT_NEAR(sum[1], 0., 1e-12 * size);
  // The two sides of the joint have moved apart by a millimetre.
  EXPECT_NEAR(sum[2], 0., 2e-3 * size);
}

TEST(Reinforcement, WhatBarsLoseWithABlockIsReleased)
{
  // Of the block with the head, and of that with the far end.
  for (const unsigned int gone : { 1U, 0U })
  {
    BarInBlocks bar;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> change(-1e-4, 1e-4);
    for (NodeRecord<2> &node : bar.state.nodes)
      for (double &u : dealii::make_array_view(node.u))
        u += change(random);
    const auto before = bar.forces(bar.state);
    bar.state.block_marks.resize(2, block_mark::present);
    bar.state.block_marks[gone] = block_mark::absent;
    // Blocks that are taken away come to rest at their mean displacement.
    const auto nodes_before = bar.state.nodes;
    for (unsigned int i = 0; i < bar.state.nodes.size(); ++i)
      if (bar.nodes->block_of_node(i) == gone)
        bar.state.nodes[i].u = dealii::Tensor<1, 2>({ 1e-3, -2e-3 });
    AlignedArray<dealii::Tensor<1, 2>> released(bar.state.nodes.size(),
                                                dealii::Tensor<1, 2>());
    const auto begin = [&]()
    {
      bar.model->reinforcement().begin_stage(
          "second", false, 0., bar.state, released.data(), nodes_before.data());
    };
    begin();
    const auto after = bar.forces(bar.state);
    double size = 0., change_there = 0.;
    for (unsigned int i = 0; i < bar.state.nodes.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const bool is_there = bar.nodes->block_of_node(i) != gone;
        size += std::abs(before[2 * i + d]);
        change_there += is_there ? std::abs(released[i][d]) : 0.;
        EXPECT_NEAR(released[i][d],
                    is_there ? before[2 * i + d] - after[2 * i + d] : 0.,
                    1e-9 * 1e5);
      }
    EXPECT_GT(change_there, 0.05 * size);
    // What is lost is so once.
    released = AlignedArray<dealii::Tensor<1, 2>>(bar.state.nodes.size(),
                                                  dealii::Tensor<1, 2>());
    begin();
    for (const dealii::Tensor<1, 2> &force : released)
      EXPECT_EQ(force.norm(), 0.);
  }
}

TEST(Reinforcement, StiffnessIsTheDerivative)
{
  BarInBlocks bar;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> change(-1e-4, 1e-4);
  for (unsigned int step = 0; step < 3; ++step)
  {
    for (NodeRecord<2> &node : bar.state.nodes)
      for (double &u : dealii::make_array_view(node.u))
        u += change(random);
    std::vector<double> stiffness;
    State<2> at = bar.state;
    bar.forces(at, &stiffness);
    const std::size_t n = 2 * bar.state.nodes.size();
    constexpr double h  = 1e-8;
    for (unsigned int j = 0; j < n; ++j)
    {
      State<2> up = bar.state, down = bar.state;
      up.nodes[j / 2].u[j % 2] += h;
      down.nodes[j / 2].u[j % 2] -= h;
      const auto a = bar.forces(up), b = bar.forces(down);
      for (unsigned int i = 0; i < n; ++i)
        EXPECT_NEAR(stiffness[i * n + j], (b[i] - a[i]) / (2. * h), 2e3);
    }
    bar.state = at;
  }
}

TEST(Reinforcement, PretensionInPlace)
{
  BarInBlocks bar;
  // Plate, free length, and a long bond as a spring.
  const double softness = 1. / 1e8 + 1. / 1e8 + 1. / std::sqrt(1e8 * 1e9);
  EXPECT_NEAR(bar.state.energy.external, 0.5 * 5e4 * 5e4 * softness, 0.6);
  EXPECT_NEAR(cable_value(bar.model->reinforcement(), bar.state, "bar",
                          CableQuantity::head_force, {}),
              5e4, 1e-6);
}

TEST(Reinforcement, ShearForceOfAnElementIsThatOfItsLargestDowel)
{
  // A bar without bond is one element through both joints.
  MeshData<2> data;
  const std::vector<std::string> groups = { "lower", "middle", "upper" };
  ModelParameters parameters;
  for (unsigned int i = 0; i < 3; ++i)
  {
    add_grid(data, 2, 1, groups[i], 0., i);
    parameters.materials.push_back(material(groups[i]));
    if (i > 0)
      add_curve(data, "joint", 0., i, 2., i);
  }
  BlockMesh<2> mesh  = split_into_blocks(data, {});
  const BarEnds ends = { { { 1.2, 2.8 }, { 1.2, 0.3 } } };
  CableParameters cable;
  cable.name                = "bar";
  cable.bars                = { ends };
  cable.law.stiffness       = 1e8;
  cable.law.plate_stiffness = cable.law.anchor_stiffness = 1e9;
  cable.law.dowel_stiffness                              = 1e8;
  parameters.joints = { elastic_joint(1e10, 1e10) };
  parameters.cables = { cable };
  const BlockTriangulation<2> blocks(
      mesh, std::vector<unsigned int>(mesh.n_cells(), 0),
      std::vector<bool>(mesh.n_blocks(), false), MPI_COMM_SELF);
  const NodeMap<2> nodes(blocks, std::vector<NodeMap<2>::Segment>{
                                     { { { 1.2, 2.8 }, { 1.2, 0.3 } } } });
  Model<2> model(nodes, parameters);
  State<2> state = model.initial_state();
  model.reinforcement().begin_stage("first", true, 0., state);
  const auto &dowels = model.reinforcement().all()[0].dowels;
  ASSERT_EQ(dowels.size(), 2u);
  ASSERT_EQ(dowels[0].element, dowels[1].element);
  auto &force = state.get<ReinforcementState>().bars[0].dowel_force;
  force[1]    = -5e3;
  force[3]    = 2e3;
  EXPECT_EQ(
      cable_fields(model.reinforcement(), state).shear_force[dowels[0].element],
      -5e3);
}

// A bar that is pressed at one end and pulled at the other.
TEST(Reinforcement, LargestForceIsThatOfTheLargestMagnitude)
{
  BarInBlocks bar;
  auto &force = bar.state.get<ReinforcementState>().bars[0].force;
  std::fill(force.begin(), force.end(), -1e3);
  const auto value = [&](const CableQuantity quantity)
  {
    return cable_value(bar.model->reinforcement(), bar.state, "bar", quantity,
                       {});
  };
  EXPECT_EQ(value(CableQuantity::largest_force), -1e3);
  EXPECT_EQ(value(CableQuantity::largest_tension), 0.);
  EXPECT_EQ(value(CableQuantity::largest_compression), 1e3);
  force.front() = -7e3;
  force.back()  = 4e3;
  EXPECT_EQ(value(CableQuantity::largest_force), -7e3);
  EXPECT_EQ(value(CableQuantity::largest_tension), 4e3);
  EXPECT_EQ(value(CableQuantity::largest_compression), 7e3);
  force.back() = 9e3;
  EXPECT_EQ(value(CableQuantity::largest_force), 9e3);
}
