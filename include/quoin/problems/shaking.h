// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_shaking_h
#define quoin_problems_shaking_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/problems/parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Edges of an S wave below which we warn: eight to ten are right, and with
   * five it runs seven per cent too slowly; theory.md, "Critical time step".
   */
  constexpr double fewest_edges = 5.;

  /** A signal that shakes, and up to which frequency [Hz]; 0: it does not. */
  struct Shaking
  {
    std::string name; /**< "the load 'push'" */
    double frequency = 0.;
  };

  /** The fastest of those that act on blocks in stage @p index. */
  Shaking fastest_load(const Parameters &parameters, unsigned int index);

  /**
   * The fastest of what boundary elements are given in @p duration [s]:
   * incident waves, and values on @p geometry.
   */
  Shaking fastest_boundary_value(const BoundaryElementParameters &parameters,
                                 const BoundaryGeometry &geometry,
                                 double duration);

  /** That boundary elements of @p length [m] are too long; or nothing. */
  std::vector<std::string> element_advice(const Shaking &shaking,
                                          double shear_wave, double length);

  /** When stage @p index begins, as far as it is known [s]. */
  double start_of_stage(const std::vector<StageParameters> &stages,
                        unsigned int index);

  /** Null if there is none. */
  const LoadParameters *find_load(const Parameters &parameters,
                                  const std::string &name);
} // namespace quoin

#endif
