// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/boundary_report.h>
#include <quoin/base/number_text.h>

#include <algorithm>

namespace quoin
{
  double wanted_time_step(const BoundaryElementParameters &parameters,
                          const Boundary &boundary, const ElasticMedium &medium)
  {
    return parameters.time_step > 0.
               ? parameters.time_step
               : parameters.step_ratio * boundary.lengths().minCoeff()
                     / medium.c1;
  }

  std::vector<std::string>
  boundary_lengths(const BoundaryElementParameters &settings,
                   const BoundaryGeometry &geometry)
  {
    std::vector<std::string> lines;
    const Eigen::VectorXd lengths = geometry.boundary.lengths();
    for (unsigned int k = 0; k < settings.boundaries.size(); ++k)
    {
      unsigned int n = 0;
      double total = 0., least = 1e300, most = 0.;
      for (unsigned int e = 0; e < geometry.owner.size(); ++e)
        if (geometry.owner[e] == k)
        {
          ++n;
          total += lengths[e];
          least = std::min(least, lengths[e]);
          most  = std::max(most, lengths[e]);
        }
      lines.push_back(
          "boundary " + settings.boundaries[k].name + ": " + std::to_string(n)
          + " elements over " + number_text(total) + " m, "
          + (most - least < 1e-6 * most
                 ? "each " + number_text(most)
                 : "from " + number_text(least) + " to " + number_text(most))
          + " m");
    }
    return lines;
  }

  std::string step_ratio_text(const Boundary &boundary,
                              const ElasticMedium &medium,
                              const double time_step)
  {
    const Eigen::VectorXd lengths = boundary.lengths();
    const double low              = medium.c1 * time_step / lengths.maxCoeff();
    const double high             = medium.c1 * time_step / lengths.minCoeff();
    return "c1 dt / L "
           + (high - low < 1e-6 * high
                  ? number_text(high)
                  : "from " + number_text(low) + " to " + number_text(high));
  }

  std::unique_ptr<PassivityReport>
  passivity_of(const InfluenceKernel &kernel, const BoundaryHistory &history,
               const Boundary &boundary, const ElasticMedium &medium,
               const FormulationOptions &formulation, const double time_step,
               const unsigned int n_frequencies, const MPI_Comm communicator)
  {
    if (n_frequencies == 0)
      return nullptr;
    // As wide as the scan needs to miss little: what rings at a frequency is
    // seen from the next one.
    const double radius        = 1. - 0.5 / double(n_frequencies);
    const ZTransform transform = make_transform(
        kernel, history, boundary, medium, formulation, communicator);
    return std::make_unique<PassivityReport>(scan_passivity(
        transform, boundary, medium, time_step, n_frequencies, radius));
  }
} // namespace quoin
