// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_joint_points_h
#define quoin_source_contact_joint_points_h

#include <quoin/base/state.h>
#include <quoin/joints/composite_law.h>
#include <quoin/joints/coulomb_law.h>

// Points of both joint laws, from and to the arrays of the history.

namespace quoin
{
  inline JointPoint read_point(const CoulombLaw &, const JointHistory &history,
                               const unsigned int p)
  {
    return { history.normal_traction[p], history.shear_traction[p],
             history.plastic_slip[p], history.plastic_opening[p],
             history.state[p] };
  }

  inline CompositePoint read_point(const CompositeLaw &,
                                   const JointHistory &history,
                                   const unsigned int p)
  {
    return { history.normal_traction[p],
             history.shear_traction[p],
             history.plastic_slip[p],
             history.plastic_opening[p],
             history.bond[p],
             history.crushing[p],
             history.crack_opening[p],
             history.state[p] };
  }

  /** What only a failing update changes. */
  inline void write_flow(const JointPoint &point, JointHistory &history,
                         const unsigned int p)
  {
    history.plastic_slip[p]    = point.plastic_slip;
    history.plastic_opening[p] = point.plastic_opening;
  }

  inline void write_flow(const CompositePoint &point, JointHistory &history,
                         const unsigned int p)
  {
    history.plastic_slip[p]    = point.plastic_slip;
    history.plastic_opening[p] = point.plastic_opening;
    history.bond[p]            = point.bond;
    history.crushing[p]        = point.crushing;
    history.crack_opening[p]   = point.crack_opening;
  }

  inline void book(const JointDissipation &lost, const double weight,
                   EnergyAccounts &energy)
  {
    energy.friction += weight * lost.friction;
    energy.fracture += weight * lost.fracture;
  }

  inline void book(const CompositeDissipation &lost, const double weight,
                   EnergyAccounts &energy)
  {
    energy.friction += weight * lost.friction;
    energy.fracture += weight * (lost.tension + lost.shear);
    energy.crushing += weight * lost.crushing;
  }

  template <typename Point>
  void write_tractions(const Point &point, JointHistory &history,
                       const unsigned int p)
  {
    history.normal_traction[p] = point.normal_traction;
    history.shear_traction[p]  = point.shear_traction;
    history.state[p]           = point.state;
  }
} // namespace quoin

#endif
