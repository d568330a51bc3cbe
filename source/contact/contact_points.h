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

  inline ContactStep advance(const CoulombLaw &law, ContactPoint &point,
                             const double opening, const double slip)
  {
    JointPoint joint{ point.normal_traction, point.shear_traction,
                      point.plastic_slip, point.plastic_opening, point.state };
    ContactStep step;
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
    point.normal_traction = joint.normal_traction;
    point.shear_traction  = joint.shear_traction;
    point.state           = joint.state;
    return step;
  }

  inline RockPoint rock_point(const ContactPoint &point)
  {
    return { point.normal_traction, point.shear_traction, point.plastic_slip,
             point.plastic_opening, point.worn_slip,      point.dilated,
             point.reload,          point.state };
  }

  template <typename Law>
  std::enable_if_t<is_rock_law<Law>, ContactStep>
  advance(const Law &law, ContactPoint &point, const double opening,
          const double slip)
  {
    RockPoint joint = rock_point(point);
    ContactStep step;
    step.carried = 0.5 * law.stored_energy(joint);
    step.lost    = law.update(joint, opening, slip);
    step.carried += 0.5 * law.stored_energy(joint);
    step.flows = joint.state == JointState::slipping
                 || joint.state == JointState::open;
    point.normal_traction = joint.normal_traction;
    point.shear_traction  = joint.shear_traction;
    point.plastic_slip    = joint.plastic_slip;
    point.plastic_opening = joint.plastic_opening;
    point.worn_slip       = joint.worn_slip;
    point.dilated         = joint.dilated;
    point.reload          = joint.reload;
    point.state           = joint.state;
    return step;
  }

  /** Energy per area [J/m^2] that goes when the contact goes. */
  inline double released_energy(const CoulombLaw &law,
                                const ContactPoint &point)
  {
    return 0.5
           * (point.normal_traction * point.normal_traction
                  / law.normal_stiffness
              + point.shear_traction * point.shear_traction
                    / law.shear_stiffness);
  }

  template <typename Law>
  std::enable_if_t<is_rock_law<Law>, double>
  released_energy(const Law &law, const ContactPoint &point)
  {
    return law.stored_energy(rock_point(point));
  }

  /** Recoverable energy per area [J/m^2]. */
  inline double stored_energy(const CoulombLaw &law, const ContactPoint &point,
                              const double opening)
  {
    return law.stored_energy({ point.normal_traction, point.shear_traction,
                               point.plastic_slip, point.plastic_opening,
                               point.state },
                             opening);
  }

  template <typename Law>
  std::enable_if_t<is_rock_law<Law>, double>
  stored_energy(const Law &law, const ContactPoint &point, const double)
  {
    return law.stored_energy(rock_point(point));
  }
} // namespace quoin

#endif
