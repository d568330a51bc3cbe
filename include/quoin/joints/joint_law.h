// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_law_h
#define quoin_joints_joint_law_h

#include <quoin/joints/barton_bandis_law.h>
#include <quoin/joints/composite_law.h>
#include <quoin/joints/continuously_yielding_law.h>
#include <quoin/joints/coulomb_law.h>

#include <array>
#include <type_traits>
#include <variant>

namespace quoin
{
  /**
   * The law of a set of joints. Every law has
   *
   * - Point, what it reads and overwrites: JointPoint, CompositePoint or
   *   RockPoint, which also says what the joint remembers (JointHistory);
   * - update(point, opening, slip), with a JointTangent as fourth argument
   *   too, and, but for laws of rock joints, its parts update_elastic() and
   *   update_failing();
   * - stored_energy() and holds().
   *
   * Operators visit the variant once for a set, or for a point where no time
   * is lost by it, and are templates of the law below that.
   */
  using JointLaw = std::variant<CoulombLaw, CompositeLaw, BartonBandisLaw,
                                ContinuouslyYieldingLaw>;

  /** Whether @p Law is one of rock joints (rock_point.h). */
  template <typename Law>
  constexpr bool is_rock_law = std::is_same_v<typename Law::Point, RockPoint>;

  /** The largest kn and ks [Pa/m] that a joint can come to. */
  std::array<double, 2> stiffness_bound(const JointLaw &law);

  /** Whether kn and ks grow with the pressure, from less than the bound. */
  bool stiffens(const JointLaw &law);

  /** Whether the joint may open or slip. */
  bool can_fail(const JointLaw &law);

  /** Whether slip may open the joint. */
  bool can_dilate(const JointLaw &law);

  /**
   * The law with its strength divided by @p factor, for factors of safety:
   * cohesion, tensile strength and tan of the friction angle, peak and
   * residual; of Barton-Bandis the shear strength, of continuously yielding
   * the tangents of both angles. A dilation angle is not above the reduced
   * friction angle. Stiffnesses, fracture energies, the cap of the composite
   * law and slips stay.
   */
  JointLaw reduced(const JointLaw &law, double factor);
} // namespace quoin

#endif
