// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_contact_points_h
#define quoin_source_contact_contact_points_h

#include <quoin/joint_elements/joint_points.h>

// Points of general contacts under the joint laws.

namespace quoin
{
  template <typename Law>
  PointOf<Law> read_point(const Law &, const ContactPoint &contact)
  {
    using Point = PointOf<Law>;
    static_assert(Point::internal.size() <= ContactPoint::most_internal);
    Point point;
    point.normal_traction = contact.normal_traction;
    point.shear_traction  = contact.shear_traction;
    point.plastic_slip    = contact.plastic_slip;
    point.plastic_opening = contact.plastic_opening;
    point.state           = contact.state;
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      point.*Point::internal[i] = contact.internal[i];
    return point;
  }

  template <typename Point>
  void write_point(const Point &point, ContactPoint &contact)
  {
    contact.normal_traction = point.normal_traction;
    contact.shear_traction  = point.shear_traction;
    contact.plastic_slip    = point.plastic_slip;
    contact.plastic_opening = point.plastic_opening;
    contact.state           = point.state;
    for (unsigned int i = 0; i < Point::internal.size(); ++i)
      contact.internal[i] = point.*Point::internal[i];
  }

  /** Energy per area [J/m^2] that goes when the contact goes. */
  template <typename Law>
  double released_energy(const Law &law, const ContactPoint &contact)
  {
    const auto point = read_point(law, contact);
    return law.carried_energy(point, point);
  }

  /** A contact that comes up: without tractions, at its residual strength. */
  template <typename Law>
  void begin_point(const Law &law, ContactPoint &contact)
  {
    PointOf<Law> point;
    point.state = JointState::slipped;
    law.wear_out(point);
    write_point(point, contact);
  }
} // namespace quoin

#endif
