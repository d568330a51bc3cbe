// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_projection_h
#define quoin_elastodynamics_projection_h

namespace quoin
{
  /** Projection of the boundary integral equation on an element. */
  enum class Projection
  {
    collocation, /**< equation at the midpoint of the element */
    galerkin     /**< equation weighted over the element */
  };
} // namespace quoin

#endif
