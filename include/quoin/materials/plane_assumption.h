// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_plane_assumption_h
#define quoin_materials_plane_assumption_h

namespace quoin
{
  /** Assumption on the out-of-plane direction. */
  enum class PlaneAssumption
  {
    plane_strain, /**< zero strain out of the plane: long bodies */
    plane_stress  /**< zero stress out of the plane: thin bodies */
  };
} // namespace quoin

#endif
