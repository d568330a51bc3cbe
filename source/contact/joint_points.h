// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_contact_joint_points_h
#define quoin_source_contact_joint_points_h

#include <quoin/base/state.h>
#include <quoin/joints/joint_law.h>

#include <array>
#include <type_traits>

// Points of all joint laws, from and to the arrays of the history, and what
// the laws have in common.

namespace quoin
{
  template <typename Law>
  typename Law::Point read_point(const Law &, const JointHistory &history,
                                 const unsigned int p)
  {
    using Point = typename Law::Point;
    if constexpr (std::is_same_v<Point, JointPoint>)
      return { history.normal_traction[p], history.shear_traction[p],
               history.plastic_slip[p], history.plastic_opening[p],
               history.state[p] };
    else if constexpr (std::is_same_v<Point, CompositePoint>)
      return { history.normal_traction[p],
               history.shear_traction[p],
               history.plastic_slip[p],
               history.plastic_opening[p],
               history.bond[p],
               history.crushing[p],
               history.crack_opening[p],
               history.state[p] };
    else
    {
      static_assert(std::is_same_v<Point, RockPoint>);
      return { history.normal_traction[p], history.shear_traction[p],
               history.plastic_slip[p],    history.plastic_opening[p],
               history.worn_slip[p],       history.dilated[p],
               history.reload[p],          history.state[p] };
    }
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

  inline void write_flow(const RockPoint &point, JointHistory &history,
                         const unsigned int p)
  {
    history.plastic_slip[p]    = point.plastic_slip;
    history.plastic_opening[p] = point.plastic_opening;
    history.worn_slip[p]       = point.worn_slip;
    history.dilated[p]         = point.dilated;
    history.reload[p]          = point.reload;
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

  /**
   * Brings point @p p to @p opening and @p slip [m] and books what that
   * dissipated, by the area @p weight.
   */
  template <typename Law>
  auto advance_joint(const Law &law, const double opening, const double slip,
                     const double weight, JointHistory &history,
                     const unsigned int p, EnergyAccounts &energy)
  {
    auto point = read_point(law, history, p);
    if constexpr (is_rock_law<Law>)
    {
      book(law.update(point, opening, slip), weight, energy);
      write_flow(point, history, p);
    }
    else if (!law.update_elastic(point, opening, slip))
    {
      book(law.update_failing(point, opening, slip), weight, energy);
      write_flow(point, history, p);
    }
    write_tractions(point, history, p);
    return point;
  }

  /** Sets point @p p to tractions [Pa] at rest, at zero opening and slip. */
  template <typename Law>
  void initialise_point(const Law &law, const double normal, const double shear,
                        JointHistory &history, const unsigned int p)
  {
    auto point = read_point(law, history, p);
    if constexpr (is_rock_law<Law>)
      law.initialise(point, normal, shear);
    else
    {
      point.normal_traction = normal;
      point.shear_traction  = shear;
      point.plastic_opening = -normal / law.normal_stiffness;
      point.plastic_slip    = -shear / law.shear_stiffness;
    }
    write_flow(point, history, p);
    write_tractions(point, history, p);
  }

  /** Recoverable energy per area [J/m^2]. */
  template <typename Law, typename Point>
  double energy_of(const Law &law, const Point &point, const double opening)
  {
    if constexpr (std::is_same_v<Point, JointPoint>)
      return law.stored_energy(point, opening);
    else
      return law.stored_energy(point);
  }

  /** kn and ks [Pa/m] at the normal traction @p sigma [Pa]. */
  template <typename Law>
  std::array<double, 2> stiffness_of(const Law &law, const double sigma)
  {
    if constexpr (is_rock_law<Law>)
      return { law.closure.stiffness(-sigma), law.shear_stiffness(-sigma) };
    else
      return { law.normal_stiffness, law.shear_stiffness };
  }
} // namespace quoin

#endif
