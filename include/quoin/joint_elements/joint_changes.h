// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_joint_changes_h
#define quoin_joint_elements_joint_changes_h

#include <quoin/joint_elements/matched_joints.h>
#include <quoin/joint_elements/space_joints.h>

#include <array>

// How joints begin, under stress, and how they change between stages: where
// blocks are taken away or placed, or follow other laws.

namespace quoin
{
  /** Stress for each point of a joint face [Pa]: xx, yy, xy, or xx, yy, zz,
      xy, xz, yz. */
  template <int dim>
  using JointFaceStress
      = std::array<std::array<double, dim *(dim + 1) / 2>, dim>;

  /** Sets the tractions that balance an initial stress at rest; @p face_stress
      has an entry for each of LocalFaces::joints. */
  void initialise_joints(const MatchedJoints &joints,
                         const std::vector<JointFaceStress<2>> &face_stress,
                         State<2> &state);
  void initialise_joints(const SpaceJoints &joints,
                         const std::vector<JointFaceStress<3>> &face_stress,
                         State<3> &state);

  /** Adds @p share to n[0] if @p point has lost its bond although it would
      hold with it now, and to n[1] if @p law has one; see JointLawDefaults. */
  template <typename Law, typename Point>
  void count_bond(const Law &law, const Point &point, const double share,
                  std::array<double, 2> &n)
  {
    n[0] += law.lost_its_bond(point) ? share : 0.;
    n[1] += law.behaviour().has_bond ? share : 0.;
  }
  /** The numbers of count_bond() over the points of all ranks. */
  std::array<double, 2> n_without_bond(const MatchedJoints &joints,
                                       const JointHistory &history,
                                       MPI_Comm communicator);
  std::array<double, 2> n_without_bond(const SpaceJoints &joints,
                                       const SpaceJointHistory &history,
                                       MPI_Comm communicator);

  /** Points, of all ranks, whose tractions exceed their strength. */
  double n_beyond_strength(const MatchedJoints &joints,
                           const JointHistory &history, MPI_Comm communicator);
  double n_beyond_strength(const SpaceJoints &joints,
                           const SpaceJointHistory &history,
                           MPI_Comm communicator);

  /** Adds the forces [N] of face @p i by its tractions in @p state. */
  void add_traction_forces(const MatchedJoints &joints, unsigned int i,
                           const State<2> &state, dealii::Tensor<1, 2> *force);
  void add_traction_forces(const SpaceJoints &joints, unsigned int i,
                           const State<3> &state, dealii::Tensor<1, 3> *force);

  /** The force [N] on the upper side of face @p i by its tractions. */
  dealii::Tensor<1, 3> force_on_upper(const SpaceJoints &joints, unsigned int i,
                                      const State<3> &state);

  /** Face @p i is no joint from now on: a side of it is not there. */
  void detach_joint(unsigned int i, JointHistory &history);
  void detach_joint(unsigned int i, SpaceJointHistory &history);

  /** Points count slips and openings from where begin_joint_anew() puts them,
      others from the mesh; before that, on all ranks. */
  void count_from_placing(const MatchedJoints &joints, JointHistory &history);
  void count_from_placing(const SpaceJoints &joints,
                          SpaceJointHistory &history);

  /** joint_gaps() of face @p i as results, laws and water count them: from
      where a stage placed a block beside it, if it did; those of the two faces
      that met where the joint has become a general contact. */
  std::array<std::array<double, 2>, 2>
  gaps_since_placing(const MatchedJoints &joints, unsigned int i,
                     const State<2> &state);
  std::array<SpaceJointGap, 3> gaps_since_placing(const SpaceJoints &joints,
                                                  unsigned int i,
                                                  const State<3> &state);

  /** Face @p i is an intact joint, free of traction where it is now. */
  void begin_joint_anew(const MatchedJoints &joints, unsigned int i,
                        State<2> &state);
  void begin_joint_anew(const SpaceJoints &joints, unsigned int i,
                        State<3> &state);

  /**
   * Inelastic opening and slip become those with which the tractions that
   * @p state has are those of the laws at its gaps.
   */
  void keep_joint_tractions(const MatchedJoints &joints, State<2> &state);
  void keep_joint_tractions(const SpaceJoints &joints, State<3> &state);

  /** The joint faces of a rank, which both kinds of joints number alike. */
  inline const std::vector<JointSegment> &
  joint_faces(const MatchedJoints &joints)
  {
    return joints.segments();
  }
  inline const std::vector<SpaceJointFace> &
  joint_faces(const SpaceJoints &joints)
  {
    return joints.faces();
  }
} // namespace quoin

#endif
