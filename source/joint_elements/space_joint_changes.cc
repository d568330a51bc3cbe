// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// joint_changes.h in three dimensions.

#include <quoin/joint_elements/joint_changes.h>

#include <deal.II/base/mpi.h>

#include "space_face.h"

namespace quoin
{
  namespace
  {
    /** Slip along the tangents of a face. */
    Slip<3> slip_of(const SpaceJointGap &gap)
    {
      Slip<3> slip;
      slip[0] = gap[1];
      slip[1] = gap[2];
      return slip;
    }
  } // namespace

  void initialise_joints(const SpaceJoints &joints,
                         const std::vector<JointFaceStress<3>> &face_stress,
                         State<3> &state)
  {
    SpaceJointHistory &history = state.get<SpaceJointHistory>();
    for (unsigned int i = 0; i < joints.faces().size(); ++i)
    {
      const SpaceJointFace &face  = joints.faces()[i];
      const SpaceJointFrame frame = joint_frame(face, state.nodes.data());
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto &[xx, yy, zz, xy, xz, yz] = face_stress[face.face][k];
        const Vector traction(
            { xx * frame.n[0] + xy * frame.n[1] + xz * frame.n[2],
              xy * frame.n[0] + yy * frame.n[1] + yz * frame.n[2],
              xz * frame.n[0] + yz * frame.n[1] + zz * frame.n[2] });
        const SpaceJointGap parts = components(frame, traction);
        std::visit(
            [&](const auto &law)
            {
              auto point = read_point(law, history, 3 * i + k);
              law.initialise(point, parts[0], slip_of(parts));
              move_elastic_origin(point.plastic_slip, joints.n_points(),
                                  history, 3 * i + k);
              write_point(point, history, 3 * i + k);
            },
            joints.laws()[face.set]);
      }
    }
  }

  std::array<double, 2> n_without_bond(const SpaceJoints &joints,
                                       const SpaceJointHistory &history,
                                       const MPI_Comm communicator)
  {
    std::array<double, 2> n{};
    for (unsigned int p = 0; p < joints.n_points(); ++p)
    {
      const SpaceJointFace &face = joints.faces()[p / 3];
      std::visit(
          [&](const auto &law)
          { count_bond(law, read_point(law, history, p), face.share, n); },
          joints.laws()[face.set]);
    }
    return { dealii::Utilities::MPI::sum(n[0], communicator),
             dealii::Utilities::MPI::sum(n[1], communicator) };
  }

  double n_beyond_strength(const SpaceJoints &joints,
                           const SpaceJointHistory &history,
                           const MPI_Comm communicator)
  {
    double n = 0.;
    for (unsigned int p = 0; p < joints.n_points(); ++p)
      std::visit(
          [&](const auto &law)
          {
            if (!law.holds(read_point(law, history, p)))
              n += joints.faces()[p / 3].share;
          },
          joints.laws()[joints.faces()[p / 3].set]);
    return dealii::Utilities::MPI::sum(n, communicator);
  }

  void add_traction_forces(const SpaceJoints &joints, const unsigned int i,
                           const State<3> &state, dealii::Tensor<1, 3> *force)
  {
    const SpaceJointHistory &history = state.get<SpaceJointHistory>();
    const SpaceJointFace &face       = joints.faces()[i];
    const SpaceJointFrame frame      = joint_frame(face, state.nodes.data());
    add_face_forces(
        face, frame, state.nodes.data(),
        [&](const unsigned int k, const Vector &)
        {
          const unsigned int p = 3 * i + k;
          Slip<3> shear;
          shear[0] = history.shear_traction[2 * p];
          shear[1] = history.shear_traction[2 * p + 1];
          return face.area
                 * traction_vector(frame, history.normal_traction[p], shear);
        },
        force);
  }

  Vector force_on_upper(const SpaceJoints &joints, const unsigned int i,
                        const State<3> &state)
  {
    const SpaceJointHistory &history = state.get<SpaceJointHistory>();
    const SpaceJointFace &face       = joints.faces()[i];
    const SpaceJointFrame frame      = joint_frame(face, state.nodes.data());
    Vector result;
    for (unsigned int p = 3 * i; p < 3 * i + 3; ++p)
    {
      Slip<3> shear;
      shear[0] = history.shear_traction[2 * p];
      shear[1] = history.shear_traction[2 * p + 1];
      result -= face.area
                * traction_vector(frame, history.normal_traction[p], shear);
    }
    return result;
  }

  void detach_joint(const unsigned int i, SpaceJointHistory &history)
  {
    history.detached[i] = 1;
    for (unsigned int p = 3 * i; p < 3 * i + 3; ++p)
    {
      history.normal_traction[p]        = 0.;
      history.shear_traction[2 * p]     = 0.;
      history.shear_traction[2 * p + 1] = 0.;
      history.state[p]                  = JointState::open;
    }
  }

  void begin_joint_anew(const SpaceJoints &joints, const unsigned int i,
                        State<3> &state)
  {
    const SpaceJointFace &face = joints.faces()[i];
    SpaceJointHistory &history = state.get<SpaceJointHistory>();
    history.detached[i]        = 0;
    const auto gaps            = joint_gaps(face, state.nodes.data());
    std::visit(
        [&](const auto &law)
        {
          for (unsigned int k = 0; k < 3; ++k)
          {
            PointOf<decltype(law), 3> point;
            point.plastic_opening             = gaps[k][0];
            history.placed_opening[3 * i + k] = gaps[k][0];
            set_slip<3>(history.placed_slip, 3 * i + k, slip_of(gaps[k]));
            if (!history.elastic_origin.empty())
              set_slip<3>(history.elastic_origin, 3 * i + k, Slip<3>());
            write_point(point, history, 3 * i + k);
          }
        },
        joints.laws()[face.set]);
  }

  void count_from_placing(const SpaceJoints &joints, SpaceJointHistory &history)
  {
    history.placed_slip.resize(2 * joints.n_points(), 0.);
    history.placed_opening.resize(joints.n_points(), 0.);
  }

  std::array<SpaceJointGap, 3> gaps_since_placing(const SpaceJoints &joints,
                                                  const unsigned int i,
                                                  const State<3> &state)
  {
    auto gaps = joint_gaps(joints.faces()[i], state.nodes.data());
    const SpaceJointHistory &history = state.get<SpaceJointHistory>();
    if (!history.placed_slip.empty())
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int p = 3 * i + k;
        gaps[k][0] -= history.placed_opening[p];
        for (const unsigned int d : { 0, 1 })
          gaps[k][1 + d] -= history.placed_slip[2 * p + d];
      }
    return gaps;
  }

  void keep_joint_tractions(const SpaceJoints &joints, State<3> &state)
  {
    SpaceJointHistory &history = state.get<SpaceJointHistory>();
    for (unsigned int i = 0; i < joints.faces().size(); ++i)
    {
      if (history.detached[i])
        continue;
      const auto gaps = joint_gaps(joints.faces()[i], state.nodes.data());
      std::visit(
          [&](const auto &law)
          {
            for (unsigned int k = 0; k < 3; ++k)
            {
              auto point = read_point(law, history, 3 * i + k);
              // What is open keeps what its opening counts from, unless it may
              // bear tension.
              if (point.state == JointState::open
                  && !std::decay_t<decltype(law)>::bridges)
                continue;
              auto at_rest      = point;
              const auto before = point.plastic_slip;
              law.initialise(at_rest, point.normal_traction,
                             point.shear_traction);
              point.normal_traction = at_rest.normal_traction;
              point.shear_traction  = at_rest.shear_traction;
              point.plastic_opening = at_rest.plastic_opening + gaps[k][0];
              point.plastic_slip
                  = at_rest.plastic_slip
                    + slip_since_placing(history, 3 * i + k, slip_of(gaps[k]));
              law.take_over(point);
              move_elastic_origin(point.plastic_slip - before,
                                  joints.n_points(), history, 3 * i + k);
              write_point(point, history, 3 * i + k);
            }
          },
          joints.laws()[joints.faces()[i].set]);
    }
  }
} // namespace quoin
