// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_mesh_parameters_h
#define quoin_problems_mesh_parameters_h

#include <quoin/problems/parameters.h>

namespace quoin
{
  /** Sections 'Mesh', 'Wall' and 'Rock'. */
  void declare_mesh(dealii::ParameterHandler &prm);

  /**
   * Reads them into @p parameters: a file, or the geometry of a wall or of
   * rock, and where the joints are. Throws an InputError that names file,
   * section and cure.
   */
  void read_mesh(const ParameterSection &top, Parameters &parameters);

  /** Throws an InputError if the solver cannot use the kind of triangles. */
  void check_triangles(const ParameterSection &top,
                       const Parameters &parameters);
} // namespace quoin

#endif
