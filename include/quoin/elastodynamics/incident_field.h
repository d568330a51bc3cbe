// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_incident_field_h
#define quoin_elastodynamics_incident_field_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>

namespace quoin
{
  /**
   * A field that solves the equations of motion in the full plane or in the
   * half-plane y < 0 with its free surface, as it is without the boundary that
   * is to scatter it.
   *
   * A computation that starts at rest needs a field that is zero on the
   * boundary until then.
   */
  class IncidentField
  {
  public:
    virtual ~IncidentField() = default;

    /** Displacement [m] at the place @p x [m] and time @p t [s]. */
    virtual dealii::Tensor<1, 2> displacement(const dealii::Point<2> &x,
                                              double t) const = 0;

    /**
     * The mean over [@p t0, @p t1] of the traction sigma n [Pa] on a plane with
     * the unit normal @p n; tension is positive.
     */
    virtual dealii::Tensor<1, 2> mean_traction(const dealii::Point<2> &x,
                                               const dealii::Tensor<1, 2> &n,
                                               double t0, double t1) const = 0;

    /**
     * Whether signals contain the Hilbert transform of the given one: then
     * something, little, is there before the wave arrives, at all times.
     */
    virtual bool has_precursors() const
    {
      return false;
    }

    /**
     * Displacements at the time @p t [m], in the mean over each element by four
     * Gauss points: entry 2 e + i.
     */
    Eigen::VectorXd displacements(const Boundary &boundary, double t) const;

    /**
     * Tractions on the boundary [Pa], in the mean over [@p t0, @p t1] and, by
     * four Gauss points, over each element: entry 2 e + i.
     */
    Eigen::VectorXd mean_tractions(const Boundary &boundary, double t0,
                                   double t1) const;
  };
} // namespace quoin

#endif
