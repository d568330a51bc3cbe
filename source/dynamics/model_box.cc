// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/model_box.h>

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

    /** The largest of all ranks, entry by entry. */
    void reduce(std::vector<std::uint8_t> &flags, const MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE, flags.data(), flags.size(), MPI_UINT8_T,
                    MPI_MAX, communicator);
    }
  } // namespace

  ModelBox::ModelBox(const Model &model)
    : model(model), parameters(model.contact_parameters())
  {
    if (!is_given())
      return;
    const NodeMap<2> &nodes = model.nodes();
    std::vector<std::uint8_t> is_in(model.table().n_blocks(), 0);
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      if (is_inside(parameters.box, nodes.point(i)[0], nodes.point(i)[1]))
        is_in[nodes.block_of_node(i)] = 1;
    reduce(is_in, nodes.communicator());
    for (unsigned int b = 0; b < is_in.size(); ++b)
    {
      if (is_in[b])
        continue;
      const dealii::Point<2> first = nodes.point_of_block(b);
      std::ostringstream message;
      message << "section 'Contact': " << text(parameters.box)
              << ", but before anything moves the block at (" << first[0]
              << ", " << first[1]
              << ") m is outside. Give a box around the whole model, in "
                 "metres.";
      throw InputError(message.str());
    }
  }

  bool ModelBox::is_outside(const unsigned int block,
                            const State<2> &state) const
  {
    const NodeRange range = model.block_nodes(block);
    return std::none_of(
        &state.nodes[range.begin], &state.nodes[range.begin] + range.size(),
        [&](const NodeRecord<2> &node)
        {
          return is_inside(parameters.box, node.X[0] + node.u[0],
                           node.X[1] + node.u[1]);
        });
  }

  std::vector<BlockOutside> ModelBox::look(State<2> &state,
                                           const std::vector<bool> &moved) const
  {
    using Outside               = ContactParameters::Outside;
    const MPI_Comm communicator = model.exchange().communicator();
    const unsigned int n        = model.table().n_blocks();
    const bool removes          = parameters.outside == Outside::remove;
    auto &marks                 = state.block_marks;
    marks.resize(n, 0);

    // Blocks that are reported may be free to go only later.
    std::vector<std::uint8_t> outside(n, 0), stays(n, 0);
    bool is_news      = false;
    const auto &parts = model.nodes().block_parts();
    for (unsigned int i = 0; i < parts.size(); ++i)
    {
      const unsigned int b = parts[i].number;
      outside[b]           = !state.is_absent(b) && is_outside(b, state);
      stays[b]             = !outside[b] || !removes || moved[i];
      is_news |= outside[b] && (marks[b] == 0 || !stays[b]);
    }
    if (dealii::Utilities::MPI::max(is_news ? 1U : 0U, communicator) == 0)
      return {};
    reduce(outside, communicator);
    reduce(stays, communicator);
    if (removes)
      spread_along_joints(stays, state);

    std::vector<BlockOutside> found;
    for (unsigned int b = 0; b < n; ++b)
      if (outside[b] && (marks[b] == 0 || !stays[b]))
      {
        found.push_back({ b, { { 0., 0. } }, state.time, !stays[b] });
        marks[b] = stays[b] ? block_mark::left_box : block_mark::removed;
      }
    find_positions(found, state);
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
      throw ModelFailure(message.str());
    }
    return found;
  }

  void ModelBox::spread_along_joints(std::vector<std::uint8_t> &stays,
                                     const State<2> &state) const
  {
    const MatchedJoints &joints = model.joints();
    std::vector<std::array<unsigned int, 2>> tied;
    for (unsigned int i = 0; i < joints.n_segments(); ++i)
      if (!state.get<JointHistory>().handed_over[i])
        tied.push_back(
            model.nodes().joint_faces()[joints.segment(i).face].blocks);
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
      changed = dealii::Utilities::MPI::max(changed,
                                            model.exchange().communicator());
      if (changed)
        reduce(stays, model.exchange().communicator());
    }
  }

  void ModelBox::find_positions(std::vector<BlockOutside> &found,
                                const State<2> &state) const
  {
    std::vector<double> sums(2 * found.size(), 0.);
    for (unsigned int k = 0; k < found.size(); ++k)
    {
      const NodeRange range = model.block_nodes(found[k].block);
      for (std::size_t i = range.begin; i < range.end; ++i)
        for (unsigned int d = 0; d < 2; ++d)
          sums[2 * k + d]
              += (state.nodes[i].X[d] + state.nodes[i].u[d]) / range.size();
    }
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM,
                  model.exchange().communicator());
    for (unsigned int k = 0; k < found.size(); ++k)
      found[k].position = { { sums[2 * k], sums[2 * k + 1] } };
  }
} // namespace quoin
