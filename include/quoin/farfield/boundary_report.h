// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_boundary_report_h
#define quoin_farfield_boundary_report_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/signals/signal_frequency.h>
#include <quoin/tdbem/formulation.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// What runs of boundary elements, alone or beyond blocks, say alike.

namespace quoin
{
  /** Number and lengths of the elements of each boundary, a line each. */
  std::vector<std::string>
  boundary_lengths(const BoundaryElementParameters &settings,
                   const BoundaryGeometry &geometry);

  /** Boundary values of each boundary in @p duration [s], and the incident
      waves, a line each. */
  std::vector<std::string>
  boundary_lines(const BoundaryElementParameters &settings,
                 const BoundaryGeometry &geometry, double duration);

  /**
   * Warning that elements are too long for the fastest incident wave or value
   * on a boundary within @p duration [s]; or nothing. @p with_stress: the hoop
   * stress is asked for.
   */
  std::vector<std::string>
  boundary_advice(const BoundaryElementParameters &settings,
                  const BoundaryGeometry &geometry, double duration,
                  bool with_stress);

  /**
   * Warning that elements of @p length [m] are too long for @p shaking, with
   * S waves of the speed @p shear_wave [m/s]; or nothing. The hoop stress, if
   * it is asked for, needs shorter ones than the displacement: with n elements
   * to an S wave it lacks 5/n^2 of its peak, measured on a cavity in harmonic
   * waves (theory.md, "Assumptions and limits").
   */
  std::vector<std::string> element_advice(const Shaking &shaking,
                                          double shear_wave, double length,
                                          bool with_stress);

  /** Warning that motion may grow in a run of @p n_steps of @p time_step [s]
      because tractions are given; or nothing. */
  std::vector<std::string>
  stability_lines(const BoundaryElementParameters &settings,
                  const Boundary &boundary, double time_step,
                  std::uint64_t n_steps);

  /** "c1 dt / L from 0.8 to 1.2", of a time step [s]. */
  std::string step_ratio_text(const Boundary &boundary,
                              const ElasticMedium &medium, double time_step);

  /**
   * Scans the discrete impedance of @p options at @p n_frequencies; null if
   * these are none. Collective. See scan_passivity().
   */
  std::unique_ptr<PassivityReport>
  passivity_of(const InfluenceKernel &kernel, const BoundaryHistory &history,
               const Boundary &boundary, const ElasticMedium &medium,
               const FormulationOptions &options, double time_step,
               unsigned int n_frequencies, MPI_Comm communicator);
} // namespace quoin

#endif
