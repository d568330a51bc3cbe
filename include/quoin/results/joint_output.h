// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_joint_output_h
#define quoin_results_joint_output_h

#include <quoin/joints/joint_history.h>
#include <quoin/output/field_series.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * The joint faces of this rank at an output time. Face f has the points 2 f
   * and 2 f + 1; all but the last array have one entry for each point. Opening
   * and tension are positive; slip is positive when the upper side moves to the
   * right on a horizontal joint (matched_joints.h).
   */
  struct JointFields
  {
    std::vector<dealii::Point<2>> position; /**< reference [m] */
    /** mean displacement of both sides [m] */
    std::vector<dealii::Tensor<1, 2>> displacement;
    /** Displacement before the last reset; may be empty [m]. */
    std::vector<dealii::Tensor<1, 2>> earlier_displacement;
    std::vector<double> opening; /**< [m] */
    std::vector<double> slip;    /**< [m] */
    /** Slip before the last reset; empty: none [m]. */
    std::vector<double> earlier_slip;
    std::vector<double> normal_traction; /**< [Pa] */
    std::vector<double> shear_traction;  /**< [Pa] */
    /** Fields of the joint laws, by name: JointField. */
    std::vector<std::pair<std::string, std::vector<double>>> of_laws;
    std::vector<JointState> state;
    std::vector<std::int32_t> joint_set; /**< joint set of each face */
    /** Flag of each face that is a general contact now, or was a face of a
     * joint before. */
    std::vector<std::uint8_t> handed_over;
  };

  /** JointFields of faces in three dimensions: face f has the points 3 f to
      3 f + 2, slips and shear tractions are vectors in the fixed axes. */
  struct SpaceJointFields
  {
    using Vector = dealii::Tensor<1, 3>;

    std::vector<dealii::Point<3>> position; /**< reference [m] */
    /** mean displacement of both sides [m] */
    std::vector<Vector> displacement;
    /** Displacement before the last reset; may be empty [m]. */
    std::vector<Vector> earlier_displacement;
    std::vector<double> opening; /**< [m] */
    std::vector<Vector> slip;    /**< of the upper by the lower side [m] */
    /** Slip before the last reset; empty: none [m]. */
    std::vector<Vector> earlier_slip;
    std::vector<double> normal_traction; /**< [Pa] */
    std::vector<Vector> shear_traction;  /**< on the lower side [Pa] */
    /** Fields of the joint laws, by name: JointField. */
    std::vector<std::pair<std::string, std::vector<double>>> of_laws;
    std::vector<JointState> state;
    // One entry for each face.
    std::vector<std::int32_t> joint_set;
    std::vector<Vector> normal; /**< from the lower to the upper side */
    std::vector<double> area;   /**< in the mesh [m^2] */
  };

  /**
   * The state shown for a face whose points are in the states @p a and @p b:
   * open before slipping before slipped before intact.
   */
  JointState worst(const JointState a, const JointState b);

  /**
   * The series joints.pvd: a line, or triangle, for each joint face, in the
   * middle of the current positions of its two sides. The displacement of that
   * middle is point data and gives the reference position, see BlockOutput.
   */
  class JointOutput : public FieldSeries
  {
  public:
    /** @p name of the series: joints, or contacts. */
    JointOutput(const std::string &output_directory,
                const MPI_Comm communicator, const std::string &name = "joints",
                const FieldFormat format = FieldFormat::vtu);

    /** Collective. Writes the fields of the time @p time [s]. */
    void write(const double time, const JointFields &fields);
    void write(const double time, const SpaceJointFields &fields);
  };
} // namespace quoin

#endif
