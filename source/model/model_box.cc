// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/exceptions.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/model_box.h>

#include <algorithm>
#include <sstream>

namespace quoin
{
  namespace
  {
    bool is_inside(const std::array<double, 4> &box, const double x,
                   const double y)
    {
      return x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3];
    }

    std::string text(const std::array<double, 4> &box)
    {
      std::ostringstream out;
      out << "'Box = " << box[0] << ", " << box[1] << ", " << box[2] << ", "
          << box[3] << "'";
      return out.str();
    }

    /** Maximum over all ranks, entry by entry. */
    void reduce(std::vector<std::uint8_t> &flags, const MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE, flags.data(), flags.size(), MPI_UINT8_T,
                    MPI_MAX, communicator);
    }
  } // namespace

  ModelBox::ModelBox(const Model<2> &model)
    : model(model), parameters(model.parameters().contact)
  {
    const NodeMap<2> &nodes = model.nodes();
    std::vector<std::uint8_t> is_in(model.nodes().table().n_blocks(), 0);
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      if (is_inside(parameters.box, nodes.point(i)[0], nodes.point(i)[1]))
        is_in[nodes.block_of_node(i)] = 1;
    reduce(is_in, nodes.communicator());
    for (unsigned int b = 0; b < is_in.size(); ++b)
    {
      if (is_in[b])
        continue;
      const dealii::Point<2> first = point_of_block(nodes, b);
      std::ostringstream message;
      message << "section 'Contact': " << text(parameters.box)
              << ", but before anything moves the block at (" << first[0]
              << ", " << first[1]
              << ") m is outside. Give a box around the whole model, in "
                 "metres.";
      throw InputError(message.str());
    }
  }

  std::vector<BlockOutside>
  ModelBox::find_outside(State<2> &state, const std::vector<bool> &moved) const
  {
    using Outside               = ContactParameters::Outside;
    const MPI_Comm communicator = model.nodes().communicator();
    const unsigned int n        = model.nodes().table().n_blocks();
    const bool removes          = parameters.outside == Outside::remove;
    auto &marks                 = state.block_marks;
    marks.resize(n, 0);

    // A block may lie on several ranks. A block that is only reported may be
    // removed later.
    std::vector<std::uint8_t> inside(n, 0), held(n, 0), outside(n), stays(n);
    const NodeMap<2> &nodes = model.nodes();
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      if (const NodeRecord<2> &node = state.nodes[i]; is_inside(
              parameters.box, node.X[0] + node.u[0], node.X[1] + node.u[1]))
        inside[nodes.block_of_node(i)] = 1;
    for (unsigned int i = 0; i < nodes.blocks().parts.size(); ++i)
      held[nodes.blocks().parts[i].number] = moved[i];
    reduce(inside, communicator);
    reduce(held, communicator);
    bool is_news = false;
    for (unsigned int b = 0; b < n; ++b)
    {
      outside[b] = !state.is_absent(b) && !inside[b];
      stays[b]   = !outside[b] || !removes || held[b];
      is_news |= outside[b] && (marks[b] == 0 || !stays[b]);
    }
    if (!is_news)
      return {};
    if (removes)
      spread_along_joints(stays, state);

    std::vector<BlockOutside> found;
    for (unsigned int b = 0; b < n; ++b)
      if (outside[b] && (marks[b] == 0 || !stays[b]))
      {
        found.push_back({ b, {}, {}, state.time, !stays[b] });
        marks[b] = stays[b] ? block_mark::left_box : block_mark::removed;
      }
    find_motions(found, state);
    if (parameters.outside == Outside::stop && !found.empty())
    {
      const BlockOutside &first = found.front();
      std::ostringstream message;
      message << "block " << first.block << ", now at (" << first.position[0]
              << ", " << first.position[1] << ") m, has left "
              << text(parameters.box) << " of the section 'Contact', found at "
              << "time " << state.time << " s, step " << state.step
              << ". If it may leave, make the box larger or set 'Outside the "
                 "box' to report or delete; if not, look at the last fields. "
                 "The last checkpoint is kept.";
      throw BlockLeftBox(message.str());
    }
    return found;
  }

  void ModelBox::spread_along_joints(std::vector<std::uint8_t> &stays,
                                     const State<2> &state) const
  {
    const MatchedJoints &joints = model.joints();
    std::vector<std::array<unsigned int, 2>> tied;
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
      if (!state.get<JointHistory>().handed_over[i])
        tied.push_back(
            model.nodes().faces().joints[joints.segments()[i].face].blocks);
    std::sort(tied.begin(), tied.end());
    tied.erase(std::unique(tied.begin(), tied.end()), tied.end());

    // A tie across ranks is known to both.
    unsigned int changed = 1;
    while (changed)
    {
      changed = 0;
      for (const auto &[a, b] : tied)
        if (stays[a] != stays[b])
          stays[a] = stays[b] = changed = 1;
      changed
          = dealii::Utilities::MPI::max(changed, model.nodes().communicator());
      if (changed)
        reduce(stays, model.nodes().communicator());
    }
  }

  void ModelBox::find_motions(std::vector<BlockOutside> &found,
                              const State<2> &state) const
  {
    // Positions, velocities and how many nodes there are.
    std::vector<double> sums(4 * found.size(), 0.);
    std::vector<unsigned int> n_nodes(found.size(), 0);
    for (unsigned int k = 0; k < found.size(); ++k)
      for (const unsigned int i : owned_nodes(model, found[k].block))
      {
        add_to_vector(sums, 2 * k, state.nodes[i].position());
        add_to_vector(sums, 2 * k + 1, state.velocity[i]);
        ++n_nodes[k];
      }
    dealii::Utilities::MPI::sum(sums, model.nodes().communicator(), sums);
    dealii::Utilities::MPI::sum(n_nodes, model.nodes().communicator(), n_nodes);
    for (unsigned int k = 0; k < found.size(); ++k)
    {
      found[k].position = vector_at(sums, 2 * k) / double(n_nodes[k]);
      found[k].velocity = vector_at(sums, 2 * k + 1) / double(n_nodes[k]);
    }
  }
} // namespace quoin
