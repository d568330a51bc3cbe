// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/constants.h>
#include <quoin/base/known_names.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/model/block_placement.h>
#include <quoin/operators/archive.h>
#include <quoin/results/block_histories.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  BlockHistories::BlockHistories(const std::vector<HistoryParameters> &wanted,
                                 const std::vector<NamedBlock> &named,
                                 const Model<2> &model,
                                 const BlockContacts *contacts)
    : model(model), contacts(contacts)
  {
    for (const HistoryParameters &history : wanted)
    {
      const unsigned int first = find_named(named, history.block)->number;
      Column column{ history.quantity, history.component, add_block(first), 0 };
      if (history.quantity == HistoryQuantity::block_force)
        column.pair = add_pair(
            first, history.other_block.empty()
                       ? any_block
                       : find_named(named, history.other_block)->number);
      columns.push_back(column);
    }
    counted.resize(blocks.size(), 0.);
    if (!pairs.empty())
    {
      before.add<JointHistory>();
      node_force.resize(model.nodes().n_local(), dealii::Tensor<1, 2>());
    }
  }

  unsigned int BlockHistories::add_block(const unsigned int number)
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
      if (blocks[b].number == number)
        return b;
    Block block{ number,
                 model.nodes().table().is_rigid[number],
                 inertia_of_block(model, number),
                 owned_nodes(model, number),
                 {} };
    for (const unsigned int i : block.nodes)
      block.mass.push_back(model.mass()[i]);
    blocks.push_back(block);
    return blocks.size() - 1;
  }

  bool BlockHistories::acts(const Pair &pair, const unsigned int on,
                            const unsigned int by)
  {
    return on == pair.first && by != on
           && (pair.second == any_block || by == pair.second);
  }

  unsigned int BlockHistories::add_pair(const unsigned int first,
                                        const unsigned int second)
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (pairs[p].first == first && pairs[p].second == second)
        return p;
    Pair pair{ add_block(first), first, second, {} };
    const auto &segments = model.joints().segments();
    for (unsigned int i = 0; i < segments.size(); ++i)
    {
      const auto &[lower, upper]
          = model.nodes().faces().joints[segments[i].face].blocks;
      if (acts(pair, lower, upper))
        pair.sides.push_back({ i, true });
      if (acts(pair, upper, lower))
        pair.sides.push_back({ i, false });
    }
    pairs.push_back(pair);
    return pairs.size() - 1;
  }

  bool BlockHistories::is_of(const unsigned int column,
                             const unsigned int block) const
  {
    if (blocks[columns[column].block].number == block)
      return true;
    return columns[column].quantity == HistoryQuantity::block_force
           && pairs[columns[column].pair].second == block;
  }

  void BlockHistories::add_velocities(const State<2> &state, const double share)
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      const Block &block = blocks[b];
      Sums &sum          = sums[b];
      if (block.is_rigid && !block.nodes.empty())
      {
        const double *v
            = state.get<RigidBlockStates>()[rigid_number(model, block.number)]
                  .velocity;
        sum.momentum += share * dealii::Point<2>(v[0], v[1]);
        sum.spin += share * v[2];
      }
      if (block.is_rigid)
        continue;
      for (std::size_t k = 0; k < block.nodes.size(); ++k)
      {
        const NodeRecord<2> &node     = state.nodes[block.nodes[k]];
        const double m                = share * block.mass[k];
        const dealii::Tensor<1, 2> &v = state.velocity[block.nodes[k]];
        sum.momentum += m * v;
        sum.spin += m * cross(node.X - block.rest.centroid + node.u, v);
      }
    }
  }

  void BlockHistories::before_step(const State<2> &state)
  {
    sums.assign(blocks.size(), Sums());
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      const Block &block = blocks[b];
      Sums &sum          = sums[b];
      if (block.is_rigid && !block.nodes.empty())
      {
        const RigidBlockState &rigid
            = state.get<RigidBlockStates>()[rigid_number(model, block.number)];
        sum.displacement = rigid.displacement;
        sum.sine         = rigid.rotation;
      }
      if (block.is_rigid)
        continue;
      for (std::size_t k = 0; k < block.nodes.size(); ++k)
      {
        const NodeRecord<2> &node    = state.nodes[block.nodes[k]];
        const double m               = block.mass[k];
        const dealii::Tensor<1, 2> r = node.X - block.rest.centroid;
        sum.sine += m * cross(r, node.u);
        sum.displacement += m * node.u;
        sum.cosine += m * (r * node.u);
        sum.square += m * (r + node.u).norm_square();
      }
    }
    add_velocities(state, 1.);
    before.previous_time_step = state.previous_time_step;
    if (pairs.empty())
      return;
    before.nodes    = state.nodes;
    before.velocity = state.velocity;
    // Velocities of ghosts are those of the step before.
    if (model.joints().dashpots.act())
      model.nodes().exchange().update_ghosts(before.velocity.data());
  }

  void BlockHistories::add_force(const Pair &pair, const double share,
                                 const dealii::Tensor<1, 2> &place,
                                 const dealii::Tensor<1, 2> &force,
                                 Force &sum) const
  {
    add_to_vector(sum, 0, share * force);
    sum[2] += share * cross(place - blocks[pair.block].rest.centroid, force);
  }

  BlockHistories::Force BlockHistories::joint_force(const Pair &pair)
  {
    Force sum{};
    for (const auto &[segment, is_lower] : pair.sides)
    {
      if (before.get<JointHistory>().handed_over[segment])
        continue;
      add_traction_forces(model.joints(), segment, before, node_force.data());
      model.joints().add_dashpot_forces(segment, before, node_force.data());
      const JointSegment &joint = model.joints().segments()[segment];
      for (const unsigned int i : is_lower ? joint.lower : joint.upper)
      {
        const NodeRecord<2> &node = before.nodes[i];
        add_force(pair, joint.share, node.position(), node_force[i], sum);
      }
      for (const auto &side : { joint.lower, joint.upper })
        for (const unsigned int i : side)
          node_force[i] = dealii::Tensor<1, 2>();
    }
    return sum;
  }

  void BlockHistories::add_contact_forces(const ContactState &all,
                                          std::vector<Force> &forces) const
  {
    const ContactEdges &edges = contacts->contact_edges();
    const auto add            = [&](const unsigned int i,
                         const auto &find) // bool (ContactEndForces &)
    {
      const unsigned int lower = edges[all.pairs[i].lower].block;
      const unsigned int upper = edges[all.pairs[i].upper].block;
      for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        const bool is_lower = acts(pairs[p], lower, upper);
        ContactEndForces ends;
        if ((!is_lower && !acts(pairs[p], upper, lower)) || !find(ends))
          continue;
        for (const unsigned int n : { is_lower ? 0 : 2, is_lower ? 1 : 3 })
          add_force(pairs[p], ends.share, ends.place[n], ends.force[n],
                    forces[p]);
      }
    };
    for (unsigned int i = 0; i < all.pairs.size(); ++i)
      add(i, [&](ContactEndForces &ends)
          { return contacts->near_pairs().end_forces(all, i, ends); });
    for (const ContactDashpot &at : contacts->dashpots().all())
      add(at.pair,
          [&](ContactEndForces &ends)
          {
            ends = contacts->near_pairs().spread(at.pair, at.lower, at.upper,
                                                 at.force);
            return true;
          });
  }

  void BlockHistories::add_up(std::vector<Force> &forces)
  {
    std::vector<double> all;
    for (const Sums &sum : sums)
      all.insert(all.end(), { sum.displacement[0], sum.displacement[1],
                              sum.sine, sum.cosine, sum.momentum[0],
                              sum.momentum[1], sum.spin, sum.square });
    for (const Force &force : forces)
      all.insert(all.end(), force.begin(), force.end());
    dealii::Utilities::MPI::sum(all, model.nodes().communicator(), all);
    const double *next = all.data();
    for (Sums &sum : sums)
    {
      sum = { vector_at(next, 0), next[2], next[3],
              vector_at(next, 2), next[6], next[7] };
      next += 8;
    }
    for (Force &force : forces)
    {
      std::copy_n(next, 3, force.begin());
      next += 3;
    }
  }

  void BlockHistories::count_rotations(const State<2> &state)
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      const Sums &sum = sums[b];
      if (state.is_absent(blocks[b].number))
        counted[b] = 0.;
      else if (blocks[b].is_rigid)
        counted[b] = sum.sine;
      else
        counted[b] += std::remainder(
            std::atan2(sum.sine, blocks[b].rest.moment + sum.cosine)
                - counted[b],
            2. * dealii::numbers::PI);
    }
  }

  std::array<double, 3> BlockHistories::motion(const unsigned int b,
                                               const bool is_velocity) const
  {
    const Sums &sum   = sums[b];
    const double mass = blocks[b].is_rigid ? 1. : blocks[b].rest.mass;
    const dealii::Tensor<1, 2> u = sum.displacement / mass;
    if (!is_velocity)
      return { u[0], u[1], counted[b] };
    const dealii::Tensor<1, 2> v = sum.momentum / mass;
    const double spin            = blocks[b].is_rigid
                                       ? sum.spin
                                       : (sum.spin - mass * cross(u, v))
                                  / (sum.square - mass * u.norm_square());
    return { v[0], v[1], spin };
  }

  std::vector<double> BlockHistories::after_step(const State<2> &state)
  {
    // Velocities at the full step, from those in the middle of the steps before
    // and after it, at the start of the run from the first one at t = 0. As a
    // node moves along its velocity after the step, it has the same moment
    // where it is then.
    const double h0 = before.previous_time_step, h1 = state.previous_time_step;
    const double share = h0 > 0. ? h0 / (h0 + h1) : 0.;
    for (Sums &sum : sums)
    {
      sum.momentum *= 1. - share;
      sum.spin *= 1. - share;
    }
    add_velocities(state, share);
    std::vector<Force> forces;
    if (!pairs.empty())
      before.get<JointHistory>() = state.get<JointHistory>();
    for (const Pair &pair : pairs)
      forces.push_back(joint_force(pair));
    if (contacts && !pairs.empty())
      add_contact_forces(state.get<ContactState>(), forces);
    add_up(forces);
    count_rotations(state);

    std::vector<double> values;
    for (unsigned int c = 0; c < columns.size(); ++c)
    {
      const Column &column  = columns[c];
      const bool is_force   = column.quantity == HistoryQuantity::block_force;
      const unsigned int by = is_force ? pairs[column.pair].second : any_block;
      bool is_absent = false, is_removed = false;
      for (const unsigned int block : { blocks[column.block].number, by })
      {
        if (block == any_block || !state.is_absent(block))
          continue;
        is_absent = true;
        is_removed
            = is_removed || state.block_marks[block] == block_mark::removed;
      }
      const auto position = motion(column.block, false);
      std::array<double, 3> value
          = column.quantity == HistoryQuantity::block_displacement
                ? position
                : motion(column.block, true);
      if (is_force)
      {
        value = forces[column.pair];
        value[2] -= cross(vector_at(position, 0), vector_at(value, 0));
      }
      else
        value[2] /= constants::degree;
      values.push_back(is_removed  ? std::numeric_limits<double>::quiet_NaN()
                       : is_absent ? 0.
                                   : value[column.component]);
    }
    return values;
  }
} // namespace quoin
