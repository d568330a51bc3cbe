// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/cell_states.h>
#include <quoin/model/block_placement.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Resets the internal variables of the cells of @p block on this rank. */
    void reset_plasticity(const Model<2> &model, const unsigned int block,
                          PlasticHistory &history)
    {
      const NodeMap<2> &nodes = model.nodes();
      const unsigned int part = nodes.blocks().find(block);
      if (part == nodes.blocks().parts.size())
        return;
      const auto &[begin, end] = nodes.blocks().parts[part].cells;
      for (unsigned int c = begin; c < end; ++c)
        forget_history(model.blocks(), c, history);
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int> owned_nodes(const Model<dim> &model,
                                        const unsigned int block)
  {
    const NodeMap<dim> &nodes = model.nodes();
    std::vector<unsigned int> result;
    const NodeRange own = block_nodes(model, block);
    for (std::size_t i = own.begin; i < own.end; ++i)
      result.push_back(i);
    for (unsigned int i = nodes.first_shared_node();
         i < nodes.n_deformable_nodes(); ++i)
      if (nodes.block_of_node(i) == block)
        result.push_back(i);
    return result;
  }

  template <int dim>
  NodeRange block_nodes(const Model<dim> &model, const unsigned int block)
  {
    const NodeMap<dim> &nodes = model.nodes();
    const unsigned int part   = nodes.blocks().find(block);
    if (part == nodes.blocks().parts.size())
      return { 0, 0 };
    const auto &[begin, end] = nodes.blocks().parts[part].nodes;
    return { begin, end };
  }

  template <int dim>
  unsigned int rigid_number(const Model<dim> &model, const unsigned int block)
  {
    const NodeMap<dim> &nodes = model.nodes();
    return nodes.blocks().find(block) - nodes.blocks().n_deformable;
  }

  template <int dim>
  std::vector<bool> absent_nodes(const Model<dim> &model,
                                 const State<dim> &state)
  {
    const NodeMap<dim> &nodes = model.nodes();
    std::vector<bool> result(nodes.n_local(), false);
    if (!state.block_marks.empty())
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = state.is_absent(nodes.block_of_node(i));
    return result;
  }

  bool is_at_absent_block(const Model<2> &model, const unsigned int segment,
                          const State<2> &state)
  {
    const JointNodes<2> &face
        = model.nodes().faces().joints[model.joints().segments()[segment].face];
    return state.is_absent(face.blocks[0]) || state.is_absent(face.blocks[1]);
  }

  void bring_to_rest(const Model<2> &model,
                     const std::vector<unsigned int> &blocks, State<2> &state)
  {
    // A deformable block may lie on several ranks, and so may its nodes.
    std::vector<double> sums(3 * blocks.size(), 0.);
    for (unsigned int k = 0; k < blocks.size(); ++k)
      for (const unsigned int i : owned_nodes(model, blocks[k]))
      {
        state.velocity[i] = NodeVector<2>{ { 0., 0. } };
        for (unsigned int d = 0; d < 2; ++d)
          sums[3 * k + d] += state.nodes[i].u[d];
        ++sums[3 * k + 2];
      }
    dealii::Utilities::MPI::sum(sums, model.nodes().communicator(), sums);
    for (unsigned int k = 0; k < blocks.size(); ++k)
    {
      const unsigned int block = blocks[k];
      if (model.nodes().table().is_rigid[block])
      {
        if (block_nodes(model, block).size() > 0)
          std::fill_n(state.get<RigidBlockStates>()[rigid_number(model, block)]
                          .velocity,
                      3, 0.);
        continue;
      }
      for (const unsigned int i : owned_nodes(model, block))
        for (unsigned int d = 0; d < 2; ++d)
          state.nodes[i].u[d] = sums[3 * k + d] / sums[3 * k + 2];
      reset_plasticity(model, block, state.get<PlasticHistory>());
    }
  }

  void place_blocks(const Model<2> &model,
                    const std::vector<unsigned int> &blocks, State<2> &state)
  {
    bring_to_rest(model, blocks, state);
    for (const unsigned int block : blocks)
    {
      const auto nodes = owned_nodes(model, block);
      for (const unsigned int i : nodes)
        std::fill_n(state.nodes[i].u, 2, 0.);
      if (model.nodes().table().is_rigid[block] && !nodes.empty())
        state.get<RigidBlockStates>()[rigid_number(model, block)]
            = RigidBlockState();
    }
  }

  template std::vector<unsigned int> owned_nodes(const Model<2> &,
                                                 unsigned int);
  template NodeRange block_nodes(const Model<2> &, unsigned int);
  template unsigned int rigid_number(const Model<2> &, unsigned int);
  template std::vector<bool> absent_nodes(const Model<2> &, const State<2> &);
  template std::vector<unsigned int> owned_nodes(const Model<3> &,
                                                 unsigned int);
  template NodeRange block_nodes(const Model<3> &, unsigned int);
  template unsigned int rigid_number(const Model<3> &, unsigned int);
  template std::vector<bool> absent_nodes(const Model<3> &, const State<3> &);
} // namespace quoin
