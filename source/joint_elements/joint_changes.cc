// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/joint_changes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include "joint_frame.h"
#include <quoin/joint_elements/joint_points.h>

namespace quoin
{
  namespace
  {
    /** Calls @p use with the law of @p segment, of its own type. */
    template <typename Use>
    void with_law(const MatchedJoints &joints, const JointSegment &segment,
                  const Use &use)
    {
      std::visit(use, joints.laws()[segment.set]);
    }

    /** keep_joint_tractions() of point @p p, with opening and slip @p gap. */
    template <typename Law>
    void keep_traction(const Law &law, const std::array<double, 2> &gap,
                       const std::size_t n_points, JointHistory &history,
                       const unsigned int p)
    {
      auto point = read_point(law, history, p);
      // What is open keeps what its opening counts from, unless it may bear
      // tension.
      if (point.state == JointState::open && !Law::bridges)
        return;
      auto at_rest      = point;
      const auto before = point.plastic_slip;
      law.initialise(at_rest, point.normal_traction, point.shear_traction);
      point.normal_traction = at_rest.normal_traction;
      point.shear_traction  = at_rest.shear_traction;
      point.plastic_opening = at_rest.plastic_opening + gap[0];
      point.plastic_slip
          = at_rest.plastic_slip + slip_since_placing(history, p, gap[1]);
      law.take_over(point);
      move_elastic_origin(point.plastic_slip - before, n_points, history, p);
      write_point(point, history, p);
    }
  } // namespace

  void initialise_joints(const MatchedJoints &joints,
                         const std::vector<JointFaceStress<2>> &face_stress,
                         State<2> &state)
  {
    JointHistory &history = state.get<JointHistory>();
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointSegment &segment   = joints.segments()[i];
      const JointFrame local        = joint_frame(segment, state.nodes.data());
      const dealii::Tensor<1, 2> &n = local.normal, &s = local.tangent;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const auto &[xx, yy, xy] = face_stress[segment.face][k];
        const dealii::Point<2> traction(xx * n[0] + xy * n[1],
                                        xy * n[0] + yy * n[1]);
        const double normal = traction * n, shear = traction * s;
        with_law(joints, segment,
                 [&](const auto &law)
                 {
                   auto point = read_point(law, history, 2 * i + k);
                   law.initialise(point, normal, shear);
                   move_elastic_origin(point.plastic_slip, joints.n_points(),
                                       history, 2 * i + k);
                   write_point(point, history, 2 * i + k);
                 });
      }
    }
  }

  std::array<double, 2> n_without_bond(const MatchedJoints &joints,
                                       const JointHistory &history,
                                       const MPI_Comm communicator)
  {
    std::array<double, 2> n{};
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
      with_law(joints, joints.segments()[i],
               [&](const auto &law)
               {
                 for (const unsigned int p : { 2 * i, 2 * i + 1 })
                   count_bond(law, read_point(law, history, p),
                              joints.segments()[i].share, n);
               });
    return { dealii::Utilities::MPI::sum(n[0], communicator),
             dealii::Utilities::MPI::sum(n[1], communicator) };
  }

  double n_beyond_strength(const MatchedJoints &joints,
                           const JointHistory &history,
                           const MPI_Comm communicator)
  {
    double n = 0.;
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
      with_law(joints, joints.segments()[i],
               [&](const auto &law)
               {
                 for (const unsigned int p : { 2 * i, 2 * i + 1 })
                   if (!law.holds(read_point(law, history, p)))
                     n += joints.segments()[i].share;
               });
    return dealii::Utilities::MPI::sum(n, communicator);
  }

  void add_traction_forces(const MatchedJoints &joints, const unsigned int i,
                           const State<2> &state, dealii::Tensor<1, 2> *force)
  {
    const JointHistory &history = state.get<JointHistory>();
    const JointSegment &segment = joints.segments()[i];
    const JointFrame local      = joint_frame(segment, state.nodes.data());
    double couple               = 0.;
    for (unsigned int k = 0; k < 2; ++k)
    {
      const auto [opening, slip]
          = joint_gap(segment, local, state.nodes.data(), k);
      const double sigma = segment.area[k] * history.normal_traction[2 * i + k];
      const double tau   = segment.area[k] * history.shear_traction[2 * i + k];
      couple += tau * opening - sigma * slip;
      const dealii::Tensor<1, 2> f = sigma * local.normal + tau * local.tangent;
      force[segment.lower[k]] += f;
      force[segment.upper[k]] -= f;
    }
    subtract_couple(segment, local, couple, force);
  }

  void detach_joint(const unsigned int i, JointHistory &history)
  {
    history.handed_over[i] = 1;
    for (const unsigned int p : { 2 * i, 2 * i + 1 })
    {
      history.normal_traction[p] = history.shear_traction[p] = 0.;
      history.state[p]                                       = JointState::open;
    }
  }

  void begin_joint_anew(const MatchedJoints &joints, const unsigned int i,
                        State<2> &state)
  {
    const JointSegment &segment = joints.segments()[i];
    JointHistory &history       = state.get<JointHistory>();
    history.handed_over[i]      = 0;
    const auto gap              = joint_gaps(segment, state.nodes.data());
    with_law(joints, segment,
             [&](const auto &law)
             {
               for (unsigned int k = 0; k < 2; ++k)
               {
                 const unsigned int p = 2 * i + k;
                 PointOf<decltype(law)> point;
                 point.plastic_opening     = gap[k][0];
                 history.placed_opening[p] = gap[k][0];
                 history.placed_slip[p]    = gap[k][1];
                 if (!history.elastic_origin.empty())
                   history.elastic_origin[p] = 0.;
                 write_point(point, history, p);
               }
             });
  }

  void count_from_placing(const MatchedJoints &joints, JointHistory &history)
  {
    history.placed_slip.resize(joints.n_points(), 0.);
    history.placed_opening.resize(joints.n_points(), 0.);
  }

  std::array<std::array<double, 2>, 2>
  gaps_since_placing(const MatchedJoints &joints, const unsigned int i,
                     const State<2> &state)
  {
    auto gaps = joint_gaps(joints.segments()[i], state.nodes.data());
    const JointHistory &history = state.get<JointHistory>();
    if (!history.placed_slip.empty() && !history.handed_over[i])
      for (unsigned int k = 0; k < 2; ++k)
      {
        gaps[k][0] -= history.placed_opening[2 * i + k];
        gaps[k][1] -= history.placed_slip[2 * i + k];
      }
    return gaps;
  }

  void keep_joint_tractions(const MatchedJoints &joints, State<2> &state)
  {
    JointHistory &history = state.get<JointHistory>();
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      if (history.handed_over[i])
        continue;
      const JointSegment &segment = joints.segments()[i];
      const auto gap              = joint_gaps(segment, state.nodes.data());
      with_law(joints, segment,
               [&](const auto &law)
               {
                 for (unsigned int k = 0; k < 2; ++k)
                   keep_traction(law, gap[k], joints.n_points(), history,
                                 2 * i + k);
               });
    }
  }
} // namespace quoin
