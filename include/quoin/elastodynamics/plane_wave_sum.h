// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_plane_wave_sum_h
#define quoin_elastodynamics_plane_wave_sum_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/analytic_signal.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/incident_field.h>

#include <functional>
#include <memory>
#include <vector>

namespace quoin
{
  /**
   * A sum of plane waves of one signal f, homogeneous or not: their
   * displacement is Re(A F(t - s x)) with the analytic signal F of f, the
   * amplitude A and the slowness vector s. Both are complex where a wave
   * clings to the surface of the half-plane y < 0; products of vectors are
   * without conjugation.
   */
  class PlaneWaveSum : public IncidentField
  {
  public:
    struct Component
    {
      Eigen::Vector2cd amplitude; /**< polarisation times coefficient [-] */
      Eigen::Vector2cd slowness;  /**< [s/m] */

      /** Whether the signal is a multiple of f at a real time. */
      bool is_real() const
      {
        return amplitude.imag().isZero(0.) && slowness.imag().isZero(0.);
      }
    };

    dealii::Tensor<1, 2> displacement(const dealii::Point<2> &x,
                                      double t) const override;

    /**
     * Tractions are linear in the derivative of the signal: their mean is
     * exact and needs the signal only at both ends.
     */
    dealii::Tensor<1, 2> mean_traction(const dealii::Point<2> &x,
                                       const dealii::Tensor<1, 2> &n, double t0,
                                       double t1) const override;

    bool has_precursors() const override;

    const std::vector<Component> &components() const
    {
      return waves;
    }

  protected:
    PlaneWaveSum(const ElasticMedium &medium, std::function<double(double)> f);

    /** The analytic signal is made if a component needs it. */
    void set_components(std::vector<Component> components,
                        const SignalRange &range);

  private:
    ElasticMedium medium;
    std::function<double(double)> f;
    std::vector<Component> waves;
    std::shared_ptr<const AnalyticSignal> signal;
  };
} // namespace quoin

#endif
