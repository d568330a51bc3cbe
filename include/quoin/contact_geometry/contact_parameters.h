// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_contact_parameters_h
#define quoin_contact_geometry_contact_parameters_h

#include <quoin/base/parameter_section.h>

#include <array>

namespace quoin
{
  /** The section 'Contact'. */
  struct ContactParameters
  {
    enum class Outside
    {
      report,
      remove,
      stop
    };

    bool large_displacements = false;

    /** Share of the shorter edge over which a corner's normal turns. */
    double rounding = 0.001;
    /** Slip or opening of a matched joint by its edge, where it ends. */
    double handover = 0.0005;
    /** Edges nearer than this are candidates; 0: automatic [m]. */
    double skin = 0.;
    /** Largest overlap by the height of the cells behind the edges. */
    double deepest = 0.25;

    bool has_box = false;
    std::array<double, 4> box{}; /**< xmin, ymin, xmax, ymax [m] */
    Outside outside = Outside::report;

    static void declare(dealii::ParameterHandler &prm);
    static ContactParameters read(const ParameterSection &section);
  };
} // namespace quoin

#endif
