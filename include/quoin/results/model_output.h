// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_model_output_h
#define quoin_results_model_output_h

#include <quoin/dynamics/solver.h>
#include <quoin/results/beam_output.h>
#include <quoin/results/block_output.h>
#include <quoin/results/cable_output.h>
#include <quoin/results/joint_output.h>

#include <string>

namespace quoin
{
  /** The series blocks, joints and, if there are any, contacts of general
      contacts, cables and beams. Members are collective. */
  template <int dim>
  class ModelOutput
  {
  public:
    /** @p model and @p solver must outlive this object. */
    ModelOutput(const std::string &folder, const Model<dim> &model,
                Solver<dim> &solver, const FieldFormat format);

    /** Begins the series, or continues those of a checkpoint. */
    void start();

    /** Writes the fields of @p state at @p time [s]. */
    void write(double time, const State<dim> &state);

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &blocks &joints &contacts &cables &beams;
    }

  private:
    const Model<dim> &model;
    Solver<dim> &solver;
    BlockOutput blocks;
    JointOutput joints, contacts;
    CableOutput cables;
    BeamOutput beams;
  };
} // namespace quoin

#endif
