// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_space_joint_history_h
#define quoin_joint_elements_space_joint_history_h

#include <quoin/joints/joint_history.h>

#include <array>
#include <type_traits>

namespace quoin
{
  /**
   * What JointHistory is in two dimensions: histories of the points of
   * SpaceJoints, three of each face. Shear tractions and slips have two
   * components, along the tangents of the face.
   */
  struct SpaceJointHistory
  {
    static constexpr const char *slice_name = "joints in space";
    static constexpr int dimension          = 3;

    AlignedArray<double> normal_traction; /**< [Pa] */
    AlignedArray<double> shear_traction;  /**< two of each point [Pa] */
    AlignedArray<double> plastic_slip;    /**< two of each point [m] */
    AlignedArray<double> plastic_opening; /**< dilation, offsets [m] */
    /** Internal variables of the laws; those that none has are empty. */
    std::array<AlignedArray<double>, JointHistory::most_internal> internal;
    AlignedArray<JointState> state;
    /** Whether each face is no joint, because a side of it is not there. */
    AlignedArray<std::uint8_t> detached;
    /** Slips, two of each, and openings [m] that points had where a stage
        placed a block beside them, from which they count for laws and results;
        empty: none did. */
    AlignedArray<double> placed_slip, placed_opening;
    /** As JointHistory::elastic_origin, two of each [m]. */
    AlignedArray<double> elastic_origin;

    /** For @p n_faces with @p n_internal internal variables. */
    void resize(const std::size_t n_faces, const unsigned int n_internal = 0)
    {
      const std::size_t n = 3 * n_faces;
      detached.resize(n_faces, 0);
      for (unsigned int i = 0; i < n_internal; ++i)
        internal[i].resize(n, 0.);
      normal_traction.resize(n, 0.);
      shear_traction.resize(2 * n, 0.);
      plastic_slip.resize(2 * n, 0.);
      plastic_opening.resize(n, 0.);
      state.resize(n, JointState::intact);
    }

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.own(normal_traction, 3);
      visitor.own(shear_traction, 6);
      visitor.own(plastic_slip, 6);
      visitor.own(plastic_opening, 3);
      for (AlignedArray<double> &variable : internal)
        visitor.own(variable, 3);
      visitor.own(state, 3);
      visitor.own(detached);
      visitor.own(placed_slip, 6);
      visitor.own(placed_opening, 3);
      visitor.own(elastic_origin, 6);
    }
  };

  /** The history of the joints of a model. */
  template <int dim>
  using JointHistoryOf
      = std::conditional_t<dim == 2, JointHistory, SpaceJointHistory>;
} // namespace quoin

#endif
