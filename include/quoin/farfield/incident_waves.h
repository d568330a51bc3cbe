// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_incident_waves_h
#define quoin_farfield_incident_waves_h

#include <quoin/base/eigen_core.h>
#include <quoin/farfield/boundary_parameters.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/incident_field.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /** Sum of the incident fields of section 'Incident waves'. */
  class IncidentWaves
  {
  public:
    /**
     * @p points: where the field is evaluated beside the boundary; @p duration
     * and @p time_step of the boundary elements [s]. @p boundary must outlive
     * this object. Throws an InputError that begins with the section.
     */
    IncidentWaves(const BoundaryElementParameters &settings,
                  const ElasticMedium &medium, const Boundary &boundary,
                  const std::vector<dealii::Point<2>> &points, double duration,
                  double time_step);

    bool empty() const
    {
      return waves.empty();
    }

    /** Sums of IncidentField over all waves; entry 2 e + i on the boundary. */
    dealii::Tensor<1, 2> displacement(const dealii::Point<2> &x,
                                      double time) const;
    Eigen::VectorXd displacements(double time) const;
    /**
     * Tractions that belong to the step from @p begin to @p end: in its mean,
     * or, for convolution quadrature, at its end.
     */
    Eigen::VectorXd tractions(double begin, double end) const;

    /**
     * Scale of the energy that the waves bring through @p elements of the
     * boundary [J/m]: rho c2 v^2 over their length and the @p duration [s], v
     * from displacements @p time_step [s] apart at a few of them.
     */
    double energy(const ElasticMedium &medium,
                  const std::vector<unsigned int> &elements, double duration,
                  double time_step) const;

    /** For the log. */
    const std::vector<std::string> &reports() const
    {
      return report_texts;
    }

  private:
    void check_place(const IncidentWaveParameters &wave,
                     const std::vector<dealii::Point<2>> &points) const;
    void check_start(const IncidentWaveParameters &wave,
                     const IncidentField &field,
                     const std::function<double(double)> &signal,
                     double duration, double time_step);

    const Boundary &boundary;
    bool tractions_at_end; /**< convolution quadrature */
    std::vector<std::unique_ptr<IncidentField>> waves;
    std::vector<std::string> report_texts;
  };
} // namespace quoin

#endif
