// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beam_fields_h
#define quoin_structures_beam_fields_h

#include <quoin/structures/liner_interface.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** Results of one beam at its nodes, of one beam of the spacing. */
  struct BeamFields
  {
    std::vector<dealii::Point<2>> position;         /**< [m] */
    std::vector<dealii::Tensor<1, 2>> displacement; /**< [m] */
    std::vector<double> axial, shear, moment;       /**< N, Q [N], M [N m] */
    std::vector<double> plastic; /**< plastic turning [rad] */
    /** Stresses of the outer fibres [Pa], and the larger one of both by its
        strength [-]. */
    std::vector<double> least_stress, largest_stress, utilisation;
    /** Tractions [Pa], opening, slip [m] of a liner's interface, 0 else. */
    std::vector<double> normal_traction, shear_traction, opening, slip, state;
    bool is_closed = false;
  };

  BeamFields beam_fields(const Beam &beam, const State<2> &state);

  /** Where the axial force of @p line takes its section beyond a strength that
      'Hinge moment = section' knows: a sentence on it; empty: nowhere. */
  std::string overstress_text(const BeamLine &line, const BeamFields &fields);

  /** Where a liner follows the chords of a polygon in place of a curve, so that
      its axial force bends it by a tenth of the largest moment or more: a
      sentence on it; empty: nowhere. */
  std::string chord_text(const BeamLine &line, const BeamFields &fields);

  /** Node of @p line, counted along it, that is nearest to @p point in the
      mesh. */
  unsigned int nearest_node(const BeamLine &line,
                            const dealii::Point<2> &point);

  /** A line on @p line for the log. */
  std::string beam_text(const BeamLine &line);
} // namespace quoin

#endif
