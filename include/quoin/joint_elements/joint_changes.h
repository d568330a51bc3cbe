// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_joint_changes_h
#define quoin_joint_elements_joint_changes_h

#include <quoin/joint_elements/matched_joints.h>

// How joints begin, under stress, and how they change between stages: where
// blocks are taken away or placed, or follow other laws.

namespace quoin
{
  /** Stress xx, yy, xy [Pa] for both points of a joint face. */
  using JointFaceStress = std::array<std::array<double, 3>, 2>;

  /** Sets the tractions that balance an initial stress at rest; @p face_stress
      has an entry for each of LocalFaces::joints. */
  void initialise_joints(const MatchedJoints &joints,
                         const std::vector<JointFaceStress> &face_stress,
                         State<2> &state);

  /** Points, of all ranks, whose tractions exceed their strength. */
  double n_beyond_strength(const MatchedJoints &joints,
                           const JointHistory &history, MPI_Comm communicator);

  /** Adds the forces [N] of segment @p i by its tractions in @p state. */
  void add_traction_forces(const MatchedJoints &joints, unsigned int i,
                           const State<2> &state, NodeVector<2> *force);

  /** Segment @p i is no joint from now on: a side of it is not there. */
  void detach_joint(unsigned int i, JointHistory &history);

  /** Segment @p i is an intact joint, free of traction where it is now. */
  void begin_joint_anew(const MatchedJoints &joints, unsigned int i,
                        State<2> &state);

  /**
   * Inelastic opening and slip become those with which the tractions that
   * @p state has are those of the laws at its gaps.
   */
  void keep_joint_tractions(const MatchedJoints &joints, State<2> &state);
} // namespace quoin

#endif
