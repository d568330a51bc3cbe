// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_contact_points_h
#define quoin_source_contact_contact_points_h

#include "joint_points.h"

// Points of general contacts under the joint laws.

namespace quoin
{
  /** What an update of a contact leaves to its geometry and to the books. */
  struct ContactStep
  {
    JointDissipation lost;
    bool flows = false; /**< it failed, slips or is open */
    /** Energy per area [J/m^2] that a change of area takes along. */
    double carried = 0.;
  };

  template <typename Law>
  typename Law::Point read_point(const Law &, const ContactPoint &point)
  {
    if constexpr (is_rock_law<Law>)
      return { point.normal_traction, point.shear_traction, point.plastic_slip,
               point.plastic_opening, point.worn_slip,      point.dilated,
               point.reload,          point.state };
    else
    {
      static_assert(std::is_same_v<typename Law::Point, JointPoint>);
      return { point.normal_traction, point.shear_traction, point.plastic_slip,
               point.plastic_opening, point.state };
    }
  }

  /** Brings @p point to @p opening and @p slip [m]. */
  template <typename Law>
  ContactStep advance_contact(const Law &law, ContactPoint &point,
                              const double opening, const double slip)
  {
    auto joint = read_point(law, point);
    ContactStep step;
    if constexpr (is_rock_law<Law>)
    {
      step.carried = 0.5 * law.stored_energy(joint);
      step.lost    = law.update(joint, opening, slip);
      step.carried += 0.5 * law.stored_energy(joint);
      step.flows = joint.state == JointState::slipping
                   || joint.state == JointState::open;
      point.plastic_slip    = joint.plastic_slip;
      point.plastic_opening = joint.plastic_opening;
      point.worn_slip       = joint.worn_slip;
      point.dilated         = joint.dilated;
      point.reload          = joint.reload;
    }
    else
    {
      step.flows = !law.update_elastic(joint, opening, slip);
      if (step.flows)
      {
        step.lost             = law.update_failing(joint, opening, slip);
        point.plastic_slip    = joint.plastic_slip;
        point.plastic_opening = joint.plastic_opening;
      }
      step.carried = 0.5
                     * (point.normal_traction * joint.normal_traction
                            / law.normal_stiffness
                        + point.shear_traction * joint.shear_traction
                              / law.shear_stiffness);
    }
    point.normal_traction = joint.normal_traction;
    point.shear_traction  = joint.shear_traction;
    point.state           = joint.state;
    return step;
  }

  /** Energy per area [J/m^2] that goes when the contact goes. */
  template <typename Law>
  double released_energy(const Law &law, const ContactPoint &point)
  {
    if constexpr (is_rock_law<Law>)
      return law.stored_energy(read_point(law, point));
    else
      return 0.5
             * (point.normal_traction * point.normal_traction
                    / law.normal_stiffness
                + point.shear_traction * point.shear_traction
                      / law.shear_stiffness);
  }
} // namespace quoin

#endif
