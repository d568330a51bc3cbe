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
    template <int dim>
    void reset_plasticity(const Model<dim> &model, const unsigned int block,
                          PlasticHistory &history)
    {
      const NodeMap<dim> &nodes = model.nodes();
      const unsigned int part   = nodes.blocks().find(block);
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

  template <int dim>
  bool is_at_absent_block(const Model<dim> &model, const unsigned int joint,
                          const State<dim> &state)
  {
    const JointNodes<dim> &face
        = model.nodes().faces().joints[joint_faces(model.joints())[joint].face];
    return state.is_absent(face.blocks[0]) || state.is_absent(face.blocks[1]);
  }

  template <int dim>
  void bring_to_rest(const Model<dim> &model,
                     const std::vector<unsigned int> &blocks, State<dim> &state)
  {
    // A deformable block may lie on several ranks, and so may its nodes.
    constexpr unsigned int n = dim + 1;
    std::vector<double> sums(n * blocks.size(), 0.);
    for (unsigned int k = 0; k < blocks.size(); ++k)
      for (const unsigned int i : owned_nodes(model, blocks[k]))
      {
        state.velocity[i] = dealii::Tensor<1, dim>();
        for (unsigned int d = 0; d < dim; ++d)
          sums[n * k + d] += state.nodes[i].u[d];
        ++sums[n * k + dim];
      }
    dealii::Utilities::MPI::sum(sums, model.nodes().communicator(), sums);
    for (unsigned int k = 0; k < blocks.size(); ++k)
    {
      const unsigned int block = blocks[k];
      if (model.nodes().table().is_rigid[block])
      {
        if (block_nodes(model, block).size() > 0)
          std::fill_n(
              state.template get<RigidBlockStates>()[rigid_number(model, block)]
                  .velocity,
              3, 0.);
        continue;
      }
      for (const unsigned int i : owned_nodes(model, block))
        for (unsigned int d = 0; d < dim; ++d)
          state.nodes[i].u[d] = sums[n * k + d] / sums[n * k + dim];
      reset_plasticity(model, block, state.template get<PlasticHistory>());
    }
  }

  template <int dim>
  void place_blocks(const Model<dim> &model,
                    const std::vector<unsigned int> &blocks, State<dim> &state)
  {
    bring_to_rest(model, blocks, state);
    for (const unsigned int block : blocks)
    {
      const auto nodes = owned_nodes(model, block);
      for (const unsigned int i : nodes)
        state.nodes[i].u = 0.;
      if (model.nodes().table().is_rigid[block] && !nodes.empty())
        state.template get<RigidBlockStates>()[rigid_number(model, block)]
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
  template bool is_at_absent_block(const Model<2> &, unsigned int,
                                   const State<2> &);
  template void bring_to_rest(const Model<2> &,
                              const std::vector<unsigned int> &, State<2> &);
  template void place_blocks(const Model<2> &,
                             const std::vector<unsigned int> &, State<2> &);
  template bool is_at_absent_block(const Model<3> &, unsigned int,
                                   const State<3> &);
  template void bring_to_rest(const Model<3> &,
                              const std::vector<unsigned int> &, State<3> &);
  template void place_blocks(const Model<3> &,
                             const std::vector<unsigned int> &, State<3> &);
} // namespace quoin
