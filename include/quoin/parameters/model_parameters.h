// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_parameters_model_parameters_h
#define quoin_parameters_model_parameters_h

#include <quoin/parameters/parameters.h>

namespace quoin
{
  // The parts of read_parameters(). All throw an InputError that names file,
  // section, value and cure.

  /** Declares section 'Mesh'. */
  void declare_mesh(dealii::ParameterHandler &prm);

  /** Reads sections 'Mesh', 'Wall' and 'Rock': a file, or the geometry of a
      wall or of rock, and the places of joints. */
  void read_mesh(const ParameterSection &top, Parameters &parameters);

  /** Dimension of the model as far as 'File' and 'Dimension' of section 'Mesh'
      say, which are all that @p top needs to have; 0: they do not. */
  unsigned int dimension_of_mesh(const ParameterSection &top);

  /** Refuses sections that belong to two dimensions before their entries are
      read, if the mesh is known to have three. */
  void check_sections_in_space(const ParameterSection &top,
                               const Parameters &parameters);

  /**
   * Reads the sections of a model of blocks into @p parameters, which has mesh,
   * materials and histories already: joints, contact, loads, far field, initial
   * motion, stages, implicit solver. Also checks values of several sections
   * against each other.
   */
  void read_block_model(const ParameterSection &top, Parameters &parameters);

  /** Reads the sections of a domain of boundary elements alone. */
  void read_boundary_model(const ParameterSection &top, Parameters &parameters);
} // namespace quoin

#endif
