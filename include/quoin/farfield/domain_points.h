// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_domain_points_h
#define quoin_farfield_domain_points_h

#include <quoin/farfield/boundary_parameters.h>
#include <quoin/elastodynamics/boundary.h>

#include <array>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** Points of a grid in the domain of boundary elements. */
  struct DomainPoints
  {
    std::vector<dealii::Point<2>> points; /**< [m] */
    /** Triangles between the points. */
    std::vector<std::array<std::int32_t, 3>> triangles;
  };

  /**
   * The points of the box of @p field that are in the domain and a quarter of
   * an element or more from the boundary, and triangles between them that do
   * not lie across it; nothing without a box. Throws an InputError that begins
   * with the section if there is no such point.
   */
  DomainPoints make_domain_points(const SampledFieldParameters &field,
                                  const Boundary &boundary);
} // namespace quoin

#endif
