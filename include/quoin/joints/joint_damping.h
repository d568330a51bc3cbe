// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_damping_h
#define quoin_joints_joint_damping_h

namespace quoin
{
  /**
   * Dashpots beside the springs of a joint, as shares of critical damping [-]
   * of the two blocks that it is between, as masses on these springs.
   */
  struct JointDamping
  {
    double normal = 0.;
    double shear  = 0.;

    bool acts() const
    {
      return normal > 0. || shear > 0.;
    }
  };

  /**
   * Coefficient of restitution [-] of two masses that meet on a spring and a
   * dashpot with the damping ratio @p xi, which push but do not pull
   * (@cite SchwagerPoeschel2007, Eq. 21): with xi = cos(phi),
   * @f[ \ln e = -2 \xi \arccos \xi / \sqrt{1 - \xi^2} , @f]
   * and the hyperbolic functions above 1.
   */
  double restitution_of_damping(double xi);

  /** Damping ratio [-] for @p restitution in (0, 1], the inverse of
      restitution_of_damping(). */
  double damping_of_restitution(double restitution);
} // namespace quoin

#endif
