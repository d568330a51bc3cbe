// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/model/block_placement.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  namespace
  {
    /** Whether the joint point @p p has failed after the origin, if it is not
        intact. */
    bool has_failed(const ResultOrigin<2> &origin, const JointHistory &history,
                    const unsigned int p)
    {
      return origin.is_since[p]
             || history.plastic_slip[p] != origin.plastic_slip[p]
             || history.plastic_opening[p] != origin.plastic_opening[p];
    }

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
        origin.is_since.assign(2 * segments.size(), 0);
      if (origin.is_since.empty())
        return;
      origin.plastic_slip    = history.plastic_slip;
      origin.plastic_opening = history.plastic_opening;
      for (unsigned int p = 0; p < origin.is_since.size(); ++p)
        if (history.state[p] == JointState::intact)
          origin.is_since[p] = 1;
    }
  } // namespace

  template <>
  void note_failed_joints(State<2> &state)
  {
    ResultOrigin<2> &origin     = state.get<ResultOrigin<2>>();
    const JointHistory &history = state.get<JointHistory>();
    for (unsigned int p = 0; p < origin.is_since.size(); ++p)
      origin.is_since[p] = has_failed(origin, history, p);
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
    const JointHistory &history = state.get<JointHistory>();
    const auto *origin          = state.find<ResultOrigin<2>>();
    if (!origin || origin->is_since.empty()
        || history.state[p] != JointState::slipped
        || has_failed(*origin, history, p))
      return history.state[p];
    return JointState::intact;
  }

  template void count_from(const Model<2> &, const ResultReset &, State<2> &);
  template void count_from(const Model<3> &, const ResultReset &, State<3> &);
} // namespace quoin
