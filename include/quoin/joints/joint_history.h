// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_history_h
#define quoin_joints_joint_history_h

#include <quoin/base/node_record.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace quoin
{
  /** State of a joint point; the order is written to output. */
  enum class JointState : std::uint8_t
  {
    intact   = 0, /**< never failed */
    slipping = 1, /**< slip at the shear limit in this step */
    slipped  = 2, /**< failed earlier, closed and sticking now */
    open     = 3  /**< failed in tension or open now */
  };

  /**
   * Histories of the joint points, structure of arrays, one entry per point.
   * Tension and opening are positive; slip is positive when the upper side
   * moves along s = (n_y, -n_x), n the normal from the lower to the upper
   * side: to the right on a horizontal joint.
   */
  struct JointHistory
  {
    static constexpr const char *slice_name = "joints";
    static constexpr int dimension          = 2;

    AlignedArray<double> normal_traction; /**< [Pa] */
    AlignedArray<double> shear_traction;  /**< [Pa] */
    AlignedArray<double> plastic_slip;    /**< inelastic slip [m] */
    AlignedArray<double> plastic_opening; /**< dilation, offsets [m] */
    static constexpr unsigned int most_internal = 4;
    /** Internal variables of the laws; those that none has are empty. */
    std::array<AlignedArray<double>, most_internal> internal;
    AlignedArray<JointState> state;
    /** Whether each segment, two points, has become a general contact. */
    AlignedArray<std::uint8_t> handed_over;
    /** Slip and opening [m] that points had where a stage placed a block beside
        them, from which they count for laws, water and results; empty: none
        did. */
    AlignedArray<double> placed_slip, placed_opening;
    /** Plastic slip that stands for a traction, of the initial stress or of
        another stiffness, and is none that the point has done [m]; empty: there
        is none. */
    AlignedArray<double> elastic_origin;

    /** For @p n points with @p n_internal internal variables. */
    void resize(const std::size_t n, const unsigned int n_internal = 0)
    {
      for (unsigned int i = 0; i < n_internal; ++i)
        internal[i].resize(n, 0.);
      normal_traction.resize(n, 0.);
      shear_traction.resize(n, 0.);
      plastic_slip.resize(n, 0.);
      plastic_opening.resize(n, 0.);
      state.resize(n, JointState::intact);
      handed_over.resize(n / 2, 0);
    }

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      // Each segment has two points.
      visitor.own(normal_traction, 2);
      visitor.own(shear_traction, 2);
      visitor.own(plastic_slip, 2);
      visitor.own(plastic_opening, 2);
      for (AlignedArray<double> &variable : internal)
        visitor.own(variable, 2);
      visitor.own(state, 2);
      visitor.own(handed_over);
      visitor.own(placed_slip, 2);
      visitor.own(placed_opening, 2);
      visitor.own(elastic_origin, 2);
    }
  };
} // namespace quoin

#endif
