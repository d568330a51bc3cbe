// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_model_parameters_h
#define quoin_problems_model_parameters_h

#include <quoin/problems/parameters.h>

namespace quoin
{
  /**
   * The sections of a model of blocks, which @p parameters takes up beside
   * mesh, materials and histories that it has already: joints, contact,
   * loads, far field, initial motion, stages, implicit solver. Throws an
   * InputError that names file, section, value and cure, also where values
   * of several sections do not go together.
   */
  void read_block_model(const ParameterSection &top, Parameters &parameters);

  /** The same of a domain with boundary elements alone. */
  void read_boundary_model(const ParameterSection &top, Parameters &parameters);

  /** Sections 'Boundary elements', 'Incident waves', 'Sampled field';
      @p coupled: beyond blocks. */
  void read_boundary_elements(const ParameterSection &top,
                              Parameters &parameters, bool coupled);
} // namespace quoin

#endif
