// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_line_source_h
#define quoin_elastodynamics_line_source_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/analytic_signal.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/incident_field.h>

#include <functional>
#include <vector>

namespace quoin
{
  /**
   * An explosion along a line in the full plane: a centre of dilatation with
   * the moment M(t) per unit length [N], positive outward. A moment M0 that is
   * switched on at t = 0 gives the radial displacement @cite EringenSuhubi1975
   *
   *   u_r = M0 t / (2 pi rho c1^2 r sqrt(t^2 - r^2/c1^2)), t > r/c1,
   *
   * that is, M0 / (2 pi rho c1^2 r) after a long time. A cavity of radius a
   * with the pressure p is seen from afar as M0 = pi a^2 p (lambda + 2 mu) /
   * mu.
   *
   * M is taken as linear between samples. Convolutions are then closed forms:
   * with S = sqrt(t^2 - r^2/c1^2), the integral of the kernel's t/S,
   * displacements are sums of the changes of M's slope times S, and means over
   * time of tractions sums of these times t S and arcosh(c1 t/r). The
   * singularities at the front are integrated exactly. A value costs a root
   * and, for tractions, a logarithm for each sample at which the slope changes.
   */
  class LineSource : public IncidentField
  {
  public:
    /**
     * @param position of the line [m]; the field has no value there
     * @param moment M(t); zero before @p range begins and constant after its
     *   end. A moment that is not zero at the beginning is reached in the step
     *   before it.
     */
    LineSource(const ElasticMedium &medium, const dealii::Point<2> &position,
               const std::function<double(double)> &moment,
               const SignalRange &range);

    dealii::Tensor<1, 2> displacement(const dealii::Point<2> &x,
                                      double t) const override;

    /** Exact for the moment that is linear between its samples. */
    dealii::Tensor<1, 2> mean_traction(const dealii::Point<2> &x,
                                       const dealii::Tensor<1, 2> &n, double t0,
                                       double t1) const override;

  private:
    /** Change of the slope of the moment. */
    struct Knot
    {
      double time;   /**< [s] */
      double change; /**< change of the slope [N/s] */
    };

    ElasticMedium medium;
    dealii::Point<2> position;
    std::vector<Knot> knots; /**< knots in ascending order of time */
  };
} // namespace quoin

#endif
