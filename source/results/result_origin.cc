// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/model/block_placement.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  namespace
  {
    void count_joints_from(const Model<2> &model, const ResultReset &reset,
                           State<2> &state)
    {
      ResultOrigin<2> &origin     = state.get<ResultOrigin<2>>();
      const JointHistory &history = state.get<JointHistory>();
      const auto &segments        = model.joints().segments();
      if (reset.slips)
        origin.slip.resize(2 * segments.size());
      for (unsigned int p = 0; p < origin.slip.size(); ++p)
        if (is_at_absent_block(model, p / 2, state))
          origin.slip[p] = 0.;
        else if (reset.slips)
          origin.slip[p]
              = joint_gaps(segments[p / 2], state.nodes.data())[p % 2][1];

      if (reset.joint_states)
        origin.has_failed.assign(history.state.size(), 0);
      for (unsigned int p = 0; p < origin.has_failed.size(); ++p)
        if (history.state[p] == JointState::intact)
          origin.has_failed[p] = 1;
    }
  } // namespace

  template <>
  void note_failed_joints(State<2> &state)
  {
    AlignedArray<std::uint8_t> &has_failed
        = state.get<ResultOrigin<2>>().has_failed;
    const AlignedArray<JointState> &now = state.get<JointHistory>().state;
    for (unsigned int p = 0; p < has_failed.size(); ++p)
      if (now[p] == JointState::slipping || now[p] == JointState::open)
        has_failed[p] = 1;
  }

  template <>
  void note_failed_joints(State<3> &)
  {
  }

  template <int dim>
  void count_from(const Model<dim> &model, const ResultReset &reset,
                  State<dim> &state)
  {
    auto &displacement = state.template get<ResultOrigin<dim>>().displacement;
    if (reset.displacements)
      displacement.resize(state.nodes.size());
    const std::vector<bool> is_absent = absent_nodes(model, state);
    for (unsigned int i = 0; i < displacement.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (is_absent[i])
          displacement[i].v[d] = 0.;
        else if (reset.displacements)
          displacement[i].v[d] = state.nodes[i].u[d];
    if constexpr (dim == 2)
      count_joints_from(model, reset, state);
  }

  JointState state_since_origin(const State<2> &state, const unsigned int p)
  {
    const JointState now = state.get<JointHistory>().state[p];
    const auto *origin   = state.find<ResultOrigin<2>>();
    return now == JointState::slipped && origin && !origin->has_failed.empty()
                   && !origin->has_failed[p]
               ? JointState::intact
               : now;
  }

  template void count_from(const Model<2> &, const ResultReset &, State<2> &);
  template void count_from(const Model<3> &, const ResultReset &, State<3> &);
} // namespace quoin
