// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/joint_changes.h>
#include <quoin/model/block_placement.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  namespace
  {
    template <int dim>
    void count_joints_from(const Model<dim> &model, const ResultReset &reset,
                           State<dim> &state)
    {
      ResultOrigin<dim> &origin = state.template get<ResultOrigin<dim>>();
      const auto &history       = state.template get<JointHistoryOf<dim>>();
      const auto &faces         = joint_faces(model.joints());
      constexpr unsigned int n  = dim * (dim - 1); // components of a face
      if (reset.slips)
        origin.slip.resize(n * faces.size());
      for (unsigned int c = 0; c < origin.slip.size(); ++c)
        if (is_at_absent_block(model, c / n, state))
          origin.slip[c] = 0.;
        else if (reset.slips)
          origin.slip[c]
              = gaps_since_placing(model.joints(), c / n,
                                   state)[c % n / (dim - 1)][1 + c % (dim - 1)];

      if (reset.joint_states)
        origin.has_failed.assign(history.state.size(), 0);
      for (unsigned int p = 0; p < origin.has_failed.size(); ++p)
        if (history.state[p] == JointState::intact)
          origin.has_failed[p] = 1;
    }
  } // namespace

  template <int dim>
  void note_failed_joints(State<dim> &state)
  {
    AlignedArray<std::uint8_t> &has_failed
        = state.template get<ResultOrigin<dim>>().has_failed;
    const AlignedArray<JointState> &now
        = state.template get<JointHistoryOf<dim>>().state;
    // Without a branch, so that compilers find vectors.
    for (std::size_t p = 0; p < has_failed.size(); ++p)
      has_failed[p] |= std::uint8_t(now[p] == JointState::slipping)
                       | std::uint8_t(now[p] == JointState::open);
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
          displacement[i][d] = 0.;
        else if (reset.displacements)
          displacement[i][d] = state.nodes[i].u[d];
    count_joints_from(model, reset, state);
  }

  template <int dim>
  JointState state_since_origin(const State<dim> &state, const unsigned int p)
  {
    const JointState now = state.template get<JointHistoryOf<dim>>().state[p];
    const auto *origin   = state.template find<ResultOrigin<dim>>();
    return now == JointState::slipped && origin && !origin->has_failed.empty()
                   && !origin->has_failed[p]
               ? JointState::intact
               : now;
  }

  template void note_failed_joints(State<2> &);
  template void note_failed_joints(State<3> &);
  template JointState state_since_origin(const State<2> &, unsigned int);
  template JointState state_since_origin(const State<3> &, unsigned int);
  template void count_from(const Model<2> &, const ResultReset &, State<2> &);
  template void count_from(const Model<3> &, const ResultReset &, State<3> &);
} // namespace quoin
