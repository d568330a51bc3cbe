// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_boundary_report_h
#define quoin_problems_boundary_report_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/farfield/boundary_parameters.h>
#include <quoin/tdbem/boundary.h>
#include <quoin/tdbem/elastic_medium.h>
#include <quoin/tdbem/formulation.h>
#include <quoin/tdbem/passivity.h>

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

// What runs of boundary elements, alone or beyond blocks, choose and say alike.

namespace quoin
{
  /** The time step that the parameters ask for [s]. */
  double wanted_time_step(const BoundaryElementParameters &parameters,
                          const Boundary &boundary,
                          const ElasticMedium &medium);

  /** Number and lengths of the elements of each boundary, a line each. */
  std::vector<std::string>
  boundary_lengths(const BoundaryElementParameters &settings,
                   const BoundaryGeometry &geometry);

  /** "c1 dt / L from 0.8 to 1.2", of a time step [s]. */
  std::string step_ratio_text(const Boundary &boundary,
                              const ElasticMedium &medium, double time_step);

  /**
   * Scans the discrete impedance at @p n_frequencies; null if these are none.
   * Collective. See scan_passivity().
   */
  std::unique_ptr<PassivityReport>
  passivity_of(const InfluenceKernel &kernel, const BoundaryHistory &history,
               const Boundary &boundary, const ElasticMedium &medium,
               const FormulationOptions &formulation, double time_step,
               unsigned int n_frequencies, MPI_Comm communicator);
} // namespace quoin

#endif
