// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/initial_block_motion.h>
#include <quoin/model/block_placement.h>

namespace quoin
{
  namespace
  {
    /** Centroid of @p block where it is in @p state; collective. */
    dealii::Point<2> centroid_now(const Model<2> &model,
                                  const unsigned int block,
                                  const State<2> &state)
    {
      const BlockInertia rest = inertia_of_block(model, block);
      dealii::Tensor<1, 2> sum; // of masses by displacements
      for (const unsigned int i : owned_nodes(model, block))
        sum += model.mass()[i] * state.nodes[i].u;
      return rest.centroid
             + dealii::Utilities::MPI::sum(sum, model.nodes().communicator())
                   / rest.mass;
    }

    /** Whether @p constraint prescribes a component of the motion of @p block
        in which it starts, or moves it as a body; on this rank. */
    bool determines(const MotionConstraint<2> &constraint,
                    const unsigned int block, const Model<2> &model,
                    const State<2> &state)
    {
      const ConstraintTraits &traits = constraint.traits();
      for (const unsigned int i : constraint.nodes())
      {
        if (model.nodes().block_of_node(i) != block)
          continue;
        if (traits.is_rigid_body())
          return true;
        for (unsigned int d = 0; d < state.velocity[i].dimension; ++d)
          if (traits.kind == MotionKind::prescribed && traits.holds[d]
              && state.velocity[i][d] != 0.)
            return true;
      }
      return false;
    }

    void refuse_contradictions(const NamedBlock &block, const Model<2> &model,
                               const Solver<2> &solver,
                               const StageParameters &first,
                               const State<2> &state)
    {
      const std::string where = "section 'Blocks/" + block.name
                                + "': 'Velocity' and 'Spin' are those of a "
                                  "block that ";
      if (state.is_absent(block.number))
        throw InputError(where
                         + "is not there at the start, but is placed by 'Fill' "
                           "of a stage. Make them 0.");
      for (const auto &constraint : solver.loads().constraints)
        if (names_load(first, constraint->name())
            && dealii::Utilities::MPI::max(
                   determines(*constraint, block.number, model, state) ? 1 : 0,
                   model.nodes().communicator())
                   > 0)
          throw InputError(where + "the load '" + constraint->name()
                           + "' holds or drives in the stage '" + first.name
                           + "'. Make them 0, or name the load in later stages "
                             "only.");
    }
  } // namespace

  void start_blocks(const std::vector<NamedBlock> &blocks,
                    const Model<2> &model, const Solver<2> &solver,
                    const StageParameters &first, State<2> &state)
  {
    const NodeMap<2> &nodes = model.nodes();
    for (const NamedBlock &block : blocks)
    {
      if (!block.moves())
        continue;
      const dealii::Point<2> centre = centroid_now(model, block.number, state);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        if (nodes.block_of_node(i) != block.number)
          continue;
        const NodeRecord<2> &node = state.nodes[i];
        const double x            = node.X[0] + node.u[0] - centre[0];
        const double y            = node.X[1] + node.u[1] - centre[1];
        state.velocity[i][0] += block.velocity[0] - block.spin * y;
        state.velocity[i][1] += block.velocity[1] + block.spin * x;
      }
      if (nodes.table().is_rigid[block.number]
          && nodes.blocks().find(block.number) < nodes.blocks().parts.size())
      {
        double *velocity
            = state.get<RigidBlockStates>()[rigid_number(model, block.number)]
                  .velocity;
        velocity[0] += block.velocity[0];
        velocity[1] += block.velocity[1];
        velocity[2] += block.spin;
      }
      refuse_contradictions(block, model, solver, first, state);
    }
  }
} // namespace quoin
