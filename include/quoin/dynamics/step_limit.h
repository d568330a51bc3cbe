// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_step_limit_h
#define quoin_dynamics_step_limit_h

#include <quoin/model/model.h>

#include <deal.II/base/point.h>

#include <array>
#include <string>

namespace quoin
{
  /**
   * What limits the critical time step of a model without mass scaling and
   * damping, by the bound of StableTimeStep. A body is a node of deformable
   * blocks or a rigid block.
   */
  template <int dim>
  struct StepLimit
  {
    static constexpr std::array<double, 3> shares = { 0.001, 0.01, 0.1 };

    double critical = 0.;     /**< [s]; 0: there are no bodies */
    dealii::Point<dim> where; /**< the body that limits it [m] */
    unsigned int block = 0;   /**< its block */
    bool is_rigid      = false;
    double cells_share = 0.; /**< share of cells in its omega^2 [-] */
    /** How many times as long the critical step would be without that share
        of the bodies whose frequencies are highest [-]. */
    std::array<double, shares.size()> longer{};

    /** Whether without a tenth of the nodes the step would be four times as
        long. */
    bool is_of_few() const
    {
      return !is_rigid && longer[2] > 4.;
    }

    /** Sentences for the log. */
    std::string text() const;
  };

  /** The step limit of @p model in @p state. Collective; alike on all ranks. */
  template <int dim>
  StepLimit<dim> find_step_limit(const Model<dim> &model,
                                 const State<dim> &state);
} // namespace quoin

#endif
