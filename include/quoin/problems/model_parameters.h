// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_model_parameters_h
#define quoin_problems_model_parameters_h

#include <quoin/problems/parameters.h>

namespace quoin
{
  // The parts of read_parameters(). All throw an InputError that names file,
  // section, value and cure.

  /** Declares section 'Mesh'. */
  void declare_mesh(dealii::ParameterHandler &prm);

  /** Sections 'Mesh', 'Wall' and 'Rock': a file, or the geometry of a wall or
      of rock, and where the joints are. */
  void read_mesh(const ParameterSection &top, Parameters &parameters);

  /**
   * The sections of a model of blocks, which @p parameters takes up beside
   * mesh, materials and histories that it has already: joints, contact,
   * loads, far field, initial motion, stages, implicit solver. Checks also
   * whether values of several sections go together.
   */
  void read_block_model(const ParameterSection &top, Parameters &parameters);

  /** The same of a domain with boundary elements alone. */
  void read_boundary_model(const ParameterSection &top, Parameters &parameters);
} // namespace quoin

#endif
