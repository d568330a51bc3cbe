// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_input_advice_h
#define quoin_problems_input_advice_h

#include <quoin/problems/parameters.h>
#include <quoin/operators/state.h>
#include <quoin/dynamics/free_bodies.h>
#include <quoin/dynamics/model.h>

#include <string>
#include <vector>

namespace quoin
{
  // What is allowed but most likely a mistake: each a sentence with its cure,
  // to be shown as a warning. All ranks get the same.

  /** About the file and the mesh, whatever the stages. */
  std::vector<std::string> model_advice(const Parameters &parameters,
                                        const Model &model);

  /**
   * About stage @p index of the explicit solver, which has begun with
   * @p state and takes steps of @p time_step [s].
   */
  std::vector<std::string> stage_advice(const Parameters &parameters,
                                        unsigned int index, const Model &model,
                                        const State<2> &state,
                                        double time_step);

  /** That these bodies of stage @p stage will move away; or nothing. */
  std::vector<std::string>
  free_body_advice(const std::string &stage,
                   const std::vector<PushedBody> &bodies);

  /** How coarse the blocks' cells of one material are, for waves. */
  struct CellSize
  {
    /** Largest second-longest edge of a cell: the diagonal of a square of two
        cells does not count [m]; 0: there is no cell. */
    double edge = 0.;
    dealii::Point<2> position; /**< of that cell [m] */
  };

  /** Of each material; cells of blocks absent in @p state do not count. */
  std::vector<CellSize> cell_sizes(const Model &model, const State<2> &state,
                                   std::size_t n_materials);
} // namespace quoin

#endif
