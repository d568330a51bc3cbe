// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_cable_output_h
#define quoin_results_cable_output_h

#include <quoin/output/field_series.h>
#include <quoin/reinforcement/bar_results.h>

#include <string>

namespace quoin
{
  /** The series cables: elements of bars as lines, written by the first rank.
      Members are collective. */
  class CableOutput : public FieldSeries
  {
  public:
    CableOutput(const std::string &output_directory, MPI_Comm communicator,
                FieldFormat format);

    /** @p fields: the same on all ranks. @p earlier: displacement of their
        points before a stage has reset it [m]; empty: none has. */
    void write(double time, const CableFields &fields,
               const std::vector<dealii::Tensor<1, 2>> &earlier = {});

  private:
    bool is_first; /**< rank */
  };

  /** Displacement of the points of cable_fields() where a stage has reset
      displacements, see ResultOrigin [m]; empty: none has. */
  std::vector<dealii::Tensor<1, 2>>
  earlier_displacement(const Reinforcement &reinforcement,
                       const State<2> &state);
} // namespace quoin

#endif
