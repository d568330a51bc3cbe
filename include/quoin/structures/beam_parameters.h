// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beam_parameters_h
#define quoin_structures_beam_parameters_h

#include <quoin/base/parameter_section.h>
#include <quoin/signals/time_function.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace quoin
{
  /** What holds an end of a beam: components of the displacement, and the
      rotation. */
  struct BeamSupport
  {
    bool holds_x = false, holds_y = false, holds_rotation = false;

    bool operator==(const BeamSupport &other) const
    {
      return holds_x == other.holds_x && holds_y == other.holds_y
             && holds_rotation == other.holds_rotation;
    }
  };

  /** A beam or liner: a subsection of 'Beams'. */
  struct BeamParameters
  {
    std::string name;
    /** Corners of a free beam [m]; empty: it lines a boundary. */
    std::vector<std::array<double, 2>> points;
    unsigned int n_segments = 10; /**< of each side of a free beam */
    std::string boundary;         /**< curve that it lines, or empty */
    std::string interface;        /**< set of joints between it and blocks */
    std::string stage;            /**< stage that places it; empty: first */

    // Values of one beam, whatever the spacing.
    double modulus       = 0.; /**< E, in plane strain E / (1 - nu^2) [Pa] */
    double area          = 0.; /**< [m^2] */
    double second_moment = 0.; /**< [m^4] */
    double density       = 0.; /**< [kg/m^3] */
    double depth         = 0.; /**< from one outer fibre to the other [m] */
    static constexpr double unlimited = std::numeric_limits<double>::infinity();
    double compressive_strength = unlimited, tensile_strength = unlimited;
    /** Largest moment [N m]; by_section: that of both strengths, with the
        thrust, on a rectangle. */
    double hinge_moment                = unlimited;
    static constexpr double by_section = 0.;
    double spacing = 1.; /**< distance of beams out of the plane [m] */

    std::array<BeamSupport, 2> supports; /**< at start and end */
    /** Forces x, y at start and end [N]. */
    std::array<std::array<TimeFunction, 2>, 2> forces;
    std::array<TimeFunction, 2> distributed; /**< x, y by length [N/m] */

    bool is_liner() const
    {
      return !boundary.empty();
    }

    static void declare(dealii::ParameterHandler &prm);
    static BeamParameters read(const ParameterSection &section,
                               const std::string &name);
  };
} // namespace quoin

#endif
