// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/implicit_state.h>
#include <quoin/implicit/motion_prediction.h>

#include <cmath>

namespace quoin
{
  template <int dim>
  MotionPrediction<dim>::MotionPrediction(const Model<dim> &model,
                                          DofMap<dim> &dof_map)
    : model(model), dof_map(dof_map), held(dim * model.nodes().n_owned(), false)
  {
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        held[dim * i + d] = !dof_map.is_free(i, d) && !dof_map.is_in_body(i);
    for (const RigidBody<dim> &body : dof_map.bodies())
      for (const unsigned int node : body.nodes)
        for (unsigned int d = 0; d < dim; ++d)
          held[dim * node + d] = body.given[d];
  }

  template <int dim>
  void MotionPrediction<dim>::remember(const Configuration<dim> &from,
                                       const Configuration<dim> &to,
                                       const Balance<dim> &start,
                                       const Balance<dim> &end,
                                       const double went,
                                       ImplicitState &now) const
  {
    now.moved_for = went;
    now.moved.clear();
    now.held_by.clear();
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        now.moved.push_back(to.nodes[i].u[d] - from.nodes[i].u[d]);
        now.held_by.push_back(
            held[dim * i + d] ? end.force[i][d] - start.force[i][d] : 0.);
      }
    BodyValues<dim> turns = to.bodies;
    for (unsigned int b = 0; b < turns.size(); ++b)
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        turns[b][d] -= from.bodies[b][d];
    keep_values(dof_map.bodies(), turns, model.rigid_blocks().n_blocks(),
                now.moved_platens, now.moved_blocks);
  }

  template <int dim>
  void MotionPrediction<dim>::move(const ImplicitState &now, const double share,
                                   const double load_time, DofVector &motion,
                                   Configuration<dim> &configuration) const
  {
    motion = 0.;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (dof_map.is_free(i, d))
          motion(dof_map.dof(i, d)) = now.moved[std::size_t(dim) * i + d];
    for (unsigned int b = 0; b < dof_map.bodies().size(); ++b)
    {
      const RigidBody<dim> &body = dof_map.bodies()[b];
      const auto moved = kept_values(dof_map.bodies(), b, now.moved_platens,
                                     now.moved_blocks);
      for (unsigned int d = 0; body.counts && d < n_body_motions<dim>; ++d)
        if (!body.given[d])
          motion(body.first + d) = moved[d];
    }
    motion.compress(dealii::VectorOperation::insert);
    dof_map.move(motion, share, load_time, configuration);
  }

  template <int dim>
  double MotionPrediction<dim>::error_of_reactions(
      const ImplicitState &now, const double share, const Balance<dim> &start,
      const Balance<dim> &predicted) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (held[dim * i + d])
          sum += std::abs(predicted.force[i][d] - start.force[i][d]
                          - share * now.held_by[std::size_t(dim) * i + d]);
    sum = dealii::Utilities::MPI::sum(sum, model.nodes().communicator());
    return predicted.applied > 0. ? sum / predicted.applied : 0.;
  }

  template class MotionPrediction<2>;
  template class MotionPrediction<3>;
} // namespace quoin
