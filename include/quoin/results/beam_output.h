// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_beam_output_h
#define quoin_results_beam_output_h

#include <quoin/operators/state.h>
#include <quoin/output/field_series.h>
#include <quoin/structures/beam_fields.h>
#include <quoin/structures/beams.h>

#include <string>

namespace quoin
{
  /** The series beams: lines along the beams that are placed, with N, Q, M,
      displacement, plastic turning and what the interface does. */
  class BeamOutput : public FieldSeries
  {
  public:
    BeamOutput(const std::string &output_directory, MPI_Comm communicator,
               FieldFormat format);

    /** Writes @p beams in @p state; collective. */
    void write(double time, const Beams &beams, const State<2> &state);

  private:
    const bool is_first_rank;
  };

  /** Value of component @p component of HistoryQuantity::beam: displacement x,
      y, N, Q, M at @p node of @p fields; largest displacement, N, Q, M;
      utilisation at the node, the largest one. */
  double beam_value(const BeamFields &fields, unsigned int node,
                    unsigned int component);
} // namespace quoin

#endif
