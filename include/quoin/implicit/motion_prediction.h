// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_motion_prediction_h
#define quoin_implicit_motion_prediction_h

#include <quoin/implicit/equilibrium.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Predicts that a load step, or a step of a jump, goes on as the last one,
      which ImplicitState keeps. */
  template <int dim>
  class MotionPrediction
  {
  public:
    /** For a stage; keeps references. */
    MotionPrediction(const Model<dim> &model, DofMap<dim> &dof_map);

    /** Keeps in @p now the motion @p from one equilibrium @p to the next, in
        which the load time or the pseudo-time advanced by @p went, and what
        held the nodes at the @p start and at the end of it. */
    void remember(const Configuration<dim> &from, const Configuration<dim> &to,
                  const Balance<dim> &start, const Balance<dim> &end,
                  double went, ImplicitState &now) const;

    /** Moves @p configuration on by @p share of the motion in @p now, to the
        load time @p load_time [s]; @p motion is overwritten. Collective. */
    void move(const ImplicitState &now, double share, double load_time,
              DofVector &motion, Configuration<dim> &configuration) const;

    /**
     * What the reactions of held nodes at the @p predicted configuration lack
     * of having gone on from @p start as in the last step, @p share times as
     * far: the sum of their components by the applied forces [-]. Where joints
     * begin to yield between motions that are all prescribed nothing else shows
     * it. Collective.
     */
    double error_of_reactions(const ImplicitState &now, double share,
                              const Balance<dim> &start,
                              const Balance<dim> &predicted) const;

  private:
    const Model<dim> &model;
    DofMap<dim> &dof_map;
    /** Whether a motion is prescribed, of the components of owned nodes. */
    std::vector<bool> held;
  };
} // namespace quoin

#endif
